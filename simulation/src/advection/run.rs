//! One run of one scene: plan, outcome, profiles, errors, work.

use super::lattice_path::LatticePath;
use super::method::{Method, MethodError};
use super::particle_path::ParticlePath;
use super::profile::Comparison;
use super::ring::{Ring, RingError};
use super::scene::Scene;
use super::stepper::Stepper;
use crate::march::{Evolution, Limits, march};
use crate::run::Reason;
use std::ops::ControlFlow;

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
    /// The data.
    pub scene: Scene,
    /// The scheme. Its Courant number is an upper bound: the one used lands on the end time in equal
    /// steps.
    pub method: Method,
    /// How many particles on the unit interval.
    pub particles: usize,
    /// The end time, which is also the number of periods travelled.
    pub periods: f64,
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
    #[error("the number of periods {0} must be positive and finite")]
    Periods(f64),
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// At the end time.
    Completed,
    /// A value was no longer finite; seen after this many steps.
    Overflowed {
        /// Steps done.
        steps: u64,
    },
    /// The observer said so, after this many steps.
    Cancelled {
        /// Steps done.
        steps: u64,
    },
}

/// What a run gives.
#[derive(Debug, Clone, PartialEq)]
pub struct AdvectionRun {
    /// How it ended.
    pub outcome: Outcome,
    /// `ξ_i`, ascending in `[0, 1)`.
    pub positions: Vec<f64>,
    /// The values at the start.
    pub initial: Vec<f64>,
    /// The values at the end.
    pub computed: Vec<f64>,
    /// The exact solution at the time reached.
    pub exact: Vec<f64>,
    /// The time reached.
    pub time: f64,
    /// Steps done.
    pub steps: u64,
    /// The Courant number used: at most the plan's.
    pub courant_number: f64,
    /// Terms with another particle's value added up in all: the work.
    pub interactions: u64,
    /// Errors and diagnostics; not numbers when the values overflowed.
    pub comparison: Comparison,
}

/// The number of equal steps that reach the end time, and the Courant number they have.
///
/// A plan whose Courant number divides the way exactly must get it back: a quotient within rounding of
/// an integer is taken as that integer.
fn equal_steps(plan: &RunPlan) -> (u64, f64) {
    let way = plan.periods * plan.particles as f64;
    let steps = way / plan.method.courant_number;
    let steps = (steps * (1.0 - 4.0 * f64::EPSILON)).ceil().max(1.0);
    (steps as u64, way / steps)
}

/// Runs a plan.
///
/// ```
/// use courant_analysis::kernel::Kernel;
/// use courant_simulation::advection::{AdvectionScheme, run, Layout, Method, RunPlan, Scene};
/// let method = Method {
///     scheme: AdvectionScheme::GodunovSph, kernel: Kernel::CubicSpline, ratio: 2.0, courant_number: 1.0,
/// };
/// let plan =
///     RunPlan { scene: Scene::Step, method, particles: 200, periods: 1.0, layout: Layout::Lattice };
/// let result = run(&plan).unwrap();
/// assert_eq!((result.steps, result.interactions), (200, 200 * 200 * 3));
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
    let (stepper, outcome, steps) = prepared.advance(&mut observe);
    Ok(prepared.result(&*stepper, outcome, steps))
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
        plan.method.check()?;
        if !(plan.periods > 0.0 && plan.periods.is_finite()) {
            return Err(PlanError::Periods(plan.periods));
        }
        let ring = match plan.layout {
            Layout::Lattice | Layout::Uniform => Ring::uniform(plan.particles, 1.0)?,
            Layout::Disordered { disorder, seed } => {
                Ring::disordered(plan.particles, 1.0, disorder, seed)?
            }
        };
        let (total, courant_number) = equal_steps(plan);
        let method = Method { courant_number, ..plan.method };
        let initial = ring.positions().iter().map(|&x| plan.scene.initial(x)).collect();
        Ok(Self { plan, method, ring, initial, total })
    }

    /// Finds the neighbours or the stencil and steps to the end: what a run costs.
    pub(super) fn advance(
        &self,
        observe: &mut impl FnMut(f64) -> ControlFlow<()>,
    ) -> (Box<dyn Stepper>, Outcome, u64) {
        let mut stepper: Box<dyn Stepper> = match self.plan.layout {
            Layout::Lattice => Box::new(LatticePath::new(self.method, self.plan.particles)),
            Layout::Uniform | Layout::Disordered { .. } => {
                Box::new(ParticlePath::new(self.method, &self.ring))
            }
        };
        stepper.set_state(&self.initial);
        let step = self.plan.periods / self.total as f64;
        let mut evolution = EqualSteps { stepper, step, taken: 0 };
        let limits = Limits { steps: usize::MAX };
        let end = march(&mut evolution, self.plan.periods, limits, |_, time| observe(time));
        let steps = evolution.taken;
        let outcome = if evolution.check().is_err() {
            Outcome::Overflowed { steps }
        } else if end.cancelled {
            Outcome::Cancelled { steps }
        } else {
            Outcome::Completed
        };
        (evolution.stepper, outcome, steps)
    }

    /// Sets the end of a run beside the exact solution.
    pub(super) fn result(
        self,
        stepper: &dyn Stepper,
        outcome: Outcome,
        steps: u64,
    ) -> AdvectionRun {
        let Self { plan, method, ring, initial, total } = self;
        let time = match outcome {
            Outcome::Completed => plan.periods,
            Outcome::Overflowed { .. } | Outcome::Cancelled { .. } => {
                plan.periods * steps as f64 / total as f64
            }
        };
        let computed = stepper.state().to_vec();
        let exact: Vec<f64> = ring.positions().iter().map(|&x| plan.scene.exact(x, time)).collect();
        let comparison = Comparison::new(&initial, &computed, &exact, ring.volumes());
        AdvectionRun {
            outcome,
            interactions: steps * stepper.interactions_per_step(),
            positions: ring.positions().to_vec(),
            initial,
            computed,
            exact,
            time,
            steps,
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
