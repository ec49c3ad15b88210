//! What a step does to each mode, measured on the running code and set beside the prediction.

use super::faulty::{Fault, Faulty};
use super::modes::RingModes;
use super::random::SplitMix64;
use super::run::Layout;
use super::scheme::Discretisation;
use super::stepper::Stepper;
use crate::run::{InvalidOptions, positive};
use crate::stepping::largest;
use courant_analysis::exact::stencil::Stencil;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// The allowed error in units of `ε (√N + K) A`; see [`Validation::tolerance`].
const TOLERANCE_FACTOR: f64 = 16.0;

/// One mode, predicted and measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModeRow {
    /// Waves on the ring, `m`.
    pub mode: usize,
    /// `φ = 2πm/N` in radians.
    pub phase: f64,
    /// The amplification factor `g(φ)` of the symbol.
    pub predicted: Complex64,
    /// The factor per step seen on the running code.
    pub measured: Complex64,
    /// `|measured − predicted|`.
    pub error: f64,
}

/// Predicted against measured for all modes of a ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Validation {
    /// One row per mode, `m = 0, …, ⌊N/2⌋`.
    pub rows: Vec<ModeRow>,
    /// Steps done.
    pub steps: u64,
    /// The largest error of a row.
    pub max_error: f64,
    /// `16 ε (√N + K) A`, with `K` the reach of the stencil and `A = Σ_k |c_k|`, which bounds every gain.
    ///
    /// One step, one sum over the ring each way and the table of the roots of unity each leave a few `√N ε`
    /// of the largest amplitude in an amplitude; the phases `kφ` of the prediction, up to `Kπ`, carry
    /// `K ε`. The errors of the steps are averaged and so do not add up. 16 leaves a factor of ten
    /// to a hundred over the largest error met.
    pub tolerance: f64,
}

impl Validation {
    /// Whether every mode agrees.
    pub fn passed(&self) -> bool {
        // Written so that an error that is no number does not pass.
        self.max_error <= self.tolerance
    }
}

/// What `courant validate` runs.
#[derive(Debug, Clone, PartialEq)]
pub struct ValidationPlan {
    /// Scheme, kernel, ratio.
    pub discretisation: Discretisation,
    /// The Courant number.
    pub courant_number: f64,
    /// How many particles on the ring.
    pub particles: usize,
    /// How many steps.
    pub steps: u64,
    /// Where the particles are and which code steps them; where they are not equally spaced, waves mix and nothing agrees.
    pub layout: Layout,
    /// A deliberate error of the stepping code, to see the check fail.
    pub fault: Option<Fault>,
}

/// The gain and phase of every mode of the ring per step, all modes in one run of `steps` steps.
///
/// All modes start with modulus 1 and phases from a seed. After each step every amplitude is compared
/// with what it was, and its modulus is set back to 1 while its phase goes on: left alone, a mode that
/// grows would bury one that decays under its rounding errors within some tens of steps. The answer is
/// the mean over the steps. The translation invariance of the stepper is what lets modes be told apart;
/// on disordered positions the answer is only the diagonal of the step's matrix in Fourier space.
///
/// # Panics
/// When there are no steps.
pub(super) fn measure_amplification(
    stepper: &mut dyn Stepper,
    modes: &RingModes,
    steps: u64,
) -> Vec<Complex64> {
    assert!(steps > 0, "a mean needs a step");
    let mut random = SplitMix64::new(0x6d6f_6465);
    let mut amplitudes: Vec<Complex64> = (0..modes.count())
        .map(|mode| match modes.is_real(mode) {
            true => Complex64::new(1.0, 0.0),
            false => Complex64::from_polar(1.0, TAU * random.unit()),
        })
        .collect();
    let mut sums = vec![Complex64::new(0.0, 0.0); modes.count()];
    for _ in 0..steps {
        stepper.set_state(&modes.state(&amplitudes));
        stepper.step();
        for (mode, (amplitude, sum)) in amplitudes.iter_mut().zip(&mut sums).enumerate() {
            let after = modes.amplitude(mode, stepper.state());
            *sum += after / *amplitude;
            // A mode that is gone has no phase to go on with.
            if after.norm() > 0.0 {
                *amplitude = after / after.norm();
            }
        }
    }
    sums.into_iter().map(|sum| sum / steps as f64).collect()
}

fn tolerance(stencil: &Stencil<f64>, particles: usize) -> f64 {
    let (low, high) = stencil.reach().unwrap_or((0, 0));
    let reach = low.abs().max(high) as f64;
    let moduli: f64 = stencil.terms().map(|(_, value)| value.abs()).sum();
    TOLERANCE_FACTOR * f64::EPSILON * ((particles as f64).sqrt() + reach) * moduli.max(1.0)
}

/// Steps the real scheme and compares each mode with the amplification factor.
///
/// The ring has spacing 1, so that distances between particles are exact.
///
/// ```
/// use courant_analysis::{kernel::Kernel, exact::rational::ratio};
/// use courant_simulation::advection::{
///     AdvectionScheme, Discretisation, Layout, ValidationPlan, validate,
/// };
/// let plan = ValidationPlan {
///     discretisation: Discretisation::new(
///         AdvectionScheme::LaxWendroffSph, Kernel::QuinticSpline, ratio(13, 10)).unwrap(),
///     courant_number: 0.75,
///     particles: 50,
///     steps: 100,
///     layout: Layout::Uniform,
///     fault: None,
/// };
/// let validation = validate(&plan).unwrap();
/// assert!(validation.passed() && validation.max_error < 1e-13);
/// ```
///
/// # Errors
/// When the Courant number is not positive and finite, or there are no particles or no steps.
pub fn validate(plan: &ValidationPlan) -> Result<Validation, InvalidOptions> {
    let &ValidationPlan { ref discretisation, courant_number, particles, steps, layout, fault } =
        plan;
    positive("cfl", courant_number)?;
    positive("steps", steps as f64)?;
    let (_, mut inner) =
        layout.stepper(discretisation, courant_number, particles, particles as f64)?;
    if let Some(fault) = fault {
        inner = Box::new(Faulty { inner, fault });
    }
    let stencil = discretisation.stencil(courant_number);
    let modes = RingModes::new(particles);
    let row = |(mode, measured): (usize, Complex64)| {
        let phase = modes.phase(mode);
        let predicted = stencil.at_phase(phase);
        let error = (measured - predicted).norm();
        ModeRow { mode, phase, predicted, measured, error }
    };
    let measured = measure_amplification(&mut *inner, &modes, steps).into_iter();
    let rows: Vec<ModeRow> = measured.enumerate().map(row).collect();
    let max_error = largest(rows.iter().map(|row| row.error));
    let tolerance = tolerance(&stencil, particles);
    Ok(Validation { rows, steps, max_error, tolerance })
}
