//! The methods by name, and the one way to run a scene with any of them.

use crate::finite_volume::{FiniteVolumeOptions, Grid};
use crate::lagrangian::flux::{Flux, ModifiedRoe};
use crate::lagrangian::{LagrangianOptions, LagrangianScheme};
use crate::march::refuse_too_many;
use crate::particles::{self, MethodOptions, PairWork, ParticleMethod};
use crate::run::{InvalidOptions, Lined, Reason, Run};
use crate::scene::{Material, Scene};
use std::ops::ControlFlow;

/// A method for gas dynamics in one dimension, with its options.
///
/// ```
/// use courant_simulation::method::Method;
/// use courant_simulation::scene::Scene;
/// let tube = Scene::named("ferrari1").expect("it is in the list");
/// for name in ["lagrangian-roe", "gph3"] {
///     let method = Method::named(name).expect("it is in the list");
///     let run = method.run(&tube, 100)?;
///     assert!(run.completed() && run.time == 0.2);
///     assert!(run.conservation.energy.expect("an ideal gas").abs() < 1e-13);
/// }
/// let isothermal = Scene::named("isothermal-tube").expect("it is in the list");
/// let problem = Method::named("finite-volume").expect("it is in the list").run(&isothermal, 100);
/// assert!(problem.unwrap_err().to_string().contains("isothermal"));
/// # Ok::<(), courant_simulation::run::InvalidOptions>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Godunov-type SPH in Lagrangian mass coordinates.
    Lagrangian(LagrangianOptions),
    /// First-order finite volumes in Eulerian coordinates.
    FiniteVolume(FiniteVolumeOptions),
    /// SPH and Godunov particle hydrodynamics.
    Particles(MethodOptions),
}

/// A gas ready to march.
pub(crate) struct Start {
    pub evolution: Box<dyn Lined + Send>,
    /// Particles beyond the ends.
    pub waiting: [usize; 2],
}

/// More particles than this are not run: they would fill the memory of a usual machine.
const MOST_PARTICLES: usize = 10_000_000;

impl Method {
    /// Every method: those of Ferrari et al. 2008, section 3, in the order of its figures, then those of Cha & Whitworth 2003.
    pub const NAMES: [&'static str; 11] = [
        "finite-volume",
        "sph-adke",
        "lagrangian-exact",
        "lagrangian-rusanov",
        "lagrangian-roe",
        "gph1",
        "gph2",
        "gph3",
        "gph4",
        "sph1",
        "sph2",
    ];

    /// The method of [`NAMES`](Self::NAMES) with its default options.
    pub fn named(name: &str) -> Option<Self> {
        let lagrangian = |flux| Some(Self::Lagrangian(LagrangianOptions::new(flux)));
        match name {
            "finite-volume" => Some(Self::FiniteVolume(FiniteVolumeOptions::default())),
            "lagrangian-exact" => lagrangian(Flux::Exact),
            "lagrangian-rusanov" => lagrangian(Flux::Rusanov),
            "lagrangian-roe" => lagrangian(Flux::ModifiedRoe(ModifiedRoe::default())),
            _ => ParticleMethod::named(name)
                .map(|method| Self::Particles(MethodOptions::new(method))),
        }
    }

    /// Name and title.
    fn words(&self) -> [&'static str; 2] {
        match self {
            Self::FiniteVolume(_) => ["finite-volume", "First-order Godunov finite volumes"],
            Self::Particles(options) => [options.method.name(), options.method.title()],
            Self::Lagrangian(options) => match options.flux {
                Flux::Exact => ["lagrangian-exact", "Godunov-type SPH, exact Riemann flux"],
                Flux::Rusanov => ["lagrangian-rusanov", "Godunov-type SPH, Rusanov flux"],
                Flux::ModifiedRoe(_) => ["lagrangian-roe", "Godunov-type SPH, modified Roe flux"],
            },
        }
    }

    /// The name in [`NAMES`](Self::NAMES).
    pub fn name(&self) -> &'static str {
        self.words()[0]
    }

    /// The name that people use.
    pub fn title(&self) -> &'static str {
        self.words()[1]
    }

    /// What helps against a breakdown, if anything is known to.
    pub fn advice(&self, reason: &Reason) -> Option<&'static str> {
        match (self, reason) {
            (_, Reason::StepLimit { .. }) => {
                Some("fewer --particles or a larger --cfl take fewer steps")
            }
            (Self::Particles(options), Reason::InternalEnergy { .. })
                if !options.method.is_godunov() =>
            {
                Some(
                    "SPH takes half of the work of parting neighbours from the colder one; a smaller --ratio or \
                      --method gph3 helps",
                )
            }
            (Self::Particles(options), Reason::InternalEnergy { .. })
                if options.pair_work == PairWork::Mean =>
            {
                Some(
                    "parting neighbours take half of their work from the colder one; --pair-work shared helps",
                )
            }
            (Self::Particles(options), Reason::TimeStep { .. })
                if options.pair_work == PairWork::Star =>
            {
                Some(
                    "where gravity holds a pressure, --pair-work star lets heat flow down its slope until the densest gas \
                      collapses; --pair-work shared helps",
                )
            }
            (Self::Particles(_), Reason::SmoothingLength { .. }) => {
                Some("a larger --ratio or the kernel cubic-spline helps")
            }
            (_, Reason::InternalEnergy { .. } | Reason::Density { .. }) => {
                Some("a smaller --cfl or --method lagrangian-rusanov helps")
            }
            (_, _) => None,
        }
    }

    /// Whether the method knows the physics of a scene.
    ///
    /// # Errors
    /// [`InvalidOptions::Uncovered`] says what is missing.
    pub fn covers(&self, scene: &Scene) -> Result<(), InvalidOptions> {
        let ideal = matches!(scene.material, Material::Ideal(_));
        let problem = match self {
            Self::Particles(_) => None,
            _ if !ideal => {
                Some("it advances a total energy, which an isothermal gas does not have")
            }
            Self::FiniteVolume(_) => None,
            Self::Lagrangian(_) if scene.has_gap() => {
                Some("a vacuum between gases has no place on its mass lattice")
            }
            Self::Lagrangian(_) => None,
        };
        match problem {
            None => Ok(()),
            Some(problem) => Err(InvalidOptions::Uncovered {
                method: self.name(),
                scene: scene.name.clone(),
                problem,
            }),
        }
    }

    /// Runs the scene from its start to its end time with `particles` particles or cells in its domain.
    ///
    /// # Errors
    /// [`InvalidOptions`], when the run cannot start. A run that breaks down is no error: see
    /// [`Run::failure`].
    pub fn run(&self, scene: &Scene, particles: usize) -> Result<Run, InvalidOptions> {
        self.run_with(scene, particles, |_| ControlFlow::Continue(()))
    }

    /// [`run`](Self::run); after every step `observe(time)` may end it.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_with(
        &self,
        scene: &Scene,
        particles: usize,
        mut observe: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Run, InvalidOptions> {
        let Start { mut evolution, waiting } = self.start(scene, particles)?;
        // Inside the pool a small parallel loop costs no hand-over between threads.
        let observe = |_: &_, time| observe(time);
        let mut run = rayon::scope(|_| {
            Run::of(&mut *evolution, scene.end_time, observe, |state| state.profile())
        });
        run.waiting = waiting;
        run.warnings.extend(self.unresolved(scene, particles));
        Ok(run)
    }

    /// Whether a run can start: options, physics, size.
    ///
    /// # Errors
    /// [`InvalidOptions`] names what is wrong.
    pub fn check(&self, scene: &Scene, particles: usize) -> Result<(), InvalidOptions> {
        self.covers(scene)?;
        let least = match self {
            Self::Lagrangian(options) => options.check()?,
            Self::FiniteVolume(options) => options.check()?,
            Self::Particles(options) => options.check()?,
        };
        if particles < least {
            return Err(InvalidOptions::Particles { particles, least });
        }
        let needed = match self {
            Self::FiniteVolume(_) => particles as f64,
            Self::Lagrangian(_) => {
                particles as f64 * (1.0 + scene.inflow().iter().sum::<f64>() / scene.mass())
            }
            Self::Particles(_) => scene.particles_with_ends(particles),
        };
        if needed > MOST_PARTICLES as f64 {
            let what = "particles, those that flow in or matter beyond the ends included";
            return Err(InvalidOptions::TooMuch { what, needed, most: MOST_PARTICLES });
        }
        Ok(())
    }

    /// The gas at the start.
    pub(crate) fn start(&self, scene: &Scene, particles: usize) -> Result<Start, InvalidOptions> {
        self.check(scene, particles)?;
        let mut start = match self {
            Self::FiniteVolume(options) => Start {
                evolution: Box::new(Grid::new(scene, particles, options.cfl)),
                waiting: [0; 2],
            },
            Self::Particles(options) => particles::start(scene, particles, options)?,
            Self::Lagrangian(options) => {
                let scheme = LagrangianScheme::new(scene, particles, options)?;
                Start { waiting: scheme.waiting(), evolution: Box::new(scheme) }
            }
        };
        refuse_too_many(&mut *start.evolution, scene.end_time)?;
        Ok(start)
    }

    /// Says which gas holds less than a particle's mass, and how many particles would resolve it.
    fn unresolved(&self, scene: &Scene, particles: usize) -> Option<String> {
        if matches!(self, Self::FiniteVolume(_)) {
            return None;
        }
        let total = scene.mass();
        let least = scene.layer_masses().into_iter().fold(f64::INFINITY, f64::min);
        let held = least / total * particles as f64;
        (held < 1.0).then(|| {
            format!(
                "a layer holds {:.2e} of the mass, {held:.2} of a particle's: it is not resolved; \
                 --particles {} gives it ten",
                least / total,
                (10.0 * total / least).ceil()
            )
        })
    }
}
