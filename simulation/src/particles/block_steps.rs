//! Individual time steps in blocks of powers of two.

use super::body_force::BodyForce;
use super::gas::Gas;
use super::integrator::Work;
use super::pair_loops::{PairLoops, PairSteps};
use super::rates::Rates;
use super::system::ParticleSystem;
use super::thermal::ThermalState;
use super::vector::{Vector, dot, plus_scaled};
use crate::run::Reason;

/// Steps of particles that interact differ by this factor at most (Saitoh & Makino 2009).
pub const STEP_RATIO: u32 = 4;

/// Advances particles by steps `Δ/2^level`, first order in time.
///
/// A block of length `Δ` begins with everybody at one time. Levels are set there, from the signal
/// velocities of each particle and of those around it, and so that the steps of two which interact differ by a factor of
/// `STEP_RATIO` at most; they hold for the block. A **pair** has the shorter step of its two particles: its force is evaluated
/// when that step begins and its impulse goes to both, so that momentum is conserved to round-off
/// whatever the levels. A particle takes the sum of its impulses at the end of its own step; until
/// then it moves with its old velocity. With time-centred work the total energy is conserved to round-off
/// too. With a single level this is centred Euler.
///
/// In a substep the *active* particles, whose step begins, search their neighbours, sum their density and evaluate
/// their pairs. The passive ones are seen where their velocity has taken them, with the density, pressure and
/// sound speed of the beginning of their own step, and get their half of the impulses.
#[derive(Debug, Clone)]
pub struct BlockStepper<const D: usize, T> {
    levels: u32,
    courant: f64,
    /// Which velocity the heating uses.
    pub work: Work,
    rates: Rates<D, T>,
    /// Of the last block, 0 the longest step.
    level: Vec<u32>,
    signal: Vec<f64>,
    active: Vec<u32>,
    impulse: Vec<Vector<D>>,
    energy: Vec<T>,
    /// Momentum that the walls have given so far.
    pub wall_impulse: Vector<D>,
    /// Substeps taken so far.
    pub substeps: u64,
}

impl<const D: usize, T: ThermalState> BlockStepper<D, T> {
    /// At most `levels` halvings; steps of `courant` crossing times.
    pub fn new(levels: u32, courant: f64) -> Self {
        Self {
            levels,
            courant,
            work: Work::TimeCentred,
            rates: Rates::default(),
            level: Vec::new(),
            signal: Vec::new(),
            active: Vec::new(),
            impulse: Vec::new(),
            energy: Vec::new(),
            wall_impulse: [0.0; D],
            substeps: 0,
        }
    }

    /// Looks at the signal velocities where a block begins, the fields of the system being those of its
    /// state; the longest block.
    pub fn begin<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        body: &B,
    ) -> f64 {
        system.signals(&mut self.signal);
        self.warn(system);
        let steps = || (0..system.particles.len()).map(|i| self.own_step(system, body, i));
        let (shortest, slowest) =
            (steps().fold(f64::INFINITY, f64::min), steps().fold(0.0, f64::max));
        slowest.min(shortest * f64::from(1_u32 << self.levels))
    }

    fn own_step<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &self,
        system: &ParticleSystem<D, G>,
        body: &B,
        i: usize,
    ) -> f64 {
        let h = system.particles.smoothing[i];
        (self.courant * h / self.signal[i]).min(body.longest_step(i, self.courant, h))
    }

    /// One block of the given length, after [`begin`](Self::begin).
    ///
    /// # Errors
    /// [`Reason`] if the particles leave the states of a gas.
    pub fn block<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &dyn PairLoops<D>,
        body: &mut B,
        length: f64,
    ) -> Result<(), Reason> {
        let count = system.particles.len();
        let mut level = std::mem::take(&mut self.level);
        level.clear();
        level.extend((0..count).map(|i| {
            ((length / self.own_step(system, body, i)).log2().ceil().max(0.0) as u32)
                .min(self.levels)
        }));
        self.level = level;
        self.level_out(system);
        self.impulse.clear();
        self.impulse.resize(count, [0.0; D]);
        self.energy.clear();
        self.energy.resize(count, T::default());
        let finest = self.level.iter().copied().max().unwrap_or(0);
        let ticks = 1_u32 << finest;
        let tick = length / f64::from(ticks);
        for now in 0..ticks {
            if now > 0 {
                self.active.clear();
                let begins = |level: u32| now.is_multiple_of(1 << (finest - level));
                self.active
                    .extend((0..).zip(&self.level).filter(|&(_, &l)| begins(l)).map(|(i, _)| i));
                if self.active.len() < count {
                    system.update_active(&self.active)?;
                } else {
                    system.update_fields()?;
                }
            }
            self.kick(system, force, finest, tick);
            for (x, v) in system.particles.position.iter_mut().zip(&system.particles.velocity) {
                *x = plus_scaled(x, tick, v);
            }
            body.drift(tick);
            self.close(system, body, finest, now + 1, tick);
            self.substeps += 1;
        }
        Ok(())
    }

    /// Signal velocities, the largest among a particle's neighbours, their neighbours, and so on
    /// through as many shells as there are levels: the way of a shock during the block. Without it
    /// a cold particle would be run over in the middle of a step it chose in peace.
    fn warn<G: Gas<Thermal = T>>(&mut self, system: &ParticleSystem<D, G>) {
        for _ in 0..self.levels {
            system.neighbours.spread(&mut self.signal, f64::max);
        }
    }

    /// Raises levels until the steps of two that interact differ by a factor of `STEP_RATIO` at most.
    fn level_out<G: Gas<Thermal = T>>(&mut self, system: &ParticleSystem<D, G>) {
        let least = |own: u32, other: u32| own.max(other.saturating_sub(STEP_RATIO.ilog2()));
        while system.neighbours.spread(&mut self.level, least) {}
    }

    /// The impulses of the pairs whose step begins now: those with an active end.
    fn kick<G: Gas<Thermal = T>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &dyn PairLoops<D>,
        finest: u32,
        tick: f64,
    ) {
        let steps = PairSteps { level: &self.level, finest, tick };
        system.evaluate(force, &mut self.rates, Some(steps));
        let rates = &self.rates;
        let mut add = |i: usize| {
            self.impulse[i] = plus_scaled(&self.impulse[i], 1.0, &rates.acceleration[i]);
            self.energy[i] = self.energy[i].plus_scaled(1.0, rates.energy[i]);
        };
        if rates.touched.is_empty() {
            (0..self.level.len()).for_each(&mut add);
        } else {
            rates.touched.iter().for_each(|&i| add(i as usize));
        }
        self.wall_impulse = plus_scaled(&self.wall_impulse, 1.0, &self.rates.wall_force);
    }

    /// Gives the particles whose step ends now what they have been owed, and the body force.
    fn close<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        body: &mut B,
        finest: u32,
        now: u32,
        tick: f64,
    ) {
        let state = &mut system.particles;
        let level = &self.level;
        let half = |i: usize| {
            let ticks = 1_u32 << (finest - level[i]);
            now.is_multiple_of(ticks).then(|| 0.5 * f64::from(ticks) * tick)
        };
        for i in 0..state.len() {
            let Some(half) = half(i) else { continue };
            let change = self.impulse[i];
            let old = state.velocity[i];
            // The body force gives half of its impulse before the pairs give theirs.
            let fall = body.impulse(i, state.mass[i], half);
            let falling = plus_scaled(&old, 1.0, &fall);
            let seen = match self.work {
                Work::Instantaneous => old,
                Work::TimeCentred => plus_scaled(&falling, 0.5, &change),
            };
            let done = T::from_energy(|| dot(&seen, &change));
            state.thermal[i] =
                state.thermal[i].plus_scaled(1.0, self.energy[i].plus_scaled(-1.0, done));
            let late = plus_scaled(&change, 2.0, &fall);
            state.position[i] = plus_scaled(&state.position[i], half, &late);
            state.velocity[i] = plus_scaled(&falling, 1.0, &change);
            self.impulse[i] = [0.0; D];
            self.energy[i] = T::default();
        }
        body.update(state, &|i| half(i).is_some());
        for i in 0..state.len() {
            if let Some(half) = half(i) {
                let fall = body.impulse(i, state.mass[i], half);
                state.velocity[i] = plus_scaled(&state.velocity[i], 1.0, &fall);
            }
        }
    }
}
