//! A limit, and the row that `limits` gives of one subject.

use super::{Offset, Phases, SubjectRecord, direction_of};
use crate::number::{finite, significant};
use courant_analysis::exact::rational::to_latex;
use courant_analysis::stability::{Evidence, Limit, StableSet};
use serde::Serialize;

/// A limit. A number that is not finite is `null`, and `reason` says why.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitRecord {
    /// The largest number known not to be above the limit.
    pub value: Option<f64>,
    /// The property holds from 0 up to here.
    pub lower: f64,
    /// The property is lost above here.
    pub upper: Option<f64>,
    /// A fraction or a root of one, as text.
    pub exact: Option<String>,
    /// The first digits, cut off, when more than a number of JSON holds were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decimal: Option<String>,
    /// The polynomial of which it is a root, when it has no closed form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equation: Option<EquationRecord>,
    /// `proved`, `enclosed`, `sampled`, `measured` or `undecided`.
    pub evidence: &'static str,
    /// How many phases a sampled limit looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phases: Option<usize>,
    /// The phase that binds, in radians; a list in two and three dimensions.
    pub critical_phase: Option<Phases>,
    /// The direction along which the wave that binds varies, a unit vector, in two and three dimensions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub critical_direction: Option<Vec<f64>>,
    /// `long-wave`, `interior` or `shortest-wave`.
    pub cause: Option<&'static str>,
    /// For monotonicity: the offset of the coefficient that turns negative.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub binding_offset: Option<Offset>,
    /// The condition on the multipliers that fails beyond.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub binding: Option<String>,
    /// Whether the property holds at the limit itself.
    pub included: bool,
    /// Whether no limit was met in the range looked at.
    pub unbounded: bool,
    /// Whether it is proved that there is none at all.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub without_end: bool,
    /// Why the value is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl LimitRecord {
    /// The record of a limit of what is called `symbol`, with its digits where they were asked for.
    pub fn new(limit: &Limit, symbol: &str, digits: Option<usize>) -> Self {
        let unlimited = limit.value().is_infinite();
        let undecided = limit.evidence() == Evidence::Undecided;
        Self {
            value: finite(limit.value()),
            // The decimal of the nearest number below may lie above the limit; the value's does not.
            lower: limit.lower().min(limit.value()) + 0.0,
            upper: finite(limit.upper()),
            exact: limit.closed_form(),
            decimal: digits.and_then(|digits| limit.decimal(digits)),
            equation: limit.equation().map(|root| EquationRecord {
                text: root.equation(symbol),
                polynomial: {
                    let polynomial = root.polynomial();
                    polynomial.coefficients().iter().map(ToString::to_string).collect()
                },
            }),
            evidence: limit.evidence().name(),
            phases: match limit.evidence() {
                Evidence::Sampled { phases } => Some(phases),
                _ => None,
            },
            critical_phase: limit.critical_wave().map(Phases::of),
            critical_direction: limit.critical_wave().and_then(direction_of),
            cause: limit.cause().map(|cause| cause.name()),
            binding_offset: limit.binding_offset().map(Offset::of),
            binding: limit.binding().map(|binding| binding.name()),
            included: limit.is_included() && !unlimited,
            unbounded: unlimited && !undecided,
            without_end: limit.is_unbounded(),
            reason: unlimited.then(|| {
                let lower = significant(limit.lower(), 6);
                match limit.evidence() {
                    Evidence::Undecided if limit.lower() > 0.0 => {
                        format!("undecided beyond {symbol} = {lower}")
                    }
                    Evidence::Undecided => "undecided".into(),
                    _ => format!("no limit up to {symbol} = {lower}"),
                }
            }),
        }
    }
}

/// A polynomial equation in the Courant number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EquationRecord {
    /// As one writes it.
    pub text: String,
    /// The integer coefficients of `1, C, C², …`.
    pub polynomial: Vec<String>,
}

/// One interval of values of a parameter; `to` is `null` where it goes on beyond the range.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IntervalRecord {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: Option<f64>,
    /// Why the end is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_note: Option<String>,
    /// Everything about where it begins.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub begin: Option<LimitRecord>,
    /// Everything about where it ends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<LimitRecord>,
}

impl IntervalRecord {
    /// From one number to another; without an end where the interval goes on beyond what was looked at.
    pub fn new(from: f64, to: f64, range_end: f64) -> Self {
        let note = format!("no end up to {}", significant(range_end, 6));
        // Adding zero turns −0 into 0.
        let to_note = to.is_infinite().then_some(note);
        Self { from: from + 0.0, to: finite(to), to_note, begin: None, end: None }
    }

    /// From 0 to a limit.
    pub fn up_to(limit: &Limit) -> Self {
        Self::new(0.0, limit.value(), limit.lower())
    }
}

/// A growth budget and the limit it allows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GrowthRecord {
    /// The permitted growth per step.
    pub growth: f64,
    /// The largest value up to which no multiplier exceeds `1 + growth`.
    pub value: Option<f64>,
    /// The enclosure.
    pub limit: LimitRecord,
}

/// A value of the parameter at which an implicit step cannot be solved.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SingularRecord {
    /// The value, rounded.
    pub value: f64,
    /// The value, where it is a fraction.
    pub exact: Option<String>,
    /// The phase of the wave, in radians; a list in two and three dimensions.
    pub phase: Option<Phases>,
    /// Why it is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
}

/// One row of `limits`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitsRow {
    /// What was judged.
    #[serde(flatten)]
    pub subject: SubjectRecord,
    /// No wave grows.
    pub stability: LimitRecord,
    /// All stable intervals in the range.
    pub stable_set: Vec<IntervalRecord>,
    /// Intervals that could not be decided.
    pub undecided: Vec<IntervalRecord>,
    /// The limit as `c Δt/Δ`, of a particle method.
    pub per_spacing: Option<f64>,
    /// The limit as `c Δt/σ` with the standard deviation σ of the kernel.
    pub per_standard_deviation: Option<f64>,
    /// The condition on the multipliers that fails beyond the limit.
    pub binding: Option<String>,
    /// Whether the limit itself is stable.
    pub limit_included: bool,
    /// The phase of a wave whose amplitude grows like the number of steps, where every wave has such a multiplier at every value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub double_multiplier_phase: Option<Phases>,
    /// All coefficients non-negative.
    pub monotonicity: Option<LimitRecord>,
    /// All intervals where they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monotone_set: Option<Vec<IntervalRecord>>,
    /// Why there is no monotone limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monotonicity_reason: Option<&'static str>,
    /// Where an implicit step cannot be solved.
    pub singular: Vec<SingularRecord>,
    /// Limits for the growth budgets asked for.
    pub growth_limits: Vec<GrowthRecord>,
    /// Whether what is the same everywhere and does not move stays so.
    pub keeps_constants: bool,
}

/// The intervals of a set; 0 alone where it is the limit.
pub fn intervals(set: &StableSet, symbol: &str) -> Vec<IntervalRecord> {
    let limit = set.limit();
    let zero = (limit.upper() == 0.0 && set.at_zero).then(|| IntervalRecord::new(0.0, 0.0, 0.0));
    let others = set.intervals.iter().map(|interval| IntervalRecord {
        begin: Some(LimitRecord::new(&interval.from, symbol, None)),
        end: Some(LimitRecord::new(&interval.to, symbol, None)),
        ..IntervalRecord::new(interval.from.upper(), interval.to.value(), interval.to.lower())
    });
    zero.into_iter().chain(others).collect()
}

/// What could not be decided.
pub fn undecided(set: &StableSet) -> Vec<IntervalRecord> {
    set.undecided.iter().map(|&(from, to)| IntervalRecord::new(from, to, from)).collect()
}

/// LaTeX of a limit's exact form, if it has one.
pub fn exact_latex(limit: &Limit) -> Option<String> {
    let fraction = limit.exact().and_then(|exact| exact.as_fraction()).map(to_latex);
    fraction.or_else(|| limit.exact().map(|exact| exact.to_latex()))
}
