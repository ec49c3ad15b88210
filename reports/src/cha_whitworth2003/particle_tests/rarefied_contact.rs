//! The energy at the centre of Sjögreen's test, and whether the Riemann solver is to blame.

use super::COMMAND;
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_simulation::method::Method;
use courant_simulation::particles::{MethodOptions, ParticleMethod, SolverChoice};
use courant_simulation::run::Run;
use courant_simulation::scene::Scene;
use rayon::prelude::*;

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

/// Every method with every solver that makes a difference to it, at two resolutions.
pub fn contact_energies() -> Vec<ContactEnergy> {
    let scene = Scene::named("sjogreen").expect("it is in the list of scenes");
    let mut plans = Vec::new();
    for method in ParticleMethod::ALL {
        let solvers: &[SolverChoice] = if method.is_godunov() {
            &[SolverChoice::Published, SolverChoice::Converged, SolverChoice::Exact]
        } else {
            &[SolverChoice::Published]
        };
        for &solver in solvers {
            plans.push((method, solver, scene.particles));
        }
        plans.push((method, SolverChoice::Exact, 4 * scene.particles));
    }
    plans
        .into_par_iter()
        .map(|(method, solver, particles)| {
            let options = MethodOptions { solver, ..MethodOptions::new(method) };
            let run = Method::Particles(options)
                .run(&scene, particles)
                .expect("the report's options are in range");
            measure(&scene, method, solver, &run)
        })
        .collect()
}

fn measure(
    scene: &Scene,
    method: ParticleMethod,
    solver: SolverChoice,
    run: &Run,
) -> ContactEnergy {
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
        method,
        solver,
        particles: profile.len(),
        energy: run.completed().then(|| mean(&|i| profile.energy[i])),
        exact: mean(&|i| exact(i).1),
        density: mean(&|i| profile.density[i] / exact(i).0),
        hot: hot as f64 / inside.len() as f64,
    }
}

pub(super) fn table(contacts: &[ContactEnergy]) -> Item {
    let mut table = Table::new(
        "Sjögreen's test at t = 0.18: specific internal energy u and density of the two particles next to the centre, \
         against the exact solution at their places (they stand farther out than x = 0 in a gas this thin). Too hot: share \
         of the particles in the window with u more than a tenth above the exact one. SPH has no Riemann solver.",
        &[
            ("method", Align::Left),
            ("Riemann solver", Align::Left),
            ("N", Align::Right),
            ("u at the centre", Align::Right),
            ("exact", Align::Right),
            ("u over exact", Align::Right),
            ("density over exact", Align::Right),
            ("too hot", Align::Right),
        ],
    );
    for contact in contacts {
        table.push([
            contact.method.name().to_string(),
            if contact.method.is_godunov() { solver_name(contact.solver) } else { "–" }.into(),
            contact.particles.to_string(),
            contact.energy.map_or_else(|| "broke down".into(), |u| significant(u, 4)),
            significant(contact.exact, 4),
            contact.energy.map_or_else(|| "–".into(), |u| significant(u / contact.exact, 3)),
            significant(contact.density, 3),
            format!("{:.1} %", 100.0 * contact.hot),
        ]);
    }
    Item::Table { name: "contact_energy".into(), table, command: COMMAND.into() }
}
