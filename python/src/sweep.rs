//! Limits over many values of parameters.

use crate::error::{bad, of_subject, of_sweep};
use crate::exact::{LimitAnswer, decimal, json, number};
use crate::subject::NativeSubject;
use crate::watch::watched;
use courant_analysis::exact::rational::Rational;
use courant_analysis::scheme::{SchemeError, Step};
use courant_analysis::stability::{Cause, Evidence, Limit, SearchPlan};
use courant_analysis::waves::sweep::{SweepError, with_progress};
use courant_reports::subject::{Subject, SubjectError};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

/// What stands behind a limit, by its number in arrays.
pub const EVIDENCE: [&str; 5] = ["proved", "enclosed", "sampled", "measured", "undecided"];

/// Which wave sets a limit, by its number in arrays; −1 is none.
pub const CAUSES: [&str; 3] = ["long-wave", "interior", "shortest-wave"];

fn evidence(evidence: Evidence) -> i8 {
    place(&EVIDENCE, evidence.name())
}

fn cause(cause: Option<Cause>) -> i8 {
    cause.map_or(-1, |cause| place(&CAUSES, cause.name()))
}

fn place(all: &[&str], name: &str) -> i8 {
    all.iter().position(|one| *one == name).map_or(-1, |place| place as i8)
}

/// The values of a parameter, one for each point.
#[derive(FromPyObject)]
pub enum Column<'py> {
    /// Each stands for its shortest decimal.
    Floats(PyReadonlyArray1<'py, f64>),
    /// Exact.
    Texts(Vec<String>),
}

impl Column<'_> {
    pub fn exact(&self, name: &str) -> PyResult<Vec<Rational>> {
        match self {
            Self::Floats(array) => {
                array.as_array().iter().map(|value| decimal(name, *value)).collect()
            }
            Self::Texts(texts) => texts.iter().map(|text| number(name, text)).collect(),
        }
    }
}

/// The name of the axis that is no parameter.
pub const RATIO: &str = "ratio";

/// A subject, prepared for many values of some of its parameters.
pub struct Family<'a> {
    subject: &'a Subject,
    names: &'a [String],
    /// With those parameters and the sought one open; nothing where the kernel's lattice is another at each point.
    open: Option<Step>,
    /// The sought one.
    pub parameter: String,
    pub dimension: usize,
}

impl<'a> Family<'a> {
    /// At any of the points, whose values are given in the order of the names.
    pub fn new(
        subject: &'a Subject,
        names: &'a [String],
        first: &[Rational],
    ) -> Result<Self, SubjectError> {
        let sought = at(subject, names, first).sought(false)?;
        let varies = names.iter().any(|name| name == RATIO) && subject.kernel.is_some();
        let mut but: Vec<&str> = names.iter().map(String::as_str).collect();
        but.push(&sought.parameter);
        let open = (!varies).then(|| subject.opened(&but)).transpose()?;
        let dimension = sought.step.dimension();
        Ok(Self { subject, names, open, parameter: sought.parameter, dimension })
    }

    /// The step at a point.
    pub fn step(&self, values: &[Rational]) -> Result<Step, SubjectError> {
        let Some(open) = &self.open else {
            return Ok(at(self.subject, self.names, values).sought(false)?.step);
        };
        let mut step = open.clone();
        for (name, value) in self.names.iter().zip(values) {
            step = step.with(name, value).map_err(|problem| SubjectError::Value {
                name: name.clone(),
                value: value.clone(),
                problem: Box::new(problem),
            })?;
        }
        Ok(step)
    }
}

/// A subject with values for some names more, the ratio among them.
fn at(subject: &Subject, names: &[String], values: &[Rational]) -> Subject {
    let mut subject = subject.clone();
    for (name, value) in names.iter().zip(values) {
        match &mut subject.kernel {
            Some((_, ratio)) if name == RATIO => *ratio = value.clone(),
            _ => {
                subject.values.retain(|(known, _)| known != name);
                subject.values.push((name.clone(), value.clone()));
            }
        }
    }
    subject
}

/// What went wrong at a point, as what stops a sweep.
pub fn stopped(error: SubjectError) -> SweepError {
    match error {
        SubjectError::Ratio(error) => SweepError::Ratio(error),
        other => match other.problem() {
            Some(problem) => problem.clone().into(),
            None => SchemeError::Integrator(other.to_string()).into(),
        },
    }
}

/// The limits of the parameter in question at many points, as arrays; with everything about each as JSON where that is asked for.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keyword arguments")]
pub fn limits<'py>(
    py: Python<'py>,
    subject: &NativeSubject,
    names: Vec<String>,
    columns: Vec<Column<'py>>,
    max: Option<&str>,
    growth: Option<&str>,
    budget: Option<usize>,
    records: bool,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let columns: Vec<Vec<Rational>> = names
        .iter()
        .zip(&columns)
        .map(|(name, column)| column.exact(name))
        .collect::<PyResult<_>>()?;
    let count = columns.first().map_or(1, Vec::len);
    if columns.iter().any(|column| column.len() != count) {
        return Err(bad("columns are not equally long"));
    }
    let point = |index: usize| -> Vec<Rational> {
        columns.iter().map(|column| column[index].clone()).collect()
    };
    if count == 0 {
        return Err(bad("there is no point"));
    }
    let family = Family::new(&subject.0, &names, &point(0)).map_err(|error| of_subject(&error))?;
    let plan = subject.plan(max, growth, budget)?;
    let ratio = names.iter().position(|name| name == RATIO).filter(|_| max.is_none());
    let limits = watched(py, report, |watch| {
        let plan = watch.plan(plan);
        with_progress((0..count).into_par_iter(), watch.progress, |index| {
            let values = point(index);
            let step = family.step(&values).map_err(stopped)?;
            // The range of schemes with kernels grows with the ratio.
            let plan = match ratio {
                Some(_) => plan_at(&subject.0, &names, &values, &plan),
                None => plan.clone(),
            };
            Ok(step.stable_set(&family.parameter, &plan)?.limit())
        })
    })?;
    let limits = limits.map_err(|error| of_sweep(&error))?;
    let answer = arrays(py, &limits, family.dimension)?;
    answer.set_item("parameter", &family.parameter)?;
    if records {
        let symbol = subject.0.symbol(&family.parameter);
        let answers: Vec<_> = limits.iter().map(|limit| LimitAnswer::new(limit, &symbol)).collect();
        answer.set_item("records", json(&answers)?)?;
    }
    Ok(answer)
}

fn plan_at(
    subject: &Subject,
    names: &[String],
    values: &[Rational],
    plan: &SearchPlan,
) -> SearchPlan {
    plan.clone().up_to(at(subject, names, values).range(None))
}

/// Limits as arrays: `value`, `lower`, `upper`, `phase` by axis, `evidence`, `cause`, `included`, `unbounded`.
pub fn arrays<'py>(
    py: Python<'py>,
    limits: &[Limit],
    dimension: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let answer = PyDict::new(py);
    let floats = |of: &dyn Fn(&Limit) -> f64| {
        PyArray1::from_vec(py, limits.iter().map(of).collect::<Vec<f64>>())
    };
    answer.set_item("value", floats(&Limit::value))?;
    answer.set_item("lower", floats(&|limit| limit.lower() + 0.0))?;
    answer.set_item("upper", floats(&Limit::upper))?;
    let phases = |limit: &Limit| {
        let wave = limit.critical_wave();
        wave.map_or_else(|| vec![f64::NAN; dimension], |wave| wave.phases().to_vec())
    };
    let phases = PyArray1::from_vec(py, limits.iter().flat_map(phases).collect::<Vec<f64>>());
    let phases: Bound<'py, PyArray2<f64>> = phases.reshape([limits.len(), dimension])?;
    answer.set_item("phase", phases)?;
    let codes = |of: &dyn Fn(&Limit) -> i8| {
        PyArray1::from_vec(py, limits.iter().map(of).collect::<Vec<i8>>())
    };
    answer.set_item("evidence", codes(&|limit| evidence(limit.evidence())))?;
    answer.set_item("cause", codes(&|limit| cause(limit.cause())))?;
    let flags = |of: &dyn Fn(&Limit) -> bool| {
        PyArray1::from_vec(py, limits.iter().map(of).collect::<Vec<bool>>())
    };
    let is_open = |limit: &Limit| limit.value().is_infinite();
    answer.set_item("included", flags(&|limit| limit.is_included() && !is_open(limit)))?;
    answer.set_item(
        "unbounded",
        flags(&|limit| is_open(limit) && limit.evidence() != Evidence::Undecided),
    )?;
    Ok(answer)
}
