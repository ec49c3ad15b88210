//! Prints errors, conservation and work of every method on every scene, or why it does not run it. Arguments: scene files; none: the
//! named scenes.

use courant_simulation::comparison::Comparison;
use courant_simulation::method::Method;
use courant_simulation::scene::Scene;

fn main() {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let scenes: Vec<Scene> = match files.as_slice() {
        [] => Scene::all().cloned().collect(),
        _ => files
            .iter()
            .map(|file| {
                let text = std::fs::read_to_string(file).expect("a file");
                Scene::parse(&text, file).unwrap_or_else(|error| panic!("{file}, {error}"))
            })
            .collect(),
    };
    println!(
        "scene,method,steps,rejected,density,velocity,pressure,energy,momentum drift,energy drift,passed,pairs,failure"
    );
    for scene in scenes {
        for name in Method::NAMES {
            let method = Method::named(name).expect("it is in the list");
            print!("{},{name},", scene.name);
            let run = match method.run(&scene, scene.particles) {
                Ok(run) => run,
                Err(error) => {
                    println!(",,,,,,,,,,{error}");
                    continue;
                }
            };
            let l1 = Comparison::new(&scene, &run).map(|comparison| comparison.l1);
            let error = |value: Option<f64>| value.map_or_else(String::new, |v| format!("{v:.2e}"));
            println!(
                "{},{},{},{},{},{},{:.1e},{},{},{},{}{}",
                run.steps,
                run.rejected,
                error(l1.as_ref().map(|l1| l1.density)),
                error(l1.as_ref().map(|l1| l1.velocity)),
                error(l1.as_ref().map(|l1| l1.pressure)),
                error(l1.as_ref().map(|l1| l1.energy)),
                run.conservation.momentum,
                error(run.conservation.energy),
                run.penetration.largest,
                run.counters.interactions,
                run.failure.map_or_else(String::new, |failure| failure.to_string()),
                run.warnings.iter().map(|warning| format!("; {warning}")).collect::<String>(),
            );
        }
    }
}
