//! Orders of accuracy, read off the series at long waves.
//!
//! The truncation error of one step is `Σ_m (c_m − e_m) (Δx ∂/∂x)^m` with the coefficients `c_m(p)` of the [series](super::long_waves)
//! and `e_m` of the exact step. The exact equation knows no lattice, so a parameter in `e_m = p` is `p ∝ Δt/Δx^m`, and every monomial
//! of the error, over `Δt`, becomes `Δt^s Δx^t` times a derivative:
//!
//! - **space**: the least `t` among terms with `s = 0`, which stay when `Δt → 0` on a given lattice;
//! - **time**: the least `s` among terms with `t = 0`, which stay when `Δx → 0` at a given step;
//! - **overall**: the least power of `Δx` when the parameter in question is fixed, so that `Δt ∝ Δx^m`;
//! - a term with a negative `s` or `t` is a **condition**: the scheme is consistent only where the step and the spacing shrink in such a
//!   way that it vanishes (Lax–Friedrichs: `Δx²/Δt`; Du Fort–Frankel: `Δt²/Δx²`), and there is no order in that limit.

use super::long_waves::{LongWaves, NoSeries, Weight};
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::rational::Rational;
use crate::exact::rational_function::RationalFunction;
use crate::exact::real_roots::{RealRoot, real_roots, root_bound};
use crate::scheme::{SchemeError, Step};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Orders of accuracy against the exact step; `None` where there is none, or nothing tells it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Accuracy {
    /// In space, as the step goes to zero on a given lattice.
    pub space: Option<u32>,
    /// In time, as the spacing goes to zero at a given step.
    pub time: Option<u32>,
    /// At a fixed value of the parameter; 0 where long waves travel at a wrong speed.
    pub overall: Option<u32>,
    /// Terms `Δt^s Δx^t` with a negative power that must vanish for the scheme to be consistent.
    pub conditions: Vec<(i32, i32)>,
    /// The leading power of `x = iφ` in the error; `None` where there is no error up to the highest one looked at.
    pub power: Option<usize>,
    /// Whether every wave is moved exactly: by whole cells.
    pub is_exact_shift: bool,
}

/// The series is looked at up to this power at most.
pub const HIGHEST_POWER: usize = 24;

impl Step {
    /// The orders of accuracy with the series that shows them, long enough for all orders or up to the power 24; `exact` as in
    /// [`long_waves`](Self::long_waves), `parameter` the one that is fixed in the overall order.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// let heat = Step::from_text("u[n+1,j] = u[n,j] + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])")?;
    /// let (accuracy, series) = heat.accuracy(Some("-r*phi^2"), "r")?;
    /// assert_eq!((accuracy.space, accuracy.time, accuracy.overall), (Some(2), Some(1), Some(2)));
    /// assert_eq!(series.coefficient_text(4), "r (1 - 6 r)/12");
    /// let sixth = heat.with("r", &courant_analysis::exact::rational::ratio(1, 6))?;
    /// assert_eq!(sixth.accuracy(Some("-r*phi^2"), "r")?.0.overall, Some(4));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`long_waves`](Self::long_waves).
    pub fn accuracy(
        &self,
        exact: Option<&str>,
        parameter: &str,
    ) -> Result<(Accuracy, LongWaves), NoSeries> {
        let mut order = HIGHEST_POWER / 4;
        loop {
            let series = self.long_waves(exact, order)?;
            let mut accuracy = series.accuracy(self.names().parameter(parameter));
            if accuracy.power.is_none() && order >= HIGHEST_POWER {
                accuracy.is_exact_shift = self.shifts_exactly(&series)?;
            }
            if order >= HIGHEST_POWER || series.shows(&accuracy) {
                return Ok((accuracy, series));
            }
            order = (2 * order).min(HIGHEST_POWER);
        }
    }
}

impl Step {
    /// Whether `z = E^c` solves the characteristic equation, with `λ = c x` and a whole `c`.
    fn shifts_exactly(&self, series: &LongWaves) -> Result<bool, SchemeError> {
        let speed = series.coefficients[1].as_number().filter(Rational::is_integer);
        let cells = speed.and_then(|speed| i16::try_from(speed.to_integer()).ok());
        let Some(cells) = cells.filter(|_| self.dimension() == 1) else { return Ok(false) };
        let terms = self.characteristic()?.terms().to_vec().into_iter().map(|(mut e, value)| {
            e[1] += cells * std::mem::take(&mut e[0]);
            (e, value)
        });
        Ok(Laurent::new(terms.collect()).is_zero())
    }
}

/// The least weight in a polynomial, and the terms that have it.
fn lowest(polynomial: &Laurent, weigh: &impl Fn(&[i16]) -> i32) -> (i32, Laurent) {
    let least = polynomial.terms().iter().map(|(exponents, _)| weigh(exponents)).min().unwrap_or(0);
    let terms = polynomial.terms().iter().filter(|(exponents, _)| weigh(exponents) == least);
    (least, Laurent::new(terms.cloned().collect()))
}

impl LongWaves {
    /// What this many terms say.
    fn accuracy(&self, parameter: Option<Variable>) -> Accuracy {
        let errors = (1..=self.order()).map(|power| (power, self.error(power)));
        let errors: Vec<(usize, RationalFunction)> =
            errors.filter(|(_, error)| !error.is_zero()).collect();
        let mut accuracy =
            Accuracy { power: errors.first().map(|(power, _)| *power), ..Accuracy::default() };
        if !self.is_exact() {
            // Only a wrong speed can be told: by more than the kernel is uncertain, with a wide margin for what that does.
            let margin = &self.radius * Rational::from(BigInt::from(1_000_000));
            let wrong = self.speed_ratio().is_some_and(|r| (r - Rational::one()).abs() > margin);
            return Accuracy { overall: wrong.then_some(0), ..accuracy };
        }
        let weights = match &self.exact.weights {
            Some(weights) if !weights.is_empty() => weights,
            _ => {
                // Numbers: at these the error of a step of Δt ∝ Δx^m is a power of Δx.
                let scale = self.exact.leading().map_or(1, |(power, _)| power);
                let order = accuracy.power.map(|power| power.saturating_sub(scale) as u32);
                accuracy.overall = order.filter(|_| self.exact.is_homogeneous());
                return accuracy;
            }
        };
        let weight = |exponents: &[i16]| -> Weight {
            weights.iter().fold((0, 0), |(s, t), (variable, (a, b))| {
                let power = i32::from(exponents[variable.0]);
                (s + a * power, t + b * power)
            })
        };
        let (in_time, in_space) = (|e: &[i16]| weight(e).0, |e: &[i16]| weight(e).1);
        let least = |one: Option<u32>, other: i32| {
            let other = other.max(0) as u32;
            Some(one.map_or(other, |one| one.min(other)))
        };
        // With the parameter fixed Δt ∝ Δx^m.
        let fixed = weights.iter().find(|(variable, _)| Some(*variable) == parameter);
        let (s, t) = fixed.unwrap_or(&weights[0]).1;
        let path = |exponents: &[i16]| -t * in_time(exponents) + s * in_space(exponents);
        for (power, error) in &errors {
            let power = *power as i32;
            let (above, below) = (error.numerator(), error.denominator());
            // Δt → 0.
            let ((a, rest_a), (b, rest_b)) = (lowest(above, &in_time), lowest(below, &in_time));
            let steps = a - b - 1;
            let cells = power + lowest(&rest_a, &in_space).0 - lowest(&rest_b, &in_space).0;
            if steps < 0 || cells < 0 {
                accuracy.condition((steps, cells));
            } else if steps == 0 {
                accuracy.space = least(accuracy.space, cells);
            }
            // Δx → 0.
            let ((a, rest_a), (b, rest_b)) = (lowest(above, &in_space), lowest(below, &in_space));
            let cells = power + a - b;
            let steps = lowest(&rest_a, &in_time).0 - lowest(&rest_b, &in_time).0 - 1;
            if cells < 0 {
                accuracy.condition((steps, cells));
            } else if cells == 0 && steps > 0 {
                accuracy.time = least(accuracy.time, steps);
            }
            let along = lowest(above, &path).0 - lowest(below, &path).0;
            accuracy.overall = least(accuracy.overall, (along + s * power + t).div_euclid(s));
        }
        if accuracy.conditions.iter().any(|(steps, _)| *steps < 0) {
            accuracy.space = None;
        }
        if accuracy.conditions.iter().any(|(_, cells)| *cells < 0) {
            accuracy.time = None;
        }
        accuracy
    }

    /// Whether further terms cannot lower or add an order.
    fn shows(&self, accuracy: &Accuracy) -> bool {
        let weights = self.exact.weights.as_deref().unwrap_or_default();
        let widest = weights.iter().map(|(_, (s, t))| -t / s).max().unwrap_or(1).max(1) as u32;
        let known = self.order() as u32;
        let conditional = !accuracy.conditions.is_empty();
        let space = accuracy.space.is_some_and(|space| known >= space + widest);
        let time = accuracy.time.is_some_and(|time| known >= (time + 1) * widest);
        let alone = weights.is_empty() || conditional || !self.is_exact();
        accuracy.overall.is_some_and(|order| known > order + widest) && (alone || (space && time))
    }

    /// Where a polynomial coefficient of the error vanishes at a positive value of the only free parameter in it.
    pub fn special_values(&self, power: usize, parameter: &str) -> Vec<RealRoot> {
        let variable = self.names.parameter(parameter);
        let polynomial = variable.and_then(|v| self.error(power).numerator().in_one_variable(v));
        let Some(polynomial) = polynomial else { return Vec::new() };
        real_roots(&polynomial, &Rational::zero(), &root_bound(&polynomial), 64)
    }
}

impl Accuracy {
    /// Terms are powers of the first one that was met, and only that one is told.
    fn condition(&mut self, (steps, cells): (i32, i32)) {
        let known = self
            .conditions
            .iter()
            .any(|(s, t)| s.signum() == steps.signum() && t.signum() == cells.signum());
        if !known {
            self.conditions.push((steps, cells));
        }
    }
}

#[cfg(test)]
mod tests;
