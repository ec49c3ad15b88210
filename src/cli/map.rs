//! `courant map`.

mod plane;
mod waves;

use super::numbers::{self, Numbers};
use super::output::print;
use super::progress::Bar;
use super::subject::{Defaults, Kind, Subject, SubjectOptions, setting};
use super::{Failure, Outcome, dispersion};
use clap::Args;
use courant::analysis::exact::rational::ratio;
use courant::analysis::kernel::Kernel;
use courant::reports::figure::Figure;
use courant::reports::plane_map::PlaneAxis;
use courant::reports::publish::{OutputDirectory, Prepared};
use courant::reports::stability_map::{MapPlan, stability_map};
use courant::simulation::advection::AdvectionScheme;
use rayon::prelude::*;
use std::path::PathBuf;

/// Points of one map at most.
const MAX_POINTS: usize = 4_000_000;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    /// A parameter of any scheme to the right, with its values: r=0:1:0.01. With --y.
    #[arg(long, value_name = "NAME=RANGE", allow_hyphen_values = true, value_parser = setting, requires = "y")]
    x: Option<(String, Numbers)>,
    /// A parameter upwards, along which stability is decided: C=0:2:0.01.
    #[arg(long, value_name = "NAME=RANGE", allow_hyphen_values = true, value_parser = setting, requires = "x")]
    y: Option<(String, Numbers)>,
    /// Courant numbers of euler-sph, lax-wendroff-sph, godunov-sph over --ratio, ascending (default: 0:12:0.05).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative_list, conflicts_with = "method")]
    cfl: Option<Numbers>,
    /// Wave numbers κΔ in radians per spacing, ascending, for a particle method over --ratio or --alpha.
    #[arg(long, allow_hyphen_values = true, value_parser = dispersion::kappa_list, conflicts_with = "scheme")]
    kappa: Option<Numbers>,
    /// The smoothing ratios of a particle method as an axis, where --ratio is not.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list, conflicts_with = "scheme", hide = true)]
    h: Option<Numbers>,
    /// Directory for the files.
    #[arg(long, default_value = "courant-out")]
    out: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if let (Some(x), Some(y)) = (&arguments.x, &arguments.y) {
        let axis = |(name, values): &(String, Numbers)| PlaneAxis {
            name: name.clone(),
            values: values.0.clone(),
        };
        return plane::run(arguments, &axis(x), &axis(y));
    }
    // One of the planes that are known by their options.
    let one = Defaults { ratios: vec![ratio(6, 5)], ..Defaults::default() };
    let integrators = Some("leapfrog-kdk".to_string());
    let named = Defaults { integrators, ..one };
    let subjects = arguments.subject.without_axes().subjects(&named)?;
    for subject in &subjects {
        match (subject.kind, subject.file.name.parse::<AdvectionScheme>()) {
            (Kind::Method, _) => waves::run(arguments, subject)?,
            (_, Ok(scheme)) => run_scheme(arguments, subject, scheme)?,
            _ => {
                return Err(Failure::Message(format!(
                    "--x and --y are required for {}: two of its parameters, such as --x r=0:1:0.01 --y C=0:2:0.01",
                    subject.file.name
                )));
            }
        };
    }
    Ok(Outcome::Yes)
}

fn run_scheme(
    arguments: &Arguments,
    subject: &Subject,
    scheme: AdvectionScheme,
) -> Result<Outcome, Failure> {
    let axis = |given: Option<&Numbers>, otherwise: &str| match given {
        Some(axis) => axis.clone(),
        None => numbers::list(otherwise).expect("the default axis is well-formed"),
    };
    let ratios = axis(arguments.subject.axes().0, "1:10:0.05");
    let courant_numbers = axis(arguments.cfl.as_ref(), "0:12:0.05");
    for (option, axis) in [("--ratio", &ratios), ("--cfl", &courant_numbers)] {
        numbers::axis(axis).map_err(|problem| Failure::Message(format!("{option}: {problem}")))?;
    }
    let points = ratios.0.len() * courant_numbers.0.len();
    if points > MAX_POINTS {
        let problem =
            format!("the map would have {points} points; at most {MAX_POINTS} are accepted");
        return Err(Failure::Message(format!("--ratio and --cfl: {problem}")));
    }
    let output = OutputDirectory::open(&arguments.out)?;
    let kernel = subject.kernel.as_ref().map_or(Kernel::CubicSpline, |(kernel, _)| *kernel);
    let plan = MapPlan { scheme, kernel, ratios: ratios.0, courant_numbers: courant_numbers.0 };
    let bar = Bar::new("map");
    let map = stability_map(plan, &|done, all| bar.advance(done, all))
        .map_err(|error| Failure::Message(error.to_string()))?;
    bar.finish();
    let stem = format!("map_{}_{}", scheme.name(), kernel.name());
    write(&output, &stem, || Ok(map.figure()?), || map.data_files(&stem))
}

/// Makes picture and data at the same time, writes them as they are ready, and says where when all are.
fn write(
    output: &OutputDirectory,
    stem: &str,
    figure: impl FnOnce() -> Result<Figure, Failure> + Send,
    data: impl FnOnce() -> Vec<(String, Vec<u8>)> + Send,
) -> Result<Outcome, Failure> {
    let file = |name: &str, bytes: &[u8]| output.prepare(name, bytes).map_err(Failure::from);
    let pictures = || {
        let svg = figure()?.svg()?;
        Ok([
            file(&format!("{stem}.png"), &svg.png()?)?,
            file(&format!("{stem}.svg"), svg.0.as_bytes())?,
        ])
    };
    let data = || data().par_iter().map(|(name, bytes)| file(name, bytes)).collect();
    let (pictures, data): (Result<_, Failure>, Result<Vec<Prepared>, Failure>) =
        rayon::join(pictures, data);
    let prepared: Vec<Prepared> = pictures?.into_iter().chain(data?).collect();
    // Side by side: to put away the megabytes of a file that was there takes as long as to name all others.
    let places: Vec<_> = prepared.into_par_iter().map(Prepared::publish).collect();
    let mut text = String::new();
    for place in places {
        text.push_str(&format!("{}\n", place?.display()));
    }
    print(&text)
}
