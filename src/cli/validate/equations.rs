//! Any other scheme: multipliers against the equations stepped as they were typed.

use super::{Arguments, Measured, csv_table};
use crate::cli::output::{Format, paragraphs, print, print_json, table_text};
use crate::cli::progress::Bar;
use crate::cli::subject::{Label, Subject, option, row_name, varying};
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::to_f64;
use courant::analysis::interest::Interest;
use courant::reports::equation_validation::RunningSubject;
use courant::reports::number::{finite, significant};
use courant::reports::record::SubjectRecord;
use courant::reports::table::{Align, Table};
use courant::simulation::stepping::{
    Multiplier, PerAxis, SteppingError, Validation, ValidationPlan,
};
use rayon::prelude::*;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// One subject at one value.
struct Case {
    subject: Subject,
    record: SubjectRecord,
    symbol: String,
    value: f64,
    validation: Validation,
}

#[derive(Debug, Serialize)]
struct Row {
    #[serde(flatten)]
    subject: SubjectRecord,
    cfl: f64,
    /// One number, in more dimensions one for each axis; so is the phase.
    mode: PerAxis<i64>,
    phase: PerAxis<f64>,
    branch: usize,
    predicted: Multiplier,
    measured: Multiplier,
    error: Option<f64>,
    tolerance: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Record {
    rows: Vec<Row>,
    max_error: Option<f64>,
    tolerance: Option<f64>,
    tolerance_meaning: Option<&'static str>,
    failures: Vec<String>,
    /// One number, in more dimensions one for each axis; none where they differ between subjects.
    particles: Option<PerAxis<usize>>,
    steps: usize,
    passed: bool,
}

pub fn run(arguments: &Arguments, subjects: &[Subject]) -> Result<Outcome, Failure> {
    if arguments.fault.is_some() {
        return Err(Failure::Message(
            "--fault: only euler-sph, lax-wendroff-sph and godunov-sph have it".into(),
        ));
    }
    let bar = Bar::new("validate");
    let done = AtomicUsize::new(0);
    let cases: Vec<Vec<Case>> = subjects
        .par_iter()
        .map(|subject| {
            let cases = cases(arguments, subject);
            let _ = bar.advance(done.fetch_add(1, Ordering::Relaxed) + 1, subjects.len());
            cases
        })
        .collect::<Result<_, Failure>>()?;
    bar.finish();
    let cases: Vec<Case> = cases.into_iter().flatten().collect();
    let passed = cases.iter().all(|case| case.validation.passed);
    match arguments.format {
        Format::Json => print_json("validate", &record(&cases))?,
        Format::Csv => print(&csv_table(cases.iter().flat_map(measured)).to_csv())?,
        format => {
            let table = match cases.as_slice() {
                [one] => mode_table(one),
                several => case_table(several),
            };
            let mut text = table_text(&table, format).unwrap_or_default();
            if format == Format::Table {
                text.push_str(&paragraphs(&conclusion(&cases)));
            }
            print(&text)?
        }
    };
    Ok(if passed { Outcome::Yes } else { Outcome::No })
}

fn plan(arguments: &Arguments, dimension: usize) -> Result<ValidationPlan, Failure> {
    let mut plan = ValidationPlan::in_dimension(dimension);
    if let Some(cells) = &arguments.particles {
        plan.points = cells.along(dimension)?;
    }
    plan.steps = arguments.steps.map_or(plan.steps, |steps| steps as usize);
    Ok(plan)
}

fn cases(arguments: &Arguments, subject: &Subject) -> Result<Vec<Case>, Failure> {
    let running = RunningSubject::new(subject)?;
    let sought = &running.sought;
    let plan = plan(arguments, sought.step.dimension())?;
    let name = &sought.parameter;
    let given = arguments.cfl.iter().flat_map(|values| &values.0).chain(&sought.value);
    let mut values: Vec<f64> = given.map(to_f64).collect();
    if values.is_empty() {
        values = running.about_the_limit(Interest::default())?;
    }
    values
        .into_iter()
        .map(|value| {
            let failed = |error: SteppingError| {
                let option = match error {
                    SteppingError::Singular { .. } | SteppingError::NoCells => {
                        let cells = PerAxis(plan.points.clone()).joined("x");
                        format!("--particles {cells}, {name} = {value}")
                    }
                    _ => format!("{} {}", option(subject.kind), subject.file.name),
                };
                Failure::Message(format!("{option}: {error}"))
            };
            Ok(Case {
                subject: subject.clone(),
                record: subject.record(&sought.step, Some(name)),
                symbol: subject.symbol(name),
                value,
                validation: running.validate(value, &plan).map_err(failed)?,
            })
        })
        .collect()
}

/// The largest; what is no number is larger than every number.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| if value.is_nan() { f64::INFINITY } else { most.max(value) })
}

fn record(cases: &[Case]) -> Record {
    let rows = cases.iter().flat_map(|case| {
        case.validation.rows.iter().map(|row| Row {
            subject: case.record.clone(),
            cfl: case.value,
            mode: row.mode.clone(),
            phase: row.phase.clone(),
            branch: row.branch,
            predicted: row.predicted,
            measured: row.measured,
            error: finite(row.error),
            tolerance: finite(row.tolerance),
        })
    });
    Record {
        rows: rows.collect(),
        max_error: finite(largest(cases.iter().map(|case| case.validation.max_error))),
        tolerance: finite(largest(cases.iter().map(|case| case.validation.tolerance))),
        tolerance_meaning: cases.first().map(|case| case.validation.tolerance_meaning),
        failures: failures(cases),
        particles: cells(cases).try_into().ok().map(|[cells]: [_; 1]| cells),
        steps: cases.first().map_or(0, |case| case.validation.steps),
        passed: cases.iter().all(|case| case.validation.passed),
    }
}

/// The tori of the cases, each once.
fn cells(cases: &[Case]) -> Vec<PerAxis<usize>> {
    let mut all: Vec<PerAxis<usize>> = Vec::new();
    for case in cases {
        if !all.contains(&case.validation.cells) {
            all.push(case.validation.cells.clone());
        }
    }
    all
}

fn failures(cases: &[Case]) -> Vec<String> {
    let failed = cases.iter().filter_map(|case| Some((case, case.validation.failure.as_ref()?)));
    failed.map(|(case, what)| format!("{}: {what}", name(case))).collect()
}

fn name(case: &Case) -> String {
    let labels = labels(case);
    let all: Vec<String> = labels.iter().map(|label| label.heading.clone()).collect();
    row_name(&labels, &all)
}

fn labels(case: &Case) -> Vec<Label> {
    let mut labels = case.subject.labels();
    labels.retain(|label| label.heading != case.symbol);
    let cell = significant(case.value, 7);
    let caption = format!("{} = {cell}", case.symbol);
    labels.push(Label { heading: case.symbol.clone(), cell, caption });
    labels
}

/// The rows for machines.
fn measured(case: &Case) -> impl Iterator<Item = Measured<'_>> {
    let pair = |multiplier: Multiplier| [multiplier.gain, multiplier.phase];
    case.validation.rows.iter().map(move |row| Measured {
        subject: &case.record,
        cfl: case.value,
        mode: row.mode.joined(" "),
        phase: row.phase.joined(" "),
        branch: row.branch.to_string(),
        code: "",
        predicted: pair(row.predicted),
        measured: pair(row.measured),
        error: row.error,
        tolerance: row.tolerance,
    })
}

fn mode_table(case: &Case) -> Table {
    let captions: Vec<String> = labels(case).iter().map(|label| label.caption.clone()).collect();
    let columns = [
        ("mode", Align::Right),
        ("φ", Align::Right),
        ("branch", Align::Right),
        ("predicted |z|", Align::Right),
        ("arg z", Align::Right),
        ("measured |z|", Align::Right),
        ("arg z", Align::Right),
        ("error", Align::Right),
    ];
    let mut table = Table::new(
        format!("{}: multipliers of each wave, predicted and measured", captions.join(", ")),
        &columns,
    );
    for row in &case.validation.rows {
        let factor = |z: Multiplier| [significant(z.gain, 11), significant(z.phase, 9)];
        let phases = row.phase.iter().map(|phase| significant(*phase, 6)).collect();
        let mut cells =
            vec![row.mode.joined(", "), PerAxis(phases).joined(", "), row.branch.to_string()];
        cells.extend(factor(row.predicted));
        cells.extend(factor(row.measured));
        cells.push(significant(row.error, 2));
        table.push(cells);
    }
    table
}

fn case_table(cases: &[Case]) -> Table {
    let all: Vec<Vec<Label>> = cases.iter().map(labels).collect();
    let varying = varying(&all);
    let mut columns: Vec<(&str, Align)> = varying
        .iter()
        .map(|heading| {
            let label = all.iter().flatten().find(|label| label.heading == *heading);
            (heading.as_str(), Label::align(label))
        })
        .collect();
    columns.extend([
        ("largest |z|", Align::Right),
        ("max error", Align::Right),
        ("allowed", Align::Right),
        ("agrees", Align::Left),
    ]);
    let shared = all[0].iter().filter(|label| !varying.contains(&label.heading));
    let mut caption: Vec<String> = shared.map(|label| label.caption.clone()).collect();
    caption.push("multipliers predicted and measured on the running equations".into());
    let mut table = Table::new(caption.join(", "), &columns);
    for (case, labels) in cases.iter().zip(&all) {
        let cell = |heading: &String| {
            let label = labels.iter().find(|label| label.heading == *heading);
            label.map_or_else(|| "–".to_string(), |label| label.cell.clone())
        };
        let mut cells: Vec<String> = varying.iter().map(cell).collect();
        let validation = &case.validation;
        let gain = largest(validation.rows.iter().map(|row| row.predicted.gain));
        cells.extend([
            significant(gain, 7),
            significant(validation.max_error, 2),
            significant(validation.tolerance, 2),
            if validation.passed { "yes" } else { "NO" }.into(),
        ]);
        table.push(cells);
    }
    table
}

fn conclusion(cases: &[Case]) -> Vec<String> {
    let rows: usize = cases.iter().map(|case| case.validation.rows.len()).sum();
    let failures = failures(cases);
    let verdict = match failures.len() {
        0 => format!("all {rows} multipliers agree"),
        failed => {
            format!("{failed} of {} cases do not agree: prediction and run differ", cases.len())
        }
    };
    let error = largest(cases.iter().map(|case| case.validation.max_error));
    let first = format!(
        "{verdict}; max error {}; {} cells, {} steps",
        significant(error, 3),
        cells(cases).iter().map(|cells| cells.joined(" × ")).collect::<Vec<_>>().join(" or "),
        cases.first().map_or(0, |case| case.validation.steps)
    );
    std::iter::once(first).chain(failures).collect()
}
