//! Time integrators with one global step.

use super::body_force::BodyForce;
use super::gas::Gas;
use super::pair_loops::PairLoops;
use super::rates::Rates;
use super::system::ParticleSystem;
use super::thermal::ThermalState;
use super::vector::{Vector, dot, plus_scaled};
use crate::run::{Promise, Reason};

pub use courant_analysis::scheme::{Integrator, Nystrom};

/// An integrator that no running particle code can take.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("integrator = {0}: particles are stepped by explicit Runge–Kutta and Nyström methods only")]
pub struct NotExplicit(pub &'static str);

/// The table that a particle code steps by.
///
/// # Errors
/// When the integrator is a multistep or an implicit one.
pub fn table(integrator: &'static Integrator) -> Result<Nystrom<f64>, NotExplicit> {
    integrator.nystrom().ok_or(NotExplicit(&integrator.name))
}

/// The velocity of the particle in its own heating rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Work {
    /// That of the state the force was evaluated at: total energy is conserved to the order of the integrator.
    Instantaneous,
    /// The mean of those before and after the step: total energy is conserved to round-off.
    TimeCentred,
}

impl Work {
    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Instantaneous => "published",
            Self::TimeCentred => "centred",
        }
    }

    /// How well a run with it conserves the total energy.
    pub fn promise(self) -> Promise {
        match self {
            Self::TimeCentred => Promise::RoundOff,
            Self::Instantaneous => Promise::Integrator,
        }
    }
}

/// Rates kept of a stage.
#[derive(Debug, Clone)]
struct Stage<const D: usize, T> {
    acceleration: Vec<Vector<D>>,
    heat: Vec<T>,
}

/// An integrator with its memory: nothing is allocated after the first step.
///
/// Stage `i` stands at `x + c_i Δt v + Δt² Σ_j p_ij a_j` with the velocity `v + Δt Σ_j q_ij a_j`. Energies are carried to its time
/// `c_i Δt` by the rates of the earlier stages in the proportions of `q_ij`.
#[derive(Debug, Clone)]
pub struct Stepper<const D: usize, T> {
    table: Nystrom<f64>,
    /// Which velocity the heating uses.
    pub work: Work,
    /// Rates at the last stage evaluated.
    pub rates: Rates<D, T>,
    started: bool,
    position: Vec<Vector<D>>,
    velocity: Vec<Vector<D>>,
    thermal: Vec<T>,
    stages: Vec<Stage<D, T>>,
    /// `Σ q_j` of total-energy rates and heating rates.
    sum_energy: Vec<T>,
    sum_heat: Vec<T>,
    /// Momentum that the walls have given so far.
    pub wall_impulse: Vector<D>,
}

impl<const D: usize, T: ThermalState> Stepper<D, T> {
    /// A stepper for systems of any size, with time-centred work.
    pub fn new(table: Nystrom<f64>) -> Self {
        let stage = Stage { acceleration: Vec::new(), heat: Vec::new() };
        Self {
            stages: vec![stage; table.c.len()],
            table,
            work: Work::TimeCentred,
            rates: Rates::default(),
            started: false,
            position: Vec::new(),
            velocity: Vec::new(),
            thermal: Vec::new(),
            sum_energy: Vec::new(),
            sum_heat: Vec::new(),
            wall_impulse: [0.0; D],
        }
    }

    /// Evaluates the rates where a step begins, the fields of the system being those of its state. A time step can then be
    /// chosen from them; [`step`](Self::step) takes it.
    pub fn begin<G: Gas<Thermal = T>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &dyn PairLoops<D>,
    ) {
        system.evaluate(force, &mut self.rates, None);
        self.started = true;
    }

    /// `min h_i/s_i` with the signal velocities of the last evaluation: the time a signal needs to cross a
    /// smoothing length.
    pub fn crossing_time<G: Gas<Thermal = T>>(&self, system: &ParticleSystem<D, G>) -> f64 {
        (system.particles.smoothing.iter().zip(&self.rates.signal))
            .map(|(h, signal)| h / signal)
            .fold(f64::INFINITY, f64::min)
    }

    /// One step of length `dt`, [`begin`](Self::begin) included unless it was just called; the body force is that of
    /// where it begins, and afterwards that of where it ends.
    ///
    /// # Errors
    /// [`Reason`] if a stage leaves the states of a gas.
    pub fn step<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &dyn PairLoops<D>,
        body: &mut B,
        dt: f64,
    ) -> Result<(), Reason> {
        if !self.started {
            system.rates(force, &mut self.rates)?;
        }
        self.started = false;
        self.position.clone_from(&system.particles.position);
        self.velocity.clone_from(&system.particles.velocity);
        self.thermal.clone_from(&system.particles.thermal);
        let count = self.position.len();
        self.sum_energy.clear();
        self.sum_energy.resize(count, T::default());
        self.sum_heat.clear();
        self.sum_heat.resize(count, T::default());
        for stage in 0..self.stages.len() {
            if self.moves(stage) {
                self.predict(system, body, stage, dt);
                system.rates(force, &mut self.rates)?;
            }
            self.accumulate(system, stage, dt);
        }
        self.complete(system, body, dt);
        Ok(())
    }

    /// Whether a stage stands elsewhere than where the step begins.
    fn moves(&self, stage: usize) -> bool {
        let moves = |row: &[f64]| row.iter().any(|&weight| weight != 0.0);
        stage > 0
            || self.table.c[0] != 0.0
            || moves(&self.table.position[0])
            || moves(&self.table.velocity[0])
    }

    /// The state at which a stage is evaluated.
    fn predict<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &self,
        system: &mut ParticleSystem<D, G>,
        body: &B,
        stage: usize,
        dt: f64,
    ) {
        let Nystrom { c, position, velocity, .. } = &self.table;
        let (c, p, q) = (c[stage], &position[stage], &velocity[stage]);
        let kicked: f64 = q.iter().sum();
        let share = if kicked == 0.0 { 0.0 } else { c / kicked };
        let state = &mut system.particles;
        for i in 0..state.len() {
            let fall = body.acceleration(i).map(|a| c * dt * a);
            let mean = plus_scaled(&self.velocity[i], 0.5, &fall);
            let drifted = plus_scaled(&self.position[i], c * dt, &mean);
            state.position[i] = self.sum(drifted, dt * dt, p, i);
            state.velocity[i] = self.sum(plus_scaled(&self.velocity[i], 1.0, &fall), dt, q, i);
            state.thermal[i] = q
                .iter()
                .zip(&self.stages)
                .filter(|(weight, _)| **weight != 0.0)
                .fold(self.thermal[i], |sum, (weight, earlier)| {
                    sum.plus_scaled(share * weight * dt, earlier.heat[i])
                });
        }
    }

    /// `start + factor Σ_j w_j a_j` of a particle.
    #[inline]
    fn sum(&self, start: Vector<D>, factor: f64, weights: &[f64], i: usize) -> Vector<D> {
        weights
            .iter()
            .zip(&self.stages)
            .filter(|(weight, _)| **weight != 0.0)
            .fold(start, |sum, (weight, stage)| {
                plus_scaled(&sum, factor * weight, &stage.acceleration[i])
            })
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
        stage: usize,
        dt: f64,
    ) {
        let weight = self.table.velocity_weights[stage];
        let mut heat = std::mem::take(&mut self.stages[stage].heat);
        heat.clear();
        heat.extend((0..self.position.len()).map(|i| self.heat(i, &system.particles.velocity[i])));
        if weight != 0.0 {
            for (i, &heat) in heat.iter().enumerate() {
                self.sum_energy[i] = self.sum_energy[i].plus_scaled(weight, self.rates.energy[i]);
                self.sum_heat[i] = self.sum_heat[i].plus_scaled(weight, heat);
            }
            self.wall_impulse =
                plus_scaled(&self.wall_impulse, weight * dt, &self.rates.wall_force);
        }
        let kept = &mut self.stages[stage];
        kept.heat = heat;
        kept.acceleration.clone_from(&self.rates.acceleration);
    }

    fn complete<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &self,
        system: &mut ParticleSystem<D, G>,
        body: &mut B,
        dt: f64,
    ) {
        let Nystrom { position_weights, velocity_weights, .. } = &self.table;
        let state = &mut system.particles;
        for i in 0..state.len() {
            // The body force gives half of its impulse before the pairs give theirs.
            let fall = body.impulse(i, state.mass[i], 0.5 * dt);
            let velocity = &plus_scaled(&self.velocity[i], 1.0, &fall);
            let acceleration = self.sum([0.0; D], 1.0, velocity_weights, i);
            let heat = match self.work {
                Work::Instantaneous => self.sum_heat[i],
                Work::TimeCentred => {
                    // (v + v')/2 · (v' − v) is the change of kinetic energy, exactly.
                    let centred = plus_scaled(velocity, 0.5 * dt, &acceleration);
                    let work = T::from_energy(|| dot(&centred, &acceleration));
                    self.sum_energy[i].plus_scaled(-1.0, work)
                }
            };
            let drifted = plus_scaled(&self.position[i], dt, velocity);
            state.position[i] = self.sum(drifted, dt * dt, position_weights, i);
            state.velocity[i] = plus_scaled(velocity, dt, &acceleration);
            state.thermal[i] = self.thermal[i].plus_scaled(dt, heat);
        }
        body.drift(dt);
        body.update(state, &|_| true);
        for i in 0..state.len() {
            let fall = body.impulse(i, state.mass[i], 0.5 * dt);
            state.velocity[i] = plus_scaled(&state.velocity[i], 1.0, &fall);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::scheme::catalogue::integrators;

    #[test]
    fn explicit_integrators_run_and_the_others_are_refused_in_a_line() {
        let names = |runs: bool| -> Vec<&str> {
            let of = |one: &&Integrator| one.nystrom().is_some() == runs;
            integrators().iter().filter(of).map(|one| one.name.as_str()).collect()
        };
        for name in ["centred-euler", "leapfrog-dkd", "rk2-ralston", "dp5", "rk8", "ssp-10-4"] {
            assert!(names(true).contains(&name), "{name}");
        }
        for name in ["bdf2", "ab2", "crank-nicolson", "gauss-2", "predictor-corrector-pec"] {
            assert!(names(false).contains(&name), "{name}");
        }
        let refused = table(Integrator::named("bdf2").expect("it is in the list"));
        assert!(refused.unwrap_err().to_string().contains("integrator = bdf2"));
    }
}
