//! What `check` says of one value.

use super::{LimitRecord, Phases, SubjectRecord};
use crate::number::finite;
use crate::subject::{Sought, Subject};
use courant_analysis::exact::rational::{Rational, to_f64};
use courant_analysis::stability::Limit;
use courant_analysis::stability::verdict::Check;
use serde::Serialize;

/// The answer of `check`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckRecord {
    /// What was judged.
    #[serde(flatten)]
    pub subject: SubjectRecord,
    /// The value of the parameter, rounded.
    pub cfl: f64,
    /// `stable`, `marginal`, `weakly-unstable`, `unstable` or `undecided`.
    pub verdict: &'static str,
    /// Whether all coefficients are non-negative; nothing where that is not asked or not decided.
    pub monotone: Option<bool>,
    /// The largest `|z|` over all waves.
    pub max_gain: Option<f64>,
    /// The phase of the wave that grows, or of the one that binds the limit, in radians.
    pub critical_phase: Option<Phases>,
    /// `max |z| − 1`.
    pub growth_per_step: Option<f64>,
    /// `refined` where no wave is missed, `sampled` in two and three dimensions.
    pub growth_evidence: &'static str,
    /// `all` where the waves with multiple multipliers were isolated, `some` where only phases that are multiples of π/2 and the binding
    /// wave were looked at: in two and three dimensions.
    pub multiple_multipliers: &'static str,
    /// Why it is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub growth_reason: Option<&'static str>,
    /// Steps until the fastest wave has doubled.
    pub steps_to_double: Option<f64>,
    /// Whether the growth is within what was accepted: `yes`, `no` or `undecided`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within_growth: Option<&'static str>,
    /// The phase of a wave whose amplitude grows like a power of the number of steps.
    pub double_multiplier_phase: Option<Phases>,
    /// The phase of a wave that nothing pulls back.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift_phase: Option<Phases>,
    /// The stability limit.
    pub stability: LimitRecord,
    /// The monotonicity limit.
    pub monotonicity: Option<LimitRecord>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monotonicity_reason: Option<&'static str>,
}

impl CheckRecord {
    /// Of what was found of a subject at one value of the parameter in question; `within` says whether the growth is within what is
    /// accepted, where that was asked, and nothing where it is not decided.
    pub fn new(
        subject: &Subject,
        sought: &Sought,
        value: &Rational,
        found: &Check,
        within: Option<Option<bool>>,
    ) -> Self {
        let symbol = subject.symbol(&sought.parameter);
        let limit = |limit: &Limit| LimitRecord::new(limit, &symbol, None);
        let monotonicity = found.monotone_set.as_ref().map(|set| limit(&set.limit()));
        Self {
            subject: subject.record(&sought.step, Some(&sought.parameter)),
            cfl: to_f64(value),
            verdict: found.verdict.name(),
            monotone: found.monotone,
            max_gain: finite(1.0 + found.growth.per_step),
            critical_phase: found.critical_wave().as_ref().map(Phases::of),
            growth_per_step: finite(found.growth.per_step),
            growth_evidence: if found.growth.sampled { "sampled" } else { "refined" },
            multiple_multipliers: if found.growth.sampled { "some" } else { "all" },
            growth_reason: (!found.growth.per_step.is_finite())
                .then_some("one step makes this wave larger than any number"),
            steps_to_double: found.steps_to_double,
            within_growth: within.map(|within| match within {
                Some(true) => "yes",
                Some(false) => "no",
                None => "undecided",
            }),
            double_multiplier_phase: found.double_multiplier.as_ref().map(Phases::of),
            drift_phase: found.drift.as_ref().map(Phases::of),
            stability: limit(&found.stable_set.limit()),
            monotonicity_reason: monotonicity.is_none().then(|| subject.without_monotonicity()),
            monotonicity,
        }
    }
}
