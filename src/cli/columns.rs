//! Columns for machines: the same for the same concept in every command. ASCII headings, all digits, empty where there is nothing.

use courant::reports::record::{LimitRecord, Phases, SubjectRecord};
use courant::reports::table::{Align, Table};

/// The columns that name a subject.
const SUBJECT: [&str; 11] = [
    "scheme",
    "integrator",
    "kernel",
    "ratio",
    "alpha",
    "eos",
    "density",
    "lattice",
    "dimension",
    "parameter",
    "parameters",
];

/// The columns of a limit.
const LIMIT: [&str; 11] = [
    "value",
    "lower",
    "upper",
    "exact",
    "equation",
    "evidence",
    "critical_phase",
    "cause",
    "binding",
    "included",
    "unbounded",
];

/// The columns that name a subject.
pub fn subject_columns() -> impl Iterator<Item = String> {
    SUBJECT.map(String::from).into_iter()
}

/// The cells under [`subject_columns`].
pub fn subject_cells(subject: &SubjectRecord) -> Vec<String> {
    let text = |value: Option<&str>| value.unwrap_or_default().to_string();
    let parameters: Vec<String> =
        subject.parameters.iter().map(|(name, value)| format!("{name}={value}")).collect();
    vec![
        subject.scheme.clone(),
        text(subject.integrator.as_deref()),
        text(subject.kernel),
        text(subject.ratio.as_deref()),
        number(subject.alpha),
        text(subject.eos.as_deref()),
        text(subject.density),
        text(subject.lattice),
        subject.dimension.to_string(),
        text(subject.parameter.as_deref()),
        parameters.join(";"),
    ]
}

/// The columns of a limit that is called something; stability has no prefix.
pub fn limit_columns(prefix: &str) -> Vec<String> {
    LIMIT.iter().map(move |column| format!("{prefix}{column}")).collect()
}

/// The cells under [`limit_columns`].
pub fn limit_cells(limit: Option<&LimitRecord>) -> Vec<String> {
    let Some(limit) = limit else { return vec![String::new(); LIMIT.len()] };
    let text = |value: &Option<String>| value.clone().unwrap_or_default();
    vec![
        limit.decimal.clone().unwrap_or_else(|| number(limit.value)),
        limit.lower.to_string(),
        number(limit.upper),
        text(&limit.exact),
        limit.equation.as_ref().map(|equation| equation.text.clone()).unwrap_or_default(),
        limit.evidence.into(),
        phases(limit.critical_phase.as_ref()),
        limit.cause.unwrap_or_default().into(),
        text(&limit.binding),
        limit.included.to_string(),
        limit.unbounded.to_string(),
    ]
}

/// A number with all its digits, empty where there is none.
pub fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// The phases of a wave, joined by `;`.
pub fn phases(phases: Option<&Phases>) -> String {
    phases.map_or_else(String::new, ToString::to_string)
}

/// A table with these columns and no caption.
pub fn empty(columns: &[String]) -> Table {
    let columns: Vec<(&str, Align)> = columns.iter().map(|c| (c.as_str(), Align::Left)).collect();
    Table::new("", &columns)
}
