//! Speed against error: what a run costs, which runs no other beats, and which to choose.

use super::profile::Comparison;
use super::run::{Outcome, PlanError, Prepared, RunPlan};
use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

/// One timed sample lasts at least this long; shorter runs are repeated within it.
const SHORTEST_SAMPLE: f64 = 5e-4;

/// Seconds of one run over several samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seconds {
    /// The median.
    pub median: f64,
    /// The fastest.
    pub lowest: f64,
    /// The slowest.
    pub highest: f64,
    /// How many samples.
    pub samples: usize,
}

impl Seconds {
    /// From samples, each in seconds for one run.
    ///
    /// # Panics
    /// When there are none.
    pub fn of(mut samples: Vec<f64>) -> Self {
        samples.sort_by(f64::total_cmp);
        let count = samples.len();
        let (lowest, highest) = (samples[0], samples[count - 1]);
        let median = 0.5 * (samples[(count - 1) / 2] + samples[count / 2]);
        Self { median, lowest, highest, samples: count }
    }
}

/// One run with its error and its cost.
#[derive(Debug, Clone, PartialEq)]
pub struct CostRow {
    /// What was run.
    pub plan: RunPlan,
    /// How it ended.
    pub outcome: Outcome,
    /// The Courant number used.
    pub courant_number: f64,
    /// Error norms.
    pub comparison: Comparison,
    /// Steps.
    pub steps: u64,
    /// Terms with another particle's value added up: the cost on any machine.
    pub interactions: u64,
    /// The cost on this machine: finding the neighbours or the stencil, and stepping. The data and the
    /// comparison with the exact solution are not part of it.
    pub seconds: Seconds,
}

/// Runs a plan once to warm up and then takes `samples` timed samples of it; a sample repeats a short run
/// until it lasts half a millisecond. The wall clock of one thread is meant: rings of fewer than 16,384
/// particles are stepped on one, and nothing else should run meanwhile.
///
/// # Errors
/// When the plan's numbers are out of range.
///
/// # Panics
/// When no samples are asked for.
pub fn measure_cost(plan: &RunPlan, samples: usize) -> Result<CostRow, PlanError> {
    assert!(samples > 0, "a median needs a sample");
    let prepared = Prepared::new(plan)?;
    let advance = || black_box(&prepared).advance(&mut |_| ControlFlow::Continue(()));
    let start = Instant::now();
    let (stepper, outcome, steps) = advance();
    let warm_up = start.elapsed().as_secs_f64();
    let repetitions = (SHORTEST_SAMPLE / warm_up).ceil().clamp(1.0, 1000.0) as u32;
    let sample = |_| {
        let start = Instant::now();
        for _ in 0..repetitions {
            black_box(advance());
        }
        start.elapsed().as_secs_f64() / f64::from(repetitions)
    };
    let seconds = Seconds::of((0..samples).map(sample).collect());
    let result = prepared.result(&*stepper, outcome, steps);
    Ok(CostRow {
        plan: plan.clone(),
        outcome: result.outcome,
        courant_number: result.courant_number,
        comparison: result.comparison,
        steps: result.steps,
        interactions: result.interactions,
        seconds,
    })
}

/// Which cost counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CostMeasure {
    /// Median seconds on this machine.
    Seconds,
    /// Interactions, on any machine.
    Interactions,
}

impl CostMeasure {
    /// The cost of a row.
    pub fn of(self, row: &CostRow) -> f64 {
        match self {
            Self::Seconds => row.seconds.median,
            Self::Interactions => row.interactions as f64,
        }
    }
}

/// The points `(cost, error)` that no other point beats in both, as indices by ascending cost. Points
/// that are not finite are passed over; of equal points the first is kept.
///
/// ```
/// use courant_simulation::advection::pareto_front;
/// let points = [(1.0, 9.0), (2.0, 9.5), (3.0, 1.0), (4.0, f64::NAN), (2.0, 4.0)];
/// assert_eq!(pareto_front(&points), [0, 4, 2]);
/// ```
pub fn pareto_front(points: &[(f64, f64)]) -> Vec<usize> {
    let finite = |&index: &usize| points[index].0.is_finite() && points[index].1.is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(finite).collect();
    order.sort_by(|&a, &b| {
        let ((cost_a, error_a), (cost_b, error_b)) = (points[a], points[b]);
        cost_a.total_cmp(&cost_b).then(error_a.total_cmp(&error_b)).then(a.cmp(&b))
    });
    let mut best = f64::INFINITY;
    order.retain(|&index| {
        let better = points[index].1 < best;
        if better {
            best = points[index].1;
        }
        better
    });
    order
}

/// The cheapest choice for one error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recommendation {
    /// The error asked for.
    pub target: f64,
    /// Which point to choose; `None` when none is that good.
    pub choice: Option<usize>,
}

/// For each target the cheapest of the points `(cost, error)` whose error is at most that.
pub fn recommend(points: &[(f64, f64)], targets: &[f64]) -> Vec<Recommendation> {
    let front = pareto_front(points);
    let cheapest = |target: f64| front.iter().copied().find(|&index| points[index].1 <= target);
    targets.iter().map(|&target| Recommendation { target, choice: cheapest(target) }).collect()
}
