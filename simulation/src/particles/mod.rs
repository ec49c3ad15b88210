//! Particle hydrodynamics: SPH, and Godunov particle hydrodynamics after Cha & Whitworth 2003.
//!
//! A [`ParticleSystem`] holds particles of a [`Gas`] in a [`Domain`]; a [`PairForce`] says what two of them do to each
//! other along the line that joins them; an [`Integrator`] advances the system. The dimension is a
//! compile-time constant that the pair forces do not know.

mod block_steps;
mod body_force;
mod cells;
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
mod pair_loops;
mod pair_weight;
mod parallel;
mod rates;
mod ring;
mod run;
mod smoothing_kernel;
mod system;
mod thermal;
mod vector;
mod viscous;

pub use block_steps::BlockStepper;
pub use body_force::BodyForce;
pub use density::Smoothing;
pub(crate) use dispatch::{Task, dispatch};
pub use domain::{Domain, Image};
pub use evolution::{ParticleEvolution, Stepping};
pub use gas::{Gas, IsothermalGas};
pub use godunov::{Godunov, PairWork};
pub use integrator::{Integrator, NotExplicit, Nystrom, Stepper, Work, table};
pub use method::{KernelEstimation, MethodOptions, ParticleMethod, SolverChoice, StepSharing};
pub use neighbours::Neighbours;
pub use pair_force::{Exchange, PairEnd, PairForce};
pub use pair_loops::PairLoops;
pub use pair_weight::{Convolution, OwnKernels, PairWeight, Product, SumOfSquares};
pub use rates::Rates;
pub use ring::{Amplification, Ring};
pub(crate) use run::start;
pub use smoothing_kernel::{RadialKernel, SmoothingKernel};
pub(crate) use system::keep_only;
pub use system::{ParticleSystem, Particles};
pub use thermal::ThermalState;
pub use vector::Vector;
pub(crate) use vector::{dot, plus_scaled};
pub use viscous::{ActsOn, PressureForm, Smoothed, Viscosity};

#[cfg(test)]
mod tests;
