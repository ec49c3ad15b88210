//! Scenes as TOML: the named ones, and those of a user.
//!
//! ```toml
//! name = "mine"             # optional, as are description, source, particles and method
//! gamma = 1.4               # or: sound_speed = 1.0 for an isothermal gas, which needs no pressures
//! domain = [0.0, 1.0]
//! boundary = "transmissive" # or "mirror", "periodic", "open"; ["mirror", "open"] for two different ends
//! window = [0.0, 1.0]       # optional: where the run is compared
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
//!
//! `diaphragm` with the tables `[left]` and `[right]` is short for two layers, `[simple_wave] amplitude` a wave that
//! runs to the right.

use super::quantity::{ACCEPTED, Quantity};
use super::{Flow, InvalidScene, Layer, Material, Scene};
use crate::boundary::Boundary;
use crate::particles::IsothermalGas;
use crate::riemann::{IdealGas, State};
use serde::Deserialize;
use toml::Spanned;

/// What a file has to hold, for messages.
pub const KEYS: &str = "gamma (or sound_speed), domain = [from, to], end_time, and either diaphragm with the \
     tables [left] and [right] or tables [[layer]] with to, each with density, velocity and pressure; if you like name, \
     description, source, boundary, window, particles, constant_smoothing, method";

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
    gamma: Option<Spanned<f64>>,
    sound_speed: Option<Spanned<f64>>,
    domain: Spanned<[f64; 2]>,
    boundary: Option<Spanned<Ends>>,
    window: Option<Spanned<[f64; 2]>>,
    end_time: Spanned<f64>,
    particles: Option<Spanned<usize>>,
    constant_smoothing: Option<bool>,
    method: Option<Spanned<String>>,
    diaphragm: Option<Spanned<f64>>,
    left: Option<Side>,
    right: Option<Side>,
    #[serde(default)]
    layer: Vec<LayerTable>,
    simple_wave: Option<WaveTable>,
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Ends {
    Both(String),
    Each([String; 2]),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Side {
    density: Spanned<Quantity>,
    velocity: Spanned<Quantity>,
    pressure: Option<Spanned<Quantity>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LayerTable {
    to: Spanned<f64>,
    density: Spanned<Quantity>,
    velocity: Spanned<Quantity>,
    pressure: Option<Spanned<Quantity>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WaveTable {
    amplitude: Spanned<f64>,
}

/// A place in the text, and what is wrong there.
type Problem = (usize, String);

impl Scene {
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
            let message = error.message().replace('\n', " ");
            let problem = if message.contains("untagged enum Quantity") {
                format!("a quantity is {ACCEPTED}")
            } else {
                format!("{}; accepted: {KEYS}", message.trim())
            };
            at((error.span().map_or(0, |span| span.start), problem))
        })?;
        let scene = file.scene(name).map_err(at)?;
        scene.check().map_err(|error| at((file.place(error.key), describe(&error))))?;
        Ok(scene)
    }
}

fn describe(error: &InvalidScene) -> String {
    format!("{} = {}", error.key, error.problem)
}

impl SceneFile {
    /// Where the value of a key stands.
    fn place(&self, key: &str) -> usize {
        let first = self.layer.first();
        match key {
            "domain" => self.domain.span().start,
            "window" => self.window.as_ref().map_or(0, |value| value.span().start),
            "end_time" => self.end_time.span().start,
            "particles" => self.particles.as_ref().map_or(0, |value| value.span().start),
            "boundary" => self.boundary.as_ref().map_or(0, |value| value.span().start),
            "diaphragm" => self.diaphragm.as_ref().map_or(0, |value| value.span().start),
            "to" => match &self.diaphragm {
                Some(value) => value.span().start,
                None => first.map_or(0, |layer| layer.to.span().start),
            },
            "amplitude" | "simple_wave" => {
                self.simple_wave.as_ref().map_or(0, |wave| wave.amplitude.span().start)
            }
            _ => first.map_or(0, |layer| layer.density.span().start),
        }
    }

    fn scene(&self, name: &str) -> Result<Scene, Problem> {
        let material = self.material()?;
        let domain = *self.domain.get_ref();
        let boundary = self.ends()?;
        let scene = Scene {
            name: self.name.clone().unwrap_or_else(|| name.into()),
            description: self.description.clone().unwrap_or_default(),
            source: self.source.clone().unwrap_or_else(|| "a file of your own".into()),
            material,
            domain,
            boundary,
            window: match &self.window {
                Some(window) => *window.get_ref(),
                None => Scene::usual_window(domain, boundary),
            },
            flow: self.flow(material, domain)?,
            end_time: *self.end_time.get_ref(),
            particles: self.particles.as_ref().map_or(100, |count| *count.get_ref()),
            constant_smoothing: self.constant_smoothing.unwrap_or(false),
            method: self.method.as_ref().map(|method| method.get_ref().clone()),
        };
        Ok(scene)
    }

    fn material(&self) -> Result<Material, Problem> {
        match (&self.gamma, &self.sound_speed) {
            (Some(gamma), None) => IdealGas::new(*gamma.get_ref())
                .map(Material::Ideal)
                .map_err(|error| (gamma.span().start, error.to_string())),
            (None, Some(speed)) => {
                let sound_speed = *speed.get_ref();
                if sound_speed.is_finite() && sound_speed > 0.0 {
                    return Ok(Material::Isothermal(IsothermalGas { sound_speed }));
                }
                let problem =
                    format!("sound_speed = {sound_speed}: a finite number above 0 is needed");
                Err((speed.span().start, problem))
            }
            (Some(_), Some(speed)) => {
                let problem =
                    "sound_speed: a gas has a gamma or, isothermal, a sound_speed, not both";
                Err((speed.span().start, problem.into()))
            }
            (None, None) => Err((0, format!("gamma or sound_speed is missing; accepted: {KEYS}"))),
        }
    }

    fn ends(&self) -> Result<[Boundary; 2], Problem> {
        let Some(ends) = &self.boundary else { return Ok([Boundary::Transmissive; 2]) };
        let parse = |name: &String| match name.as_str() {
            "periodic" => Ok(Boundary::Periodic),
            "mirror" | "wall" => Ok(Boundary::Mirror),
            "transmissive" => Ok(Boundary::Transmissive),
            "open" => Ok(Boundary::Open),
            _ => {
                let accepted = "periodic, mirror, transmissive, open";
                Err((ends.span().start, format!("boundary = \"{name}\": accepted: {accepted}")))
            }
        };
        match ends.get_ref() {
            Ends::Both(name) => Ok([parse(name)?; 2]),
            Ends::Each([left, right]) => Ok([parse(left)?, parse(right)?]),
        }
    }

    fn flow(&self, material: Material, domain: [f64; 2]) -> Result<Flow, Problem> {
        let tube = (&self.diaphragm, &self.left, &self.right);
        match (tube, self.layer.is_empty(), &self.simple_wave) {
            ((Some(diaphragm), Some(left), Some(right)), true, None) => {
                let place = *diaphragm.get_ref();
                let [from, to] = domain;
                // A bad domain is told of by itself.
                if from < to && !(place > from && place < to) {
                    let problem =
                        format!("diaphragm = {place}: a number between {from} and {to} is needed");
                    return Err((diaphragm.span().start, problem));
                }
                let layer = |name, side: &Side, to| {
                    let Side { density, velocity, pressure } = side;
                    layer(name, material, to, [Some(density), Some(velocity), pressure.as_ref()])
                };
                Ok(Flow::Layers(vec![layer("left.", left, place)?, layer("right.", right, to)?]))
            }
            ((None, None, None), false, None) => {
                let layers = self.layer.iter().map(|table| {
                    let LayerTable { to, density, velocity, pressure } = table;
                    let numbers = [Some(density), Some(velocity), pressure.as_ref()];
                    layer("", material, *to.get_ref(), numbers)
                });
                Ok(Flow::Layers(layers.collect::<Result<_, _>>()?))
            }
            ((None, None, None), true, Some(wave)) => {
                Ok(Flow::SimpleWave { amplitude: *wave.amplitude.get_ref() })
            }
            _ => {
                let problem = "the initial state is either diaphragm, [left] and [right], or [[layer]], or \
                               [simple_wave]";
                Err((0, format!("{problem}; accepted: {KEYS}")))
            }
        }
    }
}

/// A layer from density, velocity and pressure, each checked where it stands.
fn layer(
    prefix: &str,
    material: Material,
    to: f64,
    [density, velocity, pressure]: [Option<&Spanned<Quantity>>; 3],
) -> Result<Layer, Problem> {
    let nothing = Quantity::Constant(0.0);
    let mut numbers = [nothing.clone(), nothing.clone(), nothing];
    for ((name, value), number) in
        [("density", density), ("velocity", velocity), ("pressure", pressure)]
            .into_iter()
            .zip(&mut numbers)
    {
        let Some(value) = value else { continue };
        if let Some(problem) = value.get_ref().problem(name != "velocity") {
            return Err((value.span().start, format!("{prefix}{name} = {problem}")));
        }
        *number = value.get_ref().clone();
    }
    let place = density.map_or(0, |value| value.span().start);
    let [density, velocity, mut own_pressure] = numbers;
    match (material, pressure) {
        (Material::Ideal(_), None) if density != Quantity::Constant(0.0) => {
            return Err((
                place,
                format!("{prefix}pressure is missing: only an isothermal gas needs none"),
            ));
        }
        (Material::Isothermal(gas), _) => {
            let square = gas.sound_speed * gas.sound_speed;
            own_pressure = Quantity::Constant(density.constant().map_or(0.0, |rho| square * rho));
        }
        (Material::Ideal(_), _) => {}
    }
    let layer = Layer { to, density, velocity, pressure: own_pressure };
    if let Some(state) = layer.state()
        && let Err(error) = State::new(state.density(), state.velocity(), state.pressure())
    {
        return Err((place, format!("{prefix}{error}")));
    }
    Ok(layer)
}
