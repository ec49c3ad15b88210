//! Why a run cannot start.

use crate::lagrangian::InvalidLattice;

/// An option that does not make sense.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum InvalidOptions {
    /// The lattice cannot be made.
    #[error(transparent)]
    Lattice(#[from] InvalidLattice),
    /// A number that must be positive is not, or is not finite.
    #[error("{name} = {value}: a finite number above 0 is needed")]
    NotPositive {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number that may be 0 is negative, or is not finite.
    #[error("{name} = {value}: a finite number, not negative, is needed")]
    Negative {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Fewer particles than the method needs.
    #[error("particles = {particles}: at least {least} are needed")]
    Particles {
        /// What was asked for.
        particles: usize,
        /// What is needed.
        least: usize,
    },
}

/// Accepts a positive finite number.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), InvalidOptions> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(InvalidOptions::NotPositive { name, value })
    }
}

/// Accepts a finite number that is not negative.
pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<(), InvalidOptions> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(InvalidOptions::Negative { name, value })
    }
}
