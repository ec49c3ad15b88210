//! Scenes and methods of one-dimensional gas dynamics.

use super::answer::{Answer, Record, method_title};
use super::particle_options::{self, invalid};
use super::{Arguments, Entry, Family, Start, no_method};
use crate::cli::progress::Bar;
use crate::cli::{Failure, names};
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::reports::gas_run;
use courant::reports::number::{exact_text, significant};
use courant::reports::particle_profile::{profile_csv, profile_figure};
use courant::reports::run_record::RunRecord;
use courant::reports::table::{Align, Table};
use courant::simulation::comparison::Comparison;
use courant::simulation::lagrangian::LagrangianOptions;
use courant::simulation::lagrangian::flux::Flux;
use courant::simulation::method::Method;
use courant::simulation::particles::ParticleMethod;
use courant::simulation::run::Run;
use courant::simulation::scene::{KEYS, Scene};
use serde::Serialize;
use std::path::Path;
use std::time::Instant;

pub const FAMILY: Family = Family { scenes, methods, plan };

fn scenes() -> Vec<Entry> {
    let own = Entry {
        name: "FILE.toml",
        description: "a scene of your own; a bad file is answered with the keys it needs",
        source: "-",
    };
    let entry = |scene: &'static Scene| Entry {
        name: &scene.name,
        description: &scene.description,
        source: &scene.source,
    };
    Scene::all().iter().map(entry).chain([own]).collect()
}

fn methods() -> Vec<Entry> {
    let describe = |name: &'static str| {
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
    };
    Method::NAMES.map(describe).to_vec()
}

fn plan(arguments: Arguments) -> Result<Start, Failure> {
    let scene = scene(&arguments)?;
    let method = method(&arguments, scene.method.as_deref())?;
    let particles = arguments.particles().unwrap_or(scene.particles);
    method.check(&scene, particles).map_err(|error| invalid(&error, &arguments, method.name()))?;
    Ok(Box::new(move || {
        let bar = Bar::new(&scene.name);
        let start = Instant::now();
        let run = method
            .run_with(&scene, particles, |time| bar.march(time, scene.end_time))
            .map_err(|error| invalid(&error, &arguments, method.name()))?;
        let seconds = start.elapsed().as_secs_f64();
        bar.finish();
        let record = GasRecord::new(
            gas_run::record(&scene, &method, particles, &run, seconds),
            &method,
            &run,
            arguments.ratio(),
        );
        let exact = gas_run::exact_holds(&scene, run.time).is_ok();
        let outcome = if run.completed() { "" } else { ": failed" };
        let title = format!(
            "{}: {}, t = {}{outcome}",
            scene.name,
            method.title(),
            significant(run.time, 4)
        );
        let figure = profile_figure(&scene, &run, exact).title(title);
        let files = vec![(".csv".into(), profile_csv(&scene, &run, exact))];
        let table = table(&scene, &method, &run, &record);
        Answer::new(Record::Gas(record), table, files, Some(figure))
    }))
}

/// The record with what the method was set to, and its work.
#[derive(Debug, Serialize)]
pub struct GasRecord {
    /// What every run has.
    #[serde(flatten)]
    pub run: RunRecord,
    /// Only for methods with a kernel.
    #[serde(skip_serializing_if = "Option::is_none")]
    kernel: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ratio: Option<String>,
    cfl: f64,
    /// What follows is only for the methods that have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    integrator: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    alpha: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    beta: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    riemann: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    work: Option<&'static str>,
    /// Neighbours in the wrong order: the most after any step.
    penetration: usize,
    pair_interactions: u64,
    riemann_iterations: u64,
    /// All settings, in words.
    settings: String,
}

impl GasRecord {
    fn new(run: RunRecord, method: &Method, result: &Run, ratio: Option<&Rational>) -> Self {
        let (smoothing, cfl, options) = match method {
            Method::FiniteVolume(options) => (None, options.cfl, None),
            Method::Lagrangian(options) => {
                (Some((options.kernel, options.ratio)), options.cfl, None)
            }
            Method::Particles(options) => {
                (Some((options.kernel, options.eta)), options.courant, Some(options))
            }
        };
        let godunov = options.is_some_and(|options| options.method.is_godunov());
        let viscosity = options.filter(|_| !godunov).map(|options| options.viscosity);
        Self {
            run,
            kernel: smoothing.map(|(kernel, _)| kernel.name()),
            ratio: smoothing.map(|(_, used)| ratio.map_or_else(|| exact_text(used), to_text)),
            cfl,
            integrator: options.map(|options| options.integrator.name.as_str()),
            alpha: viscosity.map(|viscosity| viscosity.alpha),
            beta: viscosity.map(|viscosity| viscosity.beta),
            riemann: options.filter(|_| godunov).map(|options| options.solver.name()),
            work: options.map(|options| options.work.name()),
            penetration: result.penetration.largest,
            pair_interactions: result.counters.interactions,
            riemann_iterations: result.counters.riemann_iterations,
            settings: gas_run::settings(method),
        }
    }
}

/// An option that the method does not have.
fn unused(option: &str, value: &str, method: &str) -> Failure {
    Failure::Message(format!(
        "{option} {value}: `{method}` has no kernel; it takes --particles, --cfl and --time"
    ))
}

fn method(arguments: &Arguments, customary: Option<&str>) -> Result<Method, Failure> {
    let Some(name) = arguments.method().or(customary) else {
        return Err(Failure::Message(format!(
            "--method is required for {}; accepted: {}",
            arguments.scene(),
            Method::NAMES.join(", ")
        )));
    };
    let mut method =
        Method::named(name).ok_or_else(|| no_method(name, arguments.scene(), &Method::NAMES))?;
    let choices = &arguments.choices;
    let has: &[&str] = match &method {
        Method::Particles(options) => particle_options::accepted(options.method),
        Method::Lagrangian(LagrangianOptions { flux: Flux::ModifiedRoe(_), .. }) => {
            &["--roe-mean", "--contact", "--contact-form"]
        }
        Method::FiniteVolume(_) | Method::Lagrangian(_) => &[],
    };
    choices.only(has, name)?;
    let cfl = arguments.cfl().map(to_f64);
    match &mut method {
        Method::FiniteVolume(options) => {
            if let Some(kernel) = arguments.kernel() {
                return Err(unused("--kernel", kernel.name(), name));
            }
            if let Some(ratio) = arguments.ratio() {
                return Err(unused("--ratio", &to_text(ratio), name));
            }
            options.cfl = cfl.unwrap_or(options.cfl);
        }
        Method::Lagrangian(options) => {
            options.cfl = cfl.unwrap_or(options.cfl);
            options.kernel = arguments.kernel().unwrap_or(options.kernel);
            options.ratio = arguments.ratio().map_or(options.ratio, to_f64);
            if let Flux::ModifiedRoe(roe) = &mut options.flux {
                *roe = choices.roe(*roe);
            }
        }
        Method::Particles(options) => particle_options::choose(arguments, options)?,
    }
    Ok(method)
}

fn scene(arguments: &Arguments) -> Result<Scene, Failure> {
    let name = arguments.scene();
    let mut scene = if name.ends_with(".toml") {
        read(name)?
    } else {
        let known: Vec<&str> = Scene::all().iter().map(|scene| scene.name.as_str()).collect();
        let problem = || names::unknown("scene", name, &known);
        Scene::named(name)
            .ok_or_else(|| Failure::Message(format!("SCENE {name}: {}", problem())))?
    };
    if let Some(time) = arguments.time() {
        scene.end_time = to_f64(time);
    }
    Ok(scene)
}

/// Reads a file; every complaint names file, line and what is accepted.
fn read(path: &str) -> Result<Scene, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        Failure::Message(format!("SCENE {path}: {error}; accepted: a TOML file with {KEYS}"))
    })?;
    let stem = Path::new(path).file_stem().map_or("scene".into(), |stem| stem.to_string_lossy());
    let scene = Scene::parse(&text, &stem)
        .map_err(|error| Failure::Message(format!("SCENE {path}, {error}")))?;
    if let Some(method) = &scene.method
        && Method::named(method).is_none()
    {
        let line =
            1 + text.lines().take_while(|line| !line.trim_start().starts_with("method")).count();
        let problem = names::unknown("method", method, &Method::NAMES);
        return Err(Failure::Message(format!(
            "SCENE {path}, line {line}: method = \"{method}\": {problem}"
        )));
    }
    Ok(scene)
}

fn table(scene: &Scene, method: &Method, run: &Run, record: &GasRecord) -> Table {
    let caption = format!(
        "{} ({}), {}: {}",
        scene.name,
        scene.source,
        method_title(method.name()),
        record.settings
    );
    let mut table = Table::new(caption, &[("", Align::Left), ("", Align::Right)]);
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    let (record, work) = (&record.run, record);
    add("completed", if record.completed { "yes".into() } else { "no".into() });
    if let Some(failure) = &record.failure {
        add("failure", failure.clone());
    }
    add("time", significant(record.time, 6));
    add("steps", record.steps.to_string());
    if record.rejected_steps > 0 {
        add("steps repeated with half", record.rejected_steps.to_string());
    }
    add("particles", record.particles.to_string());
    let number = |value: Option<f64>| value.map_or_else(|| "–".into(), |v| significant(v, 5));
    if record.completed {
        add("inside at the end", run.profile.inside(scene.window).len().to_string());
        add("L1 density", number(record.l1.density));
        add("L1 velocity", number(record.l1.velocity));
        add("L1 pressure", number(record.l1.pressure));
        add("L1 internal energy", number(record.l1.energy));
        if let Some(note) = &record.l1_note {
            add("no L1", note.clone());
        }
        if record.l1.density.is_some()
            && let Some(comparison) = Comparison::new(scene, run)
        {
            add("overshoot of density", significant(comparison.overshoot.density, 4));
            for wave in &comparison.waves {
                let name = format!("{:?} off by", wave.kind).to_lowercase();
                add(&name, number(wave.error()));
            }
        }
    }
    add("drift of mass", number(record.conservation.mass));
    add("drift of momentum", number(record.conservation.momentum));
    add("drift of energy", number(record.conservation.energy));
    add("particles out of order", work.penetration.to_string());
    add("pairs computed", work.pair_interactions.to_string());
    if work.riemann.is_some() {
        add("Riemann iterations", work.riemann_iterations.to_string());
    }
    add("seconds", significant(record.wall_seconds, 3));
    table
}
