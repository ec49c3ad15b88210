//! Work against error.

use super::runs::{METHODS, compare, method, tube};
use super::{panel_title, text};
use crate::cells;
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Item;
use crate::timing::timed;
use courant_simulation::run::Failure;

/// A run with its error, or why there is none, and its cost.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    /// 1 to 4.
    pub test: usize,
    /// The method.
    pub name: &'static str,
    /// Particles or cells.
    pub particles: usize,
    /// `Σ|e|/N` of the density inside the domain.
    pub error: Result<f64, Failure>,
    /// Steps.
    pub steps: usize,
    /// Fluxes or forces of pairs.
    pub pairs: u64,
    /// Wall-clock seconds of the run.
    pub seconds: f64,
}

impl Point {
    /// Runs and compares.
    pub fn run(test: usize, name: &'static str, particles: usize) -> Self {
        let (tube, method) = (tube(test), method(name));
        let (run, seconds) = timed(|| method.run(&tube, particles));
        let run = run.expect("the default options are valid");
        let error = match run.failure {
            Some(failure) => Err(failure),
            None => Ok(compare(&tube, &run).l1.density),
        };
        Self {
            test,
            name,
            particles,
            error,
            steps: run.steps,
            pairs: run.counters.interactions,
            seconds,
        }
    }
}

/// Figure and table.
pub fn items(points: &[Point]) -> Vec<Item> {
    let mut figure = Figure::grid(2, 2).size(7.0, 6.0).title(SETTINGS);
    let mut rows = Vec::new();
    for test in 1..=4 {
        let mut panel = Panel::new(Axis::log("fluxes or forces of pairs"), error_axis())
            .title(panel_title(test));
        for (index, name) in METHODS.into_iter().enumerate() {
            // The largest numbers of particles were run first.
            let of = |point: &&Point| point.test == test && point.name == name;
            let series: Vec<&Point> = points.iter().rev().filter(of).collect();
            rows.extend(series.iter().map(|point| {
                let (error, pairs) = (point.error.ok(), point.pairs as f64);
                cells![
                    test,
                    name,
                    point.particles,
                    error.map_or_else(|| "failed".into(), |error| significant(error, 3)),
                    point.steps,
                    point.pairs,
                    error.map_or_else(|| "–".into(), |error| significant(pairs * error, 3)),
                    significant(1e3 * point.seconds, 2),
                ]
            }));
            let shown = series.iter().filter_map(|p| Some((p.pairs as f64, p.error.ok()?)));
            panel = curve(panel, name, index, shown.collect());
            let failed = series.iter().filter(|p| p.error.is_err()).map(|p| p.pairs as f64);
            panel = failures(panel, index, failed);
        }
        figure = figure.panel(panel);
    }
    vec![
        text().figure("section_3_cost", &[], figure, Vec::new()),
        text().table("section_3_cost_table", &[], rows),
    ]
}

/// What figures of all methods have in common.
pub const SETTINGS: &str =
    "Godunov-type SPH: cubic B-spline, l/Δξ = 2, Courant number as in Figures 3 to 21";

/// Runs of one of the five methods that failed: they have a cost, but no error, and stand at the foot of the panel.
pub fn failures(panel: Panel, index: usize, at: impl Iterator<Item = f64>) -> Panel {
    let marks: Vec<(f64, f64)> = at.map(|x| (x, LEAST_ERROR * 1.3)).collect();
    match marks.is_empty() {
        true => panel,
        false => {
            let marks = Series::markers(marks, Marker::Cross).color(Color::qualitative(index));
            panel.layer(marks.size(5.0).label("run failed: no error, drawn at the foot"))
        }
    }
}

/// The axis of errors: all four tests on one scale.
pub fn error_axis() -> Axis {
    Axis::log("Σ|e|/N of ρ").range(LEAST_ERROR, 4.0)
}

/// Where the axis of errors begins.
const LEAST_ERROR: f64 = 5e-4;

/// A line with markers for one of the five methods.
pub fn curve(panel: Panel, name: &str, index: usize, points: Vec<(f64, f64)>) -> Panel {
    if points.is_empty() {
        return panel;
    }
    let title = method(name).title();
    let color = Color::qualitative(index);
    panel.layer(Series::line(points.iter().copied()).color(color).width(0.9).label(title)).layer(
        Series::markers(points, Marker::nth(index))
            .color(color)
            .fill(Color::WHITE)
            .size(3.6)
            .label(title),
    )
}
