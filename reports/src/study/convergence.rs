//! How errors fall with the number of particles, and with work.

use super::plan::ByDetail;
use super::tubes::{Tubes, density_error, error_or_failure, method};
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::{PaperText, csv};
use crate::report::Detail;
use crate::timing::timed;
use crate::{cells, words};
use courant_simulation::run::Failure;
use rayon::prelude::*;
use serde::Deserialize;

/// Numbers of particles, which double.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    from: usize,
    most: ByDetail<usize>,
    /// Methods that stop earlier.
    slow: Vec<String>,
    most_of_slow: ByDetail<usize>,
}

impl Plan {
    fn most(&self, name: &str, detail: Detail) -> usize {
        let slow = self.slow.iter().any(|slow| slow == name);
        *(if slow { &self.most_of_slow } else { &self.most }).at(detail)
    }

    fn resolutions(&self, most: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(self.from), |n| Some(2 * n)).take_while(move |&n| n <= most)
    }
}

/// A run with its error, or why there is none, and its cost.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    /// The tube, by its place.
    pub test: usize,
    /// The method, by its place.
    pub method: usize,
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

/// Every method on every tube with more and more particles, the largest numbers first.
pub fn points(text: &PaperText, tubes: &Tubes, detail: Detail) -> Vec<Point> {
    let plan: Plan = text.plan("convergence");
    let resolutions = |(test, method): (usize, usize)| {
        let most = plan.most(&tubes.methods[method], detail);
        plan.resolutions(most).map(move |particles| (test, method, particles))
    };
    let mut cases: Vec<_> = tubes.cases().flat_map(resolutions).collect();
    // The long runs first, so that none is left alone at the end.
    cases.sort_by_key(|case| std::cmp::Reverse(case.2));
    let run = |(test, name, particles): (usize, usize, usize)| {
        let (tube, method) = (tubes.scene(test), method(&tubes.methods[name]));
        let (run, seconds) = timed(|| method.run(&tube, particles));
        let run = run.expect("the default options are valid");
        Point {
            test,
            method: name,
            particles,
            error: density_error(&tube, &run),
            steps: run.steps,
            pairs: run.counters.interactions,
            seconds,
        }
    };
    cases.into_par_iter().with_max_len(1).map(run).collect()
}

/// The slope of `−ln error` over `ln N` by least squares; `None` for fewer than two points.
pub fn order(points: &[(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    if points.len() < 2 {
        return None;
    }
    let logs = || points.iter().map(|&(n, error)| (n.ln(), error.ln()));
    let (mx, my) = logs().fold((0.0, 0.0), |sum, (x, y)| (sum.0 + x / count, sum.1 + y / count));
    let (xy, xx) = logs()
        .fold((0.0, 0.0), |sum, (x, y)| (sum.0 + (x - mx) * (y - my), sum.1 + (x - mx).powi(2)));
    Some(-xy / xx)
}

/// Figures and tables: error against particles, error against work.
pub fn items(text: &PaperText, tubes: &Tubes, detail: Detail, points: &[Point]) -> Vec<Item> {
    let plan: Plan = text.plan("convergence");
    [by_particles(text, tubes, &plan, detail, points), by_work(text, tubes, points)].concat()
}

fn by_particles(
    text: &PaperText,
    tubes: &Tubes,
    plan: &Plan,
    detail: Detail,
    points: &[Point],
) -> Vec<Item> {
    let all: Vec<usize> = plan.resolutions(*plan.most.at(detail)).collect();
    let columns: Vec<String> = all.iter().map(|n| format!("N = {n}")).collect();
    let mut rows = Vec::new();
    let mut figure = figure(tubes);
    for (test, (name, _)) in tubes.tests.iter().enumerate() {
        let mut panel = Panel::new(Axis::log("N"), error_axis()).title(tubes.panel_title(test));
        for (index, method) in tubes.methods.iter().enumerate() {
            let mut of: Vec<&Point> =
                points.iter().filter(|p| (p.test, p.method) == (test, index)).collect();
            let failed = of.iter().filter(|p| p.error.is_err()).map(|p| p.particles as f64);
            let failed: Vec<f64> = failed.collect();
            let mut row = cells![name, method];
            row.extend(all.iter().map(|&n| {
                let found = of.iter().find(|point| point.particles == n);
                match found.map(|point| point.error) {
                    None => "not run".to_string(),
                    Some(Err(_)) => "failed".into(),
                    Some(Ok(error)) => significant(error, 3),
                }
            }));
            of.sort_by_key(|point| point.particles);
            let series = of.iter().filter_map(|p| Some((p.particles as f64, p.error.ok()?)));
            let series: Vec<(f64, f64)> = series.collect();
            let slope = |points: &[(f64, f64)]| {
                order(points).map_or_else(|| "–".into(), |order| format!("{order:.2}"))
            };
            row.push(slope(&series));
            row.push(slope(&series[series.len().saturating_sub(3)..]));
            rows.push(row);
            if index == 0
                && let Some(&(n, error)) = series.last()
            {
                let first = series[0].0;
                let guide = [(first, 0.5 * error * n / first), (n, 0.5 * error)];
                panel = panel
                    .layer(Series::line(guide).color(Color::GREY).width(0.7).label("first order"));
            }
            panel = tubes.curve(panel, index, series);
            panel = failures(panel, index, failed.into_iter());
        }
        figure = figure.panel(panel);
    }
    let lines = points.iter().map(|point| {
        let (test, method) = (&tubes.tests[point.test].0, &tubes.methods[point.method]);
        cells![test, method, point.particles, error_or_failure(&point.error)]
    });
    let data = csv("test,method,particles,l1_density,failure", lines);
    let name = tubes.item("convergence");
    let most = words!["most" = plan.most_of_slow.at(detail)];
    vec![
        text.figure(&name, most, figure, vec![(format!("{name}_points.csv"), data)]),
        text.wide_table(&format!("{name}_table"), &[], &columns, rows),
    ]
}

fn by_work(text: &PaperText, tubes: &Tubes, points: &[Point]) -> Vec<Item> {
    let mut figure = figure(tubes);
    let mut rows = Vec::new();
    for (test, (name, _)) in tubes.tests.iter().enumerate() {
        let mut panel = Panel::new(Axis::log("fluxes or forces of pairs"), error_axis())
            .title(tubes.panel_title(test));
        for (index, method) in tubes.methods.iter().enumerate() {
            // The largest numbers of particles were run first.
            let of = |point: &&Point| (point.test, point.method) == (test, index);
            let series: Vec<&Point> = points.iter().rev().filter(of).collect();
            rows.extend(series.iter().map(|point| {
                let (error, pairs) = (point.error.ok(), point.pairs as f64);
                cells![
                    name,
                    method,
                    point.particles,
                    error.map_or_else(|| "failed".into(), |error| significant(error, 3)),
                    point.steps,
                    point.pairs,
                    error.map_or_else(|| "–".into(), |error| significant(pairs * error, 3)),
                    significant(1e3 * point.seconds, 2),
                ]
            }));
            let shown = series.iter().filter_map(|p| Some((p.pairs as f64, p.error.ok()?)));
            panel = tubes.curve(panel, index, shown.collect());
            let failed = series.iter().filter(|p| p.error.is_err()).map(|p| p.pairs as f64);
            panel = failures(panel, index, failed);
        }
        figure = figure.panel(panel);
    }
    let name = tubes.item("cost");
    let table = text.table(&format!("{name}_table"), &[], rows);
    vec![text.figure(&name, &[], figure, Vec::new()), table]
}

fn figure(tubes: &Tubes) -> Figure {
    Figure::grid(tubes.tests.len().div_ceil(2), 2).size(7.0, 6.0).title(&tubes.settings)
}

/// Runs of one of the methods that failed: they have a cost, but no error, and stand at the foot of the panel.
fn failures(panel: Panel, index: usize, at: impl Iterator<Item = f64>) -> Panel {
    let marks: Vec<(f64, f64)> = at.map(|x| (x, LEAST_ERROR * 1.3)).collect();
    match marks.is_empty() {
        true => panel,
        false => {
            let marks = Series::markers(marks, Marker::Cross).color(Color::qualitative(index));
            panel.layer(marks.size(5.0).label("run failed: no error, drawn at the foot"))
        }
    }
}

/// The axis of errors: all tests on one scale.
fn error_axis() -> Axis {
    Axis::log("Σ|e|/N of ρ").range(LEAST_ERROR, 4.0)
}

/// Where the axis of errors begins.
const LEAST_ERROR: f64 = 5e-4;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_is_the_slope_of_the_logarithms() {
        let points: Vec<(f64, f64)> =
            [50.0, 100.0, 200.0].iter().map(|&n: &f64| (n, 3.0 * n.powf(-0.7))).collect();
        assert!((order(&points).expect("three points") - 0.7).abs() < 1e-12);
        assert_eq!(order(&points[..1]), None);
    }
}
