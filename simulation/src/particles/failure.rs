//! Why a run of particles stopped before its end.

/// A run that cannot go on.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Failure {
    /// A position, velocity or density is infinite or not a number.
    #[error("particle {particle} is no longer finite")]
    NotFinite {
        /// Its index.
        particle: usize,
    },
    /// The energy equation has taken more than there was.
    #[error("internal energy of particle {particle} is {energy}")]
    NegativeEnergy {
        /// Its index.
        particle: usize,
        /// The value, negative or not a number.
        energy: f64,
    },
    /// The smoothing length and the density of a particle do not come to agree.
    #[error("no smoothing length fits the density of particle {particle}")]
    SmoothingLength {
        /// Its index.
        particle: usize,
    },
    /// The time step has become too small to reach the end.
    #[error("the step {step} is too small to go on")]
    StepTooSmall {
        /// The step.
        step: f64,
    },
    /// The number of steps allowed is used up.
    #[error("{steps} steps did not reach the end")]
    TooManySteps {
        /// How many were taken.
        steps: u64,
    },
}
