//! The runs that figures and tables share.

use super::{Detail, ReportError};
use crate::particle_profile::exact_solution_holds;
use courant_analysis::waves::sweep::{Progress, with_progress};
use courant_simulation::particles::{
    MethodOptions, ParticleMethod, ParticleRun, ParticleScene, run_particles,
};
use rayon::prelude::*;

/// A scene, a method and what came of them.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The scene, with the end time of this run.
    pub scene: ParticleScene,
    /// The method.
    pub options: MethodOptions,
    /// The run.
    pub run: ParticleRun,
}

impl Solved {
    /// Runs a scene with its customary number of particles.
    pub fn new(scene: ParticleScene, options: MethodOptions) -> Self {
        let run = run_particles(&scene, scene.particles, &options)
            .expect("the report's options are in range");
        Self { scene, options, run }
    }

    /// Whether a comparison with the exact solution is fair: the run is complete.
    pub fn has_exact(&self) -> bool {
        self.run.completed()
            && exact_solution_holds(&self.scene, self.scene.end_time, self.run.time)
            && self.run.errors.is_some()
    }

    /// "cubic spline, h = 1.05 spacings" and so on, for captions.
    pub fn settings(options: &MethodOptions) -> String {
        format!(
            "{}, h = {} spacings, step {} of the shortest crossing time h/s, {}",
            options.kernel.title(),
            options.eta,
            options.courant,
            options.integrator.name
        )
    }
}

/// Every scene with every method at the customary settings.
#[derive(Debug, Clone)]
pub struct Runs {
    solved: Vec<Solved>,
}

/// The paper's first snapshot of the sound wave.
pub(super) const EARLY: f64 = 0.2;

/// Scenes beyond the paper's seven are left to the full report: they take four fifths of the work.
fn scenes(detail: Detail) -> Vec<ParticleScene> {
    let mut scenes = ParticleScene::all().to_vec();
    if detail == Detail::Quick {
        scenes.truncate(7);
    }
    scenes
}

fn plans(detail: Detail) -> Vec<(ParticleScene, MethodOptions)> {
    let sound = ParticleScene::named("sound-wave").expect("it is in the list of scenes");
    let early = ParticleScene { end_time: EARLY, ..sound };
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
