//! The loops over pairs. They alone are compiled for each pair force and dimension; all around them asks for a force by
//! its table of functions, once for a block of particles.

use super::domain::Image;
use super::neighbours::{Block, Neighbour, Neighbours};
use super::pair_force::{PairEnd, PairForce};
use super::smoothing_kernel::{RadialKernel, SmoothingKernel};
use super::vector::{Vector, dot, plus_scaled};

/// A particle as its pairs see it, in spatial order: they read nothing else of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct End<const D: usize> {
    pub position: Vector<D>,
    pub velocity: Vector<D>,
    pub mass: f64,
    pub density: f64,
    pub pressure: f64,
    pub sound_speed: f64,
    pub smoothing: f64,
}

/// What a pair gives one of its ends, or the sum over pairs.
#[derive(Debug, Clone, Copy)]
pub struct Share<const D: usize> {
    pub(super) force: Vector<D>,
    pub(super) power: f64,
    pub(super) signal: f64,
}

impl<const D: usize> Share<D> {
    pub(super) const NONE: Self = Self { force: [0.0; D], power: 0.0, signal: 0.0 };

    #[inline]
    pub(super) fn add(&mut self, sign: f64, other: &Self) {
        self.force = plus_scaled(&self.force, sign, &other.force);
        self.power += sign * other.power;
        self.signal = self.signal.max(other.signal);
    }
}

/// What is owed to a passive particle, by place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Owed<const D: usize> {
    pub place: u32,
    pub force: Vector<D>,
    pub power: f64,
}

/// What a block of particles has evaluated.
#[derive(Debug, Clone)]
pub struct Work<const D: usize> {
    pub(super) owed: Vec<Owed<D>>,
    pub(super) interactions: u64,
    pub(super) iterations: u64,
    pub(super) wall_force: Vector<D>,
}

impl<const D: usize> Work<D> {
    fn clear(&mut self) {
        self.owed.clear();
        (self.interactions, self.iterations, self.wall_force) = (0, 0, [0.0; D]);
    }
}

/// Pairs of a block of particles and the sums over them.
#[derive(Debug, Clone)]
pub struct BlockPairs<const D: usize> {
    pub(super) block: usize,
    /// Those with neighbours after its particles, in the order of the lists.
    pub(super) pairs: Vec<Share<D>>,
    pub(super) sums: Vec<Share<D>>,
    pub(super) work: Work<D>,
}

impl<const D: usize> BlockPairs<D> {
    pub(super) fn new(block: usize) -> Self {
        let work = Work { owed: Vec::new(), interactions: 0, iterations: 0, wall_force: [0.0; D] };
        Self { block, pairs: Vec::new(), sums: Vec::new(), work }
    }

    pub(super) fn clear(&mut self) {
        self.pairs.clear();
        self.sums.clear();
        self.work.clear();
    }
}

/// The factors of pairs whose ends have steps of their own, `Δ/2^level`: each pair has the shorter one.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairSteps<'a> {
    /// By number.
    pub level: &'a [u32],
    pub finest: u32,
    /// The step of the finest level.
    pub tick: f64,
}

impl PairSteps<'_> {
    #[inline]
    fn of(&self, a: usize, b: usize) -> f64 {
        f64::from(1_u32 << (self.finest - self.level[a].max(self.level[b]))) * self.tick
    }
}

/// The ends of all pairs, and what else is read of a system.
#[derive(Debug, Clone, Copy)]
pub struct Pairs<'a, const D: usize> {
    pub(super) ends: &'a [End<D>],
    pub(super) neighbours: &'a Neighbours<D>,
    pub(super) kernel: &'a SmoothingKernel<D>,
    /// Of the force, in units of the kernel's support.
    pub(super) reach: f64,
    /// By number, or empty.
    pub(super) volume_gradient: &'a [Vector<D>],
    pub(super) compression: &'a [f64],
    /// The pressure of the medium around the gas, where there is one.
    pub(super) outside: Option<f64>,
    /// What forces are multiplied by; `None` is one.
    pub(super) steps: Option<PairSteps<'a>>,
}

/// Two ends, the place of each and the image seen of the second.
#[derive(Clone, Copy)]
pub(super) struct Ends<'a, const D: usize> {
    pub at: usize,
    pub other: usize,
    pub image: &'a Image<D>,
}

/// A pair force with its loops in `D` dimensions.
pub trait PairLoops<const D: usize>: PairForce {
    /// What the pair of the particle at a place with a neighbour gives it, if they interact.
    fn pair(
        &self,
        pairs: &Pairs<'_, D>,
        at: usize,
        neighbour: Neighbour,
        work: &mut Work<D>,
    ) -> Option<Share<D>>;

    /// Evaluates the pairs of a block with the neighbours after its particles.
    fn block(&self, pairs: &Pairs<'_, D>, out: &mut BlockPairs<D>);
}

impl<const D: usize, F: PairForce> PairLoops<D> for F {
    fn pair(
        &self,
        pairs: &Pairs<'_, D>,
        at: usize,
        neighbour: Neighbour,
        work: &mut Work<D>,
    ) -> Option<Share<D>> {
        pairs.evaluate(self, at, neighbour, work)
    }

    fn block(&self, pairs: &Pairs<'_, D>, out: &mut BlockPairs<D>) {
        let block: &Block = &pairs.neighbours.blocks[out.block];
        out.clear();
        for k in 0..block.len {
            let at = pairs.neighbours.active[block.start + k] as usize;
            let mut sum = Share::NONE;
            for &neighbour in block.after(k) {
                let share = pairs.evaluate(self, at, neighbour, &mut out.work);
                let share = share.unwrap_or(Share::NONE);
                sum.add(1.0, &share);
                out.pairs.push(share);
            }
            out.sums.push(sum);
        }
    }
}

impl<const D: usize> Pairs<'_, D> {
    /// Displacement and distance of two ends that can interact, and the second's velocity as seen.
    #[inline]
    pub(super) fn meet(&self, pair: Ends<'_, D>) -> Option<(Vector<D>, f64, Vector<D>)> {
        let (a, b) = (&self.ends[pair.at], &self.ends[pair.other]);
        let displacement = pair.image.displacement(&a.position, &b.position);
        let square = dot(&displacement, &displacement);
        // The kernel decides; this only spares what is certainly beyond it.
        let range = self.kernel.support() * self.reach * (1.0 + 1e-9);
        let edge = range * a.smoothing.max(b.smoothing);
        (square <= edge * edge)
            .then(|| (displacement, square.sqrt(), pair.image.reflect(&b.velocity)))
    }

    #[inline]
    fn number(&self, place: usize) -> usize {
        self.neighbours.cells.order[place] as usize
    }

    /// One end of a pair along its line of centres. By itself it would be called, and copied, twice for each pair.
    #[inline(always)]
    fn seen(
        &self,
        place: usize,
        velocity: &Vector<D>,
        direction: &Vector<D>,
        image: &Image<D>,
    ) -> PairEnd {
        let end = &self.ends[place];
        let volume_slope = match self.volume_gradient {
            [] => 0.0,
            gradients => dot(&image.reflect(&gradients[self.number(place)]), direction),
        };
        let compression = match self.compression {
            [] => 1.0,
            factors => factors[self.number(place)],
        };
        PairEnd {
            density: end.density,
            pressure: end.pressure,
            sound_speed: end.sound_speed,
            velocity: dot(velocity, direction),
            smoothing: end.smoothing,
            volume_slope,
            compression,
        }
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
        let a_end = self.seen(pair.at, &a.velocity, &direction, &Image::IDENTITY);
        let b_end = self.seen(pair.other, &velocity, &direction, pair.image);
        let (left, right) = if is_left { (a_end, b_end) } else { (b_end, a_end) };
        let exchange = force.exchange(&left, &right, distance, self.kernel)?;
        work.interactions += 1;
        work.iterations += u64::from(exchange.iterations);
        // Inside the gas the sum of what the medium takes away vanishes; at an edge what is missing of it presses inward.
        let pressed = match self.outside {
            None => exchange.force,
            Some(pressure) => exchange.force - pressure * exchange.weight,
        };
        let factor = match &self.steps {
            None => 1.0,
            Some(steps) => steps.of(self.number(pair.at), self.number(pair.other)),
        };
        let along = sign * pressed * (a.mass * b.mass);
        Some(Share {
            force: direction.map(|component| factor * (along * component)),
            power: factor * (along * exchange.velocity),
            signal: signal(&left, &right),
        })
    }

    /// Evaluates a pair and books it: what walls and passive particles get of it, and that each pair counts once.
    #[inline]
    fn evaluate<F: PairForce>(
        &self,
        force: &F,
        at: usize,
        neighbour: Neighbour,
        work: &mut Work<D>,
    ) -> Option<Share<D>> {
        let image = self.neighbours.image(neighbour);
        let other = neighbour.other as usize;
        let share = self.share(force, Ends { at, other, image }, work)?;
        let reflects = image.reflects();
        if reflects {
            work.wall_force = plus_scaled(&work.wall_force, 1.0, &share.force);
        }
        if !self.neighbours.is_active(other) {
            let force = image.reflect(&share.force).map(|component| -component);
            if reflects {
                work.wall_force = plus_scaled(&work.wall_force, 1.0, &force);
            }
            work.owed.push(Owed { place: other as u32, force, power: -share.power });
        } else if *image != Image::IDENTITY && at > other {
            // The other end counts it.
            work.interactions -= 1;
        }
        Some(share)
    }
}

fn signal(left: &PairEnd, right: &PairEnd) -> f64 {
    left.sound_speed + right.sound_speed + (left.velocity - right.velocity).max(0.0)
}
