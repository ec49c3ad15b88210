//! Runs in two and three dimensions: the figure, the tables of particles and of measures against time.

use crate::figure::{Axis, Color, Dash, Figure, Line, Marker, Markers, Panel};
use crate::gas_run::{describe_particles, eos};
use crate::number::{finite, significant};
use crate::run_record::{NO_ENERGY, RunRecord, RunReport, method_title};
use courant_simulation::field::{FieldFlow, FieldProfile, FieldRun, FieldScene};
use courant_simulation::method::Method;
use courant_simulation::particles::MethodOptions;

/// More particles than this are thinned out in pictures.
const MOST_MARKERS: usize = 4000;
const CURVE_POINTS: usize = 600;

/// What is drawn of a flow against what: the sheared velocity across it, or a quantity against the distance from the origin.
fn coordinates(scene: &FieldScene, profile: &FieldProfile, i: usize) -> (f64, f64) {
    let (x, v) = (&profile.position, &profile.velocity);
    let r = x.iter().map(|column| column[i] * column[i]).sum::<f64>().sqrt();
    match scene.flow {
        FieldFlow::Shear { .. } => (x[0][i], v[1][i]),
        FieldFlow::Gresho { .. } => (r, (x[0][i] * v[1][i] - x[1][i] * v[0][i]) / r),
        FieldFlow::Blast { .. } => (r, profile.density[i]),
    }
}

fn labels(scene: &FieldScene) -> [&'static str; 2] {
    match scene.flow {
        FieldFlow::Shear { .. } => ["x", "v along y"],
        FieldFlow::Gresho { .. } => ["r", "v around"],
        FieldFlow::Blast { .. } => ["r", "ρ"],
    }
}

/// Particles and the exact solution: a velocity across a shear, around a vortex, or the density of an explosion.
pub fn profile_panel(scene: &FieldScene, profile: &FieldProfile, time: f64) -> Panel {
    let [x_label, y_label] = labels(scene);
    let (from, to) = match scene.flow {
        FieldFlow::Shear { .. } => (scene.domain[0][0], scene.domain[1][0]),
        FieldFlow::Gresho { .. } | FieldFlow::Blast { .. } => (0.0, scene.domain[1][0]),
    };
    let every = profile.len().div_ceil(MOST_MARKERS).max(1);
    let points = (0..profile.len()).step_by(every).map(|i| coordinates(scene, profile, i));
    let solution = scene.solution();
    let curve = (0..=CURVE_POINTS).filter_map(|k| {
        let at = from + (to - from) * k as f64 / CURVE_POINTS as f64;
        let value = match scene.flow {
            FieldFlow::Shear { .. } => solution.at([at, 0.0], time)?.velocity[1],
            FieldFlow::Gresho { .. } => solution.at([at, 0.0], time)?.velocity[1],
            FieldFlow::Blast { .. } => solution.at([at, 0.0, 0.0], time)?.density,
        };
        Some((at, value))
    });
    let dots = Markers::new(points, Marker::Circle).color(Color::BLUE).size(1.6).label("particles");
    let upright = Axis::linear(y_label);
    let upright = match scene.flow {
        // One scale for all methods, so that they can be compared.
        FieldFlow::Shear { speed, .. } => upright.range(-1.2 * speed.abs(), 1.2 * speed.abs()),
        FieldFlow::Gresho { .. } | FieldFlow::Blast { .. } => upright,
    };
    Panel::new(Axis::linear(x_label).range(from, to), upright)
        .layer(dots)
        .layer(Line::new(curve.collect::<Vec<_>>()).color(Color::VERMILION).label("exact"))
}

/// The profile, and the measures of the scene against time.
pub fn field_figure(scene: &FieldScene, run: &FieldRun) -> Figure {
    let profile = profile_panel(scene, &run.run.profile, run.run.time);
    let profile = profile.title("(a) particles at the end");
    let mut measures = Panel::new(Axis::linear("t"), Axis::linear("measure")).title("(b) measures");
    let names = run.history[0].measures.iter().map(|(name, _)| *name).enumerate();
    for (k, name) in names {
        let points = run
            .history
            .iter()
            .map(|sample| (sample.time, sample.measures.get(k).map_or(f64::NAN, |m| m.1)));
        let color =
            [Color::BLUE, Color::VERMILION, Color::GREEN, Color::PURPLE, Color::BLACK][k % 5];
        let line = Line::new(points.collect::<Vec<_>>()).color(color).dash(Dash::nth(k));
        measures = measures.layer(line.label(name.replace('_', " ")));
    }
    Figure::grid(1, 2).size(7.0, 3.6).panels([profile, measures]).legend_below()
}

/// The record, the particles, the measures against time and the picture; `ratio` is the smoothing length as it was asked for.
pub fn report(
    scene: &FieldScene,
    options: &MethodOptions,
    ratio: &str,
    result: &FieldRun,
    seconds: f64,
) -> RunReport {
    let (run, method) = (&result.run, options.method.name());
    let note = match (result.errors, run.conservation.energy) {
        (None, _) => "there is no exact solution here, or the flow has reached the ends of the box",
        (Some(_), None) => NO_ENERGY,
        (Some(_), Some(_)) => "the energy follows from pressure and density",
    };
    let particles = run.profile.len();
    let mut record = RunRecord::new([&scene.name, method], particles, run, note, seconds);
    let advice =
        run.failure.and_then(|failure| Method::Particles(*options).advice(&failure.reason));
    record.advise(advice);
    if let Some(errors) = result.errors.filter(|_| run.completed()) {
        record.l1.density = finite(errors.density);
        record.l1.velocity = finite(errors.velocity);
        record.l1.pressure = finite(errors.pressure);
    }
    record.measures = result.measures.iter().map(|(name, value)| (*name, finite(*value))).collect();
    record.set("dimension", scene.dimension);
    record.set("eos", eos(scene.gas));
    record.set("lattice", scene.lattice.name());
    describe_particles(&mut record, options, ratio, &run.counters);
    let title = format!(
        "{}: {}, {}, h/Δ = {ratio}, {particles} particles, t = {}",
        scene.name,
        method.to_uppercase(),
        options.kernel.title(),
        significant(run.time, 4)
    );
    RunReport {
        caption: format!("{} ({}), {}", scene.name, scene.source, method_title(method)),
        files: vec![(".csv", profile_csv(&run.profile)), ("_measures.csv", history_csv(result))],
        figure: Some(field_figure(scene, result).title(title)),
        record,
    }
}

fn csv(header: &[&str], rows: impl Iterator<Item = Vec<f64>>) -> Vec<u8> {
    let mut text = header.join(",");
    text.push('\n');
    for row in rows {
        let cell = |value: &f64| finite(*value).map_or_else(String::new, |value| value.to_string());
        text.push_str(&row.iter().map(cell).collect::<Vec<_>>().join(","));
        text.push('\n');
    }
    text.into_bytes()
}

/// One line for each particle.
pub fn profile_csv(profile: &FieldProfile) -> Vec<u8> {
    let dimension = profile.position.len();
    let mut header = ["x", "y", "z"][..dimension].to_vec();
    header.extend(&["velocity_x", "velocity_y", "velocity_z"][..dimension]);
    header.extend(["density", "pressure", "smoothing_length"]);
    if !profile.energy.is_empty() {
        header.push("energy");
    }
    let row = |i: usize| {
        let vectors = profile.position.iter().chain(&profile.velocity).map(|column| column[i]);
        let mut row: Vec<f64> = vectors.collect();
        row.extend([profile.density[i], profile.pressure[i], profile.smoothing[i]]);
        row.extend(profile.energy.get(i));
        row
    };
    csv(&header, (0..profile.len()).map(row))
}

/// One line for each sample of the measures.
pub fn history_csv(run: &FieldRun) -> Vec<u8> {
    let mut header = vec!["time"];
    header.extend(run.history[run.history.len() - 1].measures.iter().map(|(name, _)| *name));
    let row = |sample: &courant_simulation::field::Sample| {
        std::iter::once(sample.time)
            .chain(sample.measures.iter().map(|(_, value)| *value))
            .collect()
    };
    csv(&header, run.history.iter().map(row))
}
