//! A gas on a line, from its tables.

use super::{KEYS, Problem, Quantity, SceneFile, place};
use crate::boundary::Boundary;
use crate::riemann::State;
use crate::scene::{Flow, InvalidScene, Layer, MIN_PARTICLES, Material, Scene};
use serde::Deserialize;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Side {
    density: Spanned<Quantity>,
    velocity: Spanned<Quantity>,
    pressure: Option<Spanned<Quantity>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LayerTable {
    pub to: Spanned<f64>,
    density: Option<Spanned<Quantity>>,
    velocity: Option<Spanned<Quantity>>,
    pressure: Option<Spanned<Quantity>>,
    /// Of an advected quantity.
    pub value: Option<Spanned<Quantity>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WaveTable {
    amplitude: Spanned<f64>,
}

impl SceneFile {
    pub(super) fn line(&self, name: &str) -> Result<Scene, Problem> {
        let (material, domain) = (self.material()?, self.interval()?);
        let boundary = match &self.boundary {
            Some(ends) => self.ends(ends.get_ref())?,
            None => [Boundary::Transmissive; 2],
        };
        let [name, description, source] = self.words(name);
        let scene = Scene {
            name,
            description,
            source,
            material,
            domain,
            boundary,
            window: match &self.window {
                Some(window) => *window.get_ref(),
                None => Scene::usual_window(domain, boundary),
            },
            flow: self.flow(material, domain)?,
            end_time: self.end_time.0,
            particles: self.particles(100, MIN_PARTICLES)?,
            constant_smoothing: self.constant_smoothing.as_ref().is_some_and(|yes| *yes.get_ref()),
            method: self.method(),
        };
        let describe = |error: InvalidScene| {
            (self.place_on_line(error.key), format!("{} = {}", error.key, error.problem))
        };
        scene.check().map_err(describe)?;
        Ok(scene)
    }

    /// Where the value of a key stands.
    fn place_on_line(&self, key: &str) -> usize {
        let layer = self.layer.as_ref().and_then(|all| all.first()).map(Spanned::get_ref);
        match key {
            "window" => place(&self.window),
            "to" => layer.map_or(place(&self.diaphragm), |layer| layer.to.span().start),
            "amplitude" | "simple_wave" => place(&self.simple_wave),
            _ => layer.map_or(place(&self.left), |layer| place(&layer.density)),
        }
    }

    fn flow(&self, material: Material, domain: [f64; 2]) -> Result<Flow, Problem> {
        let tube = (&self.diaphragm, &self.left, &self.right);
        match (tube, &self.layer, &self.simple_wave) {
            ((Some(diaphragm), Some(left), Some(right)), None, None) => {
                let (at, [from, to]) = (*diaphragm.get_ref(), domain);
                if !(at > from && at < to) {
                    let problem =
                        format!("diaphragm = {at}: a number between {from} and {to} is needed");
                    return Err((diaphragm.span().start, problem));
                }
                let layer = |name, side: &Spanned<Side>, to| {
                    let Side { density, velocity, pressure } = side.get_ref();
                    layer(name, material, to, [density, velocity], pressure.as_ref())
                };
                Ok(Flow::Layers(vec![layer("left.", left, at)?, layer("right.", right, to)?]))
            }
            ((None, None, None), Some(layers), None) => {
                let layers = layers.iter().map(|table| {
                    let LayerTable { to, density, velocity, pressure, value } = table.get_ref();
                    if let Some(value) = value {
                        let problem = "value: a gas has density, velocity and pressure; a value has \
                                       equation = \"advection\"";
                        return Err((value.span().start, problem.into()));
                    }
                    let missing = |key| (to.span().start, format!("{key} is missing in this layer"));
                    let density = density.as_ref().ok_or_else(|| missing("density"))?;
                    let velocity = velocity.as_ref().ok_or_else(|| missing("velocity"))?;
                    layer("", material, *to.get_ref(), [density, velocity], pressure.as_ref())
                });
                Ok(Flow::Layers(layers.collect::<Result<_, _>>()?))
            }
            ((None, None, None), None, Some(wave)) => {
                Ok(Flow::SimpleWave { amplitude: *wave.get_ref().amplitude.get_ref() })
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
    [density, velocity]: [&Spanned<Quantity>; 2],
    pressure: Option<&Spanned<Quantity>>,
) -> Result<Layer, Problem> {
    let checked =
        |name: &str, value: &Spanned<Quantity>| match value.get_ref().problem(name != "velocity") {
            Some(problem) => Err((value.span().start, format!("{prefix}{name} = {problem}"))),
            None => Ok(value.get_ref().clone()),
        };
    let place = density.span().start;
    let (density, velocity) = (checked("density", density)?, checked("velocity", velocity)?);
    let own = pressure.map(|pressure| checked("pressure", pressure)).transpose()?;
    let pressure = match (material, own) {
        (Material::Isothermal(gas), _) => {
            let square = gas.sound_speed * gas.sound_speed;
            Quantity::Constant(density.constant().map_or(0.0, |rho| square * rho))
        }
        (Material::Ideal(_), Some(pressure)) => pressure,
        (Material::Ideal(_), None) if density == Quantity::Constant(0.0) => Quantity::Constant(0.0),
        (Material::Ideal(_), None) => {
            let problem = format!("{prefix}pressure is missing: only an isothermal gas needs none");
            return Err((place, problem));
        }
    };
    let layer = Layer { to, density, velocity, pressure };
    if let Some(state) = layer.state()
        && let Err(error) = State::new(state.density(), state.velocity(), state.pressure())
    {
        return Err((place, format!("{prefix}{error}")));
    }
    Ok(layer)
}
