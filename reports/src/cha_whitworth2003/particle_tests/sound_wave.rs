//! Figures 6–10: a pulse of velocity that parts, is reflected and comes back.

use super::runs::{EARLY, Runs, Solved};
use super::text;
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::page::Item;
use crate::particle_profile::{Quantity, exact_line, profile_csv};
use crate::words;
use courant_simulation::particles::ParticleMethod;

const FIGURES: [(usize, ParticleMethod); 5] = [
    (6, ParticleMethod::Gph1),
    (7, ParticleMethod::Gph2),
    (8, ParticleMethod::Gph3),
    (9, ParticleMethod::Gph4),
    (10, ParticleMethod::Sph1),
];

pub(super) fn figures(runs: &Runs) -> Vec<Item> {
    FIGURES.iter().map(|&(number, method)| figure(runs, number, method)).collect()
}

fn figure(runs: &Runs, number: usize, method: ParticleMethod) -> Item {
    let snapshots = [runs.early(method), runs.get("sound-wave", method)];
    let looks = [(Color::BLUE, Marker::Circle), (Color::VERMILION, Marker::Square)];
    let shown = [(Quantity::Density, "(a) density"), (Quantity::Velocity, "(b) velocity")];
    let panels = shown.map(|(quantity, title)| {
        let mut panel =
            Panel::new(Axis::linear("x").range(-0.5, 0.5), Axis::linear(quantity.label()))
                .title(title);
        for (solved, (color, marker)) in snapshots.iter().zip(looks) {
            let Solved { scene, run, .. } = solved;
            let values = match quantity {
                Quantity::Density => &run.profile.density,
                _ => &run.profile.velocity,
            };
            let points = run.profile.x.iter().copied().zip(values.iter().copied());
            panel = panel.layer(
                Series::markers(points, marker)
                    .color(color)
                    .fill(None)
                    .size(2.3)
                    .width(0.6)
                    .label(format!("particles, t = {}", run.time)),
            );
            let exact = exact_line(scene, quantity, run.time);
            panel = panel.layer(Series::width(exact, 0.7));
        }
        panel
    });
    let Solved { scene, options, run, .. } = snapshots[1];
    let title = if method.is_godunov() {
        format!("GPH case {}", number - 5)
    } else {
        "SPH 1 (SPH 2 differs by less than the width of a marker)".into()
    };
    let name = format!("figure_{number:02}");
    let caption = text().text(
        "sound_wave_caption",
        words![
            "number" = number,
            "title" = title,
            "early" = EARLY,
            "late" = scene.end_time,
            "particles" = run.profile.len(),
            "settings" = Solved::settings(options),
            "peak" = format!("{:.3}", peak(snapshots[1])),
        ],
    );
    let data = snapshots.iter().zip(["early", "late"]).map(|(solved, when)| {
        (format!("{name}_{when}.csv"), profile_csv(&solved.scene, &solved.run, true))
    });
    let figure = Figure::grid(2, 1)
        .size(5.6, 5.7)
        .title(format!("Isothermal sound wave, {}", method.title()))
        .panels(panels);
    text().figure(&name, words!["caption" = caption], figure, data.collect())
}

/// The largest velocity over the largest exact one: half the amplitude of the initial pulse, once its halves have
/// parted.
pub(super) fn peak(solved: &Solved) -> f64 {
    let [from, to] = solved.scene.window;
    let exact = (0..=2000).filter_map(|k| {
        let x = from + (to - from) * f64::from(k) / 2000.0;
        solved.scene.exact(x, solved.run.time).map(|state| state.velocity())
    });
    let largest = |values: &mut dyn Iterator<Item = f64>| {
        values.fold(0.0_f64, |largest, value| largest.max(value.abs()))
    };
    let mut computed = solved.run.profile.velocity.iter().copied();
    largest(&mut computed) / largest(&mut { exact })
}
