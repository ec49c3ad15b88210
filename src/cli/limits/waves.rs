//! `courant limits --method`: stable time steps of particle methods.

use super::{
    Arguments, add_equation, answers, binding_wave, budgets, exact, number, show,
    table_with_budgets,
};
use crate::cli::subject::{SteppedMethod, SteppedRecord};
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{Rational, integer, to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::analysis::stability::Limit;
use courant::analysis::waves::dispersion::{StableStep, StepEnd, stable_step, stable_step_within};
use courant::reports::number::{finite, significant};
use courant::reports::record::{EquationRecord, GrowthRecord, IntervalRecord, LimitRecord};
use courant::reports::table::{Align, Cell, Table};
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
    let plain = LimitRecord::from(limit);
    // The unknown is x = c Δt/h.
    let equation = limit.equation().zip(plain.equation);
    let equation =
        equation.map(|(root, found)| EquationRecord { text: root.equation("x"), ..found });
    LimitRecord { reason, equation, ..limit.into() }
}

/// One method, integrator, kernel and ratio.
#[derive(Debug, Serialize)]
struct Row {
    #[serde(flatten)]
    subject: SteppedRecord,
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

/// Everything about one kernel and ratio.
struct Answer {
    kernel: Kernel,
    ratio: Rational,
    stable: StableStep,
    growth: Vec<(Rational, StableStep)>,
}

pub fn run(arguments: &Arguments, stepped: &SteppedMethod) -> Result<Outcome, Failure> {
    let answers = answers(arguments, |kernel, ratio| answer(arguments, stepped, kernel, ratio))?;
    let table = table(arguments, stepped, &answers);
    show(arguments, &table, &remarks(&answers), || {
        answers.iter().map(|answer| row(stepped, answer)).collect()
    })
}

fn answer(
    arguments: &Arguments,
    stepped: &SteppedMethod,
    kernel: Kernel,
    ratio: &Rational,
) -> Result<Answer, Failure> {
    let range = arguments.max_cfl.clone().unwrap_or_else(default_range);
    let scheme = stepped.scheme(kernel, ratio)?;
    let growth: Result<Vec<_>, Failure> = budgets(arguments)
        .iter()
        .map(|budget| {
            let found = stable_step_within(&scheme, stepped.integrator, budget, &range)?;
            Ok((budget.clone(), found))
        })
        .collect();
    Ok(Answer {
        kernel,
        ratio: ratio.clone(),
        stable: stable_step(&scheme, stepped.integrator, &range)?,
        growth: growth?,
    })
}

fn row(stepped: &SteppedMethod, answer: &Answer) -> Row {
    let stable = &answer.stable;
    let limit = stable.limit();
    Row {
        subject: stepped.record(answer.kernel, &answer.ratio),
        stability: record(limit),
        stable_set: vec![IntervalRecord::up_to(limit)],
        undecided: stable
            .undecided()
            .iter()
            .map(|&(from, to)| IntervalRecord::new(from, to, from))
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

fn table(arguments: &Arguments, stepped: &SteppedMethod, answers: &[Answer]) -> Table {
    let caption = format!("Limits of the time step c Δt/h, {}", stepped.title());
    let columns = [
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
    let mut table = table_with_budgets(arguments, caption, &columns);
    for answer in answers {
        let (stable, limit) = (&answer.stable, answer.stable.limit());
        let mut cells = vec![
            Cell::from(answer.kernel.name()),
            to_text(&answer.ratio).into(),
            number(arguments, limit),
            exact(limit),
            significant(stable.per_spacing(), 6).into(),
            significant(stable.per_standard_deviation(), 6).into(),
            limit.evidence().name().into(),
            binding_wave(limit).into(),
            stable.binding().map_or("–", |binding| binding.name()).into(),
        ];
        cells.extend(answer.growth.iter().map(|(_, found)| number(arguments, found.limit())));
        table.push(cells);
    }
    table
}

/// What the columns cannot say.
fn remarks(answers: &[Answer]) -> Vec<String> {
    let mut remarks = Vec::new();
    for answer in answers {
        let name = format!("{}, h/Δ = {}", answer.kernel.name(), to_text(&answer.ratio));
        if answer.stable.end() == StepEnd::DoubleMultiplier {
            remarks.push(format!(
                "{name}: at the limit itself −1 is a double multiplier and the amplitude grows linearly; smaller steps are stable"
            ));
        }
        add_equation(&mut remarks, &name, "the limit x = c Δt/h", "x", answer.stable.limit());
        for (from, to) in answer.stable.undecided() {
            let (from, to) = (significant(*from, 8), significant(*to, 8));
            remarks.push(format!("{name}: undecided for c Δt/h in [{from}, {to}]"));
        }
    }
    remarks
}
