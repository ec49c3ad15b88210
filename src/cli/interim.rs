//! The verdict on one value: decided by the conditions, growth measured on a grid of waves.

use courant::analysis::exact::rational::{Rational, integer};
use courant::analysis::scheme::{SchemeError, Step};
use courant::analysis::stability::{PointVerdict, SearchPlan, StableSet, decide_step_at};
use num_traits::Zero;
use std::f64::consts::{LN_2, PI};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    Stable,
    Marginal,
    WeaklyUnstable,
    Unstable,
    Undecided,
}

impl Verdict {
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Marginal => "marginal",
            Self::WeaklyUnstable => "weakly-unstable",
            Self::Unstable => "unstable",
            Self::Undecided => "undecided",
        }
    }

    pub fn is_stable(self) -> bool {
        matches!(self, Self::Stable | Self::Marginal)
    }
}

pub struct Growth {
    pub per_step: f64,
    pub phase: f64,
}

pub struct Check {
    pub verdict: Verdict,
    pub monotone: Option<bool>,
    pub growth: Growth,
    pub steps_to_double: Option<f64>,
    pub double_multiplier: Option<f64>,
    pub drift: Option<f64>,
    pub stable_set: StableSet,
    pub monotone_set: Option<StableSet>,
}

impl Check {
    pub fn critical_phase(&self) -> Option<f64> {
        if self.verdict.is_stable() {
            self.stable_set.limit().critical_phase()
        } else {
            Some(self.growth.phase)
        }
    }
}

pub fn check(
    step: &Step,
    parameter: &str,
    value: &Rational,
    plan: &SearchPlan,
) -> Result<Check, SchemeError> {
    let plan = plan.clone().up_to(plan.max.clone().max(value * integer(4)));
    let stable_set = step.stable_set(parameter, &plan)?;
    let monotone_set = step.monotone_set(parameter, &plan)?;
    let at_value = step.with(parameter, value)?;
    let compiled = at_value.compile()?;
    let gain = |phase: f64| {
        compiled.multipliers(&[], phase).iter().map(|z| z.norm() - 1.0).fold(-1.0, f64::max)
    };
    let phases = (0..=4096).map(|index| PI * f64::from(index) / 4096.0);
    let (most, phase) =
        phases.map(|phase| (gain(phase), phase)).fold((f64::NEG_INFINITY, 0.0), |best, next| {
            if next.0 > best.0 + 1e-13 { next } else { best }
        });
    let decided = match decide_step_at(&at_value, &Rational::zero())? {
        _ if plan.budget == 1 => PointVerdict::Undecided,
        decided => decided,
    };
    let limit = stable_set.limit();
    let verdict = match decided {
        PointVerdict::Undecided => Verdict::Undecided,
        PointVerdict::Unstable(_) if most <= 1e-4 => Verdict::WeaklyUnstable,
        PointVerdict::Unstable(_) => Verdict::Unstable,
        PointVerdict::Stable
            if limit.exact().and_then(|exact| exact.as_fraction()) == Some(value)
                || !stable_set.contains(value) =>
        {
            Verdict::Marginal
        }
        PointVerdict::Stable => Verdict::Stable,
    };
    let grows = matches!(verdict, Verdict::WeaklyUnstable | Verdict::Unstable) && most > 0.0;
    Ok(Check {
        verdict,
        monotone: monotone_set.as_ref().map(|set| set.contains(value)),
        growth: Growth { per_step: if grows { most } else { most.min(0.0) }, phase },
        steps_to_double: grows.then(|| LN_2 / most.ln_1p()),
        double_multiplier: None,
        drift: None,
        stable_set,
        monotone_set,
    })
}
