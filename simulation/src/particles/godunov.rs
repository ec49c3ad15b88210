//! Godunov particle hydrodynamics: the star state of a Riemann problem in place of pressures and
//! artificial viscosity. Cha & Whitworth 2003, section 3.

use super::pair_force::{Exchange, PairEnd, PairForce, Work};
use super::pair_weight::PairWeight;
use super::smoothing_kernel::RadialKernel;
use crate::riemann::{StarSolver, State};

/// Case 1–4 of the paper, by the weight: [`SumOfSquares`](super::SumOfSquares),
/// [`Product`](super::Product), [`OwnKernels`](super::OwnKernels), [`Convolution`](super::Convolution).
///
/// `m_i dv_i/dt = ± m_i m_j P* A`, and the particle heats by the force times `v* − ṙ*_i` (cases 3
/// and 4; (14) and (16) need a leading minus for an approaching pair to heat) or by half the
/// relative velocity (cases 1 and 2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Godunov<W, S> {
    /// The geometrical factor.
    pub weight: W,
    /// The Riemann solver.
    pub solver: S,
}

impl<W: PairWeight, S: StarSolver> PairForce for Godunov<W, S> {
    const WORK: Work = W::WORK;

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
        let velocity =
            if W::STAR_WORK { star.velocity } else { 0.5 * (left.velocity + right.velocity) };
        let force = star.pressure * weight;
        Some(Exchange { force, weight, velocity, iterations: star.iterations })
    }
}
