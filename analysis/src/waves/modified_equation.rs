//! The equation that a scheme solves: its modified equation, and what it does to a wave first.
//!
//! `Δt ∂u/∂t = Σ_m c_m (Δx ∂/∂x)^m u` with the coefficients of the [series](super::long_waves). On a wave `e^{iφj}` a term of even `m` is
//! the real number `(−1)^{m/2} c_m φ^m`: growth or decay (dissipation); one of odd `m` is imaginary: speed (dispersion). With `i` among
//! the coefficients it is the other way round.

use super::long_waves::{LongWaves, ROOT};
use crate::exact::laurent::{Laurent, Variable, latex};
use crate::exact::rational_function::RationalFunction;
use num_traits::Zero;
use std::collections::BTreeMap;

/// One term of a modified equation.
#[derive(Debug, Clone, PartialEq)]
pub struct ModifiedTerm {
    /// How often it is differentiated along each axis, in units of the spacing.
    pub derivative: Vec<u32>,
    /// The factor.
    pub coefficient: RationalFunction,
}

impl LongWaves {
    /// The terms that are not zero, as far as the series goes; `None` where they are no derivatives (waves in several dimensions, whose
    /// frequency is a root) or not exact.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// let text = "u[n+1,j] = u[n,j] - C*(u[n,j+1] - u[n,j-1])/2 + C^2/2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    /// let series = Step::from_text(text)?.long_waves(Some("-I*C*phi"), 4)?;
    /// assert_eq!(
    ///     series.equation_text(&series.modified_equation().unwrap()),
    ///     "Δt ∂t u = -C Δx ∂x u - C (1 - C) (1 + C)/6 Δx^3 ∂x^3 u - C^2 (1 - C) (1 + C)/8 Δx^4 ∂x^4 u + …"
    /// );
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn modified_equation(&self) -> Option<Vec<ModifiedTerm>> {
        let axes = || (0..self.dimension).map(Variable::axis);
        let along = |p: &Laurent| self.dimension > 1 && axes().any(|axis| p.contains(axis));
        if !self.is_exact() || along(&self.square) {
            return None;
        }
        let mut terms = Vec::new();
        for (power, coefficient) in self.coefficients.iter().enumerate() {
            if coefficient.is_zero() {
                continue;
            }
            if self.dimension == 1 {
                let derivative = vec![power as u32];
                terms.push(ModifiedTerm { derivative, coefficient: coefficient.clone() });
                continue;
            }
            if along(coefficient.denominator()) {
                return None;
            }
            let mut parts: BTreeMap<Vec<u32>, Laurent> = BTreeMap::new();
            for (exponents, value) in coefficient.numerator().terms() {
                let mut rest = *exponents;
                let derivative =
                    axes().map(|axis| std::mem::take(&mut rest[axis.0]) as u32).collect();
                let part = parts.entry(derivative).or_default();
                *part = std::mem::take(part) + Laurent::monomial(rest, value.clone());
            }
            let below = RationalFunction::from(coefficient.denominator().clone());
            for (derivative, part) in parts.into_iter().rev() {
                let coefficient = RationalFunction::from(part).over(&below)?;
                terms.push(ModifiedTerm { derivative, coefficient });
            }
        }
        Some(terms)
    }

    /// The least power of `x` at which the scheme damps or amplifies other than the exact step; `None` as far as the series goes.
    pub fn leading_dissipation(&self) -> Option<usize> {
        self.first_error(0)
    }

    /// The least power of `x` at which waves travel at another speed than with the exact step; `None` as far as the series goes.
    pub fn leading_dispersion(&self) -> Option<usize> {
        self.first_error(1)
    }

    fn first_error(&self, parity: usize) -> Option<usize> {
        let turned = self.square == Laurent::integer(-1);
        (1..=self.order()).find(|power| {
            let error = self.error(*power);
            error.numerator().terms().iter().any(|(exponents, _)| {
                let turns = if turned { exponents[ROOT.0] as usize } else { 0 };
                (power + turns) % 2 == parity
            })
        })
    }

    /// `c_m` as text, factors apart.
    pub fn coefficient_text(&self, power: usize) -> String {
        self.text(&self.coefficients[power])
    }

    /// The coefficient of the error, `c_m − e_m`, as text.
    pub fn error_text(&self, power: usize) -> String {
        self.text(&self.error(power))
    }

    /// A coefficient as text.
    pub fn text(&self, value: &RationalFunction) -> String {
        value.to_text(&|place| match place {
            0 if self.square == Laurent::integer(-1) => "i".into(),
            0 => format!("sqrt({})", self.square.to_text(&|place| self.names.name_at(place))),
            1..4 => format!("n_{}", AXES[place - 1]),
            _ => self.names.name_at(place),
        })
    }

    /// A coefficient as LaTeX.
    pub fn latex(&self, value: &RationalFunction) -> String {
        let name = |place| match place {
            0 if self.square == Laurent::integer(-1) => "i".into(),
            // One word: spaces part words.
            0 => format!(
                "\\sqrt{{{}}}",
                latex(&self.square.to_text(&|place| self.names.name_at(place))).replace(' ', "{}")
            ),
            1..4 => format!("n_{}", AXES[place - 1]),
            _ => self.names.name_at(place),
        };
        value.to_latex(&|polynomial| latex(&polynomial.to_text(&name)))
    }

    /// Terms put together as plain text.
    pub fn equation_text(&self, terms: &[ModifiedTerm]) -> String {
        let derivative = |axis: &str, times: u32| match times {
            1 => format!("Δ{axis} ∂{axis}"),
            _ => format!("Δ{axis}^{times} ∂{axis}^{times}"),
        };
        let terms = terms.iter().map(|term| {
            format!("{} u", factors(&self.text(&term.coefficient), term, " ", derivative))
        });
        format!("Δt ∂t u = {} + …", joined(terms))
    }

    /// Terms put together as LaTeX.
    pub fn equation_latex(&self, terms: &[ModifiedTerm]) -> String {
        let derivative = |axis: &str, times: u32| match times {
            1 => format!("\\Delta {axis}\\,\\partial_{axis}"),
            _ => format!("\\Delta {axis}^{{{times}}}\\,\\partial_{axis}^{{{times}}}"),
        };
        let terms = terms.iter().map(|term| {
            format!("{} u", factors(&self.latex(&term.coefficient), term, "\\,", derivative))
        });
        format!("\\Delta t\\,\\partial_t u = {} + \\dots", joined(terms))
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// A coefficient and its derivatives; 1 is not written.
fn factors(
    coefficient: &str,
    term: &ModifiedTerm,
    between: &str,
    derivative: impl Fn(&str, u32) -> String,
) -> String {
    let axes = AXES.iter().zip(&term.derivative).filter(|(_, times)| **times > 0);
    let derivatives = axes.map(|(axis, &times)| derivative(axis, times));
    let sign = if coefficient.starts_with('-') { "-" } else { "" };
    let size = coefficient.trim_start_matches('-');
    let size = (size != "1").then(|| size.to_string());
    let parts: Vec<String> = size.into_iter().chain(derivatives).collect();
    format!("{sign}{}", parts.join(between))
}

/// Terms with their signs as operators.
fn joined(terms: impl Iterator<Item = String>) -> String {
    let mut text = String::new();
    for term in terms {
        match (text.is_empty(), term.strip_prefix('-')) {
            (true, _) => text.push_str(&term),
            (_, Some(size)) => text.push_str(&format!(" - {size}")),
            (_, None) => text.push_str(&format!(" + {term}")),
        }
    }
    if text.is_empty() { "0".into() } else { text }
}

#[cfg(test)]
mod tests;
