//! Sweeps over the (smoothing ratio, Courant number) plane, in parallel over the ratios.

use crate::exact::rational::Rational;
use crate::kernel::lattice::RatioOutOfRange;
use crate::scheme::SchemeError;
use crate::stability::margin::Margin;
use crate::waves::growth::PhaseTable;
use ndarray::{Array2, Axis, Zip};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Called after every finished row with the number of rows done and the number of all; it may stop the
/// sweep. It is called from several threads.
pub type Progress<'a> = &'a (dyn Fn(usize, usize) -> ControlFlow<()> + Sync);

/// A [`Progress`] that does not care.
pub fn no_progress(_done: usize, _all: usize) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Why a sweep has no result.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SweepError {
    /// The progress callback asked to stop.
    #[error("the sweep was cancelled")]
    Cancelled,
    /// A ratio of the axis is out of range.
    #[error(transparent)]
    Ratio(#[from] RatioOutOfRange),
    /// The scheme does not serve.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
}

/// The results of `work` on all items, in parallel and in their order; the callback hears of each.
///
/// # Errors
/// The error of an item, or that the callback stopped the work.
pub fn with_progress<Item, T: Send>(
    items: impl IndexedParallelIterator<Item = Item>,
    progress: Progress<'_>,
    work: impl Fn(Item) -> Result<T, SweepError> + Sync + Send,
) -> Result<Vec<T>, SweepError> {
    let (all, done) = (items.len(), AtomicUsize::new(0));
    items
        .map(|item| {
            let result = work(item)?;
            match progress(done.fetch_add(1, Ordering::Relaxed) + 1, all) {
                ControlFlow::Continue(()) => Ok(result),
                ControlFlow::Break(()) => Err(SweepError::Cancelled),
            }
        })
        .collect()
}

/// The extreme amplification factors over the plane; every array is `[ratio, Courant number]`.
#[derive(Debug, Clone, PartialEq)]
pub struct GainMap {
    /// `max_φ |g| − 1`.
    pub growth: Array2<f64>,
    /// Where it is taken, in radians.
    pub growth_phase: Array2<f64>,
    /// `min_φ |g|`: what is left of the most damped wave.
    pub lowest_gain: Array2<f64>,
    /// Where it is taken, in radians.
    pub lowest_gain_phase: Array2<f64>,
}

/// For every ratio, with the margin `1 − |g|²` of the scheme there, and every Courant number the largest and the smallest `|g|` over all phases, on at least
/// `phases` samples with refinement in between (to 1e-10 of the true extremum).
///
/// The result does not depend on the number of threads.
///
/// # Errors
/// The error of a margin, or that the callback stopped the sweep.
pub fn gain_map(
    margin: impl Fn(&Rational) -> Result<Margin, SchemeError> + Sync + Send,
    ratios: &[Rational],
    courant_numbers: &[f64],
    phases: usize,
    progress: Progress<'_>,
) -> Result<GainMap, SweepError> {
    let shape = (ratios.len(), courant_numbers.len());
    let mut map = GainMap {
        growth: Array2::zeros(shape),
        growth_phase: Array2::zeros(shape),
        lowest_gain: Array2::zeros(shape),
        lowest_gain_phase: Array2::zeros(shape),
    };
    let rows = with_progress(ratios.par_iter(), progress, |ratio| {
        let table = PhaseTable::new(margin(ratio)?.compile(), phases);
        let mut scratch = Vec::new();
        let extrema = courant_numbers.iter().map(|&c| table.extrema(c, &mut scratch));
        Ok(extrema.collect::<Vec<_>>())
    })?;
    for (index, row) in rows.into_iter().enumerate() {
        Zip::from(map.growth.index_axis_mut(Axis(0), index))
            .and(map.growth_phase.index_axis_mut(Axis(0), index))
            .and(map.lowest_gain.index_axis_mut(Axis(0), index))
            .and(map.lowest_gain_phase.index_axis_mut(Axis(0), index))
            .and(&ndarray::Array1::from(row))
            .for_each(|growth, growth_phase, lowest, lowest_phase, (largest, smallest)| {
                *growth = largest.growth;
                *growth_phase = largest.phase;
                *lowest = 1.0 + smallest.growth;
                *lowest_phase = smallest.phase;
            });
    }
    Ok(map)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{integer, ratio};
    use crate::kernel::Kernel;
    use crate::scheme::testing::sph;

    fn margin(
        scheme: &'static str,
        kernel: Kernel,
    ) -> impl Fn(&Rational) -> Result<Margin, SchemeError> + Sync + Send {
        move |ratio| Ok(sph(scheme, kernel, ratio).gain_margin("C", &integer(0))?.unwrap())
    }

    fn axes() -> (Vec<Rational>, Vec<f64>) {
        let ratios = (10..40).map(|i| ratio(i, 10)).collect();
        let courant_numbers = (0..40).map(|i| f64::from(i) * 0.15).collect();
        (ratios, courant_numbers)
    }

    #[test]
    fn the_bits_do_not_depend_on_the_number_of_threads() {
        let (ratios, courant_numbers) = axes();
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let godunov = margin("godunov-sph", Kernel::Gaussian);
                gain_map(godunov, &ratios, &courant_numbers, 200, &no_progress).unwrap()
            })
        };
        assert_eq!(run(1), run(3));
    }

    #[test]
    fn a_sweep_can_be_cancelled_and_reports_every_row() {
        let (ratios, courant_numbers) = axes();
        let sweep = |progress: Progress<'_>| {
            let lax_wendroff = margin("lax-wendroff-sph", Kernel::CubicSpline);
            gain_map(lax_wendroff, &ratios, &courant_numbers, 100, progress)
        };
        let rows = AtomicUsize::new(0);
        let count = |_: usize, all: usize| {
            assert_eq!(all, 30);
            rows.fetch_add(1, Ordering::Relaxed);
            ControlFlow::Continue(())
        };
        assert!(sweep(&count).is_ok());
        assert_eq!(rows.into_inner(), 30);
        assert_eq!(sweep(&|_, _| ControlFlow::Break(())), Err(SweepError::Cancelled));
    }

    #[test]
    fn rows_and_columns_are_where_they_belong() {
        let map = gain_map(
            margin("godunov-sph", Kernel::CubicSpline),
            &[ratio(1, 1), ratio(2, 1)],
            &[0.5, 1.0, 2.0],
            100,
            &no_progress,
        )
        .unwrap();
        // Ratio 1 is the upwind scheme: |g| ≤ 1 up to C = 1, and |1 − 2C| at the shortest wave.
        assert_eq!(map.growth[[0, 1]], 0.0);
        assert!((map.growth[[0, 2]] - 2.0).abs() < 1e-14);
        assert!((map.lowest_gain[[0, 0]]).abs() < 1e-7);
        assert!(map.growth[[1, 2]] > 0.0 && map.growth[[1, 1]] == 0.0);
    }
}
