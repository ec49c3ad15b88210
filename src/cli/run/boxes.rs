//! Options of the scenes in two and three dimensions.

use super::Arguments;
use super::choices::one;
use crate::cli::numbers::Names;
use crate::cli::{Failure, names, numbers};
use clap::{Args, ValueEnum};
use courant::simulation::field::FieldScene;
use courant::simulation::lattice::Lattice;
use courant::simulation::particles::{ActsOn, MethodOptions, StepSharing};

/// Options of the scenes in boxes alone.
#[derive(Debug, Clone, Args)]
pub struct Options {
    /// Two and three dimensions: how the particles stand at the start: square, hexagonal, cubic, bcc, fcc, hcp (default: the scene's own).
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub lattice: Vec<String>,
    /// Two and three dimensions, sph1 and sph2: what tells shear from compression in the viscosity (default: none).
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub switch: Vec<SwitchName>,
    /// Two and three dimensions: steps in blocks, halved at most N times (default: one step for everybody; needs centred-euler).
    #[arg(long, value_name = "LIST", value_parser = levels)]
    pub levels: Option<Names<usize>>,
}

/// Switches by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SwitchName {
    /// Viscosity between all approaching particles.
    None,
    /// Balsara's factor.
    Balsara,
}

fn levels(text: &str) -> Result<Names<usize>, String> {
    numbers::counts(text, 0, 20)
}

impl Options {
    /// Its options, and whether they were given.
    pub fn given(&self) -> [(&'static str, bool); 3] {
        [
            ("--lattice", !self.lattice.is_empty()),
            ("--switch", !self.switch.is_empty()),
            ("--levels", self.levels.is_some()),
        ]
    }
}

/// Puts what was asked for in the place of what is customary.
pub fn choose(
    arguments: &Arguments,
    scene: &mut FieldScene,
    options: &mut MethodOptions,
) -> Result<(), Failure> {
    let asked = &arguments.boxes;
    if let Some(name) = asked.lattice.first() {
        let fitting = Lattice::ALL.into_iter().filter(|l| l.dimension() == scene.dimension);
        let known: Vec<&str> = fitting.clone().map(Lattice::name).collect();
        let problem = || names::unknown(&format!("lattice for {}", scene.name), name, &known);
        scene.lattice = fitting
            .clone()
            .find(|lattice| lattice.name() == name)
            .ok_or_else(|| Failure::Message(format!("--lattice {name}: {}", problem())))?;
    }
    if asked.switch.contains(&SwitchName::Balsara) {
        if options.method.is_godunov() {
            return Err(Failure::Message(format!(
                "--switch balsara: {} has no artificial viscosity; it belongs to sph1 and sph2",
                options.method.name()
            )));
        }
        options.viscosity.acts_on = ActsOn::Compressing;
    }
    if let Some(levels) = one(&asked.levels) {
        options.sharing = StepSharing::Block { levels: *levels as u32 };
    }
    Ok(())
}
