//! `courant map --method`: the planes of sound waves in particle methods.

use super::{Arguments, MAX_POINTS};
use crate::cli::numbers::{self, Numbers};
use crate::cli::progress::Bar;
use crate::cli::waves::MethodName;
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{Rational, integer, ratio, to_f64, to_text};
use courant::analysis::kernel::LatticeSums;
use courant::analysis::scheme::integrator::Integrator;
use courant::analysis::waves::dispersion::{WaveMethod, WaveScheme};
use courant::reports::publish::OutputDirectory;
use courant::reports::step_map::step_map;
use courant::reports::wave_map::{amplitude_map, phase_error_map};

/// What is mapped over what.
enum Plane<'a> {
    PhaseError { kappas: &'a Numbers, ratios: &'a Numbers },
    Amplitude { kappas: &'a Numbers, alphas: &'a Numbers },
    StableStep { integrator: Integrator, ratios: &'a Numbers, alphas: &'a Numbers },
}

fn refuse(message: impl Into<String>) -> Failure {
    Failure::Message(message.into())
}

/// The plane that the axes given ask for.
fn plane(arguments: &Arguments) -> Result<Plane<'_>, Failure> {
    let Arguments { kappa, h, alpha, integrator, .. } = arguments;
    match (kappa, h, alpha, *integrator) {
        (None, Some(ratios), Some(alphas), Some(integrator)) => {
            Ok(Plane::StableStep { integrator, ratios, alphas })
        }
        (_, _, _, Some(integrator)) => Err(refuse(format!(
            "--integrator {integrator}: the map of stable steps needs --h and --alpha ranges and no --kappa"
        ))),
        (Some(kappas), Some(ratios), _, None) => Ok(Plane::PhaseError { kappas, ratios }),
        (Some(kappas), None, Some(alphas), None) => Ok(Plane::Amplitude { kappas, alphas }),
        _ => Err(refuse(
            "--method: a map needs two axes: --kappa and --h (phase error), --kappa and --alpha (amplitude), \
             or --integrator with --h and --alpha (stable steps)",
        )),
    }
}

fn axes(first: (&str, &Numbers), second: (&str, &Numbers)) -> Result<(), Failure> {
    for (option, axis) in [first, second] {
        numbers::axis(axis).map_err(|problem| refuse(format!("{option}: {problem}")))?;
        if option == "--kappa" && axis.0[0] == integer(0) {
            return Err(refuse("--kappa: a map begins above 0, for example 0.02:3.14:0.02"));
        }
    }
    let points = first.1.0.len() * second.1.0.len();
    if points > MAX_POINTS {
        return Err(refuse(format!(
            "{} and {}: the map would have {points} points; at most {MAX_POINTS} are accepted",
            first.0, second.0
        )));
    }
    Ok(())
}

pub fn run(arguments: &Arguments, name: MethodName) -> Result<Outcome, Failure> {
    let plane = plane(arguments)?;
    let only_viscous = |what: &str| match name {
        MethodName::SphAv => Ok(WaveMethod::SphAv { alpha: integer(1) }),
        _ => Err(refuse(format!(
            "--alpha: {} has no viscosity coefficient; a map of {what} over it needs --method sph-av",
            name.name()
        ))),
    };
    let scheme = |method: WaveMethod, ratio: &Rational| {
        LatticeSums::new(arguments.kernel, ratio, arguments.density.into())
            .map(|sums| WaveScheme::with_sums(method, sums))
            .map_err(|error| refuse(format!("--ratio: {error}")))
    };
    if let (Some(_), Plane::PhaseError { .. } | Plane::StableStep { .. }) =
        (&arguments.ratio, &plane)
    {
        return Err(refuse("--ratio: the smoothing ratio is the axis --h of this map"));
    }
    if let (Some(form), Plane::Amplitude { .. } | Plane::StableStep { .. }) =
        (arguments.form, &plane)
    {
        return Err(refuse(format!(
            "--form {}: only a map over --kappa and --h of gph takes it",
            form.name()
        )));
    }
    let bar = Bar::new("map");
    let progress = |done: usize, all: usize| bar.advance(done, all);
    let stopped = |error| refuse(format!("{error}"));
    let floats = |numbers: &Numbers| -> Vec<f64> { numbers.0.iter().map(to_f64).collect() };
    let kernel = arguments.kernel;
    let stem = |what: &str| format!("map_{what}_{}_{}", name.name(), kernel.name());
    let (stem, figure, data) = match plane {
        Plane::PhaseError { kappas, ratios } => {
            axes(("--kappa", kappas), ("--h", ratios))?;
            let alpha = match arguments.alpha.as_ref().map(|alphas| alphas.0.as_slice()) {
                None => None,
                Some([alpha]) => Some(alpha),
                Some(_) => {
                    return Err(refuse(
                        "--alpha: a map over --kappa and --h takes one value of it",
                    ));
                }
            };
            let method = name.method(arguments.form, alpha)?;
            let mut stem = stem("phase_error");
            if let Some(form) = method.form() {
                stem = format!("{stem}_{}", form.name());
            }
            let title = format!("{}, {}", method.title(), kernel.title());
            let first = &ratios.0[0];
            let map =
                phase_error_map(&scheme(method, first)?, &floats(kappas), &ratios.0, &progress)
                    .map_err(stopped)?;
            (stem.clone(), map.figure(&title)?, map.data_files(&stem))
        }
        Plane::Amplitude { kappas, alphas } => {
            axes(("--kappa", kappas), ("--alpha", alphas))?;
            let method = only_viscous("the amplitude")?;
            let at = match arguments.ratio.as_ref().map(|ratios| ratios.0.as_slice()) {
                None => ratio(6, 5),
                Some([value]) => value.clone(),
                Some(_) => {
                    return Err(refuse(
                        "--ratio: a map over --kappa and --alpha takes one value of it",
                    ));
                }
            };
            let stem = stem("amplitude");
            let title = format!("SPH with viscosity, {}, h/Δ = {}", kernel.title(), to_text(&at));
            let map =
                amplitude_map(&scheme(method, &at)?, &floats(kappas), &floats(alphas), &progress)
                    .map_err(stopped)?;
            (stem.clone(), map.figure(&title)?, map.data_files(&stem))
        }
        Plane::StableStep { integrator, ratios, alphas } => {
            axes(("--h", ratios), ("--alpha", alphas))?;
            let method = only_viscous("the stable step")?;
            let stem = format!("{}_{}", stem("stable_step"), integrator.name());
            let title = format!("SPH with viscosity, {}, {}", kernel.title(), integrator.title());
            let first = &ratios.0[0];
            let scheme = scheme(method, first)?;
            let map = step_map(&scheme, integrator, &ratios.0, &floats(alphas), &progress)
                .map_err(stopped)?;
            (stem.clone(), map.figure(&title)?, map.data_files(&stem))
        }
    };
    bar.finish();
    let output = OutputDirectory::open(&arguments.out)?;
    super::write(&output, &stem, &figure, data)
}
