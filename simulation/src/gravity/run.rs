//! The run of a cloud, and what comes of it.

use super::cloud::Cloud;
use super::measures::WaveMeasures;
use super::self_gravity::SelfGravity;
use super::sink::{Sink, cross};
use super::sphere::{ball, relax};
use crate::boundary::Boundary;
use crate::march::{MOST_STEPS, march, refuse_too_many};
use crate::particles::{
    Domain, Gas, Integrator, MethodOptions, PairLoops, PairWork, ParticleEvolution, ParticleSystem,
    Particles, Smoothing, SmoothingKernel, StepSharing, Task, ThermalState, Vector, dispatch, dot,
    plus_scaled, table,
};
use crate::run::{Conservation, Counters, InvalidOptions, Penetration, Promise, Run};
use std::ops::ControlFlow;

/// The gas at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// The time simulated.
    pub time: f64,
    /// Positions of the particles, from where the centre was.
    pub position: Vec<Vector<3>>,
    /// Their velocities.
    pub velocity: Vec<Vector<3>>,
    /// Their densities.
    pub density: Vec<f64>,
    /// The sink.
    pub sink: Option<Sink>,
    /// Mass of a particle.
    pub particle_mass: f64,
}

/// The energies of the whole cloud.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energies {
    /// The time simulated.
    pub time: f64,
    /// Of the motion, that of the sink included.
    pub kinetic: f64,
    /// Internal energy; `None` for an isothermal gas.
    pub thermal: Option<f64>,
    /// Of the attraction; with what particles had when the sink took them.
    pub potential: f64,
}

impl Energies {
    /// Their sum, conserved where there is an energy equation and a vacuum outside.
    pub fn total(&self) -> Option<f64> {
        self.thermal.map(|thermal| self.kinetic + thermal + self.potential)
    }
}

/// What a run leaves behind.
#[derive(Debug, Clone, PartialEq)]
pub struct CloudRun {
    /// How the run went. Drifts: of the mass of gas and sink, of the momentum over `√(G M³/R)`, of the energy where it is
    /// conserved.
    pub run: Run<()>,
    /// Time and mass of the sink, after every step.
    pub core: Vec<[f64; 2]>,
    /// Energies at the start, at the end, and, where there is an energy equation, about [`SAMPLES`] times between.
    pub energies: Vec<Energies>,
    /// The least that the entropy `P/ρ^γ` of a particle has been, where energies were summed up, over its own at the start, where there is an
    /// energy equation and no sink: no gas falls below one.
    pub least_entropy: Option<f64>,
    /// The gas at the times asked for, and at the end.
    pub snapshots: Vec<Snapshot>,
    /// The expansion wave, if the run came to it.
    pub wave: Option<WaveMeasures>,
    /// Total angular momentum at the end, over `√(G M³ R)`.
    pub angular_momentum: f64,
}

/// How often energies are summed up in a run.
pub const SAMPLES: usize = 50;
/// Steps of the relaxation of a cloud in equilibrium.
const RELAXATION_STEPS: usize = 60;

/// Runs a cloud to its end time. `snapshots` are times at which the gas is kept (the first step that reaches each), and
/// `observe` hears the time simulated.
///
/// # Errors
/// [`InvalidOptions`] when the run cannot start. A run that breaks down is no error: see [`Run::failure`].
pub fn run_cloud(
    cloud: &Cloud,
    particles: usize,
    options: &MethodOptions,
    snapshots: &[f64],
    observe: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<CloudRun, InvalidOptions> {
    options.check()?;
    if particles < 100 {
        return Err(InvalidOptions::Particles { particles, least: 100 });
    }
    dispatch(cloud.material, options, Plan { cloud, particles, options, snapshots, observe })
}

/// The options of a method with what is customary for a cloud: about 50 neighbours, 0.4 of the crossing time, and for an
/// isothermal gas block steps of at most eight halvings. A gas that heats up as its centre collapses shares one
/// step: blocks cannot follow a bounce that begins inside them. Pairs that would work at `v*` share their heat. Both steps are first order in time, the paper's SPH is of second.
pub fn cloud_options(cloud: &Cloud, mut options: MethodOptions) -> MethodOptions {
    let levels = if cloud.sound_speed().is_some() { 8 } else { 0 };
    options.eta = 1.145;
    options.sharing = StepSharing::Block { levels };
    options.integrator = Integrator::named("centred-euler").expect("it is in the catalogue");
    options.courant = 0.4;
    if options.pair_work == PairWork::Star {
        // It would take the heat from where gravity holds a high pressure.
        options.pair_work = PairWork::Shared;
    }
    options
}

struct Plan<'a> {
    cloud: &'a Cloud,
    particles: usize,
    options: &'a MethodOptions,
    snapshots: &'a [f64],
    observe: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
}

impl Task<3> for Plan<'_> {
    type Output = Result<CloudRun, InvalidOptions>;

    fn run<G: Gas>(self, gas: G, force: Box<dyn PairLoops<3>>) -> Self::Output {
        let mut system = self.place(gas, &*force);
        let sink = self.cloud.sink.map(|radius| hollow(&mut system, radius));
        let gravity = SelfGravity::new(self.cloud.constant, sink);
        self.evolve(system, force, gravity)
    }
}

impl Plan<'_> {
    /// The particles at the start.
    fn place<G: Gas>(&self, gas: G, force: &dyn PairLoops<3>) -> ParticleSystem<3, G> {
        let (cloud, count) = (self.cloud, self.particles);
        let places = ball(cloud.distribution, count);
        let thermal = G::Thermal::from_energy(|| cloud.energy);
        let ratio = 4.0 * std::f64::consts::PI / 3.0;
        let smoothing = (places.iter().enumerate())
            // From the mean density inside.
            .map(|(k, x)| {
                self.options.eta
                    * cloud.radius
                    * dot(x, x).sqrt()
                    * (ratio / (k as f64 + 0.5)).cbrt()
            })
            .collect();
        let particles = Particles {
            position: places.iter().map(|x| x.map(|x| cloud.radius * x)).collect(),
            velocity: vec![[0.0; 3]; count],
            mass: vec![cloud.mass / count as f64; count],
            thermal: vec![thermal; count],
            smoothing,
        };
        let mut system = ParticleSystem::new(
            gas,
            particles,
            Domain::new([-cloud.radius; 3], [cloud.radius; 3], Boundary::Open),
            SmoothingKernel::new(self.options.kernel),
            Smoothing::adaptive(self.options.eta),
            force,
        );
        if let Some(pressure) = cloud.outside {
            system = system.in_medium(pressure);
        }
        if cloud.equilibrium {
            // What goes wrong here goes wrong in the first step, which says so.
            let _ = relax(&mut system, force, RELAXATION_STEPS);
        }
        system
    }

    fn evolve<G: Gas>(
        self,
        system: ParticleSystem<3, G>,
        force: Box<dyn PairLoops<3>>,
        gravity: SelfGravity,
    ) -> Result<CloudRun, InvalidOptions> {
        let Plan { cloud, options, snapshots, observe, .. } = self;
        let table = table(options.integrator)?;
        let evolution = ParticleEvolution::stepped(system, force, options, &table);
        let mut evolution = evolution.under(gravity);
        // This also finds the fields at the start.
        refuse_too_many(&mut evolution, cloud.end_time)?;
        let coarse = cloud.sink.and_then(|radius| coarse_sink(evolution.system(), radius));
        let mut core = Vec::new();
        let mut energies = vec![energies_of(&evolution, 0.0)];
        let has_energy = energies[0].thermal.is_some();
        let entropy = |state: &Gravitating<G>| -> Option<Vec<f64>> {
            let (gas, system) = (cloud.material.ideal()?, state.system());
            let both = system.pressure().iter().zip(system.density());
            cloud.sink.is_none().then(|| both.map(|(p, d)| p / d.powf(gas.gamma())).collect())
        };
        let first_entropy = entropy(&evolution);
        let mut least_entropy = first_entropy.as_ref().map(|_| 1.0);
        let mut lower = |state: &Gravitating<G>| {
            let both = first_entropy.iter().zip(entropy(state));
            for (first, now) in both.flat_map(|(first, now)| first.iter().zip(now)) {
                least_entropy = least_entropy.map(|least: f64| least.min(now / first));
            }
        };
        let (mut kept, mut wave) = (Vec::new(), None);
        let end = cloud.end_time;
        core.extend(evolution.body().sink.map(|sink| [0.0, sink.mass]));
        let march = march(&mut evolution, end, MOST_STEPS, |state, time| {
            core.extend(state.body().sink.map(|sink| [time, sink.mass]));
            if wave.is_none() && cloud.wave_time().is_some_and(|wanted| time >= wanted) {
                wave = cloud.wave_measures(&snapshot(state, time));
            }
            if has_energy && time >= end / SAMPLES as f64 * energies.len() as f64 {
                energies.push(energies_of(state, time));
                lower(state);
            }
            if snapshots.get(kept.len()).is_some_and(|&wanted| time >= wanted) {
                kept.push(snapshot(state, time));
            }
            observe(time)
        });
        lower(&evolution);
        kept.push(snapshot(&evolution, march.time));
        energies.push(energies_of(&evolution, march.time));
        let system = evolution.system();
        let (mut momentum, mut turning) = (system.momentum(), [0.0; 3]);
        let state = &system.particles;
        let mut mass: f64 = state.mass.iter().sum();
        for i in 0..state.len() {
            let orbit = cross(&state.position[i], &state.velocity[i]);
            turning = plus_scaled(&turning, state.mass[i], &orbit);
        }
        if let Some(sink) = &evolution.body().sink {
            mass += sink.mass;
            momentum = plus_scaled(&momentum, sink.mass, &sink.velocity);
            turning = plus_scaled(&turning, sink.mass, &cross(&sink.position, &sink.velocity));
            turning = plus_scaled(&turning, 1.0, &sink.spin);
        }
        let unit = (cloud.constant * cloud.mass.powi(3)).sqrt();
        let drifts = energies.iter().filter_map(Energies::total);
        let first = energies[0].total();
        let energy = first.and_then(|first| {
            drifts.map(|total| (total - first) / first).max_by(|a, b| a.abs().total_cmp(&b.abs()))
        });
        let conservation = Conservation {
            mass: mass / cloud.mass - 1.0,
            momentum: dot(&momentum, &momentum).sqrt() / unit * cloud.radius.sqrt(),
            energy,
            volume: None,
        };
        let counters = Counters { attractions: evolution.body().interactions, ..system.counters };
        let mut run =
            Run::after(&march, (), conservation, Promise::Tree, counters, Penetration::default());
        run.warnings.extend(coarse);
        run.warnings.extend(least_entropy.filter(|least| *least < DRAINED).map(|least| {
            format!(
                "the entropy of a particle has fallen to {least:.2} of that at the start, as that of no gas does: its neighbours have \
                 taken its heat"
            )
        }));
        Ok(CloudRun {
            run: run.with_substeps(evolution.substeps()),
            core,
            energies,
            least_entropy,
            snapshots: kept,
            wave,
            angular_momentum: dot(&turning, &turning).sqrt() / unit / cloud.radius.sqrt(),
        })
    }
}

/// An entropy below this part of that at the start is told.
const DRAINED: f64 = 0.5;
/// Smoothing lengths above this part of the radius are told: there the pair force of GPH case 3 is 9 % too large
/// (`docs/collapse.md`).
const COARSE: f64 = 0.2;

/// A warning where the smoothing length beside the sink is not small against its radius.
fn coarse_sink<G: Gas>(system: &ParticleSystem<3, G>, radius: f64) -> Option<String> {
    let state = &system.particles;
    let near = (state.position.iter().zip(&state.smoothing))
        .map(|(x, h)| (dot(x, x).sqrt(), h))
        .filter(|(r, _)| *r < 2.0 * radius);
    let (sum, count) = near.fold((0.0, 0), |(sum, count), (r, h)| (sum + h / r, count + 1));
    let ratio = sum / f64::from(count);
    // h/r falls like the cube root of the number of particles.
    let enough = state.len() as f64 * (ratio / COARSE).powi(3);
    match count {
        0 => Some("no particle is near the sink: the flow there is not resolved".into()),
        _ if ratio > COARSE => Some(format!(
            "beside the sink the smoothing length is {ratio:.2} of the radius, so pressure and infall there are \
             not resolved; {COARSE} would need about {enough:.0e} particles"
        )),
        _ => None,
    }
}

/// Puts all particles inside a radius into a sink.
fn hollow<G: Gas>(system: &mut ParticleSystem<3, G>, radius: f64) -> Sink {
    let outside: Vec<bool> =
        system.particles.position.iter().map(|x| dot(x, x) >= radius * radius).collect();
    let inside = outside.iter().zip(&system.particles.mass).filter(|(outside, _)| !**outside);
    let mass = inside.map(|(_, mass)| mass).sum();
    system.retain(|i| outside[i]);
    Sink::new([0.0; 3], mass, radius)
}

type Gravitating<G> = ParticleEvolution<3, G, SelfGravity>;

fn energies_of<G: Gas>(state: &Gravitating<G>, time: f64) -> Energies {
    let (system, gravity) = (state.system(), state.body());
    let particles = &system.particles;
    let half = |m: f64, v: &Vector<3>| 0.5 * m * dot(v, v);
    let mut kinetic: f64 =
        particles.mass.iter().zip(&particles.velocity).map(|(m, v)| half(*m, v)).sum();
    let thermal = system.energy().map(|energy| energy - kinetic);
    let mut potential = gravity.energy(particles);
    if let Some(sink) = &gravity.sink {
        kinetic += half(sink.mass, &sink.velocity);
        potential += sink.energy;
    }
    Energies { time, kinetic, thermal, potential }
}

fn snapshot<G: Gas>(state: &Gravitating<G>, time: f64) -> Snapshot {
    let system = state.system();
    let particles = &system.particles;
    Snapshot {
        time,
        position: particles.position.clone(),
        velocity: particles.velocity.clone(),
        density: system.density().to_vec(),
        sink: state.body().sink,
        particle_mass: particles.mass.first().copied().unwrap_or(0.0),
    }
}
