//! Spheres of gas under their own gravity: Cha & Whitworth 2003, section 5.8, and what tests gravity.

use super::answer::{Answer, Record, method_title};
use super::particle_options::{self, eos, invalid};
use super::{Arguments, Entry, Family, Start};
use crate::cli::Failure;
use crate::cli::progress::Bar;
use courant::analysis::exact::rational::to_f64;
use courant::reports::cloud_profile::{cloud_csv, cloud_figure, core_csv};
use courant::reports::number::{finite, significant};
use courant::reports::run_record::{BROKEN, ConservationRecord, ErrorNorms, RunRecord};
use courant::reports::table::{Align, Table};
use courant::simulation::gravity::{Cloud, CloudRun, cloud_options, run_cloud};
use courant::simulation::particles::{MethodOptions, StepSharing};
use courant::simulation::run::InvalidOptions;
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Instant;

pub const FAMILY: Family = Family { scenes, methods: Vec::new, plan };

fn scenes() -> Vec<Entry> {
    let entry = |cloud: &'static Cloud| Entry {
        name: &cloud.name,
        description: &cloud.description,
        source: &cloud.source,
    };
    Cloud::all().iter().map(entry).collect()
}

fn options(arguments: &Arguments, cloud: &Cloud) -> Result<MethodOptions, Failure> {
    let method = particle_options::method(arguments)?;
    let mut options = cloud_options(cloud, MethodOptions::new(method));
    let customary = options.integrator;
    particle_options::choose(arguments, &mut options)?;
    if options.integrator != customary {
        // Blocks have one integrator.
        options.sharing = StepSharing::Global;
    }
    options.check().map_err(|error| invalid(&error, arguments, method.name()))?;
    Ok(options)
}

#[derive(Debug, Serialize)]
pub struct CloudRecord {
    /// What every run has.
    #[serde(flatten)]
    pub run: RunRecord,
    /// What the scene is judged by.
    pub measures: BTreeMap<&'static str, f64>,
    dimension: usize,
    eos: String,
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
    let completed = run.failure.is_none();
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
            warnings: run.warnings.clone(),
            l1: ErrorNorms::default(),
            l1_note: Some(if completed { NO_NORMS } else { BROKEN }.into()),
            conservation: ConservationRecord {
                mass: finite(run.conservation.mass),
                momentum: finite(run.conservation.momentum),
                energy: run.conservation.energy.and_then(finite),
            },
            conservation_note: run.conservation.energy.is_none().then(|| NO_ENERGY.into()),
            wall_seconds: seconds,
        },
        measures,
        dimension: 3,
        eos: eos(cloud.material),
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
        "{} with {}, three dimensions, {}, {} particles, {} at {} spacings, step {} of the crossing time: {outcome}",
        run.scene,
        method_title(&run.method),
        record.eos,
        run.particles,
        record.kernel,
        record.ratio,
        record.cfl
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

fn plan(arguments: Arguments) -> Result<Start, Failure> {
    let mut cloud = Cloud::named(arguments.scene()).expect("the family answers for its own scenes");
    if let Some(time) = arguments.time() {
        cloud.end_time = to_f64(time);
    }
    let options = options(&arguments, &cloud)?;
    let particles = arguments.particles().unwrap_or(cloud.particles);
    if particles < 100 {
        let error = InvalidOptions::Particles { particles, least: 100 };
        return Err(invalid(&error, &arguments, options.method.name()));
    }
    Ok(Box::new(move || {
        let bar = Bar::new(&cloud.name);
        let start = Instant::now();
        let end = cloud.end_time;
        let run = run_cloud(&cloud, particles, &options, &[], &mut |time| bar.march(time, end))
            .map_err(|error| invalid(&error, &arguments, options.method.name()))?;
        bar.finish();
        let ratio = particle_options::ratio(&arguments, options.eta);
        let seconds = start.elapsed().as_secs_f64();
        let record = record(&cloud, &options, ratio, particles, &run, seconds);
        let last = run.snapshots.last().expect("the end is always kept");
        let mut files = vec![(".csv".into(), cloud_csv(&cloud, last))];
        if !run.core.is_empty() {
            files.push(("_core.csv".into(), core_csv(&run)));
        }
        let title = format!(
            "{}: {}, {particles} particles, t = {}",
            cloud.name,
            options.method.title(),
            significant(run.time, 4)
        );
        let figure = cloud_figure(&cloud, &run).map(|figure| figure.title(title));
        let table = table(&record);
        Answer::new(Record::Cloud(record), table, files, figure)
    }))
}
