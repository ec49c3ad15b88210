//! What lies beyond the ends of an axis.

use serde::Deserialize;

/// What lies beyond an end of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    /// The other end.
    Periodic,
    /// A rigid, frictionless wall: the world in a mirror.
    #[serde(alias = "wall")]
    Mirror,
    /// The state at the end continues: waves leave.
    Transmissive,
    /// Nothing: particles may leave.
    Open,
}
