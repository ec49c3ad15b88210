//! Which methods there are, and which scenes they run.

use super::{Arguments, Entry};
use crate::cli::{Failure, names};
use courant::simulation::advection::AdvectionScheme;
use courant::simulation::method::Method;
use courant::simulation::particles::ParticleMethod;
use courant::simulation::scene::AnyScene;

/// The methods that run a kind of scene.
pub fn of(scene: &AnyScene) -> Vec<&'static str> {
    match scene {
        AnyScene::Advection(_) => AdvectionScheme::ALL.map(AdvectionScheme::name).to_vec(),
        AnyScene::Line(_) => Method::NAMES.to_vec(),
        AnyScene::Field(_) | AnyScene::Cloud(_) => {
            ParticleMethod::ALL.map(ParticleMethod::name).to_vec()
        }
    }
}

/// The name of the method that was asked for, or the customary one of the scene.
pub fn chosen<'a>(arguments: &'a Arguments, scene: &'a AnyScene) -> Result<&'a str, Failure> {
    let accepted = of(scene);
    let Some(name) = arguments.method().or(scene.method()) else {
        return Err(Failure::Message(format!(
            "--method is required for {}; accepted: {}",
            arguments.scene(),
            accepted.join(", ")
        )));
    };
    match accepted.contains(&name) {
        true => Ok(name),
        false => Err(not_for(name, arguments.scene(), &accepted)),
    }
}

/// What to say of a method that does not run a scene: which scenes it runs, or what else it is, or which name is near.
fn not_for(name: &str, scene: &str, accepted: &[&str]) -> Failure {
    let runs = |scene: &&AnyScene| of(scene).contains(&name);
    let others: Vec<&str> = AnyScene::all().iter().filter(runs).map(AnyScene::name).collect();
    let all = accepted.join(", ");
    let problem = if !others.is_empty() {
        format!("it does not run {scene} but {}; accepted: {all}", others.join(", "))
    } else {
        match names::elsewhere(name, None) {
            Some(what) => format!("{what}, and runs no scene; accepted: {all}"),
            None => names::unknown(&format!("method for {scene}"), name, accepted),
        }
    };
    Failure::Message(format!("--method {name}: {problem}"))
}

/// All of them, for listing.
pub fn all() -> Vec<Entry> {
    let advection = AdvectionScheme::ALL.into_iter().map(|scheme| Entry {
        name: scheme.name(),
        description: "advection scenes: the scheme stepped over particles",
        source: &scheme.file().source,
    });
    advection.chain(Method::NAMES.map(describe)).collect()
}

fn describe(name: &'static str) -> Entry {
    let (description, source) = match name {
        "finite-volume" => (
            "first-order Godunov finite volumes in Eulerian coordinates, exact Riemann flux",
            "Godunov 1959; Ferrari et al. 2008, section 3.3",
        ),
        "sph-adke" => (
            "standard SPH, adaptive density kernel estimation, Monaghan viscosity",
            "Sigalotti et al. 2006; Ferrari et al. 2008, section 3.3",
        ),
        "lagrangian-exact" => (
            "Godunov-type SPH in mass coordinates, exact Riemann flux",
            "Ferrari et al. 2008, (3.9)",
        ),
        "lagrangian-rusanov" => (
            "Godunov-type SPH in mass coordinates, Rusanov flux",
            "Ferrari et al. 2008, (3.9), (3.10)",
        ),
        "lagrangian-roe" => (
            "Godunov-type SPH in mass coordinates, modified Roe flux",
            "Ferrari et al. 2008, (3.9), (3.12)-(3.15)",
        ),
        _ => {
            let method = ParticleMethod::named(name).expect("the rest are particle methods");
            let description = match method {
                ParticleMethod::Gph1 => "Godunov particles, (1/ρi² + 1/ρj²) ∇W(h mean)",
                ParticleMethod::Gph2 => "Godunov particles, 2/(ρi ρj) ∇W(h mean)",
                ParticleMethod::Gph3 => "Godunov particles, ∇W(hi)/ρi² + ∇W(hj)/ρj²",
                ParticleMethod::Gph4 => "Godunov particles, convolution of Gaussians",
                ParticleMethod::Sph2 => "SPH, 2√(Pi Pj)/(ρi ρj), viscosity α = 1, β = 2",
                ParticleMethod::Sph1 | ParticleMethod::Adke => {
                    "SPH, Pi/ρi² + Pj/ρj², viscosity α = 1, β = 2"
                }
            };
            (description, method.source())
        }
    };
    Entry { name, description, source }
}
