//! `courant validate`: predicted against measured, mode by mode.

mod advection;
mod equations;
mod particles;

use super::columns::{empty, number, subject_cells, subject_columns};
use super::numbers::Numbers;
use super::output::Format;
use super::subject::{Defaults, Kind, Subject, SubjectOptions};
use super::{Failure, Outcome, numbers};
use clap::Args;
use courant::analysis::exact::rational::{Rational, integer, ratio};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::catalogue;
use courant::reports::number::finite;
use courant::reports::record::SubjectRecord;
use courant::reports::table::Table;
use courant::simulation::advection::AdvectionScheme;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    /// Values of the parameter whose limit is sought (default: half the stability limit, the limit, and one and a half times it; for
    /// particle methods c Δt/h = 0.25).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::courant_numbers)]
    cfl: Option<Numbers>,
    /// Cells or particles on the ring (default: 200; particle methods and equations 32); in two and three dimensions along each axis:
    /// one number for all or 12x10 (default), 6x5x4.
    #[arg(long, alias = "cells", value_name = "N", value_parser = cells)]
    particles: Option<Cells>,
    /// Steps of each run (default: 100; waves of particle methods 200).
    #[arg(long, value_name = "N", value_parser = steps)]
    steps: Option<u64>,
    /// Add this to the coefficient of the upwind neighbour in the stepping code, to see the check fail.
    #[arg(long, value_parser = numbers::number, allow_hyphen_values = true, hide = true)]
    fault: Option<Rational>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// How many cells along each axis.
#[derive(Debug, Clone)]
struct Cells(Vec<usize>);

/// The transform takes as many operations as there are cells, squared.
const MOST_CELLS: usize = 10_000;

fn cells(text: &str) -> Result<Cells, String> {
    let along = |text: &str| numbers::count(text.trim(), 4, MOST_CELLS);
    let axes: Vec<usize> = text.split(['x', '×']).map(along).collect::<Result<_, _>>()?;
    match axes.iter().try_fold(1usize, |all, axis| all.checked_mul(*axis)) {
        Some(..=MOST_CELLS) if axes.len() <= 3 => Ok(Cells(axes)),
        _ => Err(format!("up to three numbers, in all {MOST_CELLS} cells, are accepted")),
    }
}

impl Cells {
    /// In so many dimensions: a single number is meant for every axis.
    fn along(&self, dimension: usize) -> Result<Vec<usize>, Failure> {
        let axes = match self.0.as_slice() {
            [one] => vec![*one; dimension],
            several => several.to_vec(),
        };
        let all: usize = axes.iter().product();
        if axes.len() == dimension && all <= MOST_CELLS {
            return Ok(axes);
        }
        let given = self.0.iter().map(usize::to_string).collect::<Vec<_>>().join("x");
        Err(Failure::Message(format!(
            "--particles {given}: in {dimension} dimension{} one number for each axis, in all up to {MOST_CELLS} cells, or one for all axes is accepted",
            if dimension == 1 { "" } else { "s" }
        )))
    }
}

impl Arguments {
    /// How many particles along a line.
    fn on_line(&self) -> Result<Option<usize>, Failure> {
        self.particles.as_ref().map(|cells| Ok(cells.along(1)?[0])).transpose()
    }
}

/// A multiplier of one wave for machines: the columns are the same for every subject.
struct Measured<'a> {
    subject: &'a SubjectRecord,
    cfl: f64,
    /// One number, in more dimensions several, as the phase.
    mode: String,
    phase: String,
    branch: String,
    /// Which of several running codes.
    code: &'a str,
    /// Gain and phase.
    predicted: [f64; 2],
    measured: [f64; 2],
    error: f64,
    tolerance: f64,
}

fn csv_table<'a>(rows: impl Iterator<Item = Measured<'a>>) -> Table {
    let own = [
        "cfl",
        "mode",
        "phase",
        "branch",
        "code",
        "predicted_gain",
        "predicted_phase",
        "measured_gain",
        "measured_phase",
        "error",
        "tolerance",
    ];
    let columns: Vec<String> = subject_columns().chain(own.map(String::from)).collect();
    let mut table = empty(&columns);
    for row in rows {
        let mut cells = subject_cells(row.subject);
        cells.extend([row.cfl.to_string(), row.mode, row.phase, row.branch, row.code.into()]);
        let numbers = row.predicted.into_iter().chain(row.measured);
        cells.extend(numbers.chain([row.error, row.tolerance]).map(|x| number(finite(x))));
        table.push(cells);
    }
    table
}

fn steps(text: &str) -> Result<u64, String> {
    numbers::count(text, 1, 1_000_000).map(|count| count as u64)
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let method = arguments.subject.is_method();
    let ratio = if method { ratio(6, 5) } else { integer(2) };
    let kernels = Kernel::ALL.to_vec();
    // Without a subject those that the program ships running codes for.
    let schemes = (!arguments.subject.is_named())
        .then(|| AdvectionScheme::ALL.map(AdvectionScheme::name).join(","));
    let integrators = method.then(|| catalogue::PARTICLE_INTEGRATORS.join(","));
    let defaults = Defaults {
        kernels,
        ratios: vec![ratio],
        schemes,
        integrators,
        published: true,
        ..Defaults::default()
    };
    let subjects = arguments.subject.subjects(&defaults)?;
    let running = |subject: &Subject| {
        subject.kind == Kind::Scheme && subject.file.name.parse::<AdvectionScheme>().is_ok()
    };
    if method {
        return particles::run(arguments, &subjects);
    }
    if subjects.iter().all(running) {
        return advection::run(arguments, &subjects);
    }
    equations::run(arguments, &subjects)
}
