//! Scenes in two and three dimensions, as data.

use super::sedov::SedovBlast;
use crate::boundary::Boundary;
use crate::lattice::{Filling, Lattice};
use crate::particles::{MethodOptions, ParticleMethod};
use crate::scene::Material;
use courant_analysis::kernel::Kernel;
use std::f64::consts::PI;

/// The initial state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FieldFlow {
    /// `v = (0, speed·sin 2π(x − x₀)/L)`, `L` the length of the box: Cha & Whitworth 2003 (65).
    Shear {
        /// The density.
        density: f64,
        /// The amplitude.
        speed: f64,
        /// The pressure.
        pressure: f64,
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

/// A flow in a box.
///
/// ```
/// use courant_simulation::field::FieldScene;
/// let shear = FieldScene::named("shear").expect("it is in the list");
/// assert_eq!((shear.dimension, shear.particles, shear.end_time), (2, 2500, 6.0));
/// let error = FieldScene::parse("end_time = 1\ndomain = [0, 1]\nshear = {}", "mine").unwrap_err();
/// assert!(error.to_string().contains("missing field `density`"), "{error}");
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
    /// The corners of the box, one value for each axis; the upper one moves to the nearest periods of the lattice.
    pub domain: [Vec<f64>; 2],
    /// What is beyond the ends of each axis: another period, or a mirror.
    pub boundary: Vec<[Boundary; 2]>,
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
    /// The customary method, if the file names one.
    pub method: Option<String>,
}

impl FieldScene {
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

    /// How far the nearest end of the box is from the origin.
    fn nearest_end(&self) -> f64 {
        self.domain.iter().flatten().map(|end| end.abs()).fold(f64::INFINITY, f64::min)
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

    /// The state at a point; `None` for an explosion at time 0 or one that has reached the box, or whose `γ` has no solution in
    /// powers.
    pub fn at<const D: usize>(&self, x: [f64; D], time: f64) -> Option<FieldState<D>> {
        let r = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut velocity = [0.0; D];
        match self.scene.flow {
            FieldFlow::Shear { density, speed, pressure } => {
                let [from, to] = [self.scene.domain[0][0], self.scene.domain[1][0]];
                velocity[1] = speed * (2.0 * PI * (x[0] - from) / (to - from)).sin();
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
                if blast.shock_radius(energy, density, time) > self.scene.nearest_end() {
                    return None;
                }
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

/// Outside of this distance from its axis the gas of the vortex is at rest.
pub const VORTEX_RADIUS: f64 = 0.4;

/// Speed and pressure of the vortex at a distance from its axis.
fn vortex(density: f64, pressure: f64, r: f64) -> (f64, f64) {
    let rise = match r {
        r if r < 0.2 => 12.5 * r * r,
        r if r < VORTEX_RADIUS => 4.0 + 12.5 * r * r - 20.0 * r + 4.0 * (5.0 * r).ln(),
        _ => 4.0 * 2f64.ln() - 2.0,
    };
    let speed = if r < 0.2 { 5.0 * r } else { (2.0 - 5.0 * r).max(0.0) };
    (speed, pressure + density * rise)
}
