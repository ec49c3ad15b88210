//! Sweeps over wave number, smoothing ratio, viscosity and time step: plain arrays, computed in parallel.
//!
//! Every value depends on its own place alone, so the results are the same bits for any number of
//! threads. A callback hears of every finished row and may end the sweep.

use super::mode::Mode;
use super::sampled_step::SampledStep;
use super::wave_errors::{AmplitudeTime, amplitude, damping_per_wavelength, phase_error};
use crate::exact::rational::{Rational, integer, to_f64};
use crate::scheme::{Integrator, LatticeMethod};
use crate::waves::sweep::{Progress, SweepError, with_progress};
use ndarray::{Array2, Array3};
use rayon::prelude::*;

/// `count` values from `from` to `to` inclusive, evenly spaced and exact.
///
/// ```
/// use courant_analysis::waves::dispersion::sweep::even_axis;
/// use courant_analysis::exact::rational::{integer, ratio};
/// let axis = even_axis(&integer(1), &ratio(3, 2), 6);
/// assert_eq!((axis[1].clone(), axis[5].clone()), (ratio(11, 10), ratio(3, 2)));
/// ```
pub fn even_axis(from: &Rational, to: &Rational, count: usize) -> Vec<Rational> {
    let steps = integer(count.saturating_sub(1).max(1) as i64);
    (0..count).map(|index| from + (to - from) * integer(index as i64) / &steps).collect()
}

/// What is looked at of the forward wave of a mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// `(Re ω − cκ)/(cκ)`: (57) with its sign. It is −1 where the wave does not travel.
    PhaseError,
    /// `exp(Im ω t)`: (56).
    Amplitude(AmplitudeTime),
    /// `Re ω/(cκ)`.
    Speed,
    /// `−2π Im ω/(cκ)`.
    DampingPerWavelength,
    /// `b/(2ω0)`: above 1 the mode is over-damped, so its contour at 1 bounds that region. Infinite
    /// where nothing restores a damped mode, NaN where the lattice itself is unstable.
    DampingRatio,
}

impl Quantity {
    /// The value for a mode of phase above zero.
    #[inline]
    pub fn of(self, mode: &Mode) -> f64 {
        match self {
            Self::DampingRatio if mode.damping == 0.0 && mode.restoring >= 0.0 => 0.0,
            Self::DampingRatio => 0.5 * mode.damping / mode.restoring.sqrt(),
            Self::PhaseError => phase_error(mode.frequencies().forward, mode.phase),
            Self::Amplitude(time) => amplitude(mode.frequencies().forward, mode.phase, time),
            Self::Speed => mode.frequencies().forward.re / mode.phase,
            Self::DampingPerWavelength => {
                damping_per_wavelength(mode.frequencies().forward, mode.phase)
            }
        }
    }
}

/// Fills `rows × width` values row by row.
fn fill_rows<R: Sync>(
    rows: &[R],
    width: usize,
    progress: Progress<'_>,
    fill: impl Fn(&R, &mut [f64]) -> Result<(), SweepError> + Sync,
) -> Result<Vec<f64>, SweepError> {
    let mut values = vec![0.0; rows.len() * width];
    if width == 0 {
        return Ok(values);
    }
    with_progress(values.par_chunks_mut(width).zip(rows), progress, |(target, row)| {
        fill(row, target)
    })?;
    Ok(values)
}

fn plane(rows: usize, columns: usize, values: Vec<f64>) -> Array2<f64> {
    Array2::from_shape_vec((rows, columns), values).expect("one value for every place")
}

/// A quantity on the (κ, h) plane, `[ratio, phase]`; of `method` all but the ratio is used. Phases are
/// `κΔ > 0` in radians.
///
/// # Errors
/// When a ratio is out of range, or when the callback cancels.
pub fn over_phase_and_ratio(
    method: &LatticeMethod,
    phases: &[f64],
    ratios: &[Rational],
    quantity: Quantity,
    progress: Progress<'_>,
) -> Result<Array2<f64>, SweepError> {
    let values = fill_rows(ratios, phases.len(), progress, |ratio, target| {
        let waves = method.at_ratio(ratio)?.waves()?.compile();
        for (value, &phase) in target.iter_mut().zip(phases) {
            *value = quantity.of(&waves.mode(phase));
        }
        Ok(())
    })?;
    Ok(plane(ratios.len(), phases.len(), values))
}

/// A quantity on the (κ, α) plane, `[factor, phase]`: the damping of `method` multiplied by each factor,
/// which is α itself when it has α = 1.
///
/// # Errors
/// When the callback cancels.
pub fn over_phase_and_viscosity(
    method: &LatticeMethod,
    phases: &[f64],
    factors: &[f64],
    quantity: Quantity,
    progress: Progress<'_>,
) -> Result<Array2<f64>, SweepError> {
    let waves = method.waves()?.compile();
    let modes: Vec<Mode> = phases.iter().map(|&phase| waves.mode(phase)).collect();
    let values = fill_rows(factors, phases.len(), progress, |factor, target| {
        fill_with_viscosity(&modes, *factor, quantity, target);
        Ok(())
    })?;
    Ok(plane(factors.len(), phases.len(), values))
}

fn fill_with_viscosity(modes: &[Mode], factor: f64, quantity: Quantity, target: &mut [f64]) {
    for (value, mode) in target.iter_mut().zip(modes) {
        *value = quantity.of(&Mode { damping: factor * mode.damping, ..*mode });
    }
}

/// A quantity on the (κ, h, α) box, `[ratio, factor, phase]`, as in the two planes.
///
/// # Errors
/// When a ratio is out of range, or when the callback cancels.
pub fn over_phase_ratio_and_viscosity(
    method: &LatticeMethod,
    phases: &[f64],
    ratios: &[Rational],
    factors: &[f64],
    quantity: Quantity,
    progress: Progress<'_>,
) -> Result<Array3<f64>, SweepError> {
    let width = factors.len() * phases.len();
    let values = fill_rows(ratios, width, progress, |ratio, target| {
        let waves = method.at_ratio(ratio)?.waves()?.compile();
        let modes: Vec<Mode> = phases.iter().map(|&phase| waves.mode(phase)).collect();
        for (target, factor) in target.chunks_mut(phases.len()).zip(factors) {
            fill_with_viscosity(&modes, *factor, quantity, target);
        }
        Ok(())
    })?;
    let shape = (ratios.len(), factors.len(), phases.len());
    Ok(Array3::from_shape_vec(shape, values).expect("one value for every place"))
}

/// The largest stable `c Δt/h ≤ max_step` on the (h, α) plane, `[ratio, factor]`, looked at on a grid of phases: a map, not a proof —
/// [`Step::stable_set`](crate::scheme::Step::stable_set) proves single points of it. The damping of `method` is multiplied by each factor.
///
/// # Errors
/// When a ratio is out of range, the integrator does not serve, or when the callback cancels.
pub fn stable_step_map(
    method: &LatticeMethod,
    integrator: &Integrator,
    ratios: &[Rational],
    factors: &[f64],
    max_step: f64,
    progress: Progress<'_>,
) -> Result<Array2<f64>, SweepError> {
    let [free, damped] = [false, true].map(|damped| SampledStep::new(integrator, damped));
    let (free, damped) = (free?, damped?);
    let values = fill_rows(ratios, factors.len(), progress, |ratio, target| {
        let waves = method.at_ratio(ratio)?.waves()?;
        let (compiled, undamped) = (waves.compile(), waves.damping().is_zero());
        for (value, &factor) in target.iter_mut().zip(factors) {
            let sampled = if factor == 0.0 || undamped { &free } else { &damped };
            let waves = compiled.clone().with_damping_scaled(factor);
            *value = sampled.limit(&waves, to_f64(ratio), max_step).lower();
        }
        Ok(())
    })?;
    Ok(plane(ratios.len(), factors.len(), values))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use crate::kernel::Kernel;
    use crate::scheme::catalogue;
    use crate::stability::SearchPlan;
    use crate::waves::sweep::no_progress;
    use std::ops::ControlFlow;
    use std::sync::atomic::{AtomicUsize, Ordering};

    fn viscous() -> LatticeMethod {
        let method = catalogue::method("sph-av").unwrap();
        LatticeMethod::new(method, Kernel::CubicSpline, &ratio(6, 5)).unwrap()
    }

    fn integrator(name: &str) -> &'static Integrator {
        Integrator::named(name).unwrap()
    }

    fn phases(count: usize) -> Vec<f64> {
        (1..=count).map(|index| index as f64 * std::f64::consts::PI / count as f64).collect()
    }

    #[test]
    fn the_bits_do_not_depend_on_the_number_of_threads() {
        let (scheme, phases) = (viscous(), phases(50));
        let ratios = even_axis(&integer(1), &ratio(3, 2), 11);
        let factors = [0.0, 0.5, 1.0, 4.0];
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("a small pool starts").install(|| {
                let box_of = |quantity| {
                    over_phase_ratio_and_viscosity(
                        &scheme,
                        &phases,
                        &ratios,
                        &factors,
                        quantity,
                        &no_progress,
                    )
                };
                let map = stable_step_map(
                    &scheme,
                    integrator("rk4"),
                    &ratios,
                    &factors,
                    4.0,
                    &no_progress,
                );
                let bits = |v: &f64| v.to_bits();
                let speed: Vec<u64> = box_of(Quantity::Speed).unwrap().iter().map(bits).collect();
                (speed, map.unwrap().iter().map(bits).collect::<Vec<_>>())
            })
        };
        assert_eq!(run(1), run(3));
    }

    #[test]
    fn the_box_contains_the_planes() {
        let (scheme, phases) = (viscous(), phases(20));
        let ratios = even_axis(&integer(1), &ratio(3, 2), 6);
        let factors = [0.0, 1.0, 3.0];
        let quantity = Quantity::PhaseError;
        let all = over_phase_ratio_and_viscosity(
            &scheme,
            &phases,
            &ratios,
            &factors,
            quantity,
            &no_progress,
        )
        .unwrap();
        let by_ratio =
            over_phase_and_ratio(&scheme, &phases, &ratios, quantity, &no_progress).unwrap();
        let at_6_5 =
            over_phase_and_viscosity(&scheme, &phases, &factors, quantity, &no_progress).unwrap();
        assert_eq!(ratios[2], ratio(6, 5));
        assert_eq!(all.index_axis(ndarray::Axis(1), 1), by_ratio);
        assert_eq!(all.index_axis(ndarray::Axis(0), 2), at_6_5);
        // And a single value straight from the relation.
        let mode = scheme.waves().unwrap().compile().mode(phases[7]);
        assert_eq!(at_6_5[[1, 7]], quantity.of(&mode));
        let ratio = Quantity::DampingRatio;
        let damping = over_phase_and_viscosity(&scheme, &phases, &factors, ratio, &no_progress);
        for ((row, column), value) in damping.unwrap().indexed_iter() {
            let still = at_6_5[[row, column]] == -1.0;
            assert_eq!(*value >= 1.0, still, "over-damped waves do not travel");
        }
    }

    #[test]
    fn a_callback_hears_of_every_row_and_ends_the_sweep() {
        let (scheme, phases) = (viscous(), phases(4));
        let heard = AtomicUsize::new(0);
        let count = |_: usize, total: usize| {
            assert_eq!(total, 9);
            heard.fetch_add(1, Ordering::Relaxed);
            ControlFlow::Continue(())
        };
        let factors: Vec<f64> = (1..10).map(f64::from).collect();
        let speed = Quantity::Speed;
        let map = over_phase_and_viscosity(&scheme, &phases, &factors, speed, &count).unwrap();
        assert_eq!((heard.into_inner(), map.dim()), (9, (9, 4)));
        let stop = |_: usize, _: usize| ControlFlow::Break(());
        let stopped = over_phase_and_viscosity(&scheme, &phases, &factors, speed, &stop);
        assert_eq!(stopped.unwrap_err(), SweepError::Cancelled);
        let bad =
            over_phase_and_ratio(&scheme, &phases, &[integer(0)], Quantity::Speed, &no_progress);
        assert!(matches!(bad, Err(SweepError::Ratio(_))));
    }

    #[test]
    fn the_map_lies_on_the_proved_limits() {
        let ratios = even_axis(&integer(1), &integer(2), 3);
        for name in ["leapfrog-kdk", "rk2-heun", "rk3-ssp", "ab3"] {
            let stepped = integrator(name);
            let map = stable_step_map(&viscous(), stepped, &ratios, &[0.0, 1.0], 4.0, &no_progress);
            for ((row, column), value) in map.unwrap().indexed_iter() {
                let method = viscous().at_ratio(&ratios[row]).unwrap();
                let method = method.with("alpha", &integer(column as i64));
                let plan = SearchPlan::default().up_to(integer(4));
                let proved = method.step(stepped).unwrap().stable_set("C", &plan).unwrap().limit();
                // Never below, and above by what a grid of 64 phases or more may miss of a maximum.
                let (low, high) = (proved.lower(), proved.upper());
                assert!(
                    *value >= low * (1.0 - 1e-12) && *value <= high * 1.002 + 1e-12,
                    "{name} {row} {column}: {value} against {low} to {high}"
                );
            }
        }
    }
}
