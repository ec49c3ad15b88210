//! Flows in two and three dimensions on particles.

use super::particle_options::{self, eos, invalid};
use super::{Arguments, Entry, Family};
use crate::cli::output::{Format, print, print_record, warnings};
use crate::cli::progress::Bar;
use crate::cli::{Failure, Outcome, names, numbers};
use clap::{Args, ValueEnum};
use courant::analysis::exact::rational::to_f64;
use courant::reports::field_profile::{field_figure, history_csv, profile_csv};
use courant::reports::number::{finite, significant};
use courant::reports::publish::OutputDirectory;
use courant::reports::run_record::{BROKEN, ConservationRecord, ErrorNorms, RunRecord};
use courant::reports::table::{Align, Table};
use courant::simulation::field::{FieldRun, FieldScene, run_field};
use courant::simulation::lattice::Lattice;
use courant::simulation::particles::{ActsOn, MethodOptions};
use courant::simulation::run::InvalidOptions;
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Instant;

pub const FAMILY: Family = Family { scenes, methods: Vec::new, run };

/// Options of the scenes in two and three dimensions alone.
#[derive(Debug, Args)]
pub struct Options {
    /// Two and three dimensions: how the particles stand at the start: square, hexagonal, cubic, bcc, fcc, hcp (default: the scene's own).
    #[arg(long)]
    lattice: Option<String>,
    /// Two and three dimensions, sph1 and sph2: what tells shear from compression in the viscosity (default: none).
    #[arg(long, value_enum)]
    switch: Option<SwitchName>,
    /// Two and three dimensions: steps in blocks, halved at most N times (default: one step for everybody), by leapfrog-kdk.
    #[arg(long, value_name = "N", value_parser = levels)]
    levels: Option<usize>,
}

/// Switches by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SwitchName {
    /// Viscosity between all approaching particles.
    None,
    /// Balsara's factor.
    Balsara,
}

fn levels(text: &str) -> Result<usize, String> {
    numbers::count(text, 0, 20)
}

impl Options {
    /// The first option given, as an error for a scene on a line.
    pub fn reject(&self, scene: &str) -> Result<(), Failure> {
        let given = [
            ("--lattice", self.lattice.is_some()),
            ("--switch", self.switch.is_some()),
            ("--levels", self.levels.is_some()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Failure::Message(format!(
                "{option}: scene {scene} has no such option; it belongs to shear, gresho and sedov"
            ))),
            None => Ok(()),
        }
    }
}

/// Whether a scene is one of these.
pub fn has_scene(name: &str) -> bool {
    FieldScene::all().iter().any(|scene| scene.name == name)
}

fn scenes() -> Vec<Entry> {
    let entry = |scene: &'static FieldScene| Entry {
        name: &scene.name,
        description: &scene.description,
        source: &scene.source,
    };
    FieldScene::all().iter().map(entry).collect()
}

struct Plan {
    scene: FieldScene,
    particles: usize,
    options: MethodOptions,
    ratio: String,
}

impl Plan {
    fn new(arguments: &Arguments) -> Result<Self, Failure> {
        let method = particle_options::method(arguments)?;
        let mut scene =
            FieldScene::named(&arguments.scene).expect("the family answers for its own scenes");
        if let Some(time) = &arguments.time {
            scene.end_time = to_f64(time);
        }
        if let Some(name) = &arguments.fields.lattice {
            let fitting = Lattice::ALL.into_iter().filter(|l| l.dimension() == scene.dimension);
            let known: Vec<&str> = fitting.clone().map(Lattice::name).collect();
            scene.lattice =
                fitting.clone().find(|lattice| lattice.name() == name).ok_or_else(|| {
                    let problem =
                        names::unknown(&format!("lattice for {}", scene.name), name, &known);
                    Failure::Message(format!("--lattice {name}: {problem}"))
                })?;
        }
        let mut options = scene.options(method);
        particle_options::choose(arguments, &mut options)?;
        if arguments.fields.switch == Some(SwitchName::Balsara) {
            if method.is_godunov() {
                return Err(Failure::Message(format!(
                    "--switch balsara: {} has no artificial viscosity; it belongs to sph1 and sph2",
                    method.name()
                )));
            }
            options.viscosity.acts_on = ActsOn::Compressing;
        }
        if let Some(levels) = arguments.fields.levels {
            let blocks = options.in_blocks(levels as u32);
            // One that was asked for is checked.
            let integrator = arguments.choices.integrator(blocks.integrator);
            options = MethodOptions { integrator, ..blocks };
        }
        let particles = arguments.particles.unwrap_or(scene.particles);
        if particles < 100 {
            let error = InvalidOptions::Particles { particles, least: 100 };
            return Err(invalid(&error, arguments, method.name()));
        }
        options.check().map_err(|error| invalid(&error, arguments, method.name()))?;
        let ratio = particle_options::ratio(arguments, options.eta);
        Ok(Self { scene, particles, options, ratio })
    }
}

/// The record with what only these runs have.
#[derive(Debug, Serialize)]
struct FieldRecord {
    #[serde(flatten)]
    run: RunRecord,
    measures: BTreeMap<&'static str, Option<f64>>,
    dimension: usize,
    eos: String,
    lattice: &'static str,
    kernel: &'static str,
    ratio: String,
    cfl: f64,
    integrator: &'static str,
    pair_interactions: u64,
    densities: u64,
    searches: u64,
    riemann_iterations: u64,
}

fn record(plan: &Plan, run: &FieldRun, seconds: f64) -> FieldRecord {
    let errors = run.errors.filter(|_| run.completed());
    let isothermal = run.conservation.energy.is_none();
    let conservation = ConservationRecord {
        mass: finite(run.conservation.mass),
        momentum: finite(run.conservation.momentum),
        energy: run.conservation.energy.and_then(finite),
    };
    let norms = ErrorNorms {
        value: None,
        density: errors.and_then(|e| finite(e.density)),
        velocity: errors.and_then(|e| finite(e.velocity)),
        pressure: errors.and_then(|e| finite(e.pressure)),
        energy: None,
    };
    let no_energy = "an isothermal gas has no energy equation";
    FieldRecord {
        run: RunRecord {
            scene: plan.scene.name.clone(),
            method: plan.options.method.name().into(),
            particles: run.profile.len(),
            steps: run.steps as usize,
            rejected_steps: run.rejected,
            time: run.time,
            completed: run.completed(),
            failure: run.failure.map(|failure| failure.to_string()),
            warnings: run.warnings.clone(),
            l1: norms,
            l1_note: Some(match (run.completed(), isothermal) {
                (false, _) => BROKEN.into(),
                (true, true) => no_energy.into(),
                (true, false) => "the energy follows from pressure and density".into(),
            }),
            conservation_note: match isothermal {
                _ if conservation.is_complete() => None,
                true => Some(no_energy.into()),
                false => Some(BROKEN.into()),
            },
            conservation,
            wall_seconds: seconds,
        },
        measures: run.measures.iter().map(|(name, value)| (*name, finite(*value))).collect(),
        dimension: plan.scene.dimension,
        eos: eos(plan.scene.gas),
        lattice: plan.scene.lattice.name(),
        kernel: plan.options.kernel.name(),
        ratio: plan.ratio.clone(),
        cfl: plan.options.courant,
        integrator: &plan.options.integrator.name,
        pair_interactions: run.counters.interactions,
        densities: run.counters.densities,
        searches: run.counters.searches,
        riemann_iterations: run.counters.riemann_iterations,
    }
}

fn table(record: &FieldRecord) -> Table {
    let run = &record.run;
    let outcome = match &run.failure {
        None => "completed".into(),
        Some(failure) => format!("broke down: {failure}"),
    };
    let caption = format!(
        "{} with {}, {} dimensions, {}, {} particles on a {} lattice, {} at {} spacings: {outcome}",
        run.scene,
        run.method,
        if record.dimension == 2 { "two" } else { "three" },
        record.eos,
        run.particles,
        record.lattice,
        record.kernel,
        record.ratio
    );
    let mut table = Table::new(caption, &[("quantity", Align::Left), ("value", Align::Right)]);
    let number = |value: Option<f64>, digits| {
        value.map_or_else(|| "–".to_string(), |value| significant(value, digits))
    };
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    add("time", significant(run.time, 6));
    add("steps", run.steps.to_string());
    for (name, value) in &record.measures {
        add(&name.replace('_', " "), number(*value, 4));
    }
    add("L1 density", number(run.l1.density, 4));
    add("L1 velocity", number(run.l1.velocity, 4));
    add("L1 pressure", number(run.l1.pressure, 4));
    add("drift of momentum", number(run.conservation.momentum, 2));
    add("drift of energy", number(run.conservation.energy, 2));
    add("pair interactions", record.pair_interactions.to_string());
    add("wall seconds", significant(run.wall_seconds, 3));
    table
}

fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let plan = Plan::new(arguments)?;
    let output = OutputDirectory::open(&arguments.out)?;
    let start = Instant::now();
    let bar = Bar::new(&plan.scene.name);
    let mut observe = |time| bar.march(time, plan.scene.end_time);
    let run = run_field(&plan.scene, plan.particles, &plan.options, &mut observe)
        .map_err(|error| invalid(&error, arguments, plan.options.method.name()))?;
    bar.finish();
    let record = record(&plan, &run, start.elapsed().as_secs_f64());
    let name = format!("{}_{}", plan.scene.name, plan.options.method.name());
    output.write(&format!("{name}.csv"), &profile_csv(&run.profile))?;
    output.write(&format!("{name}_measures.csv"), &history_csv(&run))?;
    let title = format!(
        "{}: {}, {}, h/Δ = {}, {} particles, t = {}",
        plan.scene.name,
        plan.options.method.name().to_uppercase(),
        plan.options.kernel.title(),
        plan.ratio,
        run.profile.len(),
        significant(run.time, 4)
    );
    let figure = field_figure(&plan.scene, &run).title(title);
    match figure.png().and_then(|png| Ok((png, figure.svg()?))) {
        Ok((png, svg)) => {
            output.write(&format!("{name}.png"), &png)?;
            output.write(&format!("{name}.svg"), svg.as_bytes())?;
        }
        Err(error) if run.completed() => return Err(error.into()),
        Err(_) => {}
    }
    let outcome = if run.completed() { Outcome::Yes } else { Outcome::No };
    print_record("run", &record, &table(&record), arguments.format)?;
    if arguments.format == Format::Table {
        print(&warnings(&record.run.warnings))?;
        let path = output.path().join(&name);
        print(&format!(
            "\nparticles, measures and figure: {}.csv, _measures.csv, .png, .svg\n",
            path.display()
        ))?;
    }
    Ok(outcome)
}
