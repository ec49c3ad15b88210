//! What a scheme does to its waves, in floating point: multipliers, growth, sweeps, dispersion.

pub mod accuracy;
pub(crate) mod bands;
pub mod branches;
pub mod dispersion;
pub(crate) mod envelope;
pub mod exact_wave;
mod follow;
pub mod gain_extremes;
pub mod long_waves;
pub mod modified_equation;
pub mod multipliers;
pub(crate) mod precise;
pub mod resolution;
mod roots;
mod sampled_gain;
pub mod step_growth;
pub mod sweep;
pub(crate) mod torus_growth;
pub(crate) mod wave_terms;

pub use gain_extremes::GainExtremes;
pub use multipliers::{CompiledStep, WavePolynomial};
pub use step_growth::{Growth, growth_at};
