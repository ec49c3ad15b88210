//! A scene, a method, and what comes of them.

use super::domain::Domain;
use super::evolution::ParticleEvolution;
use super::gas::Gas;
use super::godunov::Godunov;
use super::integrator::{Nystrom, table};
use super::method::{
    InvalidMethodOptions, MethodOptions, ParticleMethod, SolverChoice, StepSharing,
};
use super::pair_force::PairForce;
use super::pair_weight::{Convolution, OwnKernels, Product, SumOfSquares};
use super::result::{Drift, Errors, ParticleRun, Penetration};
use super::scene::{Material, ParticleScene};
use super::smoothing_kernel::SmoothingKernel;
use super::system::{ParticleSystem, Particles};
use super::thermal::ThermalState;
use super::viscous::{PressureForm, Smoothed};
use crate::march::{Limits, march};
use crate::riemann::isothermal::{Expansion, Isothermal};
use crate::riemann::{ExactIdeal, StarSolver, Stopping, VanLeer};
use crate::run::Profile;
use std::ops::ControlFlow;

/// Runs a scene to its end time with `particles` particles (about that many: layers get whole ones).
///
/// ```
/// use courant_simulation::particles::{MethodOptions, ParticleMethod, ParticleScene, run_particles};
/// let scene = ParticleScene::named("isothermal-tube").expect("it is in the list");
/// let run = run_particles(&scene, 100, &MethodOptions::new(ParticleMethod::Gph3))?;
/// assert!(run.completed() && run.time == 0.17);
/// assert!(run.drift.momentum < 1e-13 && run.drift.energy.is_none());
/// assert_eq!(run.penetration.largest, 0);
/// # Ok::<(), courant_simulation::particles::InvalidMethodOptions>(())
/// ```
///
/// # Errors
/// [`InvalidMethodOptions`] when the run cannot start. A run that breaks down is no error: see
/// [`ParticleRun::failure`].
pub fn run_particles(
    scene: &ParticleScene,
    particles: usize,
    options: &MethodOptions,
) -> Result<ParticleRun, InvalidMethodOptions> {
    options.check()?;
    if particles < 10 {
        return Err(InvalidMethodOptions::Particles(particles));
    }
    let table = table(options.integrator)?;
    let run = (scene, particles, options, &table);
    Ok(match scene.material {
        Material::Isothermal(gas) => {
            let expansion = match options.solver {
                SolverChoice::Published => Expansion::AsShock,
                SolverChoice::Converged | SolverChoice::Exact => Expansion::Exact,
            };
            let solver = Isothermal { sound_speed: gas.sound_speed, expansion };
            with_solver(run, gas, solver)
        }
        Material::Ideal(gas) => {
            let van_leer = |stopping| VanLeer { gas, stopping };
            match options.solver {
                SolverChoice::Published => with_solver(run, gas, van_leer(Stopping::Published)),
                SolverChoice::Converged => with_solver(run, gas, van_leer(Stopping::Converged)),
                SolverChoice::Exact => with_solver(run, gas, ExactIdeal(gas)),
            }
        }
    })
}

/// A scene, how many particles, options, and the table of their integrator.
type Plan<'a> = (&'a ParticleScene, usize, &'a MethodOptions, &'a Nystrom<f64>);

fn with_solver<G: Gas, S: StarSolver>(plan: Plan<'_>, gas: G, solver: S) -> ParticleRun {
    let options = plan.2;
    let smoothed = |form| Smoothed { form, viscosity: options.viscosity };
    match options.method {
        ParticleMethod::Gph1 => evolve(plan, gas, Godunov { weight: SumOfSquares, solver }),
        ParticleMethod::Gph2 => evolve(plan, gas, Godunov { weight: Product, solver }),
        ParticleMethod::Gph3 => evolve(plan, gas, Godunov { weight: OwnKernels, solver }),
        ParticleMethod::Gph4 => {
            evolve(plan, gas, Godunov { weight: Convolution(options.volume), solver })
        }
        ParticleMethod::Sph1 => evolve(plan, gas, smoothed(PressureForm::Sum)),
        ParticleMethod::Sph2 => evolve(plan, gas, smoothed(PressureForm::Geometric)),
    }
}

fn evolve<G: Gas, F: PairForce>(
    (scene, particles, options, table): Plan<'_>,
    gas: G,
    force: F,
) -> ParticleRun {
    let system = prepare(scene, particles, options, gas, &force);
    let start = Totals::of(&system);
    let mut evolution = match options.sharing {
        StepSharing::Global => ParticleEvolution::global(system, force, table, options.courant),
        StepSharing::Block { levels } => {
            ParticleEvolution::blocks(system, force, levels, options.courant)
        }
    };
    let mut penetration = Penetration::default();
    let limits = Limits { steps: options.max_steps as usize };
    let march = march(&mut evolution, scene.end_time, limits, |state, _| {
        penetration.observe(&state.system().particles.position);
        ControlFlow::Continue(())
    });
    let (system, wall_impulse) = (evolution.system(), evolution.wall_impulse());
    let end = Totals::of(system);
    let profile = profile(system);
    let drift = Drift {
        mass: ((end.mass - start.mass) / start.mass).abs(),
        momentum: ((end.momentum - start.momentum - wall_impulse[0]) / start.momentum_scale).abs(),
        energy: start
            .energy
            .zip(end.energy)
            .map(|(before, after)| ((after - before) / before).abs()),
    };
    ParticleRun {
        errors: Errors::new(scene, &profile, march.time),
        profile,
        steps: evolution.substeps().unwrap_or(march.steps as u64),
        rejected: march.rejected,
        time: march.time,
        failure: march.failure,
        smoothing: system.particles.smoothing.clone(),
        drift,
        counters: system.counters,
        penetration,
    }
}

fn prepare<G: Gas, F: PairForce>(
    scene: &ParticleScene,
    particles: usize,
    options: &MethodOptions,
    gas: G,
    force: &F,
) -> ParticleSystem<1, G> {
    let placed = scene.place(particles);
    let states: Vec<_> = placed.iter().map(|&(x, _)| scene.initial(x)).collect();
    let particles = Particles {
        position: placed.iter().map(|&(x, _)| [x]).collect(),
        velocity: states.iter().map(|state| [state.velocity()]).collect(),
        mass: placed.iter().map(|&(_, mass)| mass).collect(),
        thermal: states.iter().map(|s| gas.thermal(s.density(), s.pressure())).collect(),
        smoothing: (placed.iter().zip(&states))
            .map(|((_, mass), state)| options.eta * mass / state.density())
            .collect(),
    };
    let [from, to] = scene.extent;
    ParticleSystem::new(
        gas,
        particles,
        Domain::new([from], [to], scene.boundary),
        SmoothingKernel::new(options.kernel),
        options.smoothing(scene.constant_smoothing),
        force,
    )
}

struct Totals {
    mass: f64,
    momentum: f64,
    momentum_scale: f64,
    energy: Option<f64>,
}

impl Totals {
    fn of<G: Gas>(system: &ParticleSystem<1, G>) -> Self {
        let state = &system.particles;
        // Σ m (|v| + √(2u) or c): what the momentum would be if everything moved one way.
        let momentum_scale = (0..state.len())
            .map(|i| {
                let spacing = state.smoothing[i];
                let thermal = system.gas.sound_speed(state.mass[i] / spacing, state.thermal[i]);
                state.mass[i] * (state.velocity[i][0].abs() + thermal)
            })
            .sum();
        Self {
            mass: state.mass.iter().sum(),
            momentum: system.momentum()[0],
            momentum_scale,
            energy: system.energy(),
        }
    }
}

fn profile<G: Gas>(system: &ParticleSystem<1, G>) -> Profile {
    let state = &system.particles;
    Profile {
        x: state.position.iter().map(|x| x[0]).collect(),
        density: system.density().to_vec(),
        velocity: state.velocity.iter().map(|v| v[0]).collect(),
        pressure: system.pressure().to_vec(),
        energy: state.thermal.iter().map_while(|thermal| thermal.energy()).collect(),
    }
}
