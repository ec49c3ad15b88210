//! Sweeps over the plane of two parameters, or of the smoothing ratio and one, in parallel over rows.

use super::gain_extremes::GainExtremes;
use crate::kernel::lattice::RatioOutOfRange;
use crate::scheme::{SchemeError, Step};
use ndarray::Array2;
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
    Scheme(SchemeError),
}

impl From<SchemeError> for SweepError {
    fn from(error: SchemeError) -> Self {
        match error {
            SchemeError::Cancelled => Self::Cancelled,
            other => Self::Scheme(other),
        }
    }
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

/// The extreme amplification factors over a plane; every array is `[row, value]`.
#[derive(Debug, Clone, PartialEq)]
pub struct GainMap {
    /// `max_φ |z| − 1`.
    pub growth: Array2<f64>,
    /// Where it is taken, in radians.
    pub growth_phase: Array2<f64>,
    /// `min_φ |z|` of the largest multiplier: what is left of the most damped wave.
    pub lowest_gain: Array2<f64>,
    /// Where it is taken, in radians.
    pub lowest_gain_phase: Array2<f64>,
}

/// A row of a [`GainMap`].
#[derive(Debug)]
pub struct GainRow<'a>([&'a mut [f64]; 4]);

impl GainRow<'_> {
    /// Takes up what was found.
    ///
    /// # Panics
    /// When the lengths differ.
    pub fn set(&mut self, found: &GainExtremes) {
        let GainExtremes { growth, growth_phase, lowest_gain, lowest_gain_phase } = found;
        let found = [growth, growth_phase, lowest_gain, lowest_gain_phase];
        self.0.iter_mut().zip(found).for_each(|(row, values)| row.copy_from_slice(values));
    }
}

impl GainMap {
    /// Room for rows.
    pub fn new(rows: usize, columns: usize) -> Self {
        let zeros = || Array2::zeros((rows, columns));
        let [growth, growth_phase, lowest_gain, lowest_gain_phase] =
            [zeros(), zeros(), zeros(), zeros()];
        Self { growth, growth_phase, lowest_gain, lowest_gain_phase }
    }

    /// The rows in their order, each to be filled: kept elsewhere until all are there they would scatter the memory.
    pub fn rows_mut(&mut self) -> Vec<GainRow<'_>> {
        let columns = self.growth.ncols().max(1);
        let [first, second, third, fourth] = [
            &mut self.growth,
            &mut self.growth_phase,
            &mut self.lowest_gain,
            &mut self.lowest_gain_phase,
        ]
        .map(|array| {
            array.as_slice_mut().expect("new arrays are contiguous").chunks_exact_mut(columns)
        });
        let rows = first.zip(second).zip(third).zip(fourth);
        rows.map(|(((first, second), third), fourth)| GainRow([first, second, third, fourth]))
            .collect()
    }
}

/// For every row, with the step there, and every value of its parameter the [extreme gains](Step::gain_extremes) over all waves.
///
/// The result does not depend on the number of threads.
///
/// # Errors
/// The error of a step, or that the callback stopped the sweep.
pub fn gain_map<Row: Sync>(
    rows: &[Row],
    step: impl Fn(&Row) -> Result<Step, SchemeError> + Sync + Send,
    parameter: &str,
    values: &[f64],
    progress: Progress<'_>,
) -> Result<GainMap, SweepError> {
    let mut map = GainMap::new(rows.len(), values.len());
    let items = rows.par_iter().zip(map.rows_mut());
    with_progress(items, progress, |(row, mut gains)| {
        gains.set(&step(row)?.gain_extremes(parameter, values)?);
        Ok(())
    })?;
    Ok(map)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{Rational, ratio};
    use crate::kernel::Kernel;
    use crate::scheme::testing::sph;

    fn step(
        scheme: &'static str,
        kernel: Kernel,
    ) -> impl Fn(&Rational) -> Result<Step, SchemeError> + Sync + Send {
        move |ratio| Ok(sph(scheme, kernel, ratio))
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
                let godunov = step("godunov-sph", Kernel::Gaussian);
                gain_map(&ratios, godunov, "C", &courant_numbers, &no_progress).unwrap()
            })
        };
        assert_eq!(run(1), run(3));
    }

    #[test]
    fn a_sweep_can_be_cancelled_and_reports_every_row() {
        let (ratios, courant_numbers) = axes();
        let sweep = |progress: Progress<'_>| {
            let lax_wendroff = step("lax-wendroff-sph", Kernel::CubicSpline);
            gain_map(&ratios, lax_wendroff, "C", &courant_numbers, progress)
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
            &[ratio(1, 1), ratio(2, 1)],
            step("godunov-sph", Kernel::CubicSpline),
            "C",
            &[0.5, 1.0, 2.0],
            &no_progress,
        )
        .unwrap();
        // Ratio 1 is the upwind scheme: |g| ≤ 1 up to C = 1, and |1 − 2C| at the shortest wave.
        assert_eq!(map.growth[[0, 1]], 0.0);
        assert!((map.growth[[0, 2]] - 2.0).abs() < 1e-14);
        assert!((map.lowest_gain[[0, 0]]).abs() < 1e-13);
        assert!(map.growth[[1, 2]] > 0.0 && map.growth[[1, 1]] == 0.0);
    }
}
