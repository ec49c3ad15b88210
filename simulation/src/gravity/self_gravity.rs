//! The attraction that particles feel from each other and from a sink.

use super::octree::{Bodies, Octree};
use super::sink::Sink;
use super::walk::Opening;
use crate::particles::{
    BodyForce, Gas, ParticleSystem, Particles, ThermalState, Vector, dot, keep_only, plus_scaled,
};
use rayon::prelude::*;

/// Targets handled together by one thread.
const CHUNK: usize = 256;
/// The part of its distance a cell may measure where no acceleration is known yet.
const FIRST_ANGLE: f64 = 0.5;

/// Self-gravity by [`Octree`], with a [`Sink`] or without.
///
/// Each particle is spread like the cubic spline of its smoothing length; in a pair the mean of the two attractions
/// acts. Only that of the cells, which stand for many particles, is not exactly opposite: [`net_force`](Self::net_force) measures
/// what is left.
#[derive(Debug, Clone)]
pub struct SelfGravity {
    /// Newton's constant `G`.
    pub constant: f64,
    /// The error one cell may make in the acceleration of a particle, relative to the last one known.
    pub tolerance: f64,
    /// The sink.
    pub sink: Option<Sink>,
    /// Cells and particles summed over so far.
    pub interactions: u64,
    tree: Octree,
    /// Of the last update, by the gas alone.
    acceleration: Vec<Vector<3>>,
    /// Of the last update, by the sink.
    pull: Vec<Vector<3>>,
    marked: Vec<bool>,
    kept: Option<Sink>,
}

/// The masses of some particles.
fn bodies<T>(particles: &Particles<3, T>) -> Bodies<'_> {
    let Particles { position, mass, smoothing, .. } = particles;
    Bodies { position, mass, smoothing }
}

impl SelfGravity {
    /// `tolerance` of 5e-3, with quadrupoles: 99 % of the accelerations of a centrally condensed sphere are good to
    /// 2e-3.
    pub const TOLERANCE: f64 = 5e-3;

    /// Gravity of the constant `G` with the customary tolerance.
    pub fn new(constant: f64, sink: Option<Sink>) -> Self {
        Self {
            constant,
            tolerance: Self::TOLERANCE,
            kept: sink,
            sink,
            interactions: 0,
            tree: Octree::default(),
            acceleration: Vec::new(),
            pull: Vec::new(),
            marked: Vec::new(),
        }
    }

    /// `|Σ m a|/Σ m |a|` of the gas on itself, as of the last update: zero if all forces came in opposite pairs.
    pub fn net_force(&self, masses: &[f64]) -> f64 {
        let (mut sum, mut sizes) = ([0.0; 3], 0.0);
        for (mass, a) in masses.iter().zip(&self.acceleration) {
            sum = plus_scaled(&sum, *mass, a);
            sizes += mass * dot(a, a).sqrt();
        }
        dot(&sum, &sum).sqrt() / sizes
    }

    /// `½ Σ m φ`, the sink included: the energy of the attraction.
    pub fn energy<T: ThermalState>(&self, particles: &Particles<3, T>) -> f64 {
        let bodies = bodies(particles);
        let mut tree = Octree::default();
        tree.build(&bodies);
        let (tree, constant) = (&tree, self.constant);
        let depth = |x: &Vector<3>| self.sink.map_or(0.0, |sink| sink.depth(x));
        let mut each = Vec::new();
        (0..particles.len())
            .into_par_iter()
            .with_min_len(CHUNK)
            .map(|i| {
                let (x, h) = (&particles.position[i], particles.smoothing[i]);
                let gas = tree.potential(&bodies, x, h, Opening::Geometric(FIRST_ANGLE));
                constant * particles.mass[i] * (0.5 * gas + depth(x))
            })
            .collect_into_vec(&mut each);
        each.iter().sum()
    }
}

impl BodyForce<3> for SelfGravity {
    fn update<T: ThermalState>(
        &mut self,
        particles: &Particles<3, T>,
        active: &(dyn Fn(usize) -> bool + Sync),
    ) {
        let count = particles.len();
        let known = self.acceleration.len() == count;
        if !known {
            self.acceleration.clear();
            self.acceleration.resize(count, [0.0; 3]);
            self.marked.clear();
            self.marked.resize(count, false);
        }
        let bodies = bodies(particles);
        self.tree.build(&bodies);
        // Along the curve, so that neighbours in a chunk walk the same way.
        let targets: Vec<u32> =
            self.tree.order.iter().copied().filter(|&i| active(i as usize)).collect();
        for first in if known { &[false][..] } else { &[true, false] } {
            let (tree, constant, old) = (&self.tree, self.constant, &self.acceleration);
            let mut found = Vec::new();
            (targets.par_iter().with_min_len(CHUNK))
                .map(|&i| {
                    let i = i as usize;
                    let size = dot(&old[i], &old[i]).sqrt();
                    let opening = if *first || size == 0.0 {
                        Opening::Geometric(FIRST_ANGLE)
                    } else {
                        Opening::Error(self.tolerance * size / constant)
                    };
                    tree.attraction(&bodies, &bodies.position[i], bodies.smoothing[i], opening)
                })
                .collect_into_vec(&mut found);
            for (&i, found) in targets.iter().zip(&found) {
                self.acceleration[i as usize] = found.acceleration.map(|a| constant * a);
                self.interactions += found.interactions;
            }
        }
        if let Some(sink) = &self.sink {
            self.pull.resize(count, [0.0; 3]);
            for i in (0..count).filter(|&i| active(i)) {
                let (x, v) = (&particles.position[i], &particles.velocity[i]);
                self.pull[i] = sink.attraction(x).map(|a| self.constant * a);
                // Once marked, always: it may be through the other side before the step of the whole ends.
                self.marked[i] |= sink.takes(x, v, self.constant);
            }
        }
    }

    #[inline]
    fn acceleration(&self, particle: usize) -> Vector<3> {
        let gas = self.acceleration[particle];
        self.pull.get(particle).map_or(gas, |pull| plus_scaled(&gas, 1.0, pull))
    }

    #[inline]
    fn impulse(&mut self, particle: usize, mass: f64, duration: f64) -> Vector<3> {
        let change = self.acceleration(particle).map(|a| duration * a);
        if let (Some(sink), Some(pull)) = (&mut self.sink, self.pull.get(particle)) {
            sink.push(&pull.map(|a| -duration * mass * a));
        }
        change
    }

    fn drift(&mut self, duration: f64) {
        if let Some(sink) = &mut self.sink {
            sink.position = plus_scaled(&sink.position, duration, &sink.velocity);
        }
    }

    fn settle<G: Gas>(&mut self, system: &mut ParticleSystem<3, G>) {
        let Some(sink) = &mut self.sink else { return };
        if sink.swallow(&system.particles, &self.marked, self.constant) {
            let stays = |i: usize| !self.marked[i];
            system.retain(stays);
            keep_only(&mut self.acceleration, stays);
            keep_only(&mut self.pull, stays);
            self.marked.clear();
            self.marked.resize(self.acceleration.len(), false);
        }
    }

    fn keep(&mut self) {
        self.kept = self.sink;
    }

    fn restore(&mut self) {
        self.sink = self.kept;
        self.marked.fill(false);
    }
}
