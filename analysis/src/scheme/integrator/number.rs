//! Rings that know the fractions an integrator's coefficients are made of.

use crate::exact::polynomial::{Polynomial, Ring};
use crate::exact::rational::{Rational, ratio};
use num_complex::Complex64;

/// A commutative ring that contains the rational numbers, exactly or rounded.
pub trait Number: Ring {
    /// `numerator / denominator`.
    fn fraction(numerator: i64, denominator: i64) -> Self;
}

impl Number for f64 {
    fn fraction(numerator: i64, denominator: i64) -> Self {
        numerator as f64 / denominator as f64
    }
}

impl Number for Complex64 {
    fn fraction(numerator: i64, denominator: i64) -> Self {
        f64::fraction(numerator, denominator).into()
    }
}

impl Number for Rational {
    fn fraction(numerator: i64, denominator: i64) -> Self {
        ratio(numerator, denominator)
    }
}

impl<T: Number> Number for Polynomial<T> {
    fn fraction(numerator: i64, denominator: i64) -> Self {
        Self::constant(T::fraction(numerator, denominator))
    }
}
