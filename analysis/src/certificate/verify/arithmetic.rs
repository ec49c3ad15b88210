//! The few operations on polynomials that checking takes.

use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

pub(super) fn product(left: &[Rational], right: &[Rational]) -> Vec<Rational> {
    let mut result = vec![Rational::zero(); (left.len() + right.len()).saturating_sub(1)];
    for (i, a) in left.iter().enumerate() {
        for (j, b) in right.iter().enumerate() {
            result[i + j] += a * b;
        }
    }
    result
}

/// Positive multiples of the Bernstein coefficients of `Σ_i a_i x^i` on `[from, to]`: substitute
/// `x = from + (to − from) u`, then `u^i = u^i (u + (1 − u))^{n−i}`.
pub(super) fn bernstein(values: &[BigInt], from: &Rational, to: &Rational) -> Vec<BigInt> {
    let common = from.denom().lcm(to.denom());
    let start = from.numer() * (&common / from.denom());
    let width = to.numer() * (&common / to.denom()) - &start;
    // Horner's rule with the polynomial start + width u, over powers of the common denominator.
    let mut substituted: Vec<BigInt> = Vec::with_capacity(values.len());
    let mut power = BigInt::one();
    for value in values.iter().rev() {
        substituted.push(BigInt::zero());
        for i in (0..substituted.len()).rev() {
            let below = if i > 0 { &substituted[i - 1] * &width } else { value * &power };
            substituted[i] = &substituted[i] * &start + below;
        }
        power *= &common;
    }
    let mut result: Vec<BigInt> = Vec::with_capacity(values.len());
    for value in substituted {
        // Multiply by (u + (1 − u)), then add the next term.
        result.push(BigInt::zero());
        for k in (1..result.len()).rev() {
            let below = result[k - 1].clone();
            result[k] += below;
        }
        *result.last_mut().expect("one was just pushed") += value;
    }
    result
}

/// The value at a point.
pub(super) fn value(polynomial: &[Rational], x: &Rational) -> Rational {
    polynomial.iter().rev().fold(Rational::zero(), |sum, value| sum * x + value)
}
