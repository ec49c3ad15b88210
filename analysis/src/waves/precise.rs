//! What one step does to a wave, in as many digits as asked for.

use super::roots::{circles, roots};
use super::wave_terms::{WavePart, WaveTerm};
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::float::{ComplexFloat, Float};
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::rational::Rational;
use crate::exact::torus_series::DenseSeries;
use crate::scheme::Step;
use num_bigint::BigInt;
use num_complex::Complex64;
use num_traits::{One, Zero};

/// Iterations of Aberth's method at most; a multiple root gains one bit in each.
const MOST_ITERATIONS: usize = 200;

/// A wave, its phases one for each axis.
#[derive(Debug, Clone)]
pub(crate) struct Place(pub(crate) Vec<AxisPlace>);

/// One phase by `s = sin²(φ/2)` and `1 − s`, each with all its digits, and the sign of `sin φ`.
#[derive(Debug, Clone)]
pub(crate) struct AxisPlace {
    pub(crate) s: Float,
    pub(crate) complement: Float,
    pub(crate) backward: bool,
}

impl Place {
    /// The phases in radians.
    pub(crate) fn phases(&self) -> Vec<f64> {
        self.0.iter().map(AxisPlace::phase).collect()
    }
}

impl AxisPlace {
    /// The phase in radians, from −π to π.
    pub(crate) fn phase(&self) -> f64 {
        if self.complement.is_zero() {
            return std::f64::consts::PI;
        }
        let phase = 2.0 * self.s.sqrt().to_f64().atan2(self.complement.sqrt().to_f64());
        if self.backward { -phase } else { phase }
    }

    fn cosine(&self) -> Float {
        &self.complement - &self.s
    }

    fn sine(&self) -> Float {
        let sine = (&self.s * &self.complement).sqrt().scaled(1);
        if self.backward { -&sine } else { sine }
    }

    /// `[1, cos φ, cos 2φ, …]`, so many.
    fn cosines(&self, count: usize, bits: u32) -> Vec<Float> {
        let cosine = self.cosine();
        let twice = cosine.clone().scaled(1);
        let mut cosines = vec![Float::integer(&BigInt::one(), bits), cosine];
        while cosines.len() < count {
            let [.., before, last] = cosines.as_slice() else { unreachable!("it starts with two") };
            cosines.push(&(&twice * last) - before);
        }
        cosines
    }
}

/// The coefficients of `χ(1 + y)` in [`Float`]; letters have the values in the middle of their enclosures.
#[derive(Debug, Clone)]
pub(crate) struct PreciseStep {
    bits: u32,
    letters: Vec<Vec<Float>>,
    powers: Vec<Vec<PreciseTerm>>,
    orders: usize,
}

#[derive(Debug, Clone)]
struct PreciseTerm {
    letters: Vec<(usize, i32)>,
    parts: Vec<PrecisePart>,
}

#[derive(Debug, Clone)]
struct PrecisePart {
    odd: [bool; 3],
    s_powers: [i32; 3],
    complement_powers: [i32; 3],
    series: DenseSeries<Float>,
}

impl PreciseStep {
    /// From the [terms](super::wave_terms::difference_terms) of a step whose parameters all have values.
    pub(crate) fn new(step: &Step, terms: &[Vec<WaveTerm>], bits: u32) -> Self {
        let letters: Vec<_> = step.names.letters().collect();
        let place = |name: Variable| letters.iter().position(|(known, _)| *known == name);
        let part = |part: &WavePart| PrecisePart {
            odd: part.odd,
            s_powers: part.s_powers,
            complement_powers: part.complement_powers,
            series: DenseSeries::new(&part.series, step.dimension, |v| Float::integer(v, bits)),
        };
        let term = |term: &WaveTerm| PreciseTerm {
            letters: term
                .names
                .iter()
                .filter_map(|&(name, power)| Some((place(name)?, power)))
                .collect(),
            parts: term.parts.iter().map(part).collect(),
        };
        let value = |series: &EnclosedSeries| -> Vec<Float> {
            let center = series.center();
            center.coefficients().iter().map(|v| Float::fraction(v, bits)).collect()
        };
        let letters: Vec<Vec<Float>> =
            letters.iter().map(|(_, letter)| value(&letter.value)).collect();
        let powers: Vec<Vec<PreciseTerm>> =
            terms.iter().map(|power| power.iter().map(term).collect()).collect();
        let parts = powers.iter().flatten().flat_map(|term| &term.parts);
        let lengths = parts.flat_map(|part| part.series.lengths.iter().copied());
        let orders = lengths.chain(letters.iter().map(Vec::len)).max().unwrap_or(0);
        Self { bits, letters, powers, orders }
    }

    /// The precision.
    pub(crate) fn bits(&self) -> u32 {
        self.bits
    }

    /// In one dimension, `x` as a wave between an end of `s` and another.
    pub(crate) fn place(&self, anchor: &Rational, width: &Rational, x: f64) -> Place {
        let moved = &self.fraction(width) * &Float::from_f64(x, self.bits);
        Place(vec![AxisPlace {
            s: self.cut(&self.fraction(anchor) + &moved),
            complement: self.cut(&self.fraction(&(Rational::one() - anchor)) - &moved),
            backward: false,
        }])
    }

    /// A wave by `sin²(φ/2)` of each of its phases, and whether `sin φ` is negative.
    pub(crate) fn place_on_torus(&self, phases: &[(Rational, bool)]) -> Place {
        let axis = |(s, backward): &(Rational, bool)| AxisPlace {
            s: Float::fraction(s, self.bits),
            complement: Float::fraction(&(Rational::one() - s), self.bits),
            backward: *backward,
        };
        Place(phases.iter().map(axis).collect())
    }

    fn fraction(&self, value: &Rational) -> Float {
        Float::fraction(value, 2 * self.bits)
    }

    fn cut(&self, value: Float) -> Float {
        &value * &Float::integer(&BigInt::one(), self.bits)
    }

    /// A sum over the orders along all axes.
    fn sum(&self, series: &DenseSeries<Float>, cosines: &[Vec<Float>]) -> Float {
        let mut sum = Float::zero(self.bits);
        for (place, value) in series.values.iter().enumerate() {
            if value.is_zero() {
                continue;
            }
            let (mut term, mut rest) = (value.clone(), place);
            for (cosines, length) in cosines.iter().zip(&series.lengths).rev() {
                term = &term * &cosines[rest % length];
                rest /= length;
            }
            sum = &sum + &term;
        }
        sum
    }

    fn cosines(&self, at: &Place) -> Vec<Vec<Float>> {
        at.0.iter().map(|axis| axis.cosines(self.orders, self.bits)).collect()
    }

    /// Letters are functions of the first phase.
    fn letter_values(&self, cosines: &[Vec<Float>]) -> Vec<Float> {
        let value = |letter: &Vec<Float>| {
            let terms = letter.iter().zip(&cosines[0]);
            terms.fold(Float::zero(self.bits), |sum, (value, cosine)| &sum + &(value * cosine))
        };
        self.letters.iter().map(value).collect()
    }

    fn power(&self, base: &Float, exponent: i32) -> Float {
        (0..exponent).fold(Float::integer(&BigInt::one(), self.bits), |power, _| &power * base)
    }

    /// `[b_0, b_1, …]` of `χ(1 + y)`.
    pub(crate) fn coefficients(&self, at: &Place) -> Vec<ComplexFloat> {
        let cosines = self.cosines(at);
        let sines: Vec<Float> = at.0.iter().map(AxisPlace::sine).collect();
        let letters = self.letter_values(&cosines);
        let part = |part: &PrecisePart| {
            let mut value = ComplexFloat::real(self.sum(&part.series, &cosines));
            for (axis, place) in at.0.iter().enumerate() {
                let factor = &self.power(&place.s, part.s_powers[axis])
                    * &self.power(&place.complement, part.complement_powers[axis]);
                value = ComplexFloat { re: &value.re * &factor, im: &value.im * &factor };
                if part.odd[axis] {
                    // Times i sin φ.
                    let sine = &sines[axis];
                    value = ComplexFloat { re: -&(&value.im * sine), im: &value.re * sine };
                }
            }
            value
        };
        let zero = || ComplexFloat::real(Float::zero(self.bits));
        self.powers
            .iter()
            .map(|terms| {
                terms.iter().fold(zero(), |total, term| {
                    let factor = term.letters.iter().fold(
                        Float::integer(&BigInt::one(), self.bits),
                        |product, &(letter, exponent)| {
                            &product * &self.power(&letters[letter], exponent)
                        },
                    );
                    let parts = term.parts.iter().fold(zero(), |sum, p| &sum + &part(p));
                    let value = ComplexFloat { re: &parts.re * &factor, im: &parts.im * &factor };
                    &total + &value
                })
            })
            .collect()
    }

    /// The value of a polynomial of the step at a multiplier, and the largest modulus among its terms, as a power of two.
    pub(crate) fn value(
        &self,
        polynomial: &Laurent,
        step: &Step,
        at: &Place,
        z: &ComplexFloat,
    ) -> (ComplexFloat, Option<i64>) {
        let shift = |axis: &AxisPlace| ComplexFloat { re: axis.cosine(), im: axis.sine() };
        let shifts: Vec<ComplexFloat> = at.0.iter().map(shift).collect();
        let one = ComplexFloat::real(Float::integer(&BigInt::one(), self.bits));
        let power = |base: &ComplexFloat, exponent: i16| {
            let product = (0..exponent.unsigned_abs()).fold(one.clone(), |p, _| &p * base);
            if exponent < 0 { &one / &product } else { product }
        };
        let letters = self.letter_values(&self.cosines(at));
        let places: Vec<Variable> = step.names.letters().map(|(place, _)| place).collect();
        let (mut sum, mut size) = (ComplexFloat::real(Float::zero(self.bits)), None);
        for (exponents, coefficient) in polynomial.terms() {
            let coefficient = ComplexFloat::real(Float::integer(coefficient, self.bits));
            let wave = shifts.iter().zip(&exponents[1..]);
            let wave = wave.fold(power(z, exponents[0]), |wave, (shift, &exponent)| {
                &wave * &power(shift, exponent)
            });
            let mut term = &coefficient * &wave;
            for (place, letter) in places.iter().zip(&letters) {
                term = &term * &power(&ComplexFloat::real(letter.clone()), exponents[place.0]);
            }
            size = size.max(term.magnitude());
            sum = &sum + &term;
        }
        (sum, size)
    }

    /// `|z|² − 1` of the largest multiplier, and its `z − 1`; `None` where there is none but at infinity.
    pub(crate) fn largest(&self, at: &Place) -> Option<(Float, ComplexFloat)> {
        let all = self.differences(&self.coefficients(at));
        let excess = |y: &ComplexFloat| &y.re.clone().scaled(1) + &y.norm_sqr();
        all.into_iter().map(|y| (excess(&y), y)).max_by(|a, b| {
            // Of a conjugate pair the one that travels forward.
            a.0.compare(&b.0).then(b.1.im.compare(&a.1.im))
        })
    }

    /// The finite roots.
    pub(crate) fn differences(&self, coefficients: &[ComplexFloat]) -> Vec<ComplexFloat> {
        let highest = coefficients.iter().rposition(|a| !a.is_zero()).unwrap_or(0);
        let lowest = coefficients.iter().position(|a| !a.is_zero()).unwrap_or(0);
        let mut found = vec![ComplexFloat::real(Float::zero(self.bits)); lowest];
        match &coefficients[lowest..=highest] {
            [] | [_] => {}
            [constant, slope] => found.push(-&(constant / slope)),
            [c, b, a] => {
                let half = b.clone().scaled(-1);
                let root = (&(&half * &half) - &(a * c)).sqrt();
                // The sign that adds to the half: their scalar product is not negative.
                let along = &(&half.re * &root.re) + &(&half.im * &root.im);
                let sum = if along.is_negative() { &half - &root } else { &half + &root };
                found.push(-&(&sum / a));
                found.push(-&(c / &sum));
            }
            several => found.extend(self.aberth(several)),
        }
        found
    }

    fn aberth(&self, a: &[ComplexFloat]) -> Vec<ComplexFloat> {
        let degree = a.len() - 1;
        let mut roots = self.starting_points(a);
        let mut settled = vec![false; degree];
        let tiny = -i64::from(self.bits) + 8;
        for _ in 0..MOST_ITERATIONS {
            for i in 0..degree {
                if settled[i] {
                    continue;
                }
                let y = &roots[i];
                let zero = || ComplexFloat::real(Float::zero(self.bits));
                let (mut value, mut slope) = (zero(), zero());
                for coefficient in a.iter().rev() {
                    slope = &(&slope * y) + &value;
                    value = &(&value * y) + coefficient;
                }
                if value.is_zero() {
                    settled[i] = true;
                    continue;
                }
                // p'/p − Σ 1/(y − y_j): the inverse of the correction.
                let mut inverse = &slope / &value;
                for (j, other) in roots.iter().enumerate() {
                    let distance = y - other;
                    if j != i && !distance.is_zero() {
                        let one = ComplexFloat::real(Float::integer(&BigInt::one(), self.bits));
                        inverse = &inverse - &(&one / &distance);
                    }
                }
                if inverse.is_zero() {
                    settled[i] = true;
                    continue;
                }
                let one = ComplexFloat::real(Float::integer(&BigInt::one(), self.bits));
                let correction = &one / &inverse;
                settled[i] = match (correction.magnitude(), y.magnitude()) {
                    (Some(step), Some(size)) => step <= size + tiny,
                    _ => false,
                };
                roots[i] = &roots[i] - &correction;
            }
            if settled.iter().all(|&done| done) {
                break;
            }
        }
        roots
    }

    /// The roots in `f64`; where that cannot hold them, points on the circles that the moduli of the coefficients suggest.
    fn starting_points(&self, a: &[ComplexFloat]) -> Vec<ComplexFloat> {
        let top = a.iter().filter_map(ComplexFloat::magnitude).max().unwrap_or(0);
        let rounded: Vec<Complex64> =
            a.iter().map(|value| value.clone().scaled(-top).to_c64()).collect();
        let found = roots(&rounded);
        let distinct = |root: &Complex64| root.is_finite() && !root.is_zero();
        if found.iter().all(distinct) {
            // Roots that coincide would move as one.
            return (0..)
                .zip(found)
                .map(|(index, root)| {
                    let turn = Complex64::from_polar(
                        1.0 + 1e-15 * f64::from(index),
                        1e-15 * f64::from(index),
                    );
                    ComplexFloat::from_c64(root * turn, self.bits)
                })
                .collect();
        }
        let heights = a.iter().enumerate().filter(|(_, value)| !value.is_zero());
        let heights = heights.map(|(j, value)| (j, 0.5 * value.norm_sqr().ln())).collect();
        circles(heights)
            .into_iter()
            .map(|(logarithm, angle)| {
                let exponent = (logarithm / std::f64::consts::LN_2).round();
                let rest = (logarithm - exponent * std::f64::consts::LN_2).exp();
                ComplexFloat::from_c64(Complex64::from_polar(rest, angle), self.bits)
                    .scaled(exponent as i64)
            })
            .collect()
    }
}
