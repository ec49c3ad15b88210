//! Particle hydrodynamics: SPH, and Godunov particle hydrodynamics after Cha & Whitworth 2003.
//!
//! A [`ParticleSystem`] holds particles of a [`Gas`] in a [`Domain`]; a [`PairForce`] says what two of them do to each
//! other along the line that joins them; an [`Integrator`] advances the system. The dimension is a
//! compile-time constant that the pair forces do not know.

mod block_steps;
mod body_force;
mod cells;
mod confined;
mod density;
mod dispatch;
mod domain;
mod evolution;
mod gas;
mod godunov;
mod integrator;
mod method;
mod neighbours;
mod pair_force;
mod pair_weight;
mod parallel;
mod rates;
mod result;
mod ring;
mod run;
mod scene;
mod smoothing_kernel;
mod system;
mod thermal;
mod vector;
mod viscous;

pub use block_steps::BlockStepper;
pub use body_force::BodyForce;
pub use confined::Confined;
pub use density::Smoothing;
pub(crate) use dispatch::{Task, dispatch};
pub use domain::{Domain, Image};
pub use evolution::{ParticleEvolution, Stepping};
pub use gas::{Gas, IsothermalGas};
pub use godunov::Godunov;
pub use integrator::{Integrator, NotExplicit, Nystrom, Stepper, table};
pub use method::{InvalidMethodOptions, MethodOptions, ParticleMethod, SolverChoice, StepSharing};
pub use neighbours::{Neighbours, Pair};
pub use pair_force::{Exchange, PairEnd, PairForce, Work};
pub use pair_weight::{
    Convolution, OwnKernels, PairWeight, Product, SumOfSquares, VolumeInterpolation,
};
pub use rates::Rates;
pub use result::{Drift, Errors, ParticleRun, Penetration};
pub use ring::{Amplification, Ring};
pub use run::run_particles;
pub use scene::{Flow, Material, ParticleScene};
pub use smoothing_kernel::{RadialKernel, SmoothingKernel};
pub(crate) use system::keep_only;
pub use system::{Counters, ParticleSystem, Particles};
pub use thermal::ThermalState;
pub use vector::Vector;
pub(crate) use vector::{dot, plus_scaled};
pub use viscous::{ActsOn, PressureForm, Smoothed, Viscosity};

#[cfg(test)]
mod tests;
