//! What `probe` says of a step that was run.

use super::{IntervalRecord, LimitRecord, Phases, intervals, undecided};
use crate::number::finite;
use courant_analysis::exact::rational::{Rational, to_f64, to_text};
use courant_analysis::scheme::measurement::{Base, Probe, Probed, StencilTerm};
use courant_analysis::stability::{Evidence, Judgement, StableSet};
use serde::Serialize;
use std::collections::BTreeMap;

/// The answer of `probe`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProbeRecord {
    /// Whether the program ran and is a scheme.
    pub measured: bool,
    /// Why not.
    pub reason: Option<String>,
    /// What was run.
    pub command: Vec<String>,
    /// The names of the unknowns.
    pub unknowns: Vec<String>,
    /// Time levels that a step starts from.
    pub levels: usize,
    /// Cells along each axis.
    pub size: Vec<usize>,
    /// How many axes.
    pub dimension: usize,
    /// Whether derivatives about a state were measured.
    pub linearised: bool,
    /// How far a measured number may be wrong, as a share of the largest.
    pub tolerance: f64,
    /// The parameter whose limit is sought.
    pub parameter: Option<String>,
    /// The values of the others.
    pub parameters: BTreeMap<String, String>,
    /// What was found.
    #[serde(flatten)]
    pub found: Option<FoundRecord>,
}

/// What is known of a step that was measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoundRecord {
    /// Whether all coefficients were recognised as fractions.
    pub recognised: bool,
    /// Growth per step that is not told from none.
    pub growth_tolerance: f64,
    /// What a step adds to zero.
    pub source: f64,
    /// Where it was run.
    pub fitted_at: Vec<String>,
    /// Values that confirm the fit, of the coefficient with the fewest.
    pub verifications: usize,
    /// Whether what is the same everywhere stays so.
    pub keeps_constants: bool,
    /// The step in the language of schemes.
    pub equations: Vec<String>,
    /// Its coefficients.
    pub coefficients: Vec<StencilRecord>,
    /// The stability limit.
    pub stability: Option<LimitRecord>,
    /// All stable intervals in the range.
    pub stable_set: Vec<IntervalRecord>,
    /// Intervals that could not be decided.
    pub undecided: Vec<IntervalRecord>,
    /// The monotonicity limit.
    pub monotonicity: Option<LimitRecord>,
    /// Verdicts on single values.
    pub rows: Vec<JudgementRecord>,
}

/// One coefficient of a measured step.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StencilRecord {
    /// The unknown that is computed.
    pub of: String,
    /// The unknown that is read.
    pub reads: String,
    /// From 0 for the newest of the levels that a step starts from, −1 for the one before.
    pub level: i64,
    /// Cells from the one to the other.
    pub offset: Vec<i64>,
    /// In powers of the parameter, exact.
    pub polynomial: Vec<String>,
    /// The same, rounded.
    pub values: Vec<f64>,
}

/// The verdict on one step.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JudgementRecord {
    /// The value of the parameter; null where none is sought.
    pub value: Option<f64>,
    /// The value, exact.
    pub exact: Option<String>,
    /// `stable`, `marginal`, `weakly-unstable`, `unstable` or `undecided`.
    pub verdict: &'static str,
    /// The largest `|z|` that was seen.
    pub max_gain: Option<f64>,
    /// The phase of its wave.
    pub critical_phase: Phases,
    /// `measured`.
    pub evidence: &'static str,
}

impl JudgementRecord {
    /// Of a step at a value of its parameter, or of the only one there is.
    pub fn new(value: Option<&Rational>, found: &Judgement) -> Self {
        Self {
            value: value.map(to_f64),
            exact: value.map(to_text),
            verdict: found.verdict.name(),
            max_gain: finite(found.largest),
            critical_phase: Phases::of(&found.wave),
            evidence: Evidence::Measured.name(),
        }
    }
}

impl ProbeRecord {
    /// Of what was found, or why nothing was; what was run and the values of other parameters are for the caller to say.
    pub fn new(probe: &Probe, answer: Result<&Probed, &str>) -> Self {
        let layout = &probe.experiment.layout;
        Self {
            measured: answer.is_ok(),
            reason: answer.err().map(String::from),
            command: Vec::new(),
            unknowns: probe.unknowns.clone(),
            levels: layout.levels,
            size: layout.size.clone(),
            dimension: layout.size.len(),
            linearised: probe.experiment.base != Base::Zero,
            tolerance: probe.experiment.tolerance,
            parameter: probe.sought.clone(),
            parameters: BTreeMap::new(),
            found: answer.ok().map(|answer| found(probe, answer)),
        }
    }
}

fn found(probe: &Probe, answer: &Probed) -> FoundRecord {
    let measured = &answer.measured;
    let symbol = measured.parameter.as_deref().unwrap_or_default();
    // The closed form of a limit of decimals says nothing.
    let closed = |record: LimitRecord| match measured.recognised {
        true => record,
        false => LimitRecord { exact: None, equation: None, ..record },
    };
    let of = |set: &StableSet| closed(LimitRecord::new(&set.limit(), symbol, None));
    let interval = |record: IntervalRecord| IntervalRecord {
        begin: record.begin.map(closed),
        end: record.end.map(closed),
        ..record
    };
    let stretches = answer.stable_set.iter().flat_map(|set| intervals(set, symbol));
    let names = measured.step.unknowns();
    let coefficient = |term: &StencilTerm| StencilRecord {
        of: names[term.place.row].clone(),
        reads: names[term.place.column].clone(),
        level: term.place.level as i64 + 1 - measured.levels as i64,
        offset: term.place.offset.clone(),
        polynomial: term.coefficient.coefficients().iter().map(to_text).collect(),
        values: term.coefficient.coefficients().iter().map(to_f64).collect(),
    };
    let judged = |(value, found): &(Option<Rational>, Judgement)| {
        JudgementRecord::new(value.as_ref(), found)
    };
    let sought = probe.sought.iter().flat_map(|_| &answer.values);
    FoundRecord {
        recognised: measured.recognised,
        growth_tolerance: to_f64(&measured.growth),
        source: answer.source,
        fitted_at: sought.map(to_text).collect(),
        verifications: measured.verifications,
        keeps_constants: measured.step.keeps_constants().unwrap_or(false),
        equations: measured.equations(),
        coefficients: measured.terms.iter().map(coefficient).collect(),
        stability: answer.stable_set.as_ref().map(of),
        stable_set: stretches.map(interval).collect(),
        undecided: answer.stable_set.as_ref().map_or_else(Vec::new, undecided),
        monotonicity: answer.monotone_set.as_ref().map(of),
        rows: answer.judgements.iter().map(judged).collect(),
    }
}
