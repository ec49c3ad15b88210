//! A gas on a line, from its tables.

use super::{KEYS, Problem, Quantity, SceneFile, ascends, place, wrong};
use crate::boundary::Boundary;
use crate::riemann::State;
use crate::scene::{Flow, Layer, MIN_PARTICLES, Material, Scene};
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
        let window = match self.window.as_ref().map(|window| *window.get_ref()) {
            Some(window) if !ascends(&window) => {
                let needed = "two ascending finite numbers are needed";
                return wrong(place(&self.window), format!("window = {window:?}: {needed}"));
            }
            Some(window) => window,
            // Where it is periodic a period more on each side, for particles that drift over the ends.
            None => {
                let [from, to] = domain;
                let more = if boundary[0] == Boundary::Periodic { to - from } else { 0.0 };
                [from - more, to + more]
            }
        };
        let [name, description, source] = self.words(name);
        Ok(Scene {
            name,
            description,
            source,
            material,
            domain,
            boundary,
            window,
            flow: self.flow(material, domain, boundary)?,
            end_time: self.end_time.0,
            particles: self.particles(100, MIN_PARTICLES)?,
            constant_smoothing: self.constant_smoothing.as_ref().is_some_and(|yes| *yes.get_ref()),
            method: self.method(),
        })
    }

    fn flow(
        &self,
        material: Material,
        domain: [f64; 2],
        boundary: [Boundary; 2],
    ) -> Result<Flow, Problem> {
        let tube = (&self.diaphragm, &self.left, &self.right);
        let (start, layers) = match (tube, &self.layer, &self.simple_wave) {
            ((Some(diaphragm), Some(left), Some(right)), None, None) => {
                let (at, [from, to]) = (*diaphragm.get_ref(), domain);
                if !(at > from && at < to) {
                    let needed = format!("a number between {from} and {to} is needed");
                    return wrong(diaphragm.span().start, format!("diaphragm = {at}: {needed}"));
                }
                let layer = |name, side: &Spanned<Side>, to| {
                    let Side { density, velocity, pressure } = side.get_ref();
                    layer(name, material, to, [density, velocity], pressure.as_ref())
                };
                (place(&self.left), vec![layer("left.", left, at)?, layer("right.", right, to)?])
            }
            ((None, None, None), Some(_), None) => {
                let tables = self.layers(domain)?;
                let start = tables.first().map_or(0, |table| table.to.span().start);
                let layers = tables.into_iter().map(|table| {
                    let LayerTable { to, density, velocity, pressure, value } = table;
                    if let Some(value) = value {
                        let problem = "value: a gas has density, velocity and pressure; a value has \
                                       equation = \"advection\"";
                        return wrong(value.span().start, problem);
                    }
                    let missing = |key| (to.span().start, format!("{key} is missing in this layer"));
                    let density = density.as_ref().ok_or_else(|| missing("density"))?;
                    let velocity = velocity.as_ref().ok_or_else(|| missing("velocity"))?;
                    layer("", material, *to.get_ref(), [density, velocity], pressure.as_ref())
                });
                (start, layers.collect::<Result<_, _>>()?)
            }
            ((None, None, None), None, Some(wave)) => {
                let (start, amplitude) = (wave.span().start, *wave.get_ref().amplitude.get_ref());
                if !(amplitude > 0.0 && amplitude < 1.0) {
                    let needed = "a number above 0 and below 1 is needed";
                    return wrong(start, format!("amplitude = {amplitude}: {needed}"));
                }
                let periodic = (domain, boundary) == ([0.0, 1.0], [Boundary::Periodic; 2]);
                if !periodic || material.ideal().is_none() {
                    let needed = "a simple wave is that of an ideal gas on the periodic [0, 1]";
                    return wrong(start, format!("simple_wave: {needed}"));
                }
                return Ok(Flow::SimpleWave { amplitude });
            }
            _ => {
                let problem = "the initial state is either diaphragm, [left] and [right], or [[layer]], or \
                               [simple_wave]";
                return wrong(0, format!("{problem}; accepted: {KEYS}"));
            }
        };
        match layers.iter().all(Layer::is_vacuum) {
            true => wrong(start, "density = 0 everywhere: there is no gas"),
            false => Ok(Flow::Layers(layers)),
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
            Some(problem) => wrong(value.span().start, format!("{prefix}{name} = {problem}")),
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
            return wrong(place, problem);
        }
    };
    let layer = Layer { to, density, velocity, pressure };
    if let Some(state) = layer.state()
        && let Err(error) = State::new(state.density(), state.velocity(), state.pressure())
    {
        return wrong(place, format!("{prefix}{error}"));
    }
    Ok(layer)
}
