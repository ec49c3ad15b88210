//! The state of a gas at a point.

/// Why numbers are not a state of a gas.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum InvalidState {
    /// The heat ratio is not a finite number above 1.
    #[error("gamma = {0}: a finite number above 1 is needed")]
    Gamma(f64),
    /// The density is negative or not finite.
    #[error("density = {0}: a finite number, not negative, is needed")]
    Density(f64),
    /// The velocity is not finite.
    #[error("velocity = {0}: a finite number is needed")]
    Velocity(f64),
    /// The pressure is negative or not finite.
    #[error("pressure = {0}: a finite number, not negative, is needed")]
    Pressure(f64),
    /// There is no gas, yet it presses.
    #[error("pressure = {0} where the density is 0: a vacuum has no pressure")]
    PressureOfVacuum(f64),
}

/// Density, velocity and pressure of a gas at a point.
///
/// Density and pressure are never negative and nothing is NaN or infinite. Density 0 is a vacuum;
/// pressure 0 with a positive density is a cold gas.
///
/// ```
/// use courant_simulation::riemann::{InvalidState, State};
/// assert_eq!(State::new(1.0, -2.0, 0.4)?.velocity(), -2.0);
/// assert_eq!(State::new(-1.0, 0.0, 1.0), Err(InvalidState::Density(-1.0)));
/// # Ok::<(), InvalidState>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    density: f64,
    velocity: f64,
    pressure: f64,
}

impl State {
    /// A state from its three numbers.
    ///
    /// # Errors
    /// [`InvalidState`] names the first number that is not physical.
    pub fn new(density: f64, velocity: f64, pressure: f64) -> Result<Self, InvalidState> {
        let amount = |value: f64| value.is_finite() && value >= 0.0;
        if !amount(density) {
            Err(InvalidState::Density(density))
        } else if !velocity.is_finite() {
            Err(InvalidState::Velocity(velocity))
        } else if !amount(pressure) {
            Err(InvalidState::Pressure(pressure))
        } else if density == 0.0 && pressure > 0.0 {
            Err(InvalidState::PressureOfVacuum(pressure))
        } else {
            Ok(Self { density, velocity, pressure })
        }
    }

    /// No gas. The velocity only says how an observer in it would move.
    pub(crate) fn vacuum(velocity: f64) -> Self {
        Self { density: 0.0, velocity, pressure: 0.0 }
    }

    /// A state whose numbers are physical because they come from a solution between valid states.
    #[inline]
    pub(crate) fn trusted(density: f64, velocity: f64, pressure: f64) -> Self {
        Self { density, velocity, pressure }
    }

    /// Mass per length ρ.
    #[inline]
    pub fn density(&self) -> f64 {
        self.density
    }

    /// Velocity v.
    #[inline]
    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Pressure p.
    #[inline]
    pub fn pressure(&self) -> f64 {
        self.pressure
    }

    /// Whether there is no gas.
    #[inline]
    pub fn is_vacuum(&self) -> bool {
        self.density == 0.0
    }

    /// The same state seen in a mirror: the velocity changes sign.
    #[inline]
    pub(crate) fn mirrored(&self) -> Self {
        Self { velocity: -self.velocity, ..*self }
    }
}
