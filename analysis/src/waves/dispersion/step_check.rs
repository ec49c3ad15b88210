//! The verdict on one time step.

use super::growth::{Growth, worst_growth};
use super::stable_step::{NoSchemeRuns, StableStep, StepEnd, stable_step};
use super::wave_scheme::WaveScheme;
use crate::exact::rational::{Rational, from_f64, integer, to_f64};
use crate::scheme::integrator::Integrator;
use crate::stability::verdict::Verdict;
use crate::stability::{ExactValue, Limit};

/// All that is known about one step `c Δt/h`.
#[derive(Debug, Clone)]
pub struct StepCheck {
    /// The verdict. Below the limit it is decided by the proof of the limit; above it by the wave that
    /// grows.
    pub verdict: Verdict,
    /// The fastest growth.
    pub growth: Growth,
    /// The largest stable step.
    pub stable: StableStep,
}

impl StepCheck {
    /// The phase of the wave that grows, or that binds the limit when none grows, in radians.
    pub fn critical_phase(&self) -> Option<f64> {
        if self.verdict.is_stable() {
            self.stable.limit().critical_phase()
        } else {
            Some(self.growth.phase)
        }
    }
}

/// Judges a step `c Δt/h > 0`; the limit is searched up to `max_step` or four times the step, whichever
/// is more.
///
/// A step at the limit is marginal. For a scheme that conserves the phase area a double multiplier then
/// grows linearly, and [`StepEnd::DoubleMultiplier`] says so.
///
/// ```
/// use courant_analysis::waves::dispersion::{WaveMethod, WaveScheme, check_step};
/// use courant_analysis::exact::rational::{integer, ratio};
/// use courant_analysis::{scheme::integrator::Integrator, kernel::Kernel, stability::verdict::Verdict};
/// let scheme = WaveScheme::new(WaveMethod::Sph, Kernel::CubicSpline, &integer(1)).unwrap();
/// let verdict = |step| check_step(&scheme, Integrator::Rk4, &step, &integer(4)).unwrap().verdict;
/// assert_eq!(verdict(ratio(9, 10)), Verdict::Stable);
/// assert_eq!(verdict(integer(1)), Verdict::Marginal);
/// assert_eq!(verdict(ratio(11, 10)), Verdict::Unstable);
/// ```
///
/// # Errors
/// For the published form of Godunov particle hydrodynamics.
pub fn check_step(
    scheme: &WaveScheme,
    integrator: Integrator,
    step: &Rational,
    max_step: &Rational,
) -> Result<StepCheck, NoSchemeRuns> {
    let range = max_step.clone().max(step * integer(4));
    let stable = stable_step(scheme, integrator, &range)?;
    let growth = worst_growth(&scheme.compile(), integrator, to_f64(step));
    let verdict = match place(step, stable.limit()) {
        Place::Below => Verdict::Stable,
        Place::At => Verdict::Marginal,
        // Above the first limit a step may be stable again, or grow too slowly to be seen.
        Place::Above => match (growth.verdict(), stable.end()) {
            (Verdict::Stable, StepEnd::DoubleMultiplier) => Verdict::Marginal,
            (verdict, _) => verdict,
        },
    };
    Ok(StepCheck { verdict, growth, stable })
}

/// Where a step lies.
enum Place {
    Below,
    At,
    Above,
}

fn place(step: &Rational, limit: &Limit) -> Place {
    let compared = match limit.exact() {
        Some(ExactValue::Fraction(exact)) => step.cmp(exact),
        Some(ExactValue::SquareRoot(square)) => (step * step).cmp(square),
        None => {
            let (lower, upper) = (from_f64(limit.lower()), from_f64(limit.upper()));
            match (lower, upper) {
                (Some(lower), _) if *step < lower => std::cmp::Ordering::Less,
                (_, Some(upper)) if *step > upper => std::cmp::Ordering::Greater,
                // No limit was met in the whole range.
                (_, None) => std::cmp::Ordering::Less,
                _ => std::cmp::Ordering::Equal,
            }
        }
    };
    match compared {
        std::cmp::Ordering::Less => Place::Below,
        std::cmp::Ordering::Equal => Place::At,
        std::cmp::Ordering::Greater => Place::Above,
    }
}
