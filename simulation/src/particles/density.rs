//! Density by summation, and the smoothing length that belongs to it.

use super::domain::Domain;
use super::neighbours::Neighbours;
use super::parallel::{fill, for_each_block};
use super::smoothing_kernel::{RadialKernel, SmoothingKernel};
use super::vector::{Vector, dot};
use crate::boundary::Boundary;
use crate::run::Reason;

/// How smoothing lengths are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Smoothing {
    /// They stay as they were given.
    Constant,
    /// `h_i = η (m_i/ρ_i)^(1/D)` with the density summed with that very `h_i`; where all gas together is too little for any, as given.
    Adaptive {
        /// `η`: the smoothing length in particle spacings.
        eta: f64,
        /// Newton's iteration ends when `h` changes by less than this part of itself.
        tolerance: f64,
    },
    /// Adaptive density kernel estimation (Sigalotti et al. 2006): `h_i = k (g/ρ̂_i)^ε h₀` from a pilot density `ρ̂` with one
    /// smoothing length `h₀`, `log g` the mean of `log ρ̂`; densities with the mean length of each pair.
    Estimated {
        /// `h₀`.
        pilot: f64,
        /// `k`.
        scale: f64,
        /// `ε`.
        sensitivity: f64,
        /// The particles of the mean, from the first to before the second.
        counted: [usize; 2],
    },
}

impl Smoothing {
    /// [`Smoothing::Adaptive`] to 1e-8: Newton squares the error, so one more step would be round-off.
    pub fn adaptive(eta: f64) -> Self {
        Self::Adaptive { eta, tolerance: 1e-8 }
    }
}

/// Neighbours are searched in a range this much larger than the present smoothing lengths need, so that these may
/// grow, and particles move, without a new search. A wider margin costs candidates as its power `D`.
fn margin(dimension: usize) -> f64 {
    [1.3, 1.15, 1.1][dimension - 1]
}

/// Where the particles are, and their smoothing lengths.
pub(super) struct Positions<'a, const D: usize> {
    pub position: &'a [Vector<D>],
    pub mass: &'a [f64],
    pub smoothing: &'a mut [f64],
}

/// Newton's iteration for one `h` takes three or four steps from the last one's.
const NEWTON_STEPS: usize = 8;
/// Bisection of a bracket as wide as the ones Newton leaves takes thirty.
const MOST_ITERATIONS: usize = 100;
/// Searches in ranges growing by half each: enough for any gap a few thousand spacings wide.
const MOST_SEARCHES: usize = 40;

/// The result for one particle.
#[derive(Debug, Clone, Copy)]
enum Outcome {
    Done {
        density: f64,
        h: f64,
    },
    /// The pairs found do not reach far enough.
    Wider {
        h: f64,
    },
    Failed,
}

#[derive(Debug, Clone, Default)]
struct Scratch {
    block: usize,
    outcomes: Vec<Outcome>,
    /// Distances and masses of one particle's neighbours.
    near: Vec<(f64, f64)>,
    /// Their smoothing lengths, where the rule asks for them.
    lengths: Vec<f64>,
}

/// Searches neighbours, solves for smoothing lengths and sums densities.
#[derive(Debug, Clone)]
pub(super) struct DensitySum<const D: usize> {
    pub kernel: SmoothingKernel<D>,
    pub rule: Smoothing,
    /// Range of the pair force in units of the kernel's support.
    pub reach: f64,
    /// The most particles that have kept their smoothing length at once, the gas being too little for any.
    pub kept: u64,
    mass: Vec<f64>,
    scratch: Vec<Scratch>,
}

impl<const D: usize> DensitySum<D> {
    pub fn new(kernel: SmoothingKernel<D>, rule: Smoothing, reach: f64) -> Self {
        Self { kernel, rule, reach, kept: 0, mass: Vec::new(), scratch: Vec::new() }
    }

    /// Density and smoothing length of the active particles (all, if there is no list of their numbers). Afterwards
    /// `neighbours` holds all of theirs within the new smoothing lengths.
    pub fn solve(
        &mut self,
        domain: &Domain<D>,
        state: Positions<'_, D>,
        active: Option<&[u32]>,
        density: &mut [f64],
        neighbours: &mut Neighbours<D>,
    ) -> Result<(), Reason> {
        let Positions { position, mass, smoothing } = state;
        let range = self.kernel.support() * self.reach;
        if let Smoothing::Estimated { pilot, scale, sensitivity, counted } = self.rule {
            smoothing.fill(pilot);
            neighbours.search_from(domain, position, None, |_| pilot * range);
            self.sum(mass, f64::INFINITY, smoothing, density, 0.0, neighbours)?;
            let inside = &density[counted[0]..counted[1]];
            let mean = inside.iter().map(|rho| rho.ln()).sum::<f64>() / inside.len() as f64;
            for (h, rho) in smoothing.iter_mut().zip(&*density) {
                *h = scale * pilot * (sensitivity * (mean - rho.ln())).exp();
            }
            let lengths = &*smoothing;
            neighbours.search_from(domain, position, None, |i| lengths[i] * range);
            return self.sum(mass, f64::INFINITY, smoothing, density, 0.0, neighbours).map(|_| ());
        }
        // Images are without end.
        let open = |end: &Boundary| matches!(end, Boundary::Open | Boundary::Transmissive);
        let too_heavy = match self.rule {
            // Whoever sees too little mass however far it looks asks for an h beyond every h: it keeps its own.
            Smoothing::Adaptive { eta, .. } if domain.boundary.as_flattened().iter().all(open) => {
                mass.iter().sum::<f64>() * self.kernel.value(0.0, 1.0) / eta.powi(D as i32)
            }
            _ => f64::INFINITY,
        };
        let kept = mass.iter().filter(|&&mass| mass >= too_heavy).count();
        self.kept = self.kept.max(kept as u64);
        let mut margin = margin(D);
        for _ in 0..MOST_SEARCHES {
            let lengths = &*smoothing;
            let reusable = active.is_none() && margin == self::margin(D);
            let slack = reusable.then(|| neighbours.reuse(position, |i| lengths[i] * range));
            let slack = slack.flatten().unwrap_or_else(|| {
                neighbours.search_from(domain, position, active, |i| lengths[i] * range * margin);
                0.0
            });
            if !self.sum(mass, too_heavy, smoothing, density, slack, neighbours)? {
                return Ok(());
            }
            margin = 1.5;
        }
        Err(Reason::SmoothingLength { particle: 0 })
    }

    /// One pass over the active particles; those of a mass of `too_heavy` keep their lengths. Whether some need pairs from further away.
    fn sum(
        &mut self,
        masses: &[f64],
        too_heavy: f64,
        smoothing: &mut [f64],
        density: &mut [f64],
        slack: f64,
        neighbours: &Neighbours<D>,
    ) -> Result<bool, Reason> {
        let cells = &neighbours.cells;
        fill(&mut self.mass, masses.len(), |at| masses[cells.order[at] as usize]);
        self.scratch.resize_with(neighbours.blocks.len(), Scratch::default);
        for (block, scratch) in self.scratch.iter_mut().enumerate() {
            scratch.block = block;
        }
        let range = self.kernel.support() * self.reach;
        let (kernel, rule, mass, lengths) = (&self.kernel, self.rule, &self.mass, &*smoothing);
        for_each_block(&mut self.scratch, &|scratch| {
            let block = &neighbours.blocks[scratch.block];
            scratch.outcomes.clear();
            for k in 0..block.len {
                let number = neighbours.number(block, k);
                let at = neighbours.active[block.start + k] as usize;
                let (h, own) = (lengths[number], mass[at]);
                let widest = (neighbours.radius(number) - slack) / range;
                let mixed = matches!(rule, Smoothing::Estimated { .. });
                // A longer length of the other end reaches farther than one's own.
                let edge =
                    if mixed { f64::INFINITY } else { kernel.support() * widest * (1.0 + 1e-9) };
                scratch.near.clear();
                scratch.lengths.clear();
                for &neighbour in block.all(k) {
                    let other = neighbour.other as usize;
                    let (here, there) = (&cells.position[at], &cells.position[other]);
                    let displacement = neighbours.image(neighbour).displacement(here, there);
                    let square = dot(&displacement, &displacement);
                    if square <= edge * edge {
                        scratch.near.push((square.sqrt(), mass[other]));
                        if mixed {
                            scratch.lengths.push(lengths[cells.order[other] as usize]);
                        }
                    }
                }
                let sums = |h: f64| sums(kernel, own, &scratch.near, h);
                scratch.outcomes.push(match rule {
                    Smoothing::Constant => Outcome::Done { density: sums(h).0, h },
                    Smoothing::Estimated { .. } => {
                        let others = scratch.near.iter().zip(&scratch.lengths);
                        let term = |(&(distance, mass), other): (&(f64, f64), &f64)| {
                            mass * kernel.value(distance, 0.5 * (h + other))
                        };
                        let own = own * kernel.value(0.0, h);
                        Outcome::Done { density: others.map(term).fold(own, |a, b| a + b), h }
                    }
                    Smoothing::Adaptive { .. } if own >= too_heavy => {
                        Outcome::Done { density: sums(h).0, h }
                    }
                    Smoothing::Adaptive { eta, tolerance } => {
                        newton::<D>(sums, eta, own, h, tolerance, widest)
                    }
                });
            }
        });
        let mut widened = false;
        for (block, scratch) in neighbours.blocks.iter().zip(&self.scratch) {
            for (k, &outcome) in scratch.outcomes.iter().enumerate() {
                let particle = neighbours.number(block, k);
                match outcome {
                    Outcome::Done { density: sum, h } => {
                        density[particle] = sum;
                        smoothing[particle] = h;
                    }
                    Outcome::Wider { h } => {
                        widened = true;
                        smoothing[particle] = h;
                    }
                    Outcome::Failed => return Err(Reason::SmoothingLength { particle }),
                }
            }
        }
        Ok(widened)
    }
}

/// `ρ = Σ m_j W(r_j, h)` and `dρ/dh` of a particle, itself included, from distances and masses of the others.
#[inline]
fn sums<const D: usize>(
    kernel: &SmoothingKernel<D>,
    own: f64,
    near: &[(f64, f64)],
    h: f64,
) -> (f64, f64) {
    let mut density = own * kernel.shape(0.0)[0];
    let mut tilt = 0.0; // Σ m q w'(q)
    for &(distance, mass) in near {
        let q = distance / h;
        let [value, slope] = kernel.shape(q);
        density += mass * value;
        tilt += mass * q * slope;
    }
    let norm = kernel.norm(h);
    (norm * density, -norm * (D as f64 * density + tilt) / h)
}

/// Newton for `F = h − η (m/ρ(h))^(1/D) = 0`, in steps of at most a third and inside the bracket
/// that its own signs have made.
///
/// The density jumps where a neighbour crosses the cut of a Gaussian, and there may be no root, only a
/// change of sign: the bracket then closes on the jump, and its lower side is the answer.
fn newton<const D: usize>(
    sums: impl Fn(f64) -> (f64, f64),
    eta: f64,
    mass: f64,
    start: f64,
    tolerance: f64,
    widest: f64,
) -> Outcome {
    let mut h = start;
    let (mut lower, mut upper) = (0.0_f64, f64::INFINITY);
    for iteration in 0..MOST_ITERATIONS {
        let (density, change) = sums(h);
        let target = eta * (mass / density).powf(1.0 / D as f64);
        if !target.is_finite() {
            return Outcome::Failed;
        }
        if h < target {
            lower = lower.max(h);
        } else {
            upper = upper.min(h);
        }
        // The slope is one minus the logarithmic response of the target; it is kept away from zero
        // where a kernel's edge makes it useless.
        let slope = (1.0 + target * change / (D as f64 * density)).max(0.3);
        let mut next = (h - (h - target) / slope).clamp(0.7 * h, 1.4 * h);
        if (next - h).abs() <= tolerance * h {
            return Outcome::Done { density, h };
        }
        if upper - lower <= tolerance * lower {
            return Outcome::Done { density: sums(lower).0, h: lower };
        }
        // Where the density responds to h about as strongly as h to it, Newton creeps: after a
        // few steps look for the change of sign alone.
        let creeping = iteration >= NEWTON_STEPS;
        if next <= lower || next >= upper || (creeping && lower > 0.0 && upper.is_finite()) {
            next = 0.5 * (lower + upper);
        } else if creeping {
            next = if h < target { 1.3 * h } else { 0.75 * h };
        }
        if next > widest {
            return Outcome::Wider { h: widest };
        }
        h = next;
    }
    Outcome::Failed
}
