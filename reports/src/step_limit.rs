//! What is said before a run whose step is beyond the proved limit of its scheme.
//!
//! The limits are those of linear theory: small waves in a uniform gas at rest, on equal particles in one dimension.

use crate::number::significant;
use crate::subject::{EquationOfState, Kind, Subject};
use courant_analysis::exact::rational::{Rational, decimal_below, from_f64, integer, to_text};
use courant_analysis::kernel::{Density, Kernel};
use courant_analysis::scheme::Step;
use courant_analysis::scheme::catalogue::{self, SchemeFile};
use courant_analysis::stability::{Evidence, Limit, PointVerdict, SearchPlan, decide_step_at};
use courant_simulation::advection::RunPlan;
use courant_simulation::method::Method;
use courant_simulation::particles::{MethodOptions, ParticleMethod, Viscosity};
use courant_simulation::scene::Material;
use num_traits::Zero;
use std::sync::Arc;

/// Equal steps to an end have a Courant number that was rounded.
const ROUNDING: f64 = 1.0 - 1e-12;

/// A value, and what is a little below it.
fn with_rounding(value: f64) -> impl Iterator<Item = Rational> {
    [value, value * ROUNDING].into_iter().filter_map(from_f64)
}

/// Which steps are stable, in words, and how that is known.
fn stable_steps(limit: &Limit, name: &str) -> String {
    let known = match limit.evidence() {
        Evidence::Proved => "by proof",
        Evidence::Enclosed => "by enclosures",
        Evidence::Sampled { .. } | Evidence::Measured => "by samples",
        Evidence::Undecided => return "how far steps are stable is not decided".to_string(),
    };
    match limit.exact() {
        _ if !limit.is_positive() => format!("no step, however small, {known}"),
        Some(exact) if exact.to_string().len() <= 12 => {
            format!("steps up to {name} = {exact}, {known}")
        }
        _ => format!("steps up to {name} = {}, {known}", cut(limit.lower(), 6)),
    }
}

/// Digits of a positive number, cut so that it is not beyond the number itself.
fn cut(value: f64, digits: usize) -> String {
    from_f64(value).map_or_else(|| value.to_string(), |value| decimal_below(&value, digits))
}

/// Whether a step is proved to be unstable at the value and a little below it.
fn is_unstable(step: &Step, parameter: &str, used: f64) -> Option<bool> {
    for value in with_rounding(used) {
        let step = step.with(parameter, &value).ok()?;
        if !matches!(decide_step_at(&step, &Rational::zero()).ok()?, PointVerdict::Unstable(_)) {
            return Some(false);
        }
    }
    Some(true)
}

/// Of an advection scheme on the uniform lattice; `None` where no wave is proved to grow.
pub fn advection(plan: &RunPlan) -> Option<String> {
    let (used, of) = (plan.check().ok()?, &plan.discretisation);
    is_unstable(of.step(), "C", used)?.then(|| {
        format!(
            "C = {} is beyond the stability limit of {}: {}, with {} at l/Δξ = {}; waves grow",
            significant(used, 6),
            of.scheme().name(),
            stable_steps(&of.stable_set().limit(), "C"),
            of.kernel().name(),
            to_text(of.ratio())
        )
    })
}

/// Of a method for gases; `None` where no wave is proved to grow, or where nothing is proved of the method.
///
/// ```
/// use courant_reports::step_limit;
/// use courant_simulation::method::Method;
/// use courant_simulation::scene::Scene;
/// let gas = Scene::named("sod").unwrap().material;
/// let Some(Method::FiniteVolume(mut options)) = Method::named("finite-volume") else { panic!() };
/// assert_eq!(step_limit::gas(gas, &Method::FiniteVolume(options), None), None);
/// options.cfl = 1.1;
/// let warning = step_limit::gas(gas, &Method::FiniteVolume(options), None).unwrap();
/// assert!(warning.contains("steps up to C = 1, by proof"), "{warning}");
/// ```
pub fn gas(material: Material, method: &Method, ratio: Option<&Rational>) -> Option<String> {
    let smoothing = |kernel, used| Some((kernel, ratio.cloned().or_else(|| short(used))?));
    match method {
        Method::FiniteVolume(options) => {
            let upwind = catalogue::scheme("upwind")?;
            let question = Question::new(Kind::Scheme, upwind, options.cfl);
            question.warning(method.name(), "C", 1.0, "")
        }
        Method::Lagrangian(options) => {
            let sound = catalogue::scheme("lagrangian-sound")?;
            let mut question = Question::new(Kind::Scheme, sound, options.cfl);
            question.subject.kernel = smoothing(options.kernel, options.ratio);
            question.warning(method.name(), "C", 1.0, "")
        }
        Method::Particles(options) => {
            particles(material, options, smoothing(options.kernel, options.eta)?)
        }
    }
}

/// Crossing times are those of signals from both sides: `c Δt/h` is half of what an option says.
const SIDES: f64 = 2.0;

fn particles(
    material: Material,
    options: &MethodOptions,
    smoothing: (Kernel, Rational),
) -> Option<String> {
    let Viscosity { alpha, .. } = options.viscosity;
    let name = match options.method {
        _ if options.estimation.is_some() => return None,
        ParticleMethod::Gph1 | ParticleMethod::Gph2 | ParticleMethod::Gph3 => "gph",
        ParticleMethod::Sph1 | ParticleMethod::Sph2 if alpha > 0.0 => "sph-av",
        ParticleMethod::Sph1 | ParticleMethod::Sph2 => "sph",
        // Its relation has no closed form.
        ParticleMethod::Gph4 | ParticleMethod::Adke => return None,
    };
    let mut question =
        Question::new(Kind::Method, catalogue::method(name)?, options.courant / SIDES);
    let subject = &mut question.subject;
    subject.integrator = Some(Arc::new(options.integrator.clone()));
    let (eos, pressure) = match material {
        Material::Isothermal(_) => ("isothermal".to_string(), integer(1)),
        Material::Ideal(gas) => {
            let gamma = short(gas.gamma())?;
            (format!("γ = {}", significant(gas.gamma(), 4)), gamma.recip())
        }
    };
    subject.eos = Some(EquationOfState { name: eos.clone(), pressure: pressure.clone() });
    subject.values.push(("P".into(), pressure));
    subject.density = Some(Density::Summation);
    subject.kernel = Some(smoothing);
    let viscosity = match name {
        "sph-av" => {
            subject.values.push(("alpha".into(), short(alpha)?));
            format!(", with α = {alpha} between all pairs")
        }
        _ => String::new(),
    };
    let method = format!("{} with {}", options.method.name(), options.integrator.name);
    let more = format!(", {eos}, constant h{viscosity}");
    question.warning(&method, "c Δt/h", SIDES, &more)
}

/// A decimal of few digits near a number: an option that was typed, or a ratio of specific heats.
fn short(value: f64) -> Option<Rational> {
    let typed = courant_analysis::exact::rational::parse(&format!("{value}")).ok();
    typed.filter(|typed| typed.denom().bits() < 40).or_else(|| from_f64(value))
}

/// Whether a step is stable for a subject.
struct Question {
    subject: Subject,
    used: f64,
}

impl Question {
    fn new(kind: Kind, file: &SchemeFile, used: f64) -> Self {
        let subject = Subject {
            kind,
            file: Arc::new(file.clone()),
            integrator: None,
            eos: None,
            density: None,
            kernel: None,
            values: Vec::new(),
            parameter: Some("C".into()),
        };
        Self { subject, used }
    }

    /// What to say where the step is proved to be unstable; `--cfl` counts so many of it.
    fn warning(&self, method: &str, name: &str, per_option: f64, more: &str) -> Option<String> {
        let sought = self.subject.sought(false).ok()?;
        if !is_unstable(&sought.step, &sought.parameter, self.used)? {
            return None;
        }
        let max = self.subject.range(None).max(from_f64(4.0 * self.used)?);
        let plan = SearchPlan::default().up_to(max);
        let limit = sought.step.stable_set(&sought.parameter, &plan).ok()?.limit();
        let lattice = self.subject.kernel.as_ref().map_or_else(String::new, |(kernel, ratio)| {
            format!(", {} at {}", kernel.name(), to_text(ratio))
        });
        let option = match limit.is_positive() && per_option != 1.0 {
            true => format!(" (--cfl {})", cut(per_option * limit.lower(), 4)),
            false => String::new(),
        };
        Some(format!(
            "{name} = {} is beyond the stability limit of {method}: {}{option}, for small waves in a uniform \
             gas at rest in one dimension{lattice}{more}; waves grow",
            significant(self.used, 6),
            stable_steps(&limit, name),
        ))
    }
}
