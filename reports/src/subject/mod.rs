//! What is judged: one scheme with everything but the parameter that is sought.

mod error;
mod label;

use crate::record::SubjectRecord;
use courant_analysis::exact::laurent::Laurent;
use courant_analysis::exact::rational::{Rational, integer, parse, to_f64, to_text};
use courant_analysis::kernel::{Density, Kernel};
use courant_analysis::scheme::catalogue::SchemeFile;
use courant_analysis::scheme::{Integrator, KernelLattice, Lines, SchemeError, Step};
use courant_analysis::stability::SearchPlan;
pub use error::{SubjectError, brief};
pub use label::{Label, row_name, shown, varying};
use num_traits::Signed;
use std::str::FromStr;
use std::sync::Arc;

/// What the equations are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Typed.
    Equation,
    /// A scheme of the catalogue, or of a file.
    Scheme,
    /// Equations in space that an integrator completes.
    Space,
    /// A particle method.
    Method,
}

impl Kind {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Equation => "equation",
            Self::Scheme => "scheme",
            Self::Space => "space",
            Self::Method => "method",
        }
    }
}

/// The parameter of particle methods that an equation of state sets, `P/(ρ c²)`.
pub const PRESSURE: &str = "P";

/// What linear theory sees of an equation of state: the pressure of the undisturbed gas.
#[derive(Debug, Clone, PartialEq)]
pub struct EquationOfState {
    /// As it was written.
    pub name: String,
    /// `P/(ρ c²)`.
    pub pressure: Rational,
}

impl FromStr for EquationOfState {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let accepted =
            "accepted: isothermal, ideal:GAMMA such as ideal:7/5, tait:P0 with P0 in units of ρ c²";
        let (kind, number) = match text.split_once(':') {
            Some((kind, number)) => {
                let read = parse(number).map_err(|error| format!("{error}; {accepted}"))?;
                (kind, Some(read))
            }
            None => (text, None),
        };
        let pressure = match (kind.to_ascii_lowercase().as_str(), number) {
            ("isothermal", None) => integer(1),
            ("ideal", Some(gamma)) if gamma.is_positive() => gamma.recip(),
            ("ideal", Some(_)) => return Err(format!("GAMMA must be above 0; {accepted}")),
            ("tait", Some(pressure)) => pressure,
            _ => return Err(accepted.into()),
        };
        Ok(Self { name: text.to_ascii_lowercase(), pressure })
    }
}

/// One scheme.
#[derive(Debug, Clone)]
pub struct Subject {
    /// What its equations are.
    pub kind: Kind,
    /// The equations.
    pub file: Arc<SchemeFile>,
    /// What completes them.
    pub integrator: Option<Arc<Integrator>>,
    /// Of a particle method.
    pub eos: Option<EquationOfState>,
    /// Of a particle method.
    pub density: Option<Density>,
    /// The kernel of its sums and `l/Δξ = h/Δ`.
    pub kernel: Option<(Kernel, Rational)>,
    /// The parameters that were given values; the pressure by the equation of state.
    pub values: Vec<(String, Rational)>,
    /// The parameter in question, where somebody names it.
    pub parameter: Option<String>,
}

/// The step of a subject, ready for a question about one parameter.
#[derive(Debug, Clone)]
pub struct Sought {
    /// With values for all parameters but one.
    pub step: Step,
    /// That one.
    pub parameter: String,
    /// The value that was given for it.
    pub value: Option<Rational>,
}

impl Subject {
    /// The lattice of its kernel.
    pub fn lattice(&self) -> Result<Option<KernelLattice>, SubjectError> {
        let Some((kernel, ratio)) = &self.kernel else { return Ok(None) };
        let lattice = KernelLattice::new(*kernel, ratio).map_err(SubjectError::Ratio)?;
        Ok(Some(match self.density {
            Some(density) => lattice.with_density(density),
            None => lattice,
        }))
    }

    /// Its step with all parameters open.
    pub fn open_step(&self) -> Result<Step, SubjectError> {
        let lattice = self.lattice()?;
        let equations = &self.file.equations;
        let step = match &self.integrator {
            Some(integrator) => Lines::from_tree(equations, lattice.as_ref())
                .and_then(|lines| Step::lines(&lines, integrator)),
            None => Step::from_tree(equations, lattice.as_ref()),
        };
        step.map_err(|error| self.failure(error))
    }

    /// Its equations in space, exact in time where no integrator completes them, with values and defaults for all parameters.
    pub fn lines(&self) -> Result<Lines, SubjectError> {
        let lattice = self.lattice()?;
        let failed = |error: SchemeError| self.failure(error);
        let mut lines = Lines::from_tree(&self.file.equations, lattice.as_ref()).map_err(failed)?;
        for (name, value) in &self.values {
            if self.file.parameters.contains_key(name) && lines.names().parameter(name).is_none() {
                continue;
            }
            lines = lines.with(name, value).map_err(|problem| SubjectError::Value {
                name: name.clone(),
                value: value.clone(),
                problem: Box::new(problem),
            })?;
        }
        for (name, default) in &self.file.parameters {
            if !self.is_set(name) && lines.names().parameter(name).is_some() {
                lines = lines.with(name, default).map_err(failed)?;
            }
        }
        Ok(lines)
    }

    /// Its step for a question about one parameter: named by the user, or by the file, or `C`, or the only one without a value.
    /// Where `may_be_set` the one that is sought may have a value.
    pub fn sought(&self, may_be_set: bool) -> Result<Sought, SubjectError> {
        let open = self.open_step()?;
        let known: Vec<String> = open.names().parameters().map(|(name, _)| name.into()).collect();
        let parameter = self.sought_parameter(&known, may_be_set)?;
        let given = self.values.iter().find(|(name, _)| *name == parameter);
        let value = given.map(|(_, value)| value.clone());
        let step = self.with_defaults(open, &[&parameter])?;
        let step = self.all_but(step, &[&parameter])?;
        Ok(Sought { step, parameter, value })
    }

    /// Its step with values for all parameters but two.
    ///
    /// # Errors
    /// When one of the two does not occur or has a value, or another has none.
    pub fn plane(&self, axes: [&str; 2]) -> Result<Step, SubjectError> {
        let open = self.open_step()?;
        for name in axes {
            if open.names().parameter(name).is_none() {
                let known = open.names().parameters().map(|(name, _)| name.into()).collect();
                return Err(SubjectError::UnknownParameter { name: name.into(), known });
            }
            if self.is_set(name) {
                return Err(SubjectError::AxisIsSet(name.into()));
            }
        }
        self.all_but(self.with_defaults(open, &axes)?, &axes)
    }

    /// A step in which all parameters but these have values.
    fn all_but(&self, step: Step, but: &[&str]) -> Result<Step, SubjectError> {
        let mut open = step.free_parameters();
        open.retain(|name| !but.contains(&name.as_str()));
        if open.is_empty() { Ok(step) } else { Err(SubjectError::NotSet(open)) }
    }

    /// Its step with the values that were given, and nothing else.
    pub fn with_values(&self) -> Result<Step, SubjectError> {
        self.set(self.open_step()?, &[])
    }

    /// Its step with values and defaults for all parameters but these.
    pub fn opened(&self, but: &[&str]) -> Result<Step, SubjectError> {
        self.with_defaults(self.open_step()?, but)
    }

    /// Its step with values and defaults for all parameters.
    pub fn complete_step(&self) -> Result<Step, SubjectError> {
        self.all_but(self.opened(&[])?, &[])
    }

    fn with_defaults(&self, step: Step, but: &[&str]) -> Result<Step, SubjectError> {
        let mut step = self.set(step, but)?;
        for (name, default) in &self.file.parameters {
            let taken = but.contains(&name.as_str()) || self.is_set(name);
            if !taken && step.names().parameter(name).is_some() {
                step = step.with(name, default).map_err(|error| self.failure(error))?;
            }
        }
        Ok(step)
    }

    fn set(&self, mut step: Step, but: &[&str]) -> Result<Step, SubjectError> {
        let kept = |(name, _): &&(String, Rational)| !but.contains(&name.as_str());
        for (name, given) in self.values.iter().filter(kept) {
            // A name of the file that drops out of the equations of this lattice.
            let occurs = step.names().parameter(name).is_some();
            if !occurs && self.file.parameters.contains_key(name) {
                continue;
            }
            let (name, value) = (name.clone(), given.clone());
            step = match step.with(&name, given) {
                Ok(step) if step.denominators().iter().any(Laurent::is_zero) => {
                    return Err(SubjectError::Division { name, value });
                }
                Ok(step) => step,
                Err(problem) => {
                    let problem = Box::new(problem);
                    return Err(SubjectError::Value { name, value, problem });
                }
            };
        }
        Ok(step)
    }

    /// Whether somebody gave it a value.
    pub fn is_set(&self, name: &str) -> bool {
        self.values.iter().any(|(set, _)| set == name)
    }

    fn sought_parameter(&self, known: &[String], may_be_set: bool) -> Result<String, SubjectError> {
        let is_set = |name: &str| self.is_set(name);
        if let Some(name) = &self.parameter {
            if !known.contains(name) {
                let (name, known) = (name.clone(), known.to_vec());
                return Err(SubjectError::UnknownParameter { name, known });
            }
            return match is_set(name) && !may_be_set {
                true => Err(SubjectError::SoughtIsSet(name.clone())),
                false => Ok(name.clone()),
            };
        }
        let free = |name: &&String| known.contains(name) && (may_be_set || !is_set(name));
        let customary = "C".to_string();
        if let Some(name) = self.file.parameter.iter().chain([&customary]).find(free) {
            return Ok(name.clone());
        }
        let open: Vec<&String> = known.iter().filter(|name| !is_set(name)).collect();
        let has_default = |name: &str| self.file.parameters.contains_key(name);
        let needed: Vec<&String> = open.iter().copied().filter(|name| !has_default(name)).collect();
        let given: Vec<&String> = known.iter().filter(|name| is_set(name)).collect();
        match (needed.as_slice(), open.as_slice(), given.as_slice()) {
            ([one], _, _) | ([], [one], _) => Ok((*one).clone()),
            ([], [], [one]) if may_be_set => Ok((*one).clone()),
            ([], [], []) => {
                Err(SubjectError::NoParameter { kind: self.kind, name: self.file.name.clone() })
            }
            ([], [], [one]) => Err(SubjectError::OnlyOneIsSet((*one).clone())),
            ([], [], several) => Err(SubjectError::Ambiguous(owned(several))),
            ([], open, _) => Err(SubjectError::SeveralOpen(owned(open))),
            (needed, ..) => Err(SubjectError::SeveralOpen(owned(needed))),
        }
    }

    /// How far to look when nobody says: several times any limit.
    pub fn range(&self, asked: Option<&Rational>) -> Rational {
        match (asked, self.kind, &self.kernel) {
            (Some(max), ..) => max.clone(),
            (None, Kind::Method, _) => integer(10),
            (None, _, Some((_, ratio))) => integer(10) + ratio * integer(4),
            (None, _, None) => SearchPlan::default().max,
        }
    }

    /// A problem with the equations, or with the integrator that completes them.
    pub fn failure(&self, problem: SchemeError) -> SubjectError {
        let problem = Box::new(problem);
        match (&*problem, &self.integrator) {
            (SchemeError::Integrator(_), Some(integrator)) => {
                SubjectError::Integrator { name: integrator.name.clone(), problem }
            }
            _ => SubjectError::Equations { kind: self.kind, name: self.file.name.clone(), problem },
        }
    }

    /// Its names for JSON.
    pub fn record(&self, step: &Step, parameter: Option<&str>) -> SubjectRecord {
        let method = self.kind == Kind::Method;
        let value = |name: &str| {
            let set = step.set_parameters().iter().find(|(known, _)| known == name);
            set.map(|(_, value)| value)
        };
        SubjectRecord {
            scheme: self.file.name.clone(),
            method: method.then(|| self.file.name.clone()),
            // Left and right by position: the only relation of a scheme that runs.
            form: (method && self.file.name == "gph").then_some("resolved"),
            space: (self.integrator.is_some() && !method).then(|| self.file.name.clone()),
            integrator: self.integrator.as_ref().map(|integrator| integrator.name.clone()),
            alpha: value("alpha").map(to_f64),
            kernel: self.kernel.as_ref().map(|(kernel, _)| kernel.name()),
            ratio: self.kernel.as_ref().map(|(_, ratio)| to_text(ratio)),
            eos: self.eos.as_ref().map(|eos| eos.name.clone()),
            density: self.density.map(density_name),
            lattice: method.then_some("line"),
            dimension: step.dimension(),
            parameter: parameter.map(String::from),
            parameters: step
                .set_parameters()
                .iter()
                .map(|(name, value)| (name.clone(), to_text(value)))
                .collect(),
        }
    }

    /// Why nobody asks whether its coefficients are positive, where it has no monotone limit.
    pub fn without_monotonicity(&self) -> &'static str {
        match self.kind {
            Kind::Method => "monotonicity is a property of advection schemes",
            _ => {
                "whether all coefficients are positive is asked of explicit schemes between two time levels for one unknown"
            }
        }
    }

    /// What the parameter in question is called before people.
    pub fn symbol(&self, parameter: &str) -> String {
        if self.kind == Kind::Method && parameter == "C" {
            "c Δt/h".into()
        } else {
            parameter.into()
        }
    }

    /// The exponent of one exact step, where it is known: as the file states it, or as sound does.
    pub fn exact_step(&self) -> Option<String> {
        match (&self.file.exact, self.kind, &self.kernel) {
            (Some(text), ..) => Some(text.clone()),
            // c = 1, and C counts h.
            (None, Kind::Method, Some((_, ratio))) => {
                Some(format!("±I*C*({})*phi", to_text(ratio)))
            }
            _ => None,
        }
    }

    /// What names it, the scheme first.
    pub fn labels(&self) -> Vec<Label> {
        let label = |heading: &str, cell: &str, caption: String| Label {
            heading: heading.into(),
            cell: cell.into(),
            caption,
        };
        let method = self.kind == Kind::Method;
        let heading = self.kind.name();
        let mut labels = vec![label(heading, &self.file.name, self.file.title.clone())];
        if let Some(integrator) = &self.integrator {
            labels.push(label("integrator", &integrator.name, integrator.title.clone()));
        }
        if let Some((kernel, ratio)) = &self.kernel {
            let heading = if method { "h/Δ" } else { "l/Δξ" };
            let text = shown(ratio);
            labels.push(label("kernel", kernel.name(), kernel.title().into()));
            labels.push(label(heading, &text, format!("{heading} = {text}")));
        }
        if let Some(eos) = &self.eos {
            labels.push(label("eos", &eos.name, eos.name.clone()));
        }
        if let Some(density) = self.density {
            let text = format!("density by {}", density_name(density));
            labels.push(label("density", density_name(density), text));
        }
        // The pressure is the equation of state's, which has its column.
        let pressure = |name: &str| self.eos.is_some() && name == PRESSURE;
        for (name, value) in self.values.iter().filter(|(name, _)| !pressure(name)) {
            let symbol = if name == "alpha" { "α" } else { name.as_str() };
            labels.push(label(symbol, &shown(value), format!("{symbol} = {}", shown(value))));
        }
        labels
    }

    /// The limit of `c Δt/h` as `c Δt/Δ` and as `c Δt/σ`, with the standard deviation σ of the kernel.
    pub fn other_units(&self, limit: f64) -> Option<(f64, f64)> {
        let (kernel, ratio) = self.kernel.as_ref().filter(|_| self.kind == Kind::Method)?;
        Some((limit * to_f64(ratio), limit / kernel.standard_deviation()))
    }
}

/// The name of a density on the command line.
pub fn density_name(density: Density) -> &'static str {
    match density {
        Density::Summation => "summation",
        Density::MassPerSpacing => "continuity",
    }
}

fn owned(names: &[&String]) -> Vec<String> {
    names.iter().map(|name| (*name).clone()).collect()
}
