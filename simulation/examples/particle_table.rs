//! Prints errors, conservation and work of every particle method on every scene.

use courant_simulation::particles::{MethodOptions, ParticleMethod, ParticleScene, run_particles};

fn main() {
    println!(
        "{:20} {:5} {:>7} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>4} {:>9} {:>5}  failure",
        "scene",
        "",
        "steps",
        "density",
        "velocity",
        "pressure",
        "energy",
        "dP",
        "dE",
        "pen",
        "pairs",
        "it"
    );
    for scene in ParticleScene::all() {
        for method in ParticleMethod::ALL {
            let options = MethodOptions::new(method);
            let run = run_particles(&scene, scene.particles, &options).expect("default options");
            let number = |value: Option<f64>| {
                value.map_or_else(|| "-".into(), |value| format!("{value:.2e}"))
            };
            let errors = run.errors.as_ref();
            let per_pair =
                run.counters.riemann_iterations as f64 / run.counters.interactions as f64;
            println!(
                "{:20} {:5} {:7} {:>9} {:>9} {:>9} {:>9} {:8.1e} {:>8} {:4} {:9} {per_pair:5.2}  {}",
                scene.name,
                method.name(),
                run.steps,
                number(errors.map(|e| e.density)),
                number(errors.map(|e| e.velocity)),
                number(errors.map(|e| e.pressure)),
                number(errors.and_then(|e| e.energy)),
                run.drift.momentum,
                number(run.drift.energy),
                run.penetration.largest,
                run.counters.interactions,
                run.failure.map_or_else(String::new, |f| f.to_string()),
            );
        }
    }
}
