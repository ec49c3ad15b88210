//! Spheres of gas under their own gravity: Cha & Whitworth 2003, section 5.8, and what tests gravity.

use super::{Arguments, Entry, Family, no_method};
use crate::cli::output::{Format, print, print_record};
use crate::cli::progress::Bar;
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{to_f64, to_text};
use courant::reports::cloud_profile::{cloud_csv, cloud_figure, core_csv};
use courant::reports::number::{exact_text, finite, significant};
use courant::reports::publish::OutputDirectory;
use courant::reports::run_record::{BROKEN, ConservationRecord, ErrorNorms, RunRecord};
use courant::reports::table::{Align, Table};
use courant::simulation::gravity::{Cloud, CloudRun, cloud_options, run_cloud};
use courant::simulation::particles::{MethodOptions, ParticleMethod, StepSharing};
use courant::simulation::run::InvalidOptions;
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Instant;

pub const FAMILY: Family = Family { scenes, methods: Vec::new, run };

fn scenes() -> Vec<Entry> {
    let entry = |cloud: &'static Cloud| Entry {
        name: &cloud.name,
        description: &cloud.description,
        source: &cloud.source,
    };
    Cloud::all().iter().map(entry).collect()
}

fn options(arguments: &Arguments, cloud: &Cloud) -> Result<MethodOptions, Failure> {
    let all = ParticleMethod::ALL.map(ParticleMethod::name);
    let Some(name) = &arguments.method else {
        let (scene, all) = (&arguments.scene, all.join(", "));
        return Err(Failure::Message(format!("--method is required for {scene}; accepted: {all}")));
    };
    let method = (ParticleMethod::ALL.into_iter().find(|method| method.name() == name))
        .ok_or_else(|| no_method(name, &arguments.scene, &all))?;
    let mut options = cloud_options(cloud, MethodOptions::new(method));
    if let Some(kernel) = arguments.kernel {
        options.kernel = kernel;
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
    let customary = options.integrator;
    options.integrator = choices.integrator(customary);
    if options.integrator != customary {
        // Blocks have one integrator.
        options.sharing = StepSharing::Global;
    }
    options.solver = choices.solver(options.solver);
    options.viscosity.alpha = choices.alpha(options.viscosity.alpha);
    options.viscosity.beta = choices.beta(options.viscosity.beta);
    options.check().map_err(invalid)?;
    Ok(options)
}

/// The option's name as it is on the command line.
fn invalid(error: InvalidOptions) -> Failure {
    Failure::Message(match error {
        InvalidOptions::Kernel(kernel) => {
            format!(
                "--kernel {kernel}: gph4 has a closed form for the gaussian only; accepted: gaussian"
            )
        }
        InvalidOptions::Particles { particles: count, .. } => {
            format!("--particles {count}: a sphere needs at least 100")
        }
        InvalidOptions::NotPositive { name, value } => {
            format!("--{name} {value}: it must be above 0 and finite")
        }
        other => other.to_string(),
    })
}

#[derive(Debug, Serialize)]
struct CloudRecord {
    #[serde(flatten)]
    run: RunRecord,
    /// What the scene is judged by.
    measures: BTreeMap<&'static str, f64>,
    kernel: &'static str,
    ratio: String,
    cfl: f64,
    integrator: &'static str,
    pair_interactions: u64,
    riemann_iterations: u64,
    /// Cells and particles summed over for gravity.
    attractions: u64,
}

const NO_NORMS: &str = "the measures compare the run with what is known of it";
const NO_ENERGY: &str = "an isothermal gas has no energy equation";

fn record(
    cloud: &Cloud,
    options: &MethodOptions,
    ratio: String,
    particles: usize,
    run: &CloudRun,
    seconds: f64,
) -> CloudRecord {
    let measures = run.measures(cloud);
    let energy = measures.get("energy").copied();
    let completed = run.failure.is_none();
    let mut warnings = Vec::new();
    if let Some(drift) = energy.filter(|drift| *drift > 0.05) {
        let drift = significant(100.0 * drift, 2);
        warnings.push(format!(
            "the total energy has changed by {drift} %: a smaller --cfl keeps it better"
        ));
    }
    CloudRecord {
        run: RunRecord {
            scene: cloud.name.clone(),
            method: options.method.name().into(),
            particles,
            steps: run.steps as usize,
            rejected_steps: run.rejected,
            time: run.time,
            completed,
            failure: run.failure.map(|failure| failure.to_string()),
            warnings,
            l1: ErrorNorms::default(),
            l1_note: Some(if completed { NO_NORMS } else { BROKEN }.into()),
            conservation: ConservationRecord {
                // The masses are counted, with what the sink holds.
                mass: Some(0.0),
                momentum: finite(run.momentum),
                energy,
            },
            conservation_note: energy.is_none().then(|| NO_ENERGY.into()),
            wall_seconds: seconds,
        },
        measures,
        kernel: options.kernel.name(),
        ratio,
        cfl: options.courant,
        integrator: &options.integrator.name,
        pair_interactions: run.counters.interactions,
        riemann_iterations: run.counters.riemann_iterations,
        attractions: run.attractions,
    }
}

fn table(record: &CloudRecord) -> Table {
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
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    add("time", significant(run.time, 6));
    add("steps", run.steps.to_string());
    for (name, value) in &record.measures {
        add(&name.replace('_', " "), significant(*value, 4));
    }
    add("momentum", run.conservation.momentum.map_or_else(|| "–".into(), |p| significant(p, 2)));
    add("pair interactions", record.pair_interactions.to_string());
    add("attractions", record.attractions.to_string());
    add("Riemann iterations", record.riemann_iterations.to_string());
    add("wall seconds", significant(run.wall_seconds, 3));
    table
}

fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut cloud = Cloud::named(&arguments.scene).expect("the family answers for its own scenes");
    if let Some(time) = &arguments.time {
        cloud.end_time = to_f64(time);
    }
    let options = options(arguments, &cloud)?;
    let particles = arguments.particles.unwrap_or(cloud.particles);
    // Few particles are refused before the directory is made.
    if particles < 100 {
        return Err(invalid(InvalidOptions::Particles { particles, least: 100 }));
    }
    let output = OutputDirectory::open(&arguments.out)?;
    let bar = Bar::new(&cloud.name);
    let start = Instant::now();
    let end = cloud.end_time;
    let run = run_cloud(&cloud, particles, &options, &[], &mut |time| bar.march(time, end))
        .map_err(invalid)?;
    bar.finish();
    let ratio = arguments.ratio.as_ref().map_or_else(|| exact_text(options.eta), to_text);
    let seconds = start.elapsed().as_secs_f64();
    let record = record(&cloud, &options, ratio, particles, &run, seconds);
    let name = format!("{}_{}", cloud.name, options.method.name());
    let last = run.snapshots.last().expect("the end is always kept");
    output.write(&format!("{name}.csv"), &cloud_csv(&cloud, last))?;
    if !run.core.is_empty() {
        output.write(&format!("{name}_core.csv"), &core_csv(&run))?;
    }
    let title = format!(
        "{}: {}, {particles} particles, t = {}",
        cloud.name,
        options.method.name().to_uppercase(),
        significant(run.time, 4)
    );
    if let Some(figure) = cloud_figure(&cloud, &run).map(|figure| figure.title(title)) {
        match figure.png().and_then(|png| Ok((png, figure.svg()?))) {
            Ok((png, svg)) => {
                output.write(&format!("{name}.png"), &png)?;
                output.write(&format!("{name}.svg"), svg.as_bytes())?;
            }
            Err(error) if run.failure.is_none() => return Err(error.into()),
            // A state that is not finite has no picture; the table of it is still there.
            Err(_) => {}
        }
    }
    print_record("run", &record, &table(&record), arguments.format)?;
    if arguments.format == Format::Table {
        print(&crate::cli::output::warnings(&record.run.warnings))?;
        let path = output.path().join(&name);
        print(&format!("\nprofile and figure: {}.csv, .png, .svg\n", path.display()))?;
    }
    Ok(if run.failure.is_none() { Outcome::Yes } else { Outcome::No })
}
