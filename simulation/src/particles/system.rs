//! Particles, the fields they carry, and the rates a pair force gives them.

use super::density::{DensitySum, Smoothing};
use super::domain::Domain;
use super::gas::Gas;
use super::neighbours::{Neighbours, Pair};
use super::pair_force::PairForce;
use super::smoothing_kernel::{RadialKernel, SmoothingKernel};
use super::thermal::ThermalState;
use super::vector::{Vector, dot, plus_scaled};
use crate::run::Reason;

/// What is advanced in time: one array per quantity, all of length N.
#[derive(Debug, Clone, PartialEq)]
pub struct Particles<const D: usize, T> {
    /// Positions, not wrapped into a periodic domain.
    pub position: Vec<Vector<D>>,
    /// Velocities.
    pub velocity: Vec<Vector<D>>,
    /// Masses.
    pub mass: Vec<f64>,
    /// Specific internal energies, or nothing for an isothermal gas.
    pub thermal: Vec<T>,
    /// Smoothing lengths; with [`Smoothing::Adaptive`], a first guess.
    pub smoothing: Vec<f64>,
}

impl<const D: usize, T> Particles<D, T> {
    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }
}

/// Closes the gaps that the elements not to be kept leave.
pub(crate) fn keep_only<A>(values: &mut Vec<A>, keep: impl Fn(usize) -> bool) {
    let mut index = 0;
    values.retain(|_| {
        index += 1;
        keep(index - 1)
    });
}

/// Work done so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counters {
    /// Evaluations of the forces on all particles.
    pub evaluations: u64,
    /// Pairs for which a force was computed (each pair once, whichever way it is seen).
    pub interactions: u64,
    /// Iterations of the Riemann solver, after the first guesses.
    pub riemann_iterations: u64,
}

/// Particles of a gas in a domain.
#[derive(Debug, Clone)]
pub struct ParticleSystem<const D: usize, G: Gas> {
    /// The equation of state.
    pub gas: G,
    /// The state.
    pub particles: Particles<D, G::Thermal>,
    domain: Domain<D>,
    pub(super) sum: DensitySum<D>,
    pub(super) neighbours: Neighbours<D>,
    pub(super) density: Vec<f64>,
    pub(super) pressure: Vec<f64>,
    pub(super) sound_speed: Vec<f64>,
    pub(super) volume_gradient: Vec<Vector<D>>,
    /// Work done so far.
    pub counters: Counters,
}

impl<const D: usize, G: Gas> ParticleSystem<D, G> {
    /// Prepares a system for one pair force, whose range sets the search for pairs.
    ///
    /// # Panics
    /// If the arrays of `particles` differ in length.
    pub fn new<F: PairForce>(
        gas: G,
        particles: Particles<D, G::Thermal>,
        domain: Domain<D>,
        kernel: SmoothingKernel<D>,
        smoothing: Smoothing,
        force: &F,
    ) -> Self {
        let count = particles.len();
        assert!(
            [
                particles.velocity.len(),
                particles.mass.len(),
                particles.thermal.len(),
                particles.smoothing.len()
            ] == [count; 4],
            "one value for each particle in every array"
        );
        Self {
            gas,
            particles,
            domain,
            sum: DensitySum::new(kernel, smoothing, force.reach()),
            neighbours: Neighbours::default(),
            density: vec![0.0; count],
            pressure: vec![0.0; count],
            sound_speed: vec![0.0; count],
            volume_gradient: if force.needs_volume_slope() {
                vec![[0.0; D]; count]
            } else {
                Vec::new()
            },
            counters: Counters::default(),
        }
    }

    /// Takes out the particles that are not to be kept. Fields and pairs are those of before until they are
    /// [updated](Self::update_fields).
    pub fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        let state = &mut self.particles;
        keep_only(&mut state.position, &keep);
        keep_only(&mut state.velocity, &keep);
        keep_only(&mut state.mass, &keep);
        keep_only(&mut state.thermal, &keep);
        keep_only(&mut state.smoothing, &keep);
        let count = state.len();
        for field in [&mut self.density, &mut self.pressure, &mut self.sound_speed] {
            field.truncate(count);
        }
        self.volume_gradient.truncate(count);
    }

    /// Densities by summation, as of the last evaluation.
    pub fn density(&self) -> &[f64] {
        &self.density
    }

    /// Pressures, as of the last evaluation.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Sound speeds, as of the last evaluation.
    pub fn sound_speed(&self) -> &[f64] {
        &self.sound_speed
    }

    /// The pairs of the last evaluation, those in the margin of the search included.
    pub fn neighbours(&self) -> &Neighbours<D> {
        &self.neighbours
    }

    /// The domain.
    pub fn domain(&self) -> &Domain<D> {
        &self.domain
    }

    /// Total momentum.
    pub fn momentum(&self) -> Vector<D> {
        let state = &self.particles;
        (state.mass.iter().zip(&state.velocity))
            .fold([0.0; D], |sum, (m, v)| plus_scaled(&sum, *m, v))
    }

    /// Kinetic and internal energy; `None` for a gas without an energy equation.
    pub fn energy(&self) -> Option<f64> {
        let state = &self.particles;
        let mut total = 0.0;
        for ((mass, velocity), thermal) in
            state.mass.iter().zip(&state.velocity).zip(&state.thermal)
        {
            total += mass * (0.5 * dot(velocity, velocity) + thermal.energy()?);
        }
        Some(total)
    }

    /// Density, pressure and sound speed of the present state, and its pairs.
    ///
    /// # Errors
    /// [`Reason`] if the state is not one of a gas.
    pub fn update_fields(&mut self) -> Result<(), Reason> {
        let state = &mut self.particles;
        for (particle, (x, v)) in state.position.iter().zip(&state.velocity).enumerate() {
            if !x.iter().chain(v).all(|component| component.is_finite()) {
                return Err(Reason::NotFinite { particle });
            }
        }
        for (particle, thermal) in state.thermal.iter().enumerate() {
            if !thermal.is_physical() {
                let value = thermal.energy().unwrap_or(f64::NAN);
                return Err(Reason::InternalEnergy { particle, value });
            }
        }
        self.sum.solve(
            &self.domain,
            &state.position,
            &state.mass,
            &mut state.smoothing,
            &mut self.density,
            &mut self.neighbours,
        )?;
        for particle in 0..state.len() {
            let (density, thermal) = (self.density[particle], state.thermal[particle]);
            self.pressure[particle] = self.gas.pressure(density, thermal);
            self.sound_speed[particle] = self.gas.sound_speed(density, thermal);
        }
        if !self.volume_gradient.is_empty() {
            self.update_volume_gradients();
        }
        Ok(())
    }

    /// `∇(1/ρ) = −Σ m_j ∇W(r, h_i)/ρ_i²`.
    fn update_volume_gradients(&mut self) {
        let (kernel, state) = (&self.sum.kernel, &self.particles);
        for block in &self.neighbours.blocks {
            for k in 0..block.len {
                let i = block.start + k;
                let mut gradient = [0.0; D];
                for neighbour in block.neighbours(k) {
                    let (at, index) = neighbour.pair();
                    let pair = &self.neighbours.blocks[at].pairs[index];
                    let slope = kernel.slope(neighbour.distance, state.smoothing[i]);
                    let weight = state.mass[neighbour.other as usize] * slope;
                    // ∇_i W points against the neighbour by W', and the volume falls as ρ grows.
                    let towards = self.towards(pair, neighbour.is_first);
                    gradient = plus_scaled(&gradient, weight, &towards);
                }
                let square = self.density[i] * self.density[i];
                self.volume_gradient[i] = gradient.map(|component| component / square);
            }
        }
    }

    /// The unit vector from one end of a pair to the other, as the particle at that end sees it.
    fn towards(&self, pair: &Pair<D>, from_first: bool) -> Vector<D> {
        let sign = if pair.first_is_left == from_first { 1.0 } else { -1.0 };
        let line = pair.direction.map(|component| sign * component);
        if from_first { line } else { self.neighbours.images()[pair.image as usize].reflect(&line) }
    }
}
