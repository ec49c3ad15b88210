//! Cosine series known exactly, or within a stated distance of the true function.

use crate::exact::cosine_series::CosineSeries;
use crate::exact::rational::{
    Rational, common_denominator, integer, least_multiple, numerator_over, quotient_to_f64,
};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::ops::{Add, AddAssign, Mul};

/// Numerators below this power of two have products with room to be added up in an `i128`.
const SHORT_BITS: u32 = 56;

/// `Σ_m r_m cos mφ` with rational `r_m`, and a bound on how far the true function may be at any phase.
///
/// The coefficients are integers over one common denominator. The bound is on the sum of the moduli of
/// the errors of all coefficients, a norm under which products are estimated by products.
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedSeries {
    numerators: Vec<BigInt>,
    denominator: BigInt,
    radius: Rational,
}

impl EnclosedSeries {
    /// From `[r_0, r_1, …]` and the bound on the error, zero when there is none.
    pub fn new(coefficients: &[Rational], radius: Rational) -> Self {
        let denominator = common_denominator(coefficients);
        let numerators =
            coefficients.iter().map(|value| numerator_over(value, &denominator)).collect();
        Self { numerators, denominator, radius }
    }

    /// From integers over a positive denominator.
    pub fn over(numerators: Vec<BigInt>, denominator: BigInt, radius: Rational) -> Self {
        Self { numerators, denominator, radius }
    }

    /// The coefficients in the middle of the enclosure, times the [denominator](Self::denominator).
    pub fn numerators(&self) -> &[BigInt] {
        &self.numerators
    }

    /// What the coefficients are over.
    pub fn denominator(&self) -> &BigInt {
        &self.denominator
    }

    /// A constant, exact.
    pub fn constant(value: Rational) -> Self {
        Self::new(&[value], Rational::zero())
    }

    /// `s = (1 − cos φ)/2`, the square of the sine of half the phase.
    pub fn half_versine() -> Self {
        Self {
            numerators: vec![BigInt::one(), -BigInt::one()],
            denominator: BigInt::from(2),
            radius: Rational::zero(),
        }
    }

    /// The bound on the error.
    pub fn radius(&self) -> &Rational {
        &self.radius
    }

    /// Whether the series is known exactly.
    pub fn is_exact(&self) -> bool {
        self.radius.is_zero()
    }

    /// Whether the function vanishes identically.
    pub fn is_zero(&self) -> bool {
        self.is_exact() && self.numerators.iter().all(Zero::is_zero)
    }

    /// The coefficients in the middle of the enclosure.
    pub fn center(&self) -> CosineSeries<Rational> {
        let values = self.numerators.iter();
        CosineSeries::new(
            values.map(|value| Rational::new(value.clone(), self.denominator.clone())).collect(),
        )
    }

    /// The value of the centre at `φ = 0`.
    pub fn center_at_zero(&self) -> Rational {
        Rational::new(self.numerators.iter().sum(), self.denominator.clone())
    }

    /// Each coefficient correctly rounded.
    pub fn compile(&self) -> CosineSeries<f64> {
        let rounded = self.numerators.iter().map(|value| quotient_to_f64(value, &self.denominator));
        CosineSeries::new(rounded.collect())
    }

    /// The sum of the moduli of the coefficients in the middle.
    fn norm(&self) -> Rational {
        let sum: BigInt = self.numerators.iter().map(Signed::abs).sum();
        Rational::new(sum, self.denominator.clone())
    }

    /// The sum of two.
    pub fn plus(&self, other: &Self) -> Self {
        let denominator = least_multiple(&self.denominator, &other.denominator);
        let (left, right) = (&denominator / &self.denominator, &denominator / &other.denominator);
        let length = self.numerators.len().max(other.numerators.len());
        let zero = BigInt::zero();
        let numerators = (0..length)
            .map(|m| {
                self.numerators.get(m).unwrap_or(&zero) * &left
                    + other.numerators.get(m).unwrap_or(&zero) * &right
            })
            .collect();
        Self { numerators, denominator, radius: &self.radius + &other.radius }
    }

    /// The product of two: `2 cos a cos b = cos(a + b) + cos(a − b)`.
    pub fn times(&self, other: &Self) -> Self {
        let numerators = match (short(&self.numerators), short(&other.numerators)) {
            (Some(left), Some(right)) => {
                product(&left, &right).into_iter().map(BigInt::from).collect()
            }
            _ => product(&self.numerators, &other.numerators),
        };
        let radius = if self.is_exact() && other.is_exact() {
            Rational::zero()
        } else {
            self.norm() * &other.radius + other.norm() * &self.radius + &self.radius * &other.radius
        };
        let denominator = BigInt::from(2) * &self.denominator * &other.denominator;
        Self { numerators, denominator, radius }
    }

    /// The product with itself.
    pub fn squared(&self) -> Self {
        let numerators = match short(&self.numerators) {
            Some(values) => square(&values).into_iter().map(BigInt::from).collect(),
            None => square(&self.numerators),
        };
        if self.is_exact() {
            let denominator = BigInt::from(2) * &self.denominator * &self.denominator;
            return Self { numerators, denominator, radius: Rational::zero() };
        }
        let radius = (self.norm() * integer(2) + &self.radius) * &self.radius;
        let denominator = BigInt::from(2) * &self.denominator * &self.denominator;
        Self { numerators, denominator, radius }
    }

    /// The same function with coefficients cut to multiples of `2^−bits`, and the radius widened by what
    /// was cut off; an exact series is kept as it is.
    pub fn shortened(self, bits: u32) -> Self {
        if self.is_exact() {
            return self;
        }
        let numerators: Vec<BigInt> =
            self.numerators.iter().map(|v| (v << bits).div_floor(&self.denominator)).collect();
        let cut = Rational::new(BigInt::from(numerators.len()), BigInt::one() << bits);
        // The radius is rounded up to the same unit.
        let radius = (self.radius * Rational::from(BigInt::one() << bits)).ceil();
        let radius = radius / Rational::from(BigInt::one() << bits) + cut;
        Self { numerators, denominator: BigInt::one() << bits, radius }
    }

    /// Every coefficient multiplied by an exact factor.
    pub fn scaled(&self, factor: &Rational) -> Self {
        Self {
            numerators: self.numerators.iter().map(|value| value * factor.numer()).collect(),
            denominator: &self.denominator * factor.denom(),
            radius: &self.radius * factor.abs(),
        }
    }
}

/// Numbers whose products can be added up in machine integers, if they are such.
fn short(numerators: &[BigInt]) -> Option<Vec<i128>> {
    let fit = |value: &BigInt| value.to_i64().filter(|v| v.unsigned_abs() < 1 << SHORT_BITS);
    let room = numerators.len() < 1 << (125 - 2 * SHORT_BITS);
    numerators
        .iter()
        .map(|value| fit(value).map(i128::from))
        .collect::<Option<_>>()
        .filter(|_| room)
}

/// `2 Σ_a l_a cos aφ Σ_b r_b cos bφ`.
fn product<T>(left: &[T], right: &[T]) -> Vec<T>
where
    T: Clone + Zero + AddAssign<T> + for<'a> AddAssign<&'a T>,
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    let mut sums = vec![T::zero(); (left.len() + right.len()).saturating_sub(1)];
    for (a, left) in left.iter().enumerate() {
        for (b, right) in right.iter().enumerate() {
            let product = left * right;
            sums[a.abs_diff(b)] += &product;
            sums[a + b] += product;
        }
    }
    sums
}

/// `2 (Σ_a v_a cos aφ)²`.
fn square<T>(values: &[T]) -> Vec<T>
where
    T: Clone + Zero + Add<T, Output = T> + AddAssign<T> + for<'a> AddAssign<&'a T>,
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    let mut sums = vec![T::zero(); (2 * values.len()).saturating_sub(1)];
    for (a, left) in values.iter().enumerate() {
        let square = left * left;
        sums[0] += &square;
        sums[2 * a] += square;
        for (b, right) in values.iter().enumerate().take(a) {
            let product = left * right;
            let twice = product.clone() + product;
            sums[a - b] += &twice;
            sums[a + b] += twice;
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use proptest::prelude::*;

    fn series() -> impl Strategy<Value = Vec<i64>> {
        prop::collection::vec(-30i64..30, 1..7)
    }

    fn enclosed(values: &[i64], radius: Rational) -> EnclosedSeries {
        EnclosedSeries::new(&values.iter().map(|&v| ratio(v, 7)).collect::<Vec<_>>(), radius)
    }

    #[test]
    fn one_factor_that_is_not_exact_makes_the_product_so() {
        let (exact, near) = (enclosed(&[14, -7], ratio(0, 1)), enclosed(&[7], ratio(1, 9)));
        for product in [exact.times(&near), near.times(&exact)] {
            assert!(*product.radius() == ratio(1, 3) && !product.is_exact() && !product.is_zero());
        }
        let zero = |radius| enclosed(&[0, 0], radius);
        assert!(zero(ratio(0, 1)).is_zero() && !zero(ratio(1, 9)).is_zero() && !exact.is_zero());
        // Sums of products of 62 bits take more than 127.
        let long =
            EnclosedSeries::over(vec![BigInt::from(1) << 62; 16], BigInt::one(), ratio(0, 1));
        let whole = long.center_at_zero();
        assert_eq!(long.times(&long).center_at_zero(), &whole * &whole);
        assert_eq!(long.squared().center_at_zero(), &whole * &whole);
    }

    proptest! {
        #[test]
        fn sums_and_products_are_those_of_the_functions(
            a in series(), b in series(), phase in 0.0f64..3.2
        ) {
            let (left, right) = (enclosed(&a, ratio(0, 1)), enclosed(&b, ratio(0, 1)));
            let at = |series: &EnclosedSeries| series.compile().at_cosine(phase.cos());
            let (x, y) = (at(&left), at(&right));
            prop_assert!((at(&left.plus(&right)) - (x + y)).abs() < 1e-11);
            prop_assert!((at(&left.times(&right)) - x * y).abs() < 1e-9);
            let moved = enclosed(&a, ratio(2, 9));
            prop_assert_eq!(moved.squared(), moved.times(&moved));
            let s = (phase / 2.0).sin().powi(2);
            prop_assert!((at(&EnclosedSeries::half_versine()) - s).abs() < 1e-14);
        }

        #[test]
        fn products_of_moved_series_stay_within_the_radius(a in series(), b in series(), which in 0usize..6) {
            // Move one coefficient of each factor by its whole radius: the product must move no further
            // than its own.
            let radius = ratio(3, 11);
            let (left, right) = (enclosed(&a, radius.clone()), enclosed(&b, radius.clone()));
            let product = left.times(&right);
            let moved = |values: &[i64]| {
                let mut values: Vec<Rational> = values.iter().map(|&v| ratio(v, 7)).collect();
                let index = which % values.len();
                values[index] += &radius;
                EnclosedSeries::new(&values, ratio(0, 1))
            };
            let difference =
                moved(&a).times(&moved(&b)).plus(&product.scaled(&ratio(-1, 1)));
            prop_assert!(difference.norm() <= *product.radius());
            // Cutting the coefficients keeps the enclosure.
            let cut = product.clone().shortened(5);
            let moved = cut.plus(&product.scaled(&ratio(-1, 1)));
            prop_assert!(moved.norm() + product.radius() <= *cut.radius());
        }
    }
}
