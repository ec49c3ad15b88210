//! Ferrari, Dumbser, Toro & Armanini 2008: "A new stable version of the SPH method in Lagrangian
//! coordinates", Communications in Computational Physics 4, 378–404. Regenerated.

mod figure_1;
mod proofs;
pub mod section_2_runs;
pub mod section_3;
mod table_1;

pub use figure_1::{figure_1, figure_1_plan};
pub use table_1::{Entry, LimitKind, PublishedValue, Table1, published_values, recipe};

use crate::page::Item;
use crate::paper_text::PaperText;
use crate::part::Part;
use crate::publish::PublishError;
use courant_analysis::waves::sweep::SweepError;
use std::sync::LazyLock;

/// How much of the report to make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// A coarse grid: for a first look and for tests.
    Quick,
    /// Everything, long studies at modest sizes.
    Standard,
    /// Long studies at their full sizes.
    Full,
}

/// The words of the report, and what it shows.
pub fn text() -> &'static PaperText {
    static TEXT: LazyLock<PaperText> = LazyLock::new(|| {
        PaperText::from_toml(include_str!("../../papers/ferrari2008/items.toml"))
            .expect("the words are read by a test")
    });
    &TEXT
}

/// Why the report has no result.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A sweep stopped.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A figure could not be composed or drawn.
    #[error(transparent)]
    Figure(#[from] crate::figure::FigureError),
    /// A finished section could not be written.
    #[error(transparent)]
    Publish(#[from] PublishError),
}

/// The parts of the report in the order of its page.
pub fn parts(table: Table1, detail: Detail) -> Vec<Part> {
    let mut parts = vec![
        Part::new("Table 1", move || {
            let paragraph = [Item::Paragraph(table.explanation())];
            let items = paragraph.into_iter().chain(table.tables()).collect();
            Ok(vec![text().section("title_table_1", items)])
        }),
        Part::new("Figure 1", move || {
            Ok(vec![text().section("title_figure_1", vec![figure_1(detail)?])])
        }),
        Part::new("limits with proof", move || Ok(proofs::section(detail))),
    ];
    parts.extend(section_2_runs::parts(detail));
    parts.push(Part::new("section 3", move || Ok(section_3::sections(detail))));
    parts
}
