//! A run of gas dynamics as a record, and its settings in words.

use crate::number::{finite, significant};
use crate::particle_profile::{profile_csv, profile_figure};
use crate::run_record::{ErrorNorms, NO_ENERGY, RunRecord, RunReport, method_title};
use courant_simulation::comparison::Comparison;
use courant_simulation::method::Method;
use courant_simulation::particles::MethodOptions;
use courant_simulation::riemann::Wave;
use courant_simulation::run::{Counters, Run};
use courant_simulation::scene::{ExactSolution, Material, Scene};

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

/// The equation of state, in words.
pub fn eos(material: Material) -> String {
    match material {
        Material::Isothermal(gas) => format!("isothermal, c = {}", gas.sound_speed),
        Material::Ideal(gas) => format!("ideal gas, γ = {}", significant(gas.gamma(), 6)),
    }
}

/// Adds what a particle method was set to, and its work; `ratio` is the smoothing length as it was asked for.
pub fn describe_particles(
    record: &mut RunRecord,
    options: &MethodOptions,
    ratio: &str,
    work: &Counters,
) {
    record.set("kernel", options.kernel.name());
    record.set("ratio", ratio);
    record.set("cfl", options.courant);
    record.set("integrator", options.integrator.name.as_str());
    if options.method.is_godunov() {
        record.set("riemann", options.solver.name());
        record.set("pair_work", options.pair_work.name());
    } else {
        record.set("alpha", options.viscosity.alpha);
        record.set("beta", options.viscosity.beta);
    }
    record.set("work", options.work.name());
    record.set("pair_interactions", work.interactions);
    if options.method.is_godunov() {
        record.set("riemann_iterations", work.riemann_iterations);
    }
    if work.attractions > 0 {
        record.set("attractions", work.attractions);
    }
}

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
    let comparison = match &holds {
        Ok(()) if run.completed() && inside > 0 => Comparison::new(scene, run),
        _ => None,
    };
    let note = match holds {
        Err(reason) => reason,
        Ok(()) if inside == 0 => format!("no particle is left in the window from {from} to {to}"),
        Ok(()) if isothermal => NO_ENERGY.into(),
        Ok(()) => "where particles are, the exact solution is a vacuum".into(),
    };
    let names = [scene.name.as_str(), method.name()];
    let mut record = RunRecord::new(names, particles, run, &note, wall_seconds);
    record.advise(run.failure.and_then(|failure| method.advice(&failure.reason)));
    if let Some(Comparison { l1, .. }) = comparison {
        record.l1 = ErrorNorms {
            value: None,
            density: finite(l1.density),
            velocity: finite(l1.velocity),
            pressure: finite(l1.pressure),
            energy: finite(l1.energy),
        };
        record.l1_note = record.l1_note.filter(|_| !record.l1.is_complete());
    }
    if run.completed() && inside > 0 && waves_have_left(scene, run.time) {
        record.warnings.push(format!(
            "every wave has left the window from {from} to {to} before t = {}: the error norms are those of one constant state",
            significant(run.time, 6)
        ));
    }
    record
}

/// The record with all settings, the profile and its picture; `ratio` is the smoothing length as it was asked for.
pub fn report(
    scene: &Scene,
    method: &Method,
    ratio: &str,
    particles: usize,
    run: &Run,
    seconds: f64,
) -> RunReport {
    let mut record = record(scene, method, particles, run, seconds);
    record.set("eos", eos(scene.material));
    match method {
        Method::FiniteVolume(options) => record.set("cfl", options.cfl),
        Method::Lagrangian(options) => {
            record.set("kernel", options.kernel.name());
            record.set("ratio", ratio);
            record.set("cfl", options.cfl);
        }
        Method::Particles(options) => {
            describe_particles(&mut record, options, ratio, &run.counters);
        }
    }
    let settings = settings(method);
    record.set("penetration", run.penetration.largest);
    record.set("inside_at_end", run.profile.inside(scene.window).len());
    if record.l1.density.is_some()
        && let Some(comparison) = Comparison::new(scene, run)
    {
        record.set("density_overshoot", finite(comparison.overshoot.density));
        for wave in &comparison.waves {
            let kind = format!("{:?}", wave.kind).to_lowercase();
            // From left to right.
            let second = record.more.contains_key(&format!("{kind}_error"));
            let name = format!("{kind}_error{}", if second { "_2" } else { "" });
            record.set(&name, wave.error().and_then(finite));
        }
    }
    let exact = exact_holds(scene, run.time).is_ok();
    let outcome = if run.completed() { "" } else { ": failed" };
    let title =
        format!("{}: {}, t = {}{outcome}", scene.name, method.title(), significant(run.time, 4));
    RunReport {
        caption: format!(
            "{} ({}), {}: {settings}",
            scene.name,
            scene.source,
            method_title(method.name())
        ),
        files: vec![(".csv", profile_csv(scene, run, exact))],
        figure: Some(profile_figure(scene, run, exact).title(title)),
        record,
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
