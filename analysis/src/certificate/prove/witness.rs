//! Waves that grow: just above a limit, and just below the beginning of a stable interval.

use super::super::{GrowingWave, UnstableClaim};
use super::limit_ends::{ABOVE, above, closed_form, exactly, just_above, just_below, power};
use super::stability::StabilityProver;
use super::{CertificationError, MAX_BOXES};
use crate::exact::bernstein::{Sign, is_negative_between};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer};
use crate::stability::{ExactValue, Limit, phase_parameter};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

impl StabilityProver<'_> {
    /// A wave that is unstable from `upper` (in `t`) to a little above it.
    pub(super) fn unstable(
        &self,
        limit: &Limit,
        upper: &Rational,
        max_courant: &Rational,
    ) -> Result<UnstableClaim, CertificationError> {
        let stride = self.margin.stride();
        let courant_number = if upper.is_zero() {
            Rational::zero()
        } else {
            match closed_form(limit, stride).and_then(ExactValue::as_fraction) {
                Some(exact) => exact.clone(),
                None => exactly(just_above(limit)),
            }
        };
        for witness in above(&courant_number, max_courant) {
            let beyond = power(&witness, stride);
            if beyond <= *upper {
                continue;
            }
            let critical = limit.critical_phase().filter(|_| self.margin.degree() > 0);
            let mut candidates = vec![phase_parameter(critical.unwrap_or(0.0))];
            if let (Sign::SomewhereNegative { phase_parameter, .. }, _) =
                self.form.sign(&beyond, &beyond, MAX_BOXES)
            {
                candidates.push(phase_parameter);
            }
            for s in candidates {
                let values = self.form.at_phase_parameter(&s, 1);
                if is_negative_between(&values, upper, &beyond) != Some(true) {
                    continue;
                }
                if let Some(witness_s) = self.growing_wave(&s, &beyond) {
                    return Ok(UnstableClaim {
                        s: s.into(),
                        witness: GrowingWave {
                            s: witness_s.into(),
                            courant_number: witness.into(),
                        },
                    });
                }
            }
        }
        Err(CertificationError::NoWitness)
    }

    /// A wave that grows just below the beginning of a stable interval.
    pub(super) fn below(
        &self,
        begin: &Limit,
        from: &Rational,
    ) -> Result<Option<GrowingWave>, CertificationError> {
        if from.is_zero() {
            return Ok(None);
        }
        let courant_number = exactly(just_below(begin));
        for bits in ABOVE {
            let witness = &courant_number
                - &courant_number * Rational::new(BigInt::one(), BigInt::one() << bits);
            let t = power(&witness, self.margin.stride());
            let (Sign::SomewhereNegative { phase_parameter, .. }, _) =
                self.form.sign(&t, &t, MAX_BOXES)
            else {
                continue;
            };
            if let Some(s) = self.growing_wave(&phase_parameter, &t) {
                return Ok(Some(GrowingWave { s: s.into(), courant_number: witness.into() }));
            }
        }
        Err(CertificationError::NoWitness)
    }

    /// A wave near `s`, itself neither infinitely long nor neutral at every Courant number, whose margin
    /// is negative at `t`.
    fn growing_wave(&self, s: &Rational, t: &Rational) -> Option<Rational> {
        let steps = (4..400).step_by(2).flat_map(|bits| {
            let step = Rational::new(BigInt::one(), BigInt::one() << bits);
            [s + &step, s - step]
        });
        std::iter::once(s.clone()).chain(steps).find(|candidate| {
            let in_range = candidate.is_positive() && *candidate <= integer(1);
            let complement = self.margin.complement_power() == 0 || !candidate.is_one();
            in_range
                && complement
                && !self.margin.neutral_waves().evaluate(candidate).is_zero()
                && Polynomial::new(self.form.at_phase_parameter(candidate, 1))
                    .evaluate(t)
                    .is_negative()
        })
    }
}
