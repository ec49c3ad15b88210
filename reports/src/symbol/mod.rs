//! What a scheme is: its characteristic polynomial, its stencil, its order of accuracy and its modified equation.

mod order;

use crate::record::{CoefficientRecord, SymbolRecord};
use crate::subject::{Subject, SubjectError};
use courant_analysis::exact::laurent::{Laurent, Variable, latex};
use courant_analysis::exact::rational::{Rational, to_f64, to_text};
use courant_analysis::scheme::{OneStep, Step};
use courant_analysis::waves::long_waves::NoSeries;
pub use order::{Order, order};

/// Everything about one subject that needs no decision.
#[derive(Debug, Clone)]
pub struct Symbol {
    /// What was looked at.
    pub subject: Subject,
    /// Its step, with the values that were given.
    pub step: Step,
    /// The parameter in question, if there is one.
    pub parameter: Option<String>,
    /// The stencil, of an explicit scheme for one unknown between two levels.
    pub one_step: Option<OneStep>,
    /// Orders and modified equation, or why there are none.
    pub order: Result<Order, NoSeries>,
    /// `χ` by powers of z, ascending.
    pub characteristic: Vec<Laurent>,
    /// Whether what is the same everywhere and does not move stays so.
    pub keeps_constants: bool,
}

impl Symbol {
    /// Of a subject, with `terms` terms of its modified equation or as many as show what it does wrong first. Parameters may stay open:
    /// there is nothing to be decided.
    ///
    /// # Errors
    /// When the subject has no step.
    pub fn new(subject: Subject, terms: Option<usize>) -> Result<Self, SubjectError> {
        let failed = |error| subject.failure(error);
        let (step, parameter) = match subject.sought(true) {
            Ok(sought) => {
                let step = match &sought.value {
                    Some(value) => sought.step.with(&sought.parameter, value),
                    None => Ok(sought.step),
                };
                (step.map_err(failed)?, Some(sought.parameter))
            }
            Err(failure) => match subject.with_values() {
                Ok(step) => (step, None),
                Err(_) => return Err(failure),
            },
        };
        let chi = step.characteristic().map_err(failed)?;
        // The newest level without shifts, where that is possible.
        let leading = chi.coefficients(Variable::TIME).pop().unwrap_or_default();
        let lowest = |axis| leading.range(axis).map_or(0, |(low, _)| low);
        let shifted = (0..step.dimension())
            .map(Variable::axis)
            .fold(chi, |chi, axis| chi.shifted(axis, -lowest(axis)));
        let characteristic = shifted.coefficients(Variable::TIME);
        let one_step = parameter.as_ref().and_then(|name| step.one_step(name));
        let order = order(&subject, parameter.as_deref(), terms)?;
        let keeps_constants = step.keeps_constants().map_err(failed)?;
        Ok(Self { subject, step, parameter, one_step, order, characteristic, keeps_constants })
    }

    /// For machines; with the matrix `P` of `P U = 0` by rows, where that is asked for.
    pub fn record(&self, with_matrix: bool) -> SymbolRecord {
        let step = &self.step;
        let matrix = || {
            let row = |row: &Vec<Laurent>| row.iter().map(|entry| step.text(entry)).collect();
            step.matrix().rows().iter().map(row).collect()
        };
        let characteristic = self.characteristic_latex();
        let one = self.one_step.as_ref();
        let order = self.order.as_ref().ok();
        SymbolRecord {
            subject: self.subject.record(step, self.parameter.as_deref()),
            equations: self.subject.file.equations.text.trim().into(),
            coefficients: one.map(coefficients),
            exact: one.map(OneStep::is_exact),
            text: one.map_or_else(|| self.characteristic_text(), OneStep::to_text),
            latex: one.map_or_else(|| characteristic.clone(), OneStep::to_latex),
            characteristic,
            characteristic_text: self.characteristic_text(),
            degree: self.characteristic.len() - 1,
            unknowns: step.unknowns().to_vec(),
            matrix: with_matrix.then(matrix),
            keeps_constants: self.keeps_constants,
            order: order.map(Order::record),
            order_reasons: match &self.order {
                Ok(order) => order.reasons(),
                Err(reason) => vec![reason.to_string()],
            },
            compared_with: self.subject.file.exact.clone(),
            modified_equation: order.and_then(Order::equation),
            modified_equation_reason: match &self.order {
                Ok(order) => order.equation_reason(),
                Err(reason) => Some(reason.to_string()),
            },
            dissipation: order.and_then(Order::dissipation),
            dispersion: order.and_then(Order::dispersion),
            special_values: order.map(Order::special_values).unwrap_or_default(),
            long_wave_speed: self.long_wave_speed(),
        }
    }

    /// Over that of the exact step. Where the mean drifts, the speed of the first moment.
    fn long_wave_speed(&self) -> Option<f64> {
        let parameter = self.parameter.as_ref()?;
        let speed = match (&self.order, &self.one_step) {
            (Ok(order), _) => order.series.speed_ratio(),
            (Err(NoSeries::Drift), Some(one))
                if self.subject.file.exact == Some(format!("-I*{parameter}*phi")) =>
            {
                Some(-one.moment(1).coefficient(1))
            }
            _ => None,
        };
        speed.as_ref().map(to_f64)
    }

    /// `χ(z) = 0` in powers of z, the highest first; `write` sets a coefficient, `power` a power of z.
    fn in_powers(
        &self,
        write: impl Fn(&Laurent) -> String,
        power: impl Fn(usize) -> String,
    ) -> String {
        let terms: Vec<String> = self
            .characteristic
            .iter()
            .enumerate()
            .rev()
            .filter(|(_, coefficient)| !coefficient.is_zero())
            .map(|(exponent, coefficient)| {
                let text = write(coefficient);
                let text = match (coefficient.as_monomial().is_some(), exponent) {
                    (true, 1..) if text == "1" => String::new(),
                    (true, _) => text,
                    (false, _) => format!("({text})"),
                };
                match exponent {
                    0 => text,
                    _ if text.is_empty() => power(exponent),
                    _ => format!("{text} {}", power(exponent)),
                }
            })
            .collect();
        format!("{} = 0", terms.join(" + ").replace("+ -", "- "))
    }

    /// `χ(z) = 0` as plain text.
    pub fn characteristic_text(&self) -> String {
        let power = |exponent| if exponent == 1 { "z".into() } else { format!("z^{exponent}") };
        self.in_powers(|coefficient| self.step.text(coefficient), power)
    }

    /// The same in LaTeX.
    fn characteristic_latex(&self) -> String {
        let write = |coefficient: &Laurent| latex(&self.step.text(coefficient));
        self.in_powers(write, |exponent| format!("z^{{{exponent}}}").replace("^{1}", ""))
    }
}

/// The stencil: every neighbour from the first to the last.
pub fn coefficients(one: &OneStep) -> Vec<CoefficientRecord> {
    let offsets = || one.coefficients.iter().map(|(offset, ..)| *offset);
    let (low, high) = (offsets().min().unwrap_or(0), offsets().max().unwrap_or(0));
    let shown =
        |value: &Rational| if one.is_exact() { to_text(value) } else { to_f64(value).to_string() };
    let record = |offset| {
        let polynomial = one.coefficient(offset);
        let polynomial = polynomial.coefficients().iter().map(shown).collect();
        CoefficientRecord { offset, polynomial }
    };
    (low..=high).map(record).collect()
}
