//! A step that is only known by calling it.

use crate::error::{bad, of_scheme};
use crate::exact::{SetAnswer, json, number};
use crate::watch::watched;
use courant_analysis::exact::rational::{Rational, to_f64, to_text};
use courant_analysis::scheme::measurement::{
    Base, Experiment, MOST_VALUES, Objection, Probe, Probed, StateLayout,
};
use courant_analysis::stability::{SearchPlan, StableSet, judge};
use courant_reports::record::{JudgementRecord, ProbeRecord};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use std::sync::mpsc::{Sender, channel};

/// What was found of a step.
#[pyclass(frozen, name = "Probe", module = "courant_stability._native")]
pub struct NativeProbe {
    record: ProbeRecord,
    found: Probed,
}

/// A state that waits for its step: the value of the parameter, the state, and where the new level goes; nothing where the step failed.
type Ask = (f64, Vec<f64>, Sender<Option<Vec<f64>>>);

/// Measures `step(value, state)`, which is only called from this thread, one state after another.
fn measure(
    py: Python<'_>,
    probe: &Probe,
    step: &Py<PyAny>,
    report: Option<&Py<PyAny>>,
    plan: SearchPlan,
) -> PyResult<Probed> {
    let (ask, asked) = channel::<Ask>();
    let mut raised: Option<PyErr> = None;
    let (mut done, all) = (0, probe.runs());
    let mut call = |py: Python<'_>, value: f64, state: Vec<f64>| -> PyResult<Vec<f64>> {
        py.check_signals()?;
        let answer = step.call1(py, (value, PyArray1::from_vec(py, state)))?;
        let answer: PyReadonlyArray1<'_, f64> = answer.extract(py)?;
        done += 1;
        if let Some(report) = report {
            report.call1(py, (done, all))?;
        }
        Ok(answer.as_array().to_vec())
    };
    let found = py.detach(|| {
        std::thread::scope(|scope| {
            let worker = scope.spawn(move || {
                probe.measure(|value, state| {
                    let (reply, answer) = channel();
                    let waits = ask.send((to_f64(value), state.to_vec(), reply)).is_ok();
                    let answer = if waits { answer.recv().ok().flatten() } else { None };
                    answer.ok_or("the step failed")
                })
            });
            for (value, state, reply) in asked {
                let answer = match raised {
                    // The first failure is told; what is asked after it is not run.
                    Some(_) => None,
                    None => Python::attach(|py| call(py, value, state))
                        .map_err(|error| raised = Some(error))
                        .ok(),
                };
                // A worker that does not wait has ended already.
                let _ = reply.send(answer);
            }
            worker.join()
        })
    });
    if let Some(error) = raised {
        return Err(error);
    }
    let stencils = match found {
        Ok(found) => found.map_err(|refused| {
            let place = match (&probe.sought, &refused.value) {
                (Some(name), Some(value)) => format!("{name} = {}: ", to_text(value)),
                _ => String::new(),
            };
            let hint = match refused.objection {
                Objection::NotProportional { .. } => " (about=…)",
                _ => "",
            };
            bad(format!("{place}{}{hint}", refused.objection))
        })?,
        Err(panic) => std::panic::resume_unwind(panic),
    };
    watched(py, None, |watch| probe.analyse(stencils, &watch.plan(plan)))?.map_err(bad)
}

/// Exact values for a list of texts.
fn numbers(name: &str, texts: &[String]) -> PyResult<Vec<Rational>> {
    texts.iter().map(|text| number(name, text)).collect()
}

#[pymethods]
impl NativeProbe {
    #[new]
    #[expect(clippy::too_many_arguments, reason = "they are Python's keyword arguments")]
    fn new(
        py: Python<'_>,
        step: Py<PyAny>,
        unknowns: Vec<String>,
        size: Vec<usize>,
        levels: usize,
        parameter: Option<String>,
        fit: Vec<String>,
        judged: Vec<String>,
        about: Option<Vec<f64>>,
        tolerance: Option<f64>,
        max: &str,
        budget: Option<usize>,
        report: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let layout = StateLayout { levels, unknowns: unknowns.len(), size };
        if !(1..=3).contains(&layout.size.len()) || layout.size.iter().any(|size| *size < 4) {
            return Err(bad(format!(
                "size {:?}: one to three axes of at least 4 cells are accepted",
                layout.size
            )));
        }
        if unknowns.is_empty() || !(1..=8).contains(&levels) {
            return Err(bad("at least one unknown and 1 to 8 levels are accepted"));
        }
        if !layout.fits() {
            return Err(bad(format!("a state would have more than {MOST_VALUES} numbers")));
        }
        let base = match about {
            None => Base::Zero,
            Some(values) if values.len() == layout.values() => Base::About(values),
            Some(values) if [1, unknowns.len()].contains(&values.len()) => {
                Base::About(layout.uniform(&values))
            }
            Some(values) => {
                return Err(bad(format!(
                    "about: {} numbers; one, one an unknown, or a state is accepted",
                    values.len()
                )));
            }
        };
        let tolerance = tolerance.unwrap_or(base.usual_tolerance());
        let sought = parameter.as_deref().unwrap_or_default();
        let (fit, judged) = (numbers(sought, &fit)?, numbers(sought, &judged)?);
        let experiment = Experiment { layout, base, tolerance };
        let probe = Probe { experiment, unknowns, sought: parameter, fit, judged };
        let plan = SearchPlan::default().up_to(number("max", max)?);
        let plan = SearchPlan { budget: budget.unwrap_or(plan.budget), ..plan };
        let found = measure(py, &probe, &step, report.as_ref(), plan)?;
        Ok(Self { record: ProbeRecord::new(&probe, Ok(&found)), found })
    }

    /// What `courant probe` says, as JSON.
    fn record(&self) -> PyResult<String> {
        json(&self.record)
    }

    /// The verdict on a value of the parameter, as JSON.
    fn check(&self, py: Python<'_>, value: &str) -> PyResult<String> {
        let measured = &self.found.measured;
        let Some(name) = &measured.parameter else {
            return Err(bad("the step does not depend on the parameter"));
        };
        let value = number(name, value)?;
        let at = measured.step.with(name, &value).map_err(|error| of_scheme(&error))?;
        let found = watched(py, None, |_| judge(&at, &measured.growth))?;
        let found = found.map_err(|error| of_scheme(&error))?;
        json(&JudgementRecord::new(Some(&value), &found))
    }

    /// The stable values, as JSON; nothing where there is no parameter.
    fn stable_set(&self) -> PyResult<Option<String>> {
        self.set(self.found.stable_set.as_ref())
    }

    /// Where all coefficients are positive, as JSON.
    fn monotone_set(&self) -> PyResult<Option<String>> {
        self.set(self.found.monotone_set.as_ref())
    }
}

impl NativeProbe {
    fn set(&self, set: Option<&StableSet>) -> PyResult<Option<String>> {
        let symbol = self.found.measured.parameter.as_deref().unwrap_or_default();
        set.map(|set| json(&SetAnswer::new(set, symbol))).transpose()
    }
}
