//! What one step does to each wave: the multipliers, in `f64`.

use super::roots::roots;
use super::wave_terms::{WavePart, WaveTerm, difference_terms, primitive_characteristic};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::laurent::Variable;
use crate::exact::rational::quotient_to_f64;
use crate::exact::torus_series::DenseSeries;
use crate::scheme::{SchemeError, Step};
use num_bigint::BigInt;
use num_complex::Complex64;
use num_traits::One;
use std::f64::consts::PI;

mod errors;
mod one_parameter;
mod slopes;

pub use errors::WavePolynomial;

/// A [`Step`] in `f64`: the coefficients of `χ(z)` for any wave and any values of the parameters that are free.
///
/// ```
/// use courant_analysis::scheme::Step;
/// let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?.compile()?;
/// // z − 1/z = −2 i C sin φ: two waves on the circle.
/// let z = leapfrog.multipliers(&[0.5], &[1.0]);
/// assert!(z.iter().all(|z| (z.norm() - 1.0).abs() < 1e-15 && (z.im + 0.5 * 1f64.sin()).abs() < 1e-15));
/// // In two dimensions a wave has two phases: 1 − r (4 sin²(φ_x/2) + 4 sin²(φ_y/2)).
/// let heat = "u[n+1,i,j] = u[n,i,j] + r*(u[n,i+1,j] + u[n,i-1,j] + u[n,i,j+1] + u[n,i,j-1] - 4*u[n,i,j])";
/// let y = Step::from_text(heat)?.compile()?.differences(&[0.25], &[1e-9, 2e-9])[0];
/// assert!((y.re / -1.25e-18 - 1.0).abs() < 1e-14);
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct CompiledStep {
    dimension: usize,
    parameters: Vec<String>,
    letters: Vec<CosineSeries<f64>>,
    /// By the power of `y = z − 1`.
    powers: Vec<Vec<CompiledTerm>>,
}

#[derive(Debug, Clone)]
struct CompiledTerm {
    parameters: Vec<(usize, i32)>,
    letters: Vec<(usize, i32)>,
    parts: Vec<CompiledPart>,
}

/// A [`WavePart`], its axes those there are.
#[derive(Debug, Clone)]
struct CompiledPart {
    axes: Vec<AxisFactor>,
    series: DenseSeries<f64>,
}

/// `(i sin φ)^{0 or 1} s^p (1 − s)^q` of one axis.
#[derive(Debug, Clone, Copy)]
struct AxisFactor {
    odd: bool,
    s_power: i32,
    complement_power: i32,
}

impl Step {
    /// Prepared for waves in `f64`.
    ///
    /// # Errors
    /// When there is no characteristic polynomial.
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
        let parts = terms.iter().flatten().flat_map(|term| &term.parts);
        let numbers = parts.flat_map(|part| part.series.terms().map(|(_, value)| value));
        let scale = BigInt::one() << numbers.map(BigInt::bits).max().unwrap_or(0);
        let compiled = |term: &WaveTerm| {
            let of = |known: &dyn Fn(Variable) -> Option<usize>| -> Vec<(usize, i32)> {
                let names = term.names.iter();
                names.filter_map(|&(name, power)| Some((known(name)?, power))).collect()
            };
            let part = |part: &WavePart| CompiledPart {
                axes: (0..step.dimension)
                    .map(|axis| AxisFactor {
                        odd: part.odd[axis],
                        s_power: part.s_powers[axis],
                        complement_power: part.complement_powers[axis],
                    })
                    .collect(),
                series: DenseSeries::new(&part.series, step.dimension, |value| {
                    quotient_to_f64(value, &scale)
                }),
            };
            CompiledTerm {
                parameters: of(&|name| places.iter().position(|place| *place == name)),
                letters: of(&|name| letters.iter().position(|(place, _)| *place == name)),
                parts: term.parts.iter().map(part).collect(),
            }
        };
        Self {
            dimension: step.dimension,
            powers: terms.iter().map(|power| power.iter().map(compiled).collect()).collect(),
            letters: letters.iter().map(|(_, letter)| letter.value.compile()).collect(),
            parameters,
        }
    }

    /// The names of the parameters whose values are to be given, in their order.
    pub fn parameters(&self) -> &[String] {
        &self.parameters
    }

    /// The number of space dimensions: how many phases a wave has.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// How many multipliers a wave has.
    pub fn degree(&self) -> usize {
        self.powers.len() - 1
    }

    /// The largest order of a cosine of one phase among the coefficients: how fast they oscillate over the waves.
    pub fn span(&self) -> usize {
        // Letters are functions of the first phase.
        let letters = |term: &CompiledTerm| -> usize {
            term.letters.iter().map(|&(l, power)| self.letters[l].degree() * power as usize).sum()
        };
        let part = |part: &CompiledPart| {
            let orders = part.axes.iter().zip(&part.series.lengths).map(|(axis, length)| {
                length - 1 + (axis.s_power + axis.complement_power) as usize + usize::from(axis.odd)
            });
            orders.max().unwrap_or(0)
        };
        let terms = self.powers.iter().flatten();
        let spans =
            terms.map(|term| letters(term) + term.parts.iter().map(part).max().unwrap_or(0));
        spans.max().unwrap_or(0)
    }

    /// The multipliers of the wave of these phases, one for each axis: forward ones first, `z ≈ e^{−iωΔt}` with `ω > 0`; of real ones the
    /// largest in modulus first. Infinite where the leading coefficient vanishes, not numbers where all do.
    ///
    /// Errors are those of roundings in the coefficients: about `1e-15` of simple multipliers, the root of that where two meet.
    ///
    /// # Panics
    /// When there are not as many phases as [dimensions](Self::dimension).
    pub fn multipliers(&self, values: &[f64], phase: &[f64]) -> Vec<Complex64> {
        self.differences(values, phase).into_iter().map(|y| y + 1.0).collect()
    }

    /// `z − 1` of the multipliers in the same order, with the digits that a long wave leaves.
    ///
    /// # Panics
    /// When there are not as many phases as [dimensions](Self::dimension).
    pub fn differences(&self, values: &[f64], phase: &[f64]) -> Vec<Complex64> {
        sorted_roots(&self.coefficients(values, &self.wave(phase)))
    }

    fn wave(&self, phase: &[f64]) -> Vec<AxisWave> {
        assert_eq!(phase.len(), self.dimension, "one phase for each axis");
        phase.iter().map(|&phase| AxisWave::new(phase)).collect()
    }

    /// `[b_0, b_1, …]` of `χ(1 + y)`, up to a factor.
    fn coefficients(&self, values: &[f64], wave: &[AxisWave]) -> Vec<Complex64> {
        let letters: Vec<f64> =
            self.letters.iter().map(|letter| letter.at_cosine(wave[0].cosine)).collect();
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
                        term.parts.iter().map(|part| part.at(wave)).sum::<Complex64>() * factor
                    })
                    .sum();
                // Without the sign of zero.
                sum + Complex64::ZERO
            })
            .collect()
    }
}

fn sorted_roots(coefficients: &[Complex64]) -> Vec<Complex64> {
    let mut found = roots(coefficients);
    let modulus = |y: &Complex64| (y + 1.0).norm();
    found.sort_by(|a, b| {
        let sides = a.im.total_cmp(&b.im);
        sides.then(modulus(b).total_cmp(&modulus(a))).then(b.re.total_cmp(&a.re))
    });
    found
}

impl CompiledPart {
    fn at(&self, wave: &[AxisWave]) -> Complex64 {
        let value = self.factor(wave) * self.series.at_cosines(&|axis| wave[axis].cosine);
        let odd = self.axes.iter().zip(wave).filter(|(axis, _)| axis.odd);
        odd.fold(Complex64::from(value), |value, (_, wave)| {
            // Times i sin φ.
            Complex64::new(-(wave.sine * value.im), wave.sine * value.re)
        })
    }

    /// What stands outside of the series, but for the sines.
    fn factor(&self, wave: &[AxisWave]) -> f64 {
        let axes = self.axes.iter().zip(wave);
        let factors = axes.map(|(axis, wave)| {
            wave.s.powi(axis.s_power) * wave.complement.powi(axis.complement_power)
        });
        factors.product()
    }
}

/// A phase with what is computed of it once.
#[derive(Debug, Clone, Copy)]
struct AxisWave {
    sine: f64,
    cosine: f64,
    s: f64,
    complement: f64,
}

impl AxisWave {
    fn new(phase: f64) -> Self {
        if phase.abs() == PI {
            // The nearest float to π stands for π.
            return Self { sine: 0.0, cosine: -1.0, s: 1.0, complement: 0.0 };
        }
        let ((sine, cosine), (half_sine, half_cosine)) = (phase.sin_cos(), (0.5 * phase).sin_cos());
        Self { sine, cosine, s: half_sine * half_sine, complement: half_cosine * half_cosine }
    }
}

#[cfg(test)]
mod tests;
