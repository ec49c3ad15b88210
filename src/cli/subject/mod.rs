//! What is judged: one scheme with everything but the parameter that is sought.

mod label;
mod options;

use super::{Failure, numbers};
use courant::analysis::exact::laurent::Laurent;
use courant::analysis::exact::rational::{Rational, integer, to_f64, to_text};
use courant::analysis::kernel::{Density, Kernel};
use courant::analysis::scheme::catalogue::SchemeFile;
use courant::analysis::scheme::{Integrator, KernelLattice, Lines, SchemeError, Step};
use courant::analysis::stability::SearchPlan;
use courant::reports::plane_map::PlaneAxis;
use courant::reports::record::SubjectRecord;
pub use label::{Label, row_name, shown, varying};
pub use options::{Defaults, SubjectOptions, setting};
use std::sync::Arc;

/// Which option named it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// `--equation`.
    Equation,
    /// `--scheme`.
    Scheme,
    /// `--space`.
    Space,
    /// `--method`.
    Method,
}

impl Kind {
    /// The option.
    pub fn option(self) -> &'static str {
        match self {
            Self::Equation => "--equation",
            Self::Scheme => "--scheme",
            Self::Space => "--space",
            Self::Method => "--method",
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

/// One scheme.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Which option named it.
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
    /// The parameter that `--parameter` names.
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
    pub fn lattice(&self) -> Result<Option<KernelLattice>, Failure> {
        let Some((kernel, ratio)) = &self.kernel else { return Ok(None) };
        let lattice = KernelLattice::new(*kernel, ratio)
            .map_err(|error| Failure::Message(format!("--ratio: {error}")))?;
        Ok(Some(match self.density {
            Some(density) => lattice.with_density(density),
            None => lattice,
        }))
    }

    /// Its step with all parameters open.
    pub fn open_step(&self) -> Result<Step, Failure> {
        let lattice = self.lattice()?;
        let equations = &self.file.equations;
        let step = match &self.integrator {
            Some(integrator) => Lines::from_tree(equations, lattice.as_ref())
                .and_then(|lines| Step::lines(&lines, integrator)),
            None => Step::from_tree(equations, lattice.as_ref()),
        };
        step.map_err(|error| self.failure(&error))
    }

    /// Its equations in space, exact in time where no integrator completes them, with values and defaults for all parameters.
    pub fn lines(&self) -> Result<Lines, Failure> {
        let lattice = self.lattice()?;
        let failed = |error: SchemeError| self.failure(&error);
        let mut lines = Lines::from_tree(&self.file.equations, lattice.as_ref()).map_err(failed)?;
        for (name, value) in &self.values {
            if self.file.parameters.contains_key(name) && lines.names().parameter(name).is_none() {
                continue;
            }
            lines = lines.with(name, value).map_err(|error| {
                Failure::Message(format!("--set {name}={}: {error}", numbers::brief(value)))
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
    pub fn sought(&self, may_be_set: bool) -> Result<Sought, Failure> {
        let open = self.open_step()?;
        let known: Vec<String> = open.names().parameters().map(|(name, _)| name.into()).collect();
        let parameter = self.sought_parameter(&known, may_be_set)?;
        let given = self.values.iter().find(|(name, _)| *name == parameter);
        let value = given.map(|(_, value)| value.clone());
        let step = self.with_defaults(open, &[&parameter])?;
        let open: Vec<String> =
            step.free_parameters().into_iter().filter(|name| *name != parameter).collect();
        match open.is_empty() {
            true => Ok(Sought { step, parameter, value }),
            false => Err(without_values(&open)),
        }
    }

    /// Its step with values for all parameters but two.
    pub fn plane(&self, x: &PlaneAxis, y: &PlaneAxis) -> Result<Step, Failure> {
        let open = self.open_step()?;
        for (option, axis) in [("--x", x), ("--y", y)] {
            if open.names().parameter(&axis.name).is_none() {
                let known = open.names().parameters().map(|(name, _)| name.into()).collect();
                let problem = SchemeError::UnknownParameter { name: axis.name.clone(), known };
                return Err(Failure::Message(format!("{option} {}: {problem}", axis.name)));
            }
            if self.is_set(&axis.name) {
                let name = &axis.name;
                return Err(Failure::Message(format!("--set {name}: it is an axis of the map")));
            }
        }
        let step = self.with_defaults(open, &[&x.name, &y.name])?;
        let axes = [&x.name, &y.name];
        let open: Vec<String> =
            step.free_parameters().into_iter().filter(|name| !axes.contains(&name)).collect();
        if open.is_empty() { Ok(step) } else { Err(without_values(&open)) }
    }

    /// Its step with the values that were given, and nothing else.
    pub fn with_values(&self) -> Result<Step, Failure> {
        self.set(self.open_step()?, &[])
    }

    /// Its step with values and defaults for all parameters but these.
    pub fn opened(&self, but: &[&str]) -> Result<Step, Failure> {
        self.with_defaults(self.open_step()?, but)
    }

    /// Its step with values and defaults for all parameters.
    pub fn complete_step(&self) -> Result<Step, Failure> {
        let step = self.opened(&[])?;
        complete(&step)?;
        Ok(step)
    }

    fn with_defaults(&self, step: Step, but: &[&str]) -> Result<Step, Failure> {
        let mut step = self.set(step, but)?;
        for (name, default) in &self.file.parameters {
            let taken = but.contains(&name.as_str()) || self.is_set(name);
            if !taken && step.names().parameter(name).is_some() {
                step = step.with(name, default).map_err(|error| self.failure(&error))?;
            }
        }
        Ok(step)
    }

    fn set(&self, mut step: Step, but: &[&str]) -> Result<Step, Failure> {
        let kept = |(name, _): &&(String, Rational)| !but.contains(&name.as_str());
        for (name, given) in self.values.iter().filter(kept) {
            // A name of the file that drops out of the equations of this lattice.
            let occurs = step.names().parameter(name).is_some();
            if !occurs && self.file.parameters.contains_key(name) {
                continue;
            }
            let option = match name.as_str() {
                "alpha" => format!("--alpha {}", numbers::brief(given)),
                _ => format!("--set {name}={}", numbers::brief(given)),
            };
            step = step
                .with(name, given)
                .map_err(|error| Failure::Message(format!("{option}: {error}")))?;
            if step.denominators().iter().any(Laurent::is_zero) {
                return Err(Failure::Message(format!(
                    "{option}: the equations divide by what vanishes for this value"
                )));
            }
        }
        Ok(step)
    }

    /// Whether somebody gave it a value.
    pub fn is_set(&self, name: &str) -> bool {
        self.values.iter().any(|(set, _)| set == name)
    }

    fn sought_parameter(&self, known: &[String], may_be_set: bool) -> Result<String, Failure> {
        let is_set = |name: &str| self.is_set(name);
        if let Some(name) = &self.parameter {
            if !known.contains(name) {
                let problem =
                    SchemeError::UnknownParameter { name: name.clone(), known: known.to_vec() };
                return Err(Failure::Message(format!("--parameter {name}: {problem}")));
            }
            if is_set(name) && !may_be_set {
                return Err(Failure::Message(format!(
                    "--set {name}: this is the parameter whose limit is sought; leave it out"
                )));
            }
            return Ok(name.clone());
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
            ([], [], []) => Err(Failure::Message(format!(
                "{}: {} has no parameter, so there is no limit to seek",
                self.kind.option(),
                self.file.name
            ))),
            ([], [], [one]) => Err(Failure::Message(format!(
                "--set {one}: this is the only parameter, whose limit is sought; leave it out"
            ))),
            ([], [], several) => Err(Failure::Message(format!(
                "--parameter: it is not clear which of {} is the one in question; name it",
                joined(several)
            ))),
            (several, ..) => {
                let names: Vec<&String> =
                    if several.is_empty() { open.clone() } else { several.to_vec() };
                Err(Failure::Message(format!(
                    "--set: {} have no value; give {} and leave out the one whose limit is sought, or name it by --parameter",
                    joined(&names),
                    names
                        .iter()
                        .map(|name| format!("--set {name}=…"))
                        .collect::<Vec<_>>()
                        .join(" ")
                )))
            }
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

    /// A problem with the equations, under the option that brought them.
    pub fn failure(&self, error: &SchemeError) -> Failure {
        let option = match (error, &self.integrator) {
            (SchemeError::Integrator(_), Some(integrator)) => {
                format!("--integrator {}", integrator.name)
            }
            _ if self.kind == Kind::Equation => "--equation".into(),
            _ => format!("{} {}", self.kind.option(), self.file.name),
        };
        Failure::Message(format!("{option}: {error}"))
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

    /// What the parameter in question is called before people.
    pub fn symbol(&self, parameter: &str) -> String {
        if self.kind == Kind::Method && parameter == "C" {
            "c Δt/h".into()
        } else {
            parameter.into()
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
        let heading = self.kind.option().trim_start_matches('-');
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

fn joined(names: &[&String]) -> String {
    names.iter().map(|name| name.as_str()).collect::<Vec<_>>().join(", ")
}

/// Refuses a step with parameters that have no value.
pub fn complete(step: &Step) -> Result<(), Failure> {
    match step.free_parameters() {
        open if open.is_empty() => Ok(()),
        open => Err(without_values(&open)),
    }
}

/// Parameters are missing.
fn without_values(open: &[String]) -> Failure {
    let (verb, subject) =
        if open.len() == 1 { ("has", "the parameter") } else { ("have", "the parameters") };
    let settings: Vec<String> = open.iter().map(|name| format!("--set {name}=…")).collect();
    Failure::Message(format!(
        "--set: {subject} {} {verb} no value; give {}",
        open.join(", "),
        settings.join(" ")
    ))
}

/// What is taken for granted of particle methods and not looked at in several dimensions: a line each, none for schemes of one dimension.
pub fn assumptions<'a>(subjects: impl Iterator<Item = &'a Subject> + Clone) -> Vec<String> {
    let plane = subjects.clone().any(|one| one.file.is_of_several_dimensions());
    let plane = plane.then(|| {
        "two and three dimensions: multipliers that meet are looked for at phases that are multiples of π/2 and at the wave that binds, singular steps at phases 0 and π".to_string()
    });
    let methods: Vec<&Subject> = subjects.filter(|one| one.kind == Kind::Method).collect();
    let Some(first) = methods.first() else { return plane.into_iter().collect() };
    let shared = |text: Option<String>, same: &dyn Fn(&Subject) -> bool| {
        text.filter(|_| methods.iter().all(|one| same(one))).unwrap_or_default()
    };
    let eos = first.eos.as_ref().map(|eos| format!(", {}", eos.name));
    let density = first.density.map(|density| format!(", density by {}", density_name(density)));
    vec![format!(
        "linear waves along a line of equal particles (one dimension){}{}",
        shared(eos, &|one| one.eos == first.eos),
        shared(density, &|one| one.density == first.density)
    )]
}
