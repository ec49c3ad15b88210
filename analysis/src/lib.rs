//! The mathematics of `courant`: kernels, stencils, symbols, schemes and limits.
//!
//! Nothing here knows of files, terminals or plots. See `ARCHITECTURE.md`.

pub mod kernel;
pub mod polynomial;
pub mod rational;
