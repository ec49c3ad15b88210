//! Figure 27 and how far particles stay in their order when streams collide.

use super::COMMAND;
use super::runs::{Runs, Solved};
use crate::figure::{Axis, Color, Figure, Marker, Markers, Panel};
use crate::page::Item;
use crate::particle_profile::{Quantity, exact_line, profile_csv};
use crate::table::{Align, Table};
use courant_simulation::particles::{
    Flow, MethodOptions, ParticleMethod, ParticleScene, run_particles,
};
use courant_simulation::riemann::State;
use rayon::prelude::*;

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
            let scene = ParticleScene { window: [-HALF_WIDTH, HALF_WIDTH], ..scene.clone() };
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
                    Markers::new(points, marker)
                        .color(color)
                        .open()
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
    Item::Figure {
        name: "figure_27".into(),
        figure: Box::new(Figure::grid(2, 2).size(7.4, 5.4).panels(panels).legend_below()),
        caption: format!(
            "Figure 27. Streams that collide at 0.6 c (t = 0.1) and 1.2 c (t = 0.05), isothermal, {} particles; {}; SPH with \
             rk2-heun, α = 1, β = 2. Line: two exact isothermal shocks. Colours meet at the contact and do not mix.",
            gph.run.profile.len(),
            Solved::settings(&gph.options),
        ),
        data,
        command: COMMAND.into(),
    }
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

fn streams(approach: f64, constant_smoothing: bool) -> ParticleScene {
    let scene = ParticleScene::named("collision-supersonic").expect("it is in the list of scenes");
    let state = |v| State::new(1.0, v, 1.0).expect("density and pressure are positive");
    let edge = scene.extent[1];
    let flow = Flow::Layers(vec![(0.0, state(0.5 * approach)), (edge, state(-0.5 * approach))]);
    ParticleScene { flow, constant_smoothing, ..scene }
}

/// Collisions from slow to fast with adaptive and with constant smoothing lengths, every method.
pub fn penetrations() -> Vec<PenetrationCount> {
    let mut plans = Vec::new();
    for method in ParticleMethod::ALL {
        for constant in [false, true] {
            plans.extend(APPROACH.map(|approach| (method, constant, approach)));
        }
    }
    plans
        .into_par_iter()
        .map(|(method, constant_smoothing, approach)| {
            let scene = streams(approach, constant_smoothing);
            let run = run_particles(&scene, scene.particles, &MethodOptions::new(method))
                .expect("the report's options are in range");
            let largest = run.completed().then_some(run.penetration.largest);
            PenetrationCount { method, approach, constant_smoothing, largest }
        })
        .collect()
}

pub(super) fn table(counts: &[PenetrationCount]) -> Item {
    let speeds = APPROACH.map(|approach| format!("{approach} c"));
    let mut columns = vec![("method", Align::Left), ("h", Align::Left)];
    columns.extend(speeds.iter().map(|speed| (speed.as_str(), Align::Right)));
    let mut table = Table::new(
        "Pairs of neighbours that have passed each other, the most after any step, in collisions at a relative velocity of \
         0.6 to 10 sound speeds: isothermal, 200 particles, t = 0.05. Zero: nobody passed.",
        &columns,
    );
    for row in counts.chunks(APPROACH.len()) {
        let h = if row[0].constant_smoothing { "constant" } else { "adaptive" };
        let mut cells = vec![row[0].method.name().to_string(), h.into()];
        cells.extend(row.iter().map(|count| {
            count.largest.map_or_else(|| "broke down".into(), |largest| largest.to_string())
        }));
        table.push(cells);
    }
    Item::Table { name: "penetration".into(), table, command: COMMAND.into() }
}
