//! What a run costs, in seconds and in work that does not depend on the machine.

use super::runs::Solved;
use super::{COMMAND, Detail};
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_simulation::method::Method;
use courant_simulation::particles::{MethodOptions, ParticleMethod, StepSharing};
use courant_simulation::run::Run;
use courant_simulation::scene::Scene;
use std::time::Instant;

/// The cost of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Cost {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: ParticleMethod,
    /// Whether particles have steps of their own.
    pub block_steps: bool,
    /// Number of particles.
    pub particles: usize,
    /// The shortest of five times on one thread, in seconds.
    pub seconds: f64,
    /// Steps; with block steps, substeps.
    pub steps: u64,
    /// Searches for neighbours, each with an evaluation of the forces.
    pub searches: u64,
    /// Forces between two particles.
    pub interactions: u64,
}

const SCENES: [&str; 2] = ["sod-sph", "isothermal-tube"];
const REPEATS: usize = 5;
const LEVELS: u32 = 6;

/// The run and the seconds it took on one thread.
pub(super) fn timed(scene: &Scene, particles: usize, options: &MethodOptions) -> (Run, f64) {
    // A pool of one thread: the seconds of a wall clock are then those of a processor.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let work = || {
        let start = Instant::now();
        let run = Method::Particles(*options)
            .run(scene, particles)
            .expect("the report's options are in range");
        (run, start.elapsed().as_secs_f64())
    };
    match pool {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

/// Times every method, and the Godunov methods with block steps too, one after the other.
pub fn costs(detail: Detail) -> Vec<Cost> {
    let mut costs = Vec::new();
    for name in SCENES {
        let scene = Scene::named(name).expect("it is in the list of scenes");
        let particles = match detail {
            Detail::Full => scene.particles,
            Detail::Quick => 100,
        };
        let customary = ParticleMethod::ALL.map(MethodOptions::new);
        let blocks =
            customary.into_iter().filter(|options| options.method.is_godunov()).map(|options| {
                MethodOptions { sharing: StepSharing::Block { levels: LEVELS }, ..options }
            });
        let plans: Vec<MethodOptions> = customary.into_iter().chain(blocks).collect();
        let mut seconds = vec![f64::INFINITY; plans.len()];
        // In turn, so that whatever else the machine does meets all of them.
        for _ in 1..REPEATS {
            for (best, options) in seconds.iter_mut().zip(&plans) {
                *best = best.min(timed(&scene, particles, options).1);
            }
        }
        for (best, options) in seconds.into_iter().zip(plans) {
            let (run, last) = timed(&scene, particles, &options);
            let seconds = best.min(last);
            costs.push(Cost {
                scene: scene.name.clone(),
                method: options.method,
                block_steps: options.sharing != StepSharing::Global,
                particles: run.profile.len(),
                seconds,
                steps: run.steps as u64,
                searches: run.counters.evaluations,
                interactions: run.counters.interactions,
            });
        }
    }
    costs
}

/// The cost of a method on a scene.
pub(super) fn cost<'a>(costs: &'a [Cost], scene: &str, method: ParticleMethod) -> &'a Cost {
    costs
        .iter()
        .find(|cost| cost.scene == scene && cost.method == method && !cost.block_steps)
        .expect("every method is timed on both scenes")
}

pub(super) fn items(costs: &[Cost]) -> Vec<Item> {
    let mut table = Table::new(
        format!(
            "What a run costs, one thread, the shortest of {REPEATS} times; every step is 0.5 of the shortest crossing \
             time. Over SPH 1: the ratio to SPH 1 on the same scene. Block steps: particles step by halves of a common step, at \
             most {LEVELS} times halved; neighbours are searched for everybody in every substep. GPH: {}.",
            Solved::settings(&MethodOptions::new(ParticleMethod::Gph3))
        ),
        &[
            ("scene", Align::Left),
            ("method", Align::Left),
            ("N", Align::Right),
            ("steps", Align::Right),
            ("searches", Align::Right),
            ("pair interactions", Align::Right),
            ("over SPH 1", Align::Right),
            ("seconds", Align::Right),
            ("over SPH 1", Align::Right),
            ("million pairs/s", Align::Right),
        ],
    );
    for entry in costs {
        let sph = cost(costs, &entry.scene, ParticleMethod::Sph1);
        let method = entry.method.name();
        table.push([
            entry.scene.to_string(),
            if entry.block_steps { format!("{method}, block steps") } else { method.into() },
            entry.particles.to_string(),
            entry.steps.to_string(),
            entry.searches.to_string(),
            entry.interactions.to_string(),
            format!("{:.2}", entry.interactions as f64 / sph.interactions as f64),
            significant(entry.seconds, 3),
            format!("{:.2}", entry.seconds / sph.seconds),
            format!("{:.2}", entry.interactions as f64 / entry.seconds / 1e6),
        ]);
    }
    vec![Item::Table { name: "particle_cost".into(), table, command: COMMAND.into() }]
}
