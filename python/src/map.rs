//! Planes of a parameter, or of the smoothing ratio, and another parameter.

use crate::error::{bad, of_subject, of_sweep};
use crate::subject::NativeSubject;
use crate::sweep::{Column, RATIO, arrays, stopped};
use crate::watch::watched;
use courant_analysis::exact::rational::Rational;
use courant_analysis::scheme::Step;
use courant_analysis::stability::{Limit, SearchPlan};
use courant_analysis::waves::sweep::{GainMap, SweepError, with_progress};
use courant_reports::subject::{Subject, SubjectError};
use ndarray::Array2;
use num_traits::Signed;
use numpy::{IntoPyArray, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

/// Rows of a plane: the step for each value of the first axis, with the parameter of the second open.
struct Plane<'a> {
    subject: &'a Subject,
    x: &'a str,
    y: &'a str,
    open: Option<Step>,
}

impl<'a> Plane<'a> {
    fn new(subject: &'a Subject, x: &'a str, y: &'a str) -> Result<Self, SubjectError> {
        let open = match (&subject.kernel, x) {
            (Some(_), RATIO) => None,
            _ => Some(subject.plane([x, y])?),
        };
        Ok(Self { subject, x, y, open })
    }

    fn step(&self, value: &Rational) -> Result<Step, SweepError> {
        if let Some(open) = &self.open {
            return Ok(open.with(self.x, value)?);
        }
        let mut subject = self.subject.clone();
        subject.kernel = subject.kernel.map(|(kernel, _)| (kernel, value.clone()));
        subject.parameter = Some(self.y.into());
        Ok(subject.sought(false).map_err(stopped)?.step)
    }
}

/// The largest and the smallest gain over all waves, `[x, y]`, with the phases where they are taken in one dimension.
#[pyfunction]
pub fn gains<'py>(
    py: Python<'py>,
    subject: &NativeSubject,
    x: &str,
    xs: Column<'py>,
    y: &str,
    ys: PyReadonlyArray1<'py, f64>,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let plane = Plane::new(&subject.0, x, y).map_err(|error| of_subject(&error))?;
    let xs = xs.exact(x)?;
    let ys = ys.as_array().to_vec();
    if let Some(value) = ys.iter().find(|value| !value.is_finite()) {
        return Err(bad(format!("{y}: {value} is no finite number")));
    }
    let found = watched(py, report, |watch| -> Result<_, SweepError> {
        let mut map = GainMap::new(xs.len(), ys.len());
        let items = xs.par_iter().zip(map.rows_mut());
        with_progress(items, watch.progress, |(value, mut row)| {
            row.set(&plane.step(value)?.gain_extremes(y, &ys)?);
            Ok(())
        })?;
        map.growth += 1.0;
        Ok(map)
    })?;
    let found = found.map_err(|error| of_sweep(&error))?;
    let answer = PyDict::new(py);
    answer.set_item("largest", found.growth.into_pyarray(py))?;
    answer.set_item("lowest", found.lowest_gain.into_pyarray(py))?;
    answer.set_item("largest_phase", found.growth_phase.into_pyarray(py))?;
    answer.set_item("lowest_phase", found.lowest_gain_phase.into_pyarray(py))?;
    Ok(answer)
}

/// The limits of the second axis for each value of the first, and which of its values are stable, `[x, y]`: decided, not read off gains.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keyword arguments")]
pub fn stable<'py>(
    py: Python<'py>,
    subject: &NativeSubject,
    x: &str,
    xs: Column<'py>,
    y: &str,
    ys: Column<'py>,
    max: &str,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let plane = Plane::new(&subject.0, x, y).map_err(|error| of_subject(&error))?;
    let (xs, ys) = (xs.exact(x)?, ys.exact(y)?);
    let max = crate::exact::number(y, max)?;
    let plan = SearchPlan::default();
    let plan = if max.is_positive() { plan.up_to(max) } else { plan };
    let dimension = subject.0.open_step().map_err(|error| of_subject(&error))?.dimension();
    let rows = watched(py, report, |watch| {
        let plan = watch.plan(plan);
        with_progress(xs.par_iter(), watch.progress, |value| {
            let set = plane.step(value)?.stable_set(y, &plan)?;
            let inside = ys.iter().map(|value| set.contains(value)).collect();
            Ok((set.limit(), inside))
        })
    })?;
    let rows = rows.map_err(|error| of_sweep(&error))?;
    let (limits, inside): (Vec<Limit>, Vec<Vec<bool>>) = rows.into_iter().unzip();
    let answer = arrays(py, &limits, dimension)?;
    let inside = Array2::from_shape_vec((xs.len(), ys.len()), inside.concat()).map_err(bad)?;
    answer.set_item("stable", inside.into_pyarray(py))?;
    Ok(answer)
}
