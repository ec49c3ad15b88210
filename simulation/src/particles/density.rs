//! Density by summation, and the smoothing length that belongs to it.

use super::neighbours::{Block, Neighbour, Neighbours, for_each_block};
use super::smoothing_kernel::{RadialKernel, SmoothingKernel};
use super::vector::Vector;
use crate::run::Reason;

/// How smoothing lengths are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Smoothing {
    /// They stay as they were given.
    Constant,
    /// `h_i = η (m_i/ρ_i)^(1/D)` with the density summed with that very `h_i`.
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

    /// Pairs are searched in a range this much larger than the present smoothing lengths need, so
    /// that these may grow without a new search.
    fn margin(self) -> f64 {
        match self {
            // A unit in the last place, for pairs exactly at the edge of the support.
            Self::Constant | Self::Estimated { .. } => 1.0 + 1e-12,
            Self::Adaptive { .. } => 1.1,
        }
    }
}

/// Newton's iteration for one `h` takes three or four steps from the last one's.
const NEWTON_STEPS: usize = 8;
/// Bisection of a bracket as wide as the ones Newton leaves takes thirty.
const MOST_ITERATIONS: usize = 100;
/// Searches in ranges growing by half each: enough for any gap a few thousand spacings wide.
const MOST_SEARCHES: usize = 40;

/// `ρ = Σ m_j W(r_j, h)` and `dρ/dh` of particle `i`, itself included.
#[inline]
fn sums<const D: usize>(
    kernel: &SmoothingKernel<D>,
    masses: &[f64],
    particle: usize,
    neighbours: &[Neighbour],
    h: f64,
) -> (f64, f64) {
    let mut density = masses[particle] * kernel.value(0.0, h);
    let mut tilt = 0.0; // Σ m r ∂W/∂r
    for neighbour in neighbours {
        let mass = masses[neighbour.other as usize];
        density += mass * kernel.value(neighbour.distance, h);
        tilt += mass * neighbour.distance * kernel.slope(neighbour.distance, h);
    }
    (density, -(D as f64 * density + tilt) / h)
}

/// The result for one particle.
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
    density: Vec<f64>,
    smoothing: Vec<f64>,
    widened: bool,
    failed: Option<usize>,
}

/// Searches pairs, solves for smoothing lengths and sums densities.
#[derive(Debug, Clone)]
pub(super) struct DensitySum<const D: usize> {
    pub kernel: SmoothingKernel<D>,
    pub rule: Smoothing,
    /// Range of the pair force in units of the kernel's support.
    pub reach: f64,
    radii: Vec<f64>,
    scratch: Vec<Scratch>,
}

impl<const D: usize> DensitySum<D> {
    pub fn new(kernel: SmoothingKernel<D>, rule: Smoothing, reach: f64) -> Self {
        Self { kernel, rule, reach, radii: Vec::new(), scratch: Vec::new() }
    }

    /// Afterwards `neighbours` holds every pair within the new smoothing lengths.
    pub fn solve(
        &mut self,
        domain: &super::domain::Domain<D>,
        positions: &[Vector<D>],
        masses: &[f64],
        smoothing: &mut [f64],
        density: &mut [f64],
        neighbours: &mut Neighbours<D>,
    ) -> Result<(), Reason> {
        if let Smoothing::Estimated { pilot, scale, sensitivity, counted } = self.rule {
            smoothing.fill(pilot);
            self.search_within(domain, positions, smoothing, self.rule.margin(), neighbours);
            self.sum(masses, smoothing, density, 1.0, neighbours)?;
            let inside = &density[counted[0]..counted[1]];
            let mean = inside.iter().map(|rho| rho.ln()).sum::<f64>() / inside.len() as f64;
            for (h, rho) in smoothing.iter_mut().zip(&*density) {
                *h = scale * pilot * (sensitivity * (mean - rho.ln())).exp();
            }
            self.search_within(domain, positions, smoothing, self.rule.margin(), neighbours);
            self.sum(masses, smoothing, density, 1.0, neighbours)?;
            return Ok(());
        }
        let mut margin = self.rule.margin();
        for _ in 0..MOST_SEARCHES {
            self.search_within(domain, positions, smoothing, margin, neighbours);
            if !self.sum(masses, smoothing, density, margin, neighbours)? {
                return Ok(());
            }
            margin = 1.5;
        }
        Err(Reason::SmoothingLength { particle: 0 })
    }

    /// Finds the pairs within a margin of the smoothing lengths.
    fn search_within(
        &mut self,
        domain: &super::domain::Domain<D>,
        positions: &[Vector<D>],
        smoothing: &[f64],
        margin: f64,
        neighbours: &mut Neighbours<D>,
    ) {
        let range = self.kernel.support() * self.reach * margin;
        self.radii.clear();
        self.radii.extend(smoothing.iter().map(|h| h * range));
        neighbours.search(domain, positions, &self.radii);
    }

    /// One pass over all particles; whether some need pairs from further away.
    fn sum(
        &mut self,
        masses: &[f64],
        smoothing: &mut [f64],
        density: &mut [f64],
        margin: f64,
        neighbours: &Neighbours<D>,
    ) -> Result<bool, Reason> {
        self.scratch.resize_with(neighbours.blocks.len(), Scratch::default);
        let (kernel, rule) = (&self.kernel, self.rule);
        let lengths = &*smoothing;
        for (block, scratch) in self.scratch.iter_mut().enumerate() {
            scratch.block = block;
            scratch.widened = false;
            scratch.failed = None;
            scratch.density.clear();
            scratch.smoothing.clear();
        }
        for_each_block(&mut self.scratch, |scratch| {
            let block: &Block<D> = &neighbours.blocks[scratch.block];
            for k in 0..block.len {
                let particle = block.start + k;
                let h = lengths[particle];
                let near = block.neighbours(k);
                let outcome = match rule {
                    Smoothing::Constant => {
                        Outcome::Done { density: sums(kernel, masses, particle, near, h).0, h }
                    }
                    Smoothing::Estimated { .. } => {
                        let term = |neighbour: &Neighbour| {
                            let other = neighbour.other as usize;
                            masses[other]
                                * kernel.value(neighbour.distance, 0.5 * (h + lengths[other]))
                        };
                        let own = masses[particle] * kernel.value(0.0, h);
                        Outcome::Done { density: near.iter().map(term).fold(own, |a, b| a + b), h }
                    }
                    Smoothing::Adaptive { eta, tolerance } => {
                        let sums = |h: f64| sums(kernel, masses, particle, near, h);
                        newton::<D>(sums, eta, masses[particle], h, tolerance, h * margin)
                    }
                };
                let (density, h) = match outcome {
                    Outcome::Done { density, h } => (density, h),
                    Outcome::Wider { h } => {
                        scratch.widened = true;
                        (0.0, h)
                    }
                    Outcome::Failed => {
                        scratch.failed = scratch.failed.or(Some(particle));
                        (0.0, h)
                    }
                };
                scratch.density.push(density);
                scratch.smoothing.push(h);
            }
        });
        let mut widened = false;
        for (block, scratch) in neighbours.blocks.iter().zip(&self.scratch) {
            if let Some(particle) = scratch.failed {
                return Err(Reason::SmoothingLength { particle });
            }
            widened |= scratch.widened;
            let range = block.start..block.start + block.len;
            density[range.clone()].copy_from_slice(&scratch.density);
            smoothing[range].copy_from_slice(&scratch.smoothing);
        }
        Ok(widened)
    }
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
