//! Characteristic polynomial, order, modified equation.

use crate::error::of_subject;
use crate::exact::json;
use crate::subject::NativeSubject;
use crate::watch::watched;
use courant_reports::record::SymbolRecord;
use courant_reports::symbol::Symbol;
use pyo3::prelude::*;
use serde::Serialize;

#[derive(Serialize)]
struct SymbolAnswer {
    record: SymbolRecord,
    /// The modified equation.
    text: Option<String>,
    latex: Option<String>,
    /// The order in a sentence.
    order: Option<String>,
}

/// What `courant symbol` says, with the modified equation as text, as JSON.
#[pyfunction]
pub fn symbol(py: Python<'_>, subject: &NativeSubject, terms: Option<usize>) -> PyResult<String> {
    let found = watched(py, None, |_| Symbol::new(subject.0.clone(), terms))?;
    let found = found.map_err(|error| of_subject(&error))?;
    let order = found.order.as_ref().ok();
    let equation = order.and_then(|order| Some((&order.series, order.terms.as_ref()?)));
    json(&SymbolAnswer {
        record: found.record(false),
        text: equation.map(|(series, terms)| series.equation_text(terms)),
        latex: equation.map(|(series, terms)| series.equation_latex(terms)),
        order: order.map(|order| order.text()),
    })
}
