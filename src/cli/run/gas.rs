//! Scenes and methods of one-dimensional gas dynamics.

use super::tube_file::{self, TubeFile};
use super::{Arguments, Entry, Family, no_method};
use crate::cli::output::{Format, print, print_record, warnings};
use crate::cli::{Failure, Outcome, names};
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::reports::gas_run;
use courant::reports::number::{exact_text, significant};
use courant::reports::publish::OutputDirectory;
use courant::reports::run_record::RunRecord;
use courant::reports::table::{Align, Table};
use courant::simulation::comparison::Comparison;
use courant::simulation::lagrangian::flux::Flux;
use courant::simulation::lagrangian::{LagrangianOptions, Lattice};
use courant::simulation::method::Method;
use courant::simulation::run::Run;
use courant::simulation::scene::{STANDARD_TUBES, Scene, ShockTube, SimpleWave, WaveData};
use serde::Serialize;
use std::time::Instant;

pub const FAMILY: Family = Family { scenes, methods, run };

/// The name of the smooth wave.
const SIMPLE_WAVE: &str = "simple-wave";

fn scenes() -> Vec<Entry> {
    let table = "Ferrari et al. 2008, Table 2";
    let chapter = "Toro 1999";
    let tubes = [
        ("ferrari1", "shock tube: sonic rarefaction, contact, shock (Toro's test 1)", table),
        ("ferrari2", "shock tube: two rarefactions, nearly a vacuum (the 123 problem)", table),
        ("ferrari3", "shock tube: strong shock, pressure ratio 1e5 (blast, left half)", table),
        ("ferrari4", "shock tube: two colliding shocks and a contact", table),
        ("sod", "shock tube of Sod", "Sod 1978"),
        ("toro4", "shock tube: blast to the left", chapter),
        ("toro5", "shock tube: strong shock with a slow contact", chapter),
        ("toro6", "shock tube: a contact at rest", chapter),
        ("toro7", "shock tube: a slowly moving contact", chapter),
        (
            SIMPLE_WAVE,
            "smooth periodic sound wave of finite amplitude",
            "Courant & Friedrichs 1948",
        ),
        (
            "FILE.toml",
            "a shock tube of your own; a bad file is answered with the keys it needs",
            "-",
        ),
    ];
    tubes.map(|(name, description, source)| Entry { name, description, source }).to_vec()
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
            _ => (
                "Godunov-type SPH in mass coordinates, modified Roe flux",
                "Ferrari et al. 2008, (3.9), (3.12)-(3.15)",
            ),
        };
        Entry { name, description, source }
    };
    Method::NAMES.map(describe).to_vec()
}

fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let file = if arguments.scene.ends_with(".toml") {
        Some(tube_file::read(&arguments.scene)?)
    } else {
        None
    };
    let method = method(arguments, file.as_ref())?;
    let scene = scene(arguments, file)?;
    let particles = arguments.particles.unwrap_or_else(|| scene.particles());
    check_lattice(&method, particles)?;
    let output = OutputDirectory::open(&arguments.out)?;
    let start = Instant::now();
    let run = method
        .run(scene.as_ref(), particles)
        .map_err(|error| Failure::Message(format!("--method {}: {error}", method.name())))?;
    let seconds = start.elapsed().as_secs_f64();
    let record = GasRecord::new(
        gas_run::record(scene.as_ref(), &method, particles, &run, seconds),
        &method,
        arguments.ratio.as_ref(),
    );
    let title = format!(
        "{}: {}, t = {}",
        scene.name(),
        gas_run::method_title(method.name()),
        significant(run.time, 4)
    );
    let figure = gas_run::figure(scene.as_ref(), &run, &title);
    let stem = format!("{}_{}", file_stem(scene.name()), method.name());
    let mut files = Vec::new();
    for (ending, bytes) in [
        ("csv", gas_run::profile_csv(scene.as_ref(), &run)),
        ("png", figure.png()?),
        ("svg", figure.svg()?.into_bytes()),
    ] {
        files.push(output.write(&format!("{stem}.{ending}"), &bytes)?);
    }
    let table = table(scene.as_ref(), &method, &run, &record.run);
    print_record("run", &record, &table, arguments.format)?;
    if arguments.format == Format::Table {
        print(&warnings(&record.run.warnings))?;
        let names: Vec<String> =
            files.iter().map(|file| format!("wrote {}\n", file.display())).collect();
        print(&names.concat())?;
    }
    Ok(Outcome::Yes)
}

/// The record with what the method was set to.
#[derive(Debug, Serialize)]
struct GasRecord {
    #[serde(flatten)]
    run: RunRecord,
    /// Only for methods with a kernel.
    #[serde(skip_serializing_if = "Option::is_none")]
    kernel: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ratio: Option<String>,
    cfl: f64,
    /// All settings, in words.
    settings: String,
}

impl GasRecord {
    fn new(run: RunRecord, method: &Method, ratio: Option<&Rational>) -> Self {
        let (smoothing, cfl) = match method {
            Method::FiniteVolume(options) => (None, options.cfl),
            Method::AdaptiveSph(options) => {
                (Some((options.kernel, options.pilot_ratio)), options.cfl)
            }
            Method::Lagrangian(options) => (Some((options.kernel, options.ratio)), options.cfl),
        };
        Self {
            run,
            kernel: smoothing.map(|(kernel, _)| kernel.name()),
            ratio: smoothing.map(|(_, used)| ratio.map_or_else(|| exact_text(used), to_text)),
            cfl,
            settings: gas_run::settings(method),
        }
    }
}

/// Refuses before anything is written what the method would refuse later.
fn check_lattice(method: &Method, particles: usize) -> Result<(), Failure> {
    let Method::Lagrangian(options) = method else { return Ok(()) };
    let lattice = Lattice::new(options.kernel, options.ratio)
        .map_err(|error| Failure::Message(format!("--ratio {}: {error}", options.ratio)))?;
    let least = 2 * lattice.reach() + 1;
    if particles < least {
        return Err(Failure::Message(format!(
            "--particles {particles}: at least {least} are needed where the kernel reaches {} \
             neighbours on each side",
            lattice.reach()
        )));
    }
    Ok(())
}

/// A scene name as part of a file name.
fn file_stem(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' };
    name.chars().map(plain).collect()
}

/// An option that the method does not have.
fn unused(option: &str, value: &Rational, method: &str, accepted: &str) -> Failure {
    let value = to_text(value);
    Failure::Message(format!("{option} {value}: `{method}` has no such option; {accepted}"))
}

fn method(arguments: &Arguments, file: Option<&TubeFile>) -> Result<Method, Failure> {
    let chosen = arguments.method.as_deref().or(file.and_then(|file| file.method.as_deref()));
    let Some(name) = chosen else {
        return Err(Failure::Message(format!(
            "--method is required for {}; accepted: {}",
            arguments.scene,
            Method::NAMES.join(", ")
        )));
    };
    let mut method =
        Method::named(name).ok_or_else(|| no_method(name, &arguments.scene, &Method::NAMES))?;
    let cfl = arguments.cfl.as_ref().map(to_f64);
    let choices = &arguments.choices;
    let has: &[&str] = match &method {
        Method::AdaptiveSph(_) => &["--alpha", "--beta"],
        Method::Lagrangian(LagrangianOptions { flux: Flux::ModifiedRoe(_), .. }) => {
            &["--roe-mean", "--contact", "--contact-form"]
        }
        Method::FiniteVolume(_) | Method::Lagrangian(_) => &[],
    };
    choices.only(has, name)?;
    match &mut method {
        Method::FiniteVolume(options) => {
            let accepted = "it takes --particles, --cfl and --time";
            if let Some(kernel) = arguments.kernel {
                return Err(Failure::Message(format!(
                    "--kernel {}: `{name}` has no kernel; {accepted}",
                    kernel.name()
                )));
            }
            if let Some(ratio) = &arguments.ratio {
                return Err(unused("--ratio", ratio, name, accepted));
            }
            options.cfl = cfl.unwrap_or(options.cfl);
        }
        Method::AdaptiveSph(options) => {
            options.cfl = cfl.unwrap_or(options.cfl);
            options.kernel = arguments.kernel.unwrap_or(options.kernel);
            options.pilot_ratio = arguments.ratio.as_ref().map_or(options.pilot_ratio, to_f64);
            options.alpha = choices.alpha(options.alpha);
            options.beta = choices.beta(options.beta);
        }
        Method::Lagrangian(options) => {
            options.cfl = cfl.unwrap_or(options.cfl);
            options.kernel = arguments.kernel.unwrap_or(options.kernel);
            options.ratio = arguments.ratio.as_ref().map_or(options.ratio, to_f64);
            if let Flux::ModifiedRoe(roe) = &mut options.flux {
                *roe = choices.roe(*roe);
            }
        }
    }
    Ok(method)
}

fn scene(arguments: &Arguments, file: Option<TubeFile>) -> Result<Box<dyn Scene>, Failure> {
    let name = arguments.scene.as_str();
    let time = arguments.time.as_ref();
    let bad_time = |value: &Rational, problem: &dyn std::fmt::Display| {
        Failure::Message(format!("--time {}: {problem}", to_text(value)))
    };
    if name == SIMPLE_WAVE {
        let mut data = WaveData { amplitude: 0.1, gamma: 1.4, end_time: 0.5, particles: 100 };
        data.end_time = time.map_or(data.end_time, to_f64);
        let wave = SimpleWave::new(data).map_err(|error| match time {
            Some(value) => bad_time(value, &error),
            None => Failure::Message(error.to_string()),
        })?;
        return Ok(Box::new(wave));
    }
    let tube = match file {
        Some(file) => file.tube,
        None => {
            let problem = || names::unknown("scene", name, &STANDARD_TUBES);
            ShockTube::standard(name)
                .ok_or_else(|| Failure::Message(format!("SCENE {name}: {}", problem())))?
        }
    };
    let Some(value) = time else { return Ok(Box::new(tube)) };
    let mut data = tube.data().clone();
    data.end_time = to_f64(value);
    let tube = ShockTube::new(data).map_err(|error| bad_time(value, &error))?;
    Ok(Box::new(tube))
}

fn table(scene: &dyn Scene, method: &Method, run: &Run, record: &RunRecord) -> Table {
    let caption = format!(
        "{} ({}), {}: {}",
        scene.name(),
        scene.source(),
        gas_run::method_title(method.name()),
        gas_run::settings(method)
    );
    let mut table = Table::new(caption, &[("", Align::Left), ("", Align::Right)]);
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    add("completed", if record.completed { "yes".into() } else { "no".into() });
    if let Some(failure) = &record.failure {
        add("failure", failure.clone());
    }
    add("time", significant(record.time, 6));
    add("steps", record.steps.to_string());
    add("particles", record.particles.to_string());
    let number = |value: Option<f64>| value.map_or_else(|| "–".into(), |v| significant(v, 5));
    if record.completed {
        let comparison = Comparison::inside(scene, run, gas_run::window(scene));
        add("inside at the end", comparison.inside.to_string());
        add("L1 density", number(record.l1.density));
        add("L1 velocity", number(record.l1.velocity));
        add("L1 pressure", number(record.l1.pressure));
        add("L1 internal energy", number(record.l1.energy));
        add("overshoot of energy", significant(comparison.overshoot.energy, 4));
        for wave in &comparison.waves {
            let name = format!("{:?} off by", wave.kind).to_lowercase();
            add(&name, number(wave.error()));
        }
    }
    add("drift of mass", number(record.conservation.mass));
    add("drift of momentum", number(record.conservation.momentum));
    add("drift of energy", number(record.conservation.energy));
    add("pairs computed", run.pairs.to_string());
    add("seconds", significant(record.wall_seconds, 3));
    table
}
