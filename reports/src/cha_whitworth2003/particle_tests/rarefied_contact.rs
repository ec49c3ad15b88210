//! The energy at the centre of Sjögreen's test, and whether the Riemann solver is to blame.

use super::runs::{Plan, Runs, Solved, scene};
use super::text;
use crate::cells;
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::or_dash;
use crate::report::Detail;
use courant_simulation::particles::{MethodOptions, ParticleMethod, SolverChoice};
use courant_simulation::scene::Scene;

/// Energy at the centre of one run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactEnergy {
    /// The method.
    pub method: ParticleMethod,
    /// The Riemann solver.
    pub solver: SolverChoice,
    /// Number of particles.
    pub particles: usize,
    /// Mean specific internal energy of the two particles next to the centre; `None` if the run broke down.
    pub energy: Option<f64>,
    /// The exact one at their places.
    pub exact: f64,
    /// Mean density of the two over the exact one.
    pub density: f64,
    /// Share of the particles inside the window that are more than a tenth too hot.
    pub hot: f64,
}

fn solver_name(solver: SolverChoice) -> &'static str {
    match solver {
        SolverChoice::Published => "van Leer, as published",
        SolverChoice::Converged => "van Leer, converged",
        SolverChoice::Exact => "exact",
    }
}

/// Every method with every solver that makes a difference to it; but for a quick report at a second resolution too.
pub(super) fn plans(detail: Detail) -> Vec<Plan> {
    let scene = scene("sjogreen");
    let finer = Scene { particles: 4 * scene.particles, ..scene.clone() };
    let mut plans = Vec::new();
    for method in ParticleMethod::ALL {
        let solvers: &[SolverChoice] = if method.is_godunov() {
            &[SolverChoice::Published, SolverChoice::Converged, SolverChoice::Exact]
        } else {
            &[SolverChoice::Published]
        };
        let options = |solver| MethodOptions { solver, ..MethodOptions::new(method) };
        plans.extend(solvers.iter().map(|&solver| (scene.clone(), options(solver))));
        if detail != Detail::Quick {
            plans.push((finer.clone(), options(SolverChoice::Exact)));
        }
    }
    plans
}

/// What came of them.
pub fn contact_energies(runs: &Runs, detail: Detail) -> Vec<ContactEnergy> {
    plans(detail).iter().map(|plan| measure(runs.of(plan))).collect()
}

fn measure(Solved { scene, options, run, .. }: &Solved) -> ContactEnergy {
    let profile = &run.profile;
    let exact = |i: usize| {
        let state =
            scene.exact(profile.x[i], run.time).expect("Sjögreen's test is a Riemann problem");
        (state.density(), scene.material.internal_energy(&state).expect("the gas is ideal"))
    };
    let inside = profile.inside(scene.window);
    let mut by_distance = inside.clone();
    by_distance.sort_by(|&i, &j| profile.x[i].abs().total_cmp(&profile.x[j].abs()));
    by_distance.truncate(2);
    let mean = |value: &dyn Fn(usize) -> f64| {
        by_distance.iter().map(|&i| value(i)).sum::<f64>() / by_distance.len() as f64
    };
    let hot = inside.iter().filter(|&&i| profile.energy[i] > 1.1 * exact(i).1).count();
    ContactEnergy {
        method: options.method,
        solver: options.solver,
        particles: profile.len(),
        energy: run.completed().then(|| mean(&|i| profile.energy[i])),
        exact: mean(&|i| exact(i).1),
        density: mean(&|i| profile.density[i] / exact(i).0),
        hot: hot as f64 / inside.len() as f64,
    }
}

pub(super) fn table(contacts: &[ContactEnergy]) -> Item {
    let rows = contacts.iter().map(|contact| {
        cells![
            contact.method.name(),
            if contact.method.is_godunov() { solver_name(contact.solver) } else { "–" },
            contact.particles,
            contact.energy.map_or_else(|| "broke down".into(), |u| significant(u, 4)),
            significant(contact.exact, 4),
            or_dash(contact.energy.map(|u| u / contact.exact), 3),
            significant(contact.density, 3),
            format!("{:.1} %", 100.0 * contact.hot),
        ]
    });
    text().table("contact_energy", &[], rows)
}
