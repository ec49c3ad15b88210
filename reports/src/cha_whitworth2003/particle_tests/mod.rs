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
pub use collision::{PenetrationCount, penetrations};
pub use cost::{Cost, costs};
pub use rarefied_contact::{ContactEnergy, contact_energies};
pub use runs::{Runs, Solved};

use super::{COMMAND, Detail, ReportError};
use crate::CatalogueItem;
use crate::page::{Item, Publish, Section};
use courant_analysis::waves::sweep::{Progress, SweepError};

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

/// Hands over the sections as they are finished; the claims, which rest on all the others, last.
///
/// # Errors
/// When the callback stops the work, or a section cannot be published.
pub fn publish_sections(
    detail: Detail,
    progress: Progress<'_>,
    publish: &mut Publish<'_>,
) -> Result<(), ReportError> {
    let stages = efficiency::runs(detail).len();
    let all = Runs::count(detail) + stages;
    let runs = Runs::compute(detail, &|done, _| progress(done, all))?;
    let done = Runs::count(detail);
    let section = |title: &str, items| Section { title: title.into(), items };
    let mut waves = vec![settings_explained()];
    waves.extend(sound_wave::figures(&runs));
    publish(section("5.1 Isothermal sound wave", waves))?;
    publish(tubes::section(&runs, tubes::SOD))?;
    let shells = blast_shell(&runs);
    publish(with(tubes::section(&runs, tubes::BLAST), blast_shell::table(&shells)))?;
    publish(tubes::section(&runs, tubes::ISOTHERMAL))?;
    let contacts = contact_energies();
    publish(with(tubes::section(&runs, tubes::SJOGREEN), rarefied_contact::table(&contacts)))?;
    let penetrations = penetrations();
    let streams = vec![collision::figure(&runs), collision::table(&penetrations)];
    publish(section("5.6 Colliding streams", streams))?;
    publish(section("5.7 Shear and 5.8 collapse: not reproduced", vec![not_reproduced()]))?;
    let accuracy = vec![accuracy::errors(&runs), accuracy::conservation(&runs)];
    publish(section("Errors and conservation", accuracy))?;
    // Seconds are measured with nothing beside.
    let costs = costs(detail);
    let efficiency = efficiency::measure(detail, &|stage| progress(done + stage, all))?;
    let cost = [cost::items(&costs), efficiency::items(&efficiency)].concat();
    publish(section("What the methods cost", cost))?;
    let evidence = claims::Evidence {
        runs: &runs,
        shells: &shells,
        contacts: &contacts,
        penetrations: &penetrations,
    };
    publish(section(
        "What the paper says of its tests, against numbers",
        vec![claims::item(&evidence)],
    ))?;
    Ok(())
}

/// What of the paper this program does not compute, and why.
fn not_reproduced() -> Item {
    Item::Paragraph(
        "Of the paper's tests two are not here: the velocity shear of 5.7 (Figure 28), which is two-dimensional, and the \
         collapse of a singular isothermal sphere of 5.8 (Figures 29 to 34, Table 5), which is three-dimensional and needs \
         self-gravity and a sink particle. The pair forces and the neighbour search here are written for any dimension, but \
         scenes, runs, exact solutions and dispersion relations are one-dimensional, and there is no gravity. Nothing on \
         this page says anything about the paper's claims on shear, on rotation and on collapse. Figure 1 is a sketch."
            .into(),
    )
}

/// What the captions of the figures call step and integrator.
fn settings_explained() -> Item {
    Item::Paragraph(
        "Captions give the step as a share of the shortest crossing time: the least h_i/s_i over all particles i, s_i the \
         largest signal velocity c_L + c_R + max(0, v_L − v_R) among the pairs of i. Integrators: centred-euler takes \
         v' = v + Δt a and x' = x + Δt (v + v')/2, with the time-centred velocity of (14) and (16); rk2-heun is the \
         predictor–corrector used for SPH: a step of forward Euler, corrected with the mean of the rates before and after it."
            .into(),
    )
}

fn with(mut section: Section, item: Item) -> Section {
    section.items.push(item);
    section
}

fn cancelled() -> ReportError {
    ReportError::Sweep(SweepError::Cancelled)
}
