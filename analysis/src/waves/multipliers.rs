//! What one step does to each wave: the multipliers, in `f64`.

use super::roots::roots;
use super::wave_terms::{Factored, WaveTerm, difference_terms, primitive_characteristic};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::laurent::Variable;
use crate::exact::rational::quotient_to_f64;
use crate::scheme::{SchemeError, Step};
use num_bigint::BigInt;
use num_complex::Complex64;
use num_traits::One;
use std::f64::consts::PI;

mod errors;
mod one_parameter;

/// A [`Step`] in `f64`: the coefficients of `χ(z)` for any wave and any values of the parameters that are free.
///
/// ```
/// use courant_analysis::scheme::Step;
/// let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?.compile()?;
/// // z − 1/z = −2 i C sin φ: two waves on the circle.
/// let z = leapfrog.multipliers(&[0.5], 1.0);
/// assert!(z.iter().all(|z| (z.norm() - 1.0).abs() < 1e-15 && (z.im + 0.5 * 1f64.sin()).abs() < 1e-15));
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct CompiledStep {
    parameters: Vec<String>,
    letters: Vec<CosineSeries<f64>>,
    /// By the power of `y = z − 1`.
    powers: Vec<Vec<CompiledTerm>>,
}

#[derive(Debug, Clone)]
struct CompiledTerm {
    parameters: Vec<(usize, i32)>,
    letters: Vec<(usize, i32)>,
    even: Factored<f64>,
    odd: Factored<f64>,
}

impl Step {
    /// Prepared for waves in `f64`.
    ///
    /// # Errors
    /// When there is no characteristic polynomial, or more than one space dimension.
    pub fn compile(&self) -> Result<CompiledStep, SchemeError> {
        Ok(CompiledStep::new(self, &difference_terms(&primitive_characteristic(self)?)))
    }
}

impl CompiledStep {
    /// From the [terms](difference_terms) of a step.
    pub(crate) fn new(step: &Step, terms: &[Vec<WaveTerm>]) -> Self {
        let parameters = step.free_parameters();
        let places: Vec<Variable> =
            parameters.iter().filter_map(|name| step.names.parameter(name)).collect();
        let letters: Vec<_> = step.names.letters().collect();
        // One power of two makes the largest coefficient about 1.
        let numbers = terms.iter().flatten().flat_map(|term| {
            [&term.even, &term.odd].into_iter().flat_map(|part| part.series.coefficients())
        });
        let scale = BigInt::one() << numbers.map(BigInt::bits).max().unwrap_or(0);
        let compiled = |term: &WaveTerm| {
            let of = |known: &dyn Fn(Variable) -> Option<usize>| -> Vec<(usize, i32)> {
                let names = term.names.iter();
                names.filter_map(|&(name, power)| Some((known(name)?, power))).collect()
            };
            let part = |part: &Factored<BigInt>| Factored {
                s_power: part.s_power,
                complement_power: part.complement_power,
                series: part.series.map(|value| quotient_to_f64(value, &scale)),
            };
            CompiledTerm {
                parameters: of(&|name| places.iter().position(|place| *place == name)),
                letters: of(&|name| letters.iter().position(|(place, _)| *place == name)),
                even: part(&term.even),
                odd: part(&term.odd),
            }
        };
        Self {
            powers: terms.iter().map(|power| power.iter().map(compiled).collect()).collect(),
            letters: letters.iter().map(|(_, letter)| letter.value.compile()).collect(),
            parameters,
        }
    }

    /// The names of the parameters whose values are to be given, in their order.
    pub fn parameters(&self) -> &[String] {
        &self.parameters
    }

    /// How many multipliers a wave has.
    pub fn degree(&self) -> usize {
        self.powers.len() - 1
    }

    /// The largest order of a cosine among the coefficients: how fast they oscillate over the waves.
    pub fn span(&self) -> usize {
        let order = |part: &Factored<f64>| {
            part.series.degree() + (part.s_power + part.complement_power) as usize
        };
        let letters = |term: &CompiledTerm| -> usize {
            term.letters.iter().map(|&(l, power)| self.letters[l].degree() * power as usize).sum()
        };
        let terms = self.powers.iter().flatten();
        let spans = terms.map(|term| letters(term) + order(&term.even).max(order(&term.odd) + 1));
        spans.max().unwrap_or(0)
    }

    /// The multipliers of the wave of this phase: forward ones first, `z ≈ e^{−iωΔt}` with `ω > 0`; of real ones the largest in modulus first.
    /// Infinite where the leading coefficient vanishes, not numbers where all do.
    ///
    /// Errors are those of roundings in the coefficients: about `1e-15` of simple multipliers, the root of that where two meet.
    pub fn multipliers(&self, values: &[f64], phase: f64) -> Vec<Complex64> {
        self.differences(values, phase).into_iter().map(|y| y + 1.0).collect()
    }

    /// `z − 1` of the multipliers in the same order, with the digits that a long wave leaves.
    pub fn differences(&self, values: &[f64], phase: f64) -> Vec<Complex64> {
        let mut found = roots(&self.coefficients(values, &Wave::new(phase)));
        let modulus = |y: &Complex64| (y + 1.0).norm();
        found.sort_by(|a, b| {
            let sides = a.im.total_cmp(&b.im);
            sides.then(modulus(b).total_cmp(&modulus(a))).then(b.re.total_cmp(&a.re))
        });
        found
    }

    /// `[b_0, b_1, …]` of `χ(1 + y)`, up to a factor.
    fn coefficients(&self, values: &[f64], wave: &Wave) -> Vec<Complex64> {
        let letters: Vec<f64> =
            self.letters.iter().map(|letter| letter.at_cosine(wave.cosine)).collect();
        let product = |of: &[(usize, i32)], numbers: &[f64]| -> f64 {
            of.iter().map(|&(index, power)| numbers[index].powi(power)).product()
        };
        self.powers
            .iter()
            .map(|terms| {
                let sum: Complex64 = terms
                    .iter()
                    .map(|term| {
                        let factor =
                            product(&term.parameters, values) * product(&term.letters, &letters);
                        let odd = wave.sine * wave.at(&term.odd);
                        Complex64::new(wave.at(&term.even), odd) * factor
                    })
                    .sum();
                // Without the sign of zero.
                sum + Complex64::ZERO
            })
            .collect()
    }
}

/// A phase with what is computed of it once.
struct Wave {
    sine: f64,
    cosine: f64,
    s: f64,
    complement: f64,
}

impl Wave {
    fn new(phase: f64) -> Self {
        if phase.abs() == PI {
            // The nearest float to π stands for π.
            return Self { sine: 0.0, cosine: -1.0, s: 1.0, complement: 0.0 };
        }
        let ((sine, cosine), (half_sine, half_cosine)) = (phase.sin_cos(), (0.5 * phase).sin_cos());
        Self { sine, cosine, s: half_sine * half_sine, complement: half_cosine * half_cosine }
    }

    fn at(&self, part: &Factored<f64>) -> f64 {
        if part.series.is_zero() {
            return 0.0;
        }
        self.factor(part) * part.series.at_cosine(self.cosine)
    }

    fn factor(&self, part: &Factored<f64>) -> f64 {
        self.s.powi(part.s_power) * self.complement.powi(part.complement_power)
    }
}

#[cfg(test)]
mod tests;
