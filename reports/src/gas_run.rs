//! A run of gas dynamics as files: profile, picture, record.

use crate::figure::{Axis, Figure, Line, Panel};
use crate::number::{finite, significant};
use crate::particle_profile;
use crate::run_record::{BROKEN, ConservationRecord, ErrorNorms, RunRecord};
use courant_simulation::boundary::Boundary;
use courant_simulation::comparison::Comparison;
use courant_simulation::method::Method;
use courant_simulation::riemann::Wave;
use courant_simulation::run::Run;
use courant_simulation::scene::Scene;

/// The name of a method for titles, as in the captions of Ferrari et al. 2008.
pub fn method_title(method: &str) -> &'static str {
    match method {
        "finite-volume" => "First-order Godunov finite volumes",
        "sph-adke" => "Standard SPH with adaptive kernel estimation",
        "lagrangian-exact" => "Godunov-type SPH, exact Riemann flux",
        "lagrangian-rusanov" => "Godunov-type SPH, Rusanov flux",
        "lagrangian-roe" => "Godunov-type SPH, modified Roe flux",
        _ => "Run",
    }
}

/// The method with its settings, for captions.
pub fn settings(method: &Method) -> String {
    use courant_simulation::lagrangian::flux::{ContactViscosity, Flux, RoeMean};
    match method {
        Method::FiniteVolume(options) => {
            format!("Courant number {} of the fastest wave |v| + c", options.cfl)
        }
        Method::AdaptiveSph(options) => format!(
            "{}, h₀ = {} × largest spacing, k = {}, ε = {}, α = {}, β = {}, Courant number {}",
            options.kernel.title(),
            options.pilot_ratio,
            options.scale,
            options.sensitivity,
            options.alpha,
            options.beta,
            options.cfl
        ),
        Method::Lagrangian(options) => {
            let flux = match options.flux {
                Flux::Exact | Flux::Rusanov => String::new(),
                Flux::ModifiedRoe(roe) => {
                    let mean = match roe.mean {
                        RoeMean::Density => "mean of densities (3.14)",
                        RoeMean::Volume => "mean of specific volumes",
                    };
                    match roe.contact {
                        ContactViscosity::Printed(alpha) => {
                            format!(", {mean}, λ₂ = {alpha} max|v| (3.15)")
                        }
                        ContactViscosity::MassFlux(alpha) => {
                            format!(", {mean}, λ₂ = {alpha} ρ̄ max|v|")
                        }
                    }
                }
            };
            format!(
                "{}, l/Δξ = {}, Courant number {}{flux}",
                options.kernel.title(),
                options.ratio,
                options.cfl
            )
        }
    }
}

/// The record of a run. A run that broke down has no error norms: what it left is no approximation of
/// the end.
pub fn record(
    scene: &dyn Scene,
    method: &Method,
    particles: usize,
    run: &Run,
    wall_seconds: f64,
) -> RunRecord {
    let no_norms = match run.failure {
        Some(_) => BROKEN,
        None if run.profile.inside(window(scene)).is_empty() => "no particle is left in the window",
        None => "the exact solution has a vacuum in the window",
    };
    let mut warnings = Vec::new();
    let l1 = if run.completed() {
        let comparison = Comparison::inside(scene, run, window(scene));
        let [from, to] = window(scene);
        if waves_have_left(scene, run.time) {
            warnings.push(format!(
                "every wave has left the window from {from} to {to} before t = {}: the error norms are those of one constant state",
                significant(run.time, 6)
            ));
        }
        let l1 = comparison.l1;
        ErrorNorms {
            value: None,
            density: finite(l1.density),
            velocity: finite(l1.velocity),
            pressure: finite(l1.pressure),
            energy: finite(l1.energy),
        }
    } else {
        ErrorNorms::default()
    };
    let conservation = ConservationRecord {
        mass: finite(run.conservation.mass),
        momentum: finite(run.conservation.momentum),
        energy: finite(run.conservation.energy),
    };
    RunRecord {
        scene: scene.name().into(),
        method: method.name().into(),
        particles,
        steps: run.steps,
        time: run.time,
        completed: run.completed(),
        failure: run.failure.map(|failure| failure.to_string()),
        warnings,
        l1_note: (!l1.is_complete()).then(|| no_norms.into()),
        l1,
        conservation_note: (!conservation.is_complete()).then(|| BROKEN.into()),
        conservation,
        wall_seconds,
    }
}

/// Whether the exact solution of a Riemann problem is one state all over the window where a run is compared.
fn waves_have_left(scene: &dyn Scene, time: f64) -> bool {
    let Some((solution, origin)) = scene.riemann() else { return false };
    let [from, to] = window(scene).map(|end| (end - origin) / time);
    let inside = |ray: f64| from < ray && ray < to;
    let acoustic = |wave| match wave {
        Wave::Absent => false,
        Wave::Shock { speed } => inside(speed),
        // Its rays cover what is between head and tail.
        Wave::Rarefaction { head, tail } => head.min(tail) < to && from < head.max(tail),
    };
    let (left, right) = solution.densities();
    let contact = left != right && inside(solution.velocity());
    !(acoustic(solution.left_wave()) || acoustic(solution.right_wave()) || contact)
}

/// Where a run is compared: the domain, or where it is periodic a period more on each side (particles
/// drift over the ends, in the time before a wave breaks by less than that).
pub fn window(scene: &dyn Scene) -> [f64; 2] {
    let [from, to] = scene.domain();
    match scene.boundary() {
        Boundary::Periodic => [from - (to - from), to + (to - from)],
        Boundary::Transmissive | Boundary::Mirror | Boundary::Open => [from, to],
    }
}

/// The profile as CSV: one line for each particle or cell in the order of the start, with the exact
/// solution at its place and the time reached.
pub fn profile_csv(scene: &dyn Scene, run: &Run) -> Vec<u8> {
    let mut text = String::from(
        "particle,x,density,velocity,pressure,energy,\
         exact_density,exact_velocity,exact_pressure,exact_energy\n",
    );
    let profile = &run.profile;
    for i in 0..profile.len() {
        let numbers = [
            profile.x[i],
            profile.density[i],
            profile.velocity[i],
            profile.pressure[i],
            profile.energy[i],
        ];
        text.push_str(&i.to_string());
        let exact = finite(profile.x[i]).map(|x| exact_values(scene, x, run.time));
        for value in numbers.into_iter().chain(exact.unwrap_or([f64::NAN; 4])) {
            // What is no number is an empty field.
            text.push(',');
            if let Some(value) = finite(value) {
                text.push_str(&value.to_string());
            }
        }
        text.push('\n');
    }
    text.into_bytes()
}

/// Density, velocity, pressure and specific internal energy of the exact solution.
fn exact_values(scene: &dyn Scene, x: f64, time: f64) -> [f64; 4] {
    let state = scene.exact(x, time);
    let energy = if state.is_vacuum() {
        f64::NAN
    } else {
        scene.gas().internal_energy(state.density(), state.pressure())
    };
    [state.density(), state.velocity(), state.pressure(), energy]
}

/// Points of the exact line.
const EXACT_POINTS: usize = 2000;

/// The four panels of the figures of Ferrari et al. 2008, section 3: density, velocity, pressure and
/// specific internal energy in the domain; the exact solution as a line, the run as symbols. The title of a run that
/// failed says so: a text among the points would be struck through by them.
pub fn figure(scene: &dyn Scene, run: &Run, title: &str) -> Figure {
    let [from, to] = scene.domain();
    let x: Vec<f64> =
        (0..=EXACT_POINTS).map(|i| from + (to - from) * (i as f64 / EXACT_POINTS as f64)).collect();
    let exact: Vec<[f64; 4]> = x.iter().map(|&x| exact_values(scene, x, run.time)).collect();
    let profile = &run.profile;
    let columns = [
        ("(a) density", "ρ", &profile.density),
        ("(b) velocity", "v", &profile.velocity),
        ("(c) pressure", "p", &profile.pressure),
        ("(d) specific internal energy", "e", &profile.energy),
    ];
    let symbols = if run.particle_mass.is_some() { "particles" } else { "cells" };
    let title = match run.failure {
        Some(_) => format!("{title}: failed"),
        None => title.to_owned(),
    };
    let mut figure = Figure::grid(2, 2).size(7.0, 5.4).title(title).legend_below();
    for (index, (title, label, column)) in columns.into_iter().enumerate() {
        let line = x.iter().zip(&exact).map(|(&x, values)| (x, values[index]));
        let points: Vec<(f64, f64)> = profile
            .inside([from, to])
            .into_iter()
            .map(|i| (profile.x[i], column[i]))
            .filter(|point| point.1.is_finite())
            .collect();
        let panel = Panel::new(Axis::linear("x").range(from, to), Axis::linear(label))
            .title(title)
            .layer(Line::new(line).width(0.9).label("exact"))
            .layer(particle_profile::symbols(points, symbols));
        figure = figure.panel(panel);
    }
    figure
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_simulation::scene::ShockTube;

    fn run(scene: &str, method: &str, particles: usize) -> (ShockTube, Method, Run) {
        let tube = ShockTube::standard(scene).expect("it is in the list");
        let method = Method::named(method).expect("it is in the list");
        let run = method.run(&tube, particles).expect("valid");
        (tube, method, run)
    }

    #[test]
    fn a_failed_run_has_a_reason_and_no_norms() {
        let (tube, method, run) = run("ferrari3", "sph-adke", 100);
        let record = record(&tube, &method, 100, &run, 0.0);
        assert!(!record.completed && record.failure.is_some());
        assert_eq!(record.l1, ErrorNorms::default());
        assert!(record.time < 0.012);
        let svg = figure(&tube, &run, "a tube").svg().expect("it is drawn");
        assert!(svg.contains("a tube: failed"));
    }

    #[test]
    fn the_norms_follow_from_the_profile() {
        let (tube, method, run) = run("sod", "lagrangian-roe", 50);
        let record = record(&tube, &method, 50, &run, 0.0);
        let text = String::from_utf8(profile_csv(&tube, &run)).expect("digits");
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
            .collect();
        assert_eq!(rows.len(), 50);
        for (column, norm) in [record.l1.density, record.l1.velocity].into_iter().enumerate() {
            let sum: f64 = rows.iter().map(|row| (row[2 + column] - row[6 + column]).abs()).sum();
            assert!((sum / 50.0 - norm.expect("it ended")).abs() < 1e-15);
        }
    }
}
