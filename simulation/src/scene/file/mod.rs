//! Scenes as TOML: the named ones, and those of a user. One format for all of them; `docs/scenes.md` describes it.
//!
//! ```toml
//! gamma = 1.4               # or: sound_speed = 1.0 for an isothermal gas, which needs no pressures
//! domain = [0.0, 1.0]
//! end_time = 0.2
//!
//! [[layer]]                 # from left to right, each up to its edge
//! to = 0.5
//! density = 1.0
//! velocity = 0.0
//! pressure = 1.0
//!
//! [[layer]]
//! to = 1.0
//! density = { mean = 0.125, amplitude = 0.01, wave_number = 20.0 }
//! velocity = 0.0
//! pressure = 0.1
//! ```

mod advection;
mod cloud;
mod field;
mod line;

use super::quantity::{ACCEPTED, Quantity};
use super::{AnyScene, Material};
use crate::boundary::Boundary;
use crate::gravity::Known;
use crate::lattice::Lattice;
use crate::particles::IsothermalGas;
use crate::riemann::IdealGas;
use line::LayerTable;
use serde::Deserialize;
use toml::Spanned;
use toml::de::DeTable;

/// What a file has to hold, for messages.
pub const KEYS: &str = "gamma (or sound_speed), domain = [from, to], end_time, and the gas at the start: either diaphragm with \
     the tables [left] and [right] or tables [[layer]] with to, each with density, velocity and pressure, or [simple_wave]; in a \
     box, domain = [[from, to], ...] and lattice, one of [shear], [vortex], [blast]; or [sphere] with, if you like, [gravity], \
     [sink], [outside]; or equation = \"advection\" with velocity and [[layer]] with to and value";

/// Why a text is not a scene: the line, counted from 1, and what is wrong there.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct InvalidFile {
    /// The line.
    pub line: usize,
    /// What is wrong.
    pub problem: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    name: Option<String>,
    description: Option<String>,
    source: Option<String>,
    method: Option<Spanned<String>>,
    end_time: Positive,
    particles: Option<Spanned<usize>>,
    equation: Option<Equation>,
    dimension: Option<Spanned<usize>>,
    gamma: Option<Spanned<f64>>,
    sound_speed: Option<Spanned<Positive>>,
    velocity: Option<Spanned<f64>>,
    domain: Option<Spanned<Axes>>,
    boundary: Option<Spanned<Ends>>,
    window: Option<Spanned<[f64; 2]>>,
    constant_smoothing: Option<Spanned<bool>>,
    lattice: Option<Spanned<Lattice>>,
    exact: Option<Spanned<Known>>,
    diaphragm: Option<Spanned<f64>>,
    left: Option<Spanned<line::Side>>,
    right: Option<Spanned<line::Side>>,
    layer: Option<Vec<Spanned<line::LayerTable>>>,
    simple_wave: Option<Spanned<line::WaveTable>>,
    shear: Option<Spanned<field::ShearTable>>,
    vortex: Option<Spanned<field::VortexTable>>,
    blast: Option<Spanned<field::BlastTable>>,
    sphere: Option<Spanned<cloud::SphereTable>>,
    gravity: Option<Spanned<cloud::GravityTable>>,
    sink: Option<Spanned<cloud::SinkTable>>,
    outside: Option<Spanned<cloud::OutsideTable>>,
}

/// A finite number above 0.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "f64")]
struct Positive(f64);

impl TryFrom<f64> for Positive {
    type Error = String;

    fn try_from(number: f64) -> Result<Self, String> {
        match number.is_finite() && number > 0.0 {
            true => Ok(Self(number)),
            false => Err(format!("{number}: a finite number above 0 {NEEDED}")),
        }
    }
}

/// How a complaint of a value ends.
const NEEDED: &str = "is needed";

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Equation {
    Gas,
    Advection,
}

/// An interval, or one for each axis of a box.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Axes {
    Line([f64; 2]),
    Box(Vec<[f64; 2]>),
}

/// A word for all ends, a list for two ends or for each axis.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Ends {
    All(Boundary),
    Each(Vec<Ends>),
}

/// A place in the text, and what is wrong there.
type Problem = (usize, String);

/// What is wrong at a place.
fn wrong<T>(place: usize, problem: impl Into<String>) -> Result<T, Problem> {
    Err((place, problem.into()))
}

/// Whether two numbers are an interval.
fn ascends([from, to]: &[f64; 2]) -> bool {
    from.is_finite() && to.is_finite() && from < to
}

/// What is particular to a kind of scene.
struct Kind {
    name: &'static str,
    /// The keys that it takes beside those of every scene.
    keys: &'static str,
    /// Those by which it is known.
    marks: &'static [&'static str],
    read: fn(&SceneFile, &str) -> Result<AnyScene, Problem>,
}

/// The first one takes `equation = "advection"`.
const KINDS: [Kind; 4] = [
    Kind {
        name: "an advection scene",
        keys: "domain, velocity, layer",
        marks: &[],
        read: |file, name| Ok(AnyScene::Advection(file.advection(name)?)),
    },
    Kind {
        name: "a gas on a line",
        keys: "gamma, sound_speed, domain, boundary, window, constant_smoothing, diaphragm, left, right, layer, simple_wave",
        marks: &["diaphragm", "left", "right", "layer", "simple_wave"],
        read: |file, name| Ok(AnyScene::Line(file.line(name)?)),
    },
    Kind {
        name: "a gas in a box",
        keys: "gamma, sound_speed, domain, boundary, lattice, shear, vortex, blast",
        marks: &["shear", "vortex", "blast"],
        read: |file, name| Ok(AnyScene::Field(file.field(name)?)),
    },
    Kind {
        name: "a sphere",
        keys: "gamma, sound_speed, sphere, gravity, sink, outside, exact",
        marks: &["sphere"],
        read: |file, name| Ok(AnyScene::Cloud(file.cloud(name)?)),
    },
];

/// The keys of every scene.
const COMMON: [&str; 8] =
    ["name", "description", "source", "method", "end_time", "particles", "equation", "dimension"];

impl AnyScene {
    /// A scene from the text of a file; `name` is its name where the file gives none.
    ///
    /// # Errors
    /// [`InvalidFile`] names the line and what is accepted there.
    pub fn parse(text: &str, name: &str) -> Result<Self, InvalidFile> {
        let at = |(offset, problem): Problem| {
            let line = 1 + text[..offset.min(text.len())].matches('\n').count();
            InvalidFile { line, problem }
        };
        let file: SceneFile = toml::from_str(text).map_err(|error| {
            let place = error.span().map_or(0, |span| span.start);
            let before = text.get(..place).unwrap_or_default().lines().last().unwrap_or_default();
            at((place, explain(&error.message().replace('\n', " "), before)))
        })?;
        let table = DeTable::parse(text).expect("it was read just now");
        let given: Vec<(&str, usize)> =
            table.get_ref().keys().map(|key| (&**key.get_ref(), key.span().start)).collect();
        file.scene(name, &given).map_err(at)
    }
}

/// What serde says, with the key and what is accepted.
fn explain(message: &str, before: &str) -> String {
    let untagged = |name: &str| message.contains(&format!("untagged enum {name}"));
    if untagged("Quantity") {
        format!("a quantity is {ACCEPTED}")
    } else if untagged("Axes") {
        "domain: [from, to], or in a box one such pair for each axis, is accepted".into()
    } else if untagged("Ends") {
        "boundary: one word, or one for each end, is accepted: periodic, mirror, transmissive, open"
            .into()
    } else if message.ends_with(NEEDED) {
        format!("{}{message}", before.trim_start_matches(['{', ' ']))
    } else if message.starts_with("unknown ") {
        message.into()
    } else {
        format!("{}; accepted: {KEYS}", message.trim())
    }
}

/// Where a value stands that is there.
fn place<T>(value: &Option<Spanned<T>>) -> usize {
    value.as_ref().map_or(0, |value| value.span().start)
}

impl SceneFile {
    /// The scene, from the keys that are given and where.
    fn scene(&self, name: &str, given: &[(&str, usize)]) -> Result<AnyScene, Problem> {
        let known = |kind: &&Kind| given.iter().any(|(key, _)| kind.marks.contains(key));
        let kind = match self.equation {
            Some(Equation::Advection) => Some(&KINDS[0]),
            Some(Equation::Gas) | None => KINDS.iter().find(known),
        };
        let Some(Kind { name: what, keys, read, .. }) = kind else {
            return wrong(0, format!("the gas at the start is missing; accepted: {KEYS}"));
        };
        let takes = |key: &str| COMMON.contains(&key) || keys.split(", ").any(|known| known == key);
        let others = given.iter().filter(|(key, _)| !takes(key));
        if let Some((key, place)) = others.min_by_key(|(_, place)| place) {
            return wrong(*place, format!("{key}: {what} has no such key; it takes {keys}"));
        }
        let scene = read(self, name)?;
        let dimension = scene.dimension();
        match &self.dimension {
            Some(given) if *given.get_ref() != dimension => {
                let problem = format!("dimension = {}: {what} has {dimension}", given.get_ref());
                wrong(given.span().start, problem)
            }
            _ => Ok(scene),
        }
    }

    /// Name, description, source and method.
    fn words(&self, name: &str) -> [String; 3] {
        [
            self.name.clone().unwrap_or_else(|| name.into()),
            self.description.clone().unwrap_or_default(),
            self.source.clone().unwrap_or_else(|| "a file of your own".into()),
        ]
    }

    fn method(&self) -> Option<String> {
        self.method.as_ref().map(|method| method.get_ref().clone())
    }

    /// The customary number of particles.
    fn particles(&self, usual: usize, least: usize) -> Result<usize, Problem> {
        match self.particles.as_ref().map(|count| *count.get_ref()) {
            Some(count) if count < least => {
                let problem = format!("particles = {count}: at least {least} are needed");
                wrong(place(&self.particles), problem)
            }
            count => Ok(count.unwrap_or(usual)),
        }
    }

    fn material(&self) -> Result<Material, Problem> {
        match (&self.gamma, &self.sound_speed) {
            (Some(gamma), None) => IdealGas::new(*gamma.get_ref())
                .map(Material::Ideal)
                .map_err(|error| (gamma.span().start, error.to_string())),
            (None, Some(speed)) => {
                Ok(Material::Isothermal(IsothermalGas { sound_speed: speed.get_ref().0 }))
            }
            (Some(_), Some(speed)) => {
                let not_both = "a gas has a gamma or, isothermal, a sound_speed, not both";
                wrong(speed.span().start, format!("sound_speed: {not_both}"))
            }
            (None, None) => wrong(0, format!("gamma or sound_speed is missing; accepted: {KEYS}")),
        }
    }

    /// A number that an ideal gas needs, and of which an isothermal one says why it has none of its own but another.
    fn of_ideal(
        &self,
        material: Material,
        key: &str,
        value: &Option<Spanned<Positive>>,
        table: usize,
        isothermal: f64,
        why: &str,
    ) -> Result<f64, Problem> {
        match (material, value) {
            (Material::Isothermal(_), None) => Ok(isothermal),
            (Material::Isothermal(_), Some(own)) => {
                wrong(own.span().start, format!("{key}: {why}"))
            }
            (Material::Ideal(_), Some(own)) => Ok(own.get_ref().0),
            (Material::Ideal(_), None) => {
                wrong(table, format!("{key} is missing: only an isothermal gas needs none"))
            }
        }
    }

    /// The interval of a scene on a line.
    fn interval(&self) -> Result<[f64; 2], Problem> {
        let here = place(&self.domain);
        match self.domain.as_ref().map(Spanned::get_ref) {
            None => wrong(0, format!("domain is missing; accepted: {KEYS}")),
            Some(Axes::Line(ends)) if ascends(ends) => Ok(*ends),
            Some(Axes::Line(ends)) => {
                let needed = "two ascending finite numbers are needed";
                wrong(here, format!("domain = {ends:?}: {needed}"))
            }
            Some(Axes::Box(_)) => {
                wrong(here, "domain: on a line, one interval [from, to] is needed")
            }
        }
    }

    /// The tables [[layer]], each up to its edge and the last one up to the end.
    fn layers(&self, [from, to]: [f64; 2]) -> Result<Vec<&LayerTable>, Problem> {
        let tables: Vec<&LayerTable> = self.layer.iter().flatten().map(Spanned::get_ref).collect();
        let (mut edge, mut here) = (from, 0);
        for table in &tables {
            let end = *table.to.get_ref();
            here = table.to.span().start;
            if end.is_nan() || end <= edge {
                return wrong(here, format!("to = {end}: a number above {edge} is needed"));
            }
            edge = end;
        }
        match edge == to {
            true => Ok(tables),
            false if tables.is_empty() => wrong(
                0,
                format!("layer: tables [[layer]], the last one with to = {to}, are needed"),
            ),
            false => {
                wrong(here, format!("to = {edge}: the last layer ends with the domain, at {to}"))
            }
        }
    }

    /// The boundaries of an interval.
    fn ends(&self, ends: &Ends) -> Result<[Boundary; 2], Problem> {
        let pair = match ends {
            Ends::All(end) => [*end; 2],
            Ends::Each(words) => match words.as_slice() {
                [Ends::All(left), Ends::All(right)] => [*left, *right],
                _ => {
                    let two = "boundary: an interval has two ends, each of one word";
                    return wrong(place(&self.boundary), two);
                }
            },
        };
        match pair.map(|end| end == Boundary::Periodic) {
            [true, false] | [false, true] => {
                let both = "boundary: an interval is periodic at both ends or at none";
                wrong(place(&self.boundary), both)
            }
            _ => Ok(pair),
        }
    }
}
