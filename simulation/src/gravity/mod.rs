//! Self-gravity of particles in three dimensions, and the flows it drives.

mod cloud;
mod expansion_wave;
mod octree;
mod run;
mod self_gravity;
mod sink;
mod softening;
mod sphere;
mod walk;

pub use cloud::{Cloud, InvalidCloud, Known};
pub use expansion_wave::{ExpansionWave, Similarity};
pub use octree::{Bodies, Octree};
pub use run::{CloudRun, Energies, RELAXATION_STEPS, SAMPLES, Snapshot, cloud_options, run_cloud};
pub use self_gravity::SelfGravity;
pub use sink::{MaybeSink, Sink, cross};
pub use softening::{attraction, potential};
pub use sphere::{Distribution, ball, relax};
pub use walk::{Attraction, Opening};

#[cfg(test)]
mod tests;
