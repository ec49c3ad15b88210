//! The rates a pair force gives the particles. A pair is evaluated once, by the one that comes first in the spatial
//! order; then everybody sums over neighbours.

use super::domain::Image;
use super::gas::Gas;
use super::neighbours::{BLOCK, Block, Link, Neighbour};
use super::pair_force::{PairEnd, PairForce};
use super::parallel::{fill, for_each_block};
use super::smoothing_kernel::RadialKernel;
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
    own: Vec<Own<D>>,
    sums: Vec<Sums<D>>,
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

/// A particle as its pairs see it, in spatial order: they read nothing else of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct End<const D: usize> {
    position: Vector<D>,
    velocity: Vector<D>,
    mass: f64,
    density: f64,
    pressure: f64,
    sound_speed: f64,
    smoothing: f64,
}

/// What a pair gives one of its ends, or the sum over pairs.
#[derive(Debug, Clone, Copy)]
struct Share<const D: usize> {
    force: Vector<D>,
    power: f64,
    signal: f64,
}

impl<const D: usize> Share<D> {
    const NONE: Self = Self { force: [0.0; D], power: 0.0, signal: 0.0 };

    #[inline]
    fn add(&mut self, sign: f64, other: &Self) {
        self.force = plus_scaled(&self.force, sign, &other.force);
        self.power += sign * other.power;
        self.signal = self.signal.max(other.signal);
    }
}

/// What is owed to a passive particle, by place.
#[derive(Debug, Clone, Copy)]
struct Owed<const D: usize> {
    place: u32,
    force: Vector<D>,
    power: f64,
}

/// What a block of particles has evaluated.
#[derive(Debug, Clone)]
struct Work<const D: usize> {
    owed: Vec<Owed<D>>,
    interactions: u64,
    iterations: u64,
    wall_force: Vector<D>,
}

impl<const D: usize> Work<D> {
    const NONE: Self =
        Self { owed: Vec::new(), interactions: 0, iterations: 0, wall_force: [0.0; D] };

    fn clear(&mut self) {
        self.owed.clear();
        (self.interactions, self.iterations, self.wall_force) = (0, 0, [0.0; D]);
    }
}

/// The pairs of a block with those after its particles, and the sums over them.
#[derive(Debug, Clone)]
struct Own<const D: usize> {
    block: usize,
    pairs: Vec<Share<D>>,
    sums: Vec<Share<D>>,
    work: Work<D>,
}

/// The sums of a block over all pairs.
#[derive(Debug, Clone)]
struct Sums<const D: usize> {
    block: usize,
    sums: Vec<Share<D>>,
    work: Work<D>,
}

/// Two ends, the place of each and the image seen of the second.
#[derive(Clone, Copy)]
struct Ends<'a, const D: usize> {
    at: usize,
    other: usize,
    image: &'a Image<D>,
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

    /// Displacement and distance of two ends that can interact, and the second's velocity as seen.
    #[inline]
    fn meet(&self, pair: Ends<'_, D>) -> Option<(Vector<D>, f64, Vector<D>)> {
        let (a, b) = (&self.ends[pair.at], &self.ends[pair.other]);
        let displacement = pair.image.displacement(&a.position, &b.position);
        let square = dot(&displacement, &displacement);
        // The kernel decides; this only spares what is certainly beyond it.
        let range = self.sum.kernel.support() * self.sum.reach * (1.0 + 1e-9);
        let edge = range * a.smoothing.max(b.smoothing);
        (square <= edge * edge)
            .then(|| (displacement, square.sqrt(), pair.image.reflect(&b.velocity)))
    }

    /// What the first end of a pair gets, masses included.
    #[inline]
    fn share<F: PairForce>(
        &self,
        force: &F,
        pair: Ends<'_, D>,
        work: &mut Work<D>,
    ) -> Option<Share<D>> {
        let (displacement, distance, velocity) = self.meet(pair)?;
        let (a, b) = (&self.ends[pair.at], &self.ends[pair.other]);
        // Whether the first is left: the first non-zero component of the displacement is positive.
        let is_left = displacement.iter().find(|&&d| d != 0.0).is_none_or(|&d| d > 0.0);
        let sign = if is_left { 1.0 } else { -1.0 };
        let direction = if distance > 0.0 {
            displacement.map(|component| sign * component / distance)
        } else {
            [0.0; D]
        };
        let slope = |place: usize, image: &Image<D>| {
            if self.volume_gradient.is_empty() {
                return 0.0;
            }
            let number = self.neighbours.cells.order[place] as usize;
            dot(&image.reflect(&self.volume_gradient[number]), &direction)
        };
        let compression = |place: usize| {
            let number = self.neighbours.cells.order[place] as usize;
            self.compression[number]
        };
        let end = |place: usize, velocity: &Vector<D>, volume_slope| {
            let end = &self.ends[place];
            PairEnd {
                density: end.density,
                pressure: end.pressure,
                sound_speed: end.sound_speed,
                velocity: dot(velocity, &direction),
                smoothing: end.smoothing,
                volume_slope,
                compression: if self.compression.is_empty() { 1.0 } else { compression(place) },
            }
        };
        let a_end = end(pair.at, &a.velocity, slope(pair.at, &Image::IDENTITY));
        let b_end = end(pair.other, &velocity, slope(pair.other, pair.image));
        let (left, right) = if is_left { (a_end, b_end) } else { (b_end, a_end) };
        let exchange = force.exchange(&left, &right, distance, &self.sum.kernel)?;
        work.interactions += 1;
        work.iterations += u64::from(exchange.iterations);
        let along = sign * exchange.force * (a.mass * b.mass);
        Some(Share {
            force: direction.map(|component| along * component),
            power: along * exchange.velocity,
            signal: signal(&left, &right),
        })
    }

    /// The rates of the present state, all fields updated first.
    ///
    /// # Errors
    /// As [`update_fields`](Self::update_fields).
    pub fn rates<F: PairForce>(
        &mut self,
        force: &F,
        rates: &mut Rates<D, G::Thermal>,
    ) -> Result<(), Reason> {
        self.update_fields()?;
        self.evaluate(force, rates, |_, _| 1.0);
        Ok(())
    }

    /// The rates of the present fields, by the pairs that have an active end, each multiplied by a factor of the
    /// numbers of its ends.
    pub(super) fn evaluate<F: PairForce>(
        &mut self,
        force: &F,
        rates: &mut Rates<D, G::Thermal>,
        factor: impl Fn(usize, usize) -> f64 + Sync,
    ) {
        self.pack();
        let blocks = self.neighbours.blocks.len();
        rates.own.resize_with(blocks, || Own {
            block: 0,
            pairs: Vec::new(),
            sums: Vec::new(),
            work: Work::NONE,
        });
        rates.sums.resize_with(blocks, || Sums { block: 0, sums: Vec::new(), work: Work::NONE });
        for (block, (own, sums)) in rates.own.iter_mut().zip(&mut rates.sums).enumerate() {
            (own.block, sums.block) = (block, block);
        }
        let system = &*self;
        let neighbours = &system.neighbours;
        let evaluate = |at: usize, neighbour: &Neighbour, work: &mut Work<D>| {
            let pair = Ends { at, other: neighbour.other as usize, image: system.image(neighbour) };
            let share = system.share(force, pair, work)?;
            let number = |place: usize| neighbours.cells.order[place] as usize;
            let factor = factor(number(pair.at), number(pair.other));
            let share = Share {
                force: share.force.map(|component| factor * component),
                power: factor * share.power,
                ..share
            };
            system.settle(pair, &share, work);
            Some(share)
        };
        for_each_block(&mut rates.own, |out| {
            let block: &Block = &neighbours.blocks[out.block];
            out.pairs.clear();
            out.sums.clear();
            out.work.clear();
            for k in 0..block.len {
                let at = neighbours.active[block.start + k] as usize;
                let mut sum = Share::NONE;
                for neighbour in block.after(k) {
                    let share = evaluate(at, neighbour, &mut out.work).unwrap_or(Share::NONE);
                    sum.add(1.0, &share);
                    out.pairs.push(share);
                }
                out.sums.push(sum);
            }
        });
        let own = &rates.own;
        for_each_block(&mut rates.sums, |out| {
            let block: &Block = &neighbours.blocks[out.block];
            out.sums.clear();
            out.work.clear();
            for k in 0..block.len {
                let at = neighbours.active[block.start + k] as usize;
                let mut sum = Share::NONE;
                for neighbour in block.before(k).iter().rev() {
                    if let Link::Known(pair) = neighbour.link() {
                        let (block, index) = neighbours.pair(neighbour.other as usize, pair);
                        sum.add(-1.0, &own[block].pairs[index]);
                    } else if let Some(share) = evaluate(at, neighbour, &mut out.work) {
                        sum.add(1.0, &share);
                    }
                }
                let mut total = own[out.block].sums[k];
                total.add(1.0, &sum);
                total.signal = total.signal.max(2.0 * system.ends[at].sound_speed);
                out.sums.push(total);
            }
        });
        self.collect(rates);
    }

    /// Books a pair: what walls and passive particles get of it, and that each pair counts once.
    #[inline]
    fn settle(&self, pair: Ends<'_, D>, share: &Share<D>, work: &mut Work<D>) {
        let reflects = pair.image.reflects();
        if reflects {
            work.wall_force = plus_scaled(&work.wall_force, 1.0, &share.force);
        }
        if !self.neighbours.is_active(pair.other) {
            let force = pair.image.reflect(&share.force).map(|component| -component);
            if reflects {
                work.wall_force = plus_scaled(&work.wall_force, 1.0, &force);
            }
            work.owed.push(Owed { place: pair.other as u32, force, power: -share.power });
        } else if *pair.image != Image::IDENTITY && pair.at > pair.other {
            // The other end counts it.
            work.interactions -= 1;
        }
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
        for work in
            (rates.own.iter().map(|own| &own.work)).chain(rates.sums.iter().map(|s| &s.work))
        {
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
        for work in
            (rates.own.iter().map(|own| &own.work)).chain(rates.sums.iter().map(|s| &s.work))
        {
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
        let (neighbours, mut by_place) = (&self.neighbours, Vec::new());
        fill(&mut by_place, self.particles.len(), |at| {
            let block = &neighbours.blocks[at / BLOCK];
            let own = 2.0 * self.ends[at].sound_speed;
            block.all(at % BLOCK).fold(own, |largest, neighbour| {
                let pair =
                    Ends { at, other: neighbour.other as usize, image: self.image(neighbour) };
                let Some((displacement, distance, velocity)) = self.meet(pair) else {
                    return largest;
                };
                let (a, b) = (&self.ends[at], &self.ends[pair.other]);
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

fn signal(left: &PairEnd, right: &PairEnd) -> f64 {
    left.sound_speed + right.sound_speed + (left.velocity - right.velocity).max(0.0)
}
