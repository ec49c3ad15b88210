//! One run of one scene: plan, outcome, profiles, errors, work.

use super::lattice_path::LatticePath;
use super::particle_path::ParticlePath;
use super::profile::Comparison;
use super::ring::Ring;
use super::scene::AdvectionScene;
use super::scheme::Discretisation;
use super::stepper::Stepper;
use crate::march::{Evolution, march};
use crate::run::{
    Conservation, Counters, Failure, InvalidOptions, Penetration, Promise, Reason, Run, positive,
};
use std::ops::ControlFlow;

/// A run that will need more steps than this does not start.
const MOST_STEPS: usize = 1_000_000_000;

/// Steps between two looks at the state.
const LOOK_EVERY: u64 = 256;

/// Where the particles are and which code steps them.
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

impl Layout {
    /// So many particles on a ring of that length, and what steps them, all values zero.
    pub(super) fn stepper(
        self,
        of: &Discretisation,
        courant_number: f64,
        particles: usize,
        length: f64,
    ) -> Result<(Ring, Box<dyn Stepper>), InvalidOptions> {
        let ring = match self {
            Self::Lattice | Self::Uniform => Ring::uniform(particles, length)?,
            Self::Disordered { disorder, seed } => {
                Ring::disordered(particles, length, disorder, seed)?
            }
        };
        let stepper: Box<dyn Stepper> = match self {
            Self::Lattice => Box::new(LatticePath::new(of, courant_number, particles)),
            Self::Uniform | Self::Disordered { .. } => {
                Box::new(ParticlePath::new(of, courant_number, &ring))
            }
        };
        Ok((ring, stepper))
    }
}

/// Everything a run needs.
#[derive(Debug, Clone, PartialEq)]
pub struct RunPlan {
    /// The data, and when to stop.
    pub scene: AdvectionScene,
    /// Scheme, kernel, ratio.
    pub discretisation: Discretisation,
    /// The Courant number `a Δt/Δξ`, an upper bound: the one used lands on the end time in equal steps.
    pub courant_number: f64,
    /// How many particles on the period.
    pub particles: usize,
    /// The positions.
    pub layout: Layout,
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
    let steps = way / plan.courant_number;
    let steps = (steps * (1.0 - 4.0 * f64::EPSILON)).ceil().max(1.0);
    (steps, way / steps)
}

impl RunPlan {
    /// Whether the plan can be run; the Courant number that it is run with, whose equal steps divide the way.
    ///
    /// # Errors
    /// When a number is out of range, or too many steps would be needed.
    pub fn check(&self) -> Result<f64, InvalidOptions> {
        positive("cfl", self.courant_number)?;
        positive("time", self.scene.end_time)?;
        match equal_steps(self) {
            (steps, courant_number) if steps <= MOST_STEPS as f64 => Ok(courant_number),
            (needed, _) => Err(InvalidOptions::TooMuch { what: "steps", needed, most: MOST_STEPS }),
        }
    }
}

/// Runs a plan.
///
/// ```
/// use courant_analysis::{exact::rational::integer, kernel::Kernel};
/// use courant_simulation::advection::{
///     AdvectionScene, AdvectionScheme, Discretisation, Layout, RunPlan, run,
/// };
/// let plan = RunPlan {
///     scene: AdvectionScene::named("advection-step").unwrap(),
///     discretisation: Discretisation::new(
///         AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(2)).unwrap(),
///     courant_number: 1.0,
///     particles: 200,
///     layout: Layout::Lattice,
/// };
/// let result = run(&plan).unwrap();
/// assert_eq!((result.run.steps, result.run.counters.interactions), (200, 200 * 200 * 3));
/// assert!(result.comparison.extrema.max <= 1.0 + 1e-12);   // monotone below C = 8/5
/// ```
///
/// # Errors
/// When the plan's numbers are out of range.
pub fn run(plan: &RunPlan) -> Result<AdvectionRun, InvalidOptions> {
    run_with(plan, |_| ControlFlow::Continue(()))
}

/// Runs a plan; after every step `observe(time)` may end it.
///
/// # Errors
/// When the plan's numbers are out of range.
pub fn run_with(
    plan: &RunPlan,
    mut observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<AdvectionRun, InvalidOptions> {
    plan.check()?;
    let scene = &plan.scene;
    let (total, courant_number) = equal_steps(plan);
    let (ring, mut stepper) =
        plan.layout.stepper(&plan.discretisation, courant_number, plan.particles, 1.0)?;
    let mut positions: Vec<f64> = ring.positions().iter().map(|&part| scene.place(part)).collect();
    let mut initial: Vec<f64> = positions.iter().map(|&x| scene.initial(x)).collect();
    stepper.set_state(&initial);
    let (end, step) = (scene.end_time, scene.end_time / total);
    let mut evolution = EqualSteps { stepper, step, taken: 0 };
    let mut march = march(&mut evolution, end, usize::MAX, |_, time| observe(time));
    // The last look was up to so many steps ago.
    if let (None, Err(reason)) = (march.failure, evolution.check()) {
        march.failure = Some(Failure { reason, time: march.time, step: march.steps });
    }
    let stepper = evolution.stepper;
    let mut computed = stepper.state().to_vec();
    let mut exact: Vec<f64> = positions.iter().map(|&x| scene.exact(x, march.time)).collect();
    let comparison = Comparison::new(&initial, &computed, &exact, ring.volumes());
    let mean = initial.iter().zip(ring.volumes()).map(|(u, v)| u * v).sum::<f64>();
    let conservation =
        Conservation { mass: comparison.mean_drift / mean, ..Conservation::default() };
    let interactions = march.steps as u64 * stepper.interactions_per_step();
    let counters = Counters { interactions, ..Counters::default() };
    let penetration = Penetration::default();
    let mut run = Run::after(&march, (), conservation, Promise::RoundOff, counters, penetration);
    // A mean need not be kept: Lax–Wendroff SPH drifts by construction where its weights do not add up to 0.
    run.warnings.clear();
    if scene.velocity < 0.0 {
        // The way around is from right to left.
        for column in [&mut positions, &mut initial, &mut computed, &mut exact] {
            column.reverse();
        }
    }
    Ok(AdvectionRun { run, positions, initial, computed, exact, courant_number, comparison })
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
