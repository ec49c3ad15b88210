//! The ideal gas of constant heat ratio.

use super::InvalidState;

/// An ideal gas: `p = (γ − 1) ρ e`, `c² = γ p/ρ`.
///
/// ```
/// use courant_simulation::riemann::IdealGas;
/// let air = IdealGas::new(1.4)?;
/// assert_eq!(air.sound_speed(1.4, 1.0), 1.0);
/// assert_eq!(air.internal_energy(1.0, 0.5), 0.5 / (air.gamma() - 1.0));
/// assert!(IdealGas::new(1.0).is_err());
/// # Ok::<(), courant_simulation::riemann::InvalidState>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IdealGas {
    gamma: f64,
}

impl IdealGas {
    /// A gas of heat ratio `gamma`.
    ///
    /// # Errors
    /// [`InvalidState::Gamma`] unless `gamma` is finite and above 1.
    pub fn new(gamma: f64) -> Result<Self, InvalidState> {
        if gamma.is_finite() && gamma > 1.0 {
            Ok(Self { gamma })
        } else {
            Err(InvalidState::Gamma(gamma))
        }
    }

    /// The ratio of specific heats γ.
    pub fn gamma(self) -> f64 {
        self.gamma
    }

    /// The speed of sound `c = √(γ p/ρ)`; 0 in a vacuum.
    #[inline]
    pub fn sound_speed(self, density: f64, pressure: f64) -> f64 {
        if density > 0.0 { (self.gamma * pressure / density).sqrt() } else { 0.0 }
    }

    /// The speed of sound as a mass flux, `C = ρc = √(γ ρ p)`: Ferrari et al. 2008 (3.11).
    #[inline]
    pub fn lagrangian_sound_speed(self, density: f64, pressure: f64) -> f64 {
        (self.gamma * density * pressure).sqrt()
    }

    /// The specific internal energy `e = p/((γ − 1)ρ)`; 0 in a vacuum.
    #[inline]
    pub fn internal_energy(self, density: f64, pressure: f64) -> f64 {
        if density > 0.0 { pressure / ((self.gamma - 1.0) * density) } else { 0.0 }
    }

    /// The pressure `p = (γ − 1) ρ e`.
    #[inline]
    pub fn pressure(self, density: f64, internal_energy: f64) -> f64 {
        (self.gamma - 1.0) * density * internal_energy
    }
}
