//! The Godunov flux.

use super::LagrangianFlux;
use crate::lagrangian::LagrangianState;
use crate::riemann::{IdealGas, solve};

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
