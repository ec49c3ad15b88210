//! Work against error: the shock tube with more and more particles.

use super::runs::{Plan, Runs, every_method, scene};
use super::text;
use crate::figure::{Axis, Color, Dash, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Item;
use crate::report::Detail;
use crate::{cells, words};
use courant_simulation::particles::{MethodOptions, ParticleMethod};
use courant_simulation::scene::Scene;

const SCENE: &str = "sod-sph";

fn numbers(detail: Detail) -> &'static [usize] {
    match detail {
        Detail::Quick => &[50, 100],
        Detail::Standard => &[100, 200, 400, 800],
        Detail::Full => &[100, 200, 400, 800, 1600, 3200],
    }
}

fn scene_of(particles: usize) -> Scene {
    Scene { particles, ..scene(SCENE) }
}

pub(super) fn plans(detail: Detail) -> impl Iterator<Item = Plan> {
    numbers(detail).iter().flat_map(|&particles| every_method(&scene_of(particles)))
}

pub(super) fn items(runs: &Runs, detail: Detail) -> [Item; 2] {
    let numbers = numbers(detail);
    let mut rows = Vec::new();
    let mut panel =
        Panel::new(Axis::log("pair interactions"), Axis::log("L1 error of the density"));
    for (i, method) in ParticleMethod::ALL.into_iter().enumerate() {
        let mut before: Option<f64> = None;
        let mut curve = Vec::new();
        for &particles in numbers {
            let solved = runs.of(&(scene_of(particles), MethodOptions::new(method)));
            let (error, pairs) = (solved.density_error(), solved.run.counters.interactions);
            let order = before.zip(error).map(|(before, now)| (before / now).log2());
            rows.push(cells![
                method.name(),
                solved.run.profile.len(),
                error.map_or_else(|| "broke down".into(), |error| significant(error, 3)),
                order.map_or_else(|| "–".into(), |order| format!("{order:.2}")),
                pairs,
                significant(solved.seconds, 3),
            ]);
            curve.extend(error.map(|error| (pairs as f64, error)));
            before = error;
        }
        let (color, label) = (Color::qualitative(i), method.title());
        panel = panel
            .layer(Series::line(curve.clone()).color(color).dash(Dash::nth(i)).label(label))
            .layer(
                Series::markers(curve, Marker::nth(i))
                    .color(color)
                    .fill(Color::WHITE)
                    .size(4.2)
                    .label(label),
            );
    }
    let words = words!["scene" = SCENE, "least" = numbers[0], "most" = numbers[numbers.len() - 1],];
    let figure = Figure::single(panel).size(5.2, 3.8);
    [
        text().figure("particle_efficiency", words, figure, Vec::new()),
        text().table("particle_efficiency_table", words!["scene" = SCENE], rows),
    ]
}
