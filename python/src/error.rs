//! What is wrong, as `ValueError` with its place in the text.

use courant_analysis::scheme::SchemeError;
use courant_analysis::scheme::catalogue::SchemeFileError;
use courant_analysis::scheme::language::LanguageError;
use courant_analysis::waves::sweep::SweepError;
use courant_reports::subject::SubjectError;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

/// A `ValueError` in one line.
pub fn bad(message: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(message.to_string())
}

/// `courant_stability.TextError`: it shows the line of the text with a caret below.
pub fn of_text(error: &LanguageError) -> PyErr {
    let raise = |py: Python<'_>| -> PyResult<PyErr> {
        let class = py.import("courant_stability.errors")?.getattr("TextError")?;
        let place = (&error.message, &error.text, error.span.start, error.span.end);
        Ok(PyErr::from_value(class.call_method1("at_bytes", place)?))
    };
    Python::attach(|py| raise(py).unwrap_or_else(|failure| failure))
}

/// What a scheme complains of.
pub fn of_scheme(error: &SchemeError) -> PyErr {
    match error {
        SchemeError::Text(error) => of_text(error),
        other => bad(other),
    }
}

/// What a file complains of.
pub fn of_file(error: &SchemeFileError) -> PyErr {
    match error {
        SchemeFileError::Equations(error) => of_text(error),
        other => bad(other),
    }
}

/// What a subject complains of.
pub fn of_subject(error: &SubjectError) -> PyErr {
    match error.problem() {
        Some(SchemeError::Text(error)) => of_text(error),
        _ => bad(error),
    }
}

/// Why a sweep ended early.
pub fn of_sweep(error: &SweepError) -> PyErr {
    match error {
        SweepError::Cancelled => PyKeyboardInterrupt::new_err(()),
        SweepError::Ratio(error) => bad(format!("ratio: {error}")),
        SweepError::Scheme(error) => of_scheme(error),
    }
}
