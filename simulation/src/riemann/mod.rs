//! Riemann problems of an ideal gas: two uniform states that meet at a point.
//!
//! [`solve`] gives the exact solution: the star region between the two acoustic waves, vacuum
//! included, and its sampling along rays `x/t`. Everything that needs a reference (scenes,
//! figures) or a Godunov flux (finite volumes, particles) takes it from here.
//!
//! ```
//! use courant_simulation::riemann::{IdealGas, State, solve};
//! let gas = IdealGas::new(1.4)?;
//! let sod = solve(gas, &State::new(1.0, 0.0, 1.0)?, &State::new(0.125, 0.0, 0.1)?);
//! assert!((sod.pressure() - 0.30313).abs() < 5e-6); // Toro 1999, chapter 4
//! assert!((sod.velocity() - 0.92745).abs() < 5e-6);
//! assert!((sod.sample(1.0).density() - 0.26557).abs() < 5e-6);
//! # Ok::<(), courant_simulation::riemann::InvalidState>(())
//! ```

mod exact;
mod gas;
pub mod isothermal;
mod sample;
mod star;
mod state;
mod van_leer;
mod wave;

pub use exact::{Solution, Star, solve};
pub use gas::IdealGas;
pub use star::{ExactIdeal, StarSolver, StarState};
pub use state::{InvalidState, State};
pub use van_leer::{PRESSURE_FLOOR, Stopping, VanLeer};
pub use wave::Wave;

#[cfg(test)]
mod star_tests;
#[cfg(test)]
mod tests;
