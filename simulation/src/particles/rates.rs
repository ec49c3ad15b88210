//! The rates a pair force gives the particles. A pair is evaluated once, by the one that comes first in the spatial
//! order; then everybody sums over neighbours.

use super::gas::Gas;
use super::neighbours::{BLOCK, Link};
use super::pair_loops::{BlockPairs, End, Ends, PairLoops, PairSteps, Pairs, Share};
use super::parallel::{fill, for_each_block};
use super::system::ParticleSystem;
use super::thermal::ThermalState;
use super::vector::{Vector, dot, plus_scaled};
use crate::run::Reason;

/// Time derivatives, of length N, by number.
#[derive(Debug, Clone)]
pub struct Rates<const D: usize, T> {
    /// `dv/dt`.
    pub acceleration: Vec<Vector<D>>,
    /// Rate of the specific *total* energy; a particle of velocity `w` heats by this minus `w·dv/dt`.
    pub energy: Vec<T>,
    /// The largest signal velocity among a particle's pairs, `c_L + c_R + max(0, v_L − v_R)`; the
    /// sound speed's double for a particle alone.
    pub signal: Vec<f64>,
    /// Force of the walls on the particles, momentum per time.
    pub wall_force: Vector<D>,
    /// The numbers of the particles whose rates the last evaluation has set, if not all.
    pub(super) touched: Vec<u32>,
    is_touched: Vec<bool>,
    /// The sums over pairs with those after each particle, and over all pairs.
    own: Vec<BlockPairs<D>>,
    sums: Vec<BlockPairs<D>>,
}

impl<const D: usize, T> Default for Rates<D, T> {
    fn default() -> Self {
        Self {
            acceleration: Vec::new(),
            energy: Vec::new(),
            signal: Vec::new(),
            wall_force: [0.0; D],
            touched: Vec::new(),
            is_touched: Vec::new(),
            own: Vec::new(),
            sums: Vec::new(),
        }
    }
}

impl<const D: usize, G: Gas> ParticleSystem<D, G> {
    /// Copies what pairs need into spatial order.
    fn pack(&mut self) {
        let (state, cells) = (&self.particles, &self.neighbours.cells);
        let (density, pressure, sound_speed) = (&self.density, &self.pressure, &self.sound_speed);
        fill(&mut self.ends, state.len(), |at| {
            let i = cells.order[at] as usize;
            End {
                position: cells.position[at],
                velocity: state.velocity[i],
                mass: state.mass[i],
                density: density[i],
                pressure: pressure[i],
                sound_speed: sound_speed[i],
                smoothing: state.smoothing[i],
            }
        });
    }

    /// The pairs of the fields that were packed last.
    fn pairs<'a>(&'a self, steps: Option<PairSteps<'a>>) -> Pairs<'a, D> {
        Pairs {
            ends: &self.ends,
            neighbours: &self.neighbours,
            kernel: &self.sum.kernel,
            reach: self.sum.reach,
            volume_gradient: &self.volume_gradient,
            compression: &self.compression,
            outside: self.outside,
            steps,
        }
    }

    /// The rates of the present state, all fields updated first.
    ///
    /// # Errors
    /// As [`update_fields`](Self::update_fields).
    pub fn rates(
        &mut self,
        force: &dyn PairLoops<D>,
        rates: &mut Rates<D, G::Thermal>,
    ) -> Result<(), Reason> {
        self.update_fields()?;
        self.evaluate(force, rates, None);
        Ok(())
    }

    /// The rates of the present fields, by the pairs that have an active end, each multiplied by its step if there are
    /// `steps`.
    pub(super) fn evaluate(
        &mut self,
        force: &dyn PairLoops<D>,
        rates: &mut Rates<D, G::Thermal>,
        steps: Option<PairSteps<'_>>,
    ) {
        self.pack();
        self.pairs(steps).evaluate_all(force, &mut rates.own, &mut rates.sums);
        self.collect(rates);
    }

    /// From the places of blocks to numbers.
    fn collect(&mut self, rates: &mut Rates<D, G::Thermal>) {
        let count = self.particles.len();
        let neighbours = &self.neighbours;
        rates.acceleration.resize(count, [0.0; D]);
        rates.energy.resize(count, G::Thermal::default());
        rates.signal.resize(count, 0.0);
        rates.wall_force = [0.0; D];
        rates.touched.clear();
        self.counters.evaluations += 1;
        let mut owed = false;
        for BlockPairs { work, .. } in rates.own.iter().chain(&rates.sums) {
            self.counters.interactions += work.interactions;
            self.counters.riemann_iterations += work.iterations;
            rates.wall_force = plus_scaled(&rates.wall_force, 1.0, &work.wall_force);
            owed |= !work.owed.is_empty();
        }
        let is_partial = neighbours.active.len() < count;
        for out in &rates.sums {
            let block = &neighbours.blocks[out.block];
            for (k, sum) in out.sums.iter().enumerate() {
                let number = neighbours.number(block, k);
                let mass = self.particles.mass[number];
                rates.acceleration[number] = sum.force.map(|component| component / mass);
                rates.energy[number] = G::Thermal::from_energy(|| sum.power / mass);
                rates.signal[number] = sum.signal;
                if is_partial {
                    rates.touched.push(number as u32);
                }
            }
        }
        if !owed {
            return;
        }
        rates.is_touched.resize(count, false);
        let active = rates.touched.len();
        for BlockPairs { work, .. } in rates.own.iter().chain(&rates.sums) {
            for owed in &work.owed {
                let number = neighbours.cells.order[owed.place as usize] as usize;
                if !rates.is_touched[number] {
                    rates.is_touched[number] = true;
                    rates.touched.push(number as u32);
                    rates.acceleration[number] = [0.0; D];
                    rates.energy[number] = G::Thermal::default();
                }
                let mass = self.particles.mass[number];
                rates.acceleration[number] =
                    plus_scaled(&rates.acceleration[number], 1.0 / mass, &owed.force);
                let energy = G::Thermal::from_energy(|| owed.power / mass);
                rates.energy[number] = rates.energy[number].plus_scaled(1.0, energy);
            }
        }
        for &number in &rates.touched[active..] {
            rates.is_touched[number as usize] = false;
        }
    }

    /// Everybody's signal velocity, by number, without the forces.
    pub(super) fn signals(&mut self, signal_velocity: &mut Vec<f64>) {
        self.pack();
        let (pairs, mut by_place) = (self.pairs(None), Vec::new());
        let neighbours = pairs.neighbours;
        fill(&mut by_place, self.particles.len(), |at| {
            let block = &neighbours.blocks[at / BLOCK];
            let own = 2.0 * pairs.ends[at].sound_speed;
            block.all(at % BLOCK).fold(own, |largest, &neighbour| {
                let (other, image) = (neighbour.other as usize, neighbours.image(neighbour));
                let met = pairs.meet(Ends { at, other, image });
                let Some((displacement, distance, velocity)) = met else { return largest };
                let (a, b) = (&pairs.ends[at], &pairs.ends[other]);
                let apart: Vector<D> =
                    std::array::from_fn(|axis| a.velocity[axis] - velocity[axis]);
                let closing =
                    if distance > 0.0 { dot(&apart, &displacement) / distance } else { 0.0 };
                largest.max(a.sound_speed + b.sound_speed + closing.max(0.0))
            })
        });
        signal_velocity.resize(by_place.len(), 0.0);
        for (&number, &value) in neighbours.cells.order.iter().zip(&by_place) {
            signal_velocity[number as usize] = value;
        }
    }
}

impl<const D: usize> Pairs<'_, D> {
    /// Evaluates all pairs: first those with the neighbours after each particle, then the sums over all.
    fn evaluate_all(
        &self,
        force: &dyn PairLoops<D>,
        own: &mut Vec<BlockPairs<D>>,
        sums: &mut Vec<BlockPairs<D>>,
    ) {
        let neighbours = self.neighbours;
        for all in [&mut *own, &mut *sums] {
            all.truncate(neighbours.blocks.len());
            all.extend((all.len()..neighbours.blocks.len()).map(BlockPairs::new));
        }
        for_each_block(own, &|out| force.block(self, out));
        let own = &*own;
        for_each_block(sums, &|out| {
            let block = &neighbours.blocks[out.block];
            out.clear();
            for k in 0..block.len {
                let at = neighbours.active[block.start + k] as usize;
                let mut sum = Share::NONE;
                for &neighbour in block.before(k).iter().rev() {
                    if let Link::Known(pair) = neighbour.link() {
                        let (block, index) = neighbours.pair(neighbour.other as usize, pair);
                        sum.add(-1.0, &own[block].pairs[index]);
                    } else if let Some(share) = force.pair(self, at, neighbour, &mut out.work) {
                        sum.add(1.0, &share);
                    }
                }
                let mut total = own[out.block].sums[k];
                total.add(1.0, &sum);
                total.signal = total.signal.max(2.0 * self.ends[at].sound_speed);
                out.sums.push(total);
            }
        });
    }
}
