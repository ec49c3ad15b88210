//! Dispersion relations of particle methods: what they do to an isothermal sound wave on a lattice.
//!
//! After Cha & Whitworth 2003, section 4, with its relation for Godunov particle hydrodynamics put right.
//! A harmonic is `e^{i(κx − ωt)}`, so `Im ω < 0` is damping. Lengths are in spacings `Δ`, speeds in sound
//! speeds `c`: frequencies come in `c/Δ`, phases `φ = κΔ` in radians per spacing.
//!
//! [`LatticeSums`] → [`WaveScheme`] → [`Mode`] → [`Frequencies`], and with an
//! [`Integrator`](crate::scheme::integrator::Integrator) its multipliers and [stable steps](stable_step).

mod branches;
mod growth;
mod integral_approximation;
mod method;
mod mode;
mod stable_step;
mod step_check;
mod step_conditions;
pub mod sweep;
mod wave_errors;
mod wave_scheme;

pub use branches::{Branch, Frequencies, Regime};
pub use growth::{Growth, worst_growth};
pub use integral_approximation::{IntegralComparison, compare_integral, integral_sums};
pub use method::{Form, UnknownForm, WaveMethod};
pub use mode::Mode;
pub use stable_step::{
    Binding, NoSchemeRuns, SampledStep, StableStep, StepEnd, stable_step, stable_step_within,
};
pub use step_check::{StepCheck, check_step};
pub use wave_errors::{AmplitudeTime, amplitude, damping_per_wavelength, phase_error};
pub use wave_scheme::{CompiledWaves, WaveScheme};
