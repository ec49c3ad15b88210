//! How many points a wave needs: metrics of a branch along a direction.

use super::branches::{BranchWave, Branches, LONG};
use std::f64::consts::TAU;

/// Errors for which the resolution is told.
pub const ERRORS: [f64; 3] = [0.1, 0.01, 0.001];

/// Waves looked at up to the shortest one.
const WAVES: usize = 512;
/// What keeps the quotient of two small errors finite (Hu, Tritschler, Pirozzoli & Adams 2012).
const SMALL: f64 = 1e-3;

/// What the error is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Phase speed over the exact one, minus 1.
    PhaseSpeed,
    /// Rate of decay over the exact one, minus 1, where the equation only damps.
    DecayRate,
}

impl Measure {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::PhaseSpeed => "phase-speed",
            Self::DecayRate => "decay-rate",
        }
    }

    /// The error of a wave; none where nothing is left of it.
    fn error(self, wave: &BranchWave) -> f64 {
        let ratio = match self {
            Self::PhaseSpeed => wave.phase_speed(),
            Self::DecayRate => wave.decay_ratio(),
        };
        ratio.map_or(0.0, |ratio| (ratio - 1.0).abs())
    }
}

/// How far a physical branch follows the equation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// What the errors are of.
    pub measure: Measure,
    /// For each of [`ERRORS`] the largest phase up to which no wave errs by more per wavelength travelled; `None` where the longest do.
    pub phases: [Option<f64>; 3],
    /// The same after a number of wavelengths.
    pub phases_after: [Option<f64>; 3],
    /// The shortest wave of the direction.
    pub shortest: f64,
    /// The largest `(|c_g/c − 1| + 0.001)/(−Im κ' + 0.001)` and the phase where it is, after Hu, Tritschler, Pirozzoli & Adams 2012, with
    /// the group speed `c_g` and the modified wave number `κ' = ω/a` in radians per cell: how much faster waves run away than they are
    /// damped. `None` where a wave grows or nothing travels.
    pub dispersion_to_dissipation: Option<(f64, f64)>,
}

/// Points per wavelength of a wave.
///
/// ```
/// assert_eq!(courant_analysis::waves::resolution::points_per_wavelength(std::f64::consts::PI), 2.0);
/// ```
pub fn points_per_wavelength(phase: f64) -> f64 {
    TAU / phase
}

impl Resolution {
    /// Lele's resolving efficiency: the part of the waves down to the shortest one of the direction that is resolved (Lele 1992,
    /// section 2.2).
    pub fn efficiency(&self, phase: f64) -> f64 {
        phase / self.shortest
    }
}

impl Branches {
    /// The resolution of the first physical branch along a direction, per wavelength and after so many; `None` without such a branch, or
    /// where the equation does nothing to a wave.
    ///
    /// ```
    /// use courant_analysis::scheme::Lines;
    /// use courant_analysis::{exact::rational::integer, scheme::Step};
    /// use courant_analysis::waves::{branches::Branches, exact_wave::ExactWave};
    /// let central = Lines::from_text("u[j]' = -C*(u[j+1] - u[j-1])/2")?.with("C", &integer(1))?;
    /// let any = Step::from_text("u[n+1,j] = u[n,j-1]")?;
    /// let branches = Branches::of_lines(&central, ExactWave::stated("-I*phi", &any)?)?;
    /// // sin φ/φ = 0.9.
    /// let phase = branches.resolution(&[1.0], 1.0).unwrap().phases[0].unwrap();
    /// assert!((phase.sin() / phase - 0.9).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn resolution(&self, direction: &[f64], wavelengths: f64) -> Option<Resolution> {
        let shortest = Self::shortest(direction);
        let count = WAVES as f64;
        // Equal steps, and equal ratios below the first.
        let first = shortest / count;
        let short = (1..=WAVES).map(|k| shortest * k as f64 / count);
        let ratio = (first / LONG).powf(1.0 / 64.0);
        let long = (0..64).map(|k| LONG * ratio.powi(k));
        let moduli: Vec<f64> = long.chain(short).collect();
        let branches = self.along(direction, &moduli);
        let physical = branches.into_iter().find(|branch| branch.physical == Some(0))?;
        let waves = physical.waves;
        let (exact, _) = waves[0].exact?;
        let measure = match (exact.im != 0.0, exact.re != 0.0) {
            (true, _) => Measure::PhaseSpeed,
            (false, true) => Measure::DecayRate,
            (false, false) => return None,
        };
        let up_to = |error: f64| self.resolved(direction, &waves, measure, error);
        Some(Resolution {
            measure,
            phases: ERRORS.map(up_to),
            phases_after: ERRORS.map(|error| up_to(error / wavelengths)),
            shortest,
            dispersion_to_dissipation: dispersion_to_dissipation(&waves),
        })
    }

    /// The largest phase up to which the error stays below a bound.
    fn resolved(
        &self,
        direction: &[f64],
        waves: &[BranchWave],
        measure: Measure,
        bound: f64,
    ) -> Option<f64> {
        let Some(passed) = waves.iter().position(|wave| measure.error(wave) > bound) else {
            return waves.last().map(|wave| wave.phase);
        };
        let (mut low, mut high) = (*waves.get(passed.checked_sub(1)?)?, waves[passed]);
        while high.phase - low.phase > 1e-14 * high.phase {
            let middle = 0.5 * (low.phase + high.phase);
            if middle <= low.phase || middle >= high.phase {
                break;
            }
            let wave = self.between(direction, &low, &high, middle);
            let side = if measure.error(&wave) > bound { &mut high } else { &mut low };
            *side = wave;
        }
        Some(low.phase)
    }

    /// A wave of a branch between two that are near to each other.
    fn between(
        &self,
        direction: &[f64],
        low: &BranchWave,
        high: &BranchWave,
        at: f64,
    ) -> BranchWave {
        let phases = super::branches::scaled(direction, at);
        let share = (at - low.phase) / (high.phase - low.phase);
        let expected = low.exponent + (high.exponent - low.exponent) * share;
        let roots = self.step.differences(&[], &phases);
        let slopes = self.step.slopes(&[], &phases, direction, &roots);
        let exact = Some(self.exact[0].exponent(direction, at));
        let waves = roots.into_iter().zip(slopes);
        let waves = waves.map(|(y, slope)| self.wave(at, y, slope, expected.im, exact));
        let off = |wave: &BranchWave| (wave.exponent - expected).norm();
        waves.min_by(|a, b| off(a).total_cmp(&off(b))).expect("there is a branch")
    }
}

fn dispersion_to_dissipation(waves: &[BranchWave]) -> Option<(f64, f64)> {
    let mut largest: Option<(f64, f64)> = None;
    for wave in waves {
        let (exact, _) = wave.exact?;
        // Im κ' of κ' = iλ φ/|Im λ_exact|; the exact damping is no error.
        let damping = -(wave.exponent.re - exact.re) * wave.phase / exact.im.abs();
        if damping.is_nan() || damping < -1e-12 {
            return None;
        }
        let Some(group) = wave.group_speed() else { continue };
        let ratio = ((group - 1.0).abs() + SMALL) / (damping.max(0.0) + SMALL);
        if largest.is_none_or(|(most, _)| ratio > most) {
            largest = Some((ratio, wave.phase));
        }
    }
    largest
}

#[cfg(test)]
mod tests;
