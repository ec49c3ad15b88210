//! How multipliers change along a direction: the exact derivative of an implicit function.

use super::{AxisFactor, AxisWave, CompiledPart, CompiledStep, CompiledTerm};
use num_complex::Complex64;

impl CompiledStep {
    /// `dz/dm` of the multipliers `z = 1 + y` on the waves `φ = m d`: `−χ_m/χ_z`, with the [differences](Self::differences) `y` of the
    /// wave of these phases. Not finite where two multipliers meet.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// use num_complex::Complex64;
    /// let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?.compile()?;
    /// let y = upwind.differences(&[0.5], &[1.0]);
    /// // z = 1 − C (1 − e^{−iφ}).
    /// let slope = upwind.slopes(&[0.5], &[1.0], &[1.0], &y)[0];
    /// assert!((slope - Complex64::new(0.0, -0.5) * Complex64::cis(-1.0)).norm() < 1e-15);
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Panics
    /// When there are not as many phases or components as [dimensions](Self::dimension).
    pub fn slopes(
        &self,
        values: &[f64],
        phase: &[f64],
        direction: &[f64],
        differences: &[Complex64],
    ) -> Vec<Complex64> {
        assert_eq!(direction.len(), self.dimension, "one component for each axis");
        let coefficients = self.coefficients(values, &self.wave(phase));
        let changes = self.coefficient_slopes(values, phase, direction);
        let horner = |y: &Complex64, of: &mut dyn Iterator<Item = Complex64>| {
            of.fold(Complex64::ZERO, |sum, b| sum * y + b)
        };
        let slope = |y: &Complex64| {
            let by_phase = horner(y, &mut changes.iter().rev().copied());
            let powers = coefficients.iter().enumerate().skip(1).rev();
            let by_root = horner(y, &mut powers.map(|(j, b)| b * j as f64));
            -by_phase / by_root
        };
        differences.iter().map(slope).collect()
    }

    /// `db_j/dm` of the coefficients `b_j` of `χ(1 + y)`, up to the same factor.
    fn coefficient_slopes(
        &self,
        values: &[f64],
        phase: &[f64],
        direction: &[f64],
    ) -> Vec<Complex64> {
        let wave = self.wave(phase);
        // Letters are functions of the first phase: Σ_k r_k cos kφ.
        let letters: Vec<(f64, f64)> = self
            .letters
            .iter()
            .map(|letter| {
                let change = (0..).zip(letter.coefficients()).map(|(k, r)| {
                    let k = f64::from(k);
                    -k * r * (k * phase[0]).sin()
                });
                (letter.at_cosine(wave[0].cosine), direction[0] * change.sum::<f64>())
            })
            .collect();
        let slope = |term: &CompiledTerm| -> Complex64 {
            let parameters: f64 =
                term.parameters.iter().map(|&(index, power)| values[index].powi(power)).product();
            let known = |&(l, power): &(usize, i32)| letters[l].0.powi(power);
            let all: f64 = term.letters.iter().map(known).product();
            let change = |n: usize| {
                let (l, power) = term.letters[n];
                let others = term.letters.iter().enumerate().filter(|(m, _)| *m != n);
                let others: f64 = others.map(|(_, letter)| known(letter)).product();
                f64::from(power) * letters[l].0.powi(power - 1) * letters[l].1 * others
            };
            let change: f64 = (0..term.letters.len()).map(change).sum();
            let parts = term
                .parts
                .iter()
                .map(|part| part.at(&wave) * change + part.slope(&wave, phase, direction) * all);
            parts.sum::<Complex64>() * parameters
        };
        self.powers.iter().map(|terms| terms.iter().map(slope).sum()).collect()
    }
}

impl CompiledPart {
    fn slope(&self, wave: &[AxisWave], phase: &[f64], direction: &[f64]) -> Complex64 {
        let series = self.series.at_cosines(&|axis| wave[axis].cosine);
        let change = self.series.slope(phase, direction);
        let factors: Vec<f64> = self.axes.iter().zip(wave).map(|(a, w)| a.value(w)).collect();
        let along = |axis: usize| {
            let others = factors.iter().enumerate().filter(|(b, _)| *b != axis);
            let others: f64 = others.map(|(_, factor)| factor).product();
            direction[axis] * self.axes[axis].slope(&wave[axis]) * others
        };
        let product: f64 = factors.iter().product();
        let value = product * change + (0..factors.len()).map(along).sum::<f64>() * series;
        // The sines are in the factors; each brings its i.
        Complex64::I.powi(self.axes.iter().filter(|axis| axis.odd).count() as i32) * value
    }
}

impl AxisFactor {
    /// `(sin φ)^{0 or 1} s^p (1 − s)^q`.
    fn value(&self, wave: &AxisWave) -> f64 {
        let even = wave.s.powi(self.s_power) * wave.complement.powi(self.complement_power);
        if self.odd { wave.sine * even } else { even }
    }

    /// Its derivative, with `ds/dφ = sin φ/2`.
    fn slope(&self, wave: &AxisWave) -> f64 {
        let AxisWave { sine, cosine, s, complement } = *wave;
        let (p, q) = (self.s_power, self.complement_power);
        let lowered = |base: f64, power: i32| match power {
            0 => 0.0,
            _ => f64::from(power) * base.powi(power - 1),
        };
        let even =
            0.5 * sine * (lowered(s, p) * complement.powi(q) - s.powi(p) * lowered(complement, q));
        if self.odd { sine * even + cosine * s.powi(p) * complement.powi(q) } else { even }
    }
}

#[cfg(test)]
mod tests {
    use crate::exact::rational::ratio;
    use crate::kernel::Kernel;
    use crate::scheme::{KernelLattice, catalogue};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        /// Every scheme of the catalogue, with kernels, of any dimension: against differences of the multipliers.
        #[test]
        fn slopes_are_those_of_differences(
            which in 0usize..400, phases in prop::array::uniform3(0.3f64..2.8), turn in 0.1f64..1.4,
        ) {
            let file = &catalogue::schemes()[which % catalogue::schemes().len()];
            let lattice = KernelLattice::new(Kernel::CubicSpline, &ratio(3, 2)).unwrap();
            let mut step = file.step(file.needs_kernel().then_some(&lattice), None, &[], None).unwrap();
            for name in step.free_parameters() {
                step = step.with(&name, &ratio(2, 7)).unwrap();
            }
            let compiled = step.compile().unwrap();
            let phases = &phases[..step.dimension()];
            let direction = &[turn.cos(), turn.sin(), 0.3][..step.dimension()];
            let at = |h: f64| {
                let wave: Vec<f64> = phases.iter().zip(direction).map(|(p, d)| p + h * d).collect();
                compiled.differences(&[], &wave)
            };
            let (here, h) = (at(0.0), 1e-6);
            let nearest = |roots: &[num_complex::Complex64], y: num_complex::Complex64| {
                *roots.iter().min_by(|a, b| (*a - y).norm().total_cmp(&(*b - y).norm())).unwrap()
            };
            let (before, after) = (at(-h), at(h));
            for (y, slope) in here.iter().zip(compiled.slopes(&[], phases, direction, &here)) {
                let others = here.iter().filter(|other| (*other - y).norm() < 1e-2).count();
                if others > 1 { continue; }
                let differ = (nearest(&after, *y) - nearest(&before, *y)) / (2.0 * h);
                prop_assert!((slope - differ).norm() < 1e-5 * (1.0 + slope.norm()), "{}: {slope} {differ}", file.name);
            }
        }
    }
}
