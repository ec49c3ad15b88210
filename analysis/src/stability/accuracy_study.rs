//! What an answer costs and how wrong it is: sampled limits and proofs side by side.

use super::margin::Margin;
use super::{Limit, SearchPlan, phase_grid, refined_stability_limit, sampled_stability_limit};
use crate::exact::rational::{Rational, integer};
use crate::scheme::{SchemeError, Step};
use std::f64::consts::PI;
use std::time::Instant;

/// A way to a stability limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitMethod {
    /// This many equal steps of the phase from 0 to π.
    Sampled(usize),
    /// The same, then the worst phase refined in floating point.
    Refined(usize),
    /// The proof, to this many bits.
    Proved(u32),
}

impl LimitMethod {
    /// What the study compares: 8 to 65,536 phases, and proofs from a rough answer to the last bit.
    pub fn all() -> Vec<Self> {
        let counts = || (3..=16).map(|power| 1usize << power);
        let sampled = counts().map(Self::Sampled);
        let refined = counts().map(Self::Refined);
        sampled.chain(refined).chain([16, 24, 32, 40, 52].map(Self::Proved)).collect()
    }

    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sampled(_) => "sampled",
            Self::Refined(_) => "refined",
            Self::Proved(_) => "proved",
        }
    }

    /// The number of phases, or of bits.
    pub fn size(self) -> usize {
        match self {
            Self::Sampled(count) | Self::Refined(count) => count,
            Self::Proved(bits) => bits as usize,
        }
    }

    /// The limit, and the phases or boxes looked at.
    fn run(
        self,
        step: &Step,
        parameter: &str,
        max: &Rational,
    ) -> Result<(f64, usize), SchemeError> {
        let sampled = |count: usize, limit: fn(&Margin, &[f64], &Rational) -> Limit| {
            let margin = step.gain_margin(parameter, &integer(0))?;
            let phases = phase_grid(PI / count as f64);
            let value = margin.map_or(f64::NAN, |margin| limit(&margin, &phases, max).value());
            Ok((value, phases.len()))
        };
        match self {
            Self::Sampled(count) => sampled(count, sampled_stability_limit),
            Self::Refined(count) => sampled(count, refined_stability_limit),
            Self::Proved(bits) => {
                let plan = SearchPlan::default().up_to(max.clone()).to_bits(bits);
                let set = step.stable_set(parameter, &plan)?;
                Ok((set.limit().value(), set.work.boxes))
            }
        }
    }
}

/// One method on one scheme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AccuracyRow {
    /// How the limit was found.
    pub method: LimitMethod,
    /// What it gave.
    pub limit: f64,
    /// `|limit − true limit| / true limit`, the true one taken in the middle of its proved enclosure;
    /// errors below `2^−53` are not resolved.
    pub relative_error: f64,
    /// Phases looked at, or boxes that a proof decided.
    pub work: usize,
    /// The time it took, margin and all.
    pub seconds: f64,
}

/// Every method on one explicit scheme with a positive limit within `[0, max]`; no rows come back when there is no
/// such limit.
///
/// # Errors
/// When the parameter does not occur or another has no value.
pub fn accuracy_study(
    step: &Step,
    parameter: &str,
    max: &Rational,
) -> Result<Vec<AccuracyRow>, SchemeError> {
    let truth = step.stable_set(parameter, &SearchPlan::default().up_to(max.clone()))?.limit();
    if !truth.is_positive() || truth.upper().is_infinite() {
        return Ok(Vec::new());
    }
    let rows = LimitMethod::all().into_iter().map(|method| {
        let start = Instant::now();
        let (limit, work) = method.run(step, parameter, max)?;
        let seconds = start.elapsed().as_secs_f64();
        let relative_error = (limit - truth.value()).abs() / truth.value();
        Ok(AccuracyRow { method, limit, relative_error, work, seconds })
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::scheme::testing::sph;

    #[test]
    fn samples_err_upwards_and_proofs_within_their_bits() {
        for scheme in ["godunov-sph", "lax-wendroff-sph"] {
            let step = sph(scheme, Kernel::CubicSpline, &integer(3));
            let rows = accuracy_study(&step, "C", &integer(30)).unwrap();
            assert_eq!(rows.len(), LimitMethod::all().len());
            let truth = step.limit("C").unwrap().value();
            let mut sampled = Vec::new();
            for row in rows {
                match row.method {
                    LimitMethod::Sampled(count) => {
                        // More samples see more; none can be below the truth but by rounding.
                        assert!(row.limit >= truth * (1.0 - 1e-14), "{row:?}");
                        sampled.push((count, row.relative_error));
                    }
                    LimitMethod::Refined(count) => {
                        // A flat extremum is found to half the digits, its value to nearly all.
                        assert!(count < 64 || row.relative_error < 1e-9, "{row:?}");
                    }
                    LimitMethod::Proved(bits) => {
                        assert!(row.relative_error <= 0.5f64.powi(bits as i32 - 1), "{row:?}");
                    }
                }
            }
            // Second order in the phase step: from 64 to 1024 samples a factor 256, if not exact at once.
            let error = |wanted| sampled.iter().find(|(count, _)| *count == wanted).unwrap().1;
            assert!(error(1024) < error(64) / 60.0 + 1e-12);
        }
    }
}
