//! The coefficients of `χ` in powers of the one parameter that has no value.

use super::{AxisFactor, CompiledStep, CompiledTerm};
use num_complex::Complex64;

impl CompiledStep {
    /// The lowest power of the first parameter in any coefficient, and how many powers there are from it on.
    pub(crate) fn parameter_powers(&self) -> (i32, usize) {
        let powers = || self.powers.iter().flatten().map(parameter_power);
        let (lowest, highest) = (powers().min().unwrap_or(0), powers().max().unwrap_or(0));
        (lowest, (highest - lowest + 1) as usize)
    }

    /// `[b_0, b_1, …]` of `χ(1 + y)` where the first parameter `p` is the only one, each in powers of it, over its lowest power: adds up
    /// `b_j = Σ_m p^m values[j][m]`.
    pub(crate) fn coefficients_in_parameter(&self, phase: &[f64], values: &mut [Complex64]) {
        let wave = self.wave(phase);
        let (lowest, count) = self.parameter_powers();
        let letters: Vec<f64> =
            self.letters.iter().map(|letter| letter.at_cosine(wave[0].cosine)).collect();
        values.fill(Complex64::ZERO);
        for (terms, values) in self.powers.iter().zip(values.chunks_exact_mut(count)) {
            for term in terms {
                let factors = term.letters.iter().map(|&(index, power)| letters[index].powi(power));
                let sum: Complex64 = term.parts.iter().map(|part| part.at(&wave)).sum();
                values[(parameter_power(term) - lowest) as usize] += sum * factors.product::<f64>();
            }
        }
    }

    /// The coefficient of `y` where `χ(1 + y) = b_0 + b_1 y` with `b_1` the same for all waves and values: an explicit scheme for one
    /// unknown between two levels.
    pub(crate) fn one_step_divisor(&self) -> Option<f64> {
        let [_, leading] = self.powers.as_slice() else { return None };
        let [term] = leading.as_slice() else { return None };
        let ([part], true, true) =
            (term.parts.as_slice(), term.parameters.is_empty(), term.letters.is_empty())
        else {
            return None;
        };
        let [value] = part.series.values.as_slice() else { return None };
        let plain =
            |axis: &AxisFactor| !axis.odd && axis.s_power == 0 && axis.complement_power == 0;
        part.axes.iter().all(plain).then_some(*value)
    }
}

fn parameter_power(term: &CompiledTerm) -> i32 {
    term.parameters.iter().find(|(index, _)| *index == 0).map_or(0, |&(_, power)| power)
}
