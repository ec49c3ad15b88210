//! Profiles of particle runs: the figure and the table of one scene's state beside its exact solution.

use crate::figure::{Axis, Color, Figure, Line, Marker, Markers, Panel};
use crate::number::finite;
use courant_simulation::particles::{Flow, Material, ParticleMethod, ParticleRun, ParticleScene};
use courant_simulation::riemann::State;
use courant_simulation::run::Profile;

/// Points of the curve of an exact solution: enough for a jump to look upright in print.
const CURVE_POINTS: usize = 2400;

/// Whether the exact solution of a scene holds at `time`.
///
/// A pulse is followed through every reflection. Riemann problems hold until waves from the ends
/// of the filled interval reach the window; the scenes' own end times are the latest that were checked.
pub fn exact_solution_holds(scene: &ParticleScene, customary_end: f64, time: f64) -> bool {
    matches!(scene.flow, Flow::Pulse { .. }) || time <= customary_end
}

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
    pub fn four(scene: &ParticleScene) -> [Self; 4] {
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

    fn of_particle(self, scene: &ParticleScene, profile: &Profile, time: f64, i: usize) -> f64 {
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

    fn of_state(self, scene: &ParticleScene, state: &State) -> f64 {
        match self {
            Self::Density => state.density(),
            Self::Velocity => state.velocity(),
            Self::Pressure => state.pressure(),
            Self::Energy => internal_energy(scene, state).unwrap_or(f64::NAN),
            Self::DensityError => 0.0,
        }
    }
}

/// `u = P/((γ − 1)ρ)`; `None` for an isothermal gas.
pub fn internal_energy(scene: &ParticleScene, state: &State) -> Option<f64> {
    match scene.material {
        Material::Ideal(gas) => Some(gas.internal_energy(state.density(), state.pressure())),
        Material::Isothermal(_) => None,
    }
}

/// How particles and cells look in every profile: open blue rings, smaller where there are many.
pub fn symbols(points: Vec<(f64, f64)>, label: &str) -> Markers {
    let size = if points.len() > 150 { 2.3 } else { 3.0 };
    let rings = Markers::new(points, Marker::Circle).color(Color::BLUE).open();
    rings.size(size).width(0.6).label(label)
}

/// A method as captions name it: `gph3` is "GPH case 3".
pub fn method_title(method: ParticleMethod) -> String {
    let name = method.name();
    match name.strip_prefix("gph") {
        Some(case) => format!("GPH case {case}"),
        None => name.to_uppercase().replace("SPH", "SPH "),
    }
}

/// One panel: particles as open markers, the exact solution as a line.
///
/// Logarithmic axes leave out what is not positive.
pub fn profile_panel(
    scene: &ParticleScene,
    run: &ParticleRun,
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
    panel.layer(symbols(points, "particles"))
}

/// The exact solution as a curve over the scene's window.
pub fn exact_line(scene: &ParticleScene, quantity: Quantity, time: f64) -> Line {
    let [from, to] = scene.window;
    let points = (0..=CURVE_POINTS).filter_map(|k| {
        let x = from + (to - from) * k as f64 / CURVE_POINTS as f64;
        scene.exact(x, time).map(|state| (x, quantity.of_state(scene, &state)))
    });
    Line::new(points.collect::<Vec<_>>()).width(0.8).label("exact")
}

/// Whether a quantity of the scene spans so many decades that only a logarithmic axis shows it.
pub fn wants_logarithm(scene: &ParticleScene, quantity: Quantity) -> bool {
    scene.name == "strong-blast"
        && matches!(quantity, Quantity::Density | Quantity::Pressure | Quantity::Energy)
}

/// Four panels: density, velocity, pressure and internal energy (isothermal: the error of the
/// density). `exact` says whether the exact solution is drawn.
pub fn profile_figure(scene: &ParticleScene, run: &ParticleRun, exact: bool) -> Figure {
    let panels = Quantity::four(scene).into_iter().enumerate().map(|(k, quantity)| {
        let letter = char::from(b'a' + k as u8);
        profile_panel(scene, run, quantity, wants_logarithm(scene, quantity), exact)
            .title(format!("({letter}) {}", quantity.title()))
    });
    Figure::grid(2, 2).size(7.0, 5.2).panels(panels).legend_below()
}

/// The profile as CSV: one line for each particle in the order of the start, with the exact solution where
/// there is one. Columns that the gas does not have are left out.
pub fn profile_csv(scene: &ParticleScene, run: &ParticleRun, exact: bool) -> Vec<u8> {
    let profile = &run.profile;
    let has_energy = matches!(scene.material, Material::Ideal(_));
    let exact = exact && profile.x.first().is_some_and(|&x| scene.exact(x, run.time).is_some());
    let mut header = vec!["x", "density", "velocity", "pressure"];
    if has_energy {
        header.push("energy");
    }
    header.push("smoothing_length");
    if exact {
        header.extend(["exact_density", "exact_velocity", "exact_pressure"]);
        if has_energy {
            header.push("exact_energy");
        }
    }
    let mut text = header.join(",");
    text.push('\n');
    for (i, &x) in profile.x.iter().enumerate() {
        let mut row = vec![x, profile.density[i], profile.velocity[i], profile.pressure[i]];
        if has_energy {
            row.push(profile.energy[i]);
        }
        row.push(run.smoothing[i]);
        if let Some(state) = scene.exact(x, run.time).filter(|_| exact) {
            row.extend([state.density(), state.velocity(), state.pressure()]);
            row.extend(internal_energy(scene, &state));
        }
        let cells: Vec<String> = row
            .iter()
            .map(|value| finite(*value).map_or_else(String::new, |value| value.to_string()))
            .collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_simulation::particles::{MethodOptions, ParticleMethod, run_particles};

    #[test]
    fn the_table_has_the_columns_of_the_gas_and_every_particle() {
        for (name, columns) in [("sod-sph", 10), ("isothermal-tube", 8), ("woodward-colella", 6)] {
            let scene = ParticleScene { end_time: 1e-4, ..ParticleScene::named(name).unwrap() };
            let run = run_particles(&scene, 20, &MethodOptions::new(ParticleMethod::Gph1)).unwrap();
            let text = String::from_utf8(profile_csv(&scene, &run, true)).unwrap();
            assert_eq!(text.lines().count(), 1 + run.profile.len());
            assert!(text.lines().all(|line| line.split(',').count() == columns), "{name}: {text}");
            assert!(!text.contains("NaN"));
        }
    }

    #[test]
    fn a_pulse_is_followed_for_ever_and_a_tube_to_its_end() {
        let tube = ParticleScene::named("sod-sph").unwrap();
        assert!(exact_solution_holds(&tube, 0.17, 0.17) && !exact_solution_holds(&tube, 0.17, 0.2));
        let wave = ParticleScene::named("sound-wave").unwrap();
        assert!(exact_solution_holds(&wave, 0.8, 100.0));
    }
}
