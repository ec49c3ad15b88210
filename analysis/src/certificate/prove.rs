//! Certificates written down from the limits that were found.

mod limit_ends;
mod monotonicity;
mod stability;
mod statement;
mod witness;

pub use monotonicity::certify_monotonicity;
pub use stability::certify_stability;

use thiserror::Error;

/// Boxes a cover may have.
const MAX_BOXES: usize = 20_000;

/// Why no certificate can be written.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum CertificationError {
    /// The limit itself is not decided.
    #[error("the limit is not decided near C = {0}: there is nothing to certify")]
    Undecided(String),
    /// The claim holds, but the permitted number of boxes does not show it.
    #[error("the certificate would need more than {MAX_BOXES} boxes")]
    TooLarge,
    /// No growing wave was found just above the limit.
    #[error("no growing wave was found just above the limit")]
    NoWitness,
}
