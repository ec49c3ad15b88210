//! The ends of an interval and the numbers just beyond them.

use super::super::{End, Interval};
use crate::exact::rational::{Rational, from_f64, integer};
use crate::stability::{Cause, ExactValue, Limit};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// How far beyond an end instability is shown, relative: powers of one half, the widest that works.
pub(super) const BEYOND: [i32; 6] = [20, 26, 32, 38, 44, 50];

/// From 0 to 0.
pub(super) fn zero() -> Interval {
    let zero = End::Fraction(Rational::zero());
    Interval { begin: zero.clone(), lower: zero.clone(), upper: Some(zero) }
}

/// The closed form of a limit.
pub(super) fn closed_form(limit: &Limit) -> Option<End> {
    Some(match limit.exact()? {
        ExactValue::Fraction(value) => End::Fraction(value.clone()),
        ExactValue::SquareRoot(square) => End::Root(square.clone()),
    })
}

/// Whether boxes may come as near to a limit as one likes, but not reach it: where a wave between the ends of the phase range binds, a
/// margin has a double zero at the limit. Only where the zero stands at the edge of boxes can they.
pub(super) fn touches(limit: &Limit) -> bool {
    limit.cause() == Some(Cause::Interior)
}

/// A number below the limit, near enough.
pub(super) fn just_below(limit: &Limit) -> Option<Rational> {
    let lower = if limit.exact().is_some() || limit.lower() == limit.upper() {
        limit.lower().next_down()
    } else {
        limit.lower()
    };
    from_f64(lower)
}

/// A number above the limit, near enough.
pub(super) fn just_above(limit: &Limit) -> Option<Rational> {
    let upper = if limit.exact().is_some() || limit.lower() == limit.upper() {
        limit.upper().next_up()
    } else {
        limit.upper()
    };
    from_f64(upper)
}

/// Numbers above a limit, from far to near.
pub(super) fn above(limit: &Rational, max: &Rational) -> impl Iterator<Item = Rational> {
    let scale = if limit.is_zero() { max.clone().min(integer(1)) } else { limit.clone() };
    let limit = limit.clone();
    BEYOND
        .into_iter()
        .map(move |bits| &limit + &scale * Rational::new(BigInt::one(), BigInt::one() << bits))
}
