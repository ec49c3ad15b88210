//! The scene that was asked for: a named one or a file.

use super::Arguments;
use super::methods;
use crate::cli::{Failure, names};
use courant::analysis::exact::rational::to_f64;
use courant::simulation::scene::{AnyScene, KEYS};
use std::path::Path;

/// The scene, with the end time that was asked for.
pub fn load(arguments: &Arguments) -> Result<AnyScene, Failure> {
    let name = arguments.scene();
    let mut scene = if name.ends_with(".toml") {
        read(name)?
    } else {
        let known: Vec<&str> = AnyScene::all().iter().map(AnyScene::name).collect();
        let problem = || format!("{}, or a file NAME.toml", names::unknown("scene", name, &known));
        AnyScene::named(name)
            .ok_or_else(|| Failure::Message(format!("SCENE {name}: {}", problem())))?
    };
    if let Some(time) = arguments.time() {
        scene.set_end_time(to_f64(time));
    }
    Ok(scene)
}

/// Reads a file; every complaint names file, line and what is accepted.
fn read(path: &str) -> Result<AnyScene, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        Failure::Message(format!("SCENE {path}: {error}; accepted: a TOML file with {KEYS}"))
    })?;
    let stem = Path::new(path).file_stem().map_or("scene".into(), |stem| stem.to_string_lossy());
    let scene = AnyScene::parse(&text, &stem).map_err(|error| {
        let problem = names::misspelt_key(&error.problem);
        Failure::Message(format!("SCENE {path}, line {}: {problem}", error.line))
    })?;
    let accepted = methods::of(&scene);
    if let Some(method) = scene.method()
        && !accepted.contains(&method)
    {
        let line =
            1 + text.lines().take_while(|line| !line.trim_start().starts_with("method")).count();
        let problem = names::unknown(&format!("method for {}", scene.kind()), method, &accepted);
        return Err(Failure::Message(format!(
            "SCENE {path}, line {line}: method = \"{method}\": {problem}"
        )));
    }
    Ok(scene)
}
