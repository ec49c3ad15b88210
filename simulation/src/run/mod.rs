//! What a run leaves behind, whatever the method.

mod conservation;
mod failure;
mod options;
mod profile;

pub use conservation::Conservation;
pub(crate) use conservation::Totals;
pub use failure::{Failure, Reason};
pub use options::InvalidOptions;
pub(crate) use options::{not_negative, positive};
pub use profile::Profile;

/// The result of a run. A run that broke down is a result too: see [`failure`](Self::failure).
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The state at [`time`](Self::time).
    pub profile: Profile,
    /// How many steps were taken.
    pub steps: usize,
    /// How many broke and were repeated with half their length.
    pub rejected: usize,
    /// The time reached.
    pub time: f64,
    /// Why, when and where the run broke down; `None` if it reached the end.
    pub failure: Option<Failure>,
    /// What was lost or gained beyond the flow through the ends.
    pub conservation: Conservation,
    /// The number of pair evaluations: fluxes of particle pairs or cell faces, or
    /// forces of one particle on another.
    pub pairs: u64,
    /// How many of the particles stood beyond the left and the right end of the domain at the
    /// start, to flow in. They are the first and the last of the profile.
    pub waiting: [usize; 2],
    /// The mass of each particle; `None` for cells.
    pub particle_mass: Option<f64>,
}

impl Run {
    /// Whether the run reached its end time.
    pub fn completed(&self) -> bool {
        self.failure.is_none()
    }
}
