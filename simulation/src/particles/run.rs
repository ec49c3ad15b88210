//! A scene, a method, and what comes of them.

use super::block_steps::BlockStepper;
use super::domain::Domain;
use super::gas::Gas;
use super::godunov::Godunov;
use super::integrator::{Nystrom, Stepper, table};
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
use crate::riemann::isothermal::{Expansion, Isothermal};
use crate::riemann::{ExactIdeal, StarSolver, Stopping, VanLeer};
use crate::run::{Failure, Profile, Reason, SMALLEST_STEP};

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
        ParticleMethod::Gph1 => evolve(plan, gas, &Godunov { weight: SumOfSquares, solver }),
        ParticleMethod::Gph2 => evolve(plan, gas, &Godunov { weight: Product, solver }),
        ParticleMethod::Gph3 => evolve(plan, gas, &Godunov { weight: OwnKernels, solver }),
        ParticleMethod::Gph4 => {
            evolve(plan, gas, &Godunov { weight: Convolution(options.volume), solver })
        }
        ParticleMethod::Sph1 => evolve(plan, gas, &smoothed(PressureForm::Sum)),
        ParticleMethod::Sph2 => evolve(plan, gas, &smoothed(PressureForm::Geometric)),
    }
}

fn evolve<G: Gas, F: PairForce>(
    (scene, particles, options, table): Plan<'_>,
    gas: G,
    force: &F,
) -> ParticleRun {
    let mut system = prepare(scene, particles, options, gas, force);
    let start = Totals::of(&system);
    let mut clock =
        Clock { scene, options, time: 0.0, steps: 0, penetration: Penetration::default() };
    let (outcome, wall_impulse) = match options.sharing {
        StepSharing::Global => {
            let mut stepper = Stepper::new(table.clone());
            let outcome = clock.global(&mut system, force, &mut stepper);
            (outcome, stepper.wall_impulse)
        }
        StepSharing::Block { levels } => {
            let mut stepper = BlockStepper::new(levels);
            let outcome = clock.blocks(&mut system, force, &mut stepper);
            (outcome, stepper.wall_impulse)
        }
    };
    // The fields belong to the last evaluation; the profile to the end.
    let failure = outcome.and_then(|()| system.update_fields()).err().map(|reason| Failure {
        reason,
        time: clock.time,
        step: clock.steps as usize + 1,
    });
    let end = Totals::of(&system);
    let profile = profile(&system);
    let drift = Drift {
        mass: ((end.mass - start.mass) / start.mass).abs(),
        momentum: ((end.momentum - start.momentum - wall_impulse[0]) / start.momentum_scale).abs(),
        energy: start
            .energy
            .zip(end.energy)
            .map(|(before, after)| ((after - before) / before).abs()),
    };
    ParticleRun {
        errors: Errors::new(scene, &profile, clock.time),
        profile,
        steps: clock.steps,
        time: clock.time,
        failure,
        smoothing: system.particles.smoothing.clone(),
        drift,
        counters: system.counters,
        penetration: clock.penetration,
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

struct Clock<'a> {
    scene: &'a ParticleScene,
    options: &'a MethodOptions,
    time: f64,
    steps: u64,
    penetration: Penetration,
}

impl Clock<'_> {
    fn global<G: Gas, F: PairForce>(
        &mut self,
        system: &mut ParticleSystem<1, G>,
        force: &F,
        stepper: &mut Stepper<1, G::Thermal>,
    ) -> Result<(), Reason> {
        let end = self.scene.end_time;
        while self.time < end {
            stepper.begin(system, force)?;
            let wanted = self.options.courant * stepper.crossing_time(system);
            if wanted.is_nan() || wanted < SMALLEST_STEP * end {
                return Err(Reason::TimeStep { value: wanted });
            }
            // Two equal last steps rather than a whole one and a sliver.
            let left = end - self.time;
            let step = if left <= wanted {
                left
            } else if left <= 2.0 * wanted {
                0.5 * left
            } else {
                wanted
            };
            stepper.step(system, force, step)?;
            self.time = if left <= wanted { end } else { self.time + step };
            self.tick(system)?;
        }
        Ok(())
    }

    fn blocks<G: Gas, F: PairForce>(
        &mut self,
        system: &mut ParticleSystem<1, G>,
        force: &F,
        stepper: &mut BlockStepper<1, G::Thermal>,
    ) -> Result<(), Reason> {
        let end = self.scene.end_time;
        while self.time < end {
            let left = end - self.time;
            let length = stepper.block(system, force, self.options.courant, left)?;
            self.time = if length == left { end } else { self.time + length };
            self.steps = stepper.substeps - 1;
            self.tick(system)?;
        }
        Ok(())
    }

    fn tick<G: Gas>(&mut self, system: &ParticleSystem<1, G>) -> Result<(), Reason> {
        self.steps += 1;
        self.penetration.observe(&system.particles.position);
        if self.steps >= self.options.max_steps && self.time < self.scene.end_time {
            return Err(Reason::StepLimit { limit: self.options.max_steps as usize });
        }
        Ok(())
    }
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
