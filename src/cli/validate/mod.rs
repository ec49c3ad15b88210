//! `courant validate`: predicted against measured, mode by mode.

mod advection;
mod particles;

use super::numbers::{Names, Numbers};
use super::output::Format;
use super::waves::MethodName;
use super::{Failure, Outcome, names, numbers};
use clap::Args;
use courant::analysis::exact::rational::Rational;
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::AdvectionScheme;

#[derive(Debug, Args)]
pub struct Arguments {
    /// Scheme: euler-sph, lax-wendroff-sph, godunov-sph (default: all three).
    #[arg(long, value_parser = names::scheme)]
    scheme: Option<AdvectionScheme>,
    /// Particle method instead of a scheme: sph, sph-av, gph.
    #[arg(long, value_parser = particles::method, conflicts_with = "scheme")]
    method: Option<MethodName>,
    /// Options of particle methods.
    #[command(flatten)]
    particle: particles::Options,
    /// Kernels, separated by commas: see `courant list kernels` (default: all).
    #[arg(long, value_parser = |text: &str| numbers::names(text, names::kernel))]
    kernel: Option<Names<Kernel>>,
    /// Smoothing ratios l/Δξ: 1,2,3 or 1:10:0.5 or 3/2, read exactly (default: 2; particle methods 6/5).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list)]
    ratio: Option<Numbers>,
    /// Courant number (default: half the stability limit, the limit, and one and a half times it); for particle
    /// methods c Δt/h (default: 0.25).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::positive)]
    cfl: Option<Rational>,
    /// Particles on the ring (default: 200; particle methods 32).
    #[arg(long, value_name = "N", value_parser = ring)]
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
    match arguments.method {
        Some(method) => particles::run(arguments, method),
        None => {
            arguments.particle.reject()?;
            advection::run(arguments)
        }
    }
}
