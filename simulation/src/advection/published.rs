//! Growth at a Courant number said to be stable: the printed limits of Ferrari et al. 2008, Table 1.

use super::lattice_path::LatticePath;
use super::method::Method;
use super::modes::RingModes;
use super::scheme::Discretisation;
use super::stepper::Stepper;
use courant_analysis::stability::weak_instability::{
    fastest_growth, growth_seen_by, steps_to_double,
};
use num_complex::Complex64;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// The fastest-growing wave at one Courant number, predicted and run.
#[derive(Debug, Clone, PartialEq)]
pub struct CriticalGrowth {
    /// The Courant number.
    pub courant_number: f64,
    /// The phase with the largest gain on the infinite lattice, in radians.
    pub critical_phase: f64,
    /// That gain.
    pub largest_gain: f64,
    /// Particles on the ring that was run: chosen so that one of its modes comes closest to that gain.
    pub particles: usize,
    /// The mode that was excited.
    pub mode: usize,
    /// Its phase in radians.
    pub phase: f64,
    /// Its predicted gain per step.
    pub predicted_gain: f64,
    /// Its gain per step in the run; `None` when the run overflowed.
    pub measured_gain: Option<f64>,
    /// Steps of the run.
    pub steps: u64,
    /// Steps in which the wave doubles, as predicted; `None` when it does not grow.
    pub steps_to_double: Option<f64>,
}

/// Finds the wave that grows fastest at a Courant number, chooses a ring with a mode close to it, excites
/// that mode and measures its growth over a free run.
///
/// The mode is the ring's fastest, so rounding in the others stays below it however long the run is.
///
/// # Panics
/// When no size of ring is allowed or a size below 2.
pub fn growth_at(
    discretisation: &Discretisation,
    courant_number: f64,
    sizes: RangeInclusive<usize>,
    steps: u64,
) -> CriticalGrowth {
    let margin = discretisation.margin();
    let critical = fastest_growth(&margin, courant_number);
    let seen = |particles| (particles, growth_seen_by(&margin, courant_number, particles));
    let (particles, wave) = (sizes.filter(|&particles| particles >= 2).map(seen))
        // The smaller of two equally good rings.
        .reduce(|best, other| if other.1.growth > best.1.growth { other } else { best })
        .expect("some size of ring is allowed");
    let mode = (wave.phase / TAU * particles as f64).round() as usize;
    let mut stepper = LatticePath::new(Method::of(discretisation, courant_number), particles);
    let modes = RingModes::new(particles);
    let mut amplitudes = vec![Complex64::ZERO; modes.count()];
    amplitudes[mode] = Complex64::ONE;
    stepper.set_state(&modes.state(&amplitudes));
    let first = modes.amplitude(mode, stepper.state());
    (0..steps).for_each(|_| stepper.step());
    let ratio = modes.amplitude(mode, stepper.state()).norm() / first.norm();
    let grew = ratio.is_finite() && ratio > 0.0;
    let measured_gain = grew.then(|| (ratio.ln() / steps as f64).exp());
    CriticalGrowth {
        courant_number,
        critical_phase: critical.phase,
        largest_gain: 1.0 + critical.growth,
        particles,
        mode,
        phase: wave.phase,
        predicted_gain: 1.0 + wave.growth,
        measured_gain,
        steps,
        steps_to_double: steps_to_double(wave.growth),
    }
}
