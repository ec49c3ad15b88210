//! The wave that grows fastest and the wave that is damped most, for many values of one parameter.

use super::CompiledStep;
use super::envelope::{Envelope, Extreme, Work};
use super::sampled_gain::{SampledGain, extremes_on_torus};
use crate::scheme::{SchemeError, Step};
use crate::stability::margin::growth_from_excess;
use num_complex::Complex64;

/// Below this part of the largest `|z|²` the smallest `|z|` is taken from `z` itself: a square root has half the digits near zero.
const SMALL: f64 = 1e-4;

/// The extremes over all waves of the largest `|z|`, for every value of a parameter.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GainExtremes {
    /// `max_φ |z| − 1`. Infinite where the step cannot be solved for some wave.
    pub growth: Vec<f64>,
    /// Where it is taken, in radians, in one dimension; no number in several.
    pub growth_phase: Vec<f64>,
    /// `min_φ |z|` of the largest multiplier: what is left of the most damped wave.
    pub lowest_gain: Vec<f64>,
    /// Where it is taken, in radians, in one dimension; no number in several.
    pub lowest_gain_phase: Vec<f64>,
}

impl Step {
    /// The extreme gains over all waves for many values of a parameter, in `f64`.
    ///
    /// Explicit schemes for one unknown between two levels have `|g|² − 1` as a polynomial in the parameter and the cosine of the phase, whose
    /// extremes are certain and good to `1e-10`. Of other steps the largest multiplier is sampled, and each sampled extremum refined.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
    /// let gains = upwind.gain_extremes("C", &[0.25, 0.5, 1.5])?;
    /// assert!((gains.growth[2] - 1.0).abs() < 1e-15 && gains.growth[..2] == [0.0, 0.0]);
    /// assert!((gains.lowest_gain[0] - 0.5).abs() < 1e-15 && gains.lowest_gain[1] < 1e-15);
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Errors
    /// When the parameter does not occur, another has no value, or there is no characteristic polynomial.
    pub fn gain_extremes(
        &self,
        parameter: &str,
        values: &[f64],
    ) -> Result<GainExtremes, SchemeError> {
        self.variable(parameter)?;
        let open: Vec<String> =
            self.free_parameters().into_iter().filter(|name| name != parameter).collect();
        if !open.is_empty() {
            return Err(SchemeError::NotSet(open));
        }
        Ok(of_compiled(&self.compile()?, values).0)
    }
}

fn of_compiled(compiled: &CompiledStep, values: &[f64]) -> (GainExtremes, Work) {
    if compiled.dimension() > 1 {
        let found = extremes_on_torus(compiled, values);
        let gains = GainExtremes {
            growth: found.iter().map(|pair| growth_from_excess(pair[0]) + 0.0).collect(),
            lowest_gain: found.iter().map(|pair| 1.0 + growth_from_excess(pair[1])).collect(),
            growth_phase: vec![f64::NAN; values.len()],
            lowest_gain_phase: vec![f64::NAN; values.len()],
        };
        return (gains, Work::default());
    }
    if let (0, powers) = compiled.parameter_powers()
        && let Some(divisor) = compiled.one_step_divisor()
    {
        return of_one_step(compiled, divisor, powers, values);
    }
    let sampled = SampledGain::new(compiled);
    let found = sampled.extremes(values);
    let smallest = |(&value, [high, low]): (&f64, &[Extreme; 2])| {
        lowest_gain(high, low, || sampled.corner_about(value, low.phase))
    };
    let lowest = values.iter().zip(&found).map(smallest).collect();
    (GainExtremes::new(&found, lowest), Work::default())
}

/// With `g = 1 + Σ_m p^m y_m(φ)`: `|g|² − 1 = 2 Re Σ p^m y_m + |Σ p^m y_m|²`, without cancellation where the wave hardly changes.
fn of_one_step(
    compiled: &CompiledStep,
    divisor: f64,
    powers: usize,
    values: &[f64],
) -> (GainExtremes, Work) {
    let mut coefficients = vec![Complex64::ZERO; 2 * powers];
    let mut changes = |phase: f64| -> Vec<Complex64> {
        compiled.coefficients_in_parameter(&[phase], &mut coefficients);
        coefficients[..powers].iter().map(|value| -value / divisor).collect()
    };
    let envelope = Envelope::new(2 * compiled.span(), 2 * powers - 1, |phase, excess| {
        let changes = changes(phase);
        excess.fill(0.0);
        for (m, one) in changes.iter().enumerate() {
            excess[m] += 2.0 * one.re;
            for (n, other) in changes.iter().enumerate() {
                excess[m + n] += one.re * other.re + one.im * other.im;
            }
        }
    });
    let (found, work) = envelope.extremes(values);
    let smallest = |(&value, [high, low]): (&f64, &[Extreme; 2])| {
        lowest_gain(high, low, || {
            let sum = |sum: Complex64, one: &Complex64| sum * value + one;
            (1.0 + changes(low.phase).iter().rev().fold(Complex64::ZERO, sum)).norm()
        })
    };
    let lowest = values.iter().zip(&found).map(smallest).collect();
    (GainExtremes::new(&found, lowest), work)
}

/// From `|z|² − 1`, or `directly` where that has lost its digits.
fn lowest_gain(high: &Extreme, low: &Extreme, directly: impl FnOnce() -> f64) -> f64 {
    let is_small = 1.0 + low.value < SMALL * (1.0 + high.value.max(1.0));
    if is_small { directly() } else { 1.0 + growth_from_excess(low.value) }
}

impl GainExtremes {
    fn new(found: &[[Extreme; 2]], lowest_gain: Vec<f64>) -> Self {
        Self {
            // Adding zero turns a negative zero into a plain one.
            growth: found.iter().map(|pair| growth_from_excess(pair[0].value) + 0.0).collect(),
            growth_phase: found.iter().map(|pair| pair[0].phase).collect(),
            lowest_gain,
            lowest_gain_phase: found.iter().map(|pair| pair[1].phase).collect(),
        }
    }
}

#[cfg(test)]
mod tests;
