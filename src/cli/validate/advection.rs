//! The advection schemes: symbol against stepping.

use super::{Arguments, Measured, csv_table};
use crate::cli::output::{Format, paragraphs, print, print_json, table_text};
use crate::cli::progress::Bar;
use crate::cli::subject::Subject;
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{to_f64, to_text};
use courant::reports::advection_validation::{
    Settings, ValidatedCase, ValidationCase, ValidationRecord, run_cases,
};
use courant::reports::number::significant;
use courant::reports::record::SubjectRecord;
use courant::reports::table::{Align, Table};
use courant::simulation::advection::Fault;
use courant::simulation::advection::{AdvectionScheme, Discretisation};

pub fn run(arguments: &Arguments, subjects: &[Subject]) -> Result<Outcome, Failure> {
    let defaults = Settings::default();
    let settings = Settings {
        particles: arguments.on_line()?.unwrap_or(defaults.particles),
        steps: arguments.steps.unwrap_or(defaults.steps),
        fault: arguments.fault.as_ref().map(|by| Fault { offset: -1, by: to_f64(by) }),
    };
    let (cases, subjects): (Vec<_>, Vec<_>) =
        cases(arguments, subjects, settings)?.into_iter().unzip();
    let bar = Bar::new("validate");
    let cases = run_cases(cases, &|done, all| {
        let _ = bar.advance(done, all);
    })
    .map_err(|error| Failure::Message(error.to_string()))?;
    bar.finish();
    let record = ValidationRecord::new(settings, &cases);
    // One case is shown mode by mode, several case by case; machines get every mode.
    let table = match (cases.as_slice(), arguments.format) {
        (all, Format::Csv) => {
            csv_table(all.iter().zip(&subjects).flat_map(|(case, subject)| measured(case, subject)))
        }
        ([case], _) => mode_table(case),
        (cases, _) => case_table(cases),
    };
    match table_text(&table, arguments.format) {
        Some(mut text) => {
            if arguments.format == Format::Table {
                text.push_str(&paragraphs(&[conclusion(&record)]));
            }
            print(&text)?
        }
        None => print_json("validate", &record)?,
    };
    Ok(if record.passed { Outcome::Yes } else { Outcome::No })
}

fn cases(
    arguments: &Arguments,
    subjects: &[Subject],
    settings: Settings,
) -> Result<Vec<(ValidationCase, SubjectRecord)>, Failure> {
    let mut all = Vec::new();
    for subject in subjects {
        let scheme: AdvectionScheme = subject
            .file
            .name
            .parse()
            .map_err(|error| Failure::Message(format!("--scheme: {error}")))?;
        let (kernel, ratio) = subject.kernel.clone().expect("these schemes have kernels");
        let discretisation = Discretisation::new(scheme, kernel, ratio)
            .map_err(|error| Failure::Message(format!("--ratio: {error}")))?;
        let sought = subject.sought(true)?;
        let values = arguments.cfl.iter().flat_map(|values| &values.0).chain(&sought.value);
        let mut cases: Vec<ValidationCase> = values
            .map(|value| ValidationCase::at(discretisation.clone(), value, settings))
            .collect();
        if cases.is_empty() {
            cases = ValidationCase::about_the_limit(&discretisation, settings);
        }
        let record = subject.record(&sought.step, Some(&sought.parameter));
        all.extend(cases.into_iter().map(|case| (case, record.clone())));
    }
    Ok(all)
}

/// The rows for machines.
fn measured<'a>(
    case: &'a ValidatedCase,
    subject: &'a SubjectRecord,
) -> impl Iterator<Item = Measured<'a>> {
    case.validation.rows.iter().map(move |row| Measured {
        subject,
        cfl: case.case.plan.courant_number,
        mode: row.mode.to_string(),
        phase: row.phase.to_string(),
        branch: "0".into(),
        code: "",
        predicted: [row.predicted.norm(), row.predicted.arg()],
        measured: [row.measured.norm(), row.measured.arg()],
        error: row.error,
        tolerance: case.validation.tolerance,
    })
}

fn case_table(cases: &[ValidatedCase]) -> Table {
    let mut table = Table::new(
        "Amplification factors, predicted by the symbol and measured on the running scheme",
        &[
            ("scheme", Align::Left),
            ("kernel", Align::Left),
            ("l/Δξ", Align::Right),
            ("C", Align::Right),
            ("regime", Align::Left),
            ("largest |g|", Align::Right),
            ("max error", Align::Right),
            ("allowed", Align::Right),
            ("agrees", Align::Left),
        ],
    );
    for case in cases {
        let discretisation = &case.case.plan.discretisation;
        table.push([
            discretisation.scheme().name().to_string(),
            discretisation.kernel().name().into(),
            to_text(discretisation.ratio()),
            case.case.courant_text(),
            case.case.regime.name().into(),
            significant(case.largest_gain(), 7),
            significant(case.validation.max_error, 2),
            significant(case.validation.tolerance, 2),
            if case.validation.passed() { "yes" } else { "NO" }.into(),
        ]);
    }
    table
}

fn mode_table(case: &ValidatedCase) -> Table {
    let discretisation = &case.case.plan.discretisation;
    let caption = format!(
        "{}, {}, l/Δξ = {}, C = {} ({}): factor per step of each mode",
        discretisation.scheme().title(),
        discretisation.kernel().title(),
        to_text(discretisation.ratio()),
        case.case.courant_text(),
        case.case.regime.name()
    );
    let mut table = Table::new(
        caption,
        &[
            ("mode", Align::Right),
            ("φ", Align::Right),
            ("predicted |g|", Align::Right),
            ("predicted arg g", Align::Right),
            ("measured |g|", Align::Right),
            ("measured arg g", Align::Right),
            ("error", Align::Right),
        ],
    );
    for row in &case.validation.rows {
        table.push([
            row.mode.to_string(),
            significant(row.phase, 7),
            significant(row.predicted.norm(), 13),
            significant(row.predicted.arg(), 13),
            significant(row.measured.norm(), 13),
            significant(row.measured.arg(), 13),
            significant(row.error, 2),
        ]);
    }
    table
}

fn conclusion(record: &ValidationRecord) -> String {
    let error = record.max_error.map_or("not finite".into(), |error| significant(error, 3));
    let failed = record.cases.iter().filter(|case| !case.passed).count();
    let modes = record.rows.len();
    let verdict = match failed {
        0 => format!("all {modes} modes agree"),
        failed => {
            format!(
                "{failed} of {} cases do not agree: prediction and run differ",
                record.cases.len()
            )
        }
    };
    format!(
        "{verdict}; max error {error}, allowed {}; {} particles, {} steps",
        significant(record.tolerance, 3),
        record.particles,
        record.steps
    )
}
