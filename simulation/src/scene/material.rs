//! The gas of a scene: what its pressure depends on.

use crate::particles::IsothermalGas;
use crate::riemann::{IdealGas, State};

/// The gas of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Material {
    /// No energy equation.
    Isothermal(IsothermalGas),
    /// An ideal gas.
    Ideal(IdealGas),
}

impl Material {
    /// The speed of sound in a state.
    pub fn sound_speed(self, state: &State) -> f64 {
        match self {
            Self::Isothermal(gas) => gas.sound_speed,
            Self::Ideal(gas) => gas.sound_speed(state.density(), state.pressure()),
        }
    }

    /// The ideal gas, if it is one.
    pub fn ideal(self) -> Option<IdealGas> {
        match self {
            Self::Isothermal(_) => None,
            Self::Ideal(gas) => Some(gas),
        }
    }

    /// The specific internal energy of a state; `None` for an isothermal gas and in a vacuum.
    pub fn internal_energy(self, state: &State) -> Option<f64> {
        let gas = self.ideal().filter(|_| !state.is_vacuum())?;
        Some(gas.internal_energy(state.density(), state.pressure()))
    }
}
