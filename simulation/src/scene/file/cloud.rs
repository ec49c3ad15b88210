//! A sphere of gas, from its tables.

use super::{Positive, Problem, SceneFile, wrong};
use crate::gravity::{Cloud, Distribution};
use serde::Deserialize;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereTable {
    mass: Positive,
    radius: Positive,
    /// `ρ ∝ r^(−n)`.
    exponent: Option<Spanned<f64>>,
    /// `ξ` of Bonnor and Ebert.
    extent: Option<Positive>,
    /// Specific internal energy of an ideal gas.
    energy: Option<Spanned<Positive>>,
    /// Whether the particles are evened out in the equilibrium the sphere is in.
    #[serde(default)]
    equilibrium: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GravityTable {
    constant: Positive,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SinkTable {
    radius: Positive,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OutsideTable {
    pressure: Positive,
}

impl SceneFile {
    pub(super) fn cloud(&self, name: &str) -> Result<Cloud, Problem> {
        let table = self.sphere.as_ref().expect("a sphere is known by its table");
        let (place, sphere) = (table.span().start, table.get_ref());
        let material = self.material()?;
        let none = "an isothermal gas has no energy equation";
        let energy = self.of_ideal(material, "sphere.energy", &sphere.energy, place, 0.0, none)?;
        let distribution = match (&sphere.exponent, &sphere.extent) {
            (Some(n), None) if (0.0..3.0).contains(n.get_ref()) => {
                Distribution::PowerLaw(*n.get_ref())
            }
            (None, Some(extent)) => Distribution::BonnorEbert(extent.0),
            _ => {
                let needed = "either exponent, from 0 to below 3, or extent, above 0, is needed";
                return wrong(place, format!("sphere: {needed}"));
            }
        };
        let Some(gravity) = &self.gravity else {
            return wrong(place, "sphere: the table [gravity] with constant is needed");
        };
        let [name, description, source] = self.words(name);
        let mut cloud = Cloud {
            name,
            description,
            source,
            material,
            energy,
            distribution,
            mass: sphere.mass.0,
            radius: sphere.radius.0,
            equilibrium: sphere.equilibrium,
            constant: gravity.get_ref().constant.0,
            sink: self.sink.as_ref().map(|sink| sink.get_ref().radius.0),
            outside: self.outside.as_ref().map(|medium| medium.get_ref().pressure.0),
            known: None,
            end_time: self.end_time.0,
            particles: self.particles(3000, 100)?,
            method: self.method(),
        };
        if let (Some(radius), Some(sink)) = (cloud.sink, &self.sink)
            && radius >= cloud.radius
        {
            let needed = "a number below sphere.radius is needed";
            return wrong(sink.span().start, format!("sink.radius = {radius}: {needed}"));
        }
        if let Some(exact) = &self.exact {
            cloud.known = Some(*exact.get_ref());
            if let Some(demand) = exact.get_ref().demand(&cloud) {
                let problem = format!("exact: that is known {demand}; else leave it out");
                return wrong(exact.span().start, problem);
            }
        }
        Ok(cloud)
    }
}
