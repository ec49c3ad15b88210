//! The energy at the centre of Sjögreen's test, and whether the Riemann solver is to blame.

use super::COMMAND;
use crate::number::significant;
use crate::page::Item;
use crate::particle_profile::internal_energy;
use crate::table::{Align, Table};
use courant_simulation::particles::{
    MethodOptions, ParticleMethod, ParticleRun, ParticleScene, SolverChoice, run_particles,
};
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
    /// The largest specific internal energy of particles within 0.05 of the centre; `None` if the run broke down.
    pub energy: Option<f64>,
    /// The exact one there.
    pub exact: f64,
    /// Mass of the particles near the centre that are more than a fifth too hot, over the total.
    pub hot_mass: f64,
}

const HALF_WIDTH: f64 = 0.05;

fn solver_name(solver: SolverChoice) -> &'static str {
    match solver {
        SolverChoice::Published => "van Leer, as published",
        SolverChoice::Converged => "van Leer, converged",
        SolverChoice::Exact => "exact",
    }
}

/// Every method with every solver that makes a difference to it, at two resolutions.
pub fn contact_energies() -> Vec<ContactEnergy> {
    let scene = ParticleScene::named("sjogreen").expect("it is in the list of scenes");
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
            let run = run_particles(&scene, particles, &options)
                .expect("the report's options are in range");
            measure(&scene, method, solver, &run)
        })
        .collect()
}

fn measure(
    scene: &ParticleScene,
    method: ParticleMethod,
    solver: SolverChoice,
    run: &ParticleRun,
) -> ContactEnergy {
    let profile = &run.profile;
    let exact_at = |x: f64| {
        let state = scene.exact(x, run.time).expect("Sjögreen's test is a Riemann problem");
        internal_energy(scene, &state).expect("the gas is ideal")
    };
    let near = profile.inside([-HALF_WIDTH, HALF_WIDTH]);
    let largest = near.iter().map(|&i| profile.energy[i]).fold(f64::NEG_INFINITY, f64::max);
    let hot = near.iter().filter(|&&i| profile.energy[i] > 1.2 * exact_at(profile.x[i])).count();
    ContactEnergy {
        method,
        solver,
        particles: profile.len(),
        energy: (run.completed() && !near.is_empty()).then_some(largest),
        exact: exact_at(0.0),
        hot_mass: hot as f64 / profile.len() as f64,
    }
}

pub(super) fn table(contacts: &[ContactEnergy]) -> Item {
    let exact = contacts.first().map_or(f64::NAN, |contact| contact.exact);
    let mut table = Table::new(
        format!(
            "Sjögreen's test: the largest specific internal energy within {HALF_WIDTH} of the centre at t = 0.18; the exact \
             one at x = 0 is {exact:.4}. Too hot: the share of the mass there whose energy is more than a fifth above the exact one. \
             SPH has no Riemann solver."
        ),
        &[
            ("method", Align::Left),
            ("Riemann solver", Align::Left),
            ("N", Align::Right),
            ("u at the centre", Align::Right),
            ("over exact", Align::Right),
            ("too hot", Align::Right),
        ],
    );
    for contact in contacts {
        table.push([
            contact.method.name().to_string(),
            if contact.method.is_godunov() { solver_name(contact.solver) } else { "–" }.into(),
            contact.particles.to_string(),
            contact.energy.map_or_else(|| "broke down".into(), |u| significant(u, 4)),
            contact.energy.map_or_else(|| "–".into(), |u| significant(u / contact.exact, 3)),
            format!("{:.2} %", 100.0 * contact.hot_mass),
        ]);
    }
    Item::Table { name: "contact_energy".into(), table, command: COMMAND.into() }
}
