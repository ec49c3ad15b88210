//! `courant check`.

mod waves;

use super::judged::{Subject, SubjectOptions};
use super::limit_text::wave as binding_wave;
use super::output::{Format, print_record};
use super::{Failure, Outcome, names, numbers};
use clap::Args;
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::{AdvectionScheme, Discretisation, Scheme, search_range};
use courant::analysis::stability::Limit;
use courant::analysis::stability::stable_set;
use courant::analysis::stability::verdict::{Check, Verdict, check};
use courant::reports::number::significant;
use courant::reports::record::CheckRecord;
use courant::reports::table::{Align, Table};
use serde::Serialize;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    /// Kernel: see `courant list kernels`.
    #[arg(long, value_parser = names::kernel, default_value = "cubic-spline")]
    kernel: Kernel,
    /// Smoothing ratio l/Δξ = h/Δ, read exactly: 2, 1.3, 3/2.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio)]
    ratio: Rational,
    /// Courant number C = a Δt/Δξ of a scheme, or c Δt/h of a particle method, read exactly.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::courant_number)]
    cfl: Rational,
    /// Accept growth up to this much per step: the answer is then whether |g| ≤ 1 + growth.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative)]
    growth: Option<Rational>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match arguments.subject.subject()? {
        Subject::Scheme(scheme) => run_scheme(arguments, scheme),
        Subject::Stepped(stepped) => waves::run(arguments, &stepped),
    }
}

fn run_scheme(arguments: &Arguments, scheme: AdvectionScheme) -> Result<Outcome, Failure> {
    let discretisation = Discretisation::new(scheme, arguments.kernel, arguments.ratio.clone())
        .map_err(|error| Failure::Message(format!("--ratio: {error}")))?;
    let symbol = discretisation.symbol();
    let range = search_range(&arguments.ratio);
    let found = check(&symbol, &arguments.cfl, &range);
    let within_budget = arguments.growth.as_ref().map(|growth| {
        let range = range.max(&arguments.cfl * Rational::from_integer(2.into()));
        stable_set(&symbol, growth, &range).contains(&arguments.cfl)
    });
    let record = CheckRecord::new(&discretisation, to_f64(&arguments.cfl), &found);
    let table = table(arguments, scheme, &found);
    conclude(arguments, &record, table, found.verdict, within_budget)
}

/// Prints the answer. It is yes when the growth is within the budget or, without one, when no wave grows.
fn conclude(
    arguments: &Arguments,
    record: &impl Serialize,
    mut table: Table,
    verdict: Verdict,
    within_budget: Option<bool>,
) -> Result<Outcome, Failure> {
    if let (Some(within), Some(growth)) = (within_budget, &arguments.growth) {
        let name = format!("growth within {}", significant(to_f64(growth), 3));
        table.push([name, if within { "yes" } else { "no" }.into()]);
    }
    print_record("check", record, &table, arguments.format)?;
    let accepted = within_budget.unwrap_or_else(|| verdict.is_stable());
    Ok(if accepted { Outcome::Yes } else { Outcome::No })
}

fn table(arguments: &Arguments, scheme: AdvectionScheme, found: &Check) -> Table {
    let caption = format!(
        "{}, {}, l/Δξ = {}, C = {}: {}",
        scheme.title(),
        arguments.kernel.title(),
        to_text(&arguments.ratio),
        to_text(&arguments.cfl),
        headline(found)
    );
    let mut table = Table::new(caption, &[("", Align::Left), ("", Align::Left)]);
    let limit = found.stable_set.limit();
    let courant = to_f64(&arguments.cfl);
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    add("verdict", found.verdict.name().into());
    add("monotone", if found.monotone { "yes" } else { "no" }.into());
    add("stability limit", describe(&limit, "C"));
    if limit.is_positive() && limit.value().is_finite() {
        add("C / limit", significant(courant / limit.value(), 8));
    }
    add("monotonicity limit", describe(&found.monotonicity, "C"));
    add("largest |g|", significant(1.0 + found.strongest.growth, 12));
    add("growth per step", significant(found.strongest.growth, 6));
    if let Some(steps) = found.steps_to_double {
        add("steps to double", significant(steps, 4));
        let wavelength = 2.0 * std::f64::consts::PI / found.strongest.phase;
        let wave = if found.strongest.phase > 0.0 {
            format!(
                "{} Δξ (φ = {} rad)",
                significant(wavelength, 5),
                significant(found.strongest.phase, 5)
            )
        } else {
            "the mean itself (φ = 0)".into()
        };
        add("fastest growing wave", wave);
    }
    table
}

fn headline(found: &Check) -> String {
    let verdict = words(found.verdict);
    match (found.verdict.is_stable(), found.monotone) {
        (true, true) => format!("{verdict}, monotone"),
        (true, false) => format!("{verdict}, not monotone"),
        (false, _) => verdict.into(),
    }
}

/// The verdict as people say it.
fn words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stable",
        Verdict::Marginal => "marginally stable",
        Verdict::WeaklyUnstable => "weakly unstable",
        Verdict::Unstable => "unstable",
    }
}

/// A limit of what is called `symbol`, in words.
fn describe(limit: &Limit, symbol: &str) -> String {
    if limit.value().is_infinite() {
        return format!("none up to {symbol} = {}", significant(limit.lower(), 6));
    }
    let exact = limit
        .exact()
        .map(ToString::to_string)
        .filter(|text| text.len() <= 24 && text.contains(['/', '(']))
        .map_or_else(String::new, |text| format!(" = {text}"));
    let wave = match limit.critical_phase() {
        Some(_) => format!(", {}", binding_wave(limit)),
        None => limit
            .binding_offset()
            .map_or_else(String::new, |k| format!(", coefficient of offset {k}")),
    };
    let digits = limit.decimal(12).unwrap_or_default();
    format!("{digits}{exact} ({}{wave})", limit.evidence().name())
}
