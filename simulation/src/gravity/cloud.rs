//! Scenes of a self-gravitating sphere, as data.

use super::expansion_wave::{ExpansionWave, Similarity};
use super::sphere::Distribution;
use crate::particles::{IsothermalGas, Material};
use crate::riemann::IdealGas;
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_2, PI};

/// The gas of a cloud.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
enum GasData {
    /// Isothermal.
    Isothermal { sound_speed: f64 },
    /// Ideal, with the same specific internal energy everywhere at the start.
    Ideal { gamma: f64, energy: f64 },
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct SphereData {
    mass: f64,
    radius: f64,
    /// `ρ ∝ r^(−n)`.
    exponent: Option<f64>,
    /// `ξ` of Bonnor and Ebert.
    extent: Option<f64>,
    /// Whether the particles are evened out in the equilibrium the sphere is in.
    #[serde(default)]
    equilibrium: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct GravityData {
    constant: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct SinkData {
    radius: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct OutsideData {
    pressure: f64,
}

/// What the flow is known to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Known {
    /// [`ExpansionWave`](super::ExpansionWave), from the surface of the sink.
    ExpansionWave,
    /// Nothing moves.
    Static,
    /// Every shell falls freely.
    FreeFall,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct CloudData {
    name: String,
    description: String,
    source: String,
    dimension: u32,
    end_time: f64,
    particles: usize,
    exact: Option<Known>,
    gas: GasData,
    sphere: SphereData,
    gravity: GravityData,
    sink: Option<SinkData>,
    outside: Option<OutsideData>,
}

/// A sphere of gas at rest under its own gravity.
///
/// ```
/// use courant_simulation::gravity::Cloud;
/// let cloud = Cloud::named("sis-collapse").expect("it is in the list");
/// assert_eq!((cloud.mass, cloud.radius, cloud.sink), (2.0, 1.0, Some(0.03)));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Cloud {
    /// The name used on the command line and in files.
    pub name: String,
    /// What happens, in a line.
    pub description: String,
    /// Where the scene comes from, and what had to be chosen.
    pub source: String,
    /// The gas.
    pub material: Material,
    /// Its specific internal energy at the start, if it has one.
    pub energy: f64,
    /// How the mass is distributed.
    pub distribution: Distribution,
    /// The mass.
    pub mass: f64,
    /// The radius.
    pub radius: f64,
    /// Whether it is in equilibrium, and the particles are evened out in it.
    pub equilibrium: bool,
    /// Newton's constant.
    pub constant: f64,
    /// Radius of the sink in the centre, if there is one.
    pub sink: Option<f64>,
    /// Pressure of the medium outside; `None` for a vacuum.
    pub outside: Option<f64>,
    /// What is known of the flow.
    pub known: Option<Known>,
    /// When to stop.
    pub end_time: f64,
    /// The customary number of particles.
    pub particles: usize,
}

/// A file that is no cloud.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InvalidCloud {
    /// It is not in the format.
    #[error("{0}")]
    Format(String),
    /// A number that must be positive is not, or is not finite.
    #[error("{name} = {value}: a finite number above 0 is needed")]
    NotPositive {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A cloud has three dimensions.
    #[error("dimension = {0}: a sphere with gravity has 3")]
    Dimension(u32),
    /// The distribution is given twice, or not at all, or has no finite mass.
    #[error("sphere: either exponent, from 0 to below 3, or extent, above 0, is needed")]
    Distribution,
    /// No such gas.
    #[error("gamma = {0}: a number above 1 is needed")]
    Gamma(f64),
}

/// The files in the tree.
const FILES: [&str; 4] = [
    include_str!("../../scenes/sis-collapse.toml"),
    include_str!("../../scenes/bonnor-ebert.toml"),
    include_str!("../../scenes/cold-sphere.toml"),
    include_str!("../../scenes/evrard.toml"),
];

impl Cloud {
    /// All clouds in the tree.
    pub fn all() -> Vec<Self> {
        let read = |text| Self::read(text).expect("the scenes in the tree are tested");
        FILES.into_iter().map(read).collect()
    }

    /// The cloud of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|cloud| cloud.name == name)
    }

    /// A cloud from a file's text.
    ///
    /// # Errors
    /// [`InvalidCloud`] names the first thing that does not make sense.
    ///
    /// ```
    /// use courant_simulation::gravity::Cloud;
    /// let error = Cloud::read("name = \"mine\"").unwrap_err().to_string();
    /// assert!(error.contains("missing field"), "{error}");
    /// ```
    pub fn read(text: &str) -> Result<Self, InvalidCloud> {
        let data: CloudData =
            toml::from_str(text).map_err(|error| InvalidCloud::Format(error.message().into()))?;
        let mut numbers = vec![
            ("end_time", data.end_time),
            ("sphere.mass", data.sphere.mass),
            ("sphere.radius", data.sphere.radius),
            ("gravity.constant", data.gravity.constant),
        ];
        let (material, energy) = match data.gas {
            GasData::Isothermal { sound_speed } => {
                numbers.push(("gas.sound_speed", sound_speed));
                (Material::Isothermal(IsothermalGas { sound_speed }), 0.0)
            }
            GasData::Ideal { gamma, energy } => {
                numbers.push(("gas.energy", energy));
                let gas = IdealGas::new(gamma).map_err(|_| InvalidCloud::Gamma(gamma))?;
                (Material::Ideal(gas), energy)
            }
        };
        numbers.extend(data.sink.map(|sink| ("sink.radius", sink.radius)));
        numbers.extend(data.outside.map(|outside| ("outside.pressure", outside.pressure)));
        for (name, value) in numbers {
            if !(value.is_finite() && value > 0.0) {
                return Err(InvalidCloud::NotPositive { name, value });
            }
        }
        if data.dimension != 3 {
            return Err(InvalidCloud::Dimension(data.dimension));
        }
        let distribution = match (data.sphere.exponent, data.sphere.extent) {
            (Some(n), None) if (0.0..3.0).contains(&n) => Distribution::PowerLaw(n),
            (None, Some(extent)) if extent.is_finite() && extent > 0.0 => {
                Distribution::BonnorEbert(extent)
            }
            _ => return Err(InvalidCloud::Distribution),
        };
        Ok(Self {
            name: data.name,
            description: data.description,
            source: data.source,
            material,
            energy,
            distribution,
            mass: data.sphere.mass,
            radius: data.sphere.radius,
            equilibrium: data.sphere.equilibrium,
            constant: data.gravity.constant,
            sink: data.sink.map(|sink| sink.radius),
            outside: data.outside.map(|outside| outside.pressure),
            known: data.exact,
            end_time: data.end_time,
            particles: data.particles,
        })
    }

    /// The mean density.
    pub fn mean_density(&self) -> f64 {
        self.mass / (4.0 / 3.0 * PI * self.radius.powi(3))
    }

    /// The pressure at the edge, where the sphere is in equilibrium and isothermal.
    pub fn edge_pressure(&self) -> Option<f64> {
        match self.material {
            Material::Isothermal(gas) => Some(
                gas.sound_speed.powi(2) * self.mean_density() * self.distribution.edge_density(),
            ),
            Material::Ideal(_) => None,
        }
    }

    /// The speed of sound, where there is one.
    pub fn sound_speed(&self) -> Option<f64> {
        match self.material {
            Material::Isothermal(gas) => Some(gas.sound_speed),
            Material::Ideal(_) => None,
        }
    }

    /// `G M/(m0 c³)`: the time in which the expansion wave's constant rate would take up everything.
    pub fn collapse_time(&self) -> Option<f64> {
        let unit = self.sound_speed()?.powi(3) / self.constant;
        Some(self.mass / (ExpansionWave::solution().core_mass() * unit))
    }

    /// How long before the run the wave left the centre: at its start it is at the surface of the sink, inside
    /// of which nothing is simulated.
    pub fn wave_start(&self) -> Option<f64> {
        Some(self.sink? / self.sound_speed()?)
    }

    /// The expansion wave at a radius and a time simulated, if that is what the cloud does.
    pub fn wave(&self, r: f64, time: f64) -> Option<Similarity> {
        let (sound, start) = (self.sound_speed()?, self.wave_start()?);
        if self.known != Some(Known::ExpansionWave) {
            return None;
        }
        let state = ExpansionWave::solution().state(r, sound * (time + start));
        let unit = sound * sound / self.constant;
        Some(Similarity {
            density: unit * state.density,
            velocity: sound * state.velocity,
            mass: unit * state.mass,
        })
    }

    /// The part of its radius that a uniform cold sphere has after falling for a time: `cos²η` with
    /// `η + sin 2η/2 = √(2GM/R³) t`; 0 from the free-fall time on.
    pub fn fallen(&self, time: f64) -> f64 {
        let phase = (2.0 * self.constant * self.mass / self.radius.powi(3)).sqrt() * time;
        let (mut low, mut high) = (0.0, FRAC_PI_2);
        while high - low > 1e-15 {
            let middle: f64 = 0.5 * (low + high);
            if middle + 0.5 * (2.0 * middle).sin() < phase {
                low = middle
            } else {
                high = middle
            }
            if middle == low && middle == high {
                break;
            }
        }
        low.cos().powi(2)
    }
}
