//! The extremes over all waves of the largest multiplier of any step, by samples: for several multipliers and implicit schemes, where
//! [`Envelope`](super::envelope::Envelope) does not serve.
//!
//! The coefficients of `χ` are tabulated on the waves once, in powers of the parameter; the roots are taken for eight values together. A
//! sampled extremum is refined by parabolas and golden sections: the largest modulus has corners where two multipliers exchange places.

use super::CompiledStep;
use super::envelope::{Extreme, LANES};
use super::roots::roots;
use crate::golden_section::golden_section;
use num_complex::Complex64;
use std::f64::consts::PI;

mod largest_root;
mod on_torus;
mod table;

pub(crate) use on_torus::extremes_on_torus;
use table::Table;

/// Samples for each half-wave of the coefficients, and at least.
const SAMPLES_PER_HALF_WAVE: usize = 16;
const LEAST_SAMPLES: usize = 128;

/// Sampled extrema that far from the best one, as a part of the range, are refined.
const SLACK: f64 = 0.02;

/// Samples that differ by no more are one plateau: multipliers on the circle are there to about this.
const PLATEAU: f64 = 1e-13;

/// Evaluations of one refinement at most, and the step, in sample spacings, below which the parabola's vertex counts as found.
const MOST_EVALUATIONS: usize = 60;
const FLAT: f64 = 2e-5;

/// Golden sections stop at this width, in radians.
const RESOLUTION: f64 = 1e-13;

/// Where the neighbours must be for that, in sample spacings.
const CLOSE: f64 = 0.02;

/// A step prepared for many values of the one parameter that is free.
pub(crate) struct SampledGain<'a> {
    compiled: &'a CompiledStep,
    phases: Vec<f64>,
    table: Table,
}

/// A value at a phase, negated where the smallest is sought.
type Point = (f64, f64);

impl<'a> SampledGain<'a> {
    pub(crate) fn new(compiled: &'a CompiledStep) -> Self {
        let cells = (SAMPLES_PER_HALF_WAVE * compiled.span()).max(LEAST_SAMPLES);
        let phases: Vec<f64> = (0..=cells)
            .map(|index| if index == cells { PI } else { index as f64 * PI / cells as f64 })
            .collect();
        let table = Table::new(compiled, phases.iter().map(std::slice::from_ref));
        Self { compiled, phases, table }
    }

    /// The largest and the smallest `|z|² − 1` of the largest multiplier.
    pub(crate) fn extremes(&self, parameters: &[f64]) -> Vec<[Extreme; 2]> {
        let mut extremes = Vec::with_capacity(parameters.len());
        for columns in parameters.chunks(LANES) {
            let samples = self.table.excess(columns);
            for (lane, &parameter) in columns.iter().enumerate() {
                let sampled = |sign: f64| samples.iter().map(move |value| sign * value[lane]);
                extremes.push([1.0, -1.0].map(|sign| {
                    let found = self.refined(parameter, sign, &sampled(sign).collect::<Vec<_>>());
                    Extreme { value: sign * found.0, phase: found.1 }
                }));
            }
        }
        extremes
    }

    /// `sign (|z|² − 1)` of the largest multiplier of any wave.
    fn at(&self, parameter: f64, sign: f64, phase: f64) -> Point {
        (sign * self.table.excess_at(self.compiled, parameter, &[phase]), phase)
    }

    /// The smallest gain about a phase where it nearly vanishes: the modulus has a corner there, which golden sections find to more
    /// digits than the parabola of its square.
    pub(crate) fn corner_about(&self, parameter: f64, phase: f64) -> f64 {
        let gain = |phase: f64| {
            let multipliers = self.compiled.multipliers(&[parameter], &[phase]);
            multipliers.iter().map(|z| z.norm()).fold(0.0, f64::max)
        };
        let width = CLOSE * self.phases[1];
        let around = [phase - width, phase + width];
        let (best, _) = golden_section(|phase| -gain(phase), around, RESOLUTION);
        gain(phase).min(-best)
    }

    /// The largest value, from the samples.
    fn refined(&self, parameter: f64, sign: f64, samples: &[f64]) -> Point {
        let at = |phase: f64| self.at(parameter, sign, phase);
        let (first, best) = samples
            .iter()
            .enumerate()
            .fold((0, f64::NEG_INFINITY), |best, (i, &v)| if v > best.1 { (i, v) } else { best });
        let mut found = at(self.phases[first]);
        let lowest = samples.iter().copied().fold(f64::INFINITY, f64::min);
        let noise = PLATEAU * (1.0 + best.abs());
        if best - lowest <= noise || !best.is_finite() || lowest.is_nan() {
            return found;
        }
        let threshold = best - SLACK * (best - lowest);
        let last = samples.len() - 1;
        for index in 0..=last {
            // The function is even about both ends, so the neighbour beyond an end is its mirror.
            let here = samples[index];
            let left = samples[index.abs_diff(1).min(last)];
            let right = samples[if index == last { last - 1 } else { index + 1 }];
            let plateau = here - left.min(right) <= noise;
            if here < threshold || here < left || here < right || plateau {
                continue;
            }
            let candidate = if index == 0 || index == last {
                self.near_end(&at, at(self.phases[index]))
            } else {
                let around = [index - 1, index, index + 1].map(|i| self.phases[i]);
                // Where two multipliers exchange places the largest has a corner, which parabolas take for found too early.
                let corner = if sign < 0.0 {
                    golden_section(|phase| at(phase).0, [around[0], around[2]], RESOLUTION)
                } else {
                    (f64::NEG_INFINITY, 0.0)
                };
                let smooth = self.polish(&at, around.map(&at));
                if corner.0 > smooth.0 { corner } else { smooth }
            };
            if candidate.0 > found.0 {
                found = candidate;
            }
        }
        found
    }

    /// The maximum in the cell next to an end of the phase range. The function is even about the end, so
    /// the end is an extremum; but it may be a minimum with maxima inside the cell on both sides.
    fn near_end(&self, at: &impl Fn(f64) -> Point, end: Point) -> Point {
        let spacing = if end.1 > 0.0 { -self.phases[1] } else { self.phases[1] };
        let shares = [0.0, 0.02, 0.1, 0.25, 0.5, 1.0];
        let points =
            shares.map(|share| if share > 0.0 { at(end.1 + share * spacing) } else { end });
        let highest = (1..5).max_by(|&i, &j| points[i].0.total_cmp(&points[j].0)).unwrap_or(1);
        if points[highest].0 <= end.0 {
            return end;
        }
        let mut triple = [points[highest - 1], points[highest], points[highest + 1]];
        if spacing < 0.0 {
            triple.reverse();
        }
        self.polish(at, triple)
    }

    /// The maximum between the two neighbours of a sampled one: parabolic interpolation through a
    /// shrinking bracket, with a golden-section step wherever the parabola does not help.
    fn polish(
        &self,
        at: &impl Fn(f64) -> Point,
        [mut left, mut best, mut right]: [Point; 3],
    ) -> Point {
        let spacing = self.phases[1];
        for _ in 0..MOST_EVALUATIONS {
            let (before, after) = (best.1 - left.1, right.1 - best.1);
            // Vertex of the parabola through the three points.
            let (rise, fall) = (best.0 - left.0, best.0 - right.0);
            let curvature = after * rise + before * fall;
            let mut next =
                best.1 + 0.5 * (after * after * rise - before * before * fall) / curvature;
            let shrinks = next - left.1 > 0.01 * before && right.1 - next > 0.01 * after;
            if (next - best.1).abs() < FLAT * spacing {
                // A vertex that stays where it is, with both neighbours close, has been found. The
                // first parabolas may sit there by chance: their neighbours are far.
                if before.max(after) < 2.0 * CLOSE * spacing {
                    break;
                }
                next = best.1 + if before > after { -CLOSE } else { CLOSE } * spacing;
            } else if !shrinks {
                next = if before > after { best.1 - 0.38 * before } else { best.1 + 0.38 * after };
            }
            let tried = at(next);
            match (tried.0 > best.0, tried.1 > best.1) {
                (true, true) => (left, best) = (best, tried),
                (true, false) => (right, best) = (best, tried),
                (false, true) => right = tried,
                (false, false) => left = tried,
            }
        }
        best
    }
}

/// `|z|² − 1` of the largest root of `Σ_j y^j Σ_m p^m values[j][m]`, `z = 1 + y`; infinite where the leading coefficient vanishes.
pub(super) fn largest_excess(values: &[Complex64], powers: usize, parameter: f64) -> f64 {
    let in_parameter = |values: &[Complex64]| {
        values.iter().rev().fold(Complex64::ZERO, |sum, value| sum * parameter + value)
    };
    let coefficients: Vec<Complex64> = values.chunks_exact(powers).map(in_parameter).collect();
    let excess = |y: Complex64| 2.0 * y.re + y.norm_sqr();
    roots(&coefficients).into_iter().map(excess).fold(-1.0, f64::max)
}

#[cfg(test)]
mod tests;
