//! Exact numbers as text on their way in and out: a fraction as `15/8`, a root with its polynomial and two fractions around it.

use crate::error::bad;
use courant_analysis::exact::rational::{Rational, parse, to_text};
use courant_analysis::scheme::catalogue::exact_number;
use courant_analysis::stability::{ExactValue, Limit, StableSet};
use courant_reports::record::{LimitRecord, exact_latex};
use pyo3::prelude::*;
use serde::Serialize;

/// Bits of the enclosure that is handed over.
const BITS: u32 = 120;

/// A number as it was written.
pub fn number(name: &str, text: &str) -> PyResult<Rational> {
    exact_number(text).ok_or_else(|| bad(format!("{name}: `{text}` is no exact number")))
}

/// The number that somebody means who writes a float: its shortest decimal, 1/10 for 0.1.
pub fn decimal(name: &str, value: f64) -> PyResult<Rational> {
    parse(&value.to_string()).map_err(|_| bad(format!("{name}: {value} is no finite number")))
}

/// A limit as the program writes it, and what makes a number of it.
#[derive(Debug, Serialize)]
pub struct LimitAnswer {
    record: LimitRecord,
    symbol: String,
    /// Equal for a fraction.
    enclosure: Option<[String; 2]>,
    /// Of which it is the only root between the two, ascending.
    polynomial: Option<Vec<String>>,
    latex: Option<String>,
}

impl LimitAnswer {
    pub fn new(limit: &Limit, symbol: &str) -> Self {
        let polynomial = match (limit.exact(), limit.equation()) {
            (Some(ExactValue::SquareRoot(square)), _) => {
                Some(vec![(-square.numer()).to_string(), "0".into(), square.denom().to_string()])
            }
            (_, Some(root)) => {
                let polynomial = root.polynomial();
                Some(polynomial.coefficients().iter().map(ToString::to_string).collect())
            }
            _ => None,
        };
        Self {
            record: LimitRecord::new(limit, symbol, None),
            symbol: symbol.into(),
            enclosure: limit.enclosure(BITS).map(|(low, high)| [to_text(&low), to_text(&high)]),
            polynomial,
            latex: exact_latex(limit),
        }
    }
}

/// Stable or monotone values.
#[derive(Debug, Serialize)]
pub struct SetAnswer {
    limit: LimitAnswer,
    /// Both ends.
    intervals: Vec<[LimitAnswer; 2]>,
    undecided: Vec<(f64, f64)>,
    at_zero: bool,
    neutral: bool,
    evidence: &'static str,
}

impl SetAnswer {
    pub fn new(set: &StableSet, symbol: &str) -> Self {
        let answer = |limit: &Limit| LimitAnswer::new(limit, symbol);
        let intervals = set.intervals.iter();
        Self {
            limit: answer(&set.limit()),
            intervals: intervals.map(|one| [answer(&one.from), answer(&one.to)]).collect(),
            undecided: set.undecided.clone(),
            at_zero: set.at_zero,
            neutral: set.neutral,
            evidence: set.evidence.name(),
        }
    }
}

/// An answer as JSON.
pub fn json(answer: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(answer).map_err(bad)
}
