//! Why a question cannot be asked of a subject; no words of a command line, so that every surface can say which of its own are meant.

use super::Kind;
use courant_analysis::exact::rational::{Rational, to_text};
use courant_analysis::kernel::lattice::RatioOutOfRange;
use courant_analysis::scheme::SchemeError;
use thiserror::Error;

/// Why a question cannot be asked of a [`Subject`](super::Subject).
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SubjectError {
    /// The smoothing ratio is out of range.
    #[error("ratio: {0}")]
    Ratio(RatioOutOfRange),
    /// Nothing can be said of the equations.
    #[error("{name}: {problem}")]
    Equations {
        /// What names them.
        kind: Kind,
        /// Their name, or their text.
        name: String,
        /// Why.
        problem: Box<SchemeError>,
    },
    /// The integrator does not serve.
    #[error("integrator {name}: {problem}")]
    Integrator {
        /// Its name.
        name: String,
        /// Why.
        problem: Box<SchemeError>,
    },
    /// The equations take no such value.
    #[error("{name} = {}: {problem}", brief(value))]
    Value {
        /// The parameter.
        name: String,
        /// Its value.
        value: Rational,
        /// Why not.
        problem: Box<SchemeError>,
    },
    /// The equations divide by something that vanishes for a value.
    #[error("{name} = {}: the equations divide by what vanishes for this value", brief(value))]
    Division {
        /// The parameter.
        name: String,
        /// Its value.
        value: Rational,
    },
    /// The parameter in question does not occur.
    #[error("{}", self.unknown().expect("it is of this kind"))]
    UnknownParameter {
        /// The parameter.
        name: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// An axis of a plane has a value.
    #[error("{0} has a value, and is an axis of the plane")]
    AxisIsSet(String),
    /// The parameter in question has a value.
    #[error("{0} is the parameter whose limit is sought; leave its value out")]
    SoughtIsSet(String),
    /// The only parameter has a value.
    #[error("{0} is the only parameter, whose limit is sought; leave its value out")]
    OnlyOneIsSet(String),
    /// There is nothing to seek.
    #[error("{name} has no parameter, so there is no limit to seek")]
    NoParameter {
        /// What names the equations.
        kind: Kind,
        /// Their name.
        name: String,
    },
    /// Several parameters have values.
    #[error("it is not clear which of {} is the one in question; name it", .0.join(", "))]
    Ambiguous(Vec<String>),
    /// Several parameters have none.
    #[error("{} have no value; give values to all but the one whose limit is sought, or name that one", .0.join(", "))]
    SeveralOpen(Vec<String>),
    /// Parameters without a value.
    #[error("{} need a value", .0.join(", "))]
    NotSet(Vec<String>),
}

impl SubjectError {
    /// What the analysis says of a parameter that does not occur.
    pub fn unknown(&self) -> Option<SchemeError> {
        match self {
            Self::UnknownParameter { name, known } => {
                let (name, known) = (name.clone(), known.clone());
                Some(SchemeError::UnknownParameter { name, known })
            }
            _ => None,
        }
    }

    /// What is wrong with the scheme itself, where that is the reason.
    pub fn problem(&self) -> Option<&SchemeError> {
        match self {
            Self::Equations { problem, .. }
            | Self::Integrator { problem, .. }
            | Self::Value { problem, .. } => Some(problem),
            _ => None,
        }
    }
}

/// A number for a message: what takes a line of its own is cut.
pub fn brief(value: &Rational) -> String {
    let text = to_text(value);
    match text.char_indices().nth(24) {
        Some((end, _)) => format!("{}… ({} characters)", &text[..end], text.len()),
        None => text,
    }
}
