//! One mode of positions and velocities.

use super::branches::Frequencies;

/// `Ẋ = V, V̇ = −ω0² X − b V`, in units of the spacing `Δ` and the sound speed `c`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// `φ = κΔ`, in radians.
    pub phase: f64,
    /// `ω0² Δ²/c²`; negative when the lattice itself is unstable.
    pub restoring: f64,
    /// The damping rate `b Δ/c`.
    pub damping: f64,
}

impl Mode {
    /// The two roots of `ω² + i b ω − ω0² = 0`, in units of `c/Δ`.
    pub fn frequencies(&self) -> Frequencies {
        Frequencies::of(self.restoring, self.damping)
    }
}
