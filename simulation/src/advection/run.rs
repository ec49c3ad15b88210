//! One run of one scene: plan, outcome, profiles, errors, work.

use super::lattice_path::LatticePath;
use super::method::{Method, MethodError};
use super::particle_path::ParticlePath;
use super::profile::Comparison;
use super::ring::{Ring, RingError};
use super::scene::AdvectionScene;
use super::stepper::Stepper;
use crate::march::{Evolution, Limits, March, march};
use crate::run::{Conservation, Counters, Failure, Penetration, Promise, Reason, Run};
use std::ops::ControlFlow;

/// A run that will need more steps than this does not start.
const MOST_STEPS: f64 = 1e9;

/// Steps between two looks at the state.
const LOOK_EVERY: u64 = 256;

/// Where the particles are and which path steps them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Layout {
    /// Equal spacing, [`LatticePath`].
    Lattice,
    /// Equal spacing, [`ParticlePath`].
    Uniform,
    /// Random displacements, [`ParticlePath`]; see [`Ring::disordered`].
    Disordered {
        /// The largest displacement in spacings, below 1/2.
        disorder: f64,
        /// The seed of the displacements.
        seed: u64,
    },
}

/// Everything a run needs.
#[derive(Debug, Clone, PartialEq)]
pub struct RunPlan {
    /// The data, and when to stop.
    pub scene: AdvectionScene,
    /// The scheme. Its Courant number is an upper bound: the one used lands on the end time in equal
    /// steps.
    pub method: Method,
    /// How many particles on the period.
    pub particles: usize,
    /// The positions.
    pub layout: Layout,
}

/// Why a plan cannot be run.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// The method's numbers.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The particles.
    #[error(transparent)]
    Ring(#[from] RingError),
    /// The end time.
    #[error("the end time {0} must be positive and finite")]
    EndTime(f64),
    /// More steps than a run may take.
    #[error("{0:.3e} steps would be needed, at most {MOST_STEPS:.0e} are run")]
    Steps(f64),
}

/// What a run gives.
#[derive(Debug, Clone, PartialEq)]
pub struct AdvectionRun {
    /// How it went; the drift of the mass is that of the mean, over the mean at the start.
    pub run: Run<()>,
    /// Where the particles are, ascending within the period.
    pub positions: Vec<f64>,
    /// The values at the start.
    pub initial: Vec<f64>,
    /// The values at the end.
    pub computed: Vec<f64>,
    /// The exact solution at the time reached.
    pub exact: Vec<f64>,
    /// The Courant number used: at most the plan's.
    pub courant_number: f64,
    /// Errors and diagnostics; not numbers when the values overflowed.
    pub comparison: Comparison,
}

/// The number of equal steps that reach the end time, and the Courant number they have.
///
/// A plan whose Courant number divides the way exactly must get it back: a quotient within rounding of
/// an integer is taken as that integer.
fn equal_steps(plan: &RunPlan) -> (f64, f64) {
    let way = plan.scene.periods() * plan.particles as f64;
    let steps = way / plan.method.courant_number;
    let steps = (steps * (1.0 - 4.0 * f64::EPSILON)).ceil().max(1.0);
    (steps, way / steps)
}

impl RunPlan {
    /// Whether the plan can be run; the Courant number that it is run with, whose equal steps divide the way.
    ///
    /// # Errors
    /// When a number is out of range, or too many steps would be needed.
    pub fn check(&self) -> Result<f64, PlanError> {
        self.method.check()?;
        let end = self.scene.end_time;
        if !(end > 0.0 && end.is_finite()) {
            return Err(PlanError::EndTime(end));
        }
        match equal_steps(self) {
            (steps, courant_number) if steps <= MOST_STEPS => Ok(courant_number),
            (steps, _) => Err(PlanError::Steps(steps)),
        }
    }
}

/// Runs a plan.
///
/// ```
/// use courant_analysis::kernel::Kernel;
/// use courant_simulation::advection::{AdvectionScene, AdvectionScheme, run, Layout, Method, RunPlan};
/// let method = Method {
///     scheme: AdvectionScheme::GodunovSph, kernel: Kernel::CubicSpline, ratio: 2.0, courant_number: 1.0,
/// };
/// let scene = AdvectionScene::named("advection-step").unwrap();
/// let plan = RunPlan { scene, method, particles: 200, layout: Layout::Lattice };
/// let result = run(&plan).unwrap();
/// assert_eq!((result.run.steps, result.run.counters.interactions), (200, 200 * 200 * 3));
/// assert!(result.comparison.extrema.max <= 1.0 + 1e-12);   // monotone below C = 8/5
/// ```
///
/// # Errors
/// When the plan's numbers are out of range.
pub fn run(plan: &RunPlan) -> Result<AdvectionRun, PlanError> {
    run_with(plan, |_| ControlFlow::Continue(()))
}

/// Runs a plan; after every step `observe(time)` may end it.
///
/// # Errors
/// When the plan's numbers are out of range.
pub fn run_with(
    plan: &RunPlan,
    mut observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<AdvectionRun, PlanError> {
    let prepared = Prepared::new(plan)?;
    let (stepper, march) = prepared.advance(&mut observe);
    Ok(prepared.result(&*stepper, &march))
}

/// A plan that was found in range, with its particles and their data: all that does not count as cost.
pub(super) struct Prepared<'a> {
    plan: &'a RunPlan,
    method: Method,
    ring: Ring,
    initial: Vec<f64>,
    total: u64,
}

impl<'a> Prepared<'a> {
    pub(super) fn new(plan: &'a RunPlan) -> Result<Self, PlanError> {
        plan.check()?;
        let ring = match plan.layout {
            Layout::Lattice | Layout::Uniform => Ring::uniform(plan.particles, 1.0)?,
            Layout::Disordered { disorder, seed } => {
                Ring::disordered(plan.particles, 1.0, disorder, seed)?
            }
        };
        let (total, courant_number) = equal_steps(plan);
        let method = Method { courant_number, ..plan.method };
        let places = ring.positions().iter().map(|&part| plan.scene.place(part));
        let initial = places.map(|x| plan.scene.initial(x)).collect();
        Ok(Self { plan, method, ring, initial, total: total as u64 })
    }

    /// Finds the neighbours or the stencil and steps to the end: what a run costs.
    pub(super) fn advance(
        &self,
        observe: &mut impl FnMut(f64) -> ControlFlow<()>,
    ) -> (Box<dyn Stepper>, March) {
        let mut stepper: Box<dyn Stepper> = match self.plan.layout {
            Layout::Lattice => Box::new(LatticePath::new(self.method, self.plan.particles)),
            Layout::Uniform | Layout::Disordered { .. } => {
                Box::new(ParticlePath::new(self.method, &self.ring))
            }
        };
        stepper.set_state(&self.initial);
        let end = self.plan.scene.end_time;
        let step = end / self.total as f64;
        let mut evolution = EqualSteps { stepper, step, taken: 0 };
        let limits = Limits { steps: usize::MAX };
        let mut march = march(&mut evolution, end, limits, |_, time| observe(time));
        // The last look was up to so many steps ago.
        if let (None, Err(reason)) = (march.failure, evolution.check()) {
            march.failure = Some(Failure { reason, time: march.time, step: march.steps });
        }
        (evolution.stepper, march)
    }

    /// Sets the end of a run beside the exact solution.
    pub(super) fn result(self, stepper: &dyn Stepper, march: &March) -> AdvectionRun {
        let Self { plan, method, ring, mut initial, .. } = self;
        let time = march.time;
        let mut computed = stepper.state().to_vec();
        let mut positions: Vec<f64> =
            ring.positions().iter().map(|&part| plan.scene.place(part)).collect();
        let mut exact: Vec<f64> = positions.iter().map(|&x| plan.scene.exact(x, time)).collect();
        let comparison = Comparison::new(&initial, &computed, &exact, ring.volumes());
        let mean = initial.iter().zip(ring.volumes()).map(|(u, v)| u * v).sum::<f64>();
        let conservation =
            Conservation { mass: comparison.mean_drift / mean, ..Conservation::default() };
        let counters = Counters {
            interactions: march.steps as u64 * stepper.interactions_per_step(),
            ..Counters::default()
        };
        let penetration = Penetration::default();
        let mut run = Run::after(march, (), conservation, Promise::RoundOff, counters, penetration);
        // A mean need not be kept: Lax–Wendroff SPH drifts by construction where its weights do not add up to 0.
        run.warnings.clear();
        if plan.scene.velocity < 0.0 {
            // The way around is from right to left.
            for column in [&mut positions, &mut initial, &mut computed, &mut exact] {
                column.reverse();
            }
        }
        AdvectionRun {
            run,
            positions,
            initial,
            computed,
            exact,
            courant_number: method.courant_number,
            comparison,
        }
    }
}

/// A stepper with the step in its weights.
struct EqualSteps {
    stepper: Box<dyn Stepper>,
    step: f64,
    taken: u64,
}

impl EqualSteps {
    fn check(&self) -> Result<(), Reason> {
        let broken = self.stepper.state().iter().position(|value| !value.is_finite());
        broken.map_or(Ok(()), |particle| Err(Reason::NotFinite { particle }))
    }
}

impl Evolution for EqualSteps {
    fn time_step(&mut self) -> Result<f64, Reason> {
        Ok(self.step)
    }

    /// The step asked for is the stepper's to round-off, for the steps divide the way.
    fn advance(&mut self, step: f64) -> Result<(), Reason> {
        debug_assert!((step / self.step - 1.0).abs() < 1e-6);
        self.stepper.step();
        self.taken += 1;
        if self.taken.is_multiple_of(LOOK_EVERY) { self.check() } else { Ok(()) }
    }

    fn divisible(&self) -> bool {
        false
    }
}
