//! The mathematics of `courant`: kernels, stencils, symbols, schemes and limits.
//!
//! Nothing here knows of files, terminals or plots. See `ARCHITECTURE.md`.

pub mod algebraic_number;
pub mod bernstein;
pub mod certificate;
pub mod common_factor;
pub mod consistency;
pub mod cosine_series;
pub mod descartes;
pub mod discriminant;
pub mod dispersion;
pub mod enclosed_series;
pub mod fixed_point;
pub mod growth;
pub mod integrator;
pub mod interval;
pub mod kernel;
pub mod lagrangian;
pub mod lattice;
pub mod limit;
pub mod margin;
pub mod modular;
pub mod polynomial;
pub mod rational;
pub mod real_roots;
pub mod scheme;
pub mod stencil;
pub mod sweep;
pub mod symbol;
pub mod verdict;
pub mod weak_instability;
