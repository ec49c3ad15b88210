//! Speed against error: the shock tube with more and more particles.

use super::cost::timed;
use super::{COMMAND, Detail, ReportError, cancelled};
use crate::figure::{Axis, Color, Dash, Figure, Line, Marker, Markers, Panel};
use crate::number::significant;
use crate::page::Item;
use crate::particle_profile::method_title;
use crate::table::{Align, Table};
use courant_simulation::particles::{MethodOptions, ParticleMethod, ParticleScene};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

const SCENE: &str = "sod-sph";

/// One run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    method: ParticleMethod,
    particles: usize,
    /// `Σ|e|/N` of the density; `None` if the run broke down.
    error: Option<f64>,
    seconds: f64,
    interactions: u64,
}

impl Point {
    fn measure(scene: &ParticleScene, particles: usize, method: ParticleMethod) -> Self {
        let (run, seconds) = timed(scene, particles, &MethodOptions::new(method));
        Self {
            method,
            particles: run.profile.len(),
            error: run.errors.filter(|_| run.completed()).map(|errors| errors.density),
            seconds,
            interactions: run.counters.interactions,
        }
    }
}

/// What a point has cost.
type Measure = fn(&Point) -> f64;

/// Methods and numbers of particles, the small runs first.
pub(super) fn runs(detail: Detail) -> Vec<(usize, ParticleMethod)> {
    let numbers: &[usize] = match detail {
        Detail::Full => &[100, 200, 400, 800, 1600, 3200],
        Detail::Quick => &[100, 200, 400],
    };
    numbers
        .iter()
        .flat_map(|&particles| ParticleMethod::ALL.map(|method| (particles, method)))
        .collect()
}

/// From this number on two runs go at a time, each on a thread of its own.
const LONG: usize = 1600;

/// Short runs one after the other, since seconds are measured; long ones two at a time.
pub(super) fn measure(
    detail: Detail,
    progress: &(dyn Fn(usize) -> ControlFlow<()> + Sync),
) -> Result<Vec<Point>, ReportError> {
    let scene = ParticleScene::named(SCENE).expect("it is in the list of scenes");
    let plans = runs(detail);
    let short = plans.partition_point(|&(particles, _)| particles < LONG);
    let mut points = Vec::new();
    for &(particles, method) in &plans[..short] {
        points.push(Point::measure(&scene, particles, method));
        if progress(points.len()).is_break() {
            return Err(cancelled());
        }
    }
    let (next, done, stopped) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicBool::new(false));
    let work = || {
        let mut measured = Vec::new();
        while !stopped.load(Ordering::Relaxed) {
            let index = next.fetch_add(1, Ordering::Relaxed);
            // The most expensive first, so that no thread is left with it alone.
            let Some(&(particles, method)) = plans[short..].iter().rev().nth(index) else { break };
            measured.push((index, Point::measure(&scene, particles, method)));
            let finished = 1 + done.fetch_add(1, Ordering::Relaxed);
            if progress(short + finished).is_break() {
                stopped.store(true, Ordering::Relaxed);
            }
        }
        measured
    };
    let mut long: Vec<(usize, Point)> = std::thread::scope(|scope| {
        let workers = rayon::current_num_threads().min(2);
        let handles: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        handles
            .into_iter()
            .flat_map(|handle| handle.join().expect("a run that breaks down is a result"))
            .collect()
    });
    if stopped.into_inner() {
        return Err(cancelled());
    }
    long.sort_by_key(|&(index, _)| std::cmp::Reverse(index));
    points.extend(long.into_iter().map(|(_, point)| point));
    Ok(points)
}

pub(super) fn items(points: &[Point]) -> Vec<Item> {
    let mut table = Table::new(
        format!(
            "Error of the density (L1) against work: {SCENE}, t = 0.17, customary settings, one thread \
             for each run (from {LONG} particles on two runs at a time). Order: the \
             logarithm to base 2 of the error's fall since half as many particles."
        ),
        &[
            ("method", Align::Left),
            ("N", Align::Right),
            ("L1 density", Align::Right),
            ("order", Align::Right),
            ("seconds", Align::Right),
            ("pair interactions", Align::Right),
        ],
    );
    for method in ParticleMethod::ALL {
        let mut before: Option<f64> = None;
        for point in points.iter().filter(|point| point.method == method) {
            let order = before.zip(point.error).map(|(before, now)| (before / now).log2());
            table.push([
                method.name().to_string(),
                point.particles.to_string(),
                point.error.map_or_else(|| "broke down".into(), |error| significant(error, 3)),
                order.map_or_else(|| "–".into(), |order| format!("{order:.2}")),
                significant(point.seconds, 3),
                point.interactions.to_string(),
            ]);
            before = point.error;
        }
    }
    let axes: [(&str, Measure); 2] = [
        ("seconds on one thread", |point| point.seconds),
        ("pair interactions", |point| point.interactions as f64),
    ];
    let panels = axes.into_iter().enumerate().map(|(k, (label, work))| {
        let letter = char::from(b'a' + k as u8);
        let mut panel = Panel::new(Axis::log(label), Axis::log("L1 error of the density"))
            .title(format!("({letter}) error against {}", if k == 0 { "time" } else { "work" }));
        for (i, method) in ParticleMethod::ALL.into_iter().enumerate() {
            let curve: Vec<(f64, f64)> = points
                .iter()
                .filter(|point| point.method == method)
                .filter_map(|point| Some((work(point), point.error?)))
                .collect();
            let (color, label) = (Color::qualitative(i), method_title(method));
            panel = panel
                .layer(Line::new(curve.clone()).color(color).dash(Dash::nth(i)).label(&label))
                .layer(
                    Markers::new(curve, Marker::nth(i))
                        .color(color)
                        .fill(Color::WHITE)
                        .size(4.2)
                        .label(label),
                );
        }
        panel
    });
    let last = points.last().map_or(0, |point| point.particles);
    let figure = Figure::grid(1, 2).size(7.0, 3.4).panels(panels).legend_below();
    let csv = table.to_csv().into_bytes();
    vec![
        Item::Figure {
            name: "particle_efficiency".into(),
            figure: Box::new(figure),
            caption: format!(
                "Speed against error: L1 error of the density of {SCENE} at t = 0.17 against seconds on one thread and against pair \
                 interactions, 100 to {last} particles, doubled from marker to marker; customary settings. Lower and \
                 further left is better."
            ),
            data: vec![("particle_efficiency_points.csv".into(), csv)],
            command: COMMAND.into(),
        },
        Item::Table { name: "particle_efficiency_table".into(), table, command: COMMAND.into() },
    ]
}
