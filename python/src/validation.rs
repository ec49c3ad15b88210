//! Multipliers against the equations stepped as they were typed.

use crate::error::{bad, of_subject, of_sweep};
use crate::exact::json;
use crate::subject::NativeSubject;
use crate::watch::watched;
use courant_analysis::exact::rational::to_f64;
use courant_reports::equation_validation::RunningSubject;
use courant_simulation::stepping::{Validation, ValidationPlan};
use pyo3::prelude::*;
use rayon::prelude::*;

/// One validation for each value, as JSON: about the limit where none is given.
#[pyfunction]
pub fn validate(
    py: Python<'_>,
    subject: &NativeSubject,
    values: Vec<f64>,
    cells: Option<Vec<usize>>,
    steps: Option<usize>,
) -> PyResult<String> {
    let found = watched(py, None, |watch| -> PyResult<Vec<(f64, Validation)>> {
        let running = RunningSubject::new(&subject.0).map_err(|error| of_subject(&error))?;
        let mut plan = ValidationPlan::in_dimension(running.sought.step.dimension());
        plan.points = cells.unwrap_or(plan.points);
        plan.steps = steps.unwrap_or(plan.steps);
        let mut values = values;
        values.extend(running.sought.value.as_ref().map(to_f64));
        if values.is_empty() {
            values = running
                .about_the_limit(watch.interest.clone())
                .map_err(|error| of_subject(&error))?;
        }
        let run = |value: f64| Ok((value, running.validate(value, &plan).map_err(bad)?));
        let runs = watch.over(values.into_par_iter(), run).map_err(|error| of_sweep(&error))?;
        runs.into_iter().collect()
    })??;
    json(&found)
}
