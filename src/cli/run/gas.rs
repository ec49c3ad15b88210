//! Scenes and methods of the gas family.

use super::{Arguments, Entry, Family};
use crate::cli::{Failure, Outcome};

pub const FAMILY: Family = Family { scenes, methods, run };

fn scenes() -> Vec<Entry> {
    Vec::new()
}

fn methods() -> Vec<Entry> {
    Vec::new()
}

fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    Err(Failure::Message(format!("SCENE {}: there is no such scene here", arguments.scene)))
}
