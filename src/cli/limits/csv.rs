//! Limits for machines.

use super::{Answer, Arguments, budgets, row};
use crate::cli::columns::{
    empty, limit_cells, limit_columns, number, subject_cells, subject_columns,
};
use courant::analysis::exact::rational::to_f64;
use courant::reports::table::Table;

/// One row an answer.
pub(super) fn table(arguments: &Arguments, answers: &[Answer]) -> Table {
    let growth = budgets(arguments).iter().map(|growth| {
        format!("growth_{}_", format!("{:e}", to_f64(growth)).replace(['-', '.'], "_"))
    });
    let columns: Vec<String> = subject_columns()
        .chain(limit_columns(""))
        .chain(["per_spacing".into(), "per_standard_deviation".into()])
        .chain(limit_columns("monotonicity_"))
        .chain(growth.flat_map(|prefix| limit_columns(&prefix)))
        .chain(["keeps_constants".into()])
        .collect();
    let mut table = empty(&columns);
    for answer in answers {
        let row = row(arguments, answer);
        let mut cells = subject_cells(&row.subject);
        cells.extend(limit_cells(Some(&row.stability)));
        cells.extend([number(row.per_spacing), number(row.per_standard_deviation)]);
        cells.extend(limit_cells(row.monotonicity.as_ref()));
        cells.extend(row.growth_limits.iter().flat_map(|found| limit_cells(Some(&found.limit))));
        cells.push(row.keeps_constants.to_string());
        table.push(cells);
    }
    table
}
