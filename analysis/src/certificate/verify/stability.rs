//! Stability below the limit, and a growing wave above it.

use super::super::{
    CertifiedBox, CertifiedSymbol, FactoredMargin, GrowingWave, StabilityProof, UnstableClaim,
};
use super::arithmetic::{bernstein, covers, sign};
use super::margin::{Decider, check_margin};
use super::{CertificateError, check_limit, ensure, nearness};
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

pub(super) fn check_stability(
    symbol: &CertifiedSymbol,
    proof: &StabilityProof,
) -> Result<usize, CertificateError> {
    let margin = &proof.margin;
    ensure(!proof.growth.0.is_negative(), "the permitted growth is negative")?;
    // With a single power of t either stride would do; one spelling is enough.
    let strides = if margin.coefficients.len() > 1 { 1..=2 } else { 1..=1 };
    ensure(strides.contains(&margin.stride), "the stride is 1 or 2")?;
    let decider = check_margin(symbol, &proof.growth.0, margin)?;
    check_limit(&proof.limit, margin.stride)?;

    let (from, lower) = (&proof.from.0, &proof.limit.lower.0);
    let mut boxes = 0;
    if lower.is_zero() {
        ensure(from.is_zero() && proof.pieces.is_empty(), "a limit of 0 leaves nothing to cover")?;
    } else {
        ensure(!from.is_negative(), "the stable interval begins below 0")?;
        let mut reached = from;
        for piece in &proof.pieces {
            ensure(*reached < piece.to.0, "the pieces of the interval do not follow each other")?;
            check_piece(&decider, reached, &piece.to.0, &piece.boxes)?;
            reached = &piece.to.0;
            boxes += piece.boxes.len();
        }
        ensure(reached == lower && from < lower, "the pieces do not reach the limit")?;
    }
    match &proof.below {
        None => ensure(from.is_zero(), "the interval begins above 0 without a reason")?,
        Some(wave) => {
            let below = wave.courant_number.0.pow(margin.stride as i32);
            ensure(
                below < *from && below >= from - from * nearness(18),
                "the first witness is not just below the interval",
            )?;
            check_growing(&decider, margin, wave)?;
        }
    }
    match (&proof.unstable, &proof.limit.upper) {
        (None, None) => Ok(boxes),
        (Some(claim), Some(upper)) => {
            check_unstable(&decider, margin, claim, &upper.0)?;
            Ok(boxes)
        }
        _ => Err(CertificateError("an upper end comes with a growing wave".into())),
    }
}

/// All signs above one piece of the interval of `t`.
fn check_piece(
    decider: &Decider,
    from: &Rational,
    to: &Rational,
    boxes: &[CertifiedBox],
) -> Result<(), CertificateError> {
    ensure(covers(boxes, &Rational::zero(), &Rational::one()), "the boxes do not cover all waves")?;
    let lowered = decider.shifted(-1);
    for each in boxes {
        let rows: Vec<_> =
            lowered.iter().map(|row| bernstein(row, &each.from.0, &each.to.0)).collect();
        let columns: Vec<Vec<BigInt>> = (0..rows[0].len())
            .map(|i| {
                let column: Vec<_> = rows.iter().map(|row| row[i].clone()).collect();
                bernstein(&column, from, to)
            })
            .collect();
        let signs: Vec<String> = (0..rows.len())
            .map(|j| columns.iter().map(|column| sign(&column[j])).collect())
            .collect();
        ensure(
            each.signs == signs && !signs.iter().any(|row| row.contains('-')),
            "a box has other signs than stated",
        )?;
    }
    Ok(())
}

fn check_unstable(
    decider: &Decider,
    margin: &FactoredMargin,
    claim: &UnstableClaim,
    upper: &Rational,
) -> Result<(), CertificateError> {
    let beyond = claim.witness.courant_number.0.pow(margin.stride as i32);
    let scale = if upper.is_zero() { Rational::one() } else { upper.clone() };
    ensure(
        beyond > *upper && beyond <= upper + scale * nearness(18),
        "the witness is not just above the limit",
    )?;
    let s = &claim.s.0;
    // A polynomial that does not depend on s needs no choice.
    let last = Rational::from(BigInt::from(i32::from(decider.rows[0].len() > 1)));
    ensure(!s.is_negative() && *s <= last, "s is not in [0, 1]")?;
    let signs: Vec<_> = bernstein(&decider.raised_at(s), upper, &beyond);
    ensure(
        signs.iter().all(|value| !value.is_positive()) && signs.iter().any(Signed::is_negative),
        "the wave at s does not grow throughout",
    )?;
    check_growing(decider, margin, &claim.witness)
}

/// Whether the margin is negative at one point, whatever the true coefficients are within the radii.
fn check_growing(
    decider: &Decider,
    margin: &FactoredMargin,
    wave: &GrowingWave,
) -> Result<(), CertificateError> {
    let (s, courant_number) = (&wave.s.0, &wave.courant_number.0);
    let neutral: Rational =
        (0..).zip(&margin.neutral_waves).map(|(i, value)| &value.0 * s.pow(i)).sum();
    ensure(
        courant_number.is_positive()
            && s.is_positive()
            && *s <= Rational::one()
            && (margin.complement_power == 0 || !s.is_one())
            && !neutral.is_zero(),
        "the witness is not a wave that can grow",
    )?;
    let t = courant_number.pow(margin.stride as i32);
    let terms = (0..).zip(decider.raised_at(s));
    let value: Rational = terms.map(|(j, value)| t.pow(j) * Rational::from(value)).sum();
    ensure(value.is_negative(), "the witness does not grow")
}
