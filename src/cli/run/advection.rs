//! Scenes and methods of the advection family.

use super::answer::{Answer, Record, method_title};
use super::choices::one;
use super::{Arguments, Entry, Family, Start, no_method};
use crate::cli::numbers::{Names, Numbers};
use crate::cli::progress::Bar;
use crate::cli::{Failure, complain, numbers};
use clap::{Args, ValueEnum};
use courant::analysis::exact::rational::{Rational, from_f64, integer, to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::reports::advection_profile::{AdvectionRecord, profile_csv, profile_figure};
use courant::reports::number::significant;
use courant::reports::table::{Align, Table};
use courant::simulation::advection::AdvectionScheme;
use courant::simulation::advection::{
    AdvectionRun, Discretisation, Layout, Method, PlanError, RunPlan, Scene, run_with,
};
use std::time::Instant;

pub const FAMILY: Family = Family { scenes, methods, plan };

/// Waves of `advection-waves` when `--waves` is not given.
const WAVES: usize = 8;

/// Options of the advection scenes alone.
#[derive(Debug, Clone, Args)]
pub struct Options {
    /// Advection: end time in periods of the unit interval, the same as --time (default: 1).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = numbers::running_positive, conflicts_with = "time")]
    pub periods: Option<Numbers>,
    /// Advection: where the particles are and which code steps them (default: uniform).
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub layout: Vec<LayoutName>,
    /// Advection, disordered layout: the largest displacement in spacings, below 1/2 (default: 1/10).
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, value_parser = disorders)]
    pub disorder: Option<Numbers>,
    /// Advection: seed of the displacements and of the random phases (default: 0).
    #[arg(long, value_name = "LIST", value_parser = |text: &str| numbers::names(text, numbers::seed))]
    pub seed: Option<Names<u64>>,
    /// Advection, scene advection-waves: the highest wave number, at most half the particles (default: 8).
    #[arg(long, value_name = "LIST", value_parser = wave_numbers)]
    pub waves: Option<Names<usize>>,
}

/// Layouts by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LayoutName {
    /// Equal spacing, stepped by the stencil.
    Lattice,
    /// Equal spacing, neighbours found among the particles.
    Uniform,
    /// Random displacements, neighbours found among the particles.
    Disordered,
}

impl Options {
    /// The first option given, as an error for a scene that is not advection.
    pub fn reject(&self, scene: &str) -> Result<(), Failure> {
        let given = [
            ("--periods", self.periods.is_some()),
            ("--layout", !self.layout.is_empty()),
            ("--disorder", self.disorder.is_some()),
            ("--seed", self.seed.is_some()),
            ("--waves", self.waves.is_some()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Failure::Message(format!(
                "{option}: scene {scene} has no such option; it belongs to the advection scenes"
            ))),
            None => Ok(()),
        }
    }
}

fn disorders(text: &str) -> Result<Numbers, String> {
    let below_half = |value: &Rational| to_f64(value) < 0.5;
    let numbers = numbers::running_non_negative(text)?;
    let fits = numbers.0.iter().all(below_half);
    if fits { Ok(numbers) } else { Err("it must be at least 0 and below 1/2".into()) }
}

fn wave_numbers(text: &str) -> Result<Names<usize>, String> {
    numbers::counts(text, 1, 100_000)
}

fn scenes() -> Vec<Entry> {
    let entry = |name, description, source| Entry { name, description, source };
    vec![
        entry(
            "advection-step",
            "1 up to the middle of the period, 1/4 beyond",
            "Ferrari et al. 2008 (2.28)",
        ),
        entry(
            "advection-gaussian",
            "a smooth hump of height 1 on 1/4",
            "Ferrari et al. 2008 (2.29)",
        ),
        entry("advection-square", "1 on the middle half of the period, 0 elsewhere", "standard"),
        entry("advection-waves", "waves 1 to --waves with random phases (--seed)", "standard"),
    ]
}

fn methods() -> Vec<Entry> {
    AdvectionScheme::ALL
        .into_iter()
        .map(|scheme| Entry {
            name: scheme.name(),
            description: "advection scenes: the scheme stepped over particles",
            source: &scheme.file().source,
        })
        .collect()
}

/// Whether a scene is one of advection.
pub fn has_scene(name: &str) -> bool {
    scenes().iter().any(|scene| scene.name == name)
}

fn plan(arguments: Arguments) -> Result<Start, Failure> {
    let (plan, ratio) = plan_and_ratio(&arguments)?;
    let used = plan.check().map_err(|error| invalid(&error, &arguments))?;
    Ok(Box::new(move || {
        // Said before it starts: the user may stop it.
        let beyond = beyond_limit(&plan, &ratio, used);
        if let Some(warning) = &beyond {
            complain(&format!("warning: {warning}\n"));
        }
        let bar = Bar::new(plan.scene.name());
        let start = Instant::now();
        let result = run_with(&plan, |time| bar.march(time, plan.periods))
            .map_err(|error| Failure::Message(error.to_string()))?;
        let wall_seconds = start.elapsed().as_secs_f64();
        bar.finish();
        let mut record = AdvectionRecord::new(&plan, &ratio, &result, wall_seconds);
        record.run.warnings.extend(beyond);
        let json = serde_json::to_string_pretty(&record)
            .map_err(|error| Failure::Message(error.to_string()))?;
        let files = vec![
            (".csv".into(), profile_csv(&result).into_bytes()),
            (".json".into(), format!("{json}\n").into_bytes()),
        ];
        // Where values overflowed there is no profile to draw.
        let figure = record.run.completed.then(|| profile_figure(&plan, &ratio, &result));
        let table = table(&record, &result);
        Answer::new(Record::Advection(record), table, files, figure)
    }))
}

/// A plan that cannot be run, by its options.
fn invalid(error: &PlanError, arguments: &Arguments) -> Failure {
    let options = match (error, arguments.time(), one(&arguments.advection.periods)) {
        (PlanError::Steps(_), Some(time), _) => format!("--time {}: ", to_text(time)),
        (PlanError::Steps(_), _, Some(periods)) => format!("--periods {}: ", to_text(periods)),
        _ => String::new(),
    };
    Failure::Message(format!("{options}{error}"))
}

/// What to say where the Courant number is beyond the proved limit of the scheme on the uniform lattice.
fn beyond_limit(plan: &RunPlan, ratio: &Rational, used: f64) -> Option<String> {
    let Method { scheme, kernel, .. } = plan.method;
    let scheme = Discretisation::new(scheme, kernel, ratio.clone()).ok()?;
    let set = scheme.stable_set();
    // Equal steps to the end have a Courant number that was rounded.
    let rounding = from_f64(1.0 - 1e-12)?;
    let used = from_f64(used)?;
    if set.contains(&used) || set.contains(&(&used * rounding)) {
        return None;
    }
    let limit = set.limit();
    let limit = match limit.exact() {
        _ if !limit.is_positive() => "no step, however small".to_string(),
        Some(exact) if exact.to_string().len() <= 12 => format!("steps up to C = {exact}"),
        _ => format!("steps up to C = {}", significant(limit.value(), 6)),
    };
    Some(format!(
        "C = {} is beyond the stability limit of {}: {limit}, by proof, with {} at l/Δξ = {}; waves grow",
        significant(to_f64(&used), 6),
        plan.method.scheme.name(),
        kernel.name(),
        to_text(ratio)
    ))
}

/// The arguments as a plan, and the ratio as it was written.
fn plan_and_ratio(arguments: &Arguments) -> Result<(RunPlan, Rational), Failure> {
    let options = &arguments.advection;
    let scene_name = arguments.scene();
    let scheme = match arguments.method() {
        Some(name) => name.parse().map_err(|_| {
            no_method(name, scene_name, &AdvectionScheme::ALL.map(AdvectionScheme::name))
        })?,
        None => AdvectionScheme::GodunovSph,
    };
    arguments.choices.only(&[], "an advection scheme")?;
    let not_used = |option: &str, value: String, reason: &str| {
        Err(Failure::Message(format!("{option} {value}: {reason}")))
    };
    let (waves, seed) = (one(&options.waves).copied(), one(&options.seed).copied());
    if scene_name != "advection-waves"
        && let Some(waves) = waves
    {
        let reason = "only the scene advection-waves has waves to count";
        return not_used("--waves", waves.to_string(), reason);
    }
    let layout = options.layout.first().copied().unwrap_or(LayoutName::Uniform);
    if layout != LayoutName::Disordered {
        if let Some(disorder) = one(&options.disorder) {
            let reason = "it needs --layout disordered";
            return not_used("--disorder", disorder.to_string(), reason);
        }
        if let (Some(seed), true) = (seed, scene_name != "advection-waves") {
            let reason = "nothing is random here; it needs --layout disordered or advection-waves";
            return not_used("--seed", seed.to_string(), reason);
        }
    }
    let seed = seed.unwrap_or(0);
    let layout = match layout {
        LayoutName::Lattice => Layout::Lattice,
        LayoutName::Uniform => Layout::Uniform,
        LayoutName::Disordered => {
            Layout::Disordered { disorder: one(&options.disorder).map_or(0.1, to_f64), seed }
        }
    };
    let particles = arguments.particles().unwrap_or(200);
    // Two particles per wave: a shorter one looks like a longer one on them.
    let shortest = particles / 2;
    if let Some(waves) = waves.filter(|waves| *waves > shortest) {
        let reason = format!("{particles} particles carry waves up to number {shortest}");
        return not_used("--waves", waves.to_string(), &reason);
    }
    let scene = match scene_name.parse() {
        Ok(scene) => scene,
        Err(_) => Scene::random_phases(waves.unwrap_or(WAVES.min(shortest)), seed),
    };
    // Euler-SPH is stable at no Courant number; with small steps a period can still be looked at.
    let default_courant = match scheme {
        AdvectionScheme::EulerSph => 0.1,
        AdvectionScheme::LaxWendroffSph | AdvectionScheme::GodunovSph => 1.0,
    };
    let ratio = arguments.ratio().cloned().unwrap_or_else(|| integer(2));
    let method = Method {
        scheme,
        kernel: arguments.kernel().unwrap_or(Kernel::CubicSpline),
        ratio: to_f64(&ratio),
        courant_number: arguments.cfl().map_or(default_courant, to_f64),
    };
    let periods = one(&options.periods).or(arguments.time()).map_or(1.0, to_f64);
    Ok((RunPlan { scene, method, particles, periods, layout }, ratio))
}

fn table(record: &AdvectionRecord, result: &AdvectionRun) -> Table {
    let mut table = Table::new(
        format!("{}, {}", record.run.scene, method_title(&record.run.method)),
        &[("", Align::Left), ("", Align::Right)],
    );
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    let seen = &result.comparison;
    match &record.run.failure {
        None => add("completed", "yes".into()),
        Some(failure) => add("failed", failure.clone()),
    }
    add("kernel", record.kernel.clone());
    add("l/Δξ", record.ratio.clone());
    add("C", significant(record.cfl, 8));
    add("particles", record.run.particles.to_string());
    add("steps", record.run.steps.to_string());
    add("periods", significant(record.run.time, 6));
    if record.run.completed {
        add("L1 error", significant(seen.l1, 6));
        add("L2 error", significant(seen.l2, 6));
        add("L∞ error", significant(seen.l_infinity, 6));
        add("total variation", significant(seen.total_variation, 8));
        add("exact total variation", significant(seen.exact_total_variation, 8));
        add("smallest value", significant(seen.extrema.min, 8));
        add("largest value", significant(seen.extrema.max, 8));
        add("drift of the mean", significant(seen.mean_drift, 3));
    }
    add("interactions", record.interactions.to_string());
    add("seconds", significant(record.run.wall_seconds, 3));
    table
}
