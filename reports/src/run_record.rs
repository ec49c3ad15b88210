//! A run as the JSON object that scripts rely on: `courant.run/1`.

use crate::figure::Figure;
use crate::number::{finite, significant};
use courant_simulation::advection::AdvectionScheme;
use courant_simulation::method::Method;
use courant_simulation::run::{Conservation, Run};
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Error norms `Σ|e_i|/N` over the particles inside the scene's comparison window; a variable the scene
/// does not have is `null`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct ErrorNorms {
    /// The advected quantity of an advection scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Density.
    pub density: Option<f64>,
    /// Velocity.
    pub velocity: Option<f64>,
    /// Pressure.
    pub pressure: Option<f64>,
    /// Specific internal energy.
    pub energy: Option<f64>,
}

impl ErrorNorms {
    /// Whether all four norms of a gas are there.
    pub fn is_complete(&self) -> bool {
        [self.density, self.velocity, self.pressure, self.energy].iter().all(Option::is_some)
    }
}

/// Relative change of a total over the run; `null` where the scene has no such total.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct ConservationRecord {
    /// Mass, or the mean of an advected quantity.
    pub mass: Option<f64>,
    /// Momentum.
    pub momentum: Option<f64>,
    /// Total energy.
    pub energy: Option<f64>,
}

impl ConservationRecord {
    /// Whether all three drifts are there.
    pub fn is_complete(&self) -> bool {
        [self.mass, self.momentum, self.energy].iter().all(Option::is_some)
    }
}

/// Why a run that did not reach its end has no norms.
pub const BROKEN: &str = "the run broke down";

/// One run.
///
/// What follows the keys of every run is what this scene and this method have: `dimension`, `eos`, `kernel`, `ratio`, `cfl`, …
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunRecord {
    /// The scene's name.
    pub scene: String,
    /// The method's name.
    pub method: String,
    /// How many particles or cells.
    pub particles: usize,
    /// Time steps taken.
    pub steps: usize,
    /// Steps that broke and were repeated with half their length.
    pub rejected_steps: usize,
    /// The time reached.
    pub time: f64,
    /// Whether the end time was reached.
    pub completed: bool,
    /// Why not.
    pub failure: Option<String>,
    /// What the user should know before believing the numbers.
    pub warnings: Vec<String>,
    /// Error norms.
    pub l1: ErrorNorms,
    /// Why norms are `null`, where some are.
    pub l1_note: Option<String>,
    /// Drift of the conserved totals.
    pub conservation: ConservationRecord,
    /// Why drifts are `null`, where some are.
    pub conservation_note: Option<String>,
    /// Wall-clock time of the stepping in seconds.
    pub wall_seconds: f64,
    /// What the scene is judged by.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub measures: BTreeMap<&'static str, Option<f64>>,
    /// What scene and method were set to, and the work, where they have it.
    #[serde(flatten)]
    pub more: Map<String, Value>,
}

/// Why an isothermal gas has no norm and no drift of the energy.
pub const NO_ENERGY: &str = "an isothermal gas has no energy equation";

impl From<&Conservation> for ConservationRecord {
    fn from(drift: &Conservation) -> Self {
        Self {
            mass: finite(drift.mass),
            momentum: finite(drift.momentum),
            energy: drift.energy.and_then(finite),
        }
    }
}

impl RunRecord {
    /// The record of a run, without norms: `l1_note` says why, where it did not break down.
    pub fn new<P>(
        [scene, method]: [&str; 2],
        particles: usize,
        run: &Run<P>,
        l1_note: &str,
        wall_seconds: f64,
    ) -> Self {
        let conservation = ConservationRecord::from(&run.conservation);
        let conservation_note = match run.conservation.energy {
            _ if conservation.is_complete() => None,
            None if run.completed() => Some(NO_ENERGY.into()),
            _ => Some(BROKEN.into()),
        };
        Self {
            scene: scene.into(),
            method: method.into(),
            particles,
            steps: run.steps,
            rejected_steps: run.rejected,
            time: run.time,
            completed: run.completed(),
            failure: run.failure.map(|failure| failure.to_string()),
            warnings: run.warnings.clone(),
            l1: ErrorNorms::default(),
            l1_note: Some(if run.completed() { l1_note } else { BROKEN }.into()),
            conservation,
            conservation_note,
            wall_seconds,
            measures: BTreeMap::new(),
            more: Map::new(),
        }
    }

    /// Adds what helps against the failure.
    pub fn advise(&mut self, advice: Option<&str>) {
        if let (Some(failure), Some(advice)) = (&mut self.failure, advice) {
            *failure = format!("{failure}; {advice}");
        }
    }

    /// Adds a setting or a count; numbers that are not finite are `null`.
    pub fn set(&mut self, key: &str, value: impl Into<Value>) {
        self.more.insert(key.into(), value.into());
    }

    /// Names and values for people: all but the words of scene and method.
    pub fn rows(&self) -> Vec<[String; 2]> {
        let mut rows = Vec::new();
        let mut add = |name: &str, value: String| rows.push([name.replace('_', " "), value]);
        let number = |value: Option<f64>, digits| {
            value.map_or_else(|| "–".to_string(), |value| significant(value, digits))
        };
        add("completed", if self.completed { "yes" } else { "no" }.into());
        if let Some(failure) = &self.failure {
            add("failure", failure.clone());
        }
        add("particles", self.particles.to_string());
        for (key, value) in &self.more {
            match value {
                Value::String(text) => add(key, text.clone()),
                Value::Number(value) if value.is_f64() => add(key, number(value.as_f64(), 6)),
                Value::Number(value) => add(key, value.to_string()),
                _ => add(key, "–".into()),
            }
        }
        add("time", significant(self.time, 6));
        add("steps", self.steps.to_string());
        if self.rejected_steps > 0 {
            add("steps repeated with half", self.rejected_steps.to_string());
        }
        for (name, value) in &self.measures {
            add(name, number(*value, 4));
        }
        let l1 = &self.l1;
        for (name, value) in [
            ("L1 error", l1.value),
            ("L1 density", l1.density),
            ("L1 velocity", l1.velocity),
            ("L1 pressure", l1.pressure),
            ("L1 internal energy", l1.energy),
        ] {
            if value.is_some() {
                add(name, number(value, 5));
            }
        }
        if let Some(note) = &self.l1_note {
            add("no L1", note.clone());
        }
        let drift = &self.conservation;
        add("drift of mass", number(drift.mass, 3));
        if drift.momentum.is_some() || drift.energy.is_some() {
            add("drift of momentum", number(drift.momentum, 3));
            add("drift of energy", number(drift.energy, 3));
        }
        add("seconds", significant(self.wall_seconds, 3));
        rows
    }
}

/// The name of a method for people, and the one to type.
pub fn method_title(name: &str) -> String {
    let title = Method::named(name).map(|method| method.title());
    match title.or(name.parse().ok().map(AdvectionScheme::title)) {
        Some(title) => format!("{title} ({name})"),
        None => name.into(),
    }
}

/// A run for its user: the record, and what is written beside it.
#[derive(Debug)]
pub struct RunReport {
    /// The record.
    pub record: RunRecord,
    /// Scene, method and settings in words.
    pub caption: String,
    /// The ends of file names, with the dot, and what is in the files.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// The picture, if there is one to draw.
    pub figure: Option<Figure>,
}
