//! What fills a scene at the start.

use super::Quantity;
use crate::riemann::State;

/// Gas up to an edge. Where the density is 0 there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// The right edge.
    pub to: f64,
    /// Density.
    pub density: Quantity,
    /// Velocity.
    pub velocity: Quantity,
    /// Pressure; of an isothermal gas it follows from the density and this is not looked at.
    pub pressure: Quantity,
}

impl Layer {
    /// One state.
    pub fn uniform(to: f64, state: &State) -> Self {
        let [density, velocity, pressure] =
            [state.density(), state.velocity(), state.pressure()].map(Quantity::Constant);
        Self { to, density, velocity, pressure }
    }

    /// The state, if it is one.
    pub fn state(&self) -> Option<State> {
        let (density, velocity) = (self.density.constant()?, self.velocity.constant()?);
        Some(State::trusted(density, velocity, self.pressure.constant()?))
    }

    pub(super) fn is_vacuum(&self) -> bool {
        self.density.constant() == Some(0.0)
    }
}

/// The gas at the start.
#[derive(Debug, Clone, PartialEq)]
pub enum Flow {
    /// Layers side by side, from left to right.
    Layers(Vec<Layer>),
    /// A sound wave that runs to the right: `ρ = 1 + A sin 2πx`, homentropic, with period 1.
    SimpleWave {
        /// `A`.
        amplitude: f64,
    },
}
