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
use courant::analysis::kernel::Kernel;
use courant::analysis::limit::{
    Limit, StableSet, growth_limit, monotonicity_limit, sampled_stability_limit, stable_set,
};
use courant::analysis::rational::{Rational, to_f64, to_text};
use courant::analysis::scheme::{AdvectionScheme, Discretisation, Scheme, search_range};
use courant::reports::certificate_file;
use courant::reports::number::{finite, significant};
use courant::reports::record::{
    GrowthRecord, IntervalRecord, LimitsRow, exact_latex, intervals, undecided,
};
use courant::reports::table::{Align, Cell, Table};
use num_traits::Zero;
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
    let table = table(arguments, scheme, &answers);
    show(arguments, &table, &remarks(&answers), || answers.iter().map(row).collect())
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
    let name = |growth: &Rational| format!("growth {}", significant(to_f64(growth), 3));
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
            let set = stable_set(&symbol, &Rational::zero(), &range);
            (set.limit(), Some(set))
        }
    };
    let budgets = budgets(arguments);
    Ok(Answer {
        stability,
        set,
        monotonicity: monotonicity_limit(&symbol, &range),
        growth: budgets.iter().map(|g| (g.clone(), growth_limit(&symbol, g, &range))).collect(),
        keeps_constants: symbol.keeps_constants(),
        discretisation,
    })
}

fn row(answer: &Answer) -> LimitsRow {
    LimitsRow {
        scheme: answer.discretisation.scheme().name().into(),
        kernel: answer.discretisation.kernel().name().into(),
        ratio: to_text(answer.discretisation.ratio()),
        stability: (&answer.stability).into(),
        stable_set: match &answer.set {
            Some(set) => intervals(set),
            None => vec![IntervalRecord { from: 0.0, to: finite(answer.stability.value()) }],
        },
        undecided: answer.set.as_ref().map(undecided).unwrap_or_default(),
        monotonicity: (&answer.monotonicity).into(),
        growth_limits: answer
            .growth
            .iter()
            .map(|(growth, limit)| GrowthRecord {
                growth: to_f64(growth),
                value: finite(limit.value()),
                limit: limit.into(),
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
            number(&answer.stability),
            exact(&answer.stability),
            answer.stability.evidence().name().into(),
            binding_wave(&answer.stability).into(),
            number(&answer.monotonicity),
            exact(&answer.monotonicity),
        ];
        cells.extend(answer.growth.iter().map(|(_, limit)| number(limit)));
        table.push(cells);
    }
    table
}

/// A limit for people: twelve digits are proved, eleven are shown.
fn number(limit: &Limit) -> Cell {
    if limit.value().is_infinite() {
        format!("> {}", significant(limit.lower(), 6)).into()
    } else {
        significant(limit.value(), 11).into()
    }
}

/// The closed form where it is short enough to be read.
fn exact(limit: &Limit) -> Cell {
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
                        significant(i.from.value(), 8),
                        significant(i.to.value(), 8)
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
