//! Numbers that say how well a flow is kept.

use super::scene::{FieldFlow, FieldScene, FieldSolution};
use crate::particles::{Gas, ParticleSystem, Vector, dot};
use std::f64::consts::PI;

/// A name and a number.
pub type Measure = (&'static str, f64);

/// What is measured of a scene at a time, against the state at the start.
#[derive(Debug, Clone)]
pub(super) struct Meter<'a, const D: usize> {
    scene: &'a FieldScene,
    solution: FieldSolution<'a>,
    kinetic_energy: f64,
    angular_momentum: f64,
}

fn mean(count: usize, value: impl Fn(usize) -> f64) -> f64 {
    (0..count).map(value).sum::<f64>() / count as f64
}

impl<'a, const D: usize> Meter<'a, D> {
    pub fn new<G: Gas>(scene: &'a FieldScene, system: &ParticleSystem<D, G>) -> Self {
        Self {
            scene,
            solution: scene.solution(),
            kinetic_energy: kinetic_energy(system),
            angular_momentum: angular_momentum(system),
        }
    }

    /// The measures of the scene, in the same order at all times.
    pub fn measure<G: Gas>(&self, system: &ParticleSystem<D, G>, time: f64) -> Vec<Measure> {
        let (state, density) = (&system.particles, system.density());
        let count = state.len();
        let middle = mean(count, |i| density[i]);
        let scatter = mean(count, |i| (density[i] / middle - 1.0).powi(2)).sqrt();
        let exact = |i: usize| self.solution.at(state.position[i], time);
        let radius = |i: usize| norm(&state.position[i]);
        let velocity_error = |i: usize| {
            let exact = exact(i).map_or([0.0; D], |state| state.velocity);
            (0..D).map(|axis| (state.velocity[i][axis] - exact[axis]).powi(2)).sum::<f64>()
        };
        match self.scene.flow {
            FieldFlow::Shear { speed, .. } => {
                let sine = |i: usize| {
                    let (from, to) = (self.scene.domain[0][0], self.scene.domain[1][0]);
                    (2.0 * PI * (state.position[i][0] - from) / (to - from)).sin()
                };
                let along = |i: usize| (state.velocity[i][1] - speed * sine(i)).powi(2);
                vec![
                    ("velocity_scatter", mean(count, along).sqrt()),
                    ("cross_velocity", mean(count, |i| state.velocity[i][0].powi(2)).sqrt()),
                    ("kinetic_energy_left", kinetic_energy(system) / self.kinetic_energy),
                    ("density_scatter", scatter),
                    (
                        "amplitude_left",
                        2.0 * mean(count, |i| state.velocity[i][1] * sine(i)) / speed,
                    ),
                ]
            }
            FieldFlow::Gresho { .. } => {
                let near_peak = |i: &usize| (0.15..0.25).contains(&radius(*i));
                let turning =
                    |i: usize| turning(&state.position[i], &state.velocity[i]) / radius(i);
                let ring: Vec<usize> = (0..count).filter(near_peak).collect();
                let peak = mean(ring.len(), |k| turning(ring[k]));
                // The mean of 5r and 2 − 5r over the ring, by area.
                let exact_peak =
                    mean(ring.len(), |k| exact(ring[k]).map_or(0.0, |state| norm(&state.velocity)));
                vec![
                    ("velocity_scatter", mean(count, velocity_error).sqrt()),
                    ("kinetic_energy_left", kinetic_energy(system) / self.kinetic_energy),
                    ("angular_momentum_left", angular_momentum(system) / self.angular_momentum),
                    ("peak_left", peak / exact_peak),
                    ("density_scatter", scatter),
                ]
            }
            FieldFlow::Blast { density: before, .. } => {
                // The densest hundredth is the shell.
                let mut order: Vec<usize> = (0..count).collect();
                order.sort_by(|&a, &b| density[b].total_cmp(&density[a]));
                let shell = &order[..(count / 100).max(1)];
                let peak = mean(shell.len(), |k| density[shell[k]]) / before;
                let r = mean(shell.len(), |k| radius(shell[k]));
                let mut measures = vec![("shell_radius", r), ("shell_density", peak)];
                if let Some(shock) = self.solution.shock_radius(time) {
                    measures.push(("shell_radius_error", r / shock - 1.0));
                }
                measures
            }
        }
    }
}

fn kinetic_energy<const D: usize, G: Gas>(system: &ParticleSystem<D, G>) -> f64 {
    let state = &system.particles;
    let velocity = &state.velocity;
    (0..state.len()).map(|i| 0.5 * state.mass[i] * dot(&velocity[i], &velocity[i])).sum()
}

fn norm<const D: usize>(x: &Vector<D>) -> f64 {
    dot(x, x).sqrt()
}

/// The angular momentum about the origin, over the mass, in the plane of the first two axes.
fn turning<const D: usize>(x: &Vector<D>, v: &Vector<D>) -> f64 {
    x[0] * v[1] - x[1] * v[0]
}

fn angular_momentum<const D: usize, G: Gas>(system: &ParticleSystem<D, G>) -> f64 {
    let state = &system.particles;
    let of = |i: usize| state.mass[i] * turning(&state.position[i], &state.velocity[i]);
    (0..state.len()).map(of).sum()
}
