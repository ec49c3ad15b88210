//! Gas in a medium that presses on it.

use super::pair_force::{Exchange, PairEnd, PairForce, Work};
use super::smoothing_kernel::RadialKernel;

/// A pair force with a constant pressure taken from the pressures of every pair: inside the gas its sum over the neighbours vanishes, at
/// an edge what is missing of it presses inward like a medium outside of that pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Confined<F> {
    /// The force in a vacuum.
    pub force: F,
    /// The pressure of the medium.
    pub pressure: f64,
}

impl<F: PairForce> PairForce for Confined<F> {
    const WORK: Work = F::WORK;

    fn reach(&self) -> f64 {
        self.force.reach()
    }

    fn needs_volume_slope(&self) -> bool {
        self.force.needs_volume_slope()
    }

    #[inline]
    fn exchange<K: RadialKernel>(
        &self,
        left: &PairEnd,
        right: &PairEnd,
        distance: f64,
        kernel: &K,
    ) -> Option<Exchange> {
        let exchange = self.force.exchange(left, right, distance, kernel)?;
        Some(Exchange { force: exchange.force - self.pressure * exchange.weight, ..exchange })
    }
}
