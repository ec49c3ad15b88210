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

use super::text;
use crate::page::Section;
use crate::report::Detail;
use courant_simulation::particles::ParticleMethod;
use runs::Runs;

/// The paper's four Godunov methods.
const CASES: [ParticleMethod; 4] =
    [ParticleMethod::Gph1, ParticleMethod::Gph2, ParticleMethod::Gph3, ParticleMethod::Gph4];

/// The sections, in the order of the paper; the claims, which rest on all the others, last.
pub fn sections(detail: Detail) -> Vec<Section> {
    let runs = Runs::compute(detail);
    let shells = blast_shell::blast_shell(&runs);
    let contacts = rarefied_contact::contact_energies(&runs, detail);
    let penetrations = collision::penetrations(&runs);
    let mut waves = vec![text().paragraph("settings_explained", &[])];
    waves.extend(sound_wave::figures(&runs));
    let mut tubes = tubes::ALL.map(|tube| tubes::section(&runs, tube));
    tubes[1].items.push(blast_shell::table(&shells));
    tubes[3].items.push(rarefied_contact::table(&contacts));
    let streams = vec![collision::figure(&runs), collision::table(&penetrations)];
    let accuracy = vec![accuracy::errors(&runs), accuracy::conservation(&runs)];
    let mut cost = vec![cost::table(&runs)];
    cost.extend(efficiency::items(&runs, detail));
    let evidence = claims::Evidence {
        runs: &runs,
        shells: &shells,
        contacts: &contacts,
        penetrations: &penetrations,
    };
    let claims = vec![claims::item(&evidence)];
    let mut sections = vec![text().section("title_sound_wave", waves)];
    sections.extend(tubes);
    sections.extend([
        text().section("title_streams", streams),
        text().section("title_accuracy", accuracy),
        text().section("title_cost", cost),
        text().section("title_claims", claims),
    ]);
    sections
}
