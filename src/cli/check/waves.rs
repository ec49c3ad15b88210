//! `courant check --method`: the verdict on one time step of a particle method.

use super::{Arguments, conclude, describe, words};
use crate::cli::judged::{NO_MONOTONICITY, default_range, record};
use crate::cli::judged::{SteppedMethod, SteppedRecord};
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::analysis::stability::ExactValue;
use courant::analysis::waves::dispersion::{StepCheck, StepEnd, check_step, stable_step_within};
use courant::reports::number::significant;
use courant::reports::record::LimitRecord;
use courant::reports::table::{Align, Table};
use num_traits::Zero;
use serde::Serialize;

/// The verdict as scripts read it.
#[derive(Debug, Serialize)]
struct Record {
    #[serde(flatten)]
    subject: SteppedRecord,
    cfl: f64,
    verdict: &'static str,
    monotone: Option<bool>,
    max_gain: f64,
    critical_phase: Option<f64>,
    growth_per_step: f64,
    steps_to_double: Option<f64>,
    stability: LimitRecord,
    monotonicity: Option<LimitRecord>,
    monotonicity_reason: &'static str,
    /// Where −1 or +1 is a double multiplier on the unit circle: the amplitude grows linearly.
    double_multiplier_phase: Option<f64>,
}

pub fn run(arguments: &Arguments, stepped: &SteppedMethod) -> Result<Outcome, Failure> {
    let scheme = stepped.scheme(arguments.kernel, &arguments.ratio)?;
    let range = arguments.cfl.clone().max(default_range());
    let found = check_step(&scheme, stepped.integrator, &arguments.cfl, &default_range())?;
    let within_budget = match &arguments.growth {
        Some(growth) => {
            let range = range * Rational::from_integer(2.into());
            let limit = stable_step_within(&scheme, stepped.integrator, growth, &range)?;
            let at_most = match limit.limit().exact() {
                Some(ExactValue::Fraction(value)) => arguments.cfl <= *value,
                _ => to_f64(&arguments.cfl) <= limit.limit().lower(),
            };
            // With nothing allowed to grow the verdict knows more: a step above the first limit may be stable.
            Some(at_most || (growth.is_zero() && found.verdict.is_stable()))
        }
        None => None,
    };
    let record = answer(arguments, stepped, &found);
    let table = table(arguments, stepped, &found);
    conclude(arguments, &record, table, found.verdict, within_budget)
}

fn answer(arguments: &Arguments, stepped: &SteppedMethod, found: &StepCheck) -> Record {
    Record {
        subject: stepped.record(arguments.kernel, &arguments.ratio),
        cfl: to_f64(&arguments.cfl),
        verdict: found.verdict.name(),
        monotone: None,
        max_gain: 1.0 + found.growth.per_step,
        critical_phase: found.critical_phase(),
        growth_per_step: found.growth.per_step,
        steps_to_double: found.growth.steps_to_double(),
        stability: record(found.stable.limit()),
        monotonicity: None,
        monotonicity_reason: NO_MONOTONICITY,
        double_multiplier_phase: found.growth.double_multiplier,
    }
}

fn table(arguments: &Arguments, stepped: &SteppedMethod, found: &StepCheck) -> Table {
    let caption = format!(
        "{}, {}, h/Δ = {}, c Δt/h = {}: {}",
        stepped.title(),
        arguments.kernel.title(),
        to_text(&arguments.ratio),
        to_text(&arguments.cfl),
        words(found.verdict),
    );
    let mut table = Table::new(caption, &[("", Align::Left), ("", Align::Left)]);
    let stable = &found.stable;
    let (limit, step) = (stable.limit(), to_f64(&arguments.cfl));
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    add("verdict", found.verdict.name().into());
    add("stability limit of c Δt/h", describe(limit, "c Δt/h"));
    if limit.is_positive() && limit.value().is_finite() {
        add("the same per spacing, c Δt/Δ", significant(stable.per_spacing(), 8));
        add("per kernel deviation, c Δt/σ", significant(stable.per_standard_deviation(), 8));
        add("step / limit", significant(step / limit.value(), 8));
    }
    if let Some(binding) = stable.binding() {
        add("how stability ends", binding.name().into());
    }
    if stable.end() == StepEnd::DoubleMultiplier {
        add("at the limit itself", "linear growth: −1 is a double multiplier".into());
    }
    add("largest |z|", significant(1.0 + found.growth.per_step, 12));
    add("growth per step", significant(found.growth.per_step, 6));
    if let Some(steps) = found.growth.steps_to_double() {
        add("steps to double", significant(steps, 4));
        let length = significant(2.0 * std::f64::consts::PI / found.growth.phase, 5);
        let phase = significant(found.growth.phase, 5);
        add("fastest growing wave", format!("{length} Δ (κ = {phase} rad per spacing)"));
    }
    table
}
