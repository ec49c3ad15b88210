//! What one step does to a wave, in as many digits as asked for.

use super::roots::{circles, roots};
use super::wave_terms::{Factored, WaveTerm};
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::float::{ComplexFloat, Float};
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::rational::Rational;
use crate::scheme::Step;
use num_bigint::BigInt;
use num_complex::Complex64;
use num_traits::{One, Zero};

/// Iterations of Aberth's method at most; a multiple root gains one bit in each.
const MOST_ITERATIONS: usize = 200;

/// A wave by `s = sin²(φ/2)` and `1 − s`, each with all its digits.
#[derive(Debug, Clone)]
pub(crate) struct Place {
    pub(crate) s: Float,
    pub(crate) complement: Float,
}

impl Place {
    /// The phase in radians.
    pub(crate) fn phase(&self) -> f64 {
        if self.complement.is_zero() {
            return std::f64::consts::PI;
        }
        2.0 * self.s.sqrt().to_f64().atan2(self.complement.sqrt().to_f64())
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
    even: PrecisePart,
    odd: PrecisePart,
}

#[derive(Debug, Clone)]
struct PrecisePart {
    s_power: i32,
    complement_power: i32,
    series: Vec<Float>,
}

impl PreciseStep {
    /// From the [terms](super::wave_terms::difference_terms) of a step whose parameters all have values.
    pub(crate) fn new(step: &Step, terms: &[Vec<WaveTerm>], bits: u32) -> Self {
        let letters: Vec<_> = step.names.letters().collect();
        let place = |name: Variable| letters.iter().position(|(known, _)| *known == name);
        let part = |part: &Factored<BigInt>| PrecisePart {
            s_power: part.s_power,
            complement_power: part.complement_power,
            series: part.series.coefficients().iter().map(|v| Float::integer(v, bits)).collect(),
        };
        let term = |term: &WaveTerm| PreciseTerm {
            letters: term
                .names
                .iter()
                .filter_map(|&(name, power)| Some((place(name)?, power)))
                .collect(),
            even: part(&term.even),
            odd: part(&term.odd),
        };
        let value = |series: &EnclosedSeries| -> Vec<Float> {
            let center = series.center();
            center.coefficients().iter().map(|v| Float::fraction(v, bits)).collect()
        };
        let letters: Vec<Vec<Float>> =
            letters.iter().map(|(_, letter)| value(&letter.value)).collect();
        let powers: Vec<Vec<PreciseTerm>> =
            terms.iter().map(|power| power.iter().map(term).collect()).collect();
        let series = powers.iter().flatten().flat_map(|term| [&term.even.series, &term.odd.series]);
        let orders = series.chain(&letters).map(Vec::len).max().unwrap_or(0);
        Self { bits, letters, powers, orders }
    }

    /// The precision.
    pub(crate) fn bits(&self) -> u32 {
        self.bits
    }

    /// `x` as a wave between an end of `s` and another.
    pub(crate) fn place(&self, anchor: &Rational, width: &Rational, x: f64) -> Place {
        let fraction = |value: &Rational| Float::fraction(value, 2 * self.bits);
        let moved = &fraction(width) * &Float::from_f64(x, self.bits);
        let cut = |value: Float| &value * &Float::integer(&BigInt::one(), self.bits);
        Place {
            s: cut(&fraction(anchor) + &moved),
            complement: cut(&fraction(&(Rational::one() - anchor)) - &moved),
        }
    }

    /// `[1, cos φ, cos 2φ, …]`.
    fn cosines(&self, at: &Place) -> Vec<Float> {
        let cosine = &at.complement - &at.s;
        let twice = cosine.clone().scaled(1);
        let mut cosines = vec![Float::integer(&BigInt::one(), self.bits), cosine];
        while cosines.len() < self.orders {
            let [.., before, last] = cosines.as_slice() else { unreachable!("it starts with two") };
            cosines.push(&(&twice * last) - before);
        }
        cosines
    }

    fn sum(&self, series: &[Float], cosines: &[Float]) -> Float {
        let terms = series.iter().zip(cosines);
        terms.fold(Float::zero(self.bits), |sum, (value, cosine)| &sum + &(value * cosine))
    }

    fn letter_values(&self, at: &Place) -> Vec<Float> {
        let cosines = self.cosines(at);
        self.letters.iter().map(|letter| self.sum(letter, &cosines)).collect()
    }

    /// `[b_0, b_1, …]` of `χ(1 + y)`.
    pub(crate) fn coefficients(&self, at: &Place) -> Vec<ComplexFloat> {
        let cosines = self.cosines(at);
        let sine = (&at.s * &at.complement).sqrt().scaled(1);
        let sum = |series: &[Float]| self.sum(series, &cosines);
        let letters: Vec<Float> = self.letters.iter().map(|letter| sum(letter)).collect();
        let power = |base: &Float, exponent: i32| {
            (0..exponent).fold(Float::integer(&BigInt::one(), self.bits), |p, _| &p * base)
        };
        let part = |part: &PrecisePart| {
            if part.series.is_empty() {
                return Float::zero(self.bits);
            }
            let factor =
                &power(&at.s, part.s_power) * &power(&at.complement, part.complement_power);
            &factor * &sum(&part.series)
        };
        self.powers
            .iter()
            .map(|terms| {
                terms.iter().fold(ComplexFloat::real(Float::zero(self.bits)), |total, term| {
                    let factor = term.letters.iter().fold(
                        Float::integer(&BigInt::one(), self.bits),
                        |product, &(letter, exponent)| {
                            &product * &power(&letters[letter], exponent)
                        },
                    );
                    let odd = &part(&term.odd) * &sine;
                    let value =
                        ComplexFloat { re: &part(&term.even) * &factor, im: &odd * &factor };
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
        let sine = (&at.s * &at.complement).sqrt().scaled(1);
        let shift = ComplexFloat { re: &at.complement - &at.s, im: sine };
        let one = ComplexFloat::real(Float::integer(&BigInt::one(), self.bits));
        let power = |base: &ComplexFloat, exponent: i16| {
            let product = (0..exponent.unsigned_abs()).fold(one.clone(), |p, _| &p * base);
            if exponent < 0 { &one / &product } else { product }
        };
        let letters = self.letter_values(at);
        let places: Vec<Variable> = step.names.letters().map(|(place, _)| place).collect();
        let (mut sum, mut size) = (ComplexFloat::real(Float::zero(self.bits)), None);
        for (exponents, coefficient) in polynomial.terms() {
            let coefficient = ComplexFloat::real(Float::integer(coefficient, self.bits));
            let wave = &power(z, exponents[0]) * &power(&shift, exponents[1]);
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
