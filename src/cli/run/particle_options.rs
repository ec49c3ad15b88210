//! Particle methods and their options, alike for scenes in one, two and three dimensions.

use super::Arguments;
use super::choices::one;
use crate::cli::Failure;
use courant::analysis::exact::rational::{to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::reports::number::exact_text;
use courant::simulation::particles::{MethodOptions, ParticleMethod};
use courant::simulation::run::InvalidOptions;

/// The choices that a method leaves open.
pub fn accepted(method: ParticleMethod) -> &'static [&'static str] {
    match method.is_godunov() {
        true => &["--riemann", "--integrator", "--work", "--pair-work"],
        false => &["--alpha", "--beta", "--integrator", "--work"],
    }
}

/// Puts what was asked for in the place of what is customary.
pub fn choose(arguments: &Arguments, options: &mut MethodOptions) -> Result<(), Failure> {
    let choices = &arguments.choices;
    choices.only(accepted(options.method), options.method.name())?;
    if let Some(kernel) = arguments.kernel() {
        options.kernel = kernel;
        if kernel == Kernel::Gaussian && options.estimation.is_none() {
            // The ratio that keeps lattice points off the cut, as for the method that brings it.
            options.eta = MethodOptions::new(ParticleMethod::Gph4).eta;
        }
    }
    options.eta = arguments.ratio().map_or(options.eta, to_f64);
    options.courant = arguments.cfl().map_or(options.courant, to_f64);
    options.integrator = choices.integrator(options.integrator);
    options.work = choices.work(options.work);
    options.pair_work = choices.pair_work(options.pair_work);
    options.solver = choices.solver(options.solver);
    options.viscosity.alpha = choices.alpha(options.viscosity.alpha);
    options.viscosity.beta = choices.beta(options.viscosity.beta);
    Ok(())
}

/// The smoothing length over the spacing, as it was typed.
pub fn ratio(arguments: &Arguments, used: f64) -> String {
    arguments.ratio().map_or_else(|| exact_text(used), to_text)
}

/// An error of the simulation by the option that brought it.
pub fn invalid(error: &InvalidOptions, arguments: &Arguments, method: &str) -> Failure {
    Failure::Message(match error {
        InvalidOptions::Lattice(error) => {
            let ratio = arguments.ratio().map_or_else(String::new, to_text);
            format!("--ratio {ratio}: {error}")
        }
        InvalidOptions::Kernel(kernel) => format!(
            "--kernel {kernel}: gph4 has a closed form for the gaussian only; accepted: gaussian"
        ),
        InvalidOptions::Particles { particles, least } => {
            format!(
                "--particles {particles}: {method} needs at least {least} for {}",
                arguments.scene()
            )
        }
        InvalidOptions::NotPositive { name, value } => {
            format!("--{name} {value}: it must be above 0")
        }
        InvalidOptions::BlockIntegrator(name) => {
            format!("--integrator {name}: --levels needs centred-euler")
        }
        InvalidOptions::TooMuch { what, .. } => {
            // What asks for it, of what was given.
            let asking = [
                ("--time", arguments.time()),
                ("--periods", one(&arguments.advection.periods)),
                ("--cfl", arguments.cfl().filter(|_| what.starts_with("steps"))),
            ];
            let asking = asking.into_iter();
            let mut given: Vec<String> = asking
                .filter_map(|(option, value)| Some(format!("{option} {}", to_text(value?))))
                .collect();
            given.extend(arguments.particles().map(|particles| format!("--particles {particles}")));
            match given.is_empty() {
                false => format!("{}: {error}", given.join(", ")),
                true => format!("SCENE {}, --method {method}: {error}", arguments.scene()),
            }
        }
        other => format!("--method {method}: {other}"),
    })
}
