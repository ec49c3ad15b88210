//! One question about one scheme.

use crate::error::{bad, of_subject};
use crate::exact::{SetAnswer, json, number};
use crate::subject::NativeSubject;
use crate::watch::watched;
use courant_analysis::scheme::SchemeError;
use courant_analysis::stability::{PointVerdict, decide_step_at, verdict};
use courant_reports::record::CheckRecord;
use num_traits::Signed;
use pyo3::prelude::*;
use serde::Serialize;

/// The stable values of the parameter in question, as JSON.
#[pyfunction]
pub fn stable_set(
    py: Python<'_>,
    subject: &NativeSubject,
    max: Option<&str>,
    growth: Option<&str>,
    budget: Option<usize>,
) -> PyResult<String> {
    let (sought, plan) = (subject.sought(false)?, subject.plan(max, growth, budget)?);
    let symbol = subject.0.symbol(&sought.parameter);
    let found =
        watched(py, None, |watch| sought.step.stable_set(&sought.parameter, &watch.plan(plan)))?;
    json(&SetAnswer::new(&found.map_err(|error| subject.failed(error))?, &symbol))
}

/// Where all coefficients are positive, as JSON; why that is not asked, where it is not.
#[pyfunction]
pub fn monotone_set(
    py: Python<'_>,
    subject: &NativeSubject,
    max: Option<&str>,
    budget: Option<usize>,
) -> PyResult<String> {
    let (sought, plan) = (subject.sought(false)?, subject.plan(max, None, budget)?);
    let symbol = subject.0.symbol(&sought.parameter);
    let found =
        watched(py, None, |watch| sought.step.monotone_set(&sought.parameter, &watch.plan(plan)))?;
    match found.map_err(|error| subject.failed(error))? {
        Some(set) => json(&SetAnswer::new(&set, &symbol)),
        None => Err(bad(subject.0.without_monotonicity())),
    }
}

#[derive(Serialize)]
struct CheckAnswer {
    record: CheckRecord,
    stable_set: SetAnswer,
    monotone_set: Option<SetAnswer>,
}

/// The verdict on the value that the parameter in question has, as JSON.
#[pyfunction]
pub fn check(
    py: Python<'_>,
    subject: &NativeSubject,
    max: Option<&str>,
    growth: Option<&str>,
    budget: Option<usize>,
) -> PyResult<String> {
    let (sought, plan) = (subject.sought(true)?, subject.plan(max, None, budget)?);
    let name = &sought.parameter;
    let value = match &sought.value {
        None => return Err(bad(format!("the value of {name} to be judged is missing"))),
        Some(value) if value.is_negative() => {
            return Err(bad(format!("{name} = {value}: it must not be negative")));
        }
        Some(value) => value,
    };
    let budget = growth.map(|text| number("growth", text)).transpose()?;
    let answer = watched(py, None, |watch| -> Result<_, SchemeError> {
        let found = verdict::check(&sought.step, name, value, &watch.plan(plan))?;
        let within = match &budget {
            None => None,
            Some(growth) => Some(match decide_step_at(&sought.step.with(name, value)?, growth)? {
                PointVerdict::Stable => Some(true),
                PointVerdict::Unstable(_) => Some(false),
                PointVerdict::Undecided => None,
            }),
        };
        Ok((found, within))
    })?;
    let (found, within) = answer.map_err(|error| match error {
        error @ SchemeError::Singular { .. } => bad(error),
        error => of_subject(&subject.0.failure(error)),
    })?;
    let symbol = subject.0.symbol(name);
    json(&CheckAnswer {
        record: CheckRecord::new(&subject.0, &sought, value, &found, within),
        stable_set: SetAnswer::new(&found.stable_set, &symbol),
        monotone_set: found.monotone_set.as_ref().map(|set| SetAnswer::new(set, &symbol)),
    })
}
