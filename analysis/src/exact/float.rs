//! Binary floating point of any precision, real and complex, with exponents that do not overflow.
//!
//! For numbers that are looked at, not for proofs: every operation is cut to the precision of its operands, a few units in
//! the last place off.

use crate::exact::rational::{Rational, quotient_to_f64};
use num_bigint::{BigInt, Sign};
use num_complex::Complex64;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// `mantissa · 2^exponent` with at most `bits` bits.
#[derive(Debug, Clone)]
pub struct Float {
    mantissa: BigInt,
    exponent: i64,
    bits: u32,
}

impl Float {
    fn new(mantissa: BigInt, exponent: i64, bits: u32) -> Self {
        if mantissa.is_zero() {
            return Self { mantissa, exponent: 0, bits };
        }
        let excess = mantissa.bits().saturating_sub(u64::from(bits));
        if excess == 0 {
            return Self { mantissa, exponent, bits };
        }
        Self { mantissa: mantissa >> excess, exponent: exponent + excess as i64, bits }
    }

    /// Zero.
    pub fn zero(bits: u32) -> Self {
        Self { mantissa: BigInt::zero(), exponent: 0, bits }
    }

    /// A whole number.
    pub fn integer(value: &BigInt, bits: u32) -> Self {
        Self::new(value.clone(), 0, bits)
    }

    /// A fraction.
    pub fn fraction(value: &Rational, bits: u32) -> Self {
        Self::quotient(value.numer(), value.denom(), bits)
    }

    fn quotient(numerator: &BigInt, denominator: &BigInt, bits: u32) -> Self {
        let shift =
            (i64::from(bits) + 2 + denominator.bits() as i64 - numerator.bits() as i64).max(0);
        Self::new((numerator << shift as u64) / denominator, -shift, bits)
    }

    /// The value of a finite float; zero for others.
    pub fn from_f64(value: f64, bits: u32) -> Self {
        let exact = Rational::from_float(value).unwrap_or_default();
        Self::fraction(&exact, bits)
    }

    /// The precision.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// Whether it is below zero.
    pub fn is_negative(&self) -> bool {
        self.mantissa.is_negative()
    }

    /// The power of two just above the modulus; `None` for zero.
    pub fn magnitude(&self) -> Option<i64> {
        (!self.is_zero()).then(|| self.exponent + self.mantissa.bits() as i64)
    }

    /// The natural logarithm of the modulus.
    pub fn ln(&self) -> f64 {
        let Some(magnitude) = self.magnitude() else { return f64::NEG_INFINITY };
        let reduced = self.clone().scaled(-magnitude).to_f64().abs();
        reduced.ln() + magnitude as f64 * std::f64::consts::LN_2
    }

    /// Times a power of two.
    #[must_use]
    pub fn scaled(self, exponent: i64) -> Self {
        if self.is_zero() { self } else { Self { exponent: self.exponent + exponent, ..self } }
    }

    /// The nearest `f64`; infinite or zero out of its range.
    pub fn to_f64(&self) -> f64 {
        let magnitude = self.magnitude().unwrap_or(0);
        if magnitude > 1100 {
            return if self.is_negative() { f64::NEG_INFINITY } else { f64::INFINITY };
        }
        if magnitude < -1200 {
            return 0.0;
        }
        if self.exponent >= 0 {
            quotient_to_f64(&(&self.mantissa << self.exponent as u64), &BigInt::one())
        } else {
            quotient_to_f64(&self.mantissa, &(BigInt::one() << (-self.exponent) as u64))
        }
    }

    /// The square root of what is not negative.
    #[must_use]
    pub fn sqrt(&self) -> Self {
        let wanted = 2 * i64::from(self.bits) + 4;
        let mut shift = (wanted - self.mantissa.bits() as i64).max(0);
        if (self.exponent - shift) % 2 != 0 {
            shift += 1;
        }
        let root = (&self.mantissa << shift as u64).sqrt();
        Self::new(root, (self.exponent - shift) / 2, self.bits)
    }

    /// Which of two is larger.
    pub fn compare(&self, other: &Self) -> Ordering {
        match (self - other).mantissa.sign() {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        }
    }
}

impl Add for &Float {
    type Output = Float;
    fn add(self, other: &Float) -> Float {
        let bits = self.bits.max(other.bits);
        let (Some(left), Some(right)) = (self.magnitude(), other.magnitude()) else {
            return if self.is_zero() { other.clone() } else { self.clone() };
        };
        // What lies below the last place of the other is not seen.
        if left - right > i64::from(bits) + 2 {
            return self.clone();
        }
        if right - left > i64::from(bits) + 2 {
            return other.clone();
        }
        let (high, low) =
            if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let shifted = &high.mantissa << (high.exponent - low.exponent) as u64;
        Float::new(shifted + &low.mantissa, low.exponent, bits)
    }
}

impl Neg for &Float {
    type Output = Float;
    fn neg(self) -> Float {
        Float { mantissa: -&self.mantissa, ..*self }
    }
}

impl Sub for &Float {
    type Output = Float;
    fn sub(self, other: &Float) -> Float {
        self + &-other
    }
}

impl Mul for &Float {
    type Output = Float;
    fn mul(self, other: &Float) -> Float {
        let bits = self.bits.max(other.bits);
        Float::new(&self.mantissa * &other.mantissa, self.exponent + other.exponent, bits)
    }
}

impl Div for &Float {
    type Output = Float;
    // Exponents of a quotient are subtracted.
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn div(self, other: &Float) -> Float {
        let bits = self.bits.max(other.bits);
        let exponent = self.exponent - other.exponent;
        Float::quotient(&self.mantissa, &other.mantissa, bits).scaled(exponent)
    }
}

/// A complex number of such parts.
#[derive(Debug, Clone)]
pub struct ComplexFloat {
    /// The real part.
    pub re: Float,
    /// The imaginary part.
    pub im: Float,
}

impl ComplexFloat {
    /// A real number.
    pub fn real(re: Float) -> Self {
        Self { im: Float::zero(re.bits), re }
    }

    /// The value of an `f64`.
    pub fn from_c64(value: Complex64, bits: u32) -> Self {
        Self { re: Float::from_f64(value.re, bits), im: Float::from_f64(value.im, bits) }
    }

    /// Rounded.
    pub fn to_c64(&self) -> Complex64 {
        Complex64::new(self.re.to_f64(), self.im.to_f64())
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }

    /// The power of two just above the larger part; `None` for zero.
    pub fn magnitude(&self) -> Option<i64> {
        self.re.magnitude().max(self.im.magnitude())
    }

    /// Times a power of two.
    #[must_use]
    pub fn scaled(self, exponent: i64) -> Self {
        Self { re: self.re.scaled(exponent), im: self.im.scaled(exponent) }
    }

    /// `|z|²`.
    pub fn norm_sqr(&self) -> Float {
        &(&self.re * &self.re) + &(&self.im * &self.im)
    }

    /// The square root with a real part that is not negative.
    #[must_use]
    pub fn sqrt(&self) -> Self {
        if self.is_zero() {
            return self.clone();
        }
        // √z = (t, im/2t) or (im/2t, t) with t² = (|z| + |re|)/2: nothing cancels.
        let modulus = self.norm_sqr().sqrt();
        let size = if self.re.is_negative() { -&self.re } else { self.re.clone() };
        let larger = (&modulus + &size).scaled(-1).sqrt();
        let smaller = &self.im / &larger.clone().scaled(1);
        match (self.re.is_negative(), self.im.is_negative()) {
            (false, _) => Self { re: larger, im: smaller },
            (true, false) => Self { re: smaller, im: larger },
            (true, true) => Self { re: -&smaller, im: -&larger },
        }
    }
}

impl Add for &ComplexFloat {
    type Output = ComplexFloat;
    fn add(self, other: &ComplexFloat) -> ComplexFloat {
        ComplexFloat { re: &self.re + &other.re, im: &self.im + &other.im }
    }
}

impl Sub for &ComplexFloat {
    type Output = ComplexFloat;
    fn sub(self, other: &ComplexFloat) -> ComplexFloat {
        ComplexFloat { re: &self.re - &other.re, im: &self.im - &other.im }
    }
}

impl Neg for &ComplexFloat {
    type Output = ComplexFloat;
    fn neg(self) -> ComplexFloat {
        ComplexFloat { re: -&self.re, im: -&self.im }
    }
}

impl Mul for &ComplexFloat {
    type Output = ComplexFloat;
    fn mul(self, other: &ComplexFloat) -> ComplexFloat {
        ComplexFloat {
            re: &(&self.re * &other.re) - &(&self.im * &other.im),
            im: &(&self.re * &other.im) + &(&self.im * &other.re),
        }
    }
}

impl Div for &ComplexFloat {
    type Output = ComplexFloat;
    fn div(self, other: &ComplexFloat) -> ComplexFloat {
        if other.im.is_zero() {
            return ComplexFloat { re: &self.re / &other.re, im: &self.im / &other.re };
        }
        let square = other.norm_sqr();
        let conjugate = ComplexFloat { re: other.re.clone(), im: -&other.im };
        let product = self * &conjugate;
        ComplexFloat { re: &product.re / &square, im: &product.im / &square }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use proptest::prelude::*;

    const BITS: u32 = 200;

    /// Whether two values agree to a few units in the last place.
    fn near(found: &Float, expected: &Rational) -> bool {
        let difference = found - &Float::fraction(expected, 2 * BITS);
        let Some(error) = difference.magnitude() else { return true };
        error <= found.magnitude().unwrap_or(i64::MIN) - i64::from(BITS) + 4
    }

    #[test]
    fn what_no_f64_holds_is_infinite_or_zero() {
        let power = |sign: i64, exponent: i64| {
            Float::fraction(&ratio(sign, 1), BITS).scaled(exponent).to_f64()
        };
        for sign in [1i64, -1] {
            let unit = sign as f64;
            for exponent in [1024, 1099, 1100, 1101, 1 << 40] {
                assert_eq!(power(sign, exponent), unit * f64::INFINITY);
            }
            assert_eq!(power(sign, 1023), unit * 2f64.powi(1023));
            assert_eq!(power(sign, -1074), unit * f64::from_bits(1));
            for exponent in [-1076, -1199, -1202, -(1 << 40)] {
                assert_eq!(power(sign, exponent), 0.0);
            }
        }
    }

    #[test]
    fn the_longer_of_two_sets_the_precision() {
        let (third, seventh) =
            (Float::fraction(&ratio(1, 3), 60), Float::fraction(&ratio(1, 7), BITS));
        let found = [&third + &seventh, &seventh * &third, &third / &seventh];
        for (found, expected) in found.iter().zip([ratio(10, 21), ratio(1, 21), ratio(7, 3)]) {
            let error = found - &Float::fraction(&expected, BITS);
            assert!(found.bits == BITS && error.magnitude().unwrap() < -55);
        }
        let z = ComplexFloat { re: third, im: seventh };
        assert!((&z + &-&z).is_zero() && (-&z).im.is_negative() && (-&z).re.is_negative());
    }

    proptest! {
        #[test]
        fn operations_are_those_of_fractions(
            a in -999i64..999, b in 1i64..999, c in -999i64..999, d in 1i64..999, exponent in -700i64..700
        ) {
            let power = crate::exact::real_roots::power_of_two(exponent);
            let (p, q) = (ratio(a, b) * &power, ratio(c, d));
            let (x, y) = (Float::fraction(&p, BITS), Float::fraction(&q, BITS));
            prop_assert!(near(&(&x * &y), &(&p * &q)));
            if c != 0 {
                prop_assert!(near(&(&x / &y), &(&p / &q)));
            }
            // Sums cancel: the error is that of the larger term.
            let sum = &(&x + &y) - &Float::fraction(&(&p + &q), 2 * BITS);
            let size = x.magnitude().max(y.magnitude()).unwrap_or(0);
            prop_assert!(sum.magnitude().is_none_or(|m| m <= size - i64::from(BITS) + 4));
            prop_assert_eq!(x.compare(&y), p.cmp(&q));
            let f = crate::exact::rational::to_f64(&p);
            prop_assert!((x.to_f64() - f).abs() <= f.abs() * f64::EPSILON);
            if a > 0 {
                prop_assert!(near(&(&x.sqrt() * &x.sqrt()), &p));
                let expected = (a as f64 / b as f64).ln() + exponent as f64 * std::f64::consts::LN_2;
                prop_assert!((x.ln() - expected).abs() < 1e-12 * (1.0 + expected.abs()));
            }
        }

        #[test]
        fn complex_roots_square_back(a in -99i64..99, b in -99i64..99, c in -99i64..99, d in 1i64..99) {
            let part = |value: i64| Float::fraction(&ratio(value, 7), BITS);
            let z = ComplexFloat { re: part(a), im: part(b) };
            let w = ComplexFloat { re: part(c), im: part(d) };
            let root = z.sqrt();
            prop_assert!(!root.re.is_negative());
            for (error, size) in [(&(&root * &root) - &z, &z), (&(&(&z / &w) * &w) - &z, &z)] {
                let bound = size.magnitude().unwrap_or(0) - i64::from(BITS) + 6;
                prop_assert!(error.magnitude().is_none_or(|m| m <= bound));
            }
        }
    }
}
