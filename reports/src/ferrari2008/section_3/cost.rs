//! Computing time against error.

use super::runs::{METHODS, compare, method, tube};
use super::{COMMAND, Detail, panel_title, table_item};
use crate::figure::{Axis, Color, Figure, Line, Marker, Markers, Panel};
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_simulation::run::Failure;
use std::time::Instant;

/// The error of a run, or why there is none.
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
}

impl Point {
    /// Runs and compares.
    pub fn run(test: usize, name: &'static str, particles: usize) -> Self {
        let tube = tube(test);
        let run = method(name).run(&tube, particles).expect("the default options are valid");
        let error = match run.failure {
            Some(failure) => Err(failure),
            None => Ok(compare(&tube, &run).l1.density),
        };
        Self { test, name, particles, error }
    }
}

/// A run with its time.
#[derive(Debug, Clone, Copy)]
pub struct TimedPoint {
    /// The run.
    pub point: Point,
    /// Wall-clock seconds of the fastest of a few repetitions.
    pub seconds: f64,
}

/// Numbers of particles that double from 50.
pub fn resolutions(most: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(50), |n| Some(2 * n)).take_while(move |&n| n <= most)
}

/// Runs one after the other, so that no run waits for another. With fewer than 1024 particles no loop
/// is shared between threads: the times are those of one core.
pub fn measure(detail: Detail) -> Vec<TimedPoint> {
    let mut points = Vec::new();
    for test in 1..=4 {
        for name in METHODS {
            let most = match (detail, name) {
                (Detail::Full, "sph-adke") => 400,
                (Detail::Full, _) => 800,
                (Detail::Quick, _) => 200,
            };
            for particles in resolutions(most) {
                let (tube, method) = (tube(test), method(name));
                // Short runs are repeated: their first time is that of cold caches.
                let repetitions = if particles <= 200 { 3 } else { 1 };
                let seconds = (0..repetitions)
                    .map(|_| {
                        let start = Instant::now();
                        let run = method.run(&tube, particles);
                        let seconds = start.elapsed().as_secs_f64();
                        run.expect("the default options are valid");
                        seconds
                    })
                    .fold(f64::INFINITY, f64::min);
                points.push(TimedPoint { point: Point::run(test, name, particles), seconds });
            }
        }
    }
    points
}

/// Table and figure.
pub fn items(timed: &[TimedPoint]) -> Vec<Item> {
    let mut table = Table::new(
        "Time of a run against its error; one core, one run at a time. L1: Σ|e|/N of the density",
        &[
            ("test", Align::Left),
            ("method", Align::Left),
            ("N", Align::Right),
            ("L1 ρ", Align::Right),
            ("milliseconds", Align::Right),
            ("ms × L1 ρ", Align::Right),
        ],
    );
    for TimedPoint { point, seconds } in timed {
        let error = point.error.ok();
        let milliseconds = 1e3 * seconds;
        table.push([
            point.test.to_string(),
            point.name.into(),
            point.particles.to_string(),
            error.map_or_else(|| "failed".into(), |error| significant(error, 3)),
            significant(milliseconds, 2),
            error.map_or_else(|| "–".into(), |error| significant(milliseconds * error, 2)),
        ]);
    }
    let mut figure = Figure::grid(2, 2).size(7.0, 5.6).legend_below();
    for test in 1..=4 {
        let mut panel = Panel::new(Axis::log("milliseconds"), Axis::log("Σ|e|/N of ρ"))
            .title(panel_title(test));
        for (index, name) in METHODS.into_iter().enumerate() {
            let points: Vec<(f64, f64)> = timed
                .iter()
                .filter(|timed| timed.point.test == test && timed.point.name == name)
                .filter_map(|timed| Some((1e3 * timed.seconds, timed.point.error.ok()?)))
                .collect();
            panel = curve(panel, name, index, points);
        }
        figure = figure.panel(panel);
    }
    let caption = "Error of the density against the time of the run, one core, N doubling from 50 along \
                   each curve (methods and settings as in Figures 3 to 21). Lower left is better. Runs \
                   that fail have no point. Σ|e|/N weighs by mass for particles and by volume for cells.";
    vec![
        Item::Figure {
            name: "section_3_cost".into(),
            figure: Box::new(figure),
            caption: caption.into(),
            data: Vec::new(),
            command: COMMAND.into(),
        },
        table_item("section_3_cost_table", table),
    ]
}

/// A line with markers for one of the five methods.
pub fn curve(panel: Panel, name: &str, index: usize, points: Vec<(f64, f64)>) -> Panel {
    if points.is_empty() {
        return panel;
    }
    let color = Color::qualitative(index);
    panel.layer(Line::new(points.iter().copied()).color(color).width(0.9).label(name)).layer(
        Markers::new(points, Marker::nth(index))
            .color(color)
            .fill(Color::WHITE)
            .size(3.6)
            .label(name),
    )
}
