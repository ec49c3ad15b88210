//! The runs that figures and tables share: each is made once.

use super::{collision, cost, efficiency, rarefied_contact};
use crate::gas_run::particle_settings;
use crate::report::Detail;
use crate::timing::timed;
use courant_simulation::comparison::{Columns, Comparison};
use courant_simulation::method::Method;
use courant_simulation::particles::{MethodOptions, ParticleMethod};
use courant_simulation::run::Run;
use courant_simulation::scene::Scene;
use rayon::prelude::*;

/// A scene with its number of particles and its end time, and a method with its options.
pub type Plan = (Scene, MethodOptions);

/// A scene, a method and what came of them.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The scene, with the end time and the number of particles of this run.
    pub scene: Scene,
    /// The method.
    pub options: MethodOptions,
    /// The run.
    pub run: Run,
    /// Its errors, if it is complete and the scene has an exact solution.
    pub errors: Option<Columns<f64>>,
    /// The seconds it took on one thread.
    pub seconds: f64,
}

impl Solved {
    fn new((scene, options): Plan, repeats: usize) -> Self {
        let solve = || timed(|| Method::Particles(options).run(&scene, scene.particles));
        let (run, first) = solve();
        let seconds = (1..repeats).map(|_| solve().1).fold(first, f64::min);
        let run = run.expect("the report's options are in range");
        let comparison = Comparison::new(&scene, &run).filter(|_| run.completed());
        let errors = comparison.map(|comparison| comparison.l1);
        Self { scene, options, run, errors, seconds }
    }

    /// `Σ|e|/N` of the density; `None` if the run broke down.
    pub fn density_error(&self) -> Option<f64> {
        self.errors.as_ref().map(|errors| errors.density)
    }

    /// Whether a comparison with the exact solution is fair: the run is complete.
    pub fn has_exact(&self) -> bool {
        self.errors.is_some()
    }

    /// "cubic spline, h = 1.05 spacings" and so on, for captions.
    pub fn settings(options: &MethodOptions) -> String {
        particle_settings(options)
    }
}

/// The paper's first snapshot of the sound wave.
pub(super) const EARLY: f64 = 0.2;

pub(super) fn scene(name: &str) -> Scene {
    Scene::named(name).expect("it is in the list of scenes")
}

/// Every method with its customary options on a scene.
pub(super) fn every_method(scene: &Scene) -> [Plan; 6] {
    ParticleMethod::ALL.map(|method| (scene.clone(), MethodOptions::new(method)))
}

/// The scenes of the paper in its order, and two harder ones.
const SCENES: [&str; 9] = [
    "sound-wave",
    "sod-sph",
    "strong-blast",
    "isothermal-tube",
    "sjogreen",
    "collision-subsonic",
    "collision-supersonic",
    "noh",
    "woodward-colella",
];

/// Scenes beyond the paper's seven are left out of a quick report: they take four fifths of the work.
fn customary(detail: Detail) -> Vec<Plan> {
    let count = if detail == Detail::Quick { 7 } else { SCENES.len() };
    SCENES[..count].iter().flat_map(|name| every_method(&scene(name))).collect()
}

/// Every run of the report, each once.
#[derive(Debug, Clone)]
pub struct Runs {
    solved: Vec<Solved>,
    customary: usize,
}

impl Runs {
    /// Runs them all, several at a time.
    pub fn compute(detail: Detail) -> Self {
        let mut plans = customary(detail);
        let customary = plans.len();
        let early = Scene { end_time: EARLY, ..scene("sound-wave") };
        let others = every_method(&early)
            .into_iter()
            .chain(cost::plans())
            .chain(efficiency::plans(detail))
            .chain(rarefied_contact::plans(detail))
            .chain(collision::plans());
        for plan in others {
            if !plans.contains(&plan) {
                plans.push(plan);
            }
        }
        let timed = cost::plans();
        let repeats = |plan: &Plan| if timed.contains(plan) { cost::REPEATS } else { 1 };
        let solve = |plan: Plan| {
            let repeats = repeats(&plan);
            Solved::new(plan, repeats)
        };
        // The long ones first, so that none is left alone at the end: their place is kept with them.
        let mut plans: Vec<(usize, Plan)> = plans.into_iter().enumerate().collect();
        plans.sort_by_key(|(_, (scene, _))| std::cmp::Reverse(scene.particles));
        let mut solved: Vec<(usize, Solved)> = plans
            .into_par_iter()
            .with_max_len(1)
            .map(|(place, plan)| (place, solve(plan)))
            .collect();
        solved.sort_by_key(|(place, _)| *place);
        Self { solved: solved.into_iter().map(|(_, solved)| solved).collect(), customary }
    }

    /// The runs of every scene by every method with its customary options, by scene and then by method.
    pub fn customary(&self) -> &[Solved] {
        &self.solved[..self.customary]
    }

    /// The run of a plan.
    ///
    /// # Panics
    /// When it is not part of the report at this detail.
    pub fn of(&self, (scene, options): &Plan) -> &Solved {
        let same = |solved: &&Solved| solved.scene == *scene && solved.options == *options;
        self.solved.iter().find(same).expect("every plan of the report is run")
    }

    /// The run of a scene to its customary end time.
    ///
    /// # Panics
    /// As [`of`](Self::of).
    pub fn get(&self, name: &str, method: ParticleMethod) -> &Solved {
        self.of(&(scene(name), MethodOptions::new(method)))
    }

    /// The sound wave before it reaches the walls.
    pub fn early(&self, method: ParticleMethod) -> &Solved {
        let early = Scene { end_time: EARLY, ..scene("sound-wave") };
        self.of(&(early, MethodOptions::new(method)))
    }
}
