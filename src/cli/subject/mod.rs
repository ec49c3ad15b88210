//! What is judged, by the options that name it.

mod options;

use super::Failure;
use courant::analysis::exact::rational::Rational;
pub use courant::reports::subject::{
    EquationOfState, Kind, Label, PRESSURE, Sought, Subject, SubjectError, brief, density_name,
    row_name, shown, varying,
};
pub use options::{Defaults, SubjectOptions, setting};

/// The option that names subjects of a kind.
pub fn option(kind: Kind) -> String {
    format!("--{}", kind.name())
}

/// The option that sets a parameter, with its value.
fn given(name: &str, value: &Rational) -> String {
    match name {
        "alpha" => format!("--alpha {}", brief(value)),
        _ => format!("--set {name}={}", brief(value)),
    }
}

/// Under the option that brought it.
impl From<SubjectError> for Failure {
    fn from(error: SubjectError) -> Self {
        Self::Message(match &error {
            SubjectError::Ratio(problem) => format!("--ratio: {problem}"),
            SubjectError::Equations { kind: Kind::Equation, problem, .. } => {
                format!("--equation: {problem}")
            }
            SubjectError::Equations { kind, name, problem } => {
                format!("{} {name}: {problem}", option(*kind))
            }
            SubjectError::Integrator { name, problem } => format!("--integrator {name}: {problem}"),
            SubjectError::Value { name, value, problem } => {
                format!("{}: {problem}", given(name, value))
            }
            SubjectError::Division { name, value } => format!(
                "{}: the equations divide by what vanishes for this value",
                given(name, value)
            ),
            SubjectError::UnknownParameter { name, .. } => format!("--parameter {name}: {error}"),
            SubjectError::AxisIsSet(name) => format!("--set {name}: it is an axis of the map"),
            SubjectError::SoughtIsSet(name) => {
                format!("--set {name}: this is the parameter whose limit is sought; leave it out")
            }
            SubjectError::OnlyOneIsSet(name) => format!(
                "--set {name}: this is the only parameter, whose limit is sought; leave it out"
            ),
            SubjectError::NoParameter { kind, .. } => format!("{}: {error}", option(*kind)),
            SubjectError::Ambiguous(_) => format!("--parameter: {error}"),
            SubjectError::SeveralOpen(names) => format!(
                "--set: {} have no value; give {} and leave out the one whose limit is sought, or name it by --parameter",
                names.join(", "),
                settings(names)
            ),
            SubjectError::NotSet(names) => {
                let (verb, parameters) = match names.as_slice() {
                    [_] => ("has", "the parameter"),
                    _ => ("have", "the parameters"),
                };
                let (joined, settings) = (names.join(", "), settings(names));
                format!("--set: {parameters} {joined} {verb} no value; give {settings}")
            }
        })
    }
}

fn settings(names: &[String]) -> String {
    names.iter().map(|name| format!("--set {name}=…")).collect::<Vec<_>>().join(" ")
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
