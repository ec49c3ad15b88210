//! Time integrators with one global step.

use super::gas::Gas;
use super::pair_force::{PairForce, Work};
use super::rates::Rates;
use super::system::ParticleSystem;
use super::thermal::ThermalState;
use super::vector::{Vector, dot, plus_scaled};
use crate::run::Reason;

/// The integrators of the linear analysis: `v' = v + dt Σ b_k a_k` with the rates of each stage; positions and
/// energies follow in [`Stepper::step`].
pub use courant_analysis::scheme::integrator::Integrator;

/// `(c, b)` of each stage: it starts `c·dt` along the rates of the stage before, and its own
/// rates enter the step with weight `b`.
fn stages(integrator: Integrator) -> &'static [(f64, f64)] {
    const SIXTH: f64 = 1.0 / 6.0;
    match integrator {
        Integrator::ForwardEuler | Integrator::SymplecticEuler | Integrator::CentredEuler => {
            &[(0.0, 1.0)]
        }
        Integrator::Rk2Midpoint | Integrator::PredictorCorrector => &[(0.0, 0.0), (0.5, 1.0)],
        Integrator::Rk3Ssp => &[(0.0, SIXTH), (1.0, SIXTH), (0.5, 4.0 * SIXTH)],
        Integrator::Rk2Heun | Integrator::LeapfrogKdk | Integrator::LeapfrogKdkPredicted => {
            &[(0.0, 0.5), (1.0, 0.5)]
        }
        Integrator::Rk4 => &[(0.0, SIXTH), (0.5, 2.0 * SIXTH), (0.5, 2.0 * SIXTH), (1.0, SIXTH)],
    }
}

/// An integrator with its memory: nothing is allocated after the first step.
#[derive(Debug, Clone)]
pub struct Stepper<const D: usize, T> {
    integrator: Integrator,
    /// Rates at the last stage evaluated.
    pub rates: Rates<D, T>,
    started: bool,
    position: Vec<Vector<D>>,
    velocity: Vec<Vector<D>>,
    thermal: Vec<T>,
    /// `Σ b_k` of velocities, accelerations, total-energy rates and heating rates.
    sum_velocity: Vec<Vector<D>>,
    sum_acceleration: Vec<Vector<D>>,
    sum_energy: Vec<T>,
    sum_heat: Vec<T>,
    /// Momentum that the walls have given so far.
    pub wall_impulse: Vector<D>,
}

impl<const D: usize, T: ThermalState> Stepper<D, T> {
    /// A stepper for systems of any size.
    pub fn new(integrator: Integrator) -> Self {
        Self {
            integrator,
            rates: Rates::default(),
            started: false,
            position: Vec::new(),
            velocity: Vec::new(),
            thermal: Vec::new(),
            sum_velocity: Vec::new(),
            sum_acceleration: Vec::new(),
            sum_energy: Vec::new(),
            sum_heat: Vec::new(),
            wall_impulse: [0.0; D],
        }
    }

    /// Evaluates the rates at the present state, where a step begins. A time step can then be
    /// chosen from them; [`step`](Self::step) takes it.
    ///
    /// # Errors
    /// [`Reason`] if the state is not one of a gas.
    pub fn begin<G: Gas<Thermal = T>, F: PairForce>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &F,
    ) -> Result<(), Reason> {
        system.rates(force, &mut self.rates)?;
        self.started = true;
        Ok(())
    }

    /// `min h_i/s_i` with the signal velocities of the last evaluation: the time a signal needs to cross a
    /// smoothing length.
    pub fn crossing_time<G: Gas<Thermal = T>>(&self, system: &ParticleSystem<D, G>) -> f64 {
        (system.particles.smoothing.iter().zip(&self.rates.signal))
            .map(|(h, signal)| h / signal)
            .fold(f64::INFINITY, f64::min)
    }

    /// One step of length `dt`, [`begin`](Self::begin) included unless it was just called.
    ///
    /// # Errors
    /// [`Reason`] if a stage leaves the states of a gas.
    pub fn step<G: Gas<Thermal = T>, F: PairForce>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &F,
        dt: f64,
    ) -> Result<(), Reason> {
        if !self.started {
            self.begin(system, force)?;
        }
        self.started = false;
        self.position.clone_from(&system.particles.position);
        self.velocity.clone_from(&system.particles.velocity);
        self.thermal.clone_from(&system.particles.thermal);
        let count = self.position.len();
        self.sum_velocity.clear();
        self.sum_velocity.resize(count, [0.0; D]);
        self.sum_acceleration.clear();
        self.sum_acceleration.resize(count, [0.0; D]);
        self.sum_energy.clear();
        self.sum_energy.resize(count, T::default());
        self.sum_heat.clear();
        self.sum_heat.resize(count, T::default());
        for (stage, &(offset, weight)) in stages(self.integrator).iter().enumerate() {
            if stage > 0 {
                if self.integrator == Integrator::Rk3Ssp && stage == 2 {
                    self.predict_mean(system, offset * dt);
                } else {
                    self.predict(system, offset * dt);
                }
                system.rates(force, &mut self.rates)?;
            }
            self.accumulate(system, weight, dt);
        }
        self.complete(system, dt, F::WORK);
        Ok(())
    }

    /// The state at which the next stage is evaluated, `dt` after the beginning of the step.
    fn predict<G: Gas<Thermal = T>>(&self, system: &mut ParticleSystem<D, G>, dt: f64) {
        let state = &mut system.particles;
        for i in 0..state.len() {
            let (v, a) = (state.velocity[i], &self.rates.acceleration[i]);
            let heat = self.heat(i, &v);
            state.thermal[i] = self.thermal[i].plus_scaled(dt, heat);
            let (x0, v0) = (&self.position[i], &self.velocity[i]);
            let half = plus_scaled(v0, 0.5 * dt, a);
            let full = plus_scaled(v0, dt, a);
            (state.position[i], state.velocity[i]) = match self.integrator {
                Integrator::LeapfrogKdk => (plus_scaled(x0, dt, &half), half),
                Integrator::LeapfrogKdkPredicted => (plus_scaled(x0, dt, &half), full),
                _ => (plus_scaled(x0, dt, &v), full),
            };
        }
    }

    /// The state `dt` after the beginning of the step along the mean of the rates of two stages, each of which has
    /// entered the sums with weight 1/6.
    fn predict_mean<G: Gas<Thermal = T>>(&self, system: &mut ParticleSystem<D, G>, dt: f64) {
        let state = &mut system.particles;
        let scale = 3.0 * dt;
        for i in 0..state.len() {
            state.position[i] = plus_scaled(&self.position[i], scale, &self.sum_velocity[i]);
            state.velocity[i] = plus_scaled(&self.velocity[i], scale, &self.sum_acceleration[i]);
            state.thermal[i] = self.thermal[i].plus_scaled(scale, self.sum_heat[i]);
        }
    }

    /// Heating rate of a particle of velocity `v` at the present rates.
    #[inline]
    fn heat(&self, i: usize, v: &Vector<D>) -> T {
        let work = T::from_energy(|| dot(v, &self.rates.acceleration[i]));
        self.rates.energy[i].plus_scaled(-1.0, work)
    }

    fn accumulate<G: Gas<Thermal = T>>(
        &mut self,
        system: &ParticleSystem<D, G>,
        weight: f64,
        dt: f64,
    ) {
        if weight == 0.0 {
            return;
        }
        for i in 0..self.position.len() {
            let v = &system.particles.velocity[i];
            self.sum_velocity[i] = plus_scaled(&self.sum_velocity[i], weight, v);
            self.sum_acceleration[i] =
                plus_scaled(&self.sum_acceleration[i], weight, &self.rates.acceleration[i]);
            self.sum_energy[i] = self.sum_energy[i].plus_scaled(weight, self.rates.energy[i]);
            self.sum_heat[i] = self.sum_heat[i].plus_scaled(weight, self.heat(i, v));
        }
        self.wall_impulse = plus_scaled(&self.wall_impulse, weight * dt, &self.rates.wall_force);
    }

    fn complete<G: Gas<Thermal = T>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        dt: f64,
        work: Work,
    ) {
        let state = &mut system.particles;
        for i in 0..state.len() {
            let (x, v) = (&self.position[i], &self.velocity[i]);
            let new = plus_scaled(v, dt, &self.sum_acceleration[i]);
            let centred = plus_scaled(v, 0.5 * dt, &self.sum_acceleration[i]);
            state.position[i] = match self.integrator {
                Integrator::SymplecticEuler => plus_scaled(x, dt, &new),
                Integrator::CentredEuler | Integrator::PredictorCorrector => {
                    plus_scaled(x, dt, &centred)
                }
                // Where the last stage already is.
                Integrator::LeapfrogKdk | Integrator::LeapfrogKdkPredicted => state.position[i],
                _ => plus_scaled(x, dt, &self.sum_velocity[i]),
            };
            let heat = match work {
                Work::Instantaneous => self.sum_heat[i],
                Work::TimeCentred => {
                    // (v + v')/2 · (v' − v) is the change of kinetic energy, exactly.
                    let work = T::from_energy(|| dot(&centred, &self.sum_acceleration[i]));
                    self.sum_energy[i].plus_scaled(-1.0, work)
                }
            };
            state.velocity[i] = new;
            state.thermal[i] = self.thermal[i].plus_scaled(dt, heat);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_has_as_many_stages_as_the_list_says_and_their_weights_add_up() {
        for integrator in Integrator::ALL {
            assert_eq!(stages(integrator).len(), integrator.force_evaluations(), "{integrator}");
            let sum: f64 = stages(integrator).iter().map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < 1e-15, "{integrator}");
        }
    }
}
