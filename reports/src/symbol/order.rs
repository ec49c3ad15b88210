//! Order of accuracy and modified equation of a subject.

use crate::number::significant;
use crate::record::{DerivativeRecord, ModifiedTermRecord, OrderRecord, SpecialValueRecord};
use crate::subject::{Subject, SubjectError};
use courant_analysis::exact::rational::{to_f64, to_text};
use courant_analysis::exact::real_roots::RealRoot;
use courant_analysis::scheme::Step;
use courant_analysis::waves::accuracy::{Accuracy, HIGHEST_POWER};
use courant_analysis::waves::long_waves::{LongWaves, NoSeries};
use courant_analysis::waves::modified_equation::ModifiedTerm;

/// The highest power of the phase that is computed for a modified equation of many terms.
const LONGEST: usize = 60;

/// What the series at long waves says.
#[derive(Debug, Clone)]
pub struct Order {
    /// Orders where all parameters of the exact step are free.
    general: Accuracy,
    /// With the values that were given.
    accuracy: Accuracy,
    /// The series, with the values that were given.
    pub series: LongWaves,
    /// The terms of the modified equation, where there is one.
    pub terms: Option<Vec<ModifiedTerm>>,
    special: Vec<(RealRoot, Option<Accuracy>)>,
    parameter: String,
}

/// The names in the exact step.
fn names_in(exact: &str) -> Vec<&str> {
    exact.split(|c: char| !c.is_alphanumeric() && c != '_').collect()
}

/// The order of a subject, or why there is no series to read it from, with `terms` terms of its modified equation or as many as show what it does wrong first.
///
/// # Errors
/// When the subject has no step.
pub fn order(
    subject: &Subject,
    parameter: Option<&str>,
    terms: Option<usize>,
) -> Result<Result<Order, NoSeries>, SubjectError> {
    let exact = subject.file.exact.as_deref();
    let parameter = parameter.unwrap_or_default();
    let free = exact.map_or_else(|| vec![parameter], names_in);
    let given: Vec<&str> = free.iter().copied().filter(|name| !subject.is_set(name)).collect();
    let general = subject.opened(&free)?;
    let shown = subject.opened(&given)?;
    Ok(of_steps(&general, &shown, exact, parameter, terms))
}

fn of_steps(
    general: &Step,
    shown: &Step,
    exact: Option<&str>,
    parameter: &str,
    terms: Option<usize>,
) -> Result<Order, NoSeries> {
    let (accuracy, _) = shown.accuracy(exact, parameter)?;
    // What is general may have no series where the values have one.
    let general = general.accuracy(exact, parameter).map(|(accuracy, _)| accuracy);
    let general = general.unwrap_or_else(|_| accuracy.clone());
    let mut power = accuracy.power.map_or(1, |power| power + 1);
    let mut series = shown.long_waves(exact, power + 2)?;
    let count = |series: &LongWaves| series.modified_equation().map_or(usize::MAX, |t| t.len());
    match terms {
        Some(terms) => {
            while count(&series) < terms && power < LONGEST && accuracy.power.is_some() {
                power = (2 * power).min(LONGEST);
                series = shown.long_waves(exact, power)?;
            }
        }
        None => {
            let errors = [series.leading_dissipation(), series.leading_dispersion()];
            power = errors.into_iter().flatten().max().unwrap_or(power);
            // Those of a direction have no shape.
            series = shown.long_waves(exact, power)?;
        }
    }
    let equation = series.modified_equation().map(|mut all| {
        all.truncate(terms.unwrap_or(all.len()));
        all
    });
    let roots = accuracy.power.map_or_else(Vec::new, |p| series.special_values(p, parameter));
    let special = roots.into_iter().map(|root| {
        let there = root.exact().and_then(|value| {
            let step = shown.with(parameter, value).ok()?;
            Some(step.accuracy(exact, parameter).ok()?.0)
        });
        (root, there)
    });
    let special = special.collect();
    Ok(Order { general, accuracy, series, terms: equation, special, parameter: parameter.into() })
}

impl Order {
    /// The orders.
    pub fn record(&self) -> OrderRecord {
        let Accuracy { space, time, .. } = self.general;
        let given = self.accuracy.overall.or(self.general.overall);
        let overall = if self.accuracy.is_exact_shift { None } else { given };
        OrderRecord { space, time, overall }
    }

    /// Why an order is missing, and on what they depend.
    pub fn reasons(&self) -> Vec<String> {
        let mut reasons = Vec::new();
        if self.accuracy.is_exact_shift {
            reasons.push("exact: every wave is moved by whole cells".to_string());
        } else if self.accuracy.power.is_none() {
            reasons.push(format!("no error up to the power {HIGHEST_POWER} of the phase"));
        }
        if !self.series.is_exact() {
            reasons.push("the kernel is known within a radius, no coefficient exactly".into());
        }
        for &(steps, cells) in &self.general.conditions {
            let power = |name: &str, power: i32| match power.abs() {
                1 => name.to_string(),
                size => format!("{name}^{size}"),
            };
            let term = match (steps, cells) {
                (..0, ..=0) | (..=0, ..0) => "the exact step does not fit the equations".into(),
                (..0, _) => format!(
                    "an error {}/{}: consistent only where it vanishes",
                    power("Δx", cells),
                    power("Δt", steps)
                ),
                _ => format!(
                    "an error {}/{}: consistent only where it vanishes",
                    power("Δt", steps),
                    power("Δx", cells)
                ),
            };
            reasons.push(term);
        }
        let record = self.record();
        if (record.space, record.time) == (None, None)
            && self.general.conditions.is_empty()
            && self.series.is_exact()
            && !self.accuracy.is_exact_shift
        {
            reasons.push(
                "space and time are told apart where the parameters of the exact step are free"
                    .into(),
            );
        }
        reasons
    }

    /// One line for people.
    pub fn text(&self) -> String {
        let record = self.record();
        let overall = match record.overall {
            Some(0) => {
                let speed = self.series.speed_ratio();
                let speed = speed.map_or_else(String::new, |speed| {
                    let speed = significant(to_f64(&speed), 8);
                    format!(": long waves travel at {speed} times the true speed")
                });
                return format!("0{speed}");
            }
            Some(order) => order.to_string(),
            None => "-".into(),
        };
        let of =
            |name: &str, order: Option<u32>| Some(format!("{order} in {name}", order = order?));
        let parts = [of("space", record.space), of("time", record.time)];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        let parts = parts.join(", ");
        let general = self.general.overall.filter(|order| record.overall != Some(*order));
        let parts = match general {
            _ if parts.is_empty() => String::new(),
            None => format!(" ({parts})"),
            Some(order) => format!(" at this value (in general {order}: {parts})"),
        };
        let reasons = self.reasons().into_iter().map(|reason| format!("; {reason}"));
        format!("{overall}{parts}{}", reasons.collect::<String>())
    }

    /// Of a term of the error, what it is.
    fn error(&self, power: Option<usize>) -> Option<ModifiedTermRecord> {
        let is_line = self.terms.as_ref()?.first().is_some_and(|term| term.derivative.len() == 1);
        let power = power.filter(|_| is_line)?;
        let derivative = DerivativeRecord::Line(power as u32);
        Some(ModifiedTermRecord { derivative, coefficient: self.series.error_text(power) })
    }

    /// The first term of the error that changes amplitudes.
    pub fn dissipation(&self) -> Option<ModifiedTermRecord> {
        self.error(self.series.leading_dissipation())
    }

    /// The first term of the error that changes speeds.
    pub fn dispersion(&self) -> Option<ModifiedTermRecord> {
        self.error(self.series.leading_dispersion())
    }

    /// Positive values of the parameter at which the leading error vanishes.
    pub fn special_values(&self) -> Vec<SpecialValueRecord> {
        let record = |(root, accuracy): &(RealRoot, Option<Accuracy>)| SpecialValueRecord {
            value: to_f64(&root.lower),
            exact: root.exact().map(to_text),
            order: accuracy.as_ref().and_then(|accuracy| accuracy.overall),
        };
        self.special.iter().map(record).collect()
    }

    /// The special values for people.
    pub fn special_text(&self) -> Option<String> {
        let text = |(root, accuracy): &(RealRoot, Option<Accuracy>)| {
            let value = match root.exact() {
                Some(exact) => to_text(exact),
                None => significant(to_f64(&root.lower), 8),
            };
            let there = match accuracy {
                Some(accuracy) if accuracy.is_exact_shift => " (exact)".into(),
                Some(Accuracy { overall: Some(order), .. }) => format!(" (order {order})"),
                _ => String::new(),
            };
            format!("{} = {value}{there}", self.parameter)
        };
        let texts: Vec<String> = self.special.iter().map(text).collect();
        (!texts.is_empty()).then(|| texts.join(", "))
    }

    /// The terms of the modified equation.
    pub fn equation(&self) -> Option<Vec<ModifiedTermRecord>> {
        let record = |term: &ModifiedTerm| ModifiedTermRecord {
            derivative: match term.derivative.as_slice() {
                [times] => DerivativeRecord::Line(*times),
                several => DerivativeRecord::Axes(several.to_vec()),
            },
            coefficient: self.series.text(&term.coefficient),
        };
        Some(self.terms.as_ref()?.iter().map(record).collect())
    }

    /// Why there is no modified equation.
    pub fn equation_reason(&self) -> Option<String> {
        let reason = match self.series.is_exact() {
            true => {
                "waves along a direction: their frequency is a root, no polynomial of derivatives"
            }
            false => "the kernel is known within a radius, no coefficient exactly",
        };
        self.terms.is_none().then(|| reason.into())
    }
}
