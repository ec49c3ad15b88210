//! The advection schemes of Ferrari et al. 2008, section 2, run on particles for `u_t + a u_x = 0` with
//! `a = 1` on a periodic line.
//!
//! Two paths step the same schemes. The [particle path](ParticlePath) finds neighbours among positions,
//! uniform or disordered, and evaluates the kernel between them. The [lattice path](LatticePath) applies
//! the stencil that the kernel has on a uniform lattice. Neither knows the amplification factor: they
//! share the kernel with `courant_analysis` and nothing else, so that what they
//! [measure](validate) confirms what is predicted.

mod amplification;
mod cost;
mod disorder;
mod faulty;
mod growth;
mod lattice_path;
mod limit;
mod method;
mod modes;
mod neighbours;
mod particle_path;
mod profile;
mod published;
mod random;
mod ring;
mod run;
mod scene;
mod scheme;
mod stepper;

pub use amplification::{ModeRow, Validation, ValidationError, ValidationPlan, validate};
pub use cost::{Recommendation, pareto_front, recommend};
pub use disorder::{DisorderGrowth, DisorderRow, DisorderStudy, gain_against_disorder};
pub use faulty::Fault;
pub use growth::{Growth, GrowthPlan, GrowthVerdict, measure_growth, seed_with_noise};
pub use lattice_path::{LatticeCoefficients, LatticePath};
pub use limit::{
    LimitComparison, LongRun, MeasuredLimit, NoBracket, compare_limits, long_run,
    measured_stability_limit,
};
pub use method::{Method, MethodError};
pub use modes::RingModes;
pub use particle_path::ParticlePath;
pub use profile::{Comparison, Extrema, total_variation};
pub use published::{CriticalGrowth, growth_at};
pub use random::SplitMix64;
pub use ring::{Ring, RingError};
pub use run::{AdvectionRun, Layout, PlanError, RunPlan, run, run_with};
pub use scene::{AdvectionScene, Piece};
pub use scheme::{AdvectionScheme, Discretisation, UnknownScheme};
pub use stepper::Stepper;

#[cfg(test)]
mod tests;
