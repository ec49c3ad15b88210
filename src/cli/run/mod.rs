//! `courant run`: one scene, one method.

mod advection;
mod choices;
mod clouds;
mod fields;
mod gas;
mod particle_options;

use super::output::Format;
use super::{Failure, Outcome, names, numbers};
use clap::Args;
use courant::analysis::exact::rational::Rational;
use courant::analysis::kernel::Kernel;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Arguments {
    /// Scene: see `courant list scenes`.
    scene: String,
    /// Method: see `courant list methods`; advection and gases have their own. Advection scenes take godunov-sph
    /// if none is given, a scene from a file what the file says; for the others it is required.
    #[arg(long)]
    method: Option<String>,
    /// Number of particles (default: the scene's own).
    #[arg(long, value_name = "N", value_parser = numbers::particles)]
    particles: Option<usize>,
    /// Kernel: see `courant list kernels` (default: the method's own).
    #[arg(long, value_parser = names::kernel)]
    kernel: Option<Kernel>,
    /// Smoothing length over particle spacing (default: the method's own).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio)]
    ratio: Option<Rational>,
    /// Courant number (default: the method's own).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::running_courant_number)]
    cfl: Option<Rational>,
    /// End time (default: the scene's own).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::running_positive)]
    time: Option<Rational>,
    #[command(flatten)]
    choices: choices::Choices,
    #[command(flatten)]
    advection: advection::Options,
    #[command(flatten)]
    fields: fields::Options,
    /// Directory for profile and figure.
    #[arg(long, default_value = "courant-out")]
    out: PathBuf,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
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

/// A family of scenes and the methods that run them.
struct Family {
    scenes: fn() -> Vec<Entry>,
    methods: fn() -> Vec<Entry>,
    run: fn(&Arguments) -> Result<Outcome, Failure>,
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

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let family = FAMILIES
        .iter()
        .find(|family| (family.scenes)().iter().any(|scene| scene.name == arguments.scene))
        .or(arguments.scene.ends_with(".toml").then_some(&gas::FAMILY));
    match family {
        Some(family) => {
            if !advection::has_scene(&arguments.scene) {
                arguments.advection.reject(&arguments.scene)?;
            }
            if !fields::has_scene(&arguments.scene) {
                arguments.fields.reject(&arguments.scene)?;
            }
            (family.run)(arguments)
        }
        None => {
            let scenes: Vec<&str> = scenes().iter().map(|scene| scene.name).collect();
            let problem = names::unknown("scene", &arguments.scene, &scenes);
            Err(Failure::Message(format!("SCENE {}: {problem}", arguments.scene)))
        }
    }
}
