//! `courant limits`.

pub mod waves;

use super::numbers::{Names, Numbers};
use super::output::{Format, print, print_json, table_text};
use super::subject::{Subject, SubjectOptions};
use super::{Failure, Outcome, names, numbers};
use clap::Args;
use courant::analysis::certificate::{
    Certificate, CertificationError, certify_monotonicity, certify_stability,
};
use courant::analysis::exact::rational::{Rational, decimal_below, to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::{AdvectionScheme, Discretisation, Scheme, search_range};
use courant::analysis::stability::{
    DEFAULT_BITS, Evidence, Limit, StableSet, growth_set_beyond, monotonicity_limit,
    sampled_stability_limit, stable_set_to,
};
use courant::reports::certificate_file;
use courant::reports::number::{finite, significant};
use courant::reports::record::{
    GrowthRecord, IntervalRecord, LimitRecord, LimitsRow, exact_latex, intervals, undecided,
};
use courant::reports::table::{Align, Cell, Table};
use num_traits::{Signed, Zero};
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    /// Kernels, separated by commas: see `courant list kernels`.
    #[arg(long, value_parser = |text: &str| numbers::names(text, names::kernel), default_value = "cubic-spline")]
    kernel: Names<Kernel>,
    /// Smoothing ratios l/Δξ = h/Δ: 1,2,3 or 1:10:0.5 or 3/2, read exactly.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list)]
    ratio: Numbers,
    /// Look for stable Courant numbers up to this one (default: 10 + 4 l/Δξ; for c Δt/h 10).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::courant_number)]
    max_cfl: Option<Rational>,
    /// Also the limits for |g| ≤ 1 + growth per step: 1e-9,1e-6,1e-3.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative_list)]
    growth: Option<Numbers>,
    /// Look at N equally spaced phases instead of proving.
    #[arg(long, value_name = "N", value_parser = numbers::phases, conflicts_with = "method")]
    samples: Option<usize>,
    /// Significant digits of the limits, cut off and not rounded (at most 300); more than 15 need a closed form, an equation, or a
    /// narrower enclosure, which takes longer; limits of particle methods have them where they have a closed form or an equation.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = numbers::digits)]
    digits: Option<usize>,
    /// Also write a certificate of every limit to this file; `courant verify` checks it.
    #[arg(long, value_name = "FILE.json", conflicts_with_all = ["samples", "method"])]
    certificate: Option<PathBuf>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

#[derive(Debug, Serialize)]
struct Rows<R> {
    rows: Vec<R>,
}

/// Everything about one kernel and ratio.
struct Answer {
    discretisation: Discretisation,
    stability: Limit,
    /// Absent when only samples were looked at.
    set: Option<StableSet>,
    monotonicity: Limit,
    growth: Vec<(Rational, Limit)>,
    keeps_constants: bool,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match arguments.subject.subject()? {
        Subject::Scheme(scheme) => run_scheme(arguments, scheme),
        Subject::Stepped(stepped) => waves::run(arguments, &stepped),
    }
}

fn run_scheme(arguments: &Arguments, scheme: AdvectionScheme) -> Result<Outcome, Failure> {
    let answers =
        answers(arguments, |kernel, ratio| answer(arguments, scheme, kernel, ratio.clone()))?;
    if let Some(file) = &arguments.certificate {
        write_certificates(arguments, file, &answers)?;
    }
    let table = match arguments.format {
        Format::Csv => csv_table(arguments, &answers),
        _ => table(arguments, scheme, &answers),
    };
    show(arguments, &table, &remarks(&answers), || {
        answers.iter().map(|answer| row(arguments, answer)).collect()
    })
}

/// What there is to say about every kernel at every ratio.
fn answers<T: Send>(
    arguments: &Arguments,
    answer: impl Fn(Kernel, &Rational) -> Result<T, Failure> + Sync,
) -> Result<Vec<T>, Failure> {
    let kernels = arguments.kernel.0.iter();
    let cases: Vec<(Kernel, &Rational)> = kernels
        .flat_map(|kernel| arguments.ratio.0.iter().map(move |ratio| (*kernel, ratio)))
        .collect();
    cases.into_par_iter().map(|(kernel, ratio)| answer(kernel, ratio)).collect()
}

/// Prints the table with the remarks below it, or the rows as JSON.
fn show<R: Serialize>(
    arguments: &Arguments,
    table: &Table,
    remarks: &[String],
    rows: impl FnOnce() -> Vec<R>,
) -> Result<Outcome, Failure> {
    match table_text(table, arguments.format) {
        Some(mut text) => {
            if arguments.format == Format::Table && !remarks.is_empty() {
                text.push_str(&format!("\n{}\n", remarks.join("\n")));
            }
            print(&text)
        }
        None => print_json("limits", &Rows { rows: rows() }),
    }
}

/// The growth budgets asked for.
fn budgets(arguments: &Arguments) -> &[Rational] {
    arguments.growth.as_ref().map_or(&[], |numbers| &numbers.0)
}

/// A table with a column for each growth budget after the others.
fn table_with_budgets(arguments: &Arguments, caption: String, columns: &[(&str, Align)]) -> Table {
    // A budget may be smaller than any f64.
    let digits = |growth: &Rational| match to_f64(growth) {
        0.0 if growth.is_positive() => decimal_below(growth, 3),
        rounded => significant(rounded, 3),
    };
    let name = |growth: &Rational| format!("growth {}", digits(growth));
    let names: Vec<String> = budgets(arguments).iter().map(name).collect();
    let growth = names.iter().map(|name| (name.as_str(), Align::Right));
    let columns: Vec<(&str, Align)> = columns.iter().copied().chain(growth).collect();
    Table::new(caption, &columns)
}

/// Certificates of every limit shown: stability, growth budgets, monotonicity.
fn write_certificates(
    arguments: &Arguments,
    file: &Path,
    answers: &[Answer],
) -> Result<(), Failure> {
    let certified: Result<Vec<Vec<Certificate>>, Failure> = answers
        .par_iter()
        .map(|answer| {
            let scheme = &answer.discretisation;
            let range = arguments.max_cfl.clone().unwrap_or_else(|| search_range(scheme.ratio()));
            let symbol = scheme.symbol();
            let failed = |error: CertificationError| {
                let (kernel, ratio) = (scheme.kernel(), to_text(scheme.ratio()));
                Failure::Message(format!("--certificate: {kernel}, l/Δξ = {ratio}: {error}"))
            };
            let zero = Rational::zero();
            let budgets =
                std::iter::once(&zero).chain(answer.growth.iter().map(|(growth, _)| growth));
            let mut certificates = Vec::new();
            for growth in budgets {
                let found = certify_stability(&symbol, Some(scheme), growth, &range);
                certificates.extend(found.map_err(failed)?);
            }
            certificates.push(certify_monotonicity(&symbol, Some(scheme), &range).map_err(failed)?);
            Ok(certificates)
        })
        .collect();
    let certificates: Vec<Certificate> = certified?.into_iter().flatten().collect();
    certificate_file::write(file, &certificates)
        .map_err(|error| Failure::Message(format!("--certificate: {error}")))
}

fn answer(
    arguments: &Arguments,
    scheme: AdvectionScheme,
    kernel: Kernel,
    ratio: Rational,
) -> Result<Answer, Failure> {
    let range = arguments.max_cfl.clone().unwrap_or_else(|| search_range(&ratio));
    let discretisation = Discretisation::new(scheme, kernel, ratio)
        .map_err(|error| Failure::Message(format!("--ratio: {error}")))?;
    let symbol = discretisation.symbol();
    let (stability, set) = match arguments.samples {
        Some(samples) => {
            let cells = (samples - 1) as f64;
            let phases: Vec<f64> =
                (0..samples).map(|i| i as f64 / cells * std::f64::consts::PI).collect();
            (sampled_stability_limit(&symbol, &phases, &range), None)
        }
        None => {
            let set = stable_set_to(&symbol, &Rational::zero(), &range, bits(arguments));
            (set.limit(), Some(set))
        }
    };
    let budgets = budgets(arguments);
    Ok(Answer {
        stability,
        monotonicity: monotonicity_limit(&symbol, &range),
        growth: budgets
            .iter()
            .map(|g| {
                let bits = bits(arguments);
                let found = match &set {
                    Some(strict) if g.is_positive() => {
                        growth_set_beyond(&symbol, g, &strict.limit(), &range, bits)
                    }
                    _ => stable_set_to(&symbol, g, &range, bits),
                };
                (g.clone(), found.limit())
            })
            .collect(),
        set,
        keeps_constants: symbol.keeps_constants(),
        discretisation,
    })
}

fn row(arguments: &Arguments, answer: &Answer) -> LimitsRow {
    LimitsRow {
        scheme: answer.discretisation.scheme().name().into(),
        kernel: answer.discretisation.kernel().name().into(),
        ratio: to_text(answer.discretisation.ratio()),
        stability: record(arguments, &answer.stability),
        stable_set: match &answer.set {
            Some(set) => intervals(set),
            None => vec![IntervalRecord::up_to(&answer.stability)],
        },
        undecided: answer.set.as_ref().map(undecided).unwrap_or_default(),
        monotonicity: record(arguments, &answer.monotonicity),
        growth_limits: answer
            .growth
            .iter()
            .map(|(growth, limit)| GrowthRecord {
                growth: to_f64(growth),
                value: finite(limit.value()),
                limit: record(arguments, limit),
            })
            .collect(),
        keeps_constants: answer.keeps_constants,
    }
}

fn table(arguments: &Arguments, scheme: AdvectionScheme, answers: &[Answer]) -> Table {
    let caption = format!("Limits of the Courant number, {}", scheme.title());
    let columns = [
        ("kernel", Align::Left),
        ("l/Δξ", Align::Right),
        ("stable up to", Align::Right),
        ("exactly", Align::Right),
        ("evidence", Align::Left),
        ("binding wave", Align::Left),
        ("monotone up to", Align::Right),
        ("exactly", Align::Right),
    ];
    let mut table = table_with_budgets(arguments, caption, &columns);
    for answer in answers {
        let mut cells = vec![
            Cell::from(answer.discretisation.kernel().name()),
            to_text(answer.discretisation.ratio()).into(),
            number(arguments, &answer.stability),
            exact(&answer.stability),
            answer.stability.evidence().name().into(),
            binding_wave(&answer.stability).into(),
            number(arguments, &answer.monotonicity),
            exact(&answer.monotonicity),
        ];
        cells.extend(answer.growth.iter().map(|(_, limit)| number(arguments, limit)));
        table.push(cells);
    }
    table
}

/// The same for machines: every number with all its digits, empty where there is none.
fn csv_table(arguments: &Arguments, answers: &[Answer]) -> Table {
    let limits = ["stability", "monotonicity"].map(String::from).into_iter();
    let growth = budgets(arguments).iter().map(|growth| format!("growth_{:e}", to_f64(growth)));
    let mut columns: Vec<String> = ["scheme", "kernel", "ratio"].map(String::from).to_vec();
    for limit in limits.chain(growth) {
        let parts =
            ["", "_lower", "_upper", "_exact", "_equation", "_evidence", "_phase", "_cause"];
        columns.extend(parts.map(|part| format!("{limit}{part}")));
    }
    columns.push("keeps_constants".into());
    let columns: Vec<(&str, Align)> = columns.iter().map(|c| (c.as_str(), Align::Left)).collect();
    let mut table = Table::new(String::new(), &columns);
    let shown = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
    for answer in answers {
        let row = row(arguments, answer);
        let mut cells = vec![row.scheme, row.kernel, row.ratio];
        let budgets = row.growth_limits.into_iter().map(|growth| growth.limit);
        for limit in [row.stability, row.monotonicity].into_iter().chain(budgets) {
            cells.extend([
                limit.decimal.unwrap_or_else(|| shown(limit.value)),
                limit.lower.to_string(),
                shown(limit.upper),
                limit.exact.unwrap_or_default(),
                limit.equation.map(|equation| equation.text).unwrap_or_default(),
                limit.evidence.into(),
                shown(limit.critical_phase),
                limit.cause.unwrap_or_default().into(),
            ]);
        }
        cells.push(row.keeps_constants.to_string());
        table.push(cells);
    }
    table
}

/// Digits shown when no number of them is asked for.
const DEFAULT_DIGITS: usize = 11;

/// Bits of an enclosure that settle the digits asked for.
fn bits(arguments: &Arguments) -> u32 {
    let digits = arguments.digits.unwrap_or(DEFAULT_DIGITS) as f64;
    ((digits * std::f64::consts::LOG2_10).ceil() as u32 + 4).max(DEFAULT_BITS)
}

/// A limit for people: no digit is rounded up, so that what is printed may be used.
fn number(arguments: &Arguments, limit: &Limit) -> Cell {
    let shown = match arguments.digits {
        Some(digits) => limit.decimal(digits),
        None => limit.proved_decimal(DEFAULT_DIGITS),
    };
    match shown {
        Some(digits) => digits.into(),
        None => format!("> {}", significant(limit.lower(), 6)).into(),
    }
}

/// A limit as JSON, with its digits where they were asked for.
fn record(arguments: &Arguments, limit: &Limit) -> LimitRecord {
    let decimal = arguments.digits.and_then(|digits| limit.decimal(digits));
    LimitRecord { decimal, ..limit.into() }
}

/// The closed form where it is short enough to be read.
fn exact(limit: &Limit) -> Cell {
    if let Some(root) = limit.equation() {
        return format!("root, degree {}", root.degree()).into();
    }
    let text = limit.exact().map_or_else(String::new, ToString::to_string);
    match exact_latex(limit) {
        _ if text.len() > 24 => "(long fraction)".into(),
        Some(latex) => Cell::with_latex(text, latex),
        None => text.into(),
    }
}

/// The wave that binds, by its length in particle spacings.
pub fn binding_wave(limit: &Limit) -> String {
    match (limit.cause(), limit.critical_phase()) {
        (Some(cause), Some(phase)) if phase > 0.0 => {
            format!("{}, {} Δξ", cause.name(), significant(2.0 * std::f64::consts::PI / phase, 4))
        }
        (Some(cause), _) => cause.name().into(),
        (None, _) => "–".into(),
    }
}

/// The longest equation that is shown below a table; longer ones are in the JSON.
const LONGEST_EQUATION: usize = 160;

/// The equation a limit solves, if there is one and it can be read.
fn add_equation(remarks: &mut Vec<String>, name: &str, limit: &str, unknown: &str, found: &Limit) {
    let Some(root) = found.equation() else { return };
    let text = root.equation(unknown);
    remarks.push(if text.len() <= LONGEST_EQUATION {
        format!("{name}: {limit} solves {text}")
    } else {
        format!(
            "{name}: {limit} is a root of a polynomial of degree {}: see --format json",
            root.degree()
        )
    });
}

/// What the columns cannot say.
fn remarks(answers: &[Answer]) -> Vec<String> {
    let mut remarks = Vec::new();
    for answer in answers {
        let name = format!(
            "{}, l/Δξ = {}",
            answer.discretisation.kernel().name(),
            to_text(answer.discretisation.ratio())
        );
        if !answer.keeps_constants {
            remarks.push(format!("{name}: a constant is not kept, the mean drifts"));
        }
        add_equation(&mut remarks, &name, "the stability limit C", "C", &answer.stability);
        add_equation(&mut remarks, &name, "the monotonicity limit C", "C", &answer.monotonicity);
        for (growth, limit) in &answer.growth {
            if limit.evidence() == Evidence::Undecided {
                let budget = decimal_below(growth, 3);
                remarks.push(format!(
                    "{name}: |g| ≤ 1 + {budget} is proved up to C = {} and undecided above",
                    significant(limit.lower(), 8)
                ));
            }
        }
        let Some(set) = &answer.set else { continue };
        if set.neutral {
            remarks.push(format!("{name}: |g| = 1 for every wave at every C: no neighbour counts"));
        }
        if set.intervals.len() > 1 || set.intervals.first().is_some_and(|i| i.from.upper() > 0.0) {
            let list: Vec<String> = set
                .intervals
                .iter()
                .map(|i| {
                    format!(
                        "[{}, {}]",
                        significant(i.from.upper(), 8),
                        i.to.decimal(8).unwrap_or_else(|| significant(i.to.lower(), 8))
                    )
                })
                .collect();
            remarks.push(format!("{name}: stable for C in {}", list.join(" and ")));
        }
        for (from, to) in &set.undecided {
            remarks.push(format!(
                "{name}: undecided for C in [{}, {}]",
                significant(*from, 8),
                significant(*to, 8)
            ));
        }
    }
    remarks
}
