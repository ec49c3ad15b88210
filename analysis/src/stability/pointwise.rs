//! Stability at one Courant number by Sturm's theorem: the other road to the same answer.
//!
//! At a given `C` the margin is a polynomial in `s` alone. Its roots in `(0, 1]` are isolated by Sturm's
//! chain, and its sign between them is looked at: a touching root changes nothing.

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer};
use crate::exact::real_roots::real_roots;
use crate::stability::margin::Margin;
use num_traits::{Signed, Zero};

/// Stable or not at one Courant number; a wave that grows is named by its `s = (1 − cos φ)/2`, or as a [`Wave`](super::Wave).
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PointVerdict<W = Rational> {
    /// No wave grows: proved.
    Stable,
    /// This wave grows: proved.
    Unstable(W),
    /// The enclosures of the coefficients leave it open.
    Undecided,
}

/// Decides `|g| ≤ 1 + growth` for all waves at one Courant number.
///
/// ```
/// use courant_analysis::exact::rational::{integer, ratio};
/// use courant_analysis::scheme::Step;
/// use courant_analysis::stability::{PointVerdict, decide_at};
/// let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
/// let margin = upwind.gain_margin("C", &integer(0))?.unwrap();
/// assert_eq!(decide_at(&margin, &integer(1)), PointVerdict::Stable);
/// assert!(matches!(decide_at(&margin, &ratio(11, 10)), PointVerdict::Unstable(_)));
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
pub fn decide_at(margin: &Margin, courant_number: &Rational) -> PointVerdict {
    if courant_number.is_zero() && margin.courant_power() > 0 {
        return PointVerdict::Stable;
    }
    decide_at_parameter(margin, &courant_number.pow(margin.stride() as i32))
}

/// [`decide_at`] the Courant number `t^{1/stride}`, which need not be a fraction.
pub(super) fn decide_at_parameter(margin: &Margin, t: &Rational) -> PointVerdict {
    let (center, radius) = at_parameter(margin, t);
    let lowered = center.clone() - Polynomial::constant(radius.clone());
    match negative_point(&lowered) {
        None => PointVerdict::Stable,
        Some(_) => match negative_point(&(center + Polynomial::constant(radius))) {
            Some(s) => PointVerdict::Unstable(s),
            None => PointVerdict::Undecided,
        },
    }
}

/// A margin whose parameters all have values: the polynomial in `s` and how far it may be from the true one.
fn at_parameter(margin: &Margin, t: &Rational) -> (Polynomial<Rational>, Rational) {
    let radius = (0..)
        .zip(margin.integer_radius())
        .map(|(power, radius)| t.pow(power) * Rational::from(radius.clone()))
        .sum();
    let powers = margin.integer_series().iter().rev();
    let center = powers.fold(Polynomial::<Rational>::zero(), |sum, series| {
        sum.scale(t) + series.in_powers_of_s().map(|value| Rational::from(value.clone()))
    });
    (center, radius)
}

/// A point of `[0, 1]` where the polynomial is negative.
fn negative_point(polynomial: &Polynomial<Rational>) -> Option<Rational> {
    let (zero, one) = (integer(0), integer(1));
    let mut bits = 8;
    loop {
        let roots = real_roots(polynomial, &zero, &one, bits);
        let mut points = vec![zero.clone()];
        let mut before = zero.clone();
        for root in &roots {
            points.push((&before + &root.lower) / integer(2));
            before = root.upper.clone();
        }
        points.push((&before + &one) / integer(2));
        points.push(one.clone());
        if let Some(found) = points.iter().find(|point| polynomial.evaluate(point).is_negative()) {
            return Some(found.clone());
        }
        // Between two roots the sign is known once a point between them is no root itself; the first one is away from 0, whose enclosure
        // is narrow next to its size.
        if roots.windows(2).all(|pair| pair[0].upper < pair[1].lower) {
            return None;
        }
        assert!(bits <= 1 << 20, "distinct roots of a polynomial come apart");
        bits *= 2;
    }
}

#[cfg(test)]
mod tests;
