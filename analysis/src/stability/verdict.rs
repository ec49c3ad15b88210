//! The verdict on one value of the parameter.

use super::at_value::DemandsAt;
use super::decision::LEAST_BUDGET;
use super::multiplicity::multiplicity_among;
use super::{Demands, Evidence, Limit, PointVerdict, SearchPlan, StableSet, Wave};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, from_f64, integer};
use crate::scheme::{SchemeError, Step};
use crate::waves::Growth;
use crate::waves::step_growth::growth_under;
use num_bigint::BigInt;
use num_traits::{Signed, Zero};

/// Growth per step up to which an instability is called weak: doubling takes more than 6900 steps.
pub const WEAK_GROWTH: f64 = 1e-4;

/// What becomes of the waves at one value of the parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// No wave grows, and the value may be changed a little without any wave growing: proved.
    Stable,
    /// No wave grows exponentially, but the value lies on an end of the stable set (or closer to it than an `f64` tells), or a
    /// wave grows like a power of the number of steps.
    Marginal,
    /// A wave grows, by at most [`WEAK_GROWTH`] per step: that it grows is proved.
    WeaklyUnstable,
    /// A wave grows: proved.
    Unstable,
    /// The enclosures of the data, or the work that was allowed, leave it open.
    Undecided,
}

impl Verdict {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Marginal => "marginal",
            Self::WeaklyUnstable => "weakly-unstable",
            Self::Unstable => "unstable",
            Self::Undecided => "undecided",
        }
    }

    /// Whether it is known that no wave grows exponentially.
    pub fn is_stable(self) -> bool {
        matches!(self, Self::Stable | Self::Marginal)
    }
}

/// All that is known about one value of the parameter.
#[derive(Debug, Clone)]
pub struct Check {
    /// The verdict, decided exactly.
    pub verdict: Verdict,
    /// Whether every coefficient is non-negative, decided exactly; `None` when the question is not for this scheme, or is left open by
    /// the enclosures of the data.
    pub monotone: Option<bool>,
    /// The wave that grows most, or is damped least when none grows: measured.
    pub growth: Growth,
    /// Steps until the amplitude of a growing wave has doubled; `None` when none is known to grow.
    pub steps_to_double: Option<f64>,
    /// A wave whose amplitude grows like a power of the number of steps: a multiple multiplier on the unit circle with too
    /// few eigenvectors.
    pub double_multiplier: Option<Wave>,
    /// A shorter wave than the longest that drifts: the multiplier 1 is multiple with too few eigenvectors, nothing pulls
    /// a displacement back.
    pub drift: Option<Wave>,
    /// All stable values.
    pub stable_set: StableSet,
    /// All monotone values; `None` when the question is not for this scheme.
    pub monotone_set: Option<StableSet>,
}

impl Check {
    /// The wave that grows, or that binds the limit when none grows.
    pub fn critical_wave(&self) -> Option<Wave> {
        if self.verdict.is_stable() {
            self.stable_set.limit().critical_wave().cloned()
        } else {
            Some(self.growth.wave.clone())
        }
    }
}

/// Judges a value of a parameter that is not negative; all others must be set. The stable set is searched up to the end of the plan or four times the
/// value, whichever is more; a growth that the plan permits is not considered.
///
/// ```
/// use courant_analysis::{exact::rational::parse, scheme::Step, stability::SearchPlan};
/// use courant_analysis::stability::verdict::{Verdict, check};
/// let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?;
/// let at = |value: &str| check(&leapfrog, "C", &parse(value).unwrap(), &SearchPlan::default());
/// assert_eq!(at("0.9")?.verdict, Verdict::Stable);
/// // At the limit u_j^n = n i^{−n−j} is a solution.
/// let limit = at("1")?;
/// let double = limit.double_multiplier.unwrap();
/// assert_eq!((limit.verdict, double.phase()), (Verdict::Marginal, Some(std::f64::consts::FRAC_PI_2)));
/// assert_eq!(at("1.00000000000000000001")?.verdict, Verdict::WeaklyUnstable);
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
///
/// # Errors
/// When the parameter does not occur, another has no value, the step cannot be solved for any wave at the value, or the plan's interest is lost.
pub fn check(
    step: &Step,
    parameter: &str,
    value: &Rational,
    plan: &SearchPlan,
) -> Result<Check, SchemeError> {
    let at_value = step.with(parameter, value)?;
    step.refuse_singular(parameter, value)?;
    let range = plan.max.clone().max(value * integer(4));
    let plan = plan.clone().up_to(range).growing(Rational::zero());
    let asked = step.inequalities_while(parameter, &plan)?;
    let stable_set = step.stable_set_under(parameter, &asked, &plan)?;
    let monotone_set = step.monotone_set(parameter, &plan)?;
    let at_value = at_value.expanded();
    // Powers of the parameter were divided out: they say nothing about 0.
    let of_parameter = if value.is_zero() { None } else { DemandsAt::of_parameter(&asked, value) };
    // Strict demands on a continuous function of the parameter are met nearby as well.
    let strict = of_parameter.as_ref().is_some_and(DemandsAt::are_strict);
    let demands = match of_parameter {
        Some(demands) => demands,
        None => DemandsAt::new(&at_value.inequalities_in(None, &plan.growth, &plan.interest)?),
    };
    let decided = if plan.budget < LEAST_BUDGET && !stable_set.undecided.is_empty() {
        // No boxes would be needed, but whoever allows so few wants little work, and no more said of a value than of the set.
        PointVerdict::Undecided
    } else {
        demands.decide_while(&plan.interest)
    };
    plan.goes_on()?;
    let growth = growth_under(&at_value, &demands, &decided)?;
    let multiplicity = match decided {
        PointVerdict::Stable => multiplicity_among(&at_value, stable_set.limit().critical_wave())?,
        _ => Default::default(),
    };
    let verdict = match decided {
        PointVerdict::Undecided => Verdict::Undecided,
        PointVerdict::Unstable(_) if growth.per_step <= WEAK_GROWTH => Verdict::WeaklyUnstable,
        PointVerdict::Unstable(_) => Verdict::Unstable,
        PointVerdict::Stable => {
            let near = || match &asked {
                Demands::OnTorus(demands) => demands.are_met_about(value, &plan),
                _ => strict,
            };
            match multiplicity.growing.is_none() && is_inside(&stable_set, value, near) {
                true => Verdict::Stable,
                false => Verdict::Marginal,
            }
        }
    };
    plan.goes_on()?;
    let grows = matches!(verdict, Verdict::WeaklyUnstable | Verdict::Unstable);
    Ok(Check {
        verdict,
        monotone: is_monotone(step, parameter, value),
        steps_to_double: growth.steps_to_double().filter(|_| grows),
        growth,
        double_multiplier: multiplicity.growing.map(|found| found.wave),
        drift: multiplicity.drift.map(|found| found.wave),
        stable_set,
        monotone_set,
    })
}

/// Whether values a little to either side are stable too, where the value itself is; `near` asks what is known of it alone.
fn is_inside(set: &StableSet, value: &Rational, near: impl Fn() -> bool) -> bool {
    if value.is_zero() {
        // There are no values below.
        return set.limit().is_positive();
    }
    let mut ends = set.intervals.iter().flat_map(|interval| [&interval.from, &interval.to]);
    !ends.any(|end| is_at(end, value)) && (set.contains(value) || near())
}

/// Whether a value is an end, or cannot be told from it by an `f64`.
fn is_at(end: &Limit, value: &Rational) -> bool {
    if let Some(exact) = end.exact().and_then(|exact| exact.as_fraction()) {
        return exact == value && value.is_positive();
    }
    let (Some(lower), Some(upper)) = (from_f64(end.lower()), from_f64(end.upper())) else {
        return false;
    };
    end.evidence() != Evidence::Undecided && lower <= *value && *value <= upper
}

/// Whether every coefficient is non-negative, as far as the uncertainty of the data allows to say.
fn is_monotone(step: &Step, parameter: &str, value: &Rational) -> Option<bool> {
    let mut all = Some(true);
    let is_negative = |bound: Polynomial<BigInt>| {
        bound.map(|value| Rational::from(value.clone())).evaluate(value).is_negative()
    };
    for coefficient in &step.coefficients(parameter)? {
        if is_negative(coefficient.most()) {
            return Some(false);
        }
        if is_negative(coefficient.least()) {
            all = None;
        }
    }
    all
}

#[cfg(test)]
mod tests;
