//! Scenes in two and three dimensions, as data.

use super::sedov::SedovBlast;
use crate::lattice::{Filling, Lattice};
use crate::particles::{IsothermalGas, MethodOptions, ParticleMethod};
use crate::riemann::IdealGas;
use crate::scene::Material;
use courant_analysis::kernel::Kernel;
use serde::Deserialize;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The initial state.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum FieldFlow {
    /// `v = (0, speed·sin 2π(x − x₀)/L)`, `L` the length of the box: Cha & Whitworth 2003 (65).
    Shear {
        /// The density.
        density: f64,
        /// The amplitude.
        speed: f64,
    },
    /// A vortex about the origin: the velocity `5r` up to `r = 0.2`, `2 − 5r` up to 0.4, and none outside, held by the pressure.
    Gresho {
        /// The density.
        density: f64,
        /// The pressure at the origin.
        pressure: f64,
    },
    /// An explosion at the origin.
    Blast {
        /// The density.
        density: f64,
        /// The energy set free.
        energy: f64,
        /// The pressure of the gas around.
        pressure: f64,
    },
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
enum GasData {
    Isothermal { sound_speed: f64 },
    Ideal { gamma: f64 },
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneData {
    name: String,
    #[serde(default)]
    description: String,
    #[serde(default)]
    source: String,
    dimension: usize,
    domain: Vec<[f64; 2]>,
    lattice: String,
    end_time: f64,
    particles: usize,
    gas: GasData,
    flow: FieldFlow,
}

/// Density, velocity and pressure at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldState<const D: usize> {
    /// `ρ`.
    pub density: f64,
    /// `v`.
    pub velocity: [f64; D],
    /// `P`.
    pub pressure: f64,
}

/// A flow in a periodic box.
///
/// ```
/// use courant_simulation::field::FieldScene;
/// let shear = FieldScene::named("shear").expect("it is in the list");
/// assert_eq!((shear.dimension, shear.particles, shear.end_time), (2, 2500, 6.0));
/// let error = FieldScene::from_toml("dimension = 4").unwrap_err();
/// assert!(error.to_string().contains("missing field `name`"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FieldScene {
    /// The name used on the command line and in files.
    pub name: String,
    /// What happens, in a line.
    pub description: String,
    /// Where the scene comes from, and what had to be chosen.
    pub source: String,
    /// 2 or 3.
    pub dimension: usize,
    /// The corners of the periodic box, one value for each axis; the upper one moves to the nearest periods of the lattice.
    pub domain: [Vec<f64>; 2],
    /// How the particles stand at the start.
    pub lattice: Lattice,
    /// The gas.
    pub gas: Material,
    /// The initial state.
    pub flow: FieldFlow,
    /// When to stop.
    pub end_time: f64,
    /// The customary number of particles.
    pub particles: usize,
}

/// A scene that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InvalidField {
    /// No TOML, or not the keys of a scene.
    #[error("{0}")]
    Syntax(String),
    /// A value out of its range.
    #[error("{key} = {value}: {accepted}")]
    Value {
        /// The key.
        key: &'static str,
        /// Its value.
        value: String,
        /// What is accepted.
        accepted: String,
    },
}

const FILES: [&str; 3] = [
    include_str!("../../scenes/shear.toml"),
    include_str!("../../scenes/gresho.toml"),
    include_str!("../../scenes/sedov.toml"),
];

impl FieldScene {
    /// All named scenes.
    pub fn all() -> &'static [Self] {
        static ALL: LazyLock<Vec<FieldScene>> = LazyLock::new(|| {
            let read =
                |text| FieldScene::from_toml(text).expect("the files in the tree are scenes");
            FILES.iter().map(|text| read(text)).collect()
        });
        &ALL
    }

    /// The scene of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().iter().find(|scene| scene.name == name).cloned()
    }

    /// Reads a scene, as the files in `simulation/scenes` are written.
    ///
    /// # Errors
    /// [`InvalidField`] names the key, its value and what is accepted.
    pub fn from_toml(text: &str) -> Result<Self, InvalidField> {
        let data: SceneData = toml::from_str(text)
            .map_err(|error| InvalidField::Syntax(error.message().to_string()))?;
        let wrong = |key, value: String, accepted: &str| InvalidField::Value {
            key,
            value,
            accepted: accepted.into(),
        };
        let positive = |key, value: f64| {
            if value.is_finite() && value > 0.0 {
                Ok(value)
            } else {
                Err(wrong(key, value.to_string(), "a finite number above 0"))
            }
        };
        if !(2..=3).contains(&data.dimension) {
            return Err(wrong("dimension", data.dimension.to_string(), "2 or 3"));
        }
        let ends = |side: usize| data.domain.iter().map(|axis| axis[side]).collect::<Vec<_>>();
        let fits = data.domain.len() == data.dimension
            && data.domain.iter().flatten().all(|end| end.is_finite())
            && data.domain.iter().all(|[from, to]| from < to);
        if !fits {
            let accepted = "an interval [from, to] for each axis";
            return Err(wrong("domain", format!("{:?}", data.domain), accepted));
        }
        let fitting = || Lattice::ALL.into_iter().filter(|l| l.dimension() == data.dimension);
        let lattice =
            fitting().find(|lattice| lattice.name() == data.lattice).ok_or_else(|| {
                let names: Vec<&str> = fitting().map(Lattice::name).collect();
                wrong("lattice", data.lattice.clone(), &names.join(", "))
            })?;
        let gas = match data.gas {
            GasData::Isothermal { sound_speed } => {
                let sound_speed = positive("sound_speed", sound_speed)?;
                Material::Isothermal(IsothermalGas { sound_speed })
            }
            GasData::Ideal { gamma } => Material::Ideal(
                IdealGas::new(gamma)
                    .map_err(|_| wrong("gamma", gamma.to_string(), "a finite number above 1"))?,
            ),
        };
        let (kind, dimension) = match data.flow {
            FieldFlow::Shear { density, speed } => {
                positive("density", density)?;
                positive("speed", speed)?;
                ("shear", None)
            }
            FieldFlow::Gresho { density, pressure } => {
                positive("density", density)?;
                positive("pressure", pressure)?;
                ("gresho", Some(2))
            }
            FieldFlow::Blast { density, energy, pressure } => {
                positive("density", density)?;
                positive("energy", energy)?;
                positive("pressure", pressure)?;
                ("blast", Some(3))
            }
        };
        if dimension.is_some_and(|needed| needed != data.dimension) {
            let value = data.dimension.to_string();
            return Err(wrong("dimension", value, &format!("a flow of kind {kind} has another")));
        }
        let wants_energy = kind != "shear";
        if wants_energy && matches!(gas, Material::Isothermal(_)) {
            return Err(wrong("gas", "isothermal".into(), &format!("{kind} needs gamma")));
        }
        Ok(Self {
            dimension: data.dimension,
            domain: [ends(0), ends(1)],
            lattice,
            gas,
            flow: data.flow,
            end_time: positive("end_time", data.end_time)?,
            particles: data.particles,
            name: data.name,
            description: data.description,
            source: data.source,
        })
    }

    /// The customary options of a method here: smoothing lengths of 1.2 spacings (1.05 with the Gaussian) and three tenths of the
    /// crossing time.
    pub fn options(&self, method: ParticleMethod) -> MethodOptions {
        let options = MethodOptions::new(method);
        let eta = if options.kernel == Kernel::Gaussian { 1.05 } else { 1.2 };
        MethodOptions { eta, courant: 0.3, ..options }
    }

    /// The particles' positions and the box they fill; `None` if `D` is another dimension.
    pub(super) fn fill<const D: usize>(&self, count: usize) -> Option<([f64; D], Filling<D>)> {
        let corner = |side: usize| <[f64; D]>::try_from(self.domain[side].as_slice()).ok();
        let (lower, upper) = (corner(0)?, corner(1)?);
        Some((lower, self.lattice.fill(lower, upper, count)?))
    }

    /// The exact solution, prepared for many points.
    pub fn solution(&self) -> FieldSolution<'_> {
        let blast = match (self.flow, self.gas) {
            (FieldFlow::Blast { .. }, Material::Ideal(gas)) => SedovBlast::new(gas.gamma()),
            _ => None,
        };
        FieldSolution { scene: self, blast }
    }

    /// The pressure of a shear.
    pub(super) fn uniform_pressure(&self, density: f64) -> f64 {
        match self.gas {
            Material::Isothermal(gas) => gas.sound_speed * gas.sound_speed * density,
            Material::Ideal(gas) => density / gas.gamma(),
        }
    }
}

/// The exact solution of a scene.
///
/// ```
/// use courant_simulation::field::FieldScene;
/// let shear = FieldScene::named("shear").expect("it is in the list");
/// let crest = shear.solution().at([0.25, 0.7], 6.0).expect("it is steady");
/// assert_eq!((crest.density, crest.velocity[0]), (1.0, 0.0));
/// assert!((crest.velocity[1] - 1.0).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct FieldSolution<'a> {
    scene: &'a FieldScene,
    blast: Option<SedovBlast>,
}

impl FieldSolution<'_> {
    /// Where the shock of an explosion is.
    pub fn shock_radius(&self, time: f64) -> Option<f64> {
        match (self.scene.flow, self.blast) {
            (FieldFlow::Blast { density, energy, .. }, Some(blast)) => {
                Some(blast.shock_radius(energy, density, time))
            }
            _ => None,
        }
    }

    /// The state at a point; `None` for an explosion at time 0, or for one whose `γ` has no solution in powers.
    pub fn at<const D: usize>(&self, x: [f64; D], time: f64) -> Option<FieldState<D>> {
        let r = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut velocity = [0.0; D];
        match self.scene.flow {
            FieldFlow::Shear { density, speed } => {
                let [from, to] = [self.scene.domain[0][0], self.scene.domain[1][0]];
                velocity[1] = speed * (2.0 * PI * (x[0] - from) / (to - from)).sin();
                let pressure = self.scene.uniform_pressure(density);
                Some(FieldState { density, velocity, pressure })
            }
            FieldFlow::Gresho { density, pressure } => {
                let (speed, pressure) = vortex(density, pressure, r);
                if r > 0.0 {
                    (velocity[0], velocity[1]) = (-speed * x[1] / r, speed * x[0] / r);
                }
                Some(FieldState { density, velocity, pressure })
            }
            FieldFlow::Blast { density, energy, pressure } => {
                let blast = self.blast.filter(|_| time > 0.0)?;
                let inside = blast.state(energy, density, r, time);
                let [rho, speed, p] = inside.unwrap_or([density, 0.0, pressure]);
                if r > 0.0 {
                    velocity = x.map(|x| speed * x / r);
                }
                Some(FieldState { density: rho, velocity, pressure: p })
            }
        }
    }
}

/// Speed and pressure of the vortex at a distance from its axis.
fn vortex(density: f64, pressure: f64, r: f64) -> (f64, f64) {
    let rise = match r {
        r if r < 0.2 => 12.5 * r * r,
        r if r < 0.4 => 4.0 + 12.5 * r * r - 20.0 * r + 4.0 * (5.0 * r).ln(),
        _ => 4.0 * 2f64.ln() - 2.0,
    };
    let speed = if r < 0.2 { 5.0 * r } else { (2.0 - 5.0 * r).max(0.0) };
    (speed, pressure + density * rise)
}
