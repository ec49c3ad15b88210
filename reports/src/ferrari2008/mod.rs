//! Ferrari, Dumbser, Toro & Armanini 2008: "A new stable version of the SPH method in Lagrangian
//! coordinates", Communications in Computational Physics 4, 378–404. Regenerated.

mod figure_1;
mod figure_2;
mod hard_cases;
mod printed_growth;
pub mod section_3;
mod table_1;

pub use figure_1::{figure_1, figure_1_plan};
pub use table_1::{Entry, LimitKind, PublishedValue, Table1, published_values, recipe};

use crate::page::{Item, Section};
use crate::paper_text::PaperText;
use crate::part::Part;
use crate::report::Detail;
use crate::study::{disorder, limits_by_run, limits_cost, predicted_measured, speed};
use std::sync::LazyLock;

/// The words of the report, and what it shows.
pub fn text() -> &'static PaperText {
    static TEXT: LazyLock<PaperText> = LazyLock::new(|| {
        PaperText::from_toml(include_str!("../../papers/ferrari2008/items.toml"))
            .expect("the words are read by a test")
    });
    &TEXT
}

/// The parts of the report in the order of its page.
pub fn parts(table: Table1, detail: Detail) -> Vec<Part> {
    let study = |name, section: fn(&PaperText, Detail) -> Section| {
        Part::new(name, move || Ok(vec![section(text(), detail)]))
    };
    vec![
        Part::new("Table 1", move || {
            let paragraph = [Item::Paragraph(table.explanation())];
            let items = paragraph.into_iter().chain(table.tables()).collect();
            Ok(vec![text().section("title_table_1", items)])
        }),
        Part::new("Figure 1", move || {
            Ok(vec![text().section("title_figure_1", vec![figure_1(detail)?])])
        }),
        Part::new("limits with proof", move || Ok(proofs(detail))),
        Part::new("Figure 2", || Ok(vec![figure_2::section()])),
        study("predicted against measured", predicted_measured::section),
        Part::new("growth at printed limits", || Ok(vec![printed_growth::section()])),
        study("limits by run", limits_by_run::section),
        study("disordered positions", disorder::section),
        study("work against error", speed::section),
        Part::new("section 3", move || Ok(section_3::sections(detail))),
    ]
}

/// What a proof costs; limits as roots of polynomials; the hard cases.
fn proofs(detail: Detail) -> Vec<Section> {
    let (cost, hard) = rayon::join(
        || limits_cost::items(text(), detail),
        || vec![hard_cases::table(), limits_cost::roots(text())],
    );
    vec![text().section("title_limits_cost", cost), text().section("title_hard_cases", hard)]
}
