//! Gas dynamics in Lagrangian mass coordinates: the Godunov-type SPH of Ferrari et al. 2008,
//! section 3.
//!
//! `U = (V, v, E)` with specific volume `V = 1/ρ` and specific total energy
//! `E = v²/2 + pV/(γ − 1)` obeys `U_t + F_ζ = 0`, `F = (−v, p, pv)`, (3.6)–(3.8), on a lattice that is
//! uniform in the mass coordinate ζ.

pub mod flux;
mod lattice;
pub mod linear;
mod scheme;
mod state;

pub use flux::LagrangianFlux;
pub use lattice::{InvalidLattice, Lattice};
pub use scheme::{LagrangianOptions, LagrangianScheme, StepRule};
pub use state::LagrangianState;

#[cfg(test)]
mod tests;
