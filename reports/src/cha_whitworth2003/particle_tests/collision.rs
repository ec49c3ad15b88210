//! Figure 27 and how far particles stay in their order when streams collide.

use super::runs::{Plan, Runs, Solved, scene};
use super::text;
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::page::Item;
use crate::particle_profile::{Quantity, exact_line, profile_csv};
use crate::{cells, words};
use courant_simulation::particles::{MethodOptions, ParticleMethod};
use courant_simulation::riemann::State;
use courant_simulation::scene::{Flow, Layer, Scene};

const SCENES: [(&str, &str); 2] =
    [("collision-subsonic", "each at 0.6 c"), ("collision-supersonic", "each at 1.2 c")];
const METHODS: [(ParticleMethod, &str); 2] =
    [(ParticleMethod::Gph3, "GPH case 3"), (ParticleMethod::Sph1, "SPH 1")];

/// What the figure shows of the scene: the shocks at the end, and some gas outside.
const HALF_WIDTH: f64 = 0.12;

/// Density of both collisions with GPH case 3 and SPH; the colours say from which side a particle came.
pub(super) fn figure(runs: &Runs) -> Item {
    let mut panels = Vec::new();
    let mut data = Vec::new();
    for (scene_name, speed) in SCENES {
        for (method, title) in METHODS {
            let solved = runs.get(scene_name, method);
            let Solved { scene, run, .. } = solved;
            let scene = Scene { window: [-HALF_WIDTH, HALF_WIDTH], ..scene.clone() };
            let sides = [
                (Marker::Circle, Color::BLUE, "came from the left", 0..run.profile.len() / 2),
                (
                    Marker::Square,
                    Color::VERMILION,
                    "came from the right",
                    run.profile.len() / 2..run.profile.len(),
                ),
            ];
            let mut panel = Panel::new(
                Axis::linear("x").range(-HALF_WIDTH, HALF_WIDTH),
                // All four on one scale, to be compared.
                Axis::linear(Quantity::Density.label()).range(0.95, 1.85),
            )
            .title(format!(
                "({}) {title}, streams {speed}, t = {}",
                char::from(b'a' + panels.len() as u8),
                run.time
            ))
            .layer(exact_line(&scene, Quantity::Density, run.time));
            for (marker, color, label, range) in sides {
                let shown = range.filter(|&i| run.profile.x[i].abs() <= HALF_WIDTH);
                let points = shown.map(|i| (run.profile.x[i], run.profile.density[i]));
                panel = panel.layer(
                    Series::markers(points, marker)
                        .color(color)
                        .fill(None)
                        .size(2.8)
                        .width(0.6)
                        .label(label),
                );
            }
            panels.push(panel);
            let file = format!("figure_27_{scene_name}_{}.csv", method.name());
            data.push((file, profile_csv(&solved.scene, run, true)));
        }
    }
    let gph = runs.get(SCENES[0].0, ParticleMethod::Gph3);
    let words =
        words!["particles" = gph.run.profile.len(), "settings" = Solved::settings(&gph.options),];
    let figure = Figure::grid(2, 2).size(7.4, 5.4).panels(panels);
    text().figure("figure_27", words, figure, data)
}

/// Particles out of order in one collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PenetrationCount {
    /// The method.
    pub method: ParticleMethod,
    /// The relative velocity of the streams in sound speeds.
    pub approach: f64,
    /// Whether the smoothing lengths stay constant.
    pub constant_smoothing: bool,
    /// Neighbours in the wrong order, the most after any step; `None` if the run broke down.
    pub largest: Option<usize>,
}

const APPROACH: [f64; 6] = [0.6, 1.2, 2.0, 4.0, 6.0, 10.0];

/// Collisions from slow to fast with adaptive and with constant smoothing lengths, every method.
fn collisions() -> impl Iterator<Item = (f64, Plan)> {
    let scene = scene("collision-supersonic");
    let state = |v| State::new(1.0, v, 1.0).expect("density and pressure are positive");
    let edge = scene.domain[1];
    let streams = move |approach: f64, constant_smoothing: bool| {
        let layers = vec![
            Layer::uniform(0.0, &state(0.5 * approach)),
            Layer::uniform(edge, &state(-0.5 * approach)),
        ];
        Scene { flow: Flow::Layers(layers), constant_smoothing, ..scene.clone() }
    };
    ParticleMethod::ALL.into_iter().flat_map(move |method| {
        let streams = streams.clone();
        [false, true].into_iter().flat_map(move |constant| {
            APPROACH.map(|approach| {
                (approach, (streams(approach, constant), MethodOptions::new(method)))
            })
        })
    })
}

pub(super) fn plans() -> impl Iterator<Item = Plan> {
    collisions().map(|(_, plan)| plan)
}

/// What came of the collisions.
pub fn penetrations(runs: &Runs) -> Vec<PenetrationCount> {
    collisions()
        .map(|(approach, plan)| {
            let Solved { scene, options, run, .. } = runs.of(&plan);
            let largest = run.completed().then_some(run.penetration.largest);
            let (method, constant_smoothing) = (options.method, scene.constant_smoothing);
            PenetrationCount { method, approach, constant_smoothing, largest }
        })
        .collect()
}

pub(super) fn table(counts: &[PenetrationCount]) -> Item {
    let speeds = APPROACH.map(|approach| format!("{approach} c"));
    let rows = counts.chunks(APPROACH.len()).map(|row| {
        let h = if row[0].constant_smoothing { "constant" } else { "adaptive" };
        let mut cells = cells![row[0].method.name(), h];
        cells.extend(row.iter().map(|count| {
            count.largest.map_or_else(|| "broke down".into(), |largest| largest.to_string())
        }));
        cells
    });
    text().wide_table("penetration", &[], &speeds, rows)
}
