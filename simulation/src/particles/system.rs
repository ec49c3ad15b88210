//! Particles, the fields they carry, and the rates a pair force gives them.

use super::density::{DensitySum, Positions, Smoothing};
use super::domain::Domain;
use super::gas::Gas;
use super::neighbours::{BLOCK, Neighbours};
use super::pair_force::PairForce;
use super::pair_loops::End;
use super::parallel::{fill, first};
use super::smoothing_kernel::{RadialKernel, SmoothingKernel};
use super::thermal::ThermalState;
use super::vector::{Vector, dot, plus_scaled};
use crate::run::{Counters, Reason};

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
    pub(super) compression: Vec<f64>,
    pub(super) ends: Vec<End<D>>,
    pub(super) outside: Option<f64>,
    /// Work done so far.
    pub counters: Counters,
}

impl<const D: usize, G: Gas> ParticleSystem<D, G> {
    /// Prepares a system for one pair force, whose range sets the search for pairs.
    ///
    /// # Panics
    /// If the arrays of `particles` differ in length.
    pub fn new(
        gas: G,
        particles: Particles<D, G::Thermal>,
        domain: Domain<D>,
        kernel: SmoothingKernel<D>,
        smoothing: Smoothing,
        force: &dyn PairForce,
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
            compression: if force.needs_compression() { vec![1.0; count] } else { Vec::new() },
            ends: Vec::new(),
            outside: None,
            counters: Counters::default(),
        }
    }

    /// The same gas in a medium of constant pressure. It is taken from the pressures of every pair: inside the gas its sum over
    /// the neighbours vanishes, at an edge what is missing of it presses inward.
    #[must_use]
    pub fn in_medium(self, pressure: f64) -> Self {
        Self { outside: Some(pressure), ..self }
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
        self.fit_fields();
    }

    /// Exchanges the state with another, which may have more particles: fields and pairs are not of it until they are
    /// [updated](Self::update_fields).
    pub(super) fn exchange(&mut self, other: &mut Particles<D, G::Thermal>) {
        std::mem::swap(other, &mut self.particles);
        self.fit_fields();
    }

    /// As many values as particles; what only some forces need is as long as it ever was.
    fn fit_fields(&mut self) {
        let count = self.particles.len();
        for field in [&mut self.density, &mut self.pressure, &mut self.sound_speed] {
            field.resize(count, 0.0);
        }
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

    /// Density, pressure and sound speed of the present state, and its neighbours.
    ///
    /// # Errors
    /// [`Reason`] if the state is not one of a gas.
    pub fn update_fields(&mut self) -> Result<(), Reason> {
        self.update(None)
    }

    /// [`update_fields`](Self::update_fields) for some particles only: the others keep density, pressure, sound speed
    /// and smoothing length, and are seen where they are now.
    ///
    /// # Errors
    /// As [`update_fields`](Self::update_fields), looking at the active particles only.
    pub(super) fn update_active(&mut self, active: &[u32]) -> Result<(), Reason> {
        self.update(Some(active))
    }

    fn update(&mut self, active: Option<&[u32]>) -> Result<(), Reason> {
        let state = &mut self.particles;
        let number = |k: usize| active.map_or(k, |active| active[k] as usize);
        let count = active.map_or(state.position.len(), <[u32]>::len);
        let (position, velocity) = (&state.position, &state.velocity);
        let thermal = &state.thermal;
        let not_finite = |k: usize| {
            let i = number(k);
            !position[i].iter().chain(&velocity[i]).all(|component| component.is_finite())
        };
        if let Some(k) = first(count, not_finite) {
            return Err(Reason::NotFinite { particle: number(k) });
        }
        if let Some(k) = first(count, |k| !thermal[number(k)].is_physical()) {
            let particle = number(k);
            let value = thermal[particle].energy().unwrap_or(f64::NAN);
            return Err(Reason::InternalEnergy { particle, value });
        }
        let positions = Positions {
            position: &state.position,
            mass: &state.mass,
            smoothing: &mut state.smoothing,
        };
        self.sum.solve(&self.domain, positions, active, &mut self.density, &mut self.neighbours)?;
        self.counters.densities += count as u64;
        self.counters.searches = self.neighbours.searches;
        self.counters.kept_lengths = self.sum.kept;
        let (gas, density) = (self.gas, &self.density);
        match active {
            None => {
                fill(&mut self.pressure, count, |i| gas.pressure(density[i], thermal[i]));
                fill(&mut self.sound_speed, count, |i| gas.sound_speed(density[i], thermal[i]));
            }
            Some(active) => {
                for i in active.iter().map(|&i| i as usize) {
                    self.pressure[i] = gas.pressure(density[i], thermal[i]);
                    self.sound_speed[i] = gas.sound_speed(density[i], thermal[i]);
                }
            }
        }
        if !self.volume_gradient.is_empty() {
            self.update_volume_gradients();
        }
        if !self.compression.is_empty() {
            self.update_compression();
        }
        Ok(())
    }

    /// `∇(1/ρ) = −Σ m_j ∇W(r, h_i)/ρ_i²` of the active particles.
    fn update_volume_gradients(&mut self) {
        let (kernel, state, neighbours) = (&self.sum.kernel, &self.particles, &self.neighbours);
        let (density, mut gradients) = (&self.density, Vec::new());
        fill(&mut gradients, neighbours.active.len(), |rank| {
            let at = neighbours.active[rank] as usize;
            let (i, k) = (neighbours.cells.order[at] as usize, rank % BLOCK);
            let add = |sum: Vector<D>, &neighbour| {
                let (_, j, displacement, distance) = neighbours.see(at, neighbour);
                // ∇_i W points against the neighbour by W', and the volume falls as ρ grows.
                let slope = kernel.slope(distance, state.smoothing[i]);
                let mass = state.mass[j];
                let weight = if distance > 0.0 { mass * slope / distance } else { 0.0 };
                plus_scaled(&sum, weight, &displacement)
            };
            let block = &neighbours.blocks[rank / BLOCK];
            let before = block.before(k).iter().rev().fold([0.0; D], add);
            let after = block.after(k).iter().fold([0.0; D], add);
            let square = density[i] * density[i];
            std::array::from_fn(|axis| (before[axis] + after[axis]) / square)
        });
        neighbours.hand_out(&gradients, &mut self.volume_gradient);
    }

    /// Balsara's factor of the active particles, from `∂_b v_a = Σ m_j (v_j − v_i)_a ∂_b W(r, h_i)/ρ_i`.
    fn update_compression(&mut self) {
        let (kernel, state, neighbours) = (&self.sum.kernel, &self.particles, &self.neighbours);
        let mut factors = Vec::new();
        fill(&mut factors, neighbours.active.len(), |rank| {
            let at = neighbours.active[rank] as usize;
            let i = neighbours.cells.order[at] as usize;
            let h = state.smoothing[i];
            let mut gradient = [[0.0; D]; D];
            for &neighbour in neighbours.blocks[rank / BLOCK].all(rank % BLOCK) {
                let (image, j, displacement, distance) = neighbours.see(at, neighbour);
                if distance > 0.0 {
                    let weight = -state.mass[j] * kernel.slope(distance, h) / distance;
                    let velocity = neighbours.images()[image].reflect(&state.velocity[j]);
                    for (row, (there, here)) in
                        gradient.iter_mut().zip(velocity.iter().zip(&state.velocity[i]))
                    {
                        *row = plus_scaled(row, weight * (there - here), &displacement);
                    }
                }
            }
            let divergence = (0..D).map(|a| gradient[a][a]).sum::<f64>().abs();
            let pairs = (0..D).flat_map(|a| (0..a).map(move |b| (a, b)));
            let curl: f64 = pairs.map(|(a, b)| (gradient[a][b] - gradient[b][a]).powi(2)).sum();
            let least = 1e-4 * self.sound_speed[i] / h * self.density[i];
            divergence / (divergence + curl.sqrt() + least)
        });
        neighbours.hand_out(&factors, &mut self.compression);
    }
}
