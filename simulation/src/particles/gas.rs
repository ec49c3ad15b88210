//! Equations of state, and what a particle carries because of them.

use super::thermal::ThermalState;
use crate::riemann::IdealGas;

/// An equation of state `P(ρ, u)`.
pub trait Gas: Copy + std::fmt::Debug + Send + Sync + 'static {
    /// What a particle carries besides mass, position and velocity: `()` or its specific internal energy.
    type Thermal: ThermalState;

    /// The pressure.
    fn pressure(&self, density: f64, thermal: Self::Thermal) -> f64;

    /// The speed of sound.
    fn sound_speed(&self, density: f64, thermal: Self::Thermal) -> f64;

    /// The thermal state at a density and pressure.
    fn thermal(&self, density: f64, pressure: f64) -> Self::Thermal;
}

/// `P = c²ρ`: no energy equation, and no energies in memory.
///
/// ```
/// use courant_simulation::particles::{Gas, IsothermalGas};
/// let gas = IsothermalGas { sound_speed: 2.0 };
/// assert_eq!(gas.pressure(0.5, ()), 2.0);
/// assert_eq!(std::mem::size_of_val(vec![gas.thermal(0.5, 2.0); 1000].as_slice()), 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsothermalGas {
    /// The isothermal sound speed `c`.
    pub sound_speed: f64,
}

impl Gas for IsothermalGas {
    type Thermal = ();

    #[inline]
    fn pressure(&self, density: f64, (): ()) -> f64 {
        self.sound_speed * self.sound_speed * density
    }

    #[inline]
    fn sound_speed(&self, _: f64, (): ()) -> f64 {
        self.sound_speed
    }

    fn thermal(&self, _: f64, _: f64) {}
}

impl Gas for IdealGas {
    type Thermal = f64;

    #[inline]
    fn pressure(&self, density: f64, energy: f64) -> f64 {
        IdealGas::pressure(*self, density, energy)
    }

    #[inline]
    fn sound_speed(&self, density: f64, energy: f64) -> f64 {
        IdealGas::sound_speed(*self, density, Gas::pressure(self, density, energy))
    }

    fn thermal(&self, density: f64, pressure: f64) -> f64 {
        self.internal_energy(density, pressure)
    }
}
