//! The advection schemes of Ferrari et al. 2008, section 2, run on particles for `u_t + a u_x = 0` with
//! `a = 1` on a periodic line.
//!
//! Two paths step the same schemes. The [particle path](ParticlePath) finds neighbours among positions,
//! uniform or disordered, and evaluates the kernel between them. The [lattice path](LatticePath) applies
//! the stencil that the kernel has on a uniform lattice. Neither knows the amplification factor: they
//! share the kernel with `courant_analysis` and nothing else, of a [`Discretisation`] they read its names and its ratio, so that what they
//! [measure](validate) confirms what is predicted.

mod amplification;
mod faulty;
mod lattice_path;
mod modes;
mod particle_path;
mod profile;
mod random;
mod ring;
mod run;
mod scene;
mod scheme;
mod stepper;

pub use amplification::{ModeRow, Validation, ValidationPlan, validate};
pub use faulty::Fault;
pub use lattice_path::{LatticeCoefficients, LatticePath};
pub use modes::RingModes;
pub use particle_path::ParticlePath;
pub use profile::{Comparison, Extrema, total_variation};
pub use random::SplitMix64;
pub use ring::Ring;
pub use run::{AdvectionRun, Layout, RunPlan, run, run_with};
pub use scene::{AdvectionScene, Piece};
pub use scheme::{AdvectionScheme, Discretisation, UnknownScheme};
pub use stepper::Stepper;

#[cfg(test)]
mod tests;
