//! Why a run broke down.

use std::fmt::{Display, Formatter};

/// The breakdown of a run: a result, not a panic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Failure {
    /// What happened.
    pub reason: Reason,
    /// The time at which that step began.
    pub time: f64,
    /// The number of the step in which it happened, counted from 1.
    pub step: usize,
}

/// What broke. Particles (or cells) are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reason {
    /// A density or specific volume is not positive.
    Density {
        /// The first particle with it.
        particle: usize,
        /// The density.
        value: f64,
    },
    /// An internal energy is not positive.
    InternalEnergy {
        /// The first particle with it.
        particle: usize,
        /// The specific internal energy.
        value: f64,
    },
    /// A number is NaN or infinite.
    NotFinite {
        /// The first particle with it.
        particle: usize,
    },
    /// No smoothing length agrees with the density of a particle.
    SmoothingLength {
        /// That particle.
        particle: usize,
    },
    /// The time step fell below the resolution of the time, or is not a number.
    TimeStep {
        /// The step asked for.
        value: f64,
    },
    /// The run was not at its end after the largest number of steps allowed.
    StepLimit {
        /// That number.
        limit: usize,
    },
}

impl Display for Reason {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Density { particle, value } => {
                write!(formatter, "density {value:.3e} at particle {particle}")
            }
            Self::InternalEnergy { particle, value } => {
                write!(formatter, "internal energy {value:.3e} at particle {particle}")
            }
            Self::NotFinite { particle } => {
                write!(formatter, "not a number at particle {particle}")
            }
            Self::SmoothingLength { particle } => {
                write!(formatter, "no smoothing length fits particle {particle}")
            }
            Self::TimeStep { value } => write!(formatter, "time step {value:.3e}"),
            Self::StepLimit { limit } => write!(formatter, "not finished after {limit} steps"),
        }
    }
}

impl Display for Failure {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{} in step {} at time ", self.reason, self.step)?;
        // Early failures need their digits too.
        if self.time < 1e-3 {
            write!(formatter, "{:.3e}", self.time)
        } else {
            write!(formatter, "{:.6}", self.time)
        }
    }
}

impl Reason {
    /// The particle that broke, if it was one.
    pub fn particle(&self) -> Option<usize> {
        match self {
            Self::Density { particle, .. }
            | Self::InternalEnergy { particle, .. }
            | Self::NotFinite { particle }
            | Self::SmoothingLength { particle } => Some(*particle),
            Self::TimeStep { .. } | Self::StepLimit { .. } => None,
        }
    }

    /// Whether a particle is one of a gas.
    #[inline]
    pub(crate) fn of_particle(
        particle: usize,
        density: f64,
        internal_energy: f64,
        velocity: f64,
    ) -> Result<(), Self> {
        if !(density.is_finite() && internal_energy.is_finite() && velocity.is_finite()) {
            Err(Self::NotFinite { particle })
        } else if density <= 0.0 {
            Err(Self::Density { particle, value: density })
        } else if internal_energy <= 0.0 {
            Err(Self::InternalEnergy { particle, value: internal_energy })
        } else {
            Ok(())
        }
    }
}
