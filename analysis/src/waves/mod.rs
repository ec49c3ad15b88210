//! What a scheme does to its waves, in floating point: multipliers, growth, sweeps, dispersion.

pub mod consistency;
pub mod dispersion;
pub mod growth;
pub mod multipliers;
mod roots;
pub mod sweep;
pub(crate) mod wave_terms;
