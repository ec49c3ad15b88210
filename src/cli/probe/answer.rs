//! What was found about the user's program.

use super::{Arguments, Plan};
use crate::cli::limit_text::{describe, direction, exact_below, has_gaps, set, wavelength};
use crate::cli::output::{Format, paragraphs, print, print_json, print_record, table_text};
use crate::cli::subject::shown;
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::analysis::scheme::measurement::{Base, MeasuredStep, StencilTerm};
use courant::analysis::stability::{Evidence, Judgement, StableSet};
use courant::reports::number::{finite, significant};
use courant::reports::record::{IntervalRecord, LimitRecord, Phases, intervals, undecided};
use courant::reports::table::{Align, Table};
use serde::Serialize;
use std::collections::BTreeMap;

/// The longest equation that is shown.
const LONGEST_EQUATION: usize = 600;

/// A program that is a scheme.
pub struct Answer {
    pub measured: MeasuredStep,
    /// Where the program was run.
    pub values: Vec<Rational>,
    /// The largest of what a step adds to zero.
    pub source: f64,
    pub stable_set: Option<StableSet>,
    pub monotone_set: Option<StableSet>,
    /// Of the only step there is, or of values of the parameter.
    pub judgements: Vec<(Option<Rational>, Judgement)>,
}

/// Why nothing is known of a program, or it is no scheme, in one line.
pub struct Refusal(pub String);

#[derive(Debug, Serialize)]
struct Record {
    /// Whether the program ran and is a scheme.
    measured: bool,
    reason: Option<String>,
    command: Vec<String>,
    unknowns: Vec<String>,
    levels: usize,
    size: Vec<usize>,
    dimension: usize,
    /// Whether derivatives about a state were measured.
    linearised: bool,
    tolerance: f64,
    parameter: Option<String>,
    parameters: BTreeMap<String, String>,
    #[serde(flatten)]
    found: Option<Found>,
}

#[derive(Debug, Serialize)]
struct Found {
    /// Whether all coefficients were recognised as fractions.
    recognised: bool,
    /// Growth per step that is not told from none.
    growth_tolerance: f64,
    /// What a step adds to zero.
    source: f64,
    fitted_at: Vec<String>,
    verifications: usize,
    keeps_constants: bool,
    equations: Vec<String>,
    coefficients: Vec<CoefficientRecord>,
    stability: Option<LimitRecord>,
    stable_set: Vec<IntervalRecord>,
    undecided: Vec<IntervalRecord>,
    monotonicity: Option<LimitRecord>,
    rows: Vec<JudgementRecord>,
}

#[derive(Debug, Serialize)]
struct CoefficientRecord {
    of: String,
    reads: String,
    /// From 0 for the newest of the levels that a step starts from, −1 for the one before.
    level: i64,
    offset: Vec<i64>,
    polynomial: Vec<String>,
    values: Vec<f64>,
}

#[derive(Debug, Serialize)]
struct JudgementRecord {
    /// The value of the parameter; null where none is sought.
    value: Option<f64>,
    exact: Option<String>,
    verdict: &'static str,
    max_gain: Option<f64>,
    critical_phase: Phases,
    evidence: &'static str,
}

fn record(arguments: &Arguments, plan: &Plan, answer: Result<&Answer, &Refusal>) -> Record {
    let set = plan.fixed.iter().map(|(name, value)| (name.clone(), to_text(value)));
    Record {
        measured: answer.is_ok(),
        reason: answer.err().map(|refusal| refusal.0.clone()),
        command: arguments.command.clone(),
        unknowns: arguments.unknowns.0.clone(),
        levels: plan.layout.levels,
        size: plan.layout.size.clone(),
        dimension: plan.layout.size.len(),
        linearised: plan.experiment.base != Base::Zero,
        tolerance: plan.experiment.tolerance,
        parameter: plan.sought.clone(),
        parameters: set.collect(),
        found: answer.ok().map(|answer| found(plan, answer)),
    }
}

fn found(plan: &Plan, answer: &Answer) -> Found {
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
    let coefficient = |term: &StencilTerm| CoefficientRecord {
        of: names[term.place.row].clone(),
        reads: names[term.place.column].clone(),
        level: term.place.level as i64 + 1 - measured.levels as i64,
        offset: term.place.offset.clone(),
        polynomial: term.coefficient.coefficients().iter().map(to_text).collect(),
        values: term.coefficient.coefficients().iter().map(to_f64).collect(),
    };
    let judged = |(value, found): &(Option<Rational>, Judgement)| JudgementRecord {
        value: value.as_ref().map(to_f64),
        exact: value.as_ref().map(to_text),
        verdict: found.verdict.name(),
        max_gain: finite(found.largest),
        critical_phase: Phases::of(&found.wave),
        evidence: Evidence::Measured.name(),
    };
    let sought = plan.sought.iter().flat_map(|_| &answer.values);
    Found {
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

/// The answer no, with its reason.
pub fn refuse(arguments: &Arguments, plan: &Plan, refusal: &Refusal) -> Result<Outcome, Failure> {
    match arguments.format {
        Format::Table => print(&format!("no: {}\n", refusal.0))?,
        format => {
            let mut table = Table::new("No", &[("reason", Align::Left)]);
            table.push([refusal.0.as_str()]);
            print_record("probe", &record(arguments, plan, Err(refusal)), &table, format)?
        }
    };
    Ok(Outcome::No)
}

pub fn show(arguments: &Arguments, plan: &Plan, answer: &Answer) -> Result<Outcome, Failure> {
    match arguments.format {
        Format::Json => print_json("probe", &record(arguments, plan, Ok(answer)))?,
        format @ (Format::Table | Format::Markdown | Format::Latex) => {
            let mut text = table_text(&table(arguments, plan, answer), format).unwrap_or_default();
            if format == Format::Table {
                text.push_str(&paragraphs(&remarks(plan, answer)));
            }
            print(&text)?
        }
        format => {
            let table = table(arguments, plan, answer);
            print_record("probe", &record(arguments, plan, Ok(answer)), &table, format)?
        }
    };
    let accepted = answer.judgements.iter().all(|(_, found)| found.verdict.is_stable());
    Ok(if accepted { Outcome::Yes } else { Outcome::No })
}

fn table(arguments: &Arguments, plan: &Plan, answer: &Answer) -> Table {
    let measured = &answer.measured;
    let size: Vec<String> = plan.layout.size.iter().map(usize::to_string).collect();
    let settings = plan.fixed.iter().map(|(name, value)| format!(", {name} = {}", shown(value)));
    let caption = format!(
        "{}, measured on {} cells{}",
        arguments.command.join(" "),
        size.join(" × "),
        settings.collect::<String>()
    );
    let mut table = Table::new(caption, &[("", Align::Left), ("", Align::Left)]);
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    let linear = match plan.experiment.base {
        Base::Zero if answer.source > 0.0 => "linear, with a source that is left out",
        Base::Zero => "linear",
        Base::About(_) => "linearised about the state given",
    };
    let count = measured.terms.len();
    let plural = if count == 1 { "" } else { "s" };
    add("step", format!("{linear}, the same everywhere, {count} coefficient{plural}"));
    let symbol = measured.parameter.as_deref().unwrap_or_default();
    if let Some(stable) = &answer.stable_set {
        let limit = stable.limit();
        add("stability limit", describe(&limit, symbol, None));
        if has_gaps(stable) {
            add("stable set", set(stable));
        }
    }
    if let Some(monotone) = &answer.monotone_set {
        add("monotonicity limit", describe(&monotone.limit(), symbol, None));
    }
    for (value, found) in &answer.judgements {
        let name = match value {
            Some(value) => format!("{symbol} = {}", shown(value)),
            None => "verdict".into(),
        };
        let wave = match direction(&found.wave) {
            // Of waves that do not grow the largest is named by rounding.
            _ if found.verdict.is_stable() => String::new(),
            _ if found.wave.phases().iter().all(|phase| *phase == 0.0) => " (the mean)".into(),
            Some(direction) => format!(" ({} Δ {direction})", wavelength(&found.wave)),
            None => format!(" ({} Δ)", wavelength(&found.wave)),
        };
        let largest = significant(found.largest, 8);
        add(&name, format!("{}, largest |z| {largest}{wave}", found.verdict.name()));
    }
    table
}

fn remarks(plan: &Plan, answer: &Answer) -> Vec<String> {
    let measured = &answer.measured;
    let mut remarks = Vec::new();
    for (equation, unknown) in measured.equations().into_iter().zip(measured.step.unknowns()) {
        remarks.push(if equation.len() > LONGEST_EQUATION {
            format!("The equation of {unknown} is long: see --format json.")
        } else {
            equation
        });
    }
    let share = significant(plan.experiment.tolerance, 2);
    let of = match &measured.parameter {
        Some(name) => {
            let verified = measured.verifications;
            format!(
                "Coefficients measured at {} values of {name} and fitted as polynomials with {verified} or more of them left to verify",
                answer.values.len()
            )
        }
        None => "Coefficients measured once".into(),
    };
    remarks.push(if measured.recognised {
        format!(
            "{of}; recognised as fractions to {share} of the largest. What is said of the fractions is exact, that they are the program's is measured."
        )
    } else {
        format!(
            "{of}; not all are recognised as fractions to {share} of the largest. They are taken as decimals, and growth up to {} per step counts as none.",
            significant(to_f64(&measured.growth), 2)
        )
    });
    if let (Some(name), None) = (&plan.sought, &measured.parameter) {
        remarks.push(format!("The step does not depend on {name}."));
    }
    if let Some(set) = &answer.stable_set {
        let symbol = measured.parameter.as_deref().unwrap_or_default();
        let limit = set.limit();
        let exact = exact_below(&limit, symbol).filter(|_| measured.recognised);
        remarks.extend(exact.map(|text| format!("The limit: {text}")));
        if !limit.is_included() && limit.is_positive() && limit.evidence() != Evidence::Undecided {
            remarks.push(
                "At the limit itself two multipliers meet on the unit circle: an amplitude may grow like the number of steps.".into(),
            );
        }
        for (from, to) in &set.undecided {
            let (from, to) = (significant(*from, 8), significant(*to, 8));
            remarks.push(format!("Undecided for {symbol} in [{from}, {to}]."));
        }
    }
    if answer.source > 0.0 {
        let source = significant(answer.source, 4);
        remarks.push(format!("A state of zeros becomes up to {source}: this source is left out."));
    }
    remarks
}
