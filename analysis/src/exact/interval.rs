//! Closed intervals of `f64` with outward rounding: whatever numbers the operands stand for, the result
//! contains theirs.
//!
//! The rounding mode is never touched. A sum, product, quotient or square root of two floats is the
//! nearest float to the true one; its exact error is found by an error-free transformation (or by a
//! fused multiply-add), and only where that is not zero the end moves one float outwards. Ends are
//! therefore the tightest possible, except near underflow, where one more float is granted.

use crate::exact::rational::{Rational, from_f64, to_f64_above, to_f64_below};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// All real numbers `x` with `lower ≤ x ≤ upper`.
///
/// ```
/// use courant_analysis::exact::interval::Interval;
/// let tenth = Interval::point(1.0) / Interval::point(10.0);
/// assert!(tenth.lower() < tenth.upper() && tenth.contains(0.1));
/// assert_eq!(Interval::point(0.25) + Interval::point(0.5), Interval::point(0.75));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    lower: f64,
    upper: f64,
}

/// Below this size an error-free transformation may itself underflow.
const SMALL: f64 = 1e-290;

impl Interval {
    /// The whole line: nothing is known.
    pub const WHOLE: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// From its ends.
    ///
    /// # Panics
    /// When they are out of order or not numbers.
    pub fn new(lower: f64, upper: f64) -> Self {
        assert!(lower <= upper, "an interval has its ends in order");
        Self { lower, upper }
    }

    /// A single float.
    ///
    /// # Panics
    /// When it is not finite.
    pub fn point(value: f64) -> Self {
        assert!(value.is_finite(), "a point is finite");
        Self { lower: value, upper: value }
    }

    /// The tightest interval around a fraction.
    pub fn around(value: &Rational) -> Self {
        Self { lower: to_f64_below(value), upper: to_f64_above(value) }
    }

    /// The lower end.
    pub fn lower(self) -> f64 {
        self.lower
    }

    /// The upper end.
    pub fn upper(self) -> f64 {
        self.upper
    }

    /// Whether a float lies inside.
    pub fn contains(self, value: f64) -> bool {
        self.lower <= value && value <= self.upper
    }

    /// The middle as a fraction and half the width, exactly; `None` when an end is infinite.
    pub fn center_and_radius(self) -> Option<(Rational, Rational)> {
        let (lower, upper) = (from_f64(self.lower)?, from_f64(self.upper)?);
        let two = Rational::from_integer(2.into());
        Some(((&lower + &upper) / &two, (&upper - &lower) / &two))
    }

    /// The least and the largest modulus.
    fn moduli(self) -> (f64, f64) {
        let (a, b) = (self.lower.abs(), self.upper.abs());
        let (near, far) = if a <= b { (a, b) } else { (b, a) };
        (if self.contains(0.0) { 0.0 } else { near }, far)
    }

    /// `x²`: never negative.
    pub fn sqr(self) -> Self {
        let (near, far) = self.moduli();
        Self { lower: multiply(near, near).0.max(0.0), upper: multiply(far, far).1 }
    }

    /// `√x` of the part of the interval that is not negative; `None` when there is none.
    pub fn sqrt(self) -> Option<Self> {
        if self.upper < 0.0 {
            return None;
        }
        let root = |value: f64, up: bool| {
            let root = value.sqrt();
            if value < SMALL {
                let moved = if up { root.next_up() } else { root.next_down() };
                return if value == 0.0 { 0.0 } else { moved };
            }
            // root² − value, exactly: the product of two floats minus the nearest float.
            let excess = root.mul_add(root, -value);
            match (up, excess) {
                (true, excess) if excess < 0.0 => root.next_up(),
                (false, excess) if excess > 0.0 => root.next_down(),
                _ => root,
            }
        };
        Some(Self { lower: root(self.lower.max(0.0), false), upper: root(self.upper, true) })
    }

    /// `xⁿ`; `None` for a negative power of an interval that contains 0.
    pub fn pow(self, exponent: i32) -> Option<Self> {
        if exponent < 0 {
            let positive = self.pow(-exponent)?;
            return Self::point(1.0).divided_by(positive);
        }
        if exponent % 2 == 1 {
            // Odd powers are monotone.
            let (lower, upper) =
                (signed_power(self.lower, exponent), signed_power(self.upper, exponent));
            return Some(Self { lower: lower.lower, upper: upper.upper });
        }
        let (near, far) = self.moduli();
        Some(Self {
            lower: signed_power(near, exponent).lower.max(0.0),
            upper: signed_power(far, exponent).upper,
        })
    }

    /// `eˣ`.
    ///
    /// The library's exponential is not correctly rounded and is not used. With `x = k/2 + r`, `|r| ≤ 1/4`,
    /// the Taylor polynomial of degree 13 is summed in interval arithmetic; its remainder is at most
    /// `|r|¹⁴/14! · e^{1/4} < 2^−62`. The result is multiplied by an enclosure of `√e` to the power `k`.
    pub fn exp(self) -> Self {
        Self { lower: exp_of_point(self.lower).lower, upper: exp_of_point(self.upper).upper }
    }

    /// The quotient; `None` when the divisor contains 0.
    pub fn divided_by(self, other: Self) -> Option<Self> {
        if other.contains(0.0) {
            return None;
        }
        let ends = [
            divide(self.lower, other.lower),
            divide(self.lower, other.upper),
            divide(self.upper, other.lower),
            divide(self.upper, other.upper),
        ];
        Some(hull(&ends))
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { lower: add(self.lower, other.lower).0, upper: add(self.upper, other.upper).1 }
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        hull(&[
            multiply(self.lower, other.lower),
            multiply(self.lower, other.upper),
            multiply(self.upper, other.lower),
            multiply(self.upper, other.upper),
        ])
    }
}

impl Div for Interval {
    type Output = Self;
    /// The whole line when the divisor contains 0: nothing is known then.
    fn div(self, other: Self) -> Self {
        self.divided_by(other).unwrap_or(Self::WHOLE)
    }
}

fn hull(ends: &[(f64, f64)]) -> Interval {
    let lower = ends.iter().map(|end| end.0).fold(f64::INFINITY, f64::min);
    let upper = ends.iter().map(|end| end.1).fold(f64::NEG_INFINITY, f64::max);
    Interval { lower, upper }
}

/// The neighbours a rounded result lies between, given the sign of `true − rounded`; beyond the largest float lies infinity.
fn outwards(rounded: f64, error: f64) -> (f64, f64) {
    if error > 0.0 {
        (rounded, rounded.next_up())
    } else if error < 0.0 {
        (rounded.next_down(), rounded)
    } else {
        (rounded, rounded)
    }
}

/// Knuth's two-sum: exact unless it or a part of it overflows.
fn add(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    if sum.is_nan() {
        return (f64::NEG_INFINITY, f64::INFINITY);
    }
    let part = sum - a;
    let error = (a - (sum - part)) + (b - part);
    if error.is_finite() { outwards(sum, error) } else { (sum.next_down(), sum.next_up()) }
}

fn multiply(a: f64, b: f64) -> (f64, f64) {
    // 0 · ∞ is 0 here: an infinite end stands for unbounded, not for a number.
    if a == 0.0 || b == 0.0 {
        return (0.0, 0.0);
    }
    let product = a * b;
    if product.abs() < SMALL {
        return (product.next_down(), product.next_up());
    }
    outwards(product, a.mul_add(b, -product))
}

fn divide(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 {
        return (0.0, 0.0);
    }
    if b.is_infinite() {
        // a/b for every finite b at least this large is between 0 and the least float, or at another end if a is infinite too.
        return (-f64::from_bits(1), f64::from_bits(1));
    }
    let quotient = a / b;
    if quotient.abs() < SMALL || a.abs() < SMALL || quotient.is_infinite() {
        return (quotient.next_down(), quotient.next_up());
    }
    // true − quotient = (a − quotient·b)/b.
    let rest = (-quotient).mul_add(b, a);
    outwards(quotient, if b > 0.0 { rest } else { -rest })
}

/// `xⁿ` for one float by repeated squaring in interval arithmetic.
fn signed_power(value: f64, exponent: i32) -> Interval {
    let (mut base, mut left) = (Interval { lower: value, upper: value }, exponent);
    let mut power = Interval::point(1.0);
    while left > 0 {
        if left % 2 == 1 {
            power = power * base;
        }
        left /= 2;
        base = base * base;
    }
    power
}

fn exp_of_point(x: f64) -> Interval {
    if x > 710.0 {
        return Interval { lower: f64::MAX, upper: f64::INFINITY };
    }
    if x < -746.0 {
        return Interval { lower: 0.0, upper: f64::from_bits(1) };
    }
    if x == 0.0 {
        return Interval::point(1.0);
    }
    let halves = (2.0 * x).round();
    // Exact: both are multiples of the last place of x, and the difference is smaller than x.
    let rest = Interval::point(x - 0.5 * halves);
    let mut sum = Interval::point(0.0);
    for order in (1..=13).rev() {
        sum = rest * (Interval::point(1.0) + sum) / Interval::point(f64::from(order));
    }
    let remainder = Interval::new(-(2f64.powi(-62)), 2f64.powi(-62));
    let sum = Interval::point(1.0) + sum + remainder;
    // √e = 1.6487212707001281468…: the float below it and the next.
    let root = Interval::new(1.648_721_270_700_128, 1.648_721_270_700_128_2);
    let scale = root.pow(halves.abs() as i32).unwrap_or(Interval::WHOLE);
    let value = if halves < 0.0 { sum / scale } else { sum * scale };
    Interval { lower: value.lower.max(0.0), upper: value.upper }
}

#[cfg(test)]
mod tests;
