//! The ends of a limit in `t = C^stride`, and the numbers just beyond them.

use super::super::{CertifiedLimit, Exact};
use crate::exact::rational::{Rational, from_f64, integer, to_text};
use crate::stability::{Cause, ExactValue, Limit};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// How far above the limit instability is shown, relative: powers of one half, the widest that works.
pub(super) const ABOVE: [i32; 6] = [20, 26, 32, 38, 44, 50];

/// The ends of a limit in `t = C^stride`: equal when it is exact.
pub(super) fn ends(
    limit: &Limit,
    stride: usize,
    max_courant: &Rational,
) -> (Rational, Option<Rational>) {
    if limit.upper().is_infinite() {
        return (power(max_courant, stride), None);
    }
    match closed_form(limit, stride) {
        Some(exact) => (parameter(exact, stride), Some(parameter(exact, stride))),
        None => {
            let end = |value: f64| power(&exactly(value), stride);
            (end(just_below(limit)), Some(end(just_above(limit))))
        }
    }
}

/// The closed form of a limit that boxes can reach. Where a wave between the ends of the phase range binds, the margin has a double
/// zero at the limit, and boxes come as near as one likes, but not there; and a square root is no fraction where `t` is `C`.
pub(super) fn closed_form(limit: &Limit, stride: usize) -> Option<&ExactValue> {
    let is_a_fraction = |exact: &&ExactValue| stride == 2 || exact.as_fraction().is_some();
    limit.exact().filter(|_| limit.cause() != Some(Cause::Interior)).filter(is_a_fraction)
}

/// A number below the limit, the lower end of its enclosure.
pub(super) fn just_below(limit: &Limit) -> f64 {
    if limit.exact().is_some() { limit.lower().next_down() } else { limit.lower() }
}

/// A number above the limit, the upper end of its enclosure.
pub(super) fn just_above(limit: &Limit) -> f64 {
    if limit.exact().is_some() { limit.upper().next_up() } else { limit.upper() }
}

pub(super) fn parameter(exact: &ExactValue, stride: usize) -> Rational {
    match exact {
        ExactValue::Fraction(value) => power(value, stride),
        // Square roots occur where only even powers of C do.
        ExactValue::SquareRoot(square) => square.clone(),
    }
}

pub(super) fn power(value: &Rational, stride: usize) -> Rational {
    value.pow(stride as i32)
}

pub(super) fn exactly(value: f64) -> Rational {
    from_f64(value).expect("an end that is not exact is finite")
}

/// Numbers above the limit, from far to near.
pub(super) fn above(limit: &Rational, max_courant: &Rational) -> impl Iterator<Item = Rational> {
    let scale = if limit.is_zero() { max_courant.clone().min(integer(1)) } else { limit.clone() };
    let limit = limit.clone();
    ABOVE
        .into_iter()
        .map(move |bits| &limit + &scale * Rational::new(BigInt::one(), BigInt::one() << bits))
}

pub(super) fn certified_limit(
    limit: &Limit,
    lower: Rational,
    upper: Option<Rational>,
) -> CertifiedLimit {
    let exact = upper.as_ref().is_some_and(|upper| *upper == lower);
    let courant_number = limit.exact().filter(|_| exact).map(|exact| match exact {
        ExactValue::Fraction(value) => to_text(value),
        ExactValue::SquareRoot(square) => format!("sqrt({})", to_text(square)),
    });
    CertifiedLimit { lower: lower.into(), upper: upper.map(Exact), courant_number }
}
