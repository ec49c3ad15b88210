//! The state of a particle in mass coordinates.

use crate::riemann::{IdealGas, State};

/// The conserved quantities `U = (V, v, E)` of Ferrari et al. 2008 (3.7) and what follows from them.
///
/// The derived quantities are kept beside the conserved ones because every particle meets
/// several others in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LagrangianState {
    /// Specific volume `V = 1/ρ`.
    pub volume: f64,
    /// Velocity `v`.
    pub velocity: f64,
    /// Specific total energy `E = v²/2 + pV/(γ − 1)`.
    pub energy: f64,
    /// Density `ρ`.
    pub density: f64,
    /// Pressure `p`.
    pub pressure: f64,
    /// Lagrangian sound speed `C = √(γρp)`, a mass flux: (3.11).
    pub sound: f64,
}

impl LagrangianState {
    /// From the conserved quantities. The result is not physical where they are not:
    /// [`internal_energy`](Self::internal_energy) tells.
    #[inline]
    pub fn from_conserved(gas: IdealGas, [volume, velocity, energy]: [f64; 3]) -> Self {
        let density = volume.recip();
        let pressure = gas.pressure(density, energy - 0.5 * velocity * velocity);
        let sound = gas.lagrangian_sound_speed(density, pressure);
        Self { volume, velocity, energy, density, pressure, sound }
    }

    /// From density, velocity and pressure. The density must not be 0.
    pub fn from_state(gas: IdealGas, state: &State) -> Self {
        let (density, velocity, pressure) = (state.density(), state.velocity(), state.pressure());
        let energy = 0.5 * velocity * velocity + gas.internal_energy(density, pressure);
        let sound = gas.lagrangian_sound_speed(density, pressure);
        Self { volume: density.recip(), velocity, energy, density, pressure, sound }
    }

    /// The state as a mirror shows it.
    pub(super) fn mirrored(&self) -> Self {
        Self { velocity: -self.velocity, ..*self }
    }

    /// The conserved quantities `(V, v, E)`.
    #[inline]
    pub fn conserved(&self) -> [f64; 3] {
        [self.volume, self.velocity, self.energy]
    }

    /// The physical flux `F = (−v, p, pv)`: (3.7).
    #[inline]
    pub fn flux(&self) -> [f64; 3] {
        [-self.velocity, self.pressure, self.pressure * self.velocity]
    }

    /// The specific internal energy `e = E − v²/2`.
    #[inline]
    pub fn internal_energy(&self) -> f64 {
        self.energy - 0.5 * self.velocity * self.velocity
    }

    /// As density, velocity and pressure, for a state that is physical.
    #[inline]
    pub(crate) fn to_state(self) -> State {
        State::trusted(self.density, self.velocity, self.pressure)
    }
}
