//! One advection run as files: the profile as CSV and picture, the numbers as JSON.

use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::run_record::{BROKEN, ConservationRecord, ErrorNorms, RunRecord};
use courant_analysis::exact::rational::{Rational, to_text};
use courant_simulation::advection::{AdvectionRun, Layout, Outcome, RunPlan};
use serde::Serialize;
use std::fmt::Write;

/// Markers in a picture at most; more cannot be told apart.
const MARKERS: usize = 2000;

/// A run as JSON: the keys of every run, and those of advection. What is not finite is `null`, and
/// `failure` says why.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AdvectionRecord {
    /// What every run has.
    #[serde(flatten)]
    pub run: RunRecord,
    /// The kernel's name.
    pub kernel: String,
    /// The smoothing ratio, exactly.
    pub ratio: String,
    /// The Courant number used: the largest up to the one asked for that lands on the end time.
    pub cfl: f64,
    /// `lattice`, `uniform` or `disordered`.
    pub layout: &'static str,
    /// `√(Σ e²/N)`.
    pub l2: Option<f64>,
    /// `max |e|`.
    pub l_infinity: Option<f64>,
    /// `Σ |u_{i+1} − u_i|` at the end.
    pub total_variation: Option<f64>,
    /// The same of the exact solution.
    pub exact_total_variation: Option<f64>,
    /// The smallest value.
    pub minimum: Option<f64>,
    /// The largest value.
    pub maximum: Option<f64>,
    /// Mean of the values at the end less that at the start.
    pub mean_drift: Option<f64>,
    /// Terms with another particle's value added up in all.
    pub interactions: u64,
}

impl AdvectionRecord {
    /// The record of a run.
    pub fn new(plan: &RunPlan, ratio: &Rational, result: &AdvectionRun, wall_seconds: f64) -> Self {
        let seen = &result.comparison;
        let failure = failure(result);
        let finite = |value: f64| (failure.is_none() && value.is_finite()).then_some(value);
        let mean = result.initial.iter().sum::<f64>() / result.initial.len() as f64;
        // A relative change of a mean that is rounding says nothing.
        let relative = (mean.abs() > 1e-12).then(|| seen.mean_drift / mean);
        Self {
            run: RunRecord {
                scene: plan.scene.name().into(),
                method: plan.method.scheme.name().into(),
                particles: plan.particles,
                steps: result.steps as usize,
                rejected_steps: 0,
                time: result.time,
                completed: failure.is_none(),
                failure: failure.clone(),
                warnings: courant_warning(plan, result).into_iter().collect(),
                l1: ErrorNorms { value: finite(seen.l1), ..ErrorNorms::default() },
                l1_note: Some(match failure {
                    None => "one quantity is advected: its norm is `value`".into(),
                    Some(_) => BROKEN.into(),
                }),
                conservation: ConservationRecord {
                    mass: relative.and_then(finite),
                    ..ConservationRecord::default()
                },
                conservation_note: Some(match (&failure, relative) {
                    (Some(_), _) => BROKEN.into(),
                    (None, Some(_)) => {
                        "one quantity is advected: the drift of its mean is `mass`".into()
                    }
                    (None, None) => {
                        "the mean is zero and has no relative drift: see `mean_drift`".into()
                    }
                }),
                wall_seconds,
            },
            kernel: plan.method.kernel.name().into(),
            ratio: to_text(ratio),
            cfl: result.courant_number,
            layout: match plan.layout {
                Layout::Lattice => "lattice",
                Layout::Uniform => "uniform",
                Layout::Disordered { .. } => "disordered",
            },
            l2: finite(seen.l2),
            l_infinity: finite(seen.l_infinity),
            total_variation: finite(seen.total_variation),
            exact_total_variation: finite(seen.exact_total_variation),
            minimum: finite(seen.extrema.min),
            maximum: finite(seen.extrema.max),
            mean_drift: finite(seen.mean_drift),
            interactions: result.interactions,
        }
    }
}

/// What is to be said where equal steps to the end have another Courant number than the one asked for.
fn courant_warning(plan: &RunPlan, result: &AdvectionRun) -> Option<String> {
    let (asked, used) = (plan.method.courant_number, result.courant_number);
    // Rounding of the quotient is no change.
    ((asked - used).abs() > 1e-12 * asked).then(|| {
        format!(
            "C = {} does not divide the way: equal steps to t = {} have C = {}",
            short(asked),
            short(plan.periods),
            significant(used, 8)
        )
    })
}

/// Why a run did not reach its end with numbers.
fn failure(result: &AdvectionRun) -> Option<String> {
    let after = |steps| format!("after {steps} steps, at t = {}", significant(result.time, 4));
    match result.outcome {
        Outcome::Completed => None,
        Outcome::Overflowed { steps } => Some(format!(
            "the values overflowed {}: the scheme is unstable at C = {}",
            after(steps),
            significant(result.courant_number, 6)
        )),
        Outcome::Cancelled { steps } => Some(format!("cancelled {}", after(steps))),
    }
}

/// `position,initial,computed,exact`, one row per particle.
pub fn profile_csv(result: &AdvectionRun) -> String {
    let mut text = String::from("position,initial,computed,exact\n");
    for (i, position) in result.positions.iter().enumerate() {
        writeln!(
            text,
            "{position},{},{},{}",
            result.initial[i], result.computed[i], result.exact[i]
        )
        .expect("writing to a string succeeds");
    }
    text
}

/// The exact solution as a line with jumps, drawn between the particles.
///
/// The rows run over cell edges `ξ = j/n` and stay constant within a cell, so that a jump is upright.
pub fn exact_line(plan: &RunPlan, time: f64) -> Series {
    const CELLS: usize = 2000;
    let points = (0..CELLS).flat_map(|cell| {
        let at = |offset: f64| (cell as f64 + offset) / CELLS as f64;
        // The middle of the cell decides, so that no rounding of a jump's place shows.
        let value = plan.scene.exact(at(0.5), time);
        [(at(0.0), value), (at(1.0), value)]
    });
    Series::line(points).color(Color::GREY).width(1.0).label("exact")
}

/// The computed values as markers; of many particles every few.
pub fn profile_markers(result: &AdvectionRun, marker: Marker, color: Color) -> Series {
    let every = result.positions.len().div_ceil(MARKERS);
    let points = result.positions.iter().copied().zip(result.computed.iter().copied());
    Series::markers(points.step_by(every), marker).color(color)
}

/// Five digits at most, without zeros at the end.
fn short(value: f64) -> f64 {
    format!("{value:.4e}").parse().expect("a number that was printed can be read")
}

/// Computed and exact profile.
pub fn profile_figure(plan: &RunPlan, ratio: &Rational, result: &AdvectionRun) -> Figure {
    let method = &plan.method;
    let title = format!(
        "{}, {}, l/Δξ = {}, C = {}, N = {}, t = {}",
        method.scheme.title(),
        method.kernel.title(),
        to_text(ratio),
        short(result.courant_number),
        plan.particles,
        short(result.time)
    );
    let panel = Panel::new(Axis::linear("ξ").range(0.0, 1.0), Axis::linear("u"))
        .layer(exact_line(plan, result.time))
        .layer(
            profile_markers(result, Marker::Circle, Color::BLUE)
                .fill(Color::WHITE)
                .size(3.0)
                .label("computed"),
        );
    Figure::single(panel).title(title).size(6.0, 3.9)
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::integer;
    use courant_analysis::kernel::Kernel;
    use courant_simulation::advection::{AdvectionScheme, Method, Scene, run};

    fn plan(scheme: AdvectionScheme, courant_number: f64, periods: f64) -> RunPlan {
        let kernel = Kernel::CubicSpline;
        let method = Method { scheme, kernel, ratio: 2.0, courant_number };
        RunPlan { scene: Scene::Step, method, particles: 40, periods, layout: Layout::Uniform }
    }

    #[test]
    fn an_overflow_is_a_failure_without_numbers() {
        let plan = plan(AdvectionScheme::EulerSph, 4.0, 1e4);
        let result = run(&plan).unwrap();
        let record = AdvectionRecord::new(&plan, &integer(2), &result, 0.1);
        assert!(!record.run.completed && record.run.l1.value.is_none() && record.l2.is_none());
        assert!(record.run.failure.as_ref().unwrap().contains("overflowed after"));
        assert!(serde_json::to_value(&record).unwrap()["total_variation"].is_null());
    }

    #[test]
    fn the_csv_has_a_row_for_every_particle() {
        let plan = plan(AdvectionScheme::GodunovSph, 1.0, 1.0);
        let result = run(&plan).unwrap();
        let text = profile_csv(&result);
        assert_eq!(text.lines().count(), 41);
        // The norm from the file's own columns, by the definition.
        let sum: f64 = text
            .lines()
            .skip(1)
            .map(|line| {
                let fields: Vec<f64> = line.split(',').map(|f| f.parse().unwrap()).collect();
                (fields[2] - fields[3]).abs()
            })
            .sum();
        let record = AdvectionRecord::new(&plan, &integer(2), &result, 0.1);
        assert!((sum / 40.0 - record.run.l1.value.unwrap()).abs() < 1e-15);
        assert!(record.run.conservation.mass.unwrap().abs() < 1e-13);
    }
}
