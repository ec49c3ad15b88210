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
    entry("figures_06_10", "isothermal sound wave, five figures", "Cha & Whitworth 2003, Figures 6–10"),
    entry("figures_11_14", "shock tube, GPH cases 1–4", "Cha & Whitworth 2003, Figures 11–14"),
    entry("figures_15_18", "strong blast wave, GPH cases 1–4", "Cha & Whitworth 2003, Figures 15–18"),
    entry("figures_19_22", "isothermal shock tube, GPH cases 1–4", "Cha & Whitworth 2003, Figures 19–22"),
    entry("figures_23_26", "Sjögreen's test, GPH cases 1–4", "Cha & Whitworth 2003, Figures 23–26"),
    entry("figure_27", "colliding streams, GPH case 3 and SPH", "Cha & Whitworth 2003, Figure 27"),
    entry("particle_errors", "L1 errors of six methods on every scene", "Cha & Whitworth 2003, section 5"),
    entry("particle_conservation", "drift of momentum and energy, penetration, work", "Cha & Whitworth 2003, section 5"),
    entry("blast_shell", "density of the thin shell of the blast", "Cha & Whitworth 2003, 5.3"),
    entry("contact_energy", "energy at the centre of Sjögreen's test, by solver and resolution", "Cha & Whitworth 2003, 5.5"),
    entry("penetration", "particles that pass each other in collisions", "Cha & Whitworth 2003, 5.6"),
    entry("particle_cost", "seconds and pair interactions of six methods", "Cha & Whitworth 2003, section 6"),
    entry("particle_efficiency", "error against seconds and pair interactions", "Cha & Whitworth 2003, section 6"),
    entry("particle_claims", "what the paper says of its tests, against numbers", "Cha & Whitworth 2003, section 5 and 6"),
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
