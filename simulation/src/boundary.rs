//! What lies beyond the ends of an axis.

/// What lies beyond an end of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Boundary {
    /// The other end.
    Periodic,
    /// A rigid, frictionless wall: the world in a mirror.
    Mirror,
    /// The state at the end continues: waves leave.
    Transmissive,
    /// Nothing: particles may leave.
    Open,
}
