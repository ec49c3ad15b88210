//! A scene and a method made particles that march.

use super::dispatch::{Task, dispatch};
use super::domain::Domain;
use super::evolution::ParticleEvolution;
use super::gas::Gas;
use super::integrator::{Nystrom, table};
use super::method::MethodOptions;
use super::pair_loops::PairLoops;
use super::smoothing_kernel::SmoothingKernel;
use super::system::{ParticleSystem, Particles};
use super::thermal::ThermalState;
use super::vector::dot;
use crate::method::Start;
use crate::run::{Counters, Flowing, InvalidOptions, Lined, Profile, Promise, Totals};
use crate::scene::Scene;

/// The particles of a scene at the start: about so many in the domain, for layers get whole ones.
pub(crate) fn start(
    scene: &Scene,
    particles: usize,
    options: &MethodOptions,
) -> Result<Start, InvalidOptions> {
    let table = table(options.integrator)?;
    Ok(dispatch(scene.material, options, Plan { scene, particles, options, table: &table }))
}

struct Plan<'a> {
    scene: &'a Scene,
    particles: usize,
    options: &'a MethodOptions,
    table: &'a Nystrom<f64>,
}

impl Task<1> for Plan<'_> {
    type Output = Start;

    fn run<G: Gas>(self, gas: G, force: Box<dyn PairLoops<1>>) -> Start {
        let Self { scene, particles, options, table } = self;
        let (placed, waiting) = scene.place(particles);
        // Beyond the ends the gas is like that at the ends.
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
        let smoothing = options.smoothing(scene.constant_smoothing, &placed, waiting);
        let [from, to] = scene.domain;
        let domain = Domain { lower: [from], upper: [to], boundary: [scene.boundary] };
        let kernel = SmoothingKernel::new(options.kernel);
        let system = ParticleSystem::new(gas, particles, domain, kernel, smoothing, &*force);
        let evolution = Box::new(ParticleEvolution::stepped(system, force, options, table));
        Start { evolution, waiting }
    }
}

impl<const D: usize, G: Gas> Flowing for ParticleEvolution<D, G> {
    fn totals(&self) -> Totals {
        let (system, state) = (self.system(), &self.system().particles);
        let motion = (0..state.len())
            .map(|i| {
                let density = state.mass[i] / state.smoothing[i].powi(D as i32);
                let thermal = system.gas.sound_speed(density, state.thermal[i]);
                let speed = dot(&state.velocity[i], &state.velocity[i]).sqrt();
                state.mass[i] * (speed + thermal)
            })
            .sum();
        let (own, walls) = (system.momentum(), self.wall_impulse());
        let part = |axis: usize| if axis < D { own[axis] - walls[axis] } else { 0.0 };
        Totals {
            mass: state.mass.iter().sum(),
            momentum: std::array::from_fn(part),
            motion,
            energy: system.energy(),
            volume: None,
        }
    }

    fn counters(&self) -> Counters {
        self.system().counters
    }

    fn promise(&self) -> Promise {
        self.work().promise()
    }

    fn out_of_order(&self) -> usize {
        let positions = &self.system().particles.position;
        match D {
            1 => positions.windows(2).filter(|pair| pair[0][0] >= pair[1][0]).count(),
            _ => 0,
        }
    }

    fn substeps(&self) -> Option<u64> {
        ParticleEvolution::substeps(self)
    }
}

impl<G: Gas> Lined for ParticleEvolution<1, G> {
    fn profile(&self) -> Profile {
        let (system, state) = (self.system(), &self.system().particles);
        Profile {
            x: state.position.iter().map(|x| x[0]).collect(),
            density: system.density().to_vec(),
            velocity: state.velocity.iter().map(|v| v[0]).collect(),
            pressure: system.pressure().to_vec(),
            energy: state.thermal.iter().map_while(|thermal| thermal.energy()).collect(),
            mass: state.mass.clone(),
            smoothing: state.smoothing.clone(),
        }
    }
}
