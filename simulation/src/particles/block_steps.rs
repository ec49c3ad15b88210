//! Individual time steps in blocks of powers of two.

use super::body_force::BodyForce;
use super::gas::Gas;
use super::integrator::Work;
use super::neighbours::Neighbour;
use super::pair_force::PairForce;
use super::rates::Rates;
use super::system::{ParticleSystem, keep_only};
use super::thermal::ThermalState;
use super::vector::{Vector, dot, plus_scaled};
use crate::run::Reason;

/// Steps of particles that interact differ by this factor at most (Saitoh & Makino 2009).
pub const STEP_RATIO: u32 = 4;

/// Advances particles by steps `Δ/2^level`, by leapfrog.
///
/// A block of length `Δ` begins with everybody at one time. Levels are set there, from the signal
/// velocities of each particle and of those that reach it within the block, and so that the steps of two which interact differ by a factor of
/// `STEP_RATIO` at most; a step that becomes too long is halved within the block, and lengthened in the next. A **pair** has the shorter step of its two particles. Between two of its
/// steps its force is evaluated, and its impulse, half of that of either step, goes to both at once: momentum is
/// conserved to round-off whatever the levels, and so is the total energy with time-centred work. Then all drift. Positions are of second order in time for
/// forces that do not depend on velocities; **velocities are those of half a step before**.
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
    level: Vec<u32>,
    /// Everybody's last step and present one.
    last: Vec<f64>,
    step: Vec<f64>,
    signal: Vec<f64>,
    active: Vec<u32>,
    /// Momentum that the walls have given so far.
    pub wall_impulse: Vector<D>,
    /// Substeps taken so far.
    pub substeps: u64,
}

/// A signal on its way: how fast, and the way back to where it comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Front<const D: usize> {
    signal: f64,
    way: Vector<D>,
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
            last: Vec::new(),
            step: Vec::new(),
            signal: Vec::new(),
            active: Vec::new(),
            wall_impulse: [0.0; D],
            substeps: 0,
        }
    }

    /// The levels at the end of the last block, 0 the longest step.
    pub fn levels(&self) -> &[u32] {
        &self.level
    }

    /// Looks at the signal velocities where a block begins, the fields of the system being those of its
    /// state; the longest block.
    pub fn begin<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        body: &B,
    ) -> f64 {
        system.signals(&mut self.signal);
        let length = self.longest_block(system, body);
        self.warn(system, length);
        self.longest_block(system, body)
    }

    fn longest_block<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &self,
        system: &ParticleSystem<D, G>,
        body: &B,
    ) -> f64 {
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
    pub fn block<G: Gas<Thermal = T>, F: PairForce, B: BodyForce<D>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &F,
        body: &mut B,
        length: f64,
    ) -> Result<(), Reason> {
        let count = system.particles.len();
        let mut level = std::mem::take(&mut self.level);
        level.clear();
        level.extend((0..count).map(|i| self.level_for(self.own_step(system, body, i), length)));
        self.level = level;
        self.level_out(system);
        self.step.resize(count, 0.0);
        // Before the first step there is none.
        self.last.resize(count, 0.0);
        let before = self.last.clone();
        let mut now = 0;
        while now < 1 << self.levels {
            match self.substep(system, force, body, now, length) {
                Ok(next) => now = next,
                Err(reason) => {
                    self.last = before;
                    return Err(reason);
                }
            }
        }
        Ok(())
    }

    fn level_for(&self, step: f64, length: f64) -> u32 {
        ((length / step).log2().ceil().max(0.0) as u32).min(self.levels)
    }

    /// Ticks of a step; there are `2^levels` in a block.
    fn ticks(&self, level: u32) -> u32 {
        1 << (self.levels - level)
    }

    /// The substep from the tick `now` of the block to the next that somebody begins with.
    fn substep<G: Gas<Thermal = T>, F: PairForce, B: BodyForce<D>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &F,
        body: &mut B,
        now: u32,
        length: f64,
    ) -> Result<u32, Reason> {
        let mut active = std::mem::take(&mut self.active);
        active.clear();
        let begins = |level: u32| now.is_multiple_of(self.ticks(level));
        active.extend((0..).zip(&self.level).filter(|&(_, &l)| begins(l)).map(|(i, _)| i));
        self.active = active;
        if now > 0 {
            if self.active.len() < self.level.len() {
                system.update_active(&self.active)?;
            } else {
                system.update_fields()?;
            }
            self.refine(system, body, length);
        }
        for i in self.active.iter().map(|&i| i as usize) {
            self.step[i] = length / f64::from(1_u32 << self.level[i]);
        }
        self.kick(system, force, body);
        let finest = self.level.iter().copied().max().unwrap_or(0);
        let tick = length / f64::from(1_u32 << finest);
        for (x, v) in system.particles.position.iter_mut().zip(&system.particles.velocity) {
            *x = plus_scaled(x, tick, v);
        }
        body.drift(tick);
        let next = now + self.ticks(finest);
        let ends = |i: usize| next.is_multiple_of(self.ticks(self.level[i]));
        body.update(&system.particles, ends);
        let stays = body.settle(system, ends);
        if !stays.is_empty() {
            let stays = |i: usize| stays[i];
            keep_only(&mut self.level, stays);
            keep_only(&mut self.signal, stays);
            keep_only(&mut self.last, stays);
            keep_only(&mut self.step, stays);
        }
        self.substeps += 1;
        Ok(next)
    }

    /// Halves the steps of active particles where they have become too long since the block began: what falls in is faster
    /// at the end of a block.
    fn refine<G: Gas<Thermal = T>, B: BodyForce<D>>(
        &mut self,
        system: &ParticleSystem<D, G>,
        body: &B,
        length: f64,
    ) {
        for i in self.active.iter().map(|&i| i as usize) {
            let level = self.level_for(self.own_step(system, body, i), length);
            self.level[i] = self.level[i].max(level);
        }
        let neighbours = &system.neighbours;
        for block in &neighbours.blocks {
            for k in 0..block.len {
                let others = block.all(k).map(|other| neighbours.cells.order[other.other as usize]);
                let finest = others.map(|other| self.level[other as usize]).max().unwrap_or(0);
                let level = &mut self.level[neighbours.number(block, k)];
                *level = finest.saturating_sub(STEP_RATIO.ilog2()).max(*level);
            }
        }
    }

    /// Everybody's signal velocity becomes the largest of those that reach him within a block of that length, each
    /// travelling at itself: the way of a shock. Without it a cold particle would be run over in the middle of a
    /// step it chose in peace.
    fn warn<G: Gas<Thermal = T>>(&mut self, system: &ParticleSystem<D, G>, length: f64) {
        let mut fronts: Vec<Front<D>> =
            self.signal.iter().map(|&signal| Front { signal, way: [0.0; D] }).collect();
        let positions = &system.neighbours.cells.position;
        system.neighbours.spread(&mut fronts, |at, own, neighbour: &Neighbour, other| {
            if other.signal <= own.signal {
                return own;
            }
            let (image, there) = (system.image(neighbour), neighbour.other as usize);
            let displacement = image.displacement(&positions[at], &positions[there]);
            let way = plus_scaled(&displacement, 1.0, &image.reflect(&other.way));
            let reach = other.signal * length;
            if dot(&way, &way) < reach * reach { Front { way, ..other } } else { own }
        });
        for (signal, front) in self.signal.iter_mut().zip(&fronts) {
            *signal = front.signal;
        }
    }

    /// Raises levels until the steps of two that interact differ by a factor of `STEP_RATIO` at most.
    fn level_out<G: Gas<Thermal = T>>(&mut self, system: &ParticleSystem<D, G>) {
        let least = |_, own: u32, _: &Neighbour, other: u32| {
            own.max(other.saturating_sub(STEP_RATIO.ilog2()))
        };
        system.neighbours.spread(&mut self.level, least);
    }

    /// The impulses between the steps that have ended and those that begin: of the body force, and of the pairs with an active
    /// end.
    fn kick<G: Gas<Thermal = T>, F: PairForce, B: BodyForce<D>>(
        &mut self,
        system: &mut ParticleSystem<D, G>,
        force: &F,
        body: &mut B,
    ) {
        let (last, step) = (&self.last, &self.step);
        system.evaluate(force, &mut self.rates, |a, b| {
            0.5 * (last[a].min(last[b]) + step[a].min(step[b]))
        });
        let state = &mut system.particles;
        for i in self.active.iter().map(|&i| i as usize) {
            let fall = body.impulse(i, state.mass[i], 0.5 * (last[i] + step[i]));
            state.velocity[i] = plus_scaled(&state.velocity[i], 1.0, &fall);
        }
        let (rates, work) = (&self.rates, self.work);
        let mut push = |i: usize| {
            let (old, change) = (state.velocity[i], rates.acceleration[i]);
            let seen = match work {
                Work::Instantaneous => old,
                Work::TimeCentred => plus_scaled(&old, 0.5, &change),
            };
            let done = T::from_energy(|| dot(&seen, &change));
            state.thermal[i] =
                state.thermal[i].plus_scaled(1.0, rates.energy[i].plus_scaled(-1.0, done));
            state.velocity[i] = plus_scaled(&old, 1.0, &change);
        };
        // Of a substep whose particles have all been taken out, nobody is touched.
        if self.active.len() == last.len() {
            (0..last.len()).for_each(&mut push);
        } else {
            rates.touched.iter().for_each(|&i| push(i as usize));
        }
        self.wall_impulse = plus_scaled(&self.wall_impulse, 1.0, &self.rates.wall_force);
        for i in self.active.iter().map(|&i| i as usize) {
            self.last[i] = self.step[i];
            self.signal[i] = self.signal[i].max(self.rates.signal[i]);
        }
    }
}
