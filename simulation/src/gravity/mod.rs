//! Self-gravity of particles in three dimensions, and the flows it drives.
//!
//! An [`Octree`] with quadrupoles gives the attraction; [`SelfGravity`] is it as a
//! [`BodyForce`](crate::particles::BodyForce), with a [`Sink`] or without. A [`Cloud`] is a scene: a sphere of gas at rest, as data
//! (`simulation/scenes/*.toml`); [`run_cloud`] runs it, [`CloudRun::measures`] judges it. [`ExpansionWave`] is Shu's exact collapse of the singular
//! isothermal sphere.
//!
//! Softening lengths vary in time, without the terms that this adds to the equations of motion (Price & Monaghan 2007): total
//! energy is conserved to the change of the softened energy, some per cent in a collapse of a thousand particles.

mod cloud;
mod expansion_wave;
mod measures;
mod octree;
mod run;
mod runge_kutta;
mod self_gravity;
mod sink;
mod softening;
mod sphere;
mod walk;

pub use cloud::{Cloud, Known};
pub use expansion_wave::{ExpansionWave, Similarity};
pub use measures::{HEAD_SPEED, RATE_WINDOW, WAVE, WaveMeasures};
pub use octree::{Bodies, Octree};
pub use run::{CloudRun, Energies, SAMPLES, Snapshot, cloud_options, run_cloud};
pub use self_gravity::SelfGravity;
pub use sink::{Sink, cross};
pub use softening::{attraction, potential};
pub use sphere::{Distribution, ball, relax};
pub use walk::{Attraction, Opening};

#[cfg(test)]
mod cloud_tests;
#[cfg(test)]
mod tests;
