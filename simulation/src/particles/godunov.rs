//! Godunov particle hydrodynamics: the star state of a Riemann problem in place of pressures and
//! artificial viscosity. Cha & Whitworth 2003, section 3.

use super::pair_force::{Exchange, PairEnd, PairForce};
use super::pair_weight::PairWeight;
use super::smoothing_kernel::RadialKernel;
use crate::riemann::{StarSolver, State};

/// Case 1–4 of the paper, by the weight: [`SumOfSquares`](super::SumOfSquares),
/// [`Product`](super::Product), [`OwnKernels`](super::OwnKernels), [`Convolution`](super::Convolution).
///
/// `m_i dv_i/dt = ± m_i m_j P* A`, and the particle heats by the force times the velocity of [`PairWork`] less `ṙ*_i`
/// ((14) and (16) need a leading minus for an approaching pair to heat).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Godunov<W, S> {
    /// The geometrical factor.
    pub weight: W,
    /// The Riemann solver.
    pub solver: S,
    /// Where the force works.
    pub work: PairWork,
}

/// The velocity at which the force of a pair works, and so how its two ends share the heat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PairWork {
    /// The mean of the two: both heat alike. Cases 1 and 2 as printed.
    Mean,
    /// `v*`. Cases 3 and 4 as printed. Of a pair at rest the end of the higher pressure heats the other, by `P* v*` with
    /// `v* ≈ (P_L − P_R)/(Z_L + Z_R)`, `Z = ρc`: heat flows down the slope of the pressure, also where gravity holds that slope.
    Star,
    /// The mean for a pair that approaches; of a pair that parts each end cools in proportion to its pressure, as by its own
    /// expansion: the colder one never gives what it does not have.
    Shared,
}

impl PairWork {
    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Star => "star",
            Self::Shared => "shared",
        }
    }

    #[inline]
    fn velocity(self, left: &PairEnd, right: &PairEnd, star: f64) -> f64 {
        match self {
            Self::Star => star,
            Self::Shared if right.velocity > left.velocity => {
                (left.pressure * right.velocity + right.pressure * left.velocity)
                    / (left.pressure + right.pressure)
            }
            Self::Mean | Self::Shared => 0.5 * (left.velocity + right.velocity),
        }
    }
}

impl<W: PairWeight, S: StarSolver> PairForce for Godunov<W, S> {
    fn reach(&self) -> f64 {
        self.weight.reach()
    }

    fn needs_volume_slope(&self) -> bool {
        self.weight.needs_volume_slope()
    }

    #[inline]
    fn exchange<K: RadialKernel>(
        &self,
        left: &PairEnd,
        right: &PairEnd,
        distance: f64,
        kernel: &K,
    ) -> Option<Exchange> {
        let weight = self.weight.weight(left, right, distance, kernel);
        if weight == 0.0 {
            return None;
        }
        let state = |end: &PairEnd| State::trusted(end.density, end.velocity, end.pressure);
        let star = self.solver.star(&state(left), &state(right));
        let velocity = self.work.velocity(left, right, star.velocity);
        let force = star.pressure * weight;
        Some(Exchange { force, weight, velocity, iterations: star.iterations })
    }
}
