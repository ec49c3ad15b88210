//! How far computed multipliers may be off.

use super::{AxisWave, CompiledStep, CompiledTerm, sorted_roots};
use crate::waves::roots::roots;
use num_complex::Complex64;

/// Roundings of the longest chain of operations behind a coefficient, for each axis.
const ROUNDINGS: f64 = 6.0;

/// `χ(1 + y) = Σ_j b_j y^j` of one wave, up to a factor, and what rounding may have left in it.
#[derive(Debug, Clone)]
pub struct WavePolynomial {
    coefficients: Vec<Complex64>,
    /// What was added up to each, in absolute values.
    sizes: Vec<f64>,
}

impl WavePolynomial {
    /// The [multipliers](CompiledStep::multipliers), each with a bound on the error that rounding the coefficients of `χ` has left in it.
    ///
    /// A polynomial whose value at `y` is below `η` has a root within `min_m (C(n, m) η m!/|χ⁽ᵐ⁾(y)|)^{1/m}` of it (Henrici 1974,
    /// chapter 6): about `η` for a simple root, the m-th root of that where m roots meet.
    pub fn multipliers(&self) -> Vec<(Complex64, f64)> {
        let differences = sorted_roots(&self.coefficients).into_iter();
        differences.map(|y| (y + 1.0, root_error(&self.coefficients, &self.sizes, y))).collect()
    }

    /// `χ(z)`, and a bound on its error.
    pub fn at(&self, z: Complex64) -> (Complex64, f64) {
        derivative(&self.coefficients, &self.sizes, z - 1.0, 0)
    }
}

impl CompiledStep {
    /// The characteristic polynomial of the wave of these phases.
    ///
    /// # Panics
    /// When there are not as many phases as [dimensions](Self::dimension).
    pub fn polynomial(&self, values: &[f64], phase: &[f64]) -> WavePolynomial {
        let wave = self.wave(phase);
        let coefficients = self.coefficients(values, &wave);
        WavePolynomial { coefficients, sizes: self.sizes(values, &wave) }
    }

    /// In one dimension, `|z|² − 1` of the largest multiplier of the wave with this `s = sin²(φ/2)` and `1 − s`, and a bound on its error, where no
    /// parameter is free; infinite where it is not known at all.
    pub(crate) fn largest_excess(&self, s: f64, complement: f64) -> (f64, f64) {
        let sine = 2.0 * (s * complement).sqrt();
        let wave = [AxisWave { sine, cosine: complement - s, s, complement }];
        let (coefficients, sizes) = (self.coefficients(&[], &wave), self.sizes(&[], &wave));
        let (mut largest, mut most) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for y in roots(&coefficients) {
            let moved = root_error(&coefficients, &sizes, y);
            let excess = 2.0 * y.re + y.norm_sqr();
            let high = excess + (2.0 * (y + 1.0).norm() + moved) * moved;
            if !high.is_finite() {
                return (0.0, f64::INFINITY);
            }
            (largest, most) = (largest.max(excess), most.max(high));
        }
        (largest, most - largest)
    }

    /// What is added up to each coefficient, in absolute values, once for each axis.
    fn sizes(&self, values: &[f64], wave: &[AxisWave]) -> Vec<f64> {
        let sum = |coefficients: &[f64]| coefficients.iter().map(|c| c.abs()).sum::<f64>();
        let letters: Vec<f64> =
            self.letters.iter().map(|letter| sum(letter.coefficients())).collect();
        let term = |term: &CompiledTerm| -> f64 {
            let parameters = term.parameters.iter().map(|&(p, power)| values[p].abs().powi(power));
            let letters = term.letters.iter().map(|&(letter, power)| letters[letter].powi(power));
            let parts = term.parts.iter();
            let parts = parts.map(|part| part.factor(wave) * sum(&part.series.values));
            parameters.chain(letters).product::<f64>() * parts.sum::<f64>()
        };
        let axes = self.dimension as f64;
        self.powers.iter().map(|terms| axes * terms.iter().map(term).sum::<f64>()).collect()
    }
}

/// `Σ_j C(j, m) b_j y^{j−m}`, and its round-off.
fn derivative(
    coefficients: &[Complex64],
    sizes: &[f64],
    y: Complex64,
    m: usize,
) -> (Complex64, f64) {
    let mut binomial = 1.0;
    let (mut value, mut size) = (Complex64::default(), 0.0);
    let mut power = Complex64::ONE;
    for j in m..coefficients.len() {
        value += coefficients[j] * power * binomial;
        size += sizes[j] * power.norm() * binomial;
        power *= y;
        binomial *= (j + 1) as f64 / (j + 1 - m) as f64;
    }
    (value, ROUNDINGS * f64::EPSILON * size)
}

/// The bound for one root of `Σ_j b_j y^j`.
fn root_error(coefficients: &[Complex64], sizes: &[f64], y: Complex64) -> f64 {
    let degree = coefficients.len() - 1;
    let derivative = |m: usize| derivative(coefficients, sizes, y, m);
    let (_, residual) = derivative(0);
    let mut choices = 1.0;
    let mut least = f64::INFINITY;
    for m in 1..=degree {
        choices *= (degree + 1 - m) as f64 / m as f64;
        let (value, noise) = derivative(m);
        let slope = (value.norm() - noise).max(0.0);
        least = least.min((choices * residual / slope).powf(1.0 / m as f64));
    }
    // The last sums, 1 + y.
    least + f64::EPSILON * (1.0 + y.norm())
}

#[cfg(test)]
mod tests {
    use crate::scheme::Step;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        /// `(u − a)^m` in equations: all m multipliers are a, within their bounds.
        #[test]
        fn known_multiple_roots_lie_within_the_bounds(a in -8i32..9, order in 1usize..4) {
            let a = format!("({a}/7)");
            let terms = ["u[n,j]*A", "u[n,j]*2*A - u[n-1,j]*A^2", "u[n,j]*3*A - u[n-1,j]*3*A^2 + u[n-2,j]*A^3"];
            let text = format!("u[n+1,j] = {}", terms[order - 1].replace('A', &a));
            let value = a[1..a.len() - 3].parse::<f64>().unwrap() / 7.0;
            if value != 0.0 {
                let step = Step::from_text(&text).unwrap().compile().unwrap();
                for (multiplier, error) in step.polynomial(&[], &[0.7]).multipliers() {
                    prop_assert!((multiplier - value).norm() <= error);
                    prop_assert!(error < 30.0 * f64::EPSILON.powf(1.0 / order as f64));
                }
            }
        }
    }

    #[test]
    fn cancellation_in_the_coefficients_is_seen() {
        // z (1 + 0.9 cos φ)³ = 1 loses digits near the shortest wave.
        let text = "a[n,j] = u[n+1,j] + 9/20*(u[n+1,j+1] + u[n+1,j-1])\n\
                    b[n,j] = a[n,j] + 9/20*(a[n,j+1] + a[n,j-1])\n\
                    b[n,j] + 9/20*(b[n,j+1] + b[n,j-1]) = u[n,j]";
        let step = Step::from_text(text).unwrap().compile().unwrap();
        for (phase, least, most) in [(0.5, 1e-16, 1e-13), (3.0, 1e-12, 1e-10)] {
            let exact = (1.0 + 0.9 * f64::cos(phase)).powi(-3);
            let [(multiplier, error)] = step.polynomial(&[], &[phase]).multipliers()[..] else {
                panic!("one multiplier")
            };
            assert!((multiplier.re - exact).abs() <= error);
            assert!((least..most).contains(&(error / exact)), "{phase}: {error} of {exact}");
        }
    }
}
