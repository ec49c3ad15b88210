//! What is followed: every subject with its branches, along every direction.

use super::Arguments;
use crate::cli::Failure;
use crate::cli::subject::{Defaults, Label, Subject, SubjectError, option};
use courant::analysis::exact::rational::integer;
use courant::analysis::scheme::{Integrator, Step};
use courant::analysis::waves::branches::Branches;
use courant::analysis::waves::exact_wave::ExactWave;
use courant::reports::wave_curves::unit_vector;

/// Directions in two dimensions where nobody says, in degrees.
const DIRECTIONS: [f64; 4] = [0.0, 15.0, 30.0, 45.0];

/// One subject with values for all parameters.
pub struct Case {
    pub subject: Subject,
    /// Its step, or that of its equations in space.
    pub step: Step,
    pub branches: Branches,
    /// Why nothing is known of its equation.
    pub without_exact: Option<String>,
}

/// A direction and how it is called.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    pub vector: Vec<f64>,
    /// Degrees from the first axis, in two dimensions.
    pub degrees: Option<f64>,
    /// Empty in one dimension.
    pub name: String,
}

fn refuse(message: impl Into<String>) -> Failure {
    Failure::Message(message.into())
}

/// Every combination of the lists.
pub fn cases(arguments: &Arguments) -> Result<Vec<Case>, Failure> {
    let defaults = Defaults { exact_in_time: true, ..Defaults::default() };
    let subjects = arguments.subject.subjects(&defaults)?;
    let cases: Vec<Case> =
        subjects.into_iter().map(|subject| case(arguments, subject)).collect::<Result<_, _>>()?;
    let dimension = cases[0].branches.dimension();
    match cases.iter().find(|case| case.branches.dimension() != dimension) {
        Some(other) => Err(refuse(format!(
            "{} {}: it has {} space dimensions, {} has {dimension}; one figure takes one kind",
            option(other.subject.kind),
            other.subject.file.name,
            other.branches.dimension(),
            cases[0].subject.file.name
        ))),
        None => Ok(cases),
    }
}

fn case(arguments: &Arguments, mut subject: Subject) -> Result<Case, Failure> {
    let failed = |error| subject.failure(error);
    if !subject.file.is_of_lines() || subject.integrator.is_some() {
        let step = subject.complete_step()?;
        let (exact, without_exact) = exact(arguments, &subject, &step)?;
        let branches = Branches::of_step(&step, exact).map_err(failed)?;
        return Ok(Case { step, branches, without_exact, subject });
    }
    // Relative to the equation nothing depends on how long a step would be.
    let free = subject.file.parameter.clone().unwrap_or_else(|| "C".into());
    let mut lines = subject.lines()?;
    if !subject.is_set(&free) && lines.names().parameter(&free).is_some() {
        lines = lines.with(&free, &integer(1)).map_err(failed)?;
        subject.values.push((free, integer(1)));
    }
    let euler = Integrator::named("forward-euler").expect("it is in the catalogue");
    let failed = |error| subject.failure(error);
    let step = Step::lines(&lines, euler).map_err(failed)?;
    match step.free_parameters() {
        open if open.is_empty() => {}
        open => return Err(SubjectError::NotSet(open).into()),
    }
    let (exact, without_exact) = exact(arguments, &subject, &step)?;
    let branches = Branches::of_lines(&lines, exact).map_err(failed)?;
    Ok(Case { step, branches, without_exact, subject })
}

/// What the equation does: as the option or the file says, as sound does, or as the scheme does at long waves.
fn exact(
    arguments: &Arguments,
    subject: &Subject,
    step: &Step,
) -> Result<(Vec<ExactWave>, Option<String>), Failure> {
    if let Some(text) = &arguments.exact {
        let stated = ExactWave::stated(text, step);
        let stated = stated.map_err(|error| refuse(format!("--exact: {error}")))?;
        return Ok((stated, None));
    }
    let Some(text) = subject.exact_step() else {
        let leading = ExactWave::leading(step);
        let why = |error| format!("{error}; give the exponent of the exact step by --exact");
        return Ok(match leading {
            Ok(waves) => (waves, None),
            Err(error) => (Vec::new(), Some(why(error))),
        });
    };
    let stated = ExactWave::stated(&text, step);
    stated
        .map(|waves| (waves, None))
        .map_err(|error| refuse(format!("{} {}: {error}", option(subject.kind), subject.file.name)))
}

impl Case {
    /// Whether no integrator completes its equations.
    pub fn is_exact_in_time(&self) -> bool {
        self.subject.file.is_of_lines() && self.subject.integrator.is_none()
    }

    /// What tells it from the others.
    pub fn labels(&self) -> Vec<Label> {
        self.subject.labels()
    }
}

/// The directions that are asked for.
pub fn directions(arguments: &Arguments, dimension: usize) -> Result<Vec<Direction>, Failure> {
    let asked = arguments.direction.as_ref().map(|degrees| degrees.0.as_slice());
    let axis =
        |vector: Vec<f64>, name: &str| Direction { vector, degrees: None, name: name.into() };
    match (dimension, asked) {
        (1, None) => Ok(vec![axis(vec![1.0], "")]),
        (2, _) => {
            let angles = asked.unwrap_or(&DIRECTIONS);
            let along = |&degrees: &f64| Direction {
                vector: unit_vector(degrees).to_vec(),
                degrees: Some(degrees),
                name: format!("{degrees}°"),
            };
            Ok(angles.iter().map(along).collect())
        }
        (3, None) => {
            let (half, third) = (0.5f64.sqrt(), (1.0f64 / 3.0).sqrt());
            Ok(vec![
                axis(vec![1.0, 0.0, 0.0], "axis"),
                axis(vec![half, half, 0.0], "face diagonal"),
                axis(vec![third; 3], "body diagonal"),
            ])
        }
        (dimension, Some(_)) => Err(refuse(format!(
            "--direction: an angle is a direction in two dimensions; this scheme has {dimension}"
        ))),
        (dimension, None) => Err(refuse(format!("{dimension} space dimensions"))),
    }
}
