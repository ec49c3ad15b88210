//! Ferrari, Dumbser, Toro & Armanini 2008: "A new stable version of the SPH method in Lagrangian
//! coordinates", Communications in Computational Physics 4, 378–404. Regenerated.

mod figure_1;
mod proofs;
pub mod section_2_runs;
pub mod section_3;
mod table_1;

pub use figure_1::{figure_1, figure_1_plan};
pub use table_1::{Entry, LimitKind, PublishedValue, Table1, published_values, recipe};

use crate::CatalogueItem;
use crate::page::{Item, PageError, Publish, Section};
use courant_analysis::waves::sweep::{Progress, SweepError};

/// How much of the report to make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// Everything, at full resolution.
    Full,
    /// A coarse grid: for a quick look and for tests.
    Quick,
}

/// The command that makes this report.
pub const COMMAND: &str = "courant report ferrari2008";

/// What this report shows.
pub const CATALOGUE: &[CatalogueItem] = &[
    CatalogueItem {
        name: "table_1_exact",
        description: "largest stable and monotone Courant number, exact",
        source: "Ferrari et al. 2008, Table 1",
    },
    CatalogueItem {
        name: "table_1_published",
        description: "the same as printed, and the recipe that reproduces it",
        source: "Ferrari et al. 2008, Table 1",
    },
    CatalogueItem {
        name: "table_1_difference",
        description: "printed against exact, and the growth at the printed values",
        source: "Ferrari et al. 2008, Table 1",
    },
    CatalogueItem {
        name: "figure_01",
        description: "amplification factor over the (l/Δξ, C) plane",
        source: "Ferrari et al. 2008, Figure 1",
    },
    CatalogueItem {
        name: "limits_cost",
        description: "time against error of sampled and proved limits",
        source: "beyond the paper",
    },
    CatalogueItem {
        name: "limits_cost_table",
        description: "proof against samples over the smoothing ratio",
        source: "beyond the paper",
    },
    CatalogueItem {
        name: "limits_hard_cases",
        description: "hard cases of the limits, each answered by a computation",
        source: "beyond the paper",
    },
    CatalogueItem {
        name: "figure_02",
        description: "step and hump after one and five periods",
        source: "Ferrari et al. 2008, Figure 2",
    },
    CatalogueItem {
        name: "figure_02_norms",
        description: "error norms of the same runs",
        source: "Ferrari et al. 2008, Figure 2",
    },
    CatalogueItem {
        name: "predicted_measured",
        description: "amplification factors by symbol and by run",
        source: "Ferrari et al. 2008, section 2, run",
    },
    CatalogueItem {
        name: "figure_predicted_measured",
        description: "the same, mode by mode",
        source: "Ferrari et al. 2008, section 2, run",
    },
    CatalogueItem {
        name: "printed_growth",
        description: "runs at the printed stability limits",
        source: "Ferrari et al. 2008, Table 1",
    },
    CatalogueItem {
        name: "figure_printed_growth",
        description: "their growth, step by step",
        source: "Ferrari et al. 2008, Table 1",
    },
    CatalogueItem {
        name: "limits_by_run",
        description: "stability limits found by running, beside the proved ones",
        source: "Ferrari et al. 2008, section 2, run",
    },
    CatalogueItem {
        name: "long_runs",
        description: "a million steps just below and just above a limit",
        source: "Ferrari et al. 2008, section 2, run",
    },
    CatalogueItem {
        name: "figure_disorder",
        description: "how far the lattice theory carries on uneven positions",
        source: "Ferrari et al. 2008, section 2, run",
    },
    CatalogueItem {
        name: "figure_speed_smooth",
        description: "error against cost, smooth data",
        source: "Ferrari et al. 2008, section 2, run",
    },
    CatalogueItem {
        name: "figure_speed_jump",
        description: "error against cost, data with jumps",
        source: "Ferrari et al. 2008, section 2, run",
    },
    CatalogueItem {
        name: "speed_recommendation",
        description: "the cheapest choice for an error",
        source: "Ferrari et al. 2008, section 2, run",
    },
];

/// Why the report has no result.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A sweep stopped.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A figure could not be composed.
    #[error(transparent)]
    Figure(#[from] crate::figure::FigureError),
    /// A finished section could not be written.
    #[error(transparent)]
    Page(#[from] PageError),
}

/// Hands over the sections of the report as they are finished.
///
/// # Errors
/// When the callback stops a sweep, or a section cannot be published.
pub fn publish_sections(
    table: &Table1,
    detail: Detail,
    progress: Progress<'_>,
    publish: &mut Publish<'_>,
) -> Result<(), ReportError> {
    let mut items = vec![Item::Paragraph(table.explanation())];
    for (name, table) in [
        ("table_1_exact", table.exact_table()),
        ("table_1_published", table.published_table()),
        ("table_1_difference", table.difference_table()),
    ] {
        items.push(Item::Table { name: name.into(), table, command: COMMAND.into() });
    }
    let title = "Table 1: largest stable and largest monotone Courant number".into();
    publish(Section { title, items })?;
    publish(Section {
        title: "Figure 1: amplification over the (l/Δξ, C) plane".into(),
        items: vec![figure_1(detail, progress)?],
    })?;
    proofs::publish_sections(detail, publish)?;
    section_2_runs::publish_sections(detail, progress, publish)?;
    section_3::publish_sections(detail, progress, publish)
}
