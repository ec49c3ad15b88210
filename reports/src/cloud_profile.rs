//! Figures and tables of clouds: the gas beside the exact solution, the core against time, energies.

use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::gas_run::{describe_particles, eos};
use crate::number::{finite, significant};
use crate::run_record::{RunRecord, RunReport, method_title};
use courant_simulation::gravity::{Cloud, CloudRun, Energies, ExpansionWave, Snapshot};
use courant_simulation::method::Method;
use courant_simulation::particles::MethodOptions;
use courant_simulation::particles::Vector;

/// Points of the curve of an exact solution.
const CURVE_POINTS: usize = 600;
/// More particles than this only blacken the paper: every so many-th by radius is drawn.
const MOST_MARKERS: usize = 2500;
/// Intervals in which the accretion rate is averaged.
const RATE_INTERVALS: usize = 40;

/// Radius, velocity away from the centre and density of every particle, by radius.
fn by_radius(snapshot: &Snapshot) -> Vec<Vector<3>> {
    let mut all = snapshot.radial();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all
}

fn markers(points: Vec<(f64, f64)>) -> Series {
    let every = points.len().div_ceil(MOST_MARKERS).max(1);
    Series::markers(points.into_iter().step_by(every), Marker::Circle)
        .color(Color::BLUE)
        .fill(None)
        .size(1.4)
        .width(0.4)
        .label("particles")
}

/// The exact solution over the radii of the cloud, as `value(r, similarity)`.
fn exact(cloud: &Cloud, time: f64, value: impl Fn(f64, [f64; 2]) -> f64) -> Option<Series> {
    let from = cloud.sink.unwrap_or(1e-3 * cloud.radius);
    let ratio = (cloud.radius / from).ln();
    let points: Option<Vec<_>> = (0..=CURVE_POINTS)
        .map(|k| {
            let r = from * (ratio * k as f64 / CURVE_POINTS as f64).exp();
            let state = cloud.wave(r, time)?;
            Some((r, value(r, [state.velocity, state.density])))
        })
        .collect();
    Some(Series::line(points?).width(0.9).label("exact"))
}

/// `r·v` against `r`.
pub fn radial_flow_panel(cloud: &Cloud, snapshot: &Snapshot) -> Panel {
    let points = by_radius(snapshot).into_iter().map(|[r, u, _]| (r, r * u)).collect();
    Panel::new(Axis::linear("r"), Axis::linear("r·v")).layer(markers(points)).layers(exact(
        cloud,
        snapshot.time,
        |r, [u, _]| r * u,
    ))
}

/// Density against radius, both logarithmic.
pub fn density_panel(cloud: &Cloud, snapshot: &Snapshot) -> Panel {
    let points = by_radius(snapshot).into_iter().map(|[r, _, density]| (r, density)).collect();
    Panel::new(Axis::log("r"), Axis::log("ρ")).layer(markers(points)).layers(exact(
        cloud,
        snapshot.time,
        |_, [_, density]| density,
    ))
}

/// Mass of the core over that of the cloud, and accretion rate in `c³/G`, against time in collapse times; `None`
/// without a sink or a collapse time.
pub fn core_panels(cloud: &Cloud, run: &CloudRun) -> Option<[Panel; 2]> {
    let (collapse, start) = (cloud.collapse_time()?, cloud.wave_start()?);
    let unit = cloud.sound_speed()?.powi(3) / cloud.constant;
    let last = run.core.last()?[0];
    let scaled = |time: f64| (time + start) / collapse;
    let m0 = ExpansionWave::solution().core_mass();
    let mass = run.core.iter().map(|[time, mass]| (scaled(*time), mass / cloud.mass));
    let end = scaled(last);
    let masses = Panel::new(Axis::linear("t/t collapse"), Axis::linear("core mass/cloud mass"))
        .layer(Series::line([(0.0, 0.0), (end, end)]).width(0.8).label("exact"))
        .layer(Series::line(mass).color(Color::BLUE).width(1.1).label("run"));
    let at = |time: f64| {
        let next = run.core.partition_point(|core| core[0] < time).min(run.core.len() - 1);
        run.core[next]
    };
    let rates = (0..RATE_INTERVALS).filter_map(|k| {
        let edge = |k: usize| at(last * k as f64 / RATE_INTERVALS as f64);
        let ([a, from], [b, to]) = (edge(k), edge(k + 1));
        (b > a).then(|| (scaled(0.5 * (a + b)), (to - from) / (b - a) / unit))
    });
    let rate = Panel::new(Axis::linear("t/t collapse"), Axis::linear("accretion rate, c³/G"))
        .layer(Series::line([(0.0, m0), (end, m0)]).width(0.8).label("exact"))
        .layer(Series::line(rates).color(Color::BLUE).width(1.1).label("run"));
    Some([masses, rate])
}

/// Kinetic, thermal, potential and total energy against time; `None` for an isothermal gas.
pub fn energy_panel(run: &CloudRun) -> Option<Panel> {
    run.energies[0].thermal?;
    type Curve = (&'static str, Color, fn(&Energies) -> f64);
    let curves: [Curve; 4] = [
        ("kinetic", Color::BLUE, |e| e.kinetic),
        ("thermal", Color::VERMILION, |e| e.thermal.unwrap_or(f64::NAN)),
        ("potential", Color::GREEN, |e| e.potential),
        ("total", Color::BLACK, |e| e.total().unwrap_or(f64::NAN)),
    ];
    let lines = curves.map(|(name, color, value)| {
        Series::line(run.energies.iter().map(|e| (e.time, value(e))))
            .color(color)
            .width(1.1)
            .label(name)
    });
    Some(Panel::new(Axis::linear("t"), Axis::linear("energy")).layers(lines))
}

/// The end of a run: flow and density, and the core or the energies against time.
pub fn cloud_figure(cloud: &Cloud, run: &CloudRun) -> Option<Figure> {
    let end = run.snapshots.last()?;
    let mut panels = vec![radial_flow_panel(cloud, end), density_panel(cloud, end)];
    panels.extend(core_panels(cloud, run).into_iter().flatten());
    panels.extend(energy_panel(run));
    let rows = panels.len().div_ceil(2);
    Some(Figure::grid(rows, 2).size(7.0, 2.7 * rows as f64).panels(panels))
}

/// A snapshot as CSV, one line for each particle by radius, with the exact solution where there is one.
pub fn cloud_csv(cloud: &Cloud, snapshot: &Snapshot) -> Vec<u8> {
    let has_exact = cloud.wave(cloud.radius, snapshot.time).is_some();
    let exact = if has_exact { ",exact_velocity,exact_density" } else { "" };
    let mut text = format!("r,radial_velocity,density{exact}\n");
    for [r, u, density] in by_radius(snapshot) {
        let known = cloud.wave(r, snapshot.time).map(|state| [state.velocity, state.density]);
        let row = [r, u, density].into_iter().chain(known.into_iter().flatten());
        let cells: Vec<String> =
            row.map(|value| finite(value).map_or_else(String::new, |v| v.to_string())).collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text.into_bytes()
}

/// Time and mass of the core as CSV.
pub fn core_csv(run: &CloudRun) -> Vec<u8> {
    let rows = run.core.iter().map(|[time, mass]| format!("{time},{mass}\n"));
    format!("time,core_mass\n{}", rows.collect::<String>()).into_bytes()
}

/// The record, the particles by radius, the core against time and the picture; `ratio` is the smoothing length as it was asked
/// for.
pub fn report(
    cloud: &Cloud,
    options: &MethodOptions,
    ratio: &str,
    particles: usize,
    result: &CloudRun,
    seconds: f64,
) -> RunReport {
    let (run, method) = (&result.run, options.method.name());
    let note = "the measures compare the run with what is known of it";
    let mut record = RunRecord::new([&cloud.name, method], particles, run, note, seconds);
    let advice =
        run.failure.and_then(|failure| Method::Particles(*options).advice(&failure.reason));
    record.advise(advice);
    let measures = result.measures(cloud).into_iter();
    record.measures = measures.map(|(name, value)| (name, finite(value))).collect();
    record.set("dimension", 3);
    record.set("eos", eos(cloud.material));
    describe_particles(&mut record, options, ratio, &run.counters);
    let title = format!(
        "{}: {}, {particles} particles, t = {}",
        cloud.name,
        method.to_uppercase(),
        significant(run.time, 4)
    );
    let end = result.snapshots.last().map(|end| (".csv", cloud_csv(cloud, end)));
    let core = (!result.core.is_empty()).then(|| ("_core.csv", core_csv(result)));
    RunReport {
        caption: format!("{} ({}), {}", cloud.name, cloud.source, method_title(method)),
        files: end.into_iter().chain(core).collect(),
        figure: cloud_figure(cloud, result).map(|figure| figure.title(title)),
        record,
    }
}
