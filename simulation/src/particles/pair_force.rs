//! What two particles do to each other, along the line that joins them.

use super::smoothing_kernel::RadialKernel;

/// One end of a pair. Vectors enter by their component along the line of centres, positive from
/// left to right, so nothing here knows the dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairEnd {
    /// `ρ`.
    pub density: f64,
    /// `P`.
    pub pressure: f64,
    /// `c`.
    pub sound_speed: f64,
    /// `v` along the line.
    pub velocity: f64,
    /// `h`.
    pub smoothing: f64,
    /// `d(1/ρ)/ds` along the line; zero unless the force asks for it.
    pub volume_slope: f64,
    /// `|∇·v|/(|∇·v| + |∇×v| + 10⁻⁴ c/h)`; one unless the force asks for it.
    pub compression: f64,
}

impl PairEnd {
    /// The end as seen in a mirror.
    pub fn mirrored(&self) -> Self {
        Self { velocity: -self.velocity, volume_slope: -self.volume_slope, ..*self }
    }
}

/// Momentum and energy that pass from one particle to the other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Exchange {
    /// Force on the **left** particle along the line, divided by both masses; the right one feels the
    /// opposite. Negative for a repulsion.
    pub force: f64,
    /// The force that a pressure of one in both particles would exert.
    pub weight: f64,
    /// Velocity along the line at which that force works: the left particle gains the total
    /// energy `force × velocity` in unit time (per product of masses), the right one loses it.
    /// A particle of velocity `w` therefore heats by `± force × (velocity − w)`.
    pub velocity: f64,
    /// Iterations of a Riemann solver.
    pub iterations: u32,
}

/// A pair force. Exactly antisymmetric by construction: a pair is evaluated once.
pub trait PairForce: std::fmt::Debug + Send + Sync + 'static {
    /// Where the force ends, in units of the kernel's support times the larger smoothing length.
    fn reach(&self) -> f64 {
        1.0
    }

    /// Whether [`PairEnd::volume_slope`] is needed.
    fn needs_volume_slope(&self) -> bool {
        false
    }

    /// Whether [`PairEnd::compression`] is needed.
    fn needs_compression(&self) -> bool {
        false
    }

    /// The exchange between two particles, left and right by position, at a distance; `None`
    /// if they are too far apart to interact.
    fn exchange<K: RadialKernel>(
        &self,
        left: &PairEnd,
        right: &PairEnd,
        distance: f64,
        kernel: &K,
    ) -> Option<Exchange>
    where
        Self: Sized;
}
