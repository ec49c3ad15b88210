//! What is judged: an advection scheme, or a particle method with its integrator.

use super::waves::{self, MethodName};
use super::{Failure, names};
use clap::Args;
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::AdvectionScheme;
use courant::analysis::scheme::integrator::Integrator;
use courant::analysis::waves::dispersion::{Form, WaveMethod, WaveScheme};
use serde::Serialize;

/// The options that name it: `--scheme`, or `--method` and `--integrator`.
#[derive(Debug, Args)]
#[group(skip)]
#[command(group(clap::ArgGroup::new("subject").args(["scheme", "method"]).required(true)))]
pub struct SubjectOptions {
    /// Scheme: euler-sph, lax-wendroff-sph, godunov-sph; limits are on the Courant number.
    #[arg(long, value_parser = names::scheme)]
    scheme: Option<AdvectionScheme>,
    /// Or a particle method; limits are on c Δt/h. Needs --integrator.
    #[arg(long, value_enum, requires = "integrator")]
    method: Option<MethodName>,
    /// Time integrator of the particle method: see `courant list integrators`.
    #[arg(long, value_parser = waves::integrator, conflicts_with = "scheme")]
    integrator: Option<Integrator>,
    /// Coefficient of viscosity of sph-av (default: 1).
    #[arg(long, allow_hyphen_values = true, value_parser = waves::alpha, conflicts_with = "scheme")]
    alpha: Option<Rational>,
    /// Relation of gph; only the resolved one, the default, is a scheme that runs.
    #[arg(long, value_parser = waves::form, conflicts_with = "scheme")]
    form: Option<Form>,
}

/// What is judged.
#[derive(Debug, Clone)]
pub enum Subject {
    /// An advection scheme.
    Scheme(AdvectionScheme),
    /// A particle method.
    Stepped(SteppedMethod),
}

/// A particle method with its integrator.
#[derive(Debug, Clone)]
pub struct SteppedMethod {
    /// The method.
    pub method: WaveMethod,
    /// The integrator.
    pub integrator: Integrator,
}

impl SubjectOptions {
    /// What the options name.
    pub fn subject(&self) -> Result<Subject, Failure> {
        match (self.scheme, self.method, self.integrator) {
            (_, Some(method), Some(integrator)) => {
                let method = method.method(self.form, self.alpha.as_ref())?;
                Ok(Subject::Stepped(SteppedMethod { method, integrator }))
            }
            (Some(scheme), _, _) => Ok(Subject::Scheme(scheme)),
            _ => Err(Failure::Message("--scheme or --method with --integrator is required".into())),
        }
    }
}

/// What names a particle method in JSON.
#[derive(Debug, Serialize)]
pub struct SteppedRecord {
    method: &'static str,
    form: Option<&'static str>,
    integrator: &'static str,
    alpha: Option<f64>,
    kernel: &'static str,
    ratio: String,
}

impl SteppedMethod {
    /// The scheme at a kernel and ratio.
    pub fn scheme(&self, kernel: Kernel, ratio: &Rational) -> Result<WaveScheme, Failure> {
        WaveScheme::new(self.method.clone(), kernel, ratio)
            .map_err(|error| Failure::Message(format!("--ratio: {error}")))
    }

    /// The names for JSON.
    pub fn record(&self, kernel: Kernel, ratio: &Rational) -> SteppedRecord {
        SteppedRecord {
            method: self.method.name(),
            form: self.method.form().map(Form::name),
            integrator: self.integrator.name(),
            alpha: self.method.alpha().map(to_f64),
            kernel: kernel.name(),
            ratio: to_text(ratio),
        }
    }

    /// The name for captions.
    pub fn title(&self) -> String {
        format!("{}, {}", self.method.title(), self.integrator.title())
    }
}

/// Why a limit of time steps has no monotone one beside it.
pub const NO_MONOTONICITY: &str = "monotonicity is a property of advection schemes";

/// The steps `c Δt/h` searched by default: several times any limit of these integrators.
pub fn default_range() -> Rational {
    courant::analysis::exact::rational::integer(10)
}

/// A limit as JSON, in the words of time steps.
pub fn record(
    limit: &courant::analysis::stability::Limit,
) -> courant::reports::record::LimitRecord {
    courant::reports::record::LimitRecord::new(limit, "x", None)
}
