//! `courant validate`: predicted against measured, mode by mode.

mod advection;
mod equations;
mod particles;

use super::numbers::Numbers;
use super::output::Format;
use super::subject::{Defaults, Kind, Subject, SubjectOptions};
use super::{Failure, Outcome, numbers};
use clap::Args;
use courant::analysis::exact::rational::{Rational, integer, ratio};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::catalogue;
use courant::simulation::advection::AdvectionScheme;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    /// Values of the parameter whose limit is sought (default: half the stability limit, the limit, and one and a half times it; for
    /// particle methods c Δt/h = 0.25).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::courant_numbers)]
    cfl: Option<Numbers>,
    /// Cells or particles on the ring (default: 200; particle methods and equations 32).
    #[arg(long, alias = "cells", value_name = "N", value_parser = ring)]
    particles: Option<usize>,
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

/// The transform of a ring takes as many operations as it has particles, squared.
fn ring(text: &str) -> Result<usize, String> {
    numbers::count(text, 4, 10_000)
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
    let defaults = Defaults { kernels, ratios: vec![ratio], schemes, integrators, published: true };
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
