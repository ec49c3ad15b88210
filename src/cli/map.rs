//! `courant map`.

use super::numbers::{self, Numbers};
use super::output::print;
use super::progress::Bar;
use super::{Failure, Outcome, names};
use clap::Args;
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::AdvectionScheme;
use courant::reports::publish::OutputDirectory;
use courant::reports::stability_map::{MapPlan, stability_map};
use std::path::PathBuf;

/// Points of one map at most.
const MAX_POINTS: usize = 4_000_000;

#[derive(Debug, Args)]
pub struct Arguments {
    /// Scheme: euler-sph, lax-wendroff-sph, godunov-sph.
    #[arg(long, value_parser = names::scheme)]
    scheme: AdvectionScheme,
    /// Kernel: see `courant list kernels`.
    #[arg(long, value_parser = names::kernel, default_value = "cubic-spline")]
    kernel: Kernel,
    /// Smoothing ratios l/Δξ, ascending.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list, default_value = "1:10:0.05")]
    ratio: Numbers,
    /// Courant numbers, ascending.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative_list, default_value = "0:12:0.05")]
    cfl: Numbers,
    /// Directory for the files.
    #[arg(long, default_value = "courant-out")]
    out: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    for (option, axis) in [("--ratio", &arguments.ratio), ("--cfl", &arguments.cfl)] {
        numbers::axis(axis).map_err(|problem| Failure::Message(format!("{option}: {problem}")))?;
    }
    let points = arguments.ratio.0.len() * arguments.cfl.0.len();
    if points > MAX_POINTS {
        let problem =
            format!("the map would have {points} points; at most {MAX_POINTS} are accepted");
        return Err(Failure::Message(format!("--ratio and --cfl: {problem}")));
    }
    let output = OutputDirectory::open(&arguments.out)?;
    let plan = MapPlan {
        scheme: arguments.scheme,
        kernel: arguments.kernel,
        ratios: arguments.ratio.0.clone(),
        courant_numbers: arguments.cfl.0.clone(),
    };
    let bar = Bar::new("map");
    let map = stability_map(plan, &|done, all| bar.advance(done, all))
        .map_err(|error| Failure::Message(error.to_string()))?;
    bar.finish();
    let figure = map.figure()?;
    let stem = format!("map_{}_{}", arguments.scheme.name(), arguments.kernel.name());
    let mut files = vec![
        (format!("{stem}.png"), figure.png()?),
        (format!("{stem}.svg"), figure.svg()?.into_bytes()),
    ];
    files.extend(map.data_files(&stem));
    let mut text = String::new();
    for (name, bytes) in files {
        text.push_str(&format!("{}\n", output.write(&name, &bytes)?.display()));
    }
    print(&text)
}
