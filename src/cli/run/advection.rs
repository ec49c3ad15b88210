//! Options of the advection scenes, and what they make of one.

use super::Arguments;
use super::choices::one;
use crate::cli::numbers::{Names, Numbers};
use crate::cli::{Failure, numbers};
use clap::{Args, ValueEnum};
use courant::analysis::exact::rational::{Rational, integer, to_f64};
use courant::analysis::kernel::Kernel;
use courant::simulation::advection::{
    AdvectionScene, AdvectionScheme, Discretisation, Layout, RunPlan,
};
use courant::simulation::scene::Quantity;

/// Options of the advection scenes alone.
#[derive(Debug, Clone, Args)]
pub struct Options {
    /// Advection: end time in periods, in each of which everything goes once round (default: the time of the scene).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = numbers::running_positive, conflicts_with = "time")]
    pub periods: Option<Numbers>,
    /// Advection: where the particles are and which code steps them (default: uniform).
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub layout: Vec<LayoutName>,
    /// Advection, disordered layout: the largest displacement in spacings, below 1/2 (default: 1/10).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = disorders)]
    pub disorder: Option<Numbers>,
    /// Advection: seed of the displacements and of the random phases (default: 0).
    #[arg(long, value_name = "LIST", value_parser = |text: &str| numbers::names(text, numbers::seed))]
    pub seed: Option<Names<u64>>,
    /// Advection, scene advection-waves: the highest wave number, at most half the particles (default: 8).
    #[arg(long, value_name = "LIST", value_parser = wave_numbers)]
    pub waves: Option<Names<usize>>,
}

/// Layouts by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LayoutName {
    /// Equal spacing, stepped by the stencil.
    Lattice,
    /// Equal spacing, neighbours found among the particles.
    Uniform,
    /// Random displacements, neighbours found among the particles.
    Disordered,
}

impl Options {
    /// Its options, and whether they were given.
    pub fn given(&self) -> [(&'static str, bool); 5] {
        [
            ("--periods", self.periods.is_some()),
            ("--layout", !self.layout.is_empty()),
            ("--disorder", self.disorder.is_some()),
            ("--seed", self.seed.is_some()),
            ("--waves", self.waves.is_some()),
        ]
    }
}

fn disorders(text: &str) -> Result<Numbers, String> {
    let below_half = |value: &Rational| to_f64(value) < 0.5;
    let numbers = numbers::running_non_negative(text)?;
    let fits = numbers.0.iter().all(below_half);
    if fits { Ok(numbers) } else { Err("it must be at least 0 and below 1/2".into()) }
}

fn wave_numbers(text: &str) -> Result<Names<usize>, String> {
    numbers::counts(text, 1, 100_000)
}

/// The arguments as a plan.
pub fn plan(
    arguments: &Arguments,
    scene: &AdvectionScene,
    method: &str,
) -> Result<RunPlan, Failure> {
    let options = &arguments.advection;
    let scheme = method.parse().expect("the name is one of these schemes");
    arguments.choices.only(&[], "an advection scheme")?;
    let mut scene = scene.clone();
    if let Some(periods) = one(&options.periods) {
        scene.end_time = to_f64(periods) * scene.length() / scene.velocity.abs();
    }
    let particles = arguments.particles().unwrap_or(scene.particles);
    let noisy = put_waves(options, &mut scene, particles)?;
    let not_used = |option: &str, value: String, reason: &str| {
        Err(Failure::Message(format!("{option} {value}: {reason}")))
    };
    let seed = one(&options.seed).copied();
    let layout = options.layout.first().copied().unwrap_or(LayoutName::Uniform);
    if layout != LayoutName::Disordered {
        if let Some(disorder) = one(&options.disorder) {
            let reason = "it needs --layout disordered";
            return not_used("--disorder", disorder.to_string(), reason);
        }
        if let (Some(seed), false) = (seed, noisy) {
            let reason = "nothing is random here; it needs --layout disordered or advection-waves";
            return not_used("--seed", seed.to_string(), reason);
        }
    }
    let layout = match layout {
        LayoutName::Lattice => Layout::Lattice,
        LayoutName::Uniform => Layout::Uniform,
        LayoutName::Disordered => Layout::Disordered {
            disorder: one(&options.disorder).map_or(0.1, to_f64),
            seed: seed.unwrap_or(0),
        },
    };
    // Euler-SPH is stable at no Courant number; with small steps a period can still be looked at.
    let default_courant = match scheme {
        AdvectionScheme::EulerSph => 0.1,
        AdvectionScheme::LaxWendroffSph | AdvectionScheme::GodunovSph => 1.0,
    };
    let ratio = arguments.ratio().cloned().unwrap_or_else(|| integer(2));
    let kernel = arguments.kernel().unwrap_or(Kernel::CubicSpline);
    let discretisation = Discretisation::new(scheme, kernel, ratio)
        .map_err(|error| Failure::Message(format!("--ratio: {error}")))?;
    let courant_number = arguments.cfl().map_or(default_courant, to_f64);
    Ok(RunPlan { scene, discretisation, courant_number, particles, layout })
}

/// Puts --waves and --seed into the noise of a scene; whether it has one.
fn put_waves(
    options: &Options,
    scene: &mut AdvectionScene,
    particles: usize,
) -> Result<bool, Failure> {
    // Two particles per wave: a shorter one looks like a longer one on them.
    let shortest = particles / 2;
    let refuse = |waves, reason| Err(Failure::Message(format!("--waves {waves}: {reason}")));
    let mut noisy = false;
    for piece in &mut scene.profile {
        let Quantity::Noise { waves, seed, .. } = &mut piece.value else { continue };
        noisy = true;
        match one(&options.waves).copied() {
            Some(asked) if asked > shortest => {
                let reason = format!("{particles} particles carry waves up to number {shortest}");
                return refuse(asked, reason);
            }
            Some(asked) => *waves = asked,
            None => *waves = shortest.min(*waves),
        }
        *seed = one(&options.seed).copied().unwrap_or(*seed);
    }
    match one(&options.waves).copied() {
        Some(waves) if !noisy => {
            refuse(waves, "only a scene with noise, advection-waves, has waves to count".into())
        }
        _ => Ok(noisy),
    }
}
