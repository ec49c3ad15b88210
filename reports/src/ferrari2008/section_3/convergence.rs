//! How errors fall with the number of particles.

use super::cost::{Point, SETTINGS, curve, error_axis, failures};
use super::runs::METHODS;
use super::{Detail, error_or_failure, panel_title, text};
use crate::figure::{Axis, Color, Figure, Panel, Series};
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::csv;
use crate::{cells, words};
use rayon::prelude::*;

/// The largest number of particles. The pair search of the adaptive SPH and its pilot density cost
/// twenty seconds at N = 1600 in test 4, so it stops earlier.
fn most(detail: Detail, name: &str) -> usize {
    match (detail, name) {
        (Detail::Quick, _) => 200,
        (Detail::Standard, "sph-adke") => 400,
        (Detail::Standard, _) | (Detail::Full, "sph-adke") => 800,
        (Detail::Full, _) => 3200,
    }
}

/// Numbers of particles that double from 50.
fn resolutions(most: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(50), |n| Some(2 * n)).take_while(move |&n| n <= most)
}

/// Every method on every test with more and more particles, the largest numbers first.
pub fn points(detail: Detail) -> Vec<Point> {
    let mut cases: Vec<(usize, &'static str, usize)> = (1..=4)
        .flat_map(|test| METHODS.map(|name| (test, name)))
        .flat_map(|(test, name)| resolutions(most(detail, name)).map(move |n| (test, name, n)))
        .collect();
    // The long runs first, so that none is left alone at the end.
    cases.sort_by_key(|case| std::cmp::Reverse(case.2));
    let run = |(test, name, n)| Point::run(test, name, n);
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

/// Table and figure.
pub fn items(detail: Detail, points: &[Point]) -> Vec<Item> {
    let of = |test: usize, name: &str| -> Vec<(f64, f64)> {
        let mut series: Vec<(f64, f64)> = points
            .iter()
            .filter(|point| point.test == test && point.name == name)
            .filter_map(|point| Some((point.particles as f64, point.error.ok()?)))
            .collect();
        series.sort_by(|a, b| a.0.total_cmp(&b.0));
        series
    };
    let all: Vec<usize> = resolutions(most(detail, "finite-volume")).collect();
    let columns: Vec<String> = all.iter().map(|n| format!("N = {n}")).collect();
    let mut rows = Vec::new();
    let mut figure = Figure::grid(2, 2).size(7.0, 6.0).title(SETTINGS);
    for test in 1..=4 {
        let mut panel = Panel::new(Axis::log("N"), error_axis()).title(panel_title(test));
        for (index, name) in METHODS.into_iter().enumerate() {
            let series = of(test, name);
            let mut row = cells![test, name];
            row.extend(all.iter().map(|&n| {
                let found = points
                    .iter()
                    .find(|point| (point.test, point.name, point.particles) == (test, name, n));
                match found.map(|point| point.error) {
                    None => "not run".to_string(),
                    Some(Err(_)) => "failed".into(),
                    Some(Ok(error)) => significant(error, 3),
                }
            }));
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
            panel = curve(panel, name, index, series);
            let failed =
                points.iter().filter(|p| p.test == test && p.name == name && p.error.is_err());
            panel = failures(panel, index, failed.map(|point| point.particles as f64));
        }
        figure = figure.panel(panel);
    }
    let lines = points.iter().map(|point| {
        cells![point.test, point.name, point.particles, error_or_failure(&point.error)]
    });
    let data = csv("test,method,particles,l1_density,failure", lines);
    vec![
        text().figure(
            "section_3_convergence",
            words!["most" = most(detail, "sph-adke")],
            figure,
            vec![("section_3_convergence_points.csv".into(), data)],
        ),
        text().wide_table("section_3_convergence_table", &[], &columns, rows),
    ]
}
