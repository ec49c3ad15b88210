//! What a run costs, in work that does not depend on the machine, and in seconds beside it.

use super::runs::{Plan, Runs, Solved, every_method, scene};
use super::text;
use crate::number::significant;
use crate::page::Item;
use crate::{cells, words};
use courant_simulation::particles::{MethodOptions, ParticleMethod, StepSharing};

const SCENES: [&str; 2] = ["sod-sph", "isothermal-tube"];
const LEVELS: u32 = 6;

/// Times of each run; the shortest counts.
pub(super) const REPEATS: usize = 2;

/// Every method, and the Godunov methods with block steps too.
pub(super) fn plans() -> Vec<Plan> {
    let of = |name| {
        let customary = every_method(&scene(name));
        let blocks = customary.clone().into_iter().filter(|plan| plan.1.method.is_godunov());
        let blocks = blocks.map(|(scene, options)| {
            (scene, MethodOptions { sharing: StepSharing::Block { levels: LEVELS }, ..options })
        });
        customary.into_iter().chain(blocks).collect::<Vec<Plan>>()
    };
    SCENES.into_iter().flat_map(of).collect()
}

pub(super) fn table(runs: &Runs) -> Item {
    let rows = plans().into_iter().map(|plan| {
        let Solved { scene, options, run, seconds, .. } = runs.of(&plan);
        let pairs = |run: &Solved| run.run.counters.interactions as f64;
        let sph = runs.get(&scene.name, ParticleMethod::Sph1);
        let method = options.method.name();
        let blocks = options.sharing != StepSharing::Global;
        cells![
            scene.name,
            if blocks { format!("{method}, block steps") } else { method.into() },
            run.profile.len(),
            run.steps,
            run.counters.evaluations,
            run.counters.interactions,
            format!("{:.2}", pairs(runs.of(&plan)) / pairs(sph)),
            significant(*seconds, 3),
            format!("{:.2}", pairs(runs.of(&plan)) / seconds / 1e6),
        ]
    });
    let words = words![
        "levels" = LEVELS,
        "repeats" = REPEATS,
        "settings" = Solved::settings(&MethodOptions::new(ParticleMethod::Gph3)),
    ];
    text().table("particle_cost", words, rows)
}
