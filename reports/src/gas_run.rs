//! A run of gas dynamics as a record, and its settings in words.

use crate::number::{finite, significant};
use crate::run_record::{BROKEN, ConservationRecord, ErrorNorms, RunRecord};
use courant_simulation::comparison::Comparison;
use courant_simulation::method::Method;
use courant_simulation::particles::MethodOptions;
use courant_simulation::riemann::Wave;
use courant_simulation::run::Run;
use courant_simulation::scene::{ExactSolution, Scene};

/// The method with its settings, for captions.
pub fn settings(method: &Method) -> String {
    use courant_simulation::lagrangian::flux::{ContactViscosity, Flux, RoeMean};
    match method {
        Method::FiniteVolume(options) => {
            format!("Courant number {} of the fastest wave |v| + c", options.cfl)
        }
        Method::Particles(options) => particle_settings(options),
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

/// "cubic B-spline, h = 1.05 spacings" and so on.
pub fn particle_settings(options: &MethodOptions) -> String {
    let smoothing = match options.estimation {
        None => format!("h = {} spacings", options.eta),
        Some(estimation) => format!(
            "h₀ = {} × largest spacing, k = {}, ε = {}",
            options.eta, estimation.scale, estimation.sensitivity
        ),
    };
    let viscosity = match options.method.is_godunov() {
        true => String::new(),
        false => format!(", α = {}, β = {}", options.viscosity.alpha, options.viscosity.beta),
    };
    format!(
        "{}, {smoothing}{viscosity}, step {} of the shortest crossing time h/s, {}",
        options.kernel.title(),
        options.courant,
        options.integrator.name
    )
}

/// Why there are no norms, or some are missing.
const NO_ENERGY: &str = "an isothermal gas has no energy equation";

/// Whether the exact solution holds at the time a run reached, and why not.
pub fn exact_holds(scene: &Scene, time: f64) -> Result<(), String> {
    let until = scene.holds_until();
    match scene.exact_solution() {
        ExactSolution::None => Err("the scene has no exact solution".into()),
        // The end time may be the very limit.
        _ if time > until * (1.0 + 1e-12) => Err(format!(
            "the exact solution holds until t = {}: then waves from the ends may be in the window, or the wave breaks",
            significant(until, 4)
        )),
        _ => Ok(()),
    }
}

/// The record of a run. A run that broke down has no error norms: what it left is no approximation of
/// the end.
pub fn record(
    scene: &Scene,
    method: &Method,
    particles: usize,
    run: &Run,
    wall_seconds: f64,
) -> RunRecord {
    let [from, to] = scene.window;
    let isothermal = scene.material.ideal().is_none();
    let holds = exact_holds(scene, run.time);
    let inside = run.profile.inside(scene.window).len();
    let mut warnings = run.warnings.clone();
    let comparison = match &holds {
        Ok(()) if run.completed() && inside > 0 => Comparison::new(scene, run),
        _ => None,
    };
    let l1 = comparison.map_or_else(ErrorNorms::default, |comparison| ErrorNorms {
        value: None,
        density: finite(comparison.l1.density),
        velocity: finite(comparison.l1.velocity),
        pressure: finite(comparison.l1.pressure),
        energy: finite(comparison.l1.energy),
    });
    let no_norms = match (&run.failure, holds) {
        (Some(_), _) => BROKEN.into(),
        (None, Err(reason)) => reason,
        (None, Ok(())) if inside == 0 => {
            format!("no particle is left in the window from {from} to {to}")
        }
        (None, Ok(())) if isothermal => NO_ENERGY.into(),
        (None, Ok(())) => "where particles are, the exact solution is a vacuum".into(),
    };
    if run.completed() && inside > 0 && waves_have_left(scene, run.time) {
        warnings.push(format!(
            "every wave has left the window from {from} to {to} before t = {}: the error norms are those of one constant state",
            significant(run.time, 6)
        ));
    }
    let conservation = ConservationRecord {
        mass: finite(run.conservation.mass),
        momentum: finite(run.conservation.momentum),
        energy: run.conservation.energy.and_then(finite),
    };
    RunRecord {
        scene: scene.name.clone(),
        method: method.name().into(),
        particles,
        steps: run.steps,
        rejected_steps: run.rejected,
        time: run.time,
        completed: run.completed(),
        failure: run.failure.map(|failure| match method.advice(&failure.reason) {
            Some(advice) => format!("{failure}; {advice}"),
            None => failure.to_string(),
        }),
        warnings,
        l1_note: (!l1.is_complete()).then_some(no_norms),
        l1,
        conservation_note: match isothermal {
            _ if conservation.is_complete() => None,
            true => Some(NO_ENERGY.into()),
            false => Some(BROKEN.into()),
        },
        conservation,
        wall_seconds,
    }
}

/// Whether the exact solution of a Riemann problem is one state all over the window where a run is compared.
fn waves_have_left(scene: &Scene, time: f64) -> bool {
    let Some((solution, origin)) = scene.riemann() else { return false };
    let [from, to] = scene.window.map(|end| (end - origin) / time);
    let inside = |ray: f64| from < ray && ray < to;
    let acoustic = |wave| match wave {
        Wave::Absent => false,
        Wave::Shock { speed } => inside(speed),
        // Its rays cover what is between head and tail.
        Wave::Rarefaction { head, tail } => head.min(tail) < to && from < head.max(tail),
    };
    let (left, right) = solution.densities();
    let contact = left != right && inside(solution.velocity());
    // A vacuum between its fronts is no one state.
    let vacuum = left == 0.0 && right == 0.0;
    !(vacuum || acoustic(solution.left_wave()) || acoustic(solution.right_wave()) || contact)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle_profile::profile_figure;

    #[test]
    fn a_failed_run_has_a_reason_and_no_norms() {
        let tube = Scene::named("ferrari3").unwrap();
        let method = Method::named("sph-adke").unwrap();
        let run = method.run(&tube, 100).unwrap();
        let record = record(&tube, &method, 100, &run, 0.0);
        assert!(!record.completed && record.failure.is_some_and(|text| text.contains("--ratio")));
        assert_eq!(record.l1, ErrorNorms::default());
        assert!(record.time < 0.012);
        assert!(profile_figure(&tube, &run, true).svg().is_ok());
    }

    #[test]
    fn a_note_says_truly_why_norms_are_missing() {
        let note = |scene: &Scene, method: &str| {
            let method = Method::named(method).unwrap();
            let run = method.run(scene, 50).unwrap();
            record(scene, &method, 50, &run, 0.0).l1_note.unwrap_or_default()
        };
        let sod = Scene::named("sod").unwrap();
        assert_eq!(note(&sod, "lagrangian-roe"), "");
        // Streams that part leave nothing behind.
        let text = "gamma = 1.4\ndomain = [0, 1]\ndiaphragm = 0.5\nend_time = 1.0\n\
                    left = { density = 1, velocity = -9, pressure = 0.4 }\n\
                    right = { density = 1, velocity = 9, pressure = 0.4 }\n";
        let parting = Scene::parse(text, "parting").unwrap();
        assert!(
            note(&parting, "lagrangian-exact").starts_with("no particle is left in the window")
        );
        let late = Scene { end_time: 2.0, ..Scene::named("sod-sph").unwrap() };
        assert!(note(&late, "gph3").starts_with("the exact solution holds until"));
        assert!(note(&Scene::named("isothermal-tube").unwrap(), "gph3").contains("isothermal"));
        assert!(note(&Scene::named("shu-osher").unwrap(), "finite-volume").contains("no exact"));
    }
}
