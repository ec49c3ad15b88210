//! What `check` says of one value.

use super::{LimitRecord, Phases, SubjectRecord};
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
