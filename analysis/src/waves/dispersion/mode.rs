//! One mode: its 2 × 2 operator on displacement and velocity, and what a time step makes of it.

use super::branches::{Frequencies, Regime};
use crate::scheme::integrator::{Integrator, Multipliers, PairKind};
use num_complex::Complex64;

/// `Ẋ = V, V̇ = −ω0² X + (−b + i σ) V`, in units of the spacing `Δ` and the sound speed `c`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// `φ = κΔ`, in radians.
    pub phase: f64,
    /// `ω0² Δ²/c²`; negative when the lattice itself is unstable.
    pub restoring: f64,
    /// The damping rate `b Δ/c`.
    pub damping: f64,
    /// `σ Δ/c`: zero but for the published relation of Godunov particle hydrodynamics, where it is `S`.
    pub skew: f64,
}

impl Mode {
    /// `[[0, 1], [F, G]]` by rows, the operator on `(X, V)`: `F = −ω0²`, `G = −b + iσ`.
    pub fn operator(&self) -> [[Complex64; 2]; 2] {
        let zero = Complex64::ZERO;
        [[zero, Complex64::ONE], [(-self.restoring).into(), self.velocity_coefficient()]]
    }

    fn velocity_coefficient(&self) -> Complex64 {
        Complex64::new(-self.damping, self.skew)
    }

    /// The two roots of `ω² + (i b + σ) ω − ω0² = 0`, in units of `c/Δ`.
    pub fn frequencies(&self) -> Frequencies {
        Frequencies::of(self.restoring, self.damping, self.skew)
    }

    /// What one step of `integrator` multiplies the two waves by; `step` is `c Δt/Δ`.
    pub fn multipliers(&self, integrator: Integrator, step: f64) -> Multipliers {
        let f = -self.restoring * step * step;
        if self.skew == 0.0 {
            return integrator.multipliers(f, -self.damping * step);
        }
        let exact = self.frequencies().forward * step;
        let expected = (Complex64::new(exact.im, -exact.re)).exp();
        integrator.complex_multipliers(f, self.velocity_coefficient() * step, expected)
    }

    /// The frequencies the stepped wave shows, `ω = i ln z/Δt`, in units of `c/Δ`; `step` is `c Δt/Δ` and
    /// not zero.
    ///
    /// A real negative multiplier turns the sign at every step: it is `Re ω = ±π/Δt`.
    pub fn stepped_frequencies(&self, integrator: Integrator, step: f64) -> Frequencies {
        let multipliers = self.multipliers(integrator, step);
        let frequency = |z: Complex64, sign: f64| {
            let angle =
                if z.im == 0.0 && z.re < 0.0 { sign * std::f64::consts::PI } else { -z.arg() };
            Complex64::new((angle + 0.0) / step, z.norm().ln() / step)
        };
        let mut forward = frequency(multipliers.forward, 1.0);
        let mut backward = frequency(multipliers.backward, -1.0);
        match multipliers.kind {
            PairKind::Oscillating if self.skew == 0.0 => {
                let rate = multipliers.growth.ln_1p() / step;
                (forward.im, backward.im) = (rate, rate);
            }
            PairKind::Real | PairKind::Double { .. } => {
                forward.im = multipliers.growth.ln_1p() / step;
            }
            PairKind::Oscillating => {}
        }
        let regime = if multipliers.growth > 4.0 * f64::EPSILON {
            Regime::Growing
        } else {
            match multipliers.kind {
                PairKind::Oscillating => Regime::Propagating,
                PairKind::Real if multipliers.forward.re == 1.0 => Regime::ZeroFrequency,
                PairKind::Real => Regime::OverDamped,
                PairKind::Double { .. } if multipliers.forward.re == 1.0 => Regime::ZeroFrequency,
                PairKind::Double { .. } => Regime::CriticallyDamped,
            }
        };
        Frequencies { forward, backward, regime }
    }
}
