//! How fast the fastest wave grows under one time step.

use super::wave_scheme::CompiledWaves;
use crate::scheme::integrator::Integrator;
use crate::stability::critical::resolving_phases;
use crate::stability::verdict::{Verdict, WEAK_GROWTH};

/// The fastest growth over all waves, looked at on a grid of phases that resolves every oscillation and
/// refined to its extremum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// `|z| − 1` of the wave that grows fastest, or decays most slowly when none grows: never below
    /// that of `κ → 0`, which is zero.
    pub per_step: f64,
    /// Its phase, in radians.
    pub phase: f64,
    /// Where a double multiplier sits on the unit circle, zero-frequency waves left out, in radians.
    pub double_multiplier: Option<f64>,
}

impl Growth {
    /// How many steps double the amplitude; `None` when nothing grows.
    pub fn steps_to_double(&self) -> Option<f64> {
        (self.per_step > 0.0).then(|| std::f64::consts::LN_2 / self.per_step.ln_1p())
    }

    /// The verdict on the step, as far as looking at waves can tell; [`check_step`](super::check_step)
    /// decides it by the proved limit.
    pub fn verdict(&self) -> Verdict {
        // Two roundings of a multiplier near one.
        if self.per_step > WEAK_GROWTH {
            Verdict::Unstable
        } else if self.per_step > 4.0 * f64::EPSILON {
            Verdict::WeaklyUnstable
        } else if self.double_multiplier.is_some() {
            Verdict::Marginal
        } else {
            Verdict::Stable
        }
    }
}

/// The fastest growth for `step = c Δt/h`.
///
/// ```
/// use courant_analysis::waves::dispersion::{WaveMethod, WaveScheme, worst_growth};
/// use courant_analysis::{scheme::integrator::Integrator, kernel::Kernel, exact::rational::integer, stability::verdict::Verdict};
/// let scheme = WaveScheme::new(WaveMethod::Sph, Kernel::CubicSpline, &integer(1)).unwrap();
/// // ω0² = 8 at the shortest wave, c Δt/h = 1/20: |z|² = 1 + (ω0Δt)⁴/4 = 1.0001.
/// let growth = worst_growth(&scheme.compile(), Integrator::Rk2Heun, 0.05);
/// assert!((growth.per_step - (1.0001f64.sqrt() - 1.0)).abs() < 1e-12);
/// assert_eq!(growth.verdict(), Verdict::WeaklyUnstable);
/// ```
pub fn worst_growth(waves: &CompiledWaves, integrator: Integrator, step: f64) -> Growth {
    let spacing_step = step * waves.ratio();
    let growth_at = |phase: f64| waves.mode(phase).multipliers(integrator, spacing_step).growth;
    let phases: Vec<f64> = resolving_phases(waves.terms()).collect();
    let mut worst = (0, 0.0);
    let mut double_multiplier = None;
    for (index, &phase) in phases.iter().enumerate().skip(1) {
        let mode = waves.mode(phase);
        let multipliers = mode.multipliers(integrator, spacing_step);
        if multipliers.growth > worst.1 {
            worst = (index, multipliers.growth);
        }
        if mode.restoring != 0.0 && multipliers.is_double_on_circle() {
            double_multiplier = Some(phase);
        }
    }
    let (index, mut per_step) = worst;
    let mut phase = phases[index];
    if index > 0 {
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        let mut lower = phases[index - 1];
        let mut upper = phases[(index + 1).min(phases.len() - 1)];
        while upper - lower > 1e-9 {
            let left = upper - golden * (upper - lower);
            let right = lower + golden * (upper - lower);
            let (at_left, at_right) = (growth_at(left), growth_at(right));
            for (candidate, value) in [(left, at_left), (right, at_right)] {
                if value > per_step {
                    (phase, per_step) = (candidate, value);
                }
            }
            if at_left < at_right { lower = left } else { upper = right }
        }
    }
    Growth { per_step, phase, double_multiplier }
}
