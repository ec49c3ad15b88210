//! The rates a pair force gives the particles: pairs first, each once; then sums over each particle's neighbours.

use super::gas::Gas;
use super::neighbours::{Block, Pair, for_each_block};
use super::pair_force::{Exchange, PairEnd, PairForce};
use super::system::ParticleSystem;
use super::thermal::ThermalState;
use super::vector::{Vector, dot, plus_scaled};
use crate::run::{Counters, Reason};

/// Time derivatives, of length N.
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
    exchanges: Vec<BlockExchange<D>>,
    gathered: Vec<Gathered<D, T>>,
}

impl<const D: usize, T> Default for Rates<D, T> {
    fn default() -> Self {
        Self {
            acceleration: Vec::new(),
            energy: Vec::new(),
            signal: Vec::new(),
            wall_force: [0.0; D],
            exchanges: Vec::new(),
            gathered: Vec::new(),
        }
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct PairRate {
    /// On the left end, along the line, masses included.
    force: f64,
    velocity: f64,
    signal: f64,
}

#[derive(Debug, Clone)]
struct BlockExchange<const D: usize> {
    block: usize,
    rates: Vec<PairRate>,
    interactions: u64,
    iterations: u64,
    wall_force: Vector<D>,
}

#[derive(Debug, Clone)]
struct Gathered<const D: usize, T> {
    block: usize,
    acceleration: Vec<Vector<D>>,
    energy: Vec<T>,
    signal: Vec<f64>,
}

impl<const D: usize, G: Gas> ParticleSystem<D, G> {
    fn end(&self, particle: usize, velocity: f64, volume_slope: f64) -> PairEnd {
        PairEnd {
            density: self.density[particle],
            pressure: self.pressure[particle],
            sound_speed: self.sound_speed[particle],
            velocity,
            smoothing: self.particles.smoothing[particle],
            volume_slope,
        }
    }

    fn pair_rate<F: PairForce>(&self, force: &F, pair: &Pair<D>) -> Option<(PairRate, Exchange)> {
        let state = &self.particles;
        let (first, second) = (pair.first as usize, pair.second as usize);
        let image = &self.neighbours.images()[pair.image as usize];
        let along = |v: &Vector<D>| dot(v, &pair.direction);
        let (mut slope_first, mut slope_second) = (0.0, 0.0);
        if !self.volume_gradient.is_empty() {
            slope_first = along(&self.volume_gradient[first]);
            slope_second = along(&image.reflect(&self.volume_gradient[second]));
        }
        let a = self.end(first, along(&state.velocity[first]), slope_first);
        let b = self.end(second, along(&image.reflect(&state.velocity[second])), slope_second);
        let (left, right) = if pair.first_is_left { (a, b) } else { (b, a) };
        let exchange = force.exchange(&left, &right, pair.distance, &self.sum.kernel)?;
        let rate = PairRate {
            force: exchange.force * state.mass[first] * state.mass[second],
            velocity: exchange.velocity,
            signal: left.sound_speed
                + right.sound_speed
                + (left.velocity - right.velocity).max(0.0),
        };
        Some((rate, exchange))
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
        self.evaluate(force, rates, |_| 1.0);
        Ok(())
    }

    /// The rates of the present fields, each pair multiplied by a factor; pairs of factor zero are
    /// not evaluated.
    pub(super) fn evaluate<F: PairForce>(
        &mut self,
        force: &F,
        rates: &mut Rates<D, G::Thermal>,
        factor: impl Fn(&Pair<D>) -> f64 + Sync,
    ) {
        let blocks = self.neighbours.blocks.len();
        rates.prepare(blocks);
        let system = &*self;
        for_each_block(&mut rates.exchanges, |out| {
            let block = &system.neighbours.blocks[out.block];
            for pair in &block.pairs {
                let factor = factor(pair);
                let found = if factor == 0.0 { None } else { system.pair_rate(force, pair) };
                let Some((mut rate, exchange)) = found else {
                    out.rates.push(PairRate::default());
                    continue;
                };
                rate.force *= factor;
                out.interactions += 1;
                out.iterations += u64::from(exchange.iterations);
                let image = &system.neighbours.images()[pair.image as usize];
                if image.reflects() {
                    let sign = if pair.first_is_left { rate.force } else { -rate.force };
                    let on_first = pair.direction.map(|component| sign * component);
                    out.wall_force = plus_scaled(&out.wall_force, 1.0, &on_first);
                    if pair.first != pair.second {
                        let on_second = image.reflect(&on_first);
                        out.wall_force = plus_scaled(&out.wall_force, -1.0, &on_second);
                    }
                }
                out.rates.push(rate);
            }
        });
        let exchanges = &rates.exchanges;
        for_each_block(&mut rates.gathered, |out| {
            let block = &system.neighbours.blocks[out.block];
            for k in 0..block.len {
                system.gather(block, k, exchanges, out);
            }
        });
        rates.collect(&mut self.counters);
    }

    /// The sum over the pairs of one particle.
    #[inline]
    fn gather(
        &self,
        block: &Block<D>,
        k: usize,
        exchanges: &[BlockExchange<D>],
        out: &mut Gathered<D, G::Thermal>,
    ) {
        let particle = block.start + k;
        let mut force = [0.0; D];
        let mut power = 0.0;
        let mut signal = 2.0 * self.sound_speed[particle];
        for neighbour in block.neighbours(k) {
            let (at, index) = neighbour.pair();
            let rate = &exchanges[at].rates[index];
            if rate.force == 0.0 {
                continue;
            }
            let pair = &self.neighbours.blocks[at].pairs[index];
            let is_left = neighbour.is_first == pair.first_is_left;
            let along = if is_left { rate.force } else { -rate.force };
            if neighbour.is_first {
                force = plus_scaled(&force, along, &pair.direction);
            } else {
                let image = &self.neighbours.images()[pair.image as usize];
                force = plus_scaled(&force, along, &image.reflect(&pair.direction));
            }
            power += along * rate.velocity;
            signal = signal.max(rate.signal);
        }
        let mass = self.particles.mass[particle];
        out.acceleration.push(force.map(|component| component / mass));
        out.energy.push(G::Thermal::from_energy(|| power / mass));
        out.signal.push(signal);
    }
}

impl<const D: usize, T: ThermalState> Rates<D, T> {
    fn prepare(&mut self, blocks: usize) {
        self.exchanges.resize_with(blocks, || BlockExchange {
            block: 0,
            rates: Vec::new(),
            interactions: 0,
            iterations: 0,
            wall_force: [0.0; D],
        });
        self.gathered.resize_with(blocks, || Gathered {
            block: 0,
            acceleration: Vec::new(),
            energy: Vec::new(),
            signal: Vec::new(),
        });
        for (block, exchange) in self.exchanges.iter_mut().enumerate() {
            exchange.block = block;
            exchange.rates.clear();
            exchange.interactions = 0;
            exchange.iterations = 0;
            exchange.wall_force = [0.0; D];
        }
        for (block, gathered) in self.gathered.iter_mut().enumerate() {
            gathered.block = block;
            gathered.acceleration.clear();
            gathered.energy.clear();
            gathered.signal.clear();
        }
    }

    fn collect(&mut self, counters: &mut Counters) {
        counters.evaluations += 1;
        self.wall_force = [0.0; D];
        for exchange in &self.exchanges {
            counters.interactions += exchange.interactions;
            counters.riemann_iterations += exchange.iterations;
            self.wall_force = plus_scaled(&self.wall_force, 1.0, &exchange.wall_force);
        }
        self.acceleration.clear();
        self.energy.clear();
        self.signal.clear();
        for gathered in &self.gathered {
            self.acceleration.extend_from_slice(&gathered.acceleration);
            self.energy.extend_from_slice(&gathered.energy);
            self.signal.extend_from_slice(&gathered.signal);
        }
    }
}
