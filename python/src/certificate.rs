//! Certificates as the text of their file.

use crate::error::bad;
use crate::exact::number;
use crate::subject::NativeSubject;
use crate::watch::watched;
use courant_reports::certificate_file::{certificates, parse, to_text, verify_all};
use pyo3::prelude::*;
use std::path::Path;

/// The text of a file of certificates for every limit of a scheme.
#[pyfunction]
pub fn certify(
    py: Python<'_>,
    subject: &NativeSubject,
    max: Option<&str>,
    growth: Vec<String>,
    budget: Option<usize>,
) -> PyResult<String> {
    let (sought, plan) = (subject.sought(false)?, subject.plan(max, None, budget)?);
    let budgets: Vec<_> =
        growth.iter().map(|text| number("growth", text)).collect::<PyResult<_>>()?;
    let found =
        watched(py, None, |watch| certificates(&subject.0, &sought, &watch.plan(plan), &budgets))?;
    to_text(&found.map_err(bad)?).map_err(bad)
}

/// What the certificates of a text prove: the theorems, and how many boxes were recomputed.
#[pyfunction]
pub fn verify(py: Python<'_>, text: &str) -> PyResult<(Vec<String>, usize)> {
    let name = Path::new("certificate");
    let found = py.detach(|| verify_all(name, &parse(name, text)?));
    let found = found.map_err(bad)?;
    let boxes = found.iter().map(|one| one.boxes).sum();
    Ok((found.into_iter().map(|one| one.statement).collect(), boxes))
}
