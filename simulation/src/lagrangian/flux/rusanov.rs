//! The Rusanov flux.

use super::LagrangianFlux;
use crate::lagrangian::LagrangianState;
use crate::riemann::IdealGas;

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
