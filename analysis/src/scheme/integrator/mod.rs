//! Time integrators for a damped oscillator, each written once as the algorithm a code runs.
//!
//! A linear wave in a particle scheme obeys `Ẋ = V, V̇ = F X + G V`, mode by mode. One step multiplies
//! the state `(X, VΔt)` by a 2 × 2 matrix whose entries are polynomials in `f = FΔt²` and `g = GΔt`.
//! The steps are generic over the number type: run on floats they advance a wave, run on polynomials
//! they give the matrix, from which the conditions for stability follow exactly.

mod conditions;
mod multipliers;
mod number;
mod step;

pub use conditions::{BivariatePolynomial, StepPolynomials};
pub use multipliers::{Multipliers, PairKind};
pub use number::Number;

/// A time integrator.
///
/// ```
/// use courant_analysis::scheme::integrator::Integrator;
/// assert_eq!("kdk".parse(), Ok(Integrator::LeapfrogKdk));
/// // One undamped leapfrog step at ωΔt = 1: the matrix on (X, VΔt) has determinant 1.
/// let [[a, b], [c, d]] = Integrator::LeapfrogKdk.matrix(&-1.0, &0.0);
/// assert_eq!([a, b, c, d], [0.5, 1.0, -0.75, 0.5]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Integrator {
    /// `X += VΔt, V += a(X, V)Δt`, both from the old state.
    ForwardEuler,
    /// `V += a(X, V)Δt`, then `X += VΔt` with the new velocity.
    ///
    /// A kick–drift–kick leapfrog that keeps the acceleration of the last step and takes the viscous
    /// force from the half-step velocity is this method seen at half steps: the same multipliers.
    SymplecticEuler,
    /// `V += a(X, V)Δt`, then `X += (Vⁿ + Vⁿ⁺¹)Δt/2`: first order, the step of Godunov particle
    /// hydrodynamics, whose energy equation needs the time-centred velocity.
    CentredEuler,
    /// Kick–drift–kick; each kick uses the velocity at its own beginning: `Vⁿ`, then `Vⁿ⁺¹ᐟ²`.
    LeapfrogKdk,
    /// Kick–drift–kick; the second kick takes the viscous force from the predicted end velocity
    /// `Vⁿ + aⁿΔt` (Springel 2005).
    LeapfrogKdkPredicted,
    /// Runge–Kutta of second order, midpoint.
    Rk2Midpoint,
    /// Runge–Kutta of second order, trapezoidal (Heun).
    Rk2Heun,
    /// Runge–Kutta of third order, strong-stability-preserving (Shu & Osher 1988).
    Rk3Ssp,
    /// The classical Runge–Kutta method of fourth order.
    Rk4,
    /// Predictor–corrector of SPH codes (Monaghan 1989; Gómez-Gesteira et al. 2012): half-step
    /// predictor from the old rates, half-step corrector of velocity and position with the rates at the
    /// prediction, then `Uⁿ⁺¹ = 2Uⁿ⁺¹ᐟ² − Uⁿ`.
    PredictorCorrector,
}

/// A name that is no integrator's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no integrator `{0}`")]
pub struct UnknownIntegrator(pub String);

impl Integrator {
    /// All integrators, in the order they are listed to people.
    pub const ALL: [Self; 10] = [
        Self::ForwardEuler,
        Self::SymplecticEuler,
        Self::CentredEuler,
        Self::LeapfrogKdk,
        Self::LeapfrogKdkPredicted,
        Self::Rk2Midpoint,
        Self::Rk2Heun,
        Self::Rk3Ssp,
        Self::Rk4,
        Self::PredictorCorrector,
    ];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::ForwardEuler => "forward-euler",
            Self::SymplecticEuler => "symplectic-euler",
            Self::CentredEuler => "centred-euler",
            Self::LeapfrogKdk => "leapfrog-kdk",
            Self::LeapfrogKdkPredicted => "leapfrog-kdk-predicted",
            Self::Rk2Midpoint => "rk2-midpoint",
            Self::Rk2Heun => "rk2-heun",
            Self::Rk3Ssp => "rk3-ssp",
            Self::Rk4 => "rk4",
            Self::PredictorCorrector => "predictor-corrector",
        }
    }

    /// Other accepted names.
    pub fn aliases(self) -> &'static [&'static str] {
        match self {
            Self::ForwardEuler => &["euler"],
            Self::SymplecticEuler => &["semi-implicit-euler"],
            Self::CentredEuler => &["centered-euler"],
            Self::LeapfrogKdk => &["kdk", "leapfrog"],
            Self::LeapfrogKdkPredicted => &["kdk-predicted", "leapfrog-predicted"],
            Self::Rk2Midpoint => &["midpoint", "rk2"],
            Self::Rk2Heun => &["heun"],
            Self::Rk3Ssp => &["rk3", "ssp-rk3"],
            Self::Rk4 => &[],
            Self::PredictorCorrector => &["pc"],
        }
    }

    /// The name for titles and captions.
    pub fn title(self) -> &'static str {
        match self {
            Self::ForwardEuler => "forward Euler",
            Self::SymplecticEuler => "symplectic Euler",
            Self::CentredEuler => "centred Euler",
            Self::LeapfrogKdk => "leapfrog KDK",
            Self::LeapfrogKdkPredicted => "leapfrog KDK, predicted velocity",
            Self::Rk2Midpoint => "RK2 midpoint",
            Self::Rk2Heun => "RK2 Heun",
            Self::Rk3Ssp => "RK3 (SSP)",
            Self::Rk4 => "RK4",
            Self::PredictorCorrector => "predictor–corrector",
        }
    }

    /// Where the integrator comes from.
    pub fn source(self) -> &'static str {
        match self {
            Self::ForwardEuler | Self::SymplecticEuler => "Hairer, Lubich & Wanner 2006, I.1",
            Self::CentredEuler => "Cha & Whitworth 2003 (14), (16)",
            Self::LeapfrogKdk => "Verlet 1967; Quinn et al. 1997",
            Self::LeapfrogKdkPredicted => "Springel 2005, section 4",
            Self::Rk2Midpoint | Self::Rk2Heun | Self::Rk4 => "Hairer, Nørsett & Wanner 1993, II.1",
            Self::Rk3Ssp => "Shu & Osher 1988",
            Self::PredictorCorrector => "Monaghan 1989; Gómez-Gesteira et al. 2012",
        }
    }

    /// How often one step evaluates the force.
    pub fn force_evaluations(self) -> usize {
        match self {
            Self::ForwardEuler | Self::SymplecticEuler | Self::CentredEuler => 1,
            Self::LeapfrogKdk
            | Self::LeapfrogKdkPredicted
            | Self::Rk2Midpoint
            | Self::Rk2Heun
            | Self::PredictorCorrector => 2,
            Self::Rk3Ssp => 3,
            Self::Rk4 => 4,
        }
    }
}

impl std::fmt::Display for Integrator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(self.name())
    }
}

impl std::str::FromStr for Integrator {
    type Err = UnknownIntegrator;
    fn from_str(text: &str) -> Result<Self, UnknownIntegrator> {
        let wanted = text.trim().to_ascii_lowercase();
        Self::ALL
            .into_iter()
            .find(|one| one.name() == wanted || one.aliases().contains(&wanted.as_str()))
            .ok_or_else(|| UnknownIntegrator(text.into()))
    }
}

#[cfg(test)]
mod tests;
