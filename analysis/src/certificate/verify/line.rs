//! Proofs about functions of one phase.

use super::super::{End, Interval, LineProof};
use super::inequality::Checked;
use super::{CertificateError, Shown, ensure};
use num_traits::Zero;

/// What the covers and waves show about the interval.
pub(super) fn shown(proof: &LineProof, interval: &Interval) -> Result<Shown, CertificateError> {
    let inequalities = proof.inequalities.iter().map(Checked::new);
    let inequalities = inequalities.collect::<Result<Vec<_>, _>>()?;
    let inequality = |number: usize| {
        inequalities
            .get(number)
            .ok_or_else(|| CertificateError("there is no such inequality".into()))
    };
    let nothing = interval.lower.square().is_some_and(|square| square.is_zero());
    let count = if nothing { 0 } else { inequalities.len() };
    ensure(proof.covers.len() == count, "a cover for each inequality")?;
    let mut shown = Shown::default();
    for (inequality, cover) in inequalities.iter().zip(&proof.covers) {
        shown.covers.push(inequality.holds(cover)?);
        shown.boxes += cover.pieces.iter().map(|piece| piece.waves.len()).sum::<usize>();
    }
    if let Some(wave) = &proof.below {
        shown.below = Some(inequality(wave.inequality)?.grows(wave)?);
    }
    if let Some(claim) = &proof.above {
        let inequality = inequality(claim.wave.inequality)?;
        let t = match &interval.upper {
            Some(End::Fraction(value)) if inequality.stride == 1 => Some(value.clone()),
            Some(upper) if inequality.stride == 2 => upper.square(),
            _ => None,
        };
        let t = t.ok_or_else(|| CertificateError("t is no fraction".into()))?;
        shown.above = Some(inequality.grows(&claim.wave)?);
        inequality.turns_negative(&claim.s.0, &t, &claim.wave.value.0)?;
    }
    Ok(shown)
}
