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
use serde::Deserialize;
use toml::Spanned;

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

/// What kind of scene a file describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Advection,
    Line,
    Field,
    Cloud,
}

impl Kind {
    const ALL: [Self; 4] = [Self::Advection, Self::Line, Self::Field, Self::Cloud];

    fn name(self) -> &'static str {
        match self {
            Self::Advection => "an advection scene",
            Self::Line => "a gas on a line",
            Self::Field => "a gas in a box",
            Self::Cloud => "a sphere",
        }
    }

    /// The keys that it takes beside those of every scene.
    fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Advection => &["domain", "velocity", "layer"],
            Self::Line => &[
                "gamma",
                "sound_speed",
                "domain",
                "boundary",
                "window",
                "constant_smoothing",
                "diaphragm",
                "left",
                "right",
                "layer",
                "simple_wave",
            ],
            Self::Field => &[
                "gamma",
                "sound_speed",
                "domain",
                "boundary",
                "lattice",
                "shear",
                "vortex",
                "blast",
            ],
            Self::Cloud => {
                &["gamma", "sound_speed", "sphere", "gravity", "sink", "outside", "exact"]
            }
        }
    }

    /// The keys by which it is known.
    fn marks(self) -> &'static [&'static str] {
        match self {
            Self::Advection => &["velocity"],
            Self::Line => &["diaphragm", "left", "right", "layer", "simple_wave"],
            Self::Field => &["shear", "vortex", "blast"],
            Self::Cloud => &["sphere"],
        }
    }
}

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
        file.scene(name).map_err(at)
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
    /// The keys given that not every scene takes, and where.
    fn given(&self) -> Vec<(&'static str, usize)> {
        macro_rules! keys {
            ($($key:ident),*) => {
                [$((stringify!($key), self.$key.as_ref().map(|value| value.span().start))),*]
            };
        }
        let layer = self.layer.as_ref().map(|all| all.first().map_or(0, |one| one.span().start));
        let keys = keys![
            gamma,
            sound_speed,
            velocity,
            domain,
            boundary,
            window,
            constant_smoothing,
            lattice,
            exact,
            diaphragm,
            left,
            right,
            simple_wave,
            shear,
            vortex,
            blast,
            sphere,
            gravity,
            sink,
            outside
        ];
        keys.into_iter()
            .chain([("layer", layer)])
            .filter_map(|(key, place)| Some((key, place?)))
            .collect()
    }

    fn kind(&self, given: &[(&str, usize)]) -> Result<Kind, Problem> {
        if self.equation == Some(Equation::Advection) {
            return Ok(Kind::Advection);
        }
        let known = |kind: &Kind| given.iter().any(|(key, _)| kind.marks().contains(key));
        match Kind::ALL[1..].iter().find(|kind| known(kind)) {
            Some(kind) => Ok(*kind),
            None => Err((0, format!("the gas at the start is missing; accepted: {KEYS}"))),
        }
    }

    fn scene(&self, name: &str) -> Result<AnyScene, Problem> {
        let given = self.given();
        let kind = self.kind(&given)?;
        if let Some((key, place)) = given.iter().find(|(key, _)| !kind.keys().contains(key)) {
            let (kind, keys) = (kind.name(), kind.keys().join(", "));
            return Err((*place, format!("{key}: {kind} has no such key; it takes {keys}")));
        }
        let scene = match kind {
            Kind::Advection => AnyScene::Advection(self.advection(name)?),
            Kind::Line => AnyScene::Line(self.line(name)?),
            Kind::Field => AnyScene::Field(self.field(name)?),
            Kind::Cloud => AnyScene::Cloud(self.cloud(name)?),
        };
        let dimension = scene.dimension();
        match &self.dimension {
            Some(given) if *given.get_ref() != dimension => {
                let problem =
                    format!("dimension = {}: {} has {dimension}", given.get_ref(), kind.name());
                Err((given.span().start, problem))
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
                Err((place(&self.particles), problem))
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
                let problem =
                    "sound_speed: a gas has a gamma or, isothermal, a sound_speed, not both";
                Err((speed.span().start, problem.into()))
            }
            (None, None) => Err((0, format!("gamma or sound_speed is missing; accepted: {KEYS}"))),
        }
    }

    /// The interval of a scene on a line.
    fn interval(&self) -> Result<[f64; 2], Problem> {
        match self.domain.as_ref().map(Spanned::get_ref) {
            None => Err((0, format!("domain is missing; accepted: {KEYS}"))),
            Some(Axes::Line(ends @ [from, to]))
                if from.is_finite() && to.is_finite() && from < to =>
            {
                Ok(*ends)
            }
            Some(Axes::Line([from, to])) => {
                let problem =
                    format!("domain = [{from}, {to}]: two ascending finite numbers are needed");
                Err((place(&self.domain), problem))
            }
            Some(Axes::Box(_)) => Err((
                place(&self.domain),
                "domain: on a line, one interval [from, to] is needed".into(),
            )),
        }
    }

    /// The boundaries of an interval.
    fn ends(&self, ends: &Ends) -> Result<[Boundary; 2], Problem> {
        let pair = match ends {
            Ends::All(end) => Some([*end; 2]),
            Ends::Each(words) => match words.as_slice() {
                [Ends::All(left), Ends::All(right)] => Some([*left, *right]),
                _ => None,
            },
        };
        let two = "boundary: an interval has two ends, each of one word";
        let pair = pair.ok_or_else(|| (place(&self.boundary), two.to_string()))?;
        match pair.map(|end| end == Boundary::Periodic) {
            [true, false] | [false, true] => Err((
                place(&self.boundary),
                "boundary: an interval is periodic at both ends or at none".into(),
            )),
            _ => Ok(pair),
        }
    }
}
