//! The methods by name.

use crate::adaptive_sph::{self, AdaptiveSphOptions};
use crate::finite_volume::{self, FiniteVolumeOptions};
use crate::lagrangian::flux::{Exact, Flux, ModifiedRoe, Rusanov};
use crate::lagrangian::{LagrangianOptions, LagrangianScheme};
use crate::run::{InvalidOptions, Run};
use crate::scene::Scene;

/// A method for gas dynamics in one dimension, with its options.
///
/// ```
/// use courant_simulation::method::Method;
/// use courant_simulation::scene::ShockTube;
/// let tube = ShockTube::standard("ferrari1").expect("it is in the list");
/// let method = Method::named("lagrangian-roe").expect("it is in the list");
/// let run = method.run(&tube, 100)?;
/// assert!(run.completed() && run.time == 0.2);
/// assert!(run.conservation.energy.abs() < 1e-13);
/// # Ok::<(), courant_simulation::run::InvalidOptions>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Godunov-type SPH in Lagrangian mass coordinates.
    Lagrangian(LagrangianOptions),
    /// First-order finite volumes in Eulerian coordinates.
    FiniteVolume(FiniteVolumeOptions),
    /// Standard SPH with adaptive density kernel estimation.
    AdaptiveSph(AdaptiveSphOptions),
}

impl Method {
    /// The five methods of Ferrari et al. 2008, section 3, in the order of its figures.
    pub const NAMES: [&'static str; 5] =
        ["finite-volume", "sph-adke", "lagrangian-exact", "lagrangian-rusanov", "lagrangian-roe"];

    /// The method of [`NAMES`](Self::NAMES) with its default options.
    pub fn named(name: &str) -> Option<Self> {
        let lagrangian = |flux| Some(Self::Lagrangian(LagrangianOptions::new(flux)));
        match name {
            "finite-volume" => Some(Self::FiniteVolume(FiniteVolumeOptions::default())),
            "sph-adke" => Some(Self::AdaptiveSph(AdaptiveSphOptions::default())),
            "lagrangian-exact" => lagrangian(Flux::Exact),
            "lagrangian-rusanov" => lagrangian(Flux::Rusanov),
            "lagrangian-roe" => lagrangian(Flux::ModifiedRoe(ModifiedRoe::default())),
            _ => None,
        }
    }

    /// The name in [`NAMES`](Self::NAMES).
    pub fn name(&self) -> &'static str {
        match self {
            Self::FiniteVolume(_) => "finite-volume",
            Self::AdaptiveSph(_) => "sph-adke",
            Self::Lagrangian(options) => match options.flux {
                Flux::Exact => "lagrangian-exact",
                Flux::Rusanov => "lagrangian-rusanov",
                Flux::ModifiedRoe(_) => "lagrangian-roe",
            },
        }
    }

    /// Where the method comes from.
    pub fn source(&self) -> &'static str {
        match self {
            Self::FiniteVolume(_) => "Godunov 1959; Toro 1999, chapter 6",
            Self::AdaptiveSph(_) => "Sigalotti et al. 2006",
            Self::Lagrangian(_) => "Ferrari et al. 2008, (3.9)-(3.16)",
        }
    }

    /// Runs the scene from its start to its end time with `particles` particles or cells.
    ///
    /// # Errors
    /// [`InvalidOptions`], when the run cannot start. A run that breaks down is no error: see
    /// [`Run::failure`].
    pub fn run(&self, scene: &dyn Scene, particles: usize) -> Result<Run, InvalidOptions> {
        match self {
            Self::FiniteVolume(options) => finite_volume::run(scene, particles, options),
            Self::AdaptiveSph(options) => adaptive_sph::run(scene, particles, options),
            Self::Lagrangian(options) => match options.flux {
                Flux::Exact => lagrangian(scene, particles, options, Exact),
                Flux::Rusanov => lagrangian(scene, particles, options, Rusanov),
                Flux::ModifiedRoe(roe) => lagrangian(scene, particles, options, roe),
            },
        }
    }
}

/// One instance of the loop per flux, so that the flux is inlined.
fn lagrangian(
    scene: &dyn Scene,
    particles: usize,
    options: &LagrangianOptions,
    flux: impl crate::lagrangian::LagrangianFlux + Send,
) -> Result<Run, InvalidOptions> {
    let scheme = LagrangianScheme::new(scene, particles, options, flux)?;
    Ok(scheme.run(scene.end_time(), options.max_steps))
}
