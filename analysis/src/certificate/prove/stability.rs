//! Stable intervals: covers of all waves below the limit, a growing wave above it.

use super::super::{
    Certificate, CertifiedBox, CertifiedPiece, Exact, FactoredMargin, Proof, StabilityProof,
};
use super::limit_ends::{
    certified_limit, closed_form, ends, exactly, just_above, parameter, power,
};
use super::statement::certificate;
use super::{CertificationError, MAX_BOXES};
use crate::exact::bernstein::{MarginForm, SignedBox, exact_cover};
use crate::exact::rational::{Rational, integer};
use crate::scheme::symbol::EnclosedSymbol;
use crate::stability::margin::Margin;
use crate::stability::{Limit, StableInterval, stable_set};
use num_bigint::BigInt;
use num_traits::Zero;

/// Boxes a cover may have before its piece of `t` is halved, and how many pieces are looked at.
const BOXES_OF_A_PIECE: usize = 400;
const MAX_PIECES: usize = 400;

/// One certificate for each stable interval of `|g| ≤ 1 + growth` within `[0, max_courant]`, or the one
/// that says that no small Courant number is stable.
///
/// ```
/// use courant_analysis::certificate::{certify_stability, verify};
/// use courant_analysis::{kernel::Kernel, exact::rational::integer};
/// use courant_analysis::scheme::{AdvectionScheme, Discretisation, Scheme};
/// let scheme = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(2));
/// let scheme = scheme.unwrap();
/// let certificates =
///     certify_stability(&scheme.symbol(), Some(&scheme), &integer(0), &integer(10)).unwrap();
/// assert!(verify(&certificates[0]).unwrap().statement.contains("15/8"));
/// ```
///
/// # Errors
/// When the limit is not decided, or when the certificate would be too large.
pub fn certify_stability(
    symbol: &EnclosedSymbol,
    subject: Option<&crate::scheme::Discretisation>,
    growth: &Rational,
    max_courant: &Rational,
) -> Result<Vec<Certificate>, CertificationError> {
    let set = stable_set(symbol, growth, max_courant);
    if let Some((from, to)) = set.undecided.first() {
        return Err(CertificationError::Undecided(format!("{from} … {to}")));
    }
    let margin = Margin::new(symbol, growth);
    let prover = StabilityProver { form: MarginForm::new(&margin), margin: &margin };
    let from_zero = set.intervals.first().is_some_and(|first| first.from.upper() == 0.0);
    let mut proofs = Vec::new();
    if !from_zero {
        proofs.push(prover.no_limit(&set.limit(), max_courant)?);
    }
    for interval in &set.intervals {
        proofs.push(prover.interval(interval, max_courant)?);
    }
    Ok(proofs
        .into_iter()
        .map(|proof| certificate(symbol, subject, Proof::Stability(Box::new(proof))))
        .collect())
}

pub(super) struct StabilityProver<'a> {
    pub(super) margin: &'a Margin,
    pub(super) form: MarginForm,
}

impl StabilityProver<'_> {
    fn interval(
        &self,
        interval: &StableInterval,
        max_courant: &Rational,
    ) -> Result<StabilityProof, CertificationError> {
        let stride = self.margin.stride();
        let from = match closed_form(&interval.from, stride) {
            Some(exact) => parameter(exact, stride),
            // Inside the interval: its beginning is enclosed, not known.
            None => power(&exactly(just_above(&interval.from)), stride),
        };
        let (lower, upper) = ends(&interval.to, stride, max_courant);
        let pieces = self.pieces(&from, &lower)?;
        let unstable = match &upper {
            Some(upper) => Some(self.unstable(&interval.to, upper, max_courant)?),
            None => None,
        };
        Ok(StabilityProof {
            growth: self.margin.growth().clone().into(),
            margin: self.factored_margin(),
            below: self.below(&interval.from, &from)?,
            from: from.into(),
            limit: certified_limit(&interval.to, lower, upper),
            pieces,
            unstable,
        })
    }

    /// Covers of all waves over an interval of `t`, which is halved where boxes over all of it would never
    /// do: of a degree above one in `t` the Bernstein coefficients may stay negative however small `s` is.
    fn pieces(
        &self,
        from: &Rational,
        to: &Rational,
    ) -> Result<Vec<CertifiedPiece>, CertificationError> {
        let linear = self.margin.powers() <= 2;
        let (boxes, mut left) =
            if linear { (MAX_BOXES, 1) } else { (BOXES_OF_A_PIECE, MAX_PIECES) };
        let mut pieces = Vec::new();
        let mut pending = vec![(from.clone(), to.clone())];
        while let Some((from, to)) = pending.pop() {
            if left == 0 {
                return Err(CertificationError::TooLarge);
            }
            left -= 1;
            match exact_cover(&self.form, &from, &to, boxes) {
                Some(cover) => pieces.push(CertifiedPiece {
                    to: to.into(),
                    boxes: cover.into_iter().map(certified_box).collect(),
                }),
                None => {
                    let middle = (&from + &to) / integer(2);
                    pending.push((middle.clone(), to));
                    pending.push((from, middle));
                }
            }
        }
        Ok(pieces)
    }

    fn no_limit(
        &self,
        limit: &Limit,
        max_courant: &Rational,
    ) -> Result<StabilityProof, CertificationError> {
        let zero = Rational::zero();
        Ok(StabilityProof {
            growth: self.margin.growth().clone().into(),
            margin: self.factored_margin(),
            from: zero.clone().into(),
            below: None,
            limit: certified_limit(limit, zero.clone(), Some(zero.clone())),
            pieces: Vec::new(),
            unstable: Some(self.unstable(limit, &zero, max_courant)?),
        })
    }

    fn factored_margin(&self) -> FactoredMargin {
        let margin = self.margin;
        let mut coefficients: Vec<Vec<Exact>> = Vec::new();
        for series in margin.integer_series() {
            let powers = series.in_powers_of_s();
            coefficients
                .push((0..=margin.degree()).map(|i| powers.coefficient(i).into()).collect());
        }
        let mut radius: Vec<Exact> =
            margin.integer_radius().iter().cloned().map(Exact::from).collect();
        if coefficients.is_empty() {
            // |g| = 1 everywhere: the polynomial is zero.
            coefficients.push(vec![BigInt::zero().into()]);
            radius.push(BigInt::zero().into());
        }
        let neutral = margin.neutral_waves().coefficients();
        FactoredMargin {
            phase_power: margin.phase_power(),
            complement_power: margin.complement_power(),
            neutral_waves: neutral.iter().cloned().map(Exact).collect(),
            courant_power: margin.courant_power(),
            stride: margin.stride(),
            denominator: margin.denominator().clone().into(),
            coefficients,
            radius,
        }
    }
}

fn certified_box(signed: SignedBox) -> CertifiedBox {
    CertifiedBox { from: signed.from.into(), to: signed.to.into(), signs: signed.signs }
}
