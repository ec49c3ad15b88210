//! The modified Roe flux.

use super::{LagrangianFlux, Rusanov};
use crate::lagrangian::LagrangianState;
use crate::riemann::IdealGas;

/// Which mean state the Roe matrix is taken at. Velocity and pressure are arithmetic means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RoeMean {
    /// The arithmetic mean of the densities, as printed in Ferrari et al. 2008 (3.14). It is not
    /// Roe-consistent: `F_R − F_L = A (U_R − U_L)` fails.
    #[default]
    Density,
    /// The arithmetic mean of the specific volumes, with which the identity holds (Munz 1994).
    Volume,
}

/// The eigenvalue given to the contact wave, whose own is 0: Ferrari et al. 2008 (3.15).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactViscosity {
    /// `λ₂ = α̃ max(|v_L|, |v_R|)`, as printed: a velocity among mass fluxes, so that the effect
    /// depends on the unit of density.
    Printed(f64),
    /// `λ₂ = α̃ ρ̄ max(|v_L|, |v_R|)` with the mean density of the matrix: a mass flux.
    MassFlux(f64),
}

/// The modified Roe flux, Ferrari et al. 2008 (3.12)–(3.15):
/// `(F_L + F_R)/2 − R|Λ|R⁻¹(U_R − U_L)/2` with `Λ = diag(−C̃, λ₂, C̃)`, `C̃² = γρ̃p̃`.
///
/// Where a linear Riemann problem has no physical answer (the states beside its contact have a specific volume or an internal
/// energy below 0, as near a vacuum: Einfeldt, Munz, Roe & Sjögreen 1991), or `λ₂` exceeds `C̃`, the pair gets the flux of
/// [`Rusanov`]. In the tests of the paper that is one pair in some hundred to none.
///
/// `λ₂ = 0` is the flux of Munz 1994. Neither form of `λ₂` is invariant under a change of frame.
///
/// The matrix at mean values `V, v, p` has the rows `(0, −1, 0)`, `a` and `v a + (0, p, 0)` with
/// `a = (−p, −(γ−1)v, γ−1)/V` and the eigenvectors `(1, ∓C, −p ∓ Cv)` for `±C` and
/// `(1, 0, p/(γ−1))` for the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModifiedRoe {
    /// The mean state.
    pub mean: RoeMean,
    /// The contact's eigenvalue.
    pub contact: ContactViscosity,
}

impl Default for ModifiedRoe {
    /// As printed, with `α̃ = 0.1`: the paper calls for a small amount and does not say which.
    fn default() -> Self {
        Self { mean: RoeMean::Density, contact: ContactViscosity::Printed(0.1) }
    }
}

impl RoeMean {
    /// The mean specific volume.
    #[inline]
    pub fn volume(self, left: &LagrangianState, right: &LagrangianState) -> f64 {
        match self {
            Self::Density => 2.0 / (left.density + right.density),
            Self::Volume => 0.5 * (left.volume + right.volume),
        }
    }
}

impl LagrangianFlux for ModifiedRoe {
    #[inline]
    fn flux(&self, gas: IdealGas, left: &LagrangianState, right: &LagrangianState) -> [f64; 3] {
        let gamma = gas.gamma();
        let volume = self.mean.volume(left, right);
        let velocity = 0.5 * (left.velocity + right.velocity);
        let pressure = 0.5 * (left.pressure + right.pressure);
        let sound = (gamma * pressure / volume).sqrt();
        let fastest = left.velocity.abs().max(right.velocity.abs());
        let contact = match self.contact {
            ContactViscosity::Printed(alpha) => alpha * fastest,
            ContactViscosity::MassFlux(alpha) => alpha * fastest / volume,
        };
        let dv = right.velocity - left.velocity;
        let d_volume = right.volume - left.volume;
        // The pressure difference as the matrix sees it: a·(U_R − U_L).
        let dp = ((gamma - 1.0) * (right.energy - left.energy - velocity * dv)
            - pressure * d_volume)
            / volume;
        let acoustic = dp / sound;
        // The strengths of the two acoustic waves, and the states between them and the contact.
        let (to_left, to_right) = (0.5 * (dv - acoustic) / sound, -0.5 * (dv + acoustic) / sound);
        let between = |state: &LagrangianState, strength: f64, sound: f64| {
            let [v, u, e] = state.conserved();
            let (v, u) = (v + strength, u + strength * sound);
            let energy = e + strength * (sound * velocity - pressure);
            v > 0.0 && energy > 0.5 * u * u
        };
        let physical = between(left, to_left, sound) && between(right, -to_right, -sound);
        if !physical || contact > sound {
            return Rusanov.flux(gas, left, right);
        }
        let entropy = contact * (d_volume + acoustic / sound);
        let dissipation = [
            entropy - acoustic,
            sound * dv,
            sound * velocity * dv + pressure * acoustic + entropy * pressure / (gamma - 1.0),
        ];
        let (fl, fr) = (left.flux(), right.flux());
        [0, 1, 2].map(|k| 0.5 * (fl[k] + fr[k]) - 0.5 * dissipation[k])
    }
}
