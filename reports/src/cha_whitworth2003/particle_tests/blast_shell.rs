//! The thin shell between contact and shock of the strong blast.

use super::runs::Runs;
use super::text;
use crate::cells;
use crate::number::significant;
use crate::page::Item;
use courant_simulation::particles::{Flow, Material, ParticleMethod, ParticleScene};
use courant_simulation::riemann::{Solution, solve};

/// What a method makes of the shell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shell {
    /// The method.
    pub method: ParticleMethod,
    /// Particles that started right of the jump and were swept up: between contact and shock.
    pub particles: usize,
    /// Their mean density over the exact one, without the three nearest to each edge.
    pub mean_density: f64,
    /// The largest density over the exact one.
    pub largest_density: f64,
    /// The largest `|P/P* − 1|` of the five particles on each side of the contact.
    pub pressure_ripple: f64,
    /// The largest velocity in the shell over `v*`, less one.
    pub velocity_overshoot: f64,
}

/// The exact solution of a tube of an ideal gas.
pub(super) fn riemann_solution(scene: &ParticleScene) -> Option<Solution> {
    match (&scene.flow, scene.material) {
        (Flow::Layers(layers), Material::Ideal(gas)) => match layers.as_slice() {
            [(_, left), (_, right)] => Some(solve(gas, left, right)),
            _ => None,
        },
        _ => None,
    }
}

/// The largest `|P/P* − 1|` of the five particles on each side of the contact.
pub(super) fn pressure_ripple(runs: &Runs, scene: &str, method: ParticleMethod) -> f64 {
    let solved = runs.get(scene, method);
    let solution =
        riemann_solution(&solved.scene).expect("tubes of ideal gases are Riemann problems");
    let profile = &solved.run.profile;
    let order = profile.inside(solved.scene.window);
    let contact = solution.velocity() * solved.run.time;
    let first_right = order.partition_point(|&i| profile.x[i] < contact);
    order[first_right.saturating_sub(5)..(first_right + 5).min(order.len())]
        .iter()
        .map(|&i| (profile.pressure[i] / solution.pressure() - 1.0).abs())
        .fold(0.0, f64::max)
}

/// Measures the shell with every method.
pub fn blast_shell(runs: &Runs) -> Vec<Shell> {
    ParticleMethod::ALL
        .into_iter()
        .map(|method| {
            let solved = runs.get("strong-blast", method);
            let solution = riemann_solution(&solved.scene).expect("the blast is a Riemann problem");
            let time = solved.run.time;
            let (_, exact) = solution.densities();
            let contact = solution.velocity() * time;
            let (_, shock) = solution.right_wave().edges().expect("the right wave is a shock");
            let shock = shock * time;
            let profile = &solved.run.profile;
            let shell = profile.inside([contact, shock]);
            let largest =
                |values: &[f64]| shell.iter().map(|&i| values[i]).fold(f64::NEG_INFINITY, f64::max);
            let inner =
                &shell[3.min(shell.len())..shell.len().saturating_sub(3).max(3.min(shell.len()))];
            let sum: f64 = inner.iter().map(|&i| profile.density[i]).sum();
            Shell {
                method,
                particles: shell.len(),
                mean_density: sum / inner.len() as f64 / exact,
                largest_density: largest(&profile.density) / exact,
                pressure_ripple: pressure_ripple(runs, "strong-blast", method),
                velocity_overshoot: largest(&profile.velocity) / solution.velocity() - 1.0,
            }
        })
        .collect()
}

pub(super) fn table(shells: &[Shell]) -> Item {
    let rows = shells.iter().map(|shell| {
        cells![
            shell.method.name(),
            shell.particles,
            format!("{:.4}", shell.mean_density),
            format!("{:.4}", shell.largest_density),
            significant(shell.pressure_ripple, 3),
            format!("{:.2} %", 100.0 * shell.velocity_overshoot),
        ]
    });
    text().table("blast_shell", &[], rows)
}
