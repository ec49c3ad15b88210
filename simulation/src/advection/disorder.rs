//! How far the lattice theory carries when the particles are not on a lattice.

use super::method::Method;
use super::particle_path::ParticlePath;
use super::ring::{Ring, RingError};
use super::scheme::Discretisation;
use super::stepper::Stepper;
use crate::stepping::eigenvalues;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// One wave at one amplitude of disorder, over several sets of positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisorderRow {
    /// The largest displacement of a particle, in spacings.
    pub disorder: f64,
    /// Waves on the ring; 0 is a constant.
    pub mode: usize,
    /// `φ = κ Δξ` with the mean spacing, in radians.
    pub phase: f64,
    /// The amplification factor on the lattice.
    pub lattice: Complex64,
    /// What a step leaves of the wave in the wave itself: `Σ_j V_j e^{−iκξ_j} (S e^{iκξ})_j / L`, the mean
    /// over the sets of positions.
    pub mean: Complex64,
    /// Root mean square of that number's distance from its mean over the sets.
    pub spread: f64,
    /// What a step puts into other waves: root mean square over particles (weighted with volumes) and sets
    /// of `S e^{iκξ} − g e^{iκξ}`; 0 on the lattice.
    pub scattered: f64,
}

/// What a long run does at one amplitude of disorder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisorderGrowth {
    /// The largest displacement of a particle, in spacings.
    pub disorder: f64,
    /// The factor per step of a long run, the mean over the sets of positions: the largest modulus of the eigenvalues of
    /// a step.
    pub mean_gain: f64,
    /// The largest over the sets.
    pub largest_gain: f64,
    /// The smallest over the sets.
    pub smallest_gain: f64,
}

/// Gain against disorder: rows by wave, and growth in the long run.
#[derive(Debug, Clone, PartialEq)]
pub struct DisorderStudy {
    /// By disorder, then by mode.
    pub modes: Vec<DisorderRow>,
    /// By disorder.
    pub growth: Vec<DisorderGrowth>,
}

/// Steps waves over disordered positions.
///
/// For each amplitude of disorder, `sets` rings of `particles` are drawn (seeds `0, 1, …`). Each wave of
/// `modes` is stepped once, its cosine and its sine apart, and projected on itself. The largest modulus of
/// the step's eigenvalues is the factor per step of a long run from almost any start; on a lattice it is the
/// largest `|g|`. A run of thousands of steps would not tell it from 1 where the growth is weak: what merely
/// stays, as a constant does, swamps what grows.
///
/// # Errors
/// When there are no particles or a disorder is not in `[0, 0.5)`.
///
/// # Panics
/// When there are no sets.
pub fn gain_against_disorder(
    discretisation: &Discretisation,
    courant_number: f64,
    particles: usize,
    modes: &[usize],
    disorders: &[f64],
    sets: u64,
) -> Result<DisorderStudy, RingError> {
    assert!(sets > 0, "a mean needs at least one set of positions");
    let method = Method::of(discretisation, courant_number);
    let stencil = discretisation.stencil(courant_number);
    let mut study = DisorderStudy { modes: Vec::new(), growth: Vec::new() };
    for &disorder in disorders {
        let rings = (0..sets)
            .map(|seed| Ring::disordered(particles, particles as f64, disorder, seed))
            .collect::<Result<Vec<_>, _>>()?;
        let mut steppers: Vec<_> =
            rings.iter().map(|ring| ParticlePath::new(method, ring)).collect();
        for &mode in modes {
            let phase = TAU * mode as f64 / particles as f64;
            let seen: Vec<(Complex64, f64)> = rings
                .iter()
                .zip(&mut steppers)
                .map(|(ring, stepper)| step_wave(stepper, ring, phase))
                .collect();
            let count = sets as f64;
            let mean = seen.iter().map(|(kept, _)| kept).sum::<Complex64>() / count;
            let spread = seen.iter().map(|(kept, _)| (kept - mean).norm_sqr()).sum::<f64>() / count;
            let scattered = seen.iter().map(|(_, lost)| lost).sum::<f64>() / count;
            study.modes.push(DisorderRow {
                disorder,
                mode,
                phase,
                lattice: stencil.at_phase(phase),
                mean,
                spread: spread.sqrt(),
                scattered: scattered.sqrt(),
            });
        }
        let gains: Vec<f64> = steppers.iter_mut().map(spectral_radius).collect();
        study.growth.push(DisorderGrowth {
            disorder,
            mean_gain: gains.iter().sum::<f64>() / gains.len() as f64,
            largest_gain: gains.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            smallest_gain: gains.iter().copied().fold(f64::INFINITY, f64::min),
        });
    }
    Ok(study)
}

/// The largest modulus of the eigenvalues of a step, whose columns are what it makes of unit vectors.
fn spectral_radius(stepper: &mut ParticlePath) -> f64 {
    let count = stepper.state().len();
    let mut matrix = vec![vec![Complex64::ZERO; count]; count];
    for k in 0..count {
        let mut unit = vec![0.0; count];
        unit[k] = 1.0;
        stepper.set_state(&unit);
        stepper.step();
        matrix.iter_mut().zip(stepper.state()).for_each(|(row, value)| row[k] = (*value).into());
    }
    eigenvalues(&matrix).iter().map(|value| value.norm()).fold(0.0, f64::max)
}

/// The part of `S e^{iκξ}` in the wave itself, and the mean square of the rest.
fn step_wave(stepper: &mut ParticlePath, ring: &Ring, wave_number: f64) -> (Complex64, f64) {
    let wave: Vec<Complex64> =
        ring.positions().iter().map(|x| Complex64::from_polar(1.0, wave_number * x)).collect();
    let mut stepped = |part: fn(&Complex64) -> f64| -> Vec<f64> {
        stepper.set_state(&wave.iter().map(part).collect::<Vec<_>>());
        stepper.step();
        stepper.state().to_vec()
    };
    let (real, imaginary) = (stepped(|z| z.re), stepped(|z| z.im));
    let after: Vec<Complex64> =
        real.into_iter().zip(imaginary).map(|(re, im)| Complex64::new(re, im)).collect();
    let average = |term: &dyn Fn(usize) -> Complex64| -> Complex64 {
        let volumes = ring.volumes().iter().enumerate();
        volumes.map(|(j, volume)| term(j) * volume).sum::<Complex64>() / ring.length()
    };
    let kept = average(&|j| after[j] * wave[j].conj());
    let lost = average(&|j| (after[j] - kept * wave[j]).norm_sqr().into());
    (kept, lost.re)
}
