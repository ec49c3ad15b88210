//! Section 3: gas dynamics. Table 2, Figures 3 to 21, and what their adjectives are in numbers.

mod claims;
mod figures;
mod table_2;

use super::text;
use crate::page::Section;
use crate::report::Detail;
use crate::study::{convergence, courant_number, linear_theory, riemann_tables, tubes::Tubes};

/// The four tests and the five methods, in the order of the figures.
fn tubes() -> Tubes {
    text().plan("tubes")
}

/// The sections of this part, in the order of the paper.
pub fn sections(detail: Detail) -> Vec<Section> {
    let tubes = &tubes();
    let linear = || linear_theory::items(text(), tubes);
    let ((runs, points), courant) = rayon::join(
        || rayon::join(|| tubes.runs(), || convergence::points(text(), tubes, detail)),
        || [linear(), courant_number::items(text(), tubes, detail)].concat(),
    );
    let numbers = vec![
        riemann_tables::errors(text(), "section_3_errors", &runs),
        riemann_tables::waves(text(), "section_3_waves", &runs),
        claims::table(&runs),
    ];
    let convergence = convergence::items(text(), tubes, detail, &points);
    let mut sections = vec![table_2::section()];
    sections.extend(figures::sections(&runs));
    sections.extend([
        text().section("title_section_3_numbers", numbers),
        text().section("title_convergence", convergence),
        text().section("title_courant", courant),
    ]);
    sections
}

#[cfg(test)]
mod tests;
