//! No negative coefficient below the limit, and one above it.

use super::super::{CertifiedSymbol, MonotonicityProof};
use super::arithmetic::{bernstein, covers, sign, whole_numbers};
use super::{CertificateError, check_limit, coefficient, ensure, nearness};
use crate::exact::rational::{Rational, integer};
use num_traits::{One, Signed, Zero};

pub(super) fn check_monotonicity(
    symbol: &CertifiedSymbol,
    proof: &MonotonicityProof,
) -> Result<usize, CertificateError> {
    check_limit(&proof.limit, 1)?;
    let row = |offset: i64, direction: i64| -> Vec<Rational> {
        let stencils = symbol.stencils.iter();
        stencils
            .map(|stencil| {
                coefficient(&stencil.coefficients, stencil.lowest, offset)
                    + coefficient(&stencil.radius, stencil.lowest, offset) * integer(direction)
            })
            .collect()
    };
    let lower = &proof.limit.lower.0;
    let mut boxes = 0;
    if lower.is_zero() {
        ensure(proof.coefficients.is_empty(), "a limit of 0 leaves nothing to cover")?;
    } else {
        let vanishes = |offset: i64| {
            let both = [row(offset, -1), row(offset, 1)];
            both.iter().flatten().all(Zero::is_zero)
        };
        let mut offsets: Vec<i64> = (-2000..=2000).filter(|&offset| !vanishes(offset)).collect();
        for each in &proof.coefficients {
            let known = offsets.iter().position(|offset| *offset == each.offset);
            ensure(known.is_some(), "an offset occurs twice or has no coefficient")?;
            offsets.retain(|offset| *offset != each.offset);
            ensure(
                covers(&each.boxes, &Rational::zero(), lower),
                "the boxes of a coefficient do not cover the interval",
            )?;
            let lowered = whole_numbers(&row(each.offset, -1));
            for part in &each.boxes {
                let signs: String =
                    bernstein(&lowered, &part.from.0, &part.to.0).iter().map(sign).collect();
                ensure(
                    part.signs == [signs.as_str()] && !signs.contains('-'),
                    "a coefficient has other signs than stated",
                )?;
                boxes += 1;
            }
        }
        ensure(offsets.is_empty(), "a coefficient is missing")?;
    }
    match (&proof.binding, &proof.limit.upper) {
        (None, None) => Ok(boxes),
        (Some(binding), Some(upper)) => {
            let scale = if upper.0.is_zero() { Rational::one() } else { upper.0.clone() };
            ensure(
                binding.to.0 > upper.0 && binding.to.0 <= &upper.0 + scale * nearness(18),
                "the binding coefficient is not looked at just above the limit",
            )?;
            let turns_negative = |offset: i64| {
                let raised = whole_numbers(&row(offset, 1));
                let values = bernstein(&raised, &upper.0, &binding.to.0);
                values.iter().all(|value| !value.is_positive())
                    && values.iter().any(Signed::is_negative)
            };
            ensure(binding.offset.abs() <= 2000, "the binding coefficient is out of reach")?;
            ensure(
                (-2000..=binding.offset).find(|&offset| turns_negative(offset))
                    == Some(binding.offset),
                "the binding coefficient is not the first that turns negative above the limit",
            )?;
            Ok(boxes)
        }
        _ => Err(CertificateError("an upper end comes with a binding coefficient".into())),
    }
}
