//! The runs that figures and tables share.

use super::{Detail, ReportError};
use crate::gas_run::particle_settings;
use courant_analysis::waves::sweep::{Progress, with_progress};
use courant_simulation::comparison::{Columns, Comparison};
use courant_simulation::method::Method;
use courant_simulation::particles::{MethodOptions, ParticleMethod};
use courant_simulation::run::Run;
use courant_simulation::scene::Scene;
use rayon::prelude::*;

/// A scene, a method and what came of them.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The scene, with the end time of this run.
    pub scene: Scene,
    /// The method.
    pub options: MethodOptions,
    /// The run.
    pub run: Run,
    /// Its errors, if it is complete and the scene has an exact solution.
    pub errors: Option<Columns<f64>>,
}

impl Solved {
    /// Runs a scene with its customary number of particles.
    pub fn new(scene: Scene, options: MethodOptions) -> Self {
        let run = Method::Particles(options)
            .run(&scene, scene.particles)
            .expect("the report's options are in range");
        let errors = errors(&scene, &run);
        Self { scene, options, run, errors }
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

/// The errors of a run that is complete.
pub(super) fn errors(scene: &Scene, run: &Run) -> Option<Columns<f64>> {
    let comparison = Comparison::new(scene, run).filter(|_| run.completed());
    comparison.map(|comparison| comparison.l1)
}

/// Every scene with every method at the customary settings.
#[derive(Debug, Clone)]
pub struct Runs {
    solved: Vec<Solved>,
}

/// The paper's first snapshot of the sound wave.
pub(super) const EARLY: f64 = 0.2;

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

/// Scenes beyond the paper's seven are left to the full report: they take four fifths of the work.
fn scenes(detail: Detail) -> Vec<Scene> {
    let names = match detail {
        Detail::Quick => &SCENES[..7],
        Detail::Full => &SCENES,
    };
    let named = |name: &&str| Scene::named(name).expect("it is in the list of scenes");
    names.iter().map(named).collect()
}

fn plans(detail: Detail) -> Vec<(Scene, MethodOptions)> {
    let sound = Scene::named("sound-wave").expect("it is in the list of scenes");
    let early = Scene { end_time: EARLY, ..sound };
    scenes(detail)
        .into_iter()
        .chain([early])
        .flat_map(|scene| {
            ParticleMethod::ALL.map(|method| (scene.clone(), MethodOptions::new(method)))
        })
        .collect()
}

impl Runs {
    /// How many there are.
    pub fn count(detail: Detail) -> usize {
        (scenes(detail).len() + 1) * ParticleMethod::ALL.len()
    }

    /// Runs them all, several at a time.
    ///
    /// # Errors
    /// When the callback stops the work.
    pub fn compute(detail: Detail, progress: Progress<'_>) -> Result<Self, ReportError> {
        // The longest first: the hard scenes are last in the list.
        let plans = plans(detail).into_par_iter().rev().with_max_len(1);
        let mut solved =
            with_progress(plans, progress, |(scene, options)| Ok(Solved::new(scene, options)))?;
        solved.reverse();
        Ok(Self { solved })
    }

    /// All of them, by scene and then by method; the early snapshots of the sound wave last.
    pub fn all(&self) -> &[Solved] {
        &self.solved
    }

    /// The runs to their customary end times.
    pub fn to_the_end(&self) -> impl Iterator<Item = &Solved> {
        self.solved.iter().filter(|s| s.scene.name != "sound-wave" || s.scene.end_time > EARLY)
    }

    /// One run to its customary end time.
    ///
    /// # Panics
    /// When the scene is not part of the report at this detail.
    pub fn get(&self, scene: &str, method: ParticleMethod) -> &Solved {
        self.to_the_end()
            .find(|s| s.scene.name == scene && s.options.method == method)
            .expect("the paper's scenes are always run")
    }

    /// The sound wave before it reaches the walls.
    pub fn early(&self, method: ParticleMethod) -> &Solved {
        self.solved
            .iter()
            .find(|s| s.scene.end_time == EARLY && s.options.method == method)
            .expect("the early snapshots are always run")
    }
}
