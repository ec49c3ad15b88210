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

use super::{Detail, text};
use crate::page::Section;
use courant_simulation::run::Failure;
use runs::Runs;

/// The sections of this part, in the order of the paper.
pub fn sections(detail: Detail) -> Vec<Section> {
    let ((runs, points), courant) = rayon::join(
        || rayon::join(Runs::at_100_particles, || convergence::points(detail)),
        || [linear_theory::items(), courant_number::items(detail)].concat(),
    );
    let numbers = vec![errors::table(&runs), errors::waves(&runs), measures::claims(&runs)];
    let convergence = [convergence::items(detail, &points), cost::items(&points)].concat();
    let mut sections = vec![table_2::section()];
    sections.extend(figures::sections(&runs));
    sections.extend([
        text().section("title_section_3_numbers", numbers),
        text().section("title_convergence", convergence),
        text().section("title_courant", courant),
    ]);
    sections
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
