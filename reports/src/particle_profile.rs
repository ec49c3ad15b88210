//! Profiles of particle runs: the figure and the table of one scene's state beside its exact solution.

use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::finite;
use courant_simulation::riemann::State;
use courant_simulation::run::{Profile, Run};
use courant_simulation::scene::{Material, Scene};

/// Points of the curve of an exact solution: enough for a jump to look upright in print.
const CURVE_POINTS: usize = 2400;

/// What a panel shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// `ρ`.
    Density,
    /// `v`.
    Velocity,
    /// `P`.
    Pressure,
    /// `u`.
    Energy,
    /// `ρ − ρ_exact`, for gases without an energy equation.
    DensityError,
}

impl Quantity {
    /// The four panels of a scene.
    pub fn four(scene: &Scene) -> [Self; 4] {
        let last = match scene.material {
            Material::Ideal(_) => Self::Energy,
            Material::Isothermal(_) => Self::DensityError,
        };
        [Self::Density, Self::Velocity, Self::Pressure, last]
    }

    /// The name over a panel.
    pub fn title(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::Velocity => "velocity",
            Self::Pressure => "pressure",
            Self::Energy => "specific internal energy",
            Self::DensityError => "density less the exact one",
        }
    }

    /// The label of its axis.
    pub fn label(self) -> &'static str {
        match self {
            Self::Density => "ρ",
            Self::Velocity => "v",
            Self::Pressure => "P",
            Self::Energy => "u",
            Self::DensityError => "ρ − ρ exact",
        }
    }

    fn of_particle(self, scene: &Scene, profile: &Profile, time: f64, i: usize) -> f64 {
        match self {
            Self::Density => profile.density[i],
            Self::Velocity => profile.velocity[i],
            Self::Pressure => profile.pressure[i],
            Self::Energy => profile.energy.get(i).copied().unwrap_or(f64::NAN),
            Self::DensityError => scene
                .exact(profile.x[i], time)
                .map_or(f64::NAN, |exact| profile.density[i] - exact.density()),
        }
    }

    fn of_state(self, scene: &Scene, state: &State) -> f64 {
        match self {
            Self::Density => state.density(),
            Self::Velocity => state.velocity(),
            Self::Pressure => state.pressure(),
            Self::Energy => scene.material.internal_energy(state).unwrap_or(f64::NAN),
            Self::DensityError => 0.0,
        }
    }
}

/// How particles and cells look in every profile: open blue rings, smaller where there are many.
pub fn symbols(points: Vec<(f64, f64)>, label: &str) -> Series {
    let size = if points.len() > 150 { 2.3 } else { 3.0 };
    let rings = Series::markers(points, Marker::Circle).color(Color::BLUE).fill(None);
    rings.size(size).width(0.6).label(label)
}

/// One panel: particles as open markers, the exact solution as a line.
///
/// Logarithmic axes leave out what is not positive.
pub fn profile_panel(
    scene: &Scene,
    run: &Run,
    quantity: Quantity,
    logarithmic: bool,
    exact: bool,
) -> Panel {
    let label = quantity.label();
    let y = if logarithmic { Axis::log(label) } else { Axis::linear(label) };
    let [from, to] = scene.window;
    let mut panel = Panel::new(Axis::linear("x").range(from, to), y);
    let shown = run.profile.inside(scene.window);
    let points: Vec<(f64, f64)> = shown
        .into_iter()
        .map(|i| (run.profile.x[i], quantity.of_particle(scene, &run.profile, run.time, i)))
        .collect();
    // A line without points would still have a name in the legend.
    if exact && scene.exact(from, run.time).is_some() {
        panel = panel.layer(exact_line(scene, quantity, run.time));
    }
    panel.layer(symbols(points, if run.profile.mass.is_empty() { "cells" } else { "particles" }))
}

/// The exact solution as a curve over the scene's window.
pub fn exact_line(scene: &Scene, quantity: Quantity, time: f64) -> Series {
    let [from, to] = scene.window;
    let points = (0..=CURVE_POINTS).filter_map(|k| {
        let x = from + (to - from) * k as f64 / CURVE_POINTS as f64;
        scene.exact(x, time).map(|state| (x, quantity.of_state(scene, &state)))
    });
    Series::line(points.collect::<Vec<_>>()).width(0.8).label("exact")
}

/// Whether a quantity of the scene spans so many decades that only a logarithmic axis shows it.
pub fn wants_logarithm(scene: &Scene, quantity: Quantity) -> bool {
    scene.name == "strong-blast"
        && matches!(quantity, Quantity::Density | Quantity::Pressure | Quantity::Energy)
}

/// Four panels: density, velocity, pressure and internal energy (isothermal: the error of the
/// density), in the window of the scene. `exact` says whether the exact solution is drawn.
pub fn profile_figure(scene: &Scene, run: &Run, exact: bool) -> Figure {
    let panels = Quantity::four(scene).into_iter().enumerate().map(|(k, quantity)| {
        let letter = char::from(b'a' + k as u8);
        profile_panel(scene, run, quantity, wants_logarithm(scene, quantity), exact)
            .title(format!("({letter}) {}", quantity.title()))
    });
    Figure::grid(2, 2).size(7.0, 5.2).panels(panels)
}

/// The profile as CSV: one line for each particle or cell in the order of the start, with the exact solution at its place
/// where there is one. Columns that the gas or the method does not have are left out.
pub fn profile_csv(scene: &Scene, run: &Run, exact: bool) -> Vec<u8> {
    let profile = &run.profile;
    let has_energy = !profile.energy.is_empty();
    let exact = exact && profile.x.first().is_some_and(|&x| scene.exact(x, run.time).is_some());
    let mut header = vec!["particle", "x", "density", "velocity", "pressure"];
    let mut columns = vec![&profile.x, &profile.density, &profile.velocity, &profile.pressure];
    for (name, column) in [("energy", &profile.energy), ("smoothing_length", &profile.smoothing)] {
        if !column.is_empty() {
            header.push(name);
            columns.push(column);
        }
    }
    if exact {
        header.extend(["exact_density", "exact_velocity", "exact_pressure"]);
        if has_energy {
            header.push("exact_energy");
        }
    }
    let mut text = header.join(",");
    text.push('\n');
    for (i, &x) in profile.x.iter().enumerate() {
        let mut row: Vec<f64> = columns.iter().map(|column| column[i]).collect();
        if exact {
            let state = finite(x).and_then(|x| scene.exact(x, run.time));
            let value = |value: fn(&State) -> f64| state.as_ref().map_or(f64::NAN, value);
            row.extend([value(State::density), value(State::velocity), value(State::pressure)]);
            if has_energy {
                let energy = state.and_then(|state| scene.material.internal_energy(&state));
                row.push(energy.unwrap_or(f64::NAN));
            }
        }
        text.push_str(&i.to_string());
        for value in row {
            // What is no number is an empty field.
            text.push(',');
            text.push_str(&finite(value).map_or_else(String::new, |value| value.to_string()));
        }
        text.push('\n');
    }
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_simulation::comparison::Comparison;
    use courant_simulation::method::Method;

    #[test]
    fn the_table_has_the_columns_of_the_gas_and_the_method_and_every_particle() {
        for (name, method, columns) in [
            ("sod-sph", "gph1", 11),
            ("isothermal-tube", "gph1", 9),
            ("woodward-colella", "sph1", 7),
            ("sod", "finite-volume", 10),
        ] {
            let scene = Scene { end_time: 1e-4, ..Scene::named(name).unwrap() };
            let run = Method::named(method).unwrap().run(&scene, 20).unwrap();
            let text = String::from_utf8(profile_csv(&scene, &run, true)).unwrap();
            assert_eq!(text.lines().count(), 1 + run.profile.len());
            assert!(text.lines().all(|line| line.split(',').count() == columns), "{name}: {text}");
            assert!(!text.contains("NaN"));
        }
    }

    #[test]
    fn the_norms_follow_from_the_table() {
        let sod = Scene::named("sod").unwrap();
        let run = Method::named("lagrangian-roe").unwrap().run(&sod, 50).unwrap();
        let l1 = Comparison::new(&sod, &run).unwrap().l1;
        let text = String::from_utf8(profile_csv(&sod, &run, true)).unwrap();
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
            .collect();
        for (column, norm) in
            [l1.density, l1.velocity, l1.pressure, l1.energy].into_iter().enumerate()
        {
            let sum: f64 = rows.iter().map(|row| (row[2 + column] - row[6 + column]).abs()).sum();
            assert!((sum / 50.0 - norm).abs() < 1e-15);
        }
    }
}
