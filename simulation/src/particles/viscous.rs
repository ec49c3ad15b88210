//! Smoothed particle hydrodynamics with artificial viscosity: Cha & Whitworth 2003 (4)–(8).

use super::pair_force::{Exchange, PairEnd, PairForce, Work};
use super::smoothing_kernel::RadialKernel;

/// Artificial viscosity (8).
///
/// `Π = (−α c̄ μ + β μ²)/ρ̄` for `μ = h v_ij·r_ij/(r² + η h²)`, `η = 0.01`, bars and `h = (h_i + h_j)/2` the
/// pair's means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viscosity {
    /// `α`, of the linear term.
    pub alpha: f64,
    /// `β`, of the quadratic term.
    pub beta: f64,
    /// On which pairs it acts.
    pub acts_on: ActsOn,
    /// `η`, which keeps the denominator from zero: 0.01 in (8), 0 in the linear analysis of section 4.2.
    pub softening: f64,
}

/// Which pairs a viscosity acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ActsOn {
    /// Approaching pairs, as (8) says.
    Approaching,
    /// Receding pairs too: what a linear analysis assumes (section 4.2 of the paper).
    All,
}

impl Viscosity {
    /// `α = 1`, `β = 2` on approaching pairs.
    pub const STANDARD: Self =
        Self { alpha: 1.0, beta: 2.0, acts_on: ActsOn::Approaching, softening: 0.01 };

    /// `Π`, in pressure over density squared.
    #[inline]
    pub fn term(&self, left: &PairEnd, right: &PairEnd, distance: f64) -> f64 {
        let closing = right.velocity - left.velocity;
        if closing >= 0.0 && self.acts_on == ActsOn::Approaching {
            return 0.0;
        }
        let h = 0.5 * (left.smoothing + right.smoothing);
        let mu = h * closing * distance / (distance * distance + self.softening * h * h);
        let sound = 0.5 * (left.sound_speed + right.sound_speed);
        (-self.alpha * sound * mu + self.beta * mu * mu) * 2.0 / (left.density + right.density)
    }
}

/// The symmetric form of the pressure term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PressureForm {
    /// `P_i/ρ_i² + P_j/ρ_j²`: SPH 1, (4) and (5).
    Sum,
    /// `2√(P_i P_j)/(ρ_i ρ_j)`: SPH 2, (6) and (7).
    Geometric,
}

/// SPH 1 or SPH 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smoothed {
    /// SPH 1 or SPH 2.
    pub form: PressureForm,
    /// The artificial viscosity.
    pub viscosity: Viscosity,
}

impl PairForce for Smoothed {
    const WORK: Work = Work::Instantaneous;

    #[inline]
    fn exchange<K: RadialKernel>(
        &self,
        left: &PairEnd,
        right: &PairEnd,
        distance: f64,
        kernel: &K,
    ) -> Option<Exchange> {
        let slope = kernel.slope(distance, 0.5 * (left.smoothing + right.smoothing));
        if slope == 0.0 {
            return None;
        }
        let (pressure, weight) = match self.form {
            PressureForm::Sum => (
                left.pressure / (left.density * left.density)
                    + right.pressure / (right.density * right.density),
                1.0 / (left.density * left.density) + 1.0 / (right.density * right.density),
            ),
            PressureForm::Geometric => (
                2.0 * (left.pressure * right.pressure).sqrt() / (left.density * right.density),
                2.0 / (left.density * right.density),
            ),
        };
        Some(Exchange {
            force: (pressure + self.viscosity.term(left, right, distance)) * slope,
            weight: weight * slope,
            velocity: 0.5 * (left.velocity + right.velocity),
            iterations: 0,
        })
    }
}
