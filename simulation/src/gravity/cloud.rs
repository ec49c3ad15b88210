//! Scenes of a self-gravitating sphere, as data.

use super::expansion_wave::{ExpansionWave, Similarity};
use super::sphere::Distribution;
use crate::bisection::root;
use crate::scene::Material;
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_2, PI};

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

impl Known {
    /// What a cloud would have to be for this to be known of it, where it is not.
    pub fn demand(self, cloud: &Cloud) -> Option<String> {
        let near = |value: f64, wanted: f64| (value / wanted - 1.0).abs() < 1e-3;
        let balanced = cloud
            .sound_speed()
            .zip(cloud.distribution.balance())
            .map(|(c, balance)| balance * c * c * cloud.radius / cloud.constant);
        let stands = balanced.is_some_and(|mass| near(cloud.mass, mass));
        let mass = balanced.map_or_else(String::new, |mass| format!(", here sphere.mass = {mass}"));
        let held = cloud.outside.zip(cloud.edge_pressure());
        let pressure =
            held.map_or_else(String::new, |(_, edge)| format!(", here outside.pressure = {edge}"));
        match self {
            Self::ExpansionWave => {
                let singular = cloud.distribution == Distribution::PowerLaw(2.0);
                (!(singular && stands && cloud.sink.is_some())).then(|| {
                    format!("of an isothermal sphere with exponent = 2, a [sink], and M = 2 c² R/G{mass}")
                })
            }
            Self::Static if !stands => {
                Some(format!("of an isothermal sphere with the mass of equilibrium{mass}"))
            }
            Self::Static => {
                let rests = cloud.sink.is_none() && held.is_some_and(|(p, edge)| near(p, edge));
                (!rests).then(|| {
                    format!("without a [sink], and with the pressure of the edge outside{pressure}")
                })
            }
            Self::FreeFall => {
                let heat = cloud.sound_speed().map_or(cloud.energy, |c| c * c);
                let cold = heat * cloud.radius < 1e-3 * cloud.constant * cloud.mass;
                let uniform = cloud.distribution == Distribution::PowerLaw(0.0);
                let free = cloud.outside.is_none() && cloud.sink.is_none();
                (!(uniform && cold && free)).then(|| {
                    "of a cold sphere with exponent = 0, without [outside] and [sink]".into()
                })
            }
        }
    }
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
    /// The customary method, if the file names one.
    pub method: Option<String>,
}

impl Cloud {
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
        root(0.0, FRAC_PI_2, |eta| eta + 0.5 * (2.0 * eta).sin() - phase).cos().powi(2)
    }
}
