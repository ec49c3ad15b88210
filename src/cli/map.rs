//! `courant map`.

mod waves;

use super::numbers::{self, Numbers};
use super::output::print;
use super::progress::Bar;
use super::waves::{DensityName, MethodName};
use super::{Failure, Outcome, dispersion, names};
use clap::Args;
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::AdvectionScheme;
use courant::analysis::scheme::integrator::Integrator;
use courant::analysis::waves::dispersion::Form;
use courant::reports::figure::Figure;
use courant::reports::publish::OutputDirectory;
use courant::reports::stability_map::{MapPlan, stability_map};
use std::path::PathBuf;

/// Points of one map at most.
const MAX_POINTS: usize = 4_000_000;

#[derive(Debug, Args)]
#[command(group(clap::ArgGroup::new("subject").args(["scheme", "method"]).required(true)))]
pub struct Arguments {
    /// Scheme: euler-sph, lax-wendroff-sph, godunov-sph.
    #[arg(long, value_parser = names::scheme)]
    scheme: Option<AdvectionScheme>,
    /// Or a particle method: its sound waves over --kappa and --h or --alpha, or its stable steps over
    /// --h and --alpha with --integrator.
    #[arg(long, value_enum)]
    method: Option<MethodName>,
    /// Kernel: see `courant list kernels`.
    #[arg(long, value_parser = names::kernel, default_value = "cubic-spline")]
    kernel: Kernel,
    /// Smoothing ratios l/Δξ of a scheme, ascending (default: 1:10:0.05); the one ratio h/Δ of the
    /// (κ, α) map (default: 1.2).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list)]
    ratio: Option<Numbers>,
    /// Courant numbers of a scheme, ascending (default: 0:12:0.05).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative_list, conflicts_with = "method")]
    cfl: Option<Numbers>,
    /// Wave numbers κΔ in radians per spacing, ascending.
    #[arg(long, allow_hyphen_values = true, value_parser = dispersion::kappa_list, conflicts_with = "scheme")]
    kappa: Option<Numbers>,
    /// Smoothing ratios h/Δ, ascending.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list, conflicts_with = "scheme")]
    h: Option<Numbers>,
    /// Coefficients of viscosity, ascending; over --kappa and --h the one of sph-av (default: 1).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative_list, conflicts_with = "scheme")]
    alpha: Option<Numbers>,
    /// Relation of gph (default: resolved).
    #[arg(long, value_parser = super::waves::form, conflicts_with = "scheme")]
    form: Option<Form>,
    /// Time integrator: see `courant list integrators`.
    #[arg(long, value_parser = super::waves::integrator, conflicts_with = "scheme")]
    integrator: Option<Integrator>,
    /// Density ρ0 of the undisturbed lattice.
    #[arg(long, value_enum, default_value = "summation", conflicts_with = "scheme")]
    density: DensityName,
    /// Directory for the files.
    #[arg(long, default_value = "courant-out")]
    out: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match (arguments.scheme, arguments.method) {
        (_, Some(method)) => waves::run(arguments, method),
        (Some(scheme), None) => run_scheme(arguments, scheme),
        (None, None) => Err(Failure::Message("--scheme or --method is required".into())),
    }
}

fn run_scheme(arguments: &Arguments, scheme: AdvectionScheme) -> Result<Outcome, Failure> {
    let axis = |given: &Option<Numbers>, otherwise: &str| match given {
        Some(axis) => axis.clone(),
        None => numbers::list(otherwise).expect("the default axis is well-formed"),
    };
    let ratios = axis(&arguments.ratio, "1:10:0.05");
    let courant_numbers = axis(&arguments.cfl, "0:12:0.05");
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
    let plan = MapPlan {
        scheme,
        kernel: arguments.kernel,
        ratios: ratios.0,
        courant_numbers: courant_numbers.0,
    };
    let bar = Bar::new("map");
    let map = stability_map(plan, &|done, all| bar.advance(done, all))
        .map_err(|error| Failure::Message(error.to_string()))?;
    bar.finish();
    let stem = format!("map_{}_{}", scheme.name(), arguments.kernel.name());
    write(&output, &stem, &map.figure()?, map.data_files(&stem))
}

/// Writes picture and data, and says where.
fn write(
    output: &OutputDirectory,
    stem: &str,
    figure: &Figure,
    data: Vec<(String, Vec<u8>)>,
) -> Result<Outcome, Failure> {
    let mut files = vec![
        (format!("{stem}.png"), figure.png()?),
        (format!("{stem}.svg"), figure.svg()?.into_bytes()),
    ];
    files.extend(data);
    let mut text = String::new();
    for (name, bytes) in files {
        text.push_str(&format!("{}\n", output.write(&name, &bytes)?.display()));
    }
    print(&text)
}
