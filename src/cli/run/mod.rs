//! `courant run`: scenes with methods, one run for each combination of the lists.

mod advection;
mod answer;
mod cases;
mod choices;
mod clouds;
mod fields;
mod gas;
mod particle_options;

use super::numbers::{Names, Numbers};
use super::output::Format;
use super::{Failure, Outcome, names, numbers};
use answer::Answer;
use choices::one;
use clap::Args;
use courant::analysis::exact::rational::Rational;
use courant::analysis::kernel::Kernel;
use courant::reports::publish::OutputDirectory;
use std::path::PathBuf;

/// All options but `--out` and `--format` take lists; in a case each has one value.
#[derive(Debug, Clone, Args)]
pub struct Arguments {
    /// Scenes: see `courant list scenes`.
    #[arg(num_args = 1, required = true, value_delimiter = ',')]
    scene: Vec<String>,
    /// Methods: see `courant list methods`; advection and gases have their own. Advection scenes take godunov-sph
    /// if none is given, a scene from a file what the file says; for the others it is required.
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
    fields: fields::Options,
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

/// A run that was judged and can start.
type Start = Box<dyn FnOnce() -> Result<Answer, Failure>>;

/// A family of scenes and the methods that run them.
struct Family {
    scenes: fn() -> Vec<Entry>,
    methods: fn() -> Vec<Entry>,
    /// Judges the arguments of one case.
    plan: fn(Arguments) -> Result<Start, Failure>,
}

const FAMILIES: [Family; 4] = [advection::FAMILY, gas::FAMILY, fields::FAMILY, clouds::FAMILY];

/// Every scene.
pub fn scenes() -> Vec<Entry> {
    FAMILIES.iter().flat_map(|family| (family.scenes)()).collect()
}

/// Every method.
pub fn methods() -> Vec<Entry> {
    FAMILIES.iter().flat_map(|family| (family.methods)()).collect()
}

/// What to say of a method that does not run a scene: which scenes it runs, or what else it is, or which name is near.
fn no_method(name: &str, scene: &str, accepted: &[&str]) -> Failure {
    let names = |entries: Vec<Entry>| entries.into_iter().map(|entry| entry.name);
    let other = FAMILIES.iter().find(|family| names((family.methods)()).any(|known| known == name));
    let all = accepted.join(", ");
    let problem = match other {
        Some(family) => {
            let scenes: Vec<&str> = names((family.scenes)()).collect();
            format!("it does not run {scene} but {}; accepted: {all}", scenes.join(", "))
        }
        None => match names::elsewhere(name, None) {
            Some(what) => format!("{what}, and runs no scene; accepted: {all}"),
            None => names::unknown(&format!("method for {scene}"), name, accepted),
        },
    };
    Failure::Message(format!("--method {name}: {problem}"))
}

/// Judges one case.
fn plan(arguments: Arguments) -> Result<Start, Failure> {
    let scene = arguments.scene();
    let family = FAMILIES
        .iter()
        .find(|family| (family.scenes)().iter().any(|known| known.name == scene))
        .or(scene.ends_with(".toml").then_some(&gas::FAMILY));
    let Some(family) = family else {
        let scenes: Vec<&str> = scenes().iter().map(|scene| scene.name).collect();
        let problem = names::unknown("scene", scene, &scenes);
        return Err(Failure::Message(format!("SCENE {scene}: {problem}")));
    };
    if !advection::has_scene(scene) {
        arguments.advection.reject(scene)?;
    }
    if !fields::has_scene(scene) {
        arguments.fields.reject(scene)?;
    }
    (family.plan)(arguments)
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let cases = cases::all(arguments)?;
    // All are judged before one runs.
    let starts: Vec<Start> =
        cases.iter().map(|case| plan(case.arguments.clone())).collect::<Result<_, _>>()?;
    let output = OutputDirectory::open(&arguments.out)?;
    let mut answers = Vec::new();
    for (case, start) in cases.iter().zip(starts) {
        let mut answer = start()?;
        answer.choices = case.choices.clone();
        answer.write(&output)?;
        answers.push(answer);
    }
    answer::show(&answers, arguments.format)?;
    let completed = answers.iter().all(|answer| answer.record.run().completed);
    Ok(if completed { Outcome::Yes } else { Outcome::No })
}
