//! `courant curves`.

mod cases;
mod metrics;
mod phases;
mod picture;
mod rows;

use super::output::{Format, paragraphs, print, print_json, table_text};
use super::subject::{Label, SubjectOptions, assumptions, varying};
use super::{Failure, Outcome, numbers};
use cases::{Case, Direction, cases, directions};
use clap::Args;
use courant::analysis::exact::rational::{Rational, to_f64};
use courant::analysis::waves::branches::{Branch, Branches};
use courant::analysis::waves::resolution::Resolution;
use courant::reports::publish::OutputDirectory;
use courant::reports::record::SubjectRecord;
use phases::{Degrees, Phases};
use rayon::prelude::*;
use serde::Serialize;
use std::path::PathBuf;

/// Waves of a curve where nobody says.
const WAVES: usize = 128;
/// Curves of one figure at most.
const MOST_CURVES: usize = 64;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    /// Phases in radians per cell, from above 0 to pi: pi/64:pi:pi/64 or 0.1,pi/2; in several dimensions the length of the wave vector
    /// (default: 128 of them down to the shortest wave).
    #[arg(long, alias = "kappa", value_name = "RANGE", allow_hyphen_values = true, value_parser = phases::phases)]
    phase: Option<Phases>,
    /// Directions of the wave vector in two dimensions, in degrees from the first axis (default: 0,15,30,45).
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = phases::degrees)]
    direction: Option<Degrees>,
    /// Also the points per wavelength that keep the errors after so many wavelengths travelled.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = numbers::positive)]
    wavelengths: Option<Rational>,
    /// What the equation does in one step, for schemes that do not say it: the exponent, such as -I*C*phi or ±I*C*phi (default: the file's,
    /// or what the scheme does at long waves).
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    exact: Option<String>,
    /// Directory for the files: figure as PNG and SVG, all waves as CSV and NPY.
    #[arg(long, default_value = "courant-out")]
    out: PathBuf,
    /// Format of the metrics on standard output; json has all waves too.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

impl Arguments {
    fn wavelengths(&self) -> Option<f64> {
        self.wavelengths.as_ref().map(to_f64)
    }
}

/// One subject along one direction.
pub struct Curve {
    record: SubjectRecord,
    labels: Vec<Label>,
    direction: Direction,
    branches: Vec<Branch>,
    resolution: Option<Resolution>,
}

#[derive(Debug, Serialize)]
struct Answer<'a> {
    /// What the numbers are measured in.
    units: &'static str,
    rows: Vec<rows::Row<'a>>,
    metrics: Vec<metrics::Metrics<'a>>,
    files: Vec<String>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let cases = cases(arguments)?;
    let directions = directions(arguments, cases[0].branches.dimension())?;
    let count = cases.len() * directions.len();
    if count > MOST_CURVES {
        return Err(Failure::Message(format!(
            "the lists make {count} curves; one figure takes at most {MOST_CURVES}"
        )));
    }
    within_reach(arguments, &directions)?;
    let pairs: Vec<(&Case, &Direction)> =
        cases.iter().flat_map(|case| directions.iter().map(move |along| (case, along))).collect();
    let curves: Vec<Curve> =
        pairs.into_par_iter().map(|(case, along)| curve(arguments, case, along)).collect();
    let labels: Vec<Vec<Label>> = cases.iter().map(Case::labels).collect();
    let varying = varying(&labels);
    let svg = picture::figure(&cases, &curves, &labels, &varying).svg()?;
    let stem = picture::stem(&labels);
    let mut files =
        vec![(format!("{stem}.png"), svg.png()?), (format!("{stem}.svg"), svg.0.as_bytes().into())];
    files.extend(rows::files(&curves, &stem));
    let output = OutputDirectory::open(&arguments.out)?;
    let mut written = Vec::new();
    for (name, bytes) in files {
        written.push(output.write(&name, &bytes)?.display().to_string());
    }
    let table = metrics::of_format(arguments, &curves, &varying, arguments.format);
    match table_text(&table, arguments.format) {
        Some(text) if arguments.format == Format::Table => {
            let mut remarks = assumptions(cases.iter().map(|case| &case.subject));
            if cases.iter().any(Case::is_exact_in_time) {
                remarks.push("without an integrator: exact in time".into());
            }
            remarks.extend(cases.iter().filter_map(|case| {
                let why = case.without_exact.as_ref()?;
                Some(format!("{}: no errors: {why}", case.subject.file.name))
            }));
            remarks.extend(written);
            print(&(text + &paragraphs(&remarks)))
        }
        Some(text) => print(&text),
        None => {
            let units = "phase in radians per cell, argument in radians per step, speeds over those of the equation";
            let metrics = curves.iter().map(|curve| metrics::metrics(arguments, curve)).collect();
            let rows = rows::rows(&curves).collect();
            print_json("curves", &Answer { units, rows, metrics, files: written })
        }
    }
}

/// No phase beyond the shortest wave of a direction.
fn within_reach(arguments: &Arguments, directions: &[Direction]) -> Result<(), Failure> {
    let Some(longest) = arguments.phase.as_ref().and_then(|phases| phases.0.last()) else {
        return Ok(());
    };
    for along in directions {
        let shortest = Branches::shortest(&along.vector);
        if *longest > shortest + 1e-9 {
            let place = if along.name.is_empty() {
                String::new()
            } else {
                format!(" along {}", along.name)
            };
            return Err(Failure::Message(format!(
                "--phase: {longest} is beyond the shortest wave{place}: at most {shortest}"
            )));
        }
    }
    Ok(())
}

fn curve(arguments: &Arguments, case: &Case, along: &Direction) -> Curve {
    let shortest = Branches::shortest(&along.vector);
    let usual = || (1..=WAVES).map(|k| shortest * k as f64 / WAVES as f64).collect();
    let phases: Vec<f64> = arguments.phase.as_ref().map_or_else(usual, |phases| phases.0.clone());
    let wavelengths = arguments.wavelengths().unwrap_or(1.0);
    Curve {
        record: case.subject.record(&case.step, None),
        labels: case.labels(),
        direction: along.clone(),
        branches: case.branches.along(&along.vector, &phases),
        resolution: case.branches.resolution(&along.vector, wavelengths),
    }
}
