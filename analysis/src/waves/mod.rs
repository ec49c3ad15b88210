//! What a scheme does to its waves, in floating point: multipliers, growth, sweeps, dispersion.

pub mod accuracy;
pub(crate) mod bands;
pub mod branches;
pub mod dispersion;
pub mod exact_wave;
mod follow;
pub mod growth;
pub mod long_waves;
pub mod modified_equation;
pub mod multipliers;
pub(crate) mod precise;
pub mod resolution;
mod roots;
pub mod step_growth;
pub mod sweep;
pub(crate) mod wave_terms;

pub use multipliers::{CompiledStep, WavePolynomial};
pub use step_growth::{Growth, growth_at};
