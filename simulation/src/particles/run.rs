//! A scene, a method, and what comes of them.

use super::dispatch::{Task, dispatch};
use super::domain::Domain;
use super::evolution::ParticleEvolution;
use super::gas::Gas;
use super::integrator::{Nystrom, table};
use super::method::{InvalidMethodOptions, MethodOptions, StepSharing};
use super::pair_force::PairForce;
use super::result::{Drift, Errors, ParticleRun, Penetration};
use super::scene::ParticleScene;
use super::smoothing_kernel::SmoothingKernel;
use super::system::{ParticleSystem, Particles};
use super::thermal::ThermalState;
use crate::march::{Limits, march};
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
    Ok(dispatch(scene.material, options, Plan { scene, particles, options, table: &table }))
}

struct Plan<'a> {
    scene: &'a ParticleScene,
    particles: usize,
    options: &'a MethodOptions,
    table: &'a Nystrom<f64>,
}

impl Task for Plan<'_> {
    type Output = ParticleRun;

    fn run<G: Gas, F: PairForce>(self, gas: G, force: F) -> ParticleRun {
        evolve(self, gas, force)
    }
}

fn evolve<G: Gas, F: PairForce>(
    Plan { scene, particles, options, table }: Plan<'_>,
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
