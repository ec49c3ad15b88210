//! Section 5.7: a shear flow, Figure 28.

use super::text;
use crate::field_profile::{profile_csv, profile_panel};
use crate::figure::Figure;
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::or_dash;
use crate::report::Detail;
use crate::{cells, words};
use courant_simulation::field::{FieldRun, FieldScene, run_field};
use courant_simulation::particles::{ActsOn, ParticleMethod};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Method, its name in captions, and on which pairs its viscosity acts.
const METHODS: [(ParticleMethod, &str, ActsOn); 5] = [
    (ParticleMethod::Gph1, "GPH case 1", ActsOn::Approaching),
    (ParticleMethod::Gph2, "GPH case 2", ActsOn::Approaching),
    (ParticleMethod::Gph3, "GPH case 3", ActsOn::Approaching),
    (ParticleMethod::Sph1, "SPH", ActsOn::Approaching),
    (ParticleMethod::Sph1, "SPH with Balsara's switch", ActsOn::Compressing),
];

fn count(detail: Detail) -> usize {
    match detail {
        Detail::Quick => 196,
        Detail::Standard => 900,
        Detail::Full => 2500,
    }
}

fn run(scene: &FieldScene, count: usize, method: ParticleMethod, acts_on: ActsOn) -> FieldRun {
    let mut options = scene.options(method);
    options.viscosity.acts_on = acts_on;
    run_field(scene, count, &options, &mut |_| ControlFlow::Continue(()))
        .expect("the report's options are in range")
}

/// The section.
pub fn sections(detail: Detail) -> Vec<Section> {
    let scene = FieldScene::named("shear").expect("it is in the list");
    let runs: Vec<FieldRun> = METHODS
        .par_iter()
        .map(|&(method, _, acts_on)| run(&scene, count(detail), method, acts_on))
        .collect();
    vec![text().section("title_shear", vec![figure(&scene, &runs), results(&runs)])]
}

/// The velocity along the flow, as in the panels of the paper.
fn figure(scene: &FieldScene, runs: &[FieldRun]) -> Item {
    let panels = runs.iter().zip(METHODS).map(|(run, (_, title, _))| {
        profile_panel(scene, &run.run.profile, run.run.time).title(title)
    });
    let figure = Figure::grid(3, 2).size(6.6, 7.4).panels(panels);
    let data = runs.iter().enumerate();
    let data = data.map(|(k, run)| (format!("figure_28_{k}.csv"), profile_csv(&run.run.profile)));
    let caption = words![
        "particles" = runs[0].run.profile.len(),
        "lattice" = scene.lattice.name(),
        "time" = significant(runs[0].run.time, 3)
    ];
    text().figure("figure_28", caption, figure, data.collect())
}

/// What is left of the flow, and what linear theory says of its viscosity.
fn results(runs: &[FieldRun]) -> Item {
    let rows = runs.iter().zip(METHODS).map(|(run, (_, title, _))| {
        let of = |name: &str| or_dash(run.measure(name), 3);
        cells![
            title,
            of("velocity_scatter"),
            of("cross_velocity"),
            of("kinetic_energy_left"),
            of("density_scatter"),
            of("viscosity"),
            of("viscosity_predicted"),
            run.run.counters.interactions,
        ]
    });
    text().table("shear_results", &[], rows)
}
