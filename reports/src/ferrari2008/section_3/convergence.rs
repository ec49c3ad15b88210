//! How errors fall with the number of particles.

use super::cost::{Point, TimedPoint, curve, resolutions};
use super::runs::METHODS;
use super::{COMMAND, Detail, error_or_failure, panel_title, table_item};
use crate::figure::{Axis, Color, Figure, Line, Panel};
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use rayon::prelude::*;

/// The largest number of particles. The pair search of the adaptive SPH and its pilot density cost
/// twenty seconds at N = 1600 in test 4, so it stops earlier.
fn most(detail: Detail, name: &str) -> usize {
    match (detail, name) {
        (Detail::Full, "sph-adke") => 800,
        (Detail::Full, _) => 3200,
        (Detail::Quick, _) => 200,
    }
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

/// Table and figure. What was measured with its time is not run again.
pub fn items(detail: Detail, timed: &[TimedPoint]) -> Vec<Item> {
    let known = |test, name, n| {
        timed
            .iter()
            .map(|timed| timed.point)
            .find(|point| (point.test, point.name, point.particles) == (test, name, n))
    };
    let mut cases: Vec<(usize, &'static str, usize)> = (1..=4)
        .flat_map(|test| METHODS.map(|name| (test, name)))
        .flat_map(|(test, name)| resolutions(most(detail, name)).map(move |n| (test, name, n)))
        .collect();
    // The long runs first, so that none is left alone at the end.
    cases.sort_by_key(|case| std::cmp::Reverse(case.2));
    let points: Vec<Point> = cases
        .into_par_iter()
        .with_max_len(1)
        .map(|(test, name, n)| known(test, name, n).unwrap_or_else(|| Point::run(test, name, n)))
        .collect();
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
    let names: Vec<String> = all.iter().map(|n| format!("N = {n}")).collect();
    let mut columns = vec![("test", Align::Left), ("method", Align::Left)];
    columns.extend(names.iter().map(|name| (name.as_str(), Align::Right)));
    columns.extend([("order", Align::Right), ("order, last three", Align::Right)]);
    let mut table = Table::new(
        "Σ|e|/N of the density inside [0, 1] against N; orders fitted by least squares over all \
         and over the three largest N that ran",
        &columns,
    );
    let mut figure = Figure::grid(2, 2).size(7.0, 5.6).legend_below();
    for test in 1..=4 {
        let mut panel =
            Panel::new(Axis::log("N"), Axis::log("Σ|e|/N of ρ")).title(panel_title(test));
        for (index, name) in METHODS.into_iter().enumerate() {
            let series = of(test, name);
            let mut row = vec![test.to_string(), name.into()];
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
            table.push(row);
            if index == 0
                && let Some(&(n, error)) = series.last()
            {
                let first = series[0].0;
                let guide = [(first, 0.5 * error * n / first), (n, 0.5 * error)];
                panel = panel
                    .layer(Line::new(guide).color(Color::GREY).width(0.7).label("first order"));
            }
            panel = curve(panel, name, index, series);
        }
        figure = figure.panel(panel);
    }
    let data = vec![("section_3_convergence_points.csv".to_string(), csv(&points))];
    vec![
        Item::Figure {
            name: "section_3_convergence".into(),
            figure: Box::new(figure),
            caption: format!(
                "Error of the density against N for the five methods, settings as in Figures 3 to 21. \
                 Grey: first order. Runs that fail have no point; standard SPH stops at N = {} for its \
                 computing time. A jump that is smeared over N^(−1/2) of the mass makes the order 1/2: \
                 contacts, but for the exact flux, which does not diffuse them. Σ|e|/N weighs by mass for \
                 particles and by volume for cells.",
                most(detail, "sph-adke")
            ),
            data,
            command: COMMAND.into(),
        },
        table_item("section_3_convergence_table", table),
    ]
}

fn csv(points: &[Point]) -> Vec<u8> {
    let mut text = String::from("test,method,particles,l1_density,failure\n");
    for point in points {
        let Point { test, name, particles, error } = point;
        text.push_str(&format!("{test},{name},{particles},{}\n", error_or_failure(error)));
    }
    text.into_bytes()
}
