//! The mathematics of `courant`: kernels, stencils, symbols, schemes and limits.
//!
//! Nothing here knows of files, terminals or plots. See `ARCHITECTURE.md`.

pub mod certificate;
pub mod exact;
pub mod golden_section;
pub mod interest;
pub mod kernel;
pub mod scheme;
pub mod spelling;
pub mod stability;
pub mod waves;
