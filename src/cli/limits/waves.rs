//! `courant limits --method`: stable time steps of particle methods.

use super::{Arguments, binding_wave, exact, number};
use crate::cli::output::{Format, print, print_json, table_text};
use crate::cli::subject::SteppedMethod;
use crate::cli::waves::finite;
use crate::cli::{Failure, Outcome};
use courant::analysis::dispersion::{Form, StableStep, StepEnd, stable_step, stable_step_within};
use courant::analysis::kernel::Kernel;
use courant::analysis::limit::Limit;
use courant::analysis::rational::{Rational, integer, to_f64, to_text};
use courant::reports::number::significant;
use courant::reports::record::{GrowthRecord, IntervalRecord, LimitRecord};
use courant::reports::table::{Align, Cell, Table};
use rayon::prelude::*;
use serde::Serialize;

/// Why a limit of time steps has no monotone one beside it.
pub const NO_MONOTONICITY: &str = "monotonicity is a property of advection schemes";

/// The steps `c Δt/h` searched by default: several times any limit of these integrators.
pub fn default_range() -> Rational {
    integer(10)
}

/// A limit as JSON, in the words of time steps.
pub fn record(limit: &Limit) -> LimitRecord {
    let reason = limit.value().is_infinite().then(|| {
        if limit.lower() > 0.0 {
            format!("no limit up to c Δt/h = {}", significant(limit.lower(), 6))
        } else {
            "undecided".into()
        }
    });
    LimitRecord { reason, ..limit.into() }
}

/// One method, integrator, kernel and ratio.
#[derive(Debug, Serialize)]
struct Row {
    method: &'static str,
    form: Option<&'static str>,
    integrator: &'static str,
    alpha: Option<f64>,
    kernel: &'static str,
    ratio: String,
    /// Limits of `c Δt/h`.
    stability: LimitRecord,
    /// From no step to the first limit; higher steps are not looked at.
    stable_set: Vec<IntervalRecord>,
    undecided: Vec<IntervalRecord>,
    /// The limit as `c Δt/Δ`.
    per_spacing: Option<f64>,
    /// The limit as `c Δt/σ` with the standard deviation σ of the kernel.
    per_standard_deviation: Option<f64>,
    /// `lattice`, `plus-one`, `minus-one` or `oscillation`.
    binding: Option<&'static str>,
    /// Whether the limit itself is a stable step.
    limit_included: bool,
    monotonicity: Option<LimitRecord>,
    monotonicity_reason: &'static str,
    growth_limits: Vec<GrowthRecord>,
    keeps_constants: bool,
}

#[derive(Debug, Serialize)]
struct Rows {
    rows: Vec<Row>,
}

/// Everything about one kernel and ratio.
struct Answer {
    kernel: Kernel,
    ratio: Rational,
    stable: StableStep,
    growth: Vec<(Rational, StableStep)>,
}

pub fn run(arguments: &Arguments, stepped: &SteppedMethod) -> Result<Outcome, Failure> {
    let cases: Vec<(Kernel, &Rational)> = arguments
        .kernel
        .0
        .iter()
        .flat_map(|kernel| arguments.ratio.0.iter().map(move |ratio| (*kernel, ratio)))
        .collect();
    let answers: Result<Vec<Answer>, Failure> = cases
        .into_par_iter()
        .map(|(kernel, ratio)| answer(arguments, stepped, kernel, ratio))
        .collect();
    let answers = answers?;
    match table_text(&table(stepped, &answers), arguments.format) {
        Some(mut text) => {
            if arguments.format == Format::Table {
                text.push_str(&remarks(&answers));
            }
            print(&text)
        }
        None => {
            let rows = answers.iter().map(|answer| row(stepped, answer)).collect();
            print_json("limits", &Rows { rows })
        }
    }
}

fn answer(
    arguments: &Arguments,
    stepped: &SteppedMethod,
    kernel: Kernel,
    ratio: &Rational,
) -> Result<Answer, Failure> {
    let range = arguments.max_cfl.clone().unwrap_or_else(default_range);
    let scheme = stepped.scheme(kernel, ratio)?;
    let no_scheme = |error| Failure::Message(format!("--form published: {error}"));
    let budgets = arguments.growth.as_ref().map_or(&[][..], |numbers| &numbers.0);
    let growth: Result<Vec<_>, Failure> = budgets
        .iter()
        .map(|budget| {
            let found = stable_step_within(&scheme, stepped.integrator, budget, &range);
            Ok((budget.clone(), found.map_err(no_scheme)?))
        })
        .collect();
    Ok(Answer {
        kernel,
        ratio: ratio.clone(),
        stable: stable_step(&scheme, stepped.integrator, &range).map_err(no_scheme)?,
        growth: growth?,
    })
}

fn row(stepped: &SteppedMethod, answer: &Answer) -> Row {
    let stable = &answer.stable;
    let limit = stable.limit();
    Row {
        method: stepped.method.name(),
        form: stepped.method.form().map(Form::name),
        integrator: stepped.integrator.name(),
        alpha: stepped.method.alpha().map(to_f64),
        kernel: answer.kernel.name(),
        ratio: to_text(&answer.ratio),
        stability: record(limit),
        stable_set: vec![IntervalRecord { from: 0.0, to: finite(limit.value()) }],
        undecided: stable
            .undecided()
            .iter()
            .map(|(from, to)| IntervalRecord { from: *from, to: finite(*to) })
            .collect(),
        per_spacing: finite(stable.per_spacing()),
        per_standard_deviation: finite(stable.per_standard_deviation()),
        binding: stable.binding().map(|binding| binding.name()),
        limit_included: stable.end() == StepEnd::Included,
        monotonicity: None,
        monotonicity_reason: NO_MONOTONICITY,
        growth_limits: answer
            .growth
            .iter()
            .map(|(growth, found)| GrowthRecord {
                growth: to_f64(growth),
                value: finite(found.limit().value()),
                limit: record(found.limit()),
            })
            .collect(),
        // A lattice at rest stays at rest, whatever the step.
        keeps_constants: true,
    }
}

fn table(stepped: &SteppedMethod, answers: &[Answer]) -> Table {
    let budgets: Vec<String> = answers
        .first()
        .map_or(&[][..], |answer| &answer.growth)
        .iter()
        .map(|(growth, _)| format!("growth {}", significant(to_f64(growth), 3)))
        .collect();
    let mut columns = vec![
        ("kernel", Align::Left),
        ("h/Δ", Align::Right),
        ("stable up to c Δt/h", Align::Right),
        ("exactly", Align::Right),
        ("c Δt/Δ", Align::Right),
        ("c Δt/σ", Align::Right),
        ("evidence", Align::Left),
        ("binding wave", Align::Left),
        ("how it ends", Align::Left),
    ];
    columns.extend(budgets.iter().map(|name| (name.as_str(), Align::Right)));
    let caption = format!("Limits of the time step c Δt/h, {}", stepped.title());
    let mut table = Table::new(caption, &columns);
    for answer in answers {
        let (stable, limit) = (&answer.stable, answer.stable.limit());
        let mut cells = vec![
            Cell::from(answer.kernel.name()),
            to_text(&answer.ratio).into(),
            number(limit),
            exact(limit),
            significant(stable.per_spacing(), 6).into(),
            significant(stable.per_standard_deviation(), 6).into(),
            limit.evidence().name().into(),
            binding_wave(limit).into(),
            stable.binding().map_or("–", |binding| binding.name()).into(),
        ];
        cells.extend(answer.growth.iter().map(|(_, found)| number(found.limit())));
        table.push(cells);
    }
    table
}

/// What the columns cannot say.
fn remarks(answers: &[Answer]) -> String {
    let mut remarks = Vec::new();
    for answer in answers {
        let name = format!("{}, h/Δ = {}", answer.kernel.name(), to_text(&answer.ratio));
        if answer.stable.end() == StepEnd::DoubleMultiplier {
            remarks.push(format!(
                "{name}: at the limit itself −1 is a double multiplier and the amplitude grows linearly; smaller steps are stable"
            ));
        }
        for (from, to) in answer.stable.undecided() {
            let (from, to) = (significant(*from, 8), significant(*to, 8));
            remarks.push(format!("{name}: undecided for c Δt/h in [{from}, {to}]"));
        }
    }
    if remarks.is_empty() { String::new() } else { format!("\n{}\n", remarks.join("\n")) }
}
