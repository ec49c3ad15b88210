//! Growth at a Courant number said to be stable: the printed limits of Ferrari et al. 2008, Table 1.

use super::amplification::fit_mode;
use super::lattice_path::LatticePath;
use super::method::Method;
use super::scheme::Discretisation;
use courant_analysis::exact::stencil::Stencil;
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// Phases looked at for each oscillation of the fastest-growing part of the gain.
const SAMPLES_PER_OFFSET: usize = 256;

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
    let stencil = discretisation.stencil(courant_number);
    let gain = |phase: f64| stencil.at_phase(phase).norm();
    let (critical_phase, largest_gain) = largest_gain(&stencil);
    let mut best: Option<(usize, usize, f64)> = None;
    for particles in sizes.filter(|&particles| particles >= 2) {
        let nearest = critical_phase / (2.0 * PI) * particles as f64;
        for mode in [nearest.floor(), nearest.ceil()] {
            let mode = (mode as usize).clamp(1, particles / 2);
            let gain = gain(ring_phase(particles, mode));
            // The smaller of two equally good rings.
            if best.is_none_or(|(_, _, found)| gain > found) {
                best = Some((particles, mode, gain));
            }
        }
    }
    let (particles, mode, predicted_gain) = best.expect("some size of ring is allowed");
    let mut stepper = LatticePath::new(Method::of(discretisation, courant_number), particles);
    let measured_gain = fit_mode(&mut stepper, mode, steps).map(|fit| fit.gain);
    CriticalGrowth {
        courant_number,
        critical_phase,
        largest_gain,
        particles,
        mode,
        phase: ring_phase(particles, mode),
        predicted_gain,
        measured_gain,
        steps,
        steps_to_double: (predicted_gain > 1.0).then(|| 2f64.ln() / predicted_gain.ln()),
    }
}

/// `φ_m = 2πm/N` in radians.
fn ring_phase(particles: usize, mode: usize) -> f64 {
    2.0 * PI * mode as f64 / particles as f64
}

/// The phase with the largest gain, `φ = 0` left out, and that gain: the best of a grid that resolves
/// every oscillation of the gain, refined by golden section.
fn largest_gain(stencil: &Stencil<f64>) -> (f64, f64) {
    let (low, high) = stencil.reach().unwrap_or((0, 0));
    let samples = SAMPLES_PER_OFFSET * (high - low).max(1) as usize;
    let spacing = PI / samples as f64;
    let gain = |phase: f64| stencil.at_phase(phase).norm();
    let best = (1..=samples)
        .map(|index| index as f64 * spacing)
        .max_by(|&a, &b| gain(a).total_cmp(&gain(b)))
        .expect("there is at least one sample");
    let (mut left, mut right) = (best - spacing, (best + spacing).min(PI));
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    while right - left > 1e-9 {
        let (a, b) = (right - golden * (right - left), left + golden * (right - left));
        if gain(a) < gain(b) { left = a } else { right = b }
    }
    let refined = left.midpoint(right);
    if gain(refined) >= gain(best) { (refined, gain(refined)) } else { (best, gain(best)) }
}
