//! Numerical fluxes in mass coordinates, one trait: Ferrari et al. 2008, (3.10)–(3.15).

mod exact;
mod roe;
mod rusanov;

pub use exact::Exact;
pub use roe::{ContactViscosity, ModifiedRoe, RoeMean};
pub use rusanov::Rusanov;

use super::LagrangianState;
use crate::riemann::IdealGas;

/// The flux between two particles, from the state of each.
pub trait LagrangianFlux: Sync {
    /// The numerical flux of `(V, v, E)` from `left` to `right` (by the mass coordinate). It is
    /// consistent: for equal states it is `(−v, p, pv)`.
    fn flux(&self, gas: IdealGas, left: &LagrangianState, right: &LagrangianState) -> [f64; 3];
}

/// The choice among the fluxes, as plain data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Flux {
    /// [`Exact`].
    Exact,
    /// [`Rusanov`].
    Rusanov,
    /// [`ModifiedRoe`].
    ModifiedRoe(ModifiedRoe),
}

impl LagrangianFlux for Flux {
    #[inline]
    fn flux(&self, gas: IdealGas, left: &LagrangianState, right: &LagrangianState) -> [f64; 3] {
        match self {
            Self::Exact => Exact.flux(gas, left, right),
            Self::Rusanov => Rusanov.flux(gas, left, right),
            Self::ModifiedRoe(roe) => roe.flux(gas, left, right),
        }
    }
}

#[cfg(test)]
mod tests;
