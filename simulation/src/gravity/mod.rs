//! Self-gravity of particles in three dimensions, and the flows it drives.

mod expansion_wave;
mod octree;
mod self_gravity;
mod sink;
mod softening;
mod walk;

pub use expansion_wave::{ExpansionWave, Similarity};
pub use octree::{Bodies, Octree};
pub use self_gravity::SelfGravity;
pub use sink::{MaybeSink, Sink, cross};
pub use softening::{attraction, potential};
pub use walk::{Attraction, Opening};

#[cfg(test)]
mod tests;
