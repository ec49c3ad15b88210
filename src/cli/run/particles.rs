//! Scenes and methods of particle hydrodynamics: Cha & Whitworth 2003.

use super::{Arguments, Entry, Family, no_method};
use crate::cli::output::{Format, print, print_record};
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::reports::number::{exact_text, finite, significant};
use courant::reports::particle_profile::{exact_solution_holds, profile_csv, profile_figure};
use courant::reports::publish::OutputDirectory;
use courant::reports::run_record::{BROKEN, ConservationRecord, ErrorNorms, RunRecord};
use courant::reports::table::{Align, Table};
use courant::simulation::particles::{
    InvalidMethodOptions, Material, MethodOptions, ParticleMethod, ParticleRun, ParticleScene,
    run_particles,
};
use serde::Serialize;
use std::time::Instant;

pub const FAMILY: Family = Family { scenes, methods, run };

fn scenes() -> Vec<Entry> {
    ParticleScene::all()
        .map(|scene| Entry {
            name: scene.name,
            description: scene.description,
            source: scene.source,
        })
        .to_vec()
}

fn methods() -> Vec<Entry> {
    let describe = |method| match method {
        ParticleMethod::Gph1 => "Godunov particles, (1/ρi² + 1/ρj²) ∇W(h mean)",
        ParticleMethod::Gph2 => "Godunov particles, 2/(ρi ρj) ∇W(h mean)",
        ParticleMethod::Gph3 => "Godunov particles, ∇W(hi)/ρi² + ∇W(hj)/ρj², exact energy",
        ParticleMethod::Gph4 => "Godunov particles, convolution of Gaussians, exact energy",
        ParticleMethod::Sph1 => "SPH, Pi/ρi² + Pj/ρj², viscosity α = 1, β = 2",
        ParticleMethod::Sph2 => "SPH, 2√(Pi Pj)/(ρi ρj), viscosity α = 1, β = 2",
    };
    ParticleMethod::ALL
        .map(|method| Entry {
            name: method.name(),
            description: describe(method),
            source: method.source(),
        })
        .to_vec()
}

/// What is to be run, checked before anything starts.
struct Plan {
    scene: ParticleScene,
    /// The end time the scene came with.
    customary_end: f64,
    particles: usize,
    options: MethodOptions,
    /// The smoothing ratio as it is written exactly.
    ratio: String,
}

impl Plan {
    fn new(arguments: &Arguments) -> Result<Self, Failure> {
        let all = ParticleMethod::ALL.map(ParticleMethod::name);
        let method = match &arguments.method {
            Some(name) => ParticleMethod::named(name)
                .ok_or_else(|| no_method(name, &arguments.scene, &all))?,
            None => {
                return Err(Failure::Message(format!(
                    "--method is required for {}; accepted: {}",
                    arguments.scene,
                    all.join(", ")
                )));
            }
        };
        let mut scene =
            ParticleScene::named(&arguments.scene).expect("the family answers for its own scenes");
        let customary_end = scene.end_time;
        if let Some(time) = &arguments.time {
            scene.end_time = to_f64(time);
        }
        let mut options = MethodOptions::new(method);
        if let Some(kernel) = arguments.kernel {
            options.kernel = kernel;
            if kernel == Kernel::Gaussian {
                // The ratio that keeps lattice points off the cut, as for the method that brings it.
                options.eta = MethodOptions::new(ParticleMethod::Gph4).eta;
            }
        }
        if let Some(ratio) = &arguments.ratio {
            options.eta = to_f64(ratio);
        }
        if let Some(courant) = &arguments.cfl {
            options.courant = to_f64(courant);
        }
        let choices = &arguments.choices;
        let has: &[&str] = match method.is_godunov() {
            true => &["--riemann", "--integrator"],
            false => &["--alpha", "--beta", "--integrator"],
        };
        choices.only(has, method.name())?;
        options.integrator = choices.integrator(options.integrator);
        options.solver = choices.solver(options.solver);
        options.viscosity.alpha = choices.alpha(options.viscosity.alpha);
        options.viscosity.beta = choices.beta(options.viscosity.beta);
        let ratio = arguments.ratio.as_ref().map_or_else(|| exact_text(options.eta), to_text);
        let plan = Self {
            customary_end,
            particles: arguments.particles.unwrap_or(scene.particles),
            scene,
            options,
            ratio,
        };
        plan.options.check().map_err(invalid)?;
        Ok(plan)
    }
}

/// The option's name as it is on the command line.
fn invalid(error: InvalidMethodOptions) -> Failure {
    Failure::Message(match error {
        InvalidMethodOptions::Kernel(kernel) => {
            format!(
                "--kernel {kernel}: gph4 has a closed form for the gaussian only; accepted: gaussian"
            )
        }
        InvalidMethodOptions::Particles(count) => {
            format!("--particles {count}: particle scenes need at least 10")
        }
        InvalidMethodOptions::NotPositive { name: "eta", value } => {
            format!("--ratio {value}: it must be above 0")
        }
        InvalidMethodOptions::NotPositive { value, .. } => {
            format!("--cfl {value}: it must be above 0 and finite")
        }
        other => other.to_string(),
    })
}

/// The record with what only particle runs have.
#[derive(Debug, Serialize)]
struct ParticleRecord {
    #[serde(flatten)]
    run: RunRecord,
    kernel: &'static str,
    ratio: String,
    cfl: f64,
    integrator: &'static str,
    /// Only for the methods that have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    alpha: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    beta: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    riemann: Option<&'static str>,
    /// Neighbours in the wrong order: the most after any step.
    penetration: usize,
    pair_interactions: u64,
    riemann_iterations: u64,
}

const NO_ENERGY: &str = "an isothermal gas has no energy equation";
const NO_EXACT: &str = "the scene has no exact solution";
const TOO_LATE: &str =
    "after the scene's own end time, waves from the ends may be inside the comparison window";

fn record(plan: &Plan, run: &ParticleRun, seconds: f64) -> ParticleRecord {
    let exact = exact_solution_holds(&plan.scene, plan.customary_end, run.time);
    // The state of a broken run has no error norm worth the name.
    let errors = run.errors.filter(|_| exact && run.completed());
    let isothermal = matches!(plan.scene.material, Material::Isothermal(_));
    let options = &plan.options;
    let godunov = options.method.is_godunov();
    let conservation = ConservationRecord {
        mass: finite(run.drift.mass),
        momentum: finite(run.drift.momentum),
        energy: run.drift.energy.and_then(finite),
    };
    ParticleRecord {
        run: RunRecord {
            scene: plan.scene.name.into(),
            method: plan.options.method.name().into(),
            particles: run.profile.len(),
            steps: run.steps as usize,
            time: run.time,
            completed: run.completed(),
            failure: run.failure.map(|failure| failure.to_string()),
            warnings: Vec::new(),
            l1: ErrorNorms {
                value: None,
                density: errors.and_then(|e| finite(e.density)),
                velocity: errors.and_then(|e| finite(e.velocity)),
                pressure: errors.and_then(|e| finite(e.pressure)),
                energy: errors.and_then(|e| e.energy).and_then(finite),
            },
            l1_note: match errors {
                Some(_) if isothermal => Some(NO_ENERGY.into()),
                Some(_) => None,
                None if !run.completed() => Some(BROKEN.into()),
                None if exact => Some(NO_EXACT.into()),
                None => Some(TOO_LATE.into()),
            },
            conservation_note: match isothermal {
                _ if conservation.is_complete() => None,
                true => Some(NO_ENERGY.into()),
                false => Some(BROKEN.into()),
            },
            conservation,
            wall_seconds: seconds,
        },
        kernel: options.kernel.name(),
        ratio: plan.ratio.clone(),
        cfl: options.courant,
        integrator: &options.integrator.name,
        alpha: (!godunov).then_some(options.viscosity.alpha),
        beta: (!godunov).then_some(options.viscosity.beta),
        riemann: godunov.then(|| options.solver.name()),
        penetration: run.penetration.largest,
        pair_interactions: run.counters.interactions,
        riemann_iterations: run.counters.riemann_iterations,
    }
}

fn table(record: &ParticleRecord) -> Table {
    let run = &record.run;
    let outcome = match &run.failure {
        None => "completed".into(),
        Some(failure) => format!("broke down: {failure}"),
    };
    let caption = format!(
        "{} with {}, {} particles, {} at {} spacings, step {} of the crossing time: {outcome}",
        run.scene, run.method, run.particles, record.kernel, record.ratio, record.cfl
    );
    let mut table = Table::new(caption, &[("quantity", Align::Left), ("value", Align::Right)]);
    let number = |value: Option<f64>, digits| {
        value.map_or_else(|| "–".to_string(), |value| significant(value, digits))
    };
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    add("time", significant(run.time, 6));
    add("steps", run.steps.to_string());
    add("L1 density", number(run.l1.density, 4));
    add("L1 velocity", number(run.l1.velocity, 4));
    add("L1 pressure", number(run.l1.pressure, 4));
    add("L1 energy", number(run.l1.energy, 4));
    if let Some(note) = &run.l1_note {
        add("no L1", note.clone());
    }
    add("drift of mass", number(run.conservation.mass, 2));
    add("drift of momentum", number(run.conservation.momentum, 2));
    add("drift of energy", number(run.conservation.energy, 2));
    add("particles out of order", record.penetration.to_string());
    add("pair interactions", record.pair_interactions.to_string());
    add("Riemann iterations", record.riemann_iterations.to_string());
    add("wall seconds", significant(run.wall_seconds, 3));
    table
}

fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let plan = Plan::new(arguments)?;
    // Few particles are refused before the directory is made.
    if plan.particles < 10 {
        return Err(invalid(InvalidMethodOptions::Particles(plan.particles)));
    }
    let output = OutputDirectory::open(&arguments.out)?;
    let start = Instant::now();
    let run = run_particles(&plan.scene, plan.particles, &plan.options).map_err(invalid)?;
    let record = record(&plan, &run, start.elapsed().as_secs_f64());
    let exact = exact_solution_holds(&plan.scene, plan.customary_end, run.time);
    let name = format!("{}_{}", plan.scene.name, plan.options.method.name());
    output.write(&format!("{name}.csv"), &profile_csv(&plan.scene, &run, exact))?;
    // A state that is not finite has no picture; the table of it is still there.
    let title = format!(
        "{}: {}, {}, h/Δ = {}, {} particles, t = {}",
        plan.scene.name,
        plan.options.method.name().to_uppercase(),
        plan.options.kernel.title(),
        plan.ratio,
        plan.particles,
        significant(run.time, 4)
    );
    let figure = profile_figure(&plan.scene, &run, exact).title(title);
    let pictures = figure.png().and_then(|png| Ok((png, figure.svg()?)));
    match pictures {
        Ok((png, svg)) => {
            output.write(&format!("{name}.png"), &png)?;
            output.write(&format!("{name}.svg"), svg.as_bytes())?;
        }
        Err(error) if run.completed() => return Err(error.into()),
        Err(_) => {}
    }
    print_record("run", &record, &table(&record), arguments.format)?;
    if arguments.format == Format::Table {
        let path = output.path().join(&name);
        return print(&format!("\nprofile and figure: {}.csv, .png, .svg\n", path.display()));
    }
    Ok(Outcome::Yes)
}
