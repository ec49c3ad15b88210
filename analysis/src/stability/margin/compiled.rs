//! The stability margin in `f64`, and growth without cancellation.

use super::{Margin, degree};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::rational::{quotient_to_f64, ratio, to_f64};
use num_bigint::BigInt;
use pulp::{Arch, Simd, WithSimd};

/// [`Margin`] in `f64`. Near `φ = 0` it has no cancellation: the small factor stands outside.
#[derive(Debug, Clone)]
pub struct CompiledMargin {
    series: Vec<CosineSeries<f64>>,
    phase_power: i32,
    complement_power: i32,
    neutral_waves: CosineSeries<f64>,
    courant_power: i32,
    stride: i32,
    budget: f64,
}

impl Margin {
    /// The numeric form, each coefficient correctly rounded.
    pub fn compile(&self) -> CompiledMargin {
        let rounded = |value: &BigInt| quotient_to_f64(value, &self.denominator);
        CompiledMargin {
            series: self.series.iter().map(|series| series.map(rounded)).collect(),
            phase_power: self.phase_power as i32,
            complement_power: self.complement_power as i32,
            neutral_waves: {
                let degree = self.neutral_waves.degree().unwrap_or(0);
                let scale = ratio(1, 4).pow(degree as i32);
                CosineSeries::from_powers_of_s(&self.neutral_waves, degree)
                    .map(|value| to_f64(&(value * &scale)))
            },
            courant_power: self.courant_power as i32,
            stride: self.stride as i32,
            budget: (1.0 + to_f64(&self.growth)).powi(2),
        }
    }
}

impl CompiledMargin {
    /// `[p_0(φ), p_1(φ), …]` written into `values`; `phase` in radians.
    pub fn powers_at(&self, phase: f64, values: &mut Vec<f64>) {
        let cosine = phase.cos();
        values.clear();
        values.extend(self.series.iter().map(|series| series.at_cosine(cosine)));
    }

    /// [`powers_at`](Self::powers_at) many phases: `[phase][power]`.
    pub(crate) fn powers_on(&self, phases: &[f64]) -> Vec<f64> {
        let powers = self.powers();
        let mut values = vec![0.0; phases.len() * powers];
        Arch::new().dispatch(Sampling { series: &self.series, phases, values: &mut values });
        values
    }

    /// The sum of the moduli of all terms: what rounding errors of [`powers_at`](Self::powers_at) put together at `t` are a part of.
    pub(crate) fn size_at(&self, parameter: f64) -> f64 {
        let moduli =
            |series: &CosineSeries<f64>| series.coefficients().iter().map(|r| r.abs()).sum();
        self.series.iter().rev().fold(0.0, |sum, series| {
            let moduli: f64 = moduli(series);
            sum * parameter + moduli
        })
    }

    /// The factor `s^a (1 − s)^b H²`.
    pub fn phase_factor(&self, phase: f64) -> f64 {
        let (sine, cosine) = (0.5 * phase).sin_cos();
        let factor = sine.powi(2 * self.phase_power) * cosine.powi(2 * self.complement_power);
        match self.neutral_waves.coefficients() {
            [_one] => factor,
            _ => factor * self.neutral_waves.at_cosine(phase.cos()).powi(2),
        }
    }

    /// The factor `C^c`.
    pub fn courant_factor(&self, courant_number: f64) -> f64 {
        courant_number.powi(self.courant_power)
    }

    /// `t = C^stride`.
    pub fn parameter(&self, courant_number: f64) -> f64 {
        courant_number.powi(self.stride)
    }

    /// The number of powers of `t`.
    pub fn powers(&self) -> usize {
        self.series.len()
    }

    /// The degree in `cos φ`.
    pub fn degree(&self) -> usize {
        degree(&self.series)
    }

    /// `(1 + ε)² − |g(φ)|²`.
    pub fn at(&self, courant_number: f64, phase: f64) -> f64 {
        let (cosine, parameter) = (phase.cos(), self.parameter(courant_number));
        let sum = self
            .series
            .iter()
            .rev()
            .fold(0.0, |sum, series| sum * parameter + series.at_cosine(cosine));
        self.phase_factor(phase) * self.courant_factor(courant_number) * sum
    }

    /// `|g| − 1` without cancellation.
    pub fn growth(&self, courant_number: f64, phase: f64) -> f64 {
        growth_from_excess(self.budget - 1.0 - self.at(courant_number, phase))
    }
}

struct Sampling<'a> {
    series: &'a [CosineSeries<f64>],
    phases: &'a [f64],
    values: &'a mut [f64],
}

impl WithSimd for Sampling<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (lanes, powers) = (S::F64_LANES, self.series.len());
        let cosines: Vec<f64> = self.phases.iter().map(|phase| phase.cos()).collect();
        let mut sums = vec![0.0; lanes];
        // By index: adapters of iterators are not always inlined into code for a wider processor.
        for first in (0..cosines.len()).step_by(lanes) {
            let count = lanes.min(cosines.len() - first);
            let cosine = simd.partial_load_f64s(&cosines[first..first + count]);
            let twice = simd.add_f64s(cosine, cosine);
            for power in 0..powers {
                // Clenshaw's recurrence, in the order of `clenshaw`: the bits are the same.
                let (mut last, mut before) = (simd.splat_f64s(0.0), simd.splat_f64s(0.0));
                let [constant, rest @ ..] = self.series[power].coefficients() else { continue };
                for order in (0..rest.len()).rev() {
                    let next = simd.sub_f64s(simd.splat_f64s(rest[order]), before);
                    before = last;
                    last = simd.add_f64s(simd.mul_f64s(twice, last), next);
                }
                let constant = simd.sub_f64s(simd.splat_f64s(*constant), before);
                let sum = simd.add_f64s(simd.mul_f64s(cosine, last), constant);
                simd.partial_store_f64s(&mut sums, sum);
                for (lane, sum) in sums[..count].iter().enumerate() {
                    self.values[(first + lane) * powers + power] = *sum;
                }
            }
        }
    }
}

/// `√(1 + x) − 1` without cancellation: `|g| − 1` from `x = |g|² − 1`.
pub fn growth_from_excess(excess: f64) -> f64 {
    let excess = excess.max(-1.0);
    excess / (1.0 + (1.0 + excess).sqrt())
}
