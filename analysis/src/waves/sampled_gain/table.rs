//! The coefficients of `χ` on many waves, in powers of the parameter, and the largest root there for several values together.

use super::super::CompiledStep;
use super::super::envelope::{LANES, Lanes};
use super::largest_excess;
use super::largest_root::LargestRoots;
use num_complex::Complex64;
use pulp::{Arch, Simd, WithSimd};

/// Waves with their coefficients.
pub(super) struct Table {
    /// `[wave][j][power]` for `χ(1 + y) = Σ_j b_j y^j`.
    coefficients: Vec<Complex64>,
    degree: usize,
    powers: usize,
}

impl Table {
    pub(super) fn new<'a>(
        compiled: &CompiledStep,
        waves: impl ExactSizeIterator<Item = &'a [f64]>,
    ) -> Self {
        let (degree, (_, powers)) = (compiled.degree(), compiled.parameter_powers());
        let width = powers * (degree + 1);
        let mut coefficients = vec![Complex64::ZERO; waves.len() * width];
        for (wave, values) in waves.zip(coefficients.chunks_exact_mut(width)) {
            compiled.coefficients_in_parameter(wave, values);
        }
        Self { coefficients, degree, powers }
    }

    /// `|z|² − 1` of the largest multiplier of any other wave of the same step.
    pub(super) fn excess_at(&self, compiled: &CompiledStep, parameter: f64, wave: &[f64]) -> f64 {
        let mut values = vec![Complex64::ZERO; self.powers * (self.degree + 1)];
        compiled.coefficients_in_parameter(wave, &mut values);
        largest_excess(&values, self.powers, parameter)
    }

    /// `|z|² − 1` of the largest multiplier of every wave, for up to so many values of the parameter; the last one fills up.
    pub(super) fn excess(&self, parameters: &[f64]) -> Vec<Lanes> {
        let t: Lanes = std::array::from_fn(|lane| parameters[lane.min(parameters.len() - 1)]);
        debug_assert!(parameters.len() <= LANES);
        Arch::new().dispatch(Excess { samples: self, t: &t })
    }
}

struct Excess<'a> {
    samples: &'a Table,
    t: &'a Lanes,
}

impl WithSimd for Excess<'_> {
    type Output = Vec<Lanes>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Table { coefficients, degree, powers } = self.samples;
        let mut roots = LargestRoots::new(*degree);
        let waves = coefficients.chunks_exact(powers * (degree + 1));
        waves.map(|wave| roots.excess(wave, *powers, self.t)).collect()
    }
}
