//! Section 3: gas dynamics. Table 2, Figures 3 to 21, and what their adjectives are in numbers.

mod convergence;
mod cost;
mod courant_number;
mod errors;
mod figures;
mod linear_theory;
mod measures;
mod runs;
mod table_2;
mod windows;

use super::{Detail, ReportError};
use crate::CatalogueItem;
use crate::page::{Item, Publish, Section};
use courant_analysis::waves::sweep::{Progress, SweepError};
use courant_simulation::run::Failure;
use runs::Runs;

/// The command that makes this part of the report.
const COMMAND: &str = super::COMMAND;

const SOURCE: &str = "Ferrari et al. 2008, section 3.3";

/// What this part shows.
pub const CATALOGUE: &[CatalogueItem] = &[
    CatalogueItem {
        name: "table_2",
        description: "initial conditions of the four shock tubes",
        source: "Ferrari et al. 2008, Table 2",
    },
    CatalogueItem {
        name: "table_2_star_states",
        description: "exact star states and the growth of the Lagrangian sound speed",
        source: "Ferrari et al. 2008, Table 2",
    },
    entry("figure_03", "test 1, finite volumes", "Ferrari et al. 2008, Figure 3"),
    entry("figure_04", "test 1, standard SPH (ADKE)", "Ferrari et al. 2008, Figure 4"),
    entry("figure_05", "test 1, Godunov-type SPH, exact flux", "Ferrari et al. 2008, Figure 5"),
    entry("figure_06", "test 1, Godunov-type SPH, Rusanov flux", "Ferrari et al. 2008, Figure 6"),
    entry("figure_07", "test 1, Godunov-type SPH, Roe flux", "Ferrari et al. 2008, Figure 7"),
    entry("figure_08", "test 2, finite volumes", "Ferrari et al. 2008, Figure 8"),
    entry("figure_09", "test 2, standard SPH (ADKE)", "Ferrari et al. 2008, Figure 9"),
    entry("figure_10", "test 2, Godunov-type SPH, exact flux", "Ferrari et al. 2008, Figure 10"),
    entry("figure_11", "test 2, Godunov-type SPH, Rusanov flux", "Ferrari et al. 2008, Figure 11"),
    entry("figure_12", "test 2, Godunov-type SPH, Roe flux", "Ferrari et al. 2008, Figure 12"),
    entry("figure_13", "test 3, finite volumes", "Ferrari et al. 2008, Figure 13"),
    entry("figure_14", "test 3, Godunov-type SPH, exact flux", "Ferrari et al. 2008, Figure 14"),
    entry("figure_15", "test 3, Godunov-type SPH, Rusanov flux", "Ferrari et al. 2008, Figure 15"),
    entry("figure_16", "test 3, Godunov-type SPH, Roe flux", "Ferrari et al. 2008, Figure 16"),
    entry("figure_17", "test 4, finite volumes", "Ferrari et al. 2008, Figure 17"),
    entry("figure_18", "test 4, standard SPH (ADKE)", "Ferrari et al. 2008, Figure 18"),
    entry("figure_19", "test 4, Godunov-type SPH, exact flux", "Ferrari et al. 2008, Figure 19"),
    entry("figure_20", "test 4, Godunov-type SPH, Rusanov flux", "Ferrari et al. 2008, Figure 20"),
    entry("figure_21", "test 4, Godunov-type SPH, Roe flux", "Ferrari et al. 2008, Figure 21"),
    entry("section_3_errors", "errors, overshoot, conservation, cost of every run", SOURCE),
    entry("section_3_waves", "positions of the waves and width of the contact", SOURCE),
    entry("section_3_statements", "what the paper says, confirmed or contradicted", SOURCE),
    entry("section_3_convergence", "error against N, with fitted orders", SOURCE),
    entry("section_3_convergence_table", "the same as a table", SOURCE),
    entry("section_3_cost", "error against computing time of the five methods", SOURCE),
    entry("section_3_cost_table", "the same as a table", SOURCE),
    entry("section_3_courant", "error against Courant number, and where runs fail", SOURCE),
    entry("section_3_courant_limits", "where runs fail, and what linear theory says", SOURCE),
    entry("section_3_linear", "linear theory of the Lagrangian scheme and its check", SOURCE),
];

const fn entry(
    name: &'static str,
    description: &'static str,
    source: &'static str,
) -> CatalogueItem {
    CatalogueItem { name, description, source }
}

/// Hands over the sections of this part, in the order of the paper, as they are finished.
///
/// # Errors
/// When the callback asks to stop, or a section cannot be published.
pub fn publish_sections(
    detail: Detail,
    progress: Progress<'_>,
    publish: &mut Publish<'_>,
) -> Result<(), ReportError> {
    let parts = 5;
    let reached = |part: usize| {
        if progress(part, parts).is_break() {
            Err(ReportError::Sweep(SweepError::Cancelled))
        } else {
            Ok(())
        }
    };
    reached(0)?;
    // Time is measured first, while nothing else runs.
    let timed = cost::measure(detail);
    let runs = Runs::at_100_particles();
    reached(1)?;
    publish(table_2::section())?;
    for section in figures::sections(&runs) {
        publish(section)?;
    }
    publish(Section {
        title: "Section 3.3 in numbers".into(),
        items: vec![errors::table(&runs), errors::waves(&runs), measures::claims(&runs)],
    })?;
    reached(2)?;
    publish(Section {
        title: "Convergence of the five methods".into(),
        items: convergence::items(detail, &timed),
    })?;
    reached(3)?;
    publish(Section { title: "Time against error".into(), items: cost::items(&timed) })?;
    publish(Section {
        title: "Which Courant number is safe".into(),
        items: [linear_theory::items(), courant_number::items(detail)].concat(),
    })?;
    reached(parts)
}

/// A table with its place in the report.
fn table_item(name: &str, table: crate::table::Table) -> Item {
    Item::Table { name: name.into(), table, command: COMMAND.into() }
}

/// The title of the panel of a test in a figure of all four.
fn panel_title(test: usize) -> String {
    format!("({}) test {test}", char::from(b'a' + test as u8 - 1))
}

/// The outcome of a run as two comma-separated values, one of them empty.
fn error_or_failure(outcome: &Result<f64, Failure>) -> String {
    match outcome {
        Ok(error) => format!("{error:.10e},"),
        Err(failure) => format!(",{failure}"),
    }
}

#[cfg(test)]
mod tests;
