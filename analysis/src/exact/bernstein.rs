//! Exact sign decisions for polynomials on a box, by Bernstein coefficients in integer fixed point.
//!
//! A polynomial on `[0, 1]` is a convex combination of its Bernstein coefficients, so it is nowhere
//! negative when none of them is. De Casteljau's algorithm halves the interval with additions and
//! shifts only. Numbers are integers in a fixed unit; whatever is cut off is cut off downwards, so a
//! coefficient here is never above the true one, and "nowhere negative" is a theorem.

use crate::exact::rational::{Rational, common_denominator, numerator_over};
use crate::interest::Interest;
use crate::stability::margin::Margin;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

mod basis;
mod cover;
mod fixed_point;
#[cfg(test)]
mod resolution;

pub(crate) use basis::polar_weights;
use basis::{binomials, scaled_bernstein, stretched};
pub use cover::{SignedBox, exact_cover};
use fixed_point::{amplification, nowhere_negative};

/// How much work a decision took: counts, not seconds, so that tests can hold it down.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Boxes whose Bernstein coefficients were looked at.
    pub boxes: usize,
    /// Exact evaluations of the polynomial at a point.
    pub evaluations: usize,
    /// Cells between critical values decided by Sturm's theorem.
    pub cells: usize,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.boxes += other.boxes;
        self.evaluations += other.evaluations;
        self.cells += other.cells;
    }
}

/// The answer to "is the polynomial nowhere negative on the box?".
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sign {
    /// It is: proved.
    NowhereNegative,
    /// It is not: a corner of a box is negative beyond the rounding.
    SomewhereNegative {
        /// The corner's `s`.
        phase_parameter: Rational,
        /// The corner's `t`.
        courant_parameter: Rational,
    },
    /// Not decided within the permitted number of boxes.
    Undecided,
}

/// Bits of the fixed point beyond the spread of the Bernstein coefficients.
const FIXED_POINT_BITS: u32 = 256;

/// With fewer bits machine integers are not tried.
const LEAST_NARROW_BITS: i64 = 32;

/// A margin `P(s, t) = Σ_j t^j p_j(s)` prepared for decisions: each `p_j` in scaled Bernstein form,
/// `p_j(s) = Σ_i β_{j,i} s^i (1 − s)^{n−i}`, with integer `β`.
#[derive(Debug, Clone)]
pub struct MarginForm {
    powers: Vec<Vec<BigInt>>,
    radius: Vec<BigInt>,
    binomials: Vec<BigInt>,
    fixed_point_bits: u32,
    /// Whether decisions are still wanted.
    interest: Interest,
}

impl MarginForm {
    /// Converts the cosine series of a margin.
    pub fn new(margin: &Margin) -> Self {
        let degree = margin.degree();
        let powers =
            margin.integer_series().iter().map(|series| scaled_bernstein(series, degree)).collect();
        Self {
            powers,
            radius: margin.integer_radius().to_vec(),
            binomials: binomials(degree),
            fixed_point_bits: FIXED_POINT_BITS,
            interest: Interest::default(),
        }
    }

    /// The same, undecided once nobody wants to know.
    #[must_use]
    pub fn while_wanted(self, interest: &Interest) -> Self {
        Self { interest: interest.clone(), ..self }
    }

    /// Whether decisions are still wanted.
    pub(crate) fn is_wanted(&self) -> bool {
        !self.interest.is_lost()
    }

    /// The same, fit to tell the sign of a margin that is only `2^−bits` of its size.
    pub fn resolving(self, bits: u32) -> Self {
        Self {
            fixed_point_bits: self.fixed_point_bits.max(2 * bits + FIXED_POINT_BITS / 2),
            ..self
        }
    }

    /// `t^m P(s, 1/t)`: positive values of `t` beyond a bound become those below its reciprocal.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.powers.reverse();
        self.radius.reverse();
        self
    }

    /// The degree in `s`.
    pub fn degree(&self) -> usize {
        self.binomials.len() - 1
    }

    /// The polynomial in `t` at a fixed `s ∈ [0, 1]`, in units of the margin's denominator, lowered
    /// (`-1`), kept (`0`) or raised (`1`) by the uncertainty of the data.
    pub fn at_phase_parameter(&self, s: &Rational, shift: i64) -> Vec<Rational> {
        let scale = s.denom().pow(self.degree() as u32);
        let integers = self.integers_at(s, shift);
        integers.into_iter().map(|value| Rational::new(value, scale.clone())).collect()
    }

    /// [`at_phase_parameter`](Self::at_phase_parameter) times a positive integer that makes all
    /// coefficients integers: enough for signs and roots, and free of divisions.
    pub fn integers_at(&self, s: &Rational, shift: i64) -> Vec<BigInt> {
        let (point, complement) = (s.numer(), s.denom() - s.numer());
        let scale = s.denom().pow(self.degree() as u32);
        self.powers
            .iter()
            .zip(&self.radius)
            .map(|(coefficients, radius)| {
                // Homogeneous Horner scheme: Σ β_i p^i r^{n−i}.
                let (mut sum, mut power) = (BigInt::zero(), BigInt::one());
                for coefficient in coefficients.iter().rev() {
                    sum = sum * point + coefficient * &power;
                    power *= &complement;
                }
                sum + radius * shift * &scale
            })
            .collect()
    }

    /// Decides whether `P` is nowhere negative on `0 ≤ s ≤ 1`, `from ≤ t ≤ to`, looking at no more than
    /// `max_boxes` boxes. Machine integers come first; where their rounding could decide, long ones do.
    pub fn sign(&self, from: &Rational, to: &Rational, max_boxes: usize) -> (Sign, Work) {
        let rows = self.scaled_box(from, to);
        let narrow = self.narrow_bits().and_then(|bits| {
            // What the binomials divide is below 2^126.
            let rows = self.in_fixed_point(&rows, bits, |value, binomial| {
                Some(Integer::div_floor(&value.to_i128()?, &binomial.to_i128()?))
            });
            nowhere_negative(rows?, [from, to], max_boxes, true, &self.interest)
        });
        narrow.unwrap_or_else(|| {
            let bits = i64::from(self.fixed_point_bits);
            let divided = |value: BigInt, binomial: &BigInt| Some(value.div_floor(binomial));
            self.in_fixed_point(&rows, bits, divided)
                .and_then(|rows| {
                    nowhere_negative(rows, [from, to], max_boxes, false, &self.interest)
                })
                .expect("long integers hold any number, and no doubt stops them")
        })
    }

    /// Bits of the fixed point that leave room for the sums of a halving in an `i128`, if they tell anything.
    fn narrow_bits(&self) -> Option<i64> {
        let bits = 125 - self.degree() as i64 - amplification(self.degree());
        (bits >= LEAST_NARROW_BITS).then_some(bits)
    }

    /// Positive multiples of the Bernstein coefficients on the box, exact: row by row they still carry
    /// the binomials of the degree in `s`.
    fn scaled_box(&self, from: &Rational, to: &Rational) -> Vec<Vec<BigInt>> {
        polar_weights(self.powers.len().saturating_sub(1), from, to)
            .into_iter()
            .map(|weights| {
                // The whole function may be lower by the radius, which in scaled form is the radius
                // times the binomial coefficient.
                let lowered: BigInt =
                    weights.iter().zip(&self.radius).map(|(w, radius)| w * radius).sum();
                (0..=self.degree())
                    .map(|i| {
                        let total: BigInt =
                            weights.iter().zip(&self.powers).map(|(w, power)| w * &power[i]).sum();
                        total - &lowered * &self.binomials[i]
                    })
                    .collect()
            })
            .collect()
    }

    /// Divides by the binomials and cuts to a unit far below the size of the polynomial: Bernstein
    /// coefficients of degree `n` exceed the polynomial by less than `2^{3n/2}`, and the bits above that are
    /// far below any tolerance asked for.
    fn in_fixed_point<T>(
        &self,
        rows: &[Vec<BigInt>],
        bits: i64,
        divided: impl Fn(BigInt, &BigInt) -> Option<T>,
    ) -> Option<Vec<Vec<T>>> {
        let largest = rows
            .iter()
            .flat_map(|row| row.iter().zip(&self.binomials))
            .map(|(value, binomial)| value.bits() as i64 - binomial.bits() as i64)
            .max()
            .unwrap_or(0);
        let shift = bits + amplification(self.degree()) - largest;
        let cut = |(value, binomial): (&BigInt, &BigInt)| {
            // Cut off downwards twice is cut off downwards once.
            let shifted = if shift >= 0 { value << shift as u64 } else { value >> (-shift) as u64 };
            divided(shifted, binomial)
        };
        rows.iter().map(|row| row.iter().zip(&self.binomials).map(cut).collect()).collect()
    }
}

/// Whether the polynomial in `t` with these coefficients is negative on the open interval
/// `(from, to)`: all Bernstein coefficients at most zero, one of them below. `None` when the
/// coefficients have both signs.
pub fn is_negative_between(
    coefficients: &[Rational],
    from: &Rational,
    to: &Rational,
) -> Option<bool> {
    let common = common_denominator(coefficients);
    let integers: Vec<BigInt> =
        coefficients.iter().map(|value| numerator_over(value, &common)).collect();
    is_negative_integer_polynomial(&integers, from, to)
}

/// [`is_negative_between`] for integer coefficients.
pub fn is_negative_integer_polynomial(
    coefficients: &[BigInt],
    from: &Rational,
    to: &Rational,
) -> Option<bool> {
    let (mut positive, mut negative) = (false, false);
    for value in stretched(coefficients, from, to) {
        positive |= value.is_positive();
        negative |= value.is_negative();
    }
    match (positive, negative) {
        (true, true) => None,
        (_, negative) => Some(negative),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::cosine_series::CosineSeries;
    use crate::exact::polynomial::Polynomial;
    use crate::exact::rational::{integer, ratio, to_f64};
    use crate::kernel::Kernel;
    use crate::scheme::testing::{SPH, sph};
    use proptest::prelude::*;

    fn margin(scheme: &str, kernel: Kernel, l: Rational) -> Margin {
        sph(scheme, kernel, &l).gain_margin("C", &integer(0)).unwrap().unwrap()
    }

    #[test]
    fn the_published_fractions_of_ratio_two_are_sharp() {
        let form = MarginForm::new(&margin("godunov-sph", Kernel::CubicSpline, integer(2)));
        let limit = ratio(15, 8);
        assert_eq!(form.sign(&integer(0), &limit, 1000).0, Sign::NowhereNegative);
        let above = &limit + ratio(1, 1 << 60);
        let (sign, _) = form.sign(&integer(0), &above, 1000);
        let Sign::SomewhereNegative { phase_parameter, courant_parameter } = sign else {
            panic!("just above the limit a long wave grows, but {sign:?}");
        };
        assert_eq!((phase_parameter, courant_parameter), (integer(0), above));
    }

    #[test]
    fn the_exact_shift_is_nowhere_negative() {
        let form = MarginForm::new(&margin("godunov-sph", Kernel::CubicSpline, integer(1)));
        let (sign, work) = form.sign(&integer(1), &integer(1), 10);
        assert_eq!((sign, work.boxes), (Sign::NowhereNegative, 1));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn evaluation_agrees_with_the_cosine_series(numerator in 5i64..40, at in 0i64..=64, t in 0i64..50) {
            for scheme in SPH {
                let margin = margin(scheme, Kernel::CubicSpline, ratio(numerator, 10));
                let form = MarginForm::new(&margin);
                let (s, t) = (ratio(at, 64), ratio(t, 10));
                let exact = Polynomial::new(form.at_phase_parameter(&s, 0)).evaluate(&t)
                    / Rational::from(margin.denominator().clone());
                let phase = 2.0 * to_f64(&s).sqrt().asin();
                let mut values = Vec::new();
                margin.compile().powers_at(phase, &mut values);
                let float = values.iter().rev().fold(0.0, |sum, p| sum * to_f64(&t) + p);
                let size: f64 = values.iter().rev().fold(0.0, |sum, p| sum * to_f64(&t) + p.abs());
                // asin near 1 loses half the digits of s: the slope there is bounded by degree².
                prop_assert!((to_f64(&exact) - float).abs() < 1e-7 * (1.0 + size));
            }
        }

        #[test]
        fn decisions_agree_with_dense_sampling(
            coefficients in prop::collection::vec(-20i64..20, 1..7), lift in 0i64..60
        ) {
            // A random cosine series lifted by a constant: sampled on 2000 phases.
            let mut values = coefficients;
            values[0] += lift;
            let series = CosineSeries::new(values.into_iter().map(BigInt::from).collect::<Vec<_>>());
            let degree = series.degree();
            let form = MarginForm {
                powers: vec![scaled_bernstein(&series, degree)],
                radius: vec![BigInt::zero()],
                binomials: binomials(degree),
                fixed_point_bits: FIXED_POINT_BITS,
                interest: Interest::default(),
            };
            let float = series.map(|value| to_f64(&Rational::from(value.clone())));
            let lowest = (0..=2000)
                .map(|i| float.at_cosine((f64::from(i) * std::f64::consts::PI / 2000.0).cos()))
                .fold(f64::INFINITY, f64::min);
            match form.sign(&integer(0), &integer(1), 100_000).0 {
                Sign::NowhereNegative => prop_assert!(lowest >= -1e-12),
                // The samples miss a minimum by at most (π/4000)² n² Σ|r|/2.
                Sign::SomewhereNegative { .. } => prop_assert!(lowest < 1e-3),
                Sign::Undecided => prop_assert!(lowest.abs() < 1e-3),
            }
        }

        #[test]
        fn univariate_signs(roots in prop::collection::vec(-20i64..20, 0..4), a in -20i64..20, b in 1i64..20) {
            let p = roots.iter().fold(Polynomial::<Rational>::one(), |p, &root| {
                p * Polynomial::new(vec![integer(-root), integer(1)])
            });
            let (from, to) = (integer(a), integer(a + b));
            if let Some(negative) = is_negative_between(p.coefficients(), &from, &to) {
                for i in 1..50 {
                    let point = &from + (&to - &from) * ratio(i, 50);
                    let value = p.evaluate(&point);
                    prop_assert_eq!(negative, value.is_negative(), "at {}", point);
                }
            }
        }
    }
}
