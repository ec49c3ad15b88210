//! `courant run`: scenes with methods, one run for each combination of the lists.

mod advection;
mod answer;
mod boxes;
mod cases;
mod choices;
mod methods;
mod particle_options;
mod plan;
mod scene;

pub use methods::all as methods;

use super::numbers::{Names, Numbers};
use super::output::Format;
use super::progress::Bar;
use super::{Failure, Outcome, complain, names, numbers};
use answer::Answer;
use choices::one;
use clap::Args;
use courant::analysis::exact::rational::Rational;
use courant::analysis::kernel::Kernel;
use courant::reports::publish::OutputDirectory;
use courant::simulation::scene::AnyScene;
use plan::Plan;
use std::path::PathBuf;

/// All options but `--out` and `--format` take lists; in a case each has one value.
#[derive(Debug, Clone, Args)]
pub struct Arguments {
    /// Scenes: see `courant list scenes`; or files NAME.toml of your own.
    #[arg(num_args = 1, required = true, value_delimiter = ',')]
    scene: Vec<String>,
    /// Methods: see `courant list methods`; advection and gases have their own. Without it the method is what the file
    /// of the scene says (advection scenes: godunov-sph); where it says none it is required.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    method: Vec<String>,
    /// Numbers of particles (default: the scene's own).
    #[arg(long, value_name = "LIST", value_parser = numbers::particles)]
    particles: Option<Names<usize>>,
    /// Kernels: see `courant list kernels` (default: the method's own).
    #[arg(long, value_name = "NAMES", value_parser = |text: &str| numbers::names(text, names::kernel))]
    kernel: Option<Names<Kernel>>,
    /// Smoothing lengths over particle spacing (default: the method's own).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = numbers::ratio_list)]
    ratio: Option<Numbers>,
    /// Courant numbers (default: the method's own).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = numbers::running_courant_numbers)]
    cfl: Option<Numbers>,
    /// End times (default: the scene's own).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = numbers::running_positive)]
    time: Option<Numbers>,
    #[command(flatten)]
    choices: choices::Choices,
    #[command(flatten)]
    advection: advection::Options,
    #[command(flatten)]
    boxes: boxes::Options,
    /// Directory for profiles and figures.
    #[arg(long, default_value = "courant-out")]
    out: PathBuf,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// The values of a case.
impl Arguments {
    fn scene(&self) -> &str {
        &self.scene[0]
    }

    fn method(&self) -> Option<&str> {
        self.method.first().map(String::as_str)
    }

    fn particles(&self) -> Option<usize> {
        one(&self.particles).copied()
    }

    fn kernel(&self) -> Option<Kernel> {
        one(&self.kernel).copied()
    }

    fn ratio(&self) -> Option<&Rational> {
        one(&self.ratio)
    }

    fn cfl(&self) -> Option<&Rational> {
        one(&self.cfl)
    }

    fn time(&self) -> Option<&Rational> {
        one(&self.time)
    }
}

/// A scene or method, for listing.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The name on the command line.
    pub name: &'static str,
    /// What it is.
    pub description: &'static str,
    /// Where it comes from.
    pub source: &'static str,
}

/// Every scene.
pub fn scenes() -> Vec<Entry> {
    let own = Entry {
        name: "FILE.toml",
        description: "a scene of your own, in the format of these; a bad file is answered with the keys it needs",
        source: "docs/scenes.md",
    };
    let entry = |scene: &'static AnyScene| Entry {
        name: scene.name(),
        description: scene.description(),
        source: scene.source(),
    };
    AnyScene::all().iter().map(entry).chain([own]).collect()
}

/// Runs one case.
fn answer(arguments: &Arguments, plan: &Plan) -> Result<Answer, Failure> {
    // Said before it starts: the user may stop it.
    let beyond = plan.beyond_limit(arguments);
    if let Some(warning) = &beyond {
        complain(&format!("warning: {warning}\n"));
    }
    let (scene, end_time) = plan.scene();
    let bar = Bar::new(scene);
    let mut report = plan.run(arguments, |time| bar.march(time, end_time))?;
    bar.finish();
    report.record.warnings.extend(beyond);
    Answer::new(report)
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let cases = cases::all(arguments)?;
    // All are judged before one runs.
    let plan = |case: &cases::Case| Plan::new(&case.arguments, scene::load(&case.arguments)?);
    let plans: Vec<Plan> = cases.iter().map(plan).collect::<Result<_, _>>()?;
    let output = OutputDirectory::open(&arguments.out)?;
    let mut answers = Vec::new();
    for (case, plan) in cases.iter().zip(plans) {
        let mut answer = answer(&case.arguments, &plan)?;
        answer.choices = case.choices.clone();
        answer.write(&output)?;
        answers.push(answer);
    }
    answer::show(&answers, arguments.format)?;
    let completed = answers.iter().all(|answer| answer.record.completed);
    Ok(if completed { Outcome::Yes } else { Outcome::No })
}
