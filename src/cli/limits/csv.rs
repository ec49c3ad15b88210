//! Limits for machines: every number with all its digits, empty where there is none.

use super::{Answer, Arguments, budgets, row};
use courant::analysis::exact::rational::to_f64;
use courant::reports::record::{LimitRecord, SubjectRecord};
use courant::reports::table::{Align, Table};

/// The columns that name a subject, in every command.
pub const SUBJECT: [&str; 11] = [
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

/// The columns of a limit, in every command.
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

/// The cells under [`SUBJECT`].
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
        subject.parameter.clone(),
        parameters.join(";"),
    ]
}

/// The columns of a limit that is called something; stability has no prefix.
pub fn limit_columns(prefix: &str) -> impl Iterator<Item = String> {
    LIMIT.iter().map(move |column| format!("{prefix}{column}"))
}

/// The cells under [`limit_columns`].
pub fn limit_cells(limit: Option<LimitRecord>) -> Vec<String> {
    let Some(limit) = limit else { return vec![String::new(); LIMIT.len()] };
    vec![
        limit.decimal.unwrap_or_else(|| number(limit.value)),
        limit.lower.to_string(),
        number(limit.upper),
        limit.exact.unwrap_or_default(),
        limit.equation.map(|equation| equation.text).unwrap_or_default(),
        limit.evidence.into(),
        number(limit.critical_phase),
        limit.cause.unwrap_or_default().into(),
        limit.binding.unwrap_or_default(),
        limit.included.to_string(),
        limit.unbounded.to_string(),
    ]
}

/// A number with all its digits, empty where there is none.
pub fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// A table with these columns and no caption.
pub fn empty(columns: &[String]) -> Table {
    let columns: Vec<(&str, Align)> = columns.iter().map(|c| (c.as_str(), Align::Left)).collect();
    Table::new("", &columns)
}

/// One row an answer.
pub(super) fn table(arguments: &Arguments, answers: &[Answer]) -> Table {
    let growth = budgets(arguments).iter().map(|growth| {
        format!("growth_{}_", format!("{:e}", to_f64(growth)).replace(['-', '.'], "_"))
    });
    let columns: Vec<String> = SUBJECT
        .map(String::from)
        .into_iter()
        .chain(limit_columns(""))
        .chain(["per_spacing".into(), "per_standard_deviation".into()])
        .chain(limit_columns("monotonicity_"))
        .chain(growth.flat_map(|prefix| limit_columns(&prefix).collect::<Vec<_>>()))
        .chain(["keeps_constants".into()])
        .collect();
    let mut table = empty(&columns);
    for answer in answers {
        let row = row(arguments, answer);
        let mut cells = subject_cells(&row.subject);
        cells.extend(limit_cells(Some(row.stability)));
        cells.extend([number(row.per_spacing), number(row.per_standard_deviation)]);
        cells.extend(limit_cells(row.monotonicity));
        cells
            .extend(row.growth_limits.into_iter().flat_map(|found| limit_cells(Some(found.limit))));
        cells.push(row.keeps_constants.to_string());
        table.push(cells);
    }
    table
}
