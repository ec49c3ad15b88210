//! Numerical fluxes in mass coordinates, one trait: Ferrari et al. 2008, (3.10)–(3.15).

mod roe;

pub use roe::{ContactViscosity, ModifiedRoe, RoeMean};

use super::LagrangianState;
use crate::riemann::{IdealGas, solve};

/// The flux between two particles, from the state of each.
pub trait LagrangianFlux: Sync {
    /// The numerical flux of `(V, v, E)` from `left` to `right` (by the mass coordinate). It is
    /// consistent: for equal states it is `(−v, p, pv)`.
    fn flux(&self, gas: IdealGas, left: &LagrangianState, right: &LagrangianState) -> [f64; 3];
}

/// The Godunov flux `(−v*, p*, p*v*)`: in mass coordinates the ray `ζ/t = 0` is the contact.
///
/// Where a vacuum opens, `p* = 0` and `v*` is the mean of the speeds of its fronts, the limit from
/// the side without vacuum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Exact;

impl LagrangianFlux for Exact {
    #[inline]
    fn flux(&self, gas: IdealGas, left: &LagrangianState, right: &LagrangianState) -> [f64; 3] {
        let solution = solve(gas, &left.to_state(), &right.to_state());
        let (pressure, velocity) = (solution.pressure(), solution.velocity());
        [-velocity, pressure, pressure * velocity]
    }
}

/// The Rusanov flux, Ferrari et al. 2008 (3.10):
/// `(F_L + F_R)/2 − max(C_L, C_R)(U_R − U_L)/2` with `C² = γρp`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rusanov;

impl LagrangianFlux for Rusanov {
    #[inline]
    fn flux(&self, _: IdealGas, left: &LagrangianState, right: &LagrangianState) -> [f64; 3] {
        let speed = left.sound.max(right.sound);
        let (ul, ur) = (left.conserved(), right.conserved());
        let (fl, fr) = (left.flux(), right.flux());
        [0, 1, 2].map(|k| 0.5 * (fl[k] + fr[k]) - 0.5 * speed * (ur[k] - ul[k]))
    }
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
