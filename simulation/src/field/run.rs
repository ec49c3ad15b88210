//! A scene in two or three dimensions, a method, and what comes of them.

use super::measures::{Measure, Meter};
use super::scene::{FieldFlow, FieldScene};
use super::shear_viscosity::shear_response;
use crate::march::refuse_too_many;
use crate::particles::{
    Domain, Gas, MethodOptions, PairForce, PairLoops, ParticleEvolution, ParticleSystem, Particles,
    Smoothing, SmoothingKernel, Task, ThermalState, dispatch, dot, table,
};
use crate::run::{InvalidOptions, Run};
use crate::scene::Material;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Measures are taken at so many equal intervals.
const SAMPLES: u32 = 60;

/// Particles in `D` dimensions: one column for each axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FieldProfile {
    /// Positions, inside the box.
    pub position: Vec<Vec<f64>>,
    /// Velocities.
    pub velocity: Vec<Vec<f64>>,
    /// Densities.
    pub density: Vec<f64>,
    /// Pressures.
    pub pressure: Vec<f64>,
    /// Specific internal energies; empty for an isothermal gas.
    pub energy: Vec<f64>,
    /// Smoothing lengths.
    pub smoothing: Vec<f64>,
}

impl FieldProfile {
    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.density.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.density.is_empty()
    }
}

/// `Σ|e_i|/N` over all particles against the exact solution; of the velocity, the length of the difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldErrors {
    /// Of the density.
    pub density: f64,
    /// Of the velocity.
    pub velocity: f64,
    /// Of the pressure.
    pub pressure: f64,
}

/// The measures at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The time.
    pub time: f64,
    /// The measures of the scene, always the same ones in the same order.
    pub measures: Vec<Measure>,
}

/// The result of a run. A run that broke down is a result too.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRun {
    /// The state at the start.
    pub initial: FieldProfile,
    /// The state at the end, and how the run came there.
    pub run: Run<FieldProfile>,
    /// Errors at the time reached; `None` where there is no exact solution.
    pub errors: Option<FieldErrors>,
    /// Measures at equal intervals of time, the start and the end included.
    pub history: Vec<Sample>,
    /// Measures at the end; of a shear also the viscosity that explains its decay, and the predicted one.
    pub measures: Vec<Measure>,
}

impl FieldRun {
    /// The measure of that name at the end.
    pub fn measure(&self, name: &str) -> Option<f64> {
        self.measures.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
    }
}

/// Runs a scene to its end time with about `particles` particles: whole periods of the lattice. `observe` is told the time after
/// every step and may end the run.
///
/// ```
/// use courant_simulation::field::{FieldScene, run_field};
/// use courant_simulation::particles::ParticleMethod;
/// use std::ops::ControlFlow;
/// let mut shear = FieldScene::named("shear").expect("it is in the list");
/// shear.end_time = 0.1;
/// let options = shear.options(ParticleMethod::Gph3);
/// let run = run_field(&shear, 400, &options, &mut |_| ControlFlow::Continue(()))?;
/// assert!(run.run.completed() && run.run.conservation.momentum < 1e-13);
/// // The Riemann problems brake the flow.
/// assert!(run.measure("kinetic_energy_left").is_some_and(|left| left < 0.95));
/// # Ok::<(), courant_simulation::run::InvalidOptions>(())
/// ```
///
/// # Errors
/// [`InvalidOptions`] when the run cannot start. A run that breaks down is no error: see [`Run::failure`].
pub fn run_field(
    scene: &FieldScene,
    particles: usize,
    options: &MethodOptions,
    observe: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<FieldRun, InvalidOptions> {
    options.check()?;
    if particles < 10 {
        return Err(InvalidOptions::Particles { particles, least: 10 });
    }
    if options.estimation.is_some() {
        return Err(InvalidOptions::Uncovered {
            method: options.method.name(),
            scene: scene.name.clone(),
            problem: "kernel estimation is for one dimension",
        });
    }
    let run = match scene.dimension {
        2 => dispatch(scene.gas, options, Plan::<2> { scene, particles, options, observe })?,
        _ => dispatch(scene.gas, options, Plan::<3> { scene, particles, options, observe })?,
    };
    Ok(with_viscosity(run, scene, particles, options))
}

struct Plan<'a, const D: usize> {
    scene: &'a FieldScene,
    particles: usize,
    options: &'a MethodOptions,
    observe: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
}

impl<const D: usize> Task<D> for Plan<'_, D> {
    type Output = Result<FieldRun, InvalidOptions>;

    fn run<G: Gas>(self, gas: G, force: Box<dyn PairLoops<D>>) -> Self::Output {
        let Self { scene, particles, options, observe } = self;
        let mut system = prepare::<D, G>(scene, particles, options, gas, &*force);
        // A failure shows up again at the first step.
        let _ = system.update_fields();
        let initial = profile(&system);
        let meter = Meter::new(scene, &system);
        let mut history = vec![Sample { time: 0.0, measures: meter.measure(&system, 0.0) }];
        let table = table(options.integrator)?;
        let mut evolution = ParticleEvolution::stepped(system, force, options, &table);
        refuse_too_many(&mut evolution, scene.end_time)?;
        let observe = |state: &ParticleEvolution<D, G>, time: f64| {
            let due = history.len() as f64 * scene.end_time / f64::from(SAMPLES);
            if time >= due * (1.0 - 1e-9) {
                history.push(Sample { time, measures: meter.measure(state.system(), time) });
            }
            observe(time)
        };
        let end = |state: &ParticleEvolution<D, G>| profile(state.system());
        let run = Run::of(&mut evolution, scene.end_time, observe, end);
        let errors = errors::<D>(scene, &run.profile, run.time);
        let measures = meter.measure(evolution.system(), run.time);
        Ok(FieldRun { initial, run, errors, history, measures })
    }
}

/// The particles of a scene at the start.
pub(super) fn prepare<const D: usize, G: Gas>(
    scene: &FieldScene,
    particles: usize,
    options: &MethodOptions,
    gas: G,
    force: &dyn PairForce,
) -> ParticleSystem<D, G> {
    let (lower, filling) =
        scene.fill::<D>(particles).expect("the dimension is that of the scene and its lattice");
    let count = filling.positions.len();
    let volume: f64 = (0..D).map(|axis| filling.upper[axis] - lower[axis]).product();
    let spacing = (volume / count as f64).powf(1.0 / D as f64);
    let kernel = SmoothingKernel::<D>::new(options.kernel);
    // The hot spot of an explosion is as wide as a kernel.
    let heat = |x: &[f64; D]| kernel.value(dot(x, x).sqrt(), options.eta * spacing);
    let heats: f64 = filling.positions.iter().map(heat).sum();
    let density = match scene.flow {
        FieldFlow::Shear { density, .. }
        | FieldFlow::Gresho { density, .. }
        | FieldFlow::Blast { density, .. } => density,
    };
    let mass = density * volume / count as f64;
    let solution = scene.solution();
    let state = |x: &[f64; D]| match (scene.flow, scene.gas) {
        (FieldFlow::Blast { density, energy, pressure }, Material::Ideal(ideal)) => {
            let hot = (ideal.gamma() - 1.0) * density * energy * heat(x) / (heats * mass);
            ([0.0; D], pressure + hot)
        }
        _ => {
            let exact = solution.at(*x, 0.0).expect("the other flows have a state at the start");
            (exact.velocity, exact.pressure)
        }
    };
    let states: Vec<([f64; D], f64)> = filling.positions.iter().map(state).collect();
    let particles = Particles {
        velocity: states.iter().map(|(velocity, _)| *velocity).collect(),
        mass: vec![mass; count],
        thermal: states.iter().map(|&(_, pressure)| gas.thermal(density, pressure)).collect(),
        smoothing: vec![options.eta * spacing; count],
        position: filling.positions,
    };
    let boundary = scene.boundary.as_slice().try_into().expect("a pair of ends for each axis");
    let domain = Domain { lower, upper: filling.upper, boundary };
    ParticleSystem::new(gas, particles, domain, kernel, Smoothing::adaptive(options.eta), force)
}

/// Adds what explains the decay of a shear.
fn with_viscosity(
    mut run: FieldRun,
    scene: &FieldScene,
    particles: usize,
    options: &MethodOptions,
) -> FieldRun {
    let response = shear_response(scene, particles, options);
    if let (Some(response), Some(left)) = (response, run.measure("amplitude_left")) {
        let wave = 2.0 * PI / (scene.domain[1][0] - scene.domain[0][0]);
        let time = run.run.time;
        if time > 0.0 && left > 0.0 {
            run.measures.push(("viscosity", -left.ln() / (wave * wave * time)));
        }
        run.measures.push(("viscosity_predicted", response.viscosity));
    }
    run
}

fn profile<const D: usize, G: Gas>(system: &ParticleSystem<D, G>) -> FieldProfile {
    let (state, domain) = (&system.particles, system.domain());
    let inside: Vec<_> = state.position.iter().map(|x| domain.wrap(x)).collect();
    let column = |of: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
        (0..D).map(|axis| (0..state.len()).map(|i| of(i, axis)).collect()).collect()
    };
    FieldProfile {
        position: column(&|i, axis| inside[i][axis]),
        velocity: column(&|i, axis| state.velocity[i][axis]),
        density: system.density().to_vec(),
        pressure: system.pressure().to_vec(),
        energy: state.thermal.iter().map_while(|thermal| thermal.energy()).collect(),
        smoothing: state.smoothing.clone(),
    }
}

fn errors<const D: usize>(
    scene: &FieldScene,
    profile: &FieldProfile,
    time: f64,
) -> Option<FieldErrors> {
    let count = profile.len();
    let solution = scene.solution();
    let mut sums = [0.0; 3];
    for i in 0..count {
        let x: [f64; D] = std::array::from_fn(|axis| profile.position[axis][i]);
        let exact = solution.at(x, time)?;
        let apart = |axis: usize| profile.velocity[axis][i] - exact.velocity[axis];
        sums[0] += (profile.density[i] - exact.density).abs();
        sums[1] += (0..D).map(|axis| apart(axis).powi(2)).sum::<f64>().sqrt();
        sums[2] += (profile.pressure[i] - exact.pressure).abs();
    }
    let [density, velocity, pressure] = sums.map(|sum| sum / count as f64);
    Some(FieldErrors { density, velocity, pressure })
}
