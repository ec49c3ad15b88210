//! Numbers that know how far they may be off.

use std::ops::{Add, Div, Mul};

/// A value in `f64` with a bound on its error, both carried through every operation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Rounded {
    pub value: f64,
    pub error: f64,
}

impl Rounded {
    /// A number that no operation has touched.
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A number cut to `f64`.
    pub fn nearest(value: f64) -> Self {
        Self::after(value, 0.0)
    }

    /// What one rounding makes of a value with an error.
    fn after(value: f64, error: f64) -> Self {
        Self { value, error: error + value.abs() * f64::EPSILON / 2.0 }
    }

    /// Whether nothing but errors is left, as of `0.3 - 3*0.1`.
    pub fn vanishes(self) -> bool {
        self.value.abs() <= self.error
    }

    /// The square root of a number that is not negative.
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::after(root, if root > 0.0 { self.error / root } else { self.error.sqrt() })
    }

    /// An integer power.
    pub fn power(self, exponent: i32) -> Self {
        let product =
            (0..exponent.unsigned_abs()).fold(Self::exact(1.0), |product, _| product * self);
        if exponent < 0 { Self::exact(1.0) / product } else { product }
    }
}

impl Add for Rounded {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::after(self.value + other.value, self.error + other.error)
    }
}

impl Mul for Rounded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let error = self.value.abs() * other.error
            + self.error * other.value.abs()
            + self.error * other.error;
        Self::after(self.value * other.value, error)
    }
}

impl Div for Rounded {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        let error = (self.error + quotient.abs() * other.error) / other.value.abs();
        Self::after(quotient, error)
    }
}

/// The largest of some sizes, 0 of none; `f64::max` drops what is no number, this keeps it.
pub(crate) fn largest(sizes: impl Iterator<Item = f64>) -> f64 {
    sizes.fold(0.0, |most: f64, next| if next > most || next.is_nan() { next } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cancels_vanishes_and_what_is_small_does_not() {
        let tenth = Rounded::nearest(0.1);
        assert!((Rounded::nearest(0.3) + Rounded::exact(-3.0) * tenth).vanishes());
        assert!(!(Rounded::nearest(0.3 + 1e-15) + Rounded::exact(-3.0) * tenth).vanishes());
        assert!(!Rounded::nearest(1e-300).vanishes());
    }

    #[test]
    fn roots_and_powers_undo_each_other() {
        for value in [0.3, 2.0, 1e-12] {
            let back = Rounded::nearest(value).sqrt().power(2) + Rounded::nearest(-value);
            assert!(back.vanishes(), "{value}");
            let one = Rounded::nearest(value).power(-3) * Rounded::nearest(value).power(3);
            assert!((one + Rounded::exact(-1.0)).vanishes(), "{value}");
        }
    }

    #[test]
    fn an_error_that_is_no_number_comes_out_on_top() {
        assert_eq!(largest([1.0, 3.0, 2.0].into_iter()), 3.0);
        assert!(largest([1.0, f64::NAN, 2.0].into_iter()).is_nan());
        assert!(largest([f64::NAN].into_iter()).is_nan());
    }
}
