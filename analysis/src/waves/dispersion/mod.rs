//! Dispersion relations of particle methods: what they do to a sound wave on a lattice, exact in time or as an integrator steps it.
//!
//! After Cha & Whitworth 2003, section 4, with left and right states of Godunov particle hydrodynamics chosen by position. A harmonic
//! is `e^{i(κx − ωt)}`, so `Im ω < 0` is damping. Lengths are in spacings `Δ`, speeds in sound speeds `c`: frequencies come in `c/Δ`,
//! phases `φ = κΔ` in radians per spacing.
//!
//! [`LatticeMethod`](crate::scheme::LatticeMethod) → [`LatticeWaves`] → [`Mode`] → [`Frequencies`], or with an integrator
//! [`Step`](crate::scheme::Step) → multipliers → [`stepped_frequencies`].

mod branches;
mod integral_approximation;
mod lattice_waves;
mod mode;
mod sampled_step;
mod stepped;
pub mod sweep;
mod wave_errors;

pub use branches::{Branch, Frequencies, Regime};
pub use integral_approximation::{IntegralComparison, compare_integral, integral_sums};
pub use lattice_waves::{CompiledWaves, LatticeWaves};
pub use mode::Mode;
pub use sampled_step::SampledStep;
pub use stepped::{stepped_frequencies, two_waves};
pub use wave_errors::{AmplitudeTime, amplitude, damping_per_wavelength, phase_error};
