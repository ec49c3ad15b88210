//! Courant number against error and failure, for each flux and test.

use super::cost::curve;
use super::runs::{LAGRANGIAN, PARTICLES, compare, method, tube};
use super::table_2::sound_growth;
use super::{Detail, error_or_failure, panel_title, text};
use crate::cells;
use crate::figure::{Axis, Color, Dash, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::{csv, or_dash};
use courant_simulation::lagrangian::StepRule;
use courant_simulation::method::Method;
use courant_simulation::run::Failure;
use rayon::prelude::*;

/// The stability limit of sound with the cubic spline at l/Δξ = 2.
const STABLE: f64 = 15.0 / 8.0;
/// The monotonicity limit.
const MONOTONE: f64 = 8.0 / 5.0;
/// Halvings of the interval between the last run that ended and the first that failed.
const HALVINGS: usize = 5;

fn run(test: usize, name: &str, cfl: f64, step: StepRule) -> Result<f64, Failure> {
    let tube = tube(test);
    let mut method = method(name);
    if let Method::Lagrangian(options) = &mut method {
        options.cfl = cfl;
        options.step = step;
    }
    let run = method.run(&tube, PARTICLES).expect("the options are valid");
    match run.failure {
        Some(failure) => Err(failure),
        None => Ok(compare(&tube, &run).l1.density),
    }
}

/// All runs of one flux, test and step rule.
struct Curve {
    test: usize,
    name: &'static str,
    step: StepRule,
    /// Courant numbers with errors.
    points: Vec<(f64, Result<f64, Failure>)>,
    /// The first failure from below, and how precisely it is known.
    threshold: Option<(f64, f64, Failure)>,
}

impl Curve {
    fn new(test: usize, name: &'static str, step: StepRule, grid: &[f64]) -> Self {
        let points: Vec<_> = grid.iter().map(|&cfl| (cfl, run(test, name, cfl, step))).collect();
        let first = points.iter().position(|(_, result)| result.is_err());
        let threshold = first.map(|index| {
            let mut low = if index == 0 { 0.0 } else { points[index - 1].0 };
            let (mut high, result) = points[index];
            let mut failure = result.expect_err("this is where it failed");
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                match run(test, name, middle, step) {
                    Ok(_) => low = middle,
                    Err(found) => (high, failure) = (middle, found),
                }
            }
            (low, high, failure)
        });
        Self { test, name, step, points, threshold }
    }

    /// The smallest error of the runs that ended.
    fn best(&self) -> Option<(f64, f64)> {
        let ended = self.points.iter().filter_map(|(cfl, result)| Some((*cfl, result.ok()?)));
        ended.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The largest Courant number up to which the error stays within 1.2 times that of small steps.
    fn accurate(&self) -> Option<f64> {
        let reference = run(self.test, self.name, 0.1, StepRule::Current).ok()?;
        let good =
            |result: &Result<f64, Failure>| result.is_ok_and(|error| error <= 1.2 * reference);
        let end = self.points.iter().position(|(_, result)| !good(result));
        let count = end.unwrap_or(self.points.len());
        Some(self.points[..count].last()?.0)
    }
}

/// Figure and table.
pub fn items(detail: Detail) -> Vec<Item> {
    let step = if detail == Detail::Quick { 0.3 } else { 0.1 };
    let grid: Vec<f64> = (1..=(3.0 / step) as usize).map(|i| i as f64 * step).collect();
    let cases: Vec<(usize, &'static str, StepRule)> = (1..=4)
        .flat_map(|test| LAGRANGIAN.map(|name| (test, name)))
        .flat_map(|(test, name)| {
            [StepRule::Current, StepRule::Initial].map(|rule| (test, name, rule))
        })
        .collect();
    let curves: Vec<Curve> = cases
        .into_par_iter()
        .map(|(test, name, rule)| Curve::new(test, name, rule, &grid))
        .collect();
    vec![figure(&curves), text().table("section_3_courant_limits", &[], curves.iter().map(row))]
}

fn figure(curves: &[Curve]) -> Item {
    let mut figure = Figure::grid(2, 2)
        .size(7.0, 6.0)
        .title("Godunov-type SPH: cubic B-spline, l/Δξ = 2, N = 100, steps from the current state");
    let mut lines = Vec::new();
    for test in 1..=4 {
        let mut panel = Panel::new(
            Axis::linear("Courant number of sound, ρcΔt/Δξ").range(0.0, 3.05),
            Axis::log("Σ|e|/N of ρ").range(7e-3, 12.0),
        )
        .title(panel_title(test))
        .layer(Series::vertical(MONOTONE).dash(Dash::Dashed).label("monotone up to 8/5"))
        .layer(
            Series::vertical(STABLE)
                .color(Color::BLACK)
                .dash(Dash::Dashed)
                .label("stable up to 15/8"),
        );
        for one in curves.iter().filter(|one| one.test == test) {
            for (cfl, result) in &one.points {
                let step = format!("{:?}", one.step);
                lines.push(cells![test, one.name, step, cfl, error_or_failure(result)]);
            }
        }
        let current = |one: &&Curve| one.test == test && one.step == StepRule::Current;
        for (index, one) in curves.iter().filter(current).enumerate() {
            let ended: Vec<(f64, f64)> =
                one.points.iter().map_while(|(cfl, result)| Some((*cfl, result.ok()?))).collect();
            let last = ended.last().copied();
            // The same colours as in the other figures: the Lagrangian methods are the last three of five.
            panel = curve(panel, one.name, index + 2, ended);
            if let (Some((_, high, _)), Some((_, error))) = (&one.threshold, last) {
                panel = panel.layer(
                    Series::markers([(*high, error)], Marker::Cross)
                        .size(6.0)
                        .width(1.4)
                        .label("fails from here on"),
                );
            }
        }
        figure = figure.panel(panel);
    }
    let data = csv("test,method,step,cfl,l1_density,failure", lines);
    let data = vec![("section_3_courant.csv".into(), data)];
    text().figure("section_3_courant", &[], figure, data)
}

fn row(one: &Curve) -> Vec<String> {
    let (rule, limit) = match one.step {
        StepRule::Current => ("current state", STABLE),
        StepRule::Initial => ("initial data", STABLE / sound_growth(one.test).max(1.0)),
    };
    let end = one.points.last().map_or(0.0, |point| point.0);
    let (from, reason) = match &one.threshold {
        Some((low, high, failure)) => (format!("{low:.3}–{high:.3}"), failure.to_string()),
        None => (format!("above {end:.1}"), String::new()),
    };
    let best = one.best();
    cells![
        one.test,
        one.name,
        rule,
        significant(limit, 3),
        or_dash(one.accurate(), 2),
        from,
        or_dash(best.map(|best| best.1), 3),
        or_dash(best.map(|best| best.0), 2),
        reason,
    ]
}
