//! `courant map --method`: the planes of sound waves in particle methods.

use super::{Arguments, MAX_POINTS};
use crate::cli::numbers::{self, Numbers};
use crate::cli::progress::Bar;
use crate::cli::subject::Subject;
use crate::cli::waves::{self, MethodName, Relation};
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{Rational, integer, ratio, to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::Integrator;
use courant::reports::publish::OutputDirectory;
use courant::reports::step_map::step_map;
use courant::reports::wave_map::{amplitude_map, phase_error_map};

/// What is mapped over what.
enum Plane<'a> {
    PhaseError { kappas: &'a Numbers, ratios: &'a Numbers },
    Amplitude { kappas: &'a Numbers, alphas: &'a Numbers },
    StableStep { integrator: &'static Integrator, ratios: &'a Numbers, alphas: &'a Numbers },
}

fn refuse(message: impl Into<String>) -> Failure {
    Failure::Message(message.into())
}

/// The plane that the axes given ask for.
fn plane<'a>(arguments: &'a Arguments, subject: &Subject) -> Result<Plane<'a>, Failure> {
    let (ratios, alphas) = axes_of(arguments);
    let kappas = arguments.kappa.as_ref();
    let is_range = |numbers: Option<&Numbers>| numbers.is_some_and(|list| list.0.len() > 1);
    if arguments.subject.has_integrator() {
        let integrator = subject.integrator.as_ref().map_or("", |one| one.name.as_str());
        let known = waves::integrator(integrator)
            .map_err(|problem| refuse(format!("--integrator {integrator}: {problem}")))?;
        return match (kappas, ratios, alphas) {
            (None, Some(ratios), Some(alphas)) => {
                Ok(Plane::StableStep { integrator: known, ratios, alphas })
            }
            _ => Err(refuse(format!(
                "--integrator {integrator}: the map of stable steps needs --ratio and --alpha ranges and no --kappa"
            ))),
        };
    }
    match (kappas, ratios, alphas) {
        (Some(kappas), _, Some(alphas)) if is_range(Some(alphas)) && !is_range(ratios) => {
            Ok(Plane::Amplitude { kappas, alphas })
        }
        (Some(kappas), Some(ratios), _) => Ok(Plane::PhaseError { kappas, ratios }),
        _ => Err(refuse(
            "--method: a map needs two axes: --kappa and --ratio (phase error), --kappa and --alpha (amplitude), \
             or --integrator with --ratio and --alpha (stable steps)",
        )),
    }
}

/// Ratios and coefficients of viscosity.
fn axes_of(arguments: &Arguments) -> (Option<&Numbers>, Option<&Numbers>) {
    let (ratios, alphas) = arguments.subject.axes();
    (arguments.h.as_ref().or(ratios), alphas)
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

pub fn run(arguments: &Arguments, subject: &Subject) -> Result<Outcome, Failure> {
    let plane = plane(arguments, subject)?;
    let name = &subject.file.name;
    let name = MethodName::ALL.into_iter().find(|known| known.name() == name).ok_or_else(|| {
        refuse(format!("--method {name}: only sph, sph-av and gph have maps of their waves"))
    })?;
    let only_viscous = |what: &str| match name {
        MethodName::SphAv => name.method(None, None),
        _ => Err(refuse(format!(
            "--alpha: {} has no viscosity coefficient; a map of {what} over it needs --method sph-av",
            name.name()
        ))),
    };
    let density = subject.density.unwrap_or_default();
    let lattice =
        |relation: Relation, ratio: &Rational| relation.lattice(kernel_of(subject), ratio, density);
    if let (Some(_), Some(_), false) =
        (&arguments.h, arguments.subject.axes().0, matches!(plane, Plane::Amplitude { .. }))
    {
        return Err(refuse("--ratio: the smoothing ratio is the axis --h of this map"));
    }
    let bar = Bar::new("map");
    let progress = |done: usize, all: usize| bar.advance(done, all);
    let stopped = |error| refuse(format!("{error}"));
    let floats = |numbers: &Numbers| -> Vec<f64> { numbers.0.iter().map(to_f64).collect() };
    let kernel = kernel_of(subject);
    let stem = |what: &str| format!("map_{what}_{}_{}", name.name(), kernel.name());
    let (stem, figure, data) = match plane {
        Plane::PhaseError { kappas, ratios } => {
            axes(("--kappa", kappas), ("--ratio", ratios))?;
            let alpha = match axes_of(arguments).1.map(|alphas| alphas.0.as_slice()) {
                None => None,
                Some([alpha]) => Some(alpha),
                Some(_) => {
                    return Err(refuse(
                        "--alpha: a map over --kappa and --ratio takes one value of it",
                    ));
                }
            };
            let method = name.method(None, alpha)?;
            let mut stem = stem("phase_error");
            if let Some(form) = method.form {
                stem = format!("{stem}_{}", form.name());
            }
            let title = format!("{}, {}", method.title(), kernel.title());
            let first = &ratios.0[0];
            let map =
                phase_error_map(&lattice(method, first)?, &floats(kappas), &ratios.0, &progress)
                    .map_err(stopped)?;
            (stem.clone(), map.figure(&title)?, map.data_files(&stem))
        }
        Plane::Amplitude { kappas, alphas } => {
            axes(("--kappa", kappas), ("--alpha", alphas))?;
            let method = only_viscous("the amplitude")?;
            let at = match arguments.subject.axes().0.map(|ratios| ratios.0.as_slice()) {
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
                amplitude_map(&lattice(method, &at)?, &floats(kappas), &floats(alphas), &progress)
                    .map_err(stopped)?;
            (stem.clone(), map.figure(&title)?, map.data_files(&stem))
        }
        Plane::StableStep { integrator, ratios, alphas } => {
            axes(("--ratio", ratios), ("--alpha", alphas))?;
            let method = only_viscous("the stable step")?;
            let stem = format!("{}_{}", stem("stable_step"), integrator.name);
            let title = format!("SPH with viscosity, {}, {}", kernel.title(), integrator.title);
            let first = &ratios.0[0];
            let lattice = lattice(method, first)?;
            let map = step_map(&lattice, integrator, &ratios.0, &floats(alphas), &progress)
                .map_err(stopped)?;
            (stem.clone(), map.figure(&title)?, map.data_files(&stem))
        }
    };
    bar.finish();
    let output = OutputDirectory::open(&arguments.out)?;
    super::write(&output, &stem, || Ok(figure), || data)
}

fn kernel_of(subject: &Subject) -> Kernel {
    subject.kernel.as_ref().map_or(Kernel::CubicSpline, |(kernel, _)| *kernel)
}
