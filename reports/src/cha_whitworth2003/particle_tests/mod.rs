//! Sections 5.1–5.6: the one-dimensional tests of the four Godunov particle methods and of SPH.

mod accuracy;
mod blast_shell;
mod claims;
mod collision;
mod cost;
mod efficiency;
mod rarefied_contact;
mod runs;
mod sound_wave;
mod tubes;

pub use blast_shell::{Shell, blast_shell};
pub use claims::{Claim, ClaimVerdict};
pub use collision::{PenetrationCount, penetrations};
pub use cost::{Cost, costs};
pub use rarefied_contact::{ContactEnergy, contact_energies};
pub use runs::{Runs, Solved};

use super::{COMMAND, Detail, ReportError};
use crate::CatalogueItem;
use crate::page::{Item, Section};
use courant_analysis::sweep::{Progress, SweepError};

const fn entry(
    name: &'static str,
    description: &'static str,
    source: &'static str,
) -> CatalogueItem {
    CatalogueItem { name, description, source }
}

/// What these sections show.
pub const CATALOGUE: &[CatalogueItem] = &[
    entry("figure_06", "isothermal sound wave, GPH case 1", "Cha & Whitworth 2003, Figure 6"),
    entry("figure_07", "isothermal sound wave, GPH case 2", "Cha & Whitworth 2003, Figure 7"),
    entry("figure_08", "isothermal sound wave, GPH case 3", "Cha & Whitworth 2003, Figure 8"),
    entry("figure_09", "isothermal sound wave, GPH case 4", "Cha & Whitworth 2003, Figure 9"),
    entry("figure_10", "isothermal sound wave, SPH", "Cha & Whitworth 2003, Figure 10"),
    entry("figure_11", "shock tube, GPH case 1", "Cha & Whitworth 2003, Figure 11"),
    entry("figure_12", "shock tube, GPH case 2", "Cha & Whitworth 2003, Figure 12"),
    entry("figure_13", "shock tube, GPH case 3", "Cha & Whitworth 2003, Figure 13"),
    entry("figure_14", "shock tube, GPH case 4", "Cha & Whitworth 2003, Figure 14"),
    entry("figure_15", "strong blast wave, GPH case 1", "Cha & Whitworth 2003, Figure 15"),
    entry("figure_16", "strong blast wave, GPH case 2", "Cha & Whitworth 2003, Figure 16"),
    entry("figure_17", "strong blast wave, GPH case 3", "Cha & Whitworth 2003, Figure 17"),
    entry("figure_18", "strong blast wave, GPH case 4", "Cha & Whitworth 2003, Figure 18"),
    entry("figure_19", "isothermal shock tube, GPH case 1", "Cha & Whitworth 2003, Figure 19"),
    entry("figure_20", "isothermal shock tube, GPH case 2", "Cha & Whitworth 2003, Figure 20"),
    entry("figure_21", "isothermal shock tube, GPH case 3", "Cha & Whitworth 2003, Figure 21"),
    entry("figure_22", "isothermal shock tube, GPH case 4", "Cha & Whitworth 2003, Figure 22"),
    entry("figure_23", "Sjögreen's test, GPH case 1", "Cha & Whitworth 2003, Figure 23"),
    entry("figure_24", "Sjögreen's test, GPH case 2", "Cha & Whitworth 2003, Figure 24"),
    entry("figure_25", "Sjögreen's test, GPH case 3", "Cha & Whitworth 2003, Figure 25"),
    entry("figure_26", "Sjögreen's test, GPH case 4", "Cha & Whitworth 2003, Figure 26"),
    entry("figure_27", "colliding streams, GPH case 3 and SPH", "Cha & Whitworth 2003, Figure 27"),
    entry(
        "particle_errors",
        "L1 errors of six methods on every scene",
        "Cha & Whitworth 2003, section 5",
    ),
    entry(
        "particle_conservation",
        "drift of momentum and energy, penetration, work",
        "Cha & Whitworth 2003, section 5",
    ),
    entry("blast_shell", "density of the thin shell of the blast", "Cha & Whitworth 2003, 5.3"),
    entry(
        "contact_energy",
        "energy at the centre of Sjögreen's test, by solver and resolution",
        "Cha & Whitworth 2003, 5.5",
    ),
    entry(
        "penetration",
        "particles that pass each other in collisions",
        "Cha & Whitworth 2003, 5.6",
    ),
    entry(
        "particle_cost",
        "seconds and pair interactions of six methods",
        "Cha & Whitworth 2003, section 6",
    ),
    entry(
        "particle_efficiency",
        "error against seconds and pair interactions",
        "Cha & Whitworth 2003, section 6",
    ),
    entry(
        "particle_efficiency_table",
        "the same as numbers, with orders of convergence",
        "Cha & Whitworth 2003, section 6",
    ),
    entry(
        "particle_claims",
        "what the paper says of its tests, against numbers",
        "Cha & Whitworth 2003, section 5 and 6",
    ),
];

/// The sections.
///
/// # Errors
/// When the callback stops the work.
pub fn sections(detail: Detail, progress: Progress<'_>) -> Result<Vec<Section>, ReportError> {
    let stages = efficiency::runs(detail).len();
    let all = Runs::count(detail) + stages;
    let runs = Runs::compute(detail, &|done, _| progress(done, all))?;
    let done = Runs::count(detail);
    let shells = blast_shell(&runs);
    let contacts = contact_energies();
    let penetrations = penetrations();
    // Seconds are measured with nothing beside.
    let costs = costs(detail);
    let efficiency = efficiency::measure(detail, &|stage| progress(done + stage, all))?;
    let claims = claims::claims(&runs, &shells, &contacts, &penetrations, &costs);
    Ok(vec![
        Section {
            title: "What the paper says of its tests, against numbers".into(),
            items: vec![claims::table(&claims)],
        },
        Section { title: "5.1 Isothermal sound wave".into(), items: sound_wave::figures(&runs) },
        tubes::section(&runs, tubes::SOD),
        with(tubes::section(&runs, tubes::BLAST), blast_shell::table(&shells)),
        tubes::section(&runs, tubes::ISOTHERMAL),
        with(tubes::section(&runs, tubes::SJOGREEN), rarefied_contact::table(&contacts)),
        Section {
            title: "5.6 Colliding streams".into(),
            items: vec![collision::figure(&runs), collision::table(&penetrations)],
        },
        Section {
            title: "Errors and conservation".into(),
            items: vec![accuracy::errors(&runs), accuracy::conservation(&runs)],
        },
        Section {
            title: "What the methods cost".into(),
            items: [cost::items(&costs), efficiency::items(&efficiency)].concat(),
        },
    ])
}

fn with(mut section: Section, item: Item) -> Section {
    section.items.push(item);
    section
}

fn cancelled() -> ReportError {
    ReportError::Sweep(SweepError::Cancelled)
}
