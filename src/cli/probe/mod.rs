//! `courant probe`.

mod answer;
mod command;

use super::numbers::{self, Names, Numbers};
use super::output::Format;
use super::progress::Bar;
use super::{Failure, Outcome, subject};
use answer::Refusal;
use clap::Args;
use command::{Given, NoStep, StepProgram, tuple};
use courant::analysis::exact::rational::{Rational, to_f64};
use courant::analysis::scheme::measurement::{
    Base, Experiment, MOST_VALUES, MeasuredStencil, Objection, Probe, Probed, StateLayout,
};
use courant::analysis::stability::SearchPlan;
use courant::reports::npy::NpyArray;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Cells along the only axis when nobody says how many.
const SIZE: usize = 32;

#[derive(Debug, Args)]
#[command(after_help = "\
COMMAND reads the state as a .npy file of float64 ({in}, $COURANT_IN or standard input), takes one time step on a periodic \
lattice, and writes the new level as another ({out}, $COURANT_OUT or standard output). {C} and {NAME} stand for parameters \
($COURANT_SET_C). The protocol is in docs/probe.md.

  courant probe -- python3 upwind.py {in} {out} {C}
  courant probe --unknowns E,Hx,Hy --size 16,16 --set C=0.7 -- ./yee {in} {out} {C}")]
pub struct Arguments {
    /// The unknowns, in the order of the first axis of the state; with one unknown there is no such axis.
    #[arg(long, value_name = "NAMES", default_value = "u", value_parser = |text: &str| numbers::names(text, unknown))]
    unknowns: Names<String>,
    /// Cells along each axis, and so the number of axes: 32, 16,16 or 12,12,12.
    #[arg(long, value_name = "N[,N,N]", default_value_t = Size(vec![SIZE]), value_parser = size)]
    size: Size,
    /// Time levels a step starts from, oldest first along the very first axis; the answer is the new level alone.
    #[arg(long, value_name = "L", default_value = "1", value_parser = |text: &str| numbers::count(text, 1, 8))]
    levels: usize,
    /// Values of a parameter, for each parameter once: of the sought one those to be judged (a list), of others one.
    #[arg(long, value_name = "NAME=VALUES", allow_hyphen_values = true, value_parser = subject::setting)]
    set: Vec<(String, Numbers)>,
    /// The parameter whose limit is sought (default: C where COMMAND holds {C}; else one step is judged as it is).
    #[arg(long, value_name = "NAME")]
    parameter: Option<String>,
    /// Values of the sought parameter at which COMMAND is run: coefficients are fitted as polynomials in it, of a degree up to three less
    /// than there are values.
    #[arg(long, value_name = "VALUES", default_value = "1/8:1:1/8", allow_hyphen_values = true, value_parser = numbers::list)]
    fit: Numbers,
    /// Linearise about this state, by central differences: a number for every unknown, or one for all, or FILE.npy.
    #[arg(long, value_name = "VALUES|FILE.npy", allow_hyphen_values = true)]
    about: Option<String>,
    /// How far a measured number may be wrong, as a share of the largest (default: 1.4e-14, with --about 1e-9).
    #[arg(long, value_name = "SHARE", value_parser = tolerance)]
    tolerance: Option<f64>,
    /// Seconds one step may take.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    timeout: f64,
    /// Look for stable values up to this one.
    #[arg(long, value_name = "VALUE", default_value = "100", allow_hyphen_values = true, value_parser = numbers::courant_number)]
    max: Rational,
    /// Boxes that one decision may look at; when they are spent the answer is `undecided` (default: no bound of yours).
    #[arg(long, value_name = "BOXES", value_parser = numbers::budget)]
    budget: Option<usize>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
    /// The program that takes one step, and its arguments.
    #[arg(value_name = "COMMAND", last = true, required = true, allow_hyphen_values = true)]
    command: Vec<String>,
}

/// Cells along each axis; a type of its own because the argument library treats `Vec` as repetition.
#[derive(Debug, Clone)]
struct Size(Vec<usize>);

impl std::fmt::Display for Size {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let sizes: Vec<String> = self.0.iter().map(usize::to_string).collect();
        formatter.write_str(&sizes.join(","))
    }
}

fn size(text: &str) -> Result<Size, String> {
    let sizes: Result<Vec<usize>, String> =
        text.split(',').map(|one| numbers::count(one.trim(), 4, 1_000_000)).collect();
    match sizes? {
        sizes if sizes.len() <= 3 => Ok(Size(sizes)),
        sizes => Err(format!("{} axes; one, two or three are accepted", sizes.len())),
    }
}

fn unknown(name: &str) -> Result<String, String> {
    let first = name.starts_with(|c: char| c.is_ascii_alphabetic());
    if first && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        Ok(name.into())
    } else {
        Err("a letter, then letters, digits and _ are accepted".into())
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let accepted = |value: &f64| (1e-15..=1e-3).contains(value);
    text.parse().ok().filter(accepted).ok_or_else(|| "from 1e-15 to 1e-3 is accepted".into())
}

fn seconds(text: &str) -> Result<f64, String> {
    let accepted = |value: &f64| (0.001..=1e6).contains(value);
    text.parse().ok().filter(accepted).ok_or_else(|| "from 0.001 to 1e6 is accepted".into())
}

/// What is asked of the program.
struct Plan {
    probe: Probe,
    /// The values of parameters that are not sought.
    fixed: Vec<(String, Rational)>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let plan = plan(arguments)?;
    match measure(arguments, &plan)? {
        Ok(measured) => {
            let answer = analysed(arguments, &plan, measured);
            match answer {
                Ok(answer) => answer::show(arguments, &plan, &answer),
                Err(refusal) => answer::refuse(arguments, &plan, &refusal),
            }
        }
        Err(refusal) => answer::refuse(arguments, &plan, &refusal),
    }
}

fn plan(arguments: &Arguments) -> Result<Plan, Failure> {
    let refuse = |message: String| Failure::Message(message);
    let layout = StateLayout {
        levels: arguments.levels,
        unknowns: arguments.unknowns.0.len(),
        size: arguments.size.0.clone(),
    };
    if !layout.fits() {
        return Err(refuse(format!(
            "--size {}: a state would have more than {MOST_VALUES} numbers",
            arguments.size
        )));
    }
    let sought = match &arguments.parameter {
        Some(name) => Some(unknown(name).map_err(|e| refuse(format!("--parameter {name}: {e}")))?),
        None => StepProgram::has_placeholder(&arguments.command, "C").then(|| "C".into()),
    };
    let (mut judged, mut fixed) = (Vec::new(), Vec::new());
    for (number, (name, values)) in arguments.set.iter().enumerate() {
        if arguments.set[..number].iter().any(|(known, _)| known == name) {
            return Err(refuse(format!("--set {name}: given twice; one list is accepted")));
        }
        match values.0.as_slice() {
            all if sought.as_ref() == Some(name) => judged = all.to_vec(),
            [value] => fixed.push((name.clone(), value.clone())),
            all => {
                return Err(refuse(format!(
                    "--set {name}: {} values; a list is accepted for the sought parameter, which --parameter names",
                    all.len()
                )));
            }
        }
    }
    for value in &judged {
        numbers::from_zero(value.clone()).map_err(|problem| {
            refuse(format!("--set {}: {problem}", sought.as_deref().unwrap_or_default()))
        })?;
    }
    let base = match &arguments.about {
        None => Base::Zero,
        Some(text) => Base::About(about(text, &layout)?),
    };
    let tolerance = arguments.tolerance.unwrap_or(base.usual_tolerance());
    let experiment = Experiment { layout, base, tolerance };
    let (unknowns, fit) = (arguments.unknowns.0.clone(), arguments.fit.0.clone());
    Ok(Plan { probe: Probe { experiment, unknowns, sought, fit, judged }, fixed })
}

/// A state from a file, or a uniform one.
fn about(text: &str, layout: &StateLayout) -> Result<Vec<f64>, Failure> {
    let refuse = |problem: String| Failure::Message(format!("--about {text}: {problem}"));
    if Path::new(text).extension().is_some_and(|end| end == "npy") {
        let bytes = std::fs::read(text).map_err(|error| refuse(error.to_string()))?;
        let array = NpyArray::from_bytes(&bytes).map_err(|error| refuse(error.to_string()))?;
        let shape = layout.state_shape();
        if array.shape != shape {
            let (found, needed) = (tuple(&array.shape), tuple(&shape));
            return Err(refuse(format!("the shape is {found}; {needed} is accepted")));
        }
        return match array.values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(refuse(format!("the file holds {value}"))),
            None => Ok(array.values),
        };
    }
    let values: Result<Vec<f64>, String> =
        text.split(',').map(|one| numbers::number(one).map(|value| to_f64(&value))).collect();
    let values = values.map_err(|error| {
        refuse(format!("{error}; a number for every unknown or FILE.npy is accepted"))
    })?;
    if values.len() != 1 && values.len() != layout.unknowns {
        let (found, needed) = (values.len(), layout.unknowns);
        let accepted = match needed {
            1 => "one is accepted".into(),
            _ => format!("1 or {needed}, one an unknown, are accepted"),
        };
        return Err(refuse(format!("{found} numbers; {accepted}")));
    }
    Ok(layout.uniform(&values))
}

/// The stencils at the values of the sought parameter; at the only one there is where none is sought.
type Stencils = Vec<(Rational, MeasuredStencil)>;

fn measure(arguments: &Arguments, plan: &Plan) -> Result<Result<Stencils, Refusal>, Failure> {
    let timeout = Duration::from_secs_f64(arguments.timeout);
    let layout = plan.probe.experiment.layout.clone();
    let program = StepProgram::new(&arguments.command, layout, timeout)
        .map_err(|error| Failure::Message(format!("a temporary directory: {error}")))?;
    let bar = Bar::new("running the program");
    let (done, all) = (AtomicUsize::new(0), plan.probe.runs());
    let given = |(name, value): (&String, &Rational)| Given {
        name: name.clone(),
        value: to_f64(value).to_string(),
    };
    let found = plan.probe.measure(|value, state| {
        let fixed = plan.fixed.iter().map(|(name, value)| (name, value));
        let sought = plan.probe.sought.iter().map(|name| (name, value));
        let found = program.step(state, &fixed.chain(sought).map(given).collect::<Vec<_>>());
        let _ = bar.advance(done.fetch_add(1, Ordering::Relaxed) + 1, all);
        found
    });
    bar.finish();
    let refused = match found {
        Ok(stencils) => return Ok(Ok(stencils)),
        Err(refused) => refused,
    };
    let place = match (&plan.probe.sought, &refused.value) {
        (Some(name), Some(value)) => format!("{name} = {}: ", subject::shown(value)),
        _ => String::new(),
    };
    match &refused.objection {
        Objection::Step(NoStep::Protocol(text)) => Err(Failure::Message(format!("{place}{text}"))),
        objection @ Objection::NotProportional { .. } => {
            Ok(Err(Refusal(format!("{place}{objection} (--about STATE)"))))
        }
        objection => Ok(Err(Refusal(format!("{place}{objection}")))),
    }
}

fn analysed(arguments: &Arguments, plan: &Plan, stencils: Stencils) -> Result<Probed, Refusal> {
    let search = SearchPlan::default().up_to(arguments.max.clone());
    let budget = arguments.budget.unwrap_or(search.budget);
    let found = plan.probe.analyse(stencils, &SearchPlan { budget, ..search });
    found.map_err(|error| Refusal(error.to_string()))
}
