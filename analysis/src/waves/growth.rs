//! The wave that grows fastest and the wave that is damped most, at one Courant number.

use crate::stability::margin::{CompiledMargin, growth_from_excess};
use std::f64::consts::PI;

/// An extremum of `|g|` over all phases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremum {
    /// `|g| − 1`, free of cancellation.
    pub growth: f64,
    /// Where it is taken, in radians.
    pub phase: f64,
}

/// The margin of one scheme tabulated on a grid of phases, so that any number of Courant numbers can be
/// looked at in real arithmetic: `1 − |g|² = C^c Σ_j t^j P_j(φ_i)` costs one multiplication and one
/// addition for each phase and power.
#[derive(Debug, Clone)]
pub struct PhaseTable {
    margin: CompiledMargin,
    phases: Vec<f64>,
    /// `[P_0, P_1, …]`, each over all phases.
    powers: Vec<Vec<f64>>,
}

/// Samples for each half-wave of the margin that make the refinement safe: the sampled maximum is then
/// below the true one by less than `(π/16)²/16` of the range.
const SAMPLES_PER_HALF_WAVE: usize = 16;

/// That bound, with a factor 2 to spare.
const SLACK: f64 = 0.005;

const BLOCK: usize = 64;

/// Steps of the refinement at most, and the movement of the vertex (in sample spacings) below which it
/// counts as found: the value is then below the maximum by about the square of this times the second
/// difference of the samples, itself below 2 % of the range.
const MAX_POLISH: usize = 40;
const FLAT: f64 = 2e-5;

/// Where the neighbours must be for that, in sample spacings.
const CLOSE: f64 = 0.02;

impl PhaseTable {
    /// Tabulates a margin (for growth 0) on at least `phases` phases of `[0, π]`, more when the margin
    /// oscillates faster than that can resolve.
    pub fn new(margin: CompiledMargin, phases: usize) -> Self {
        let cells = phases.saturating_sub(1).max(SAMPLES_PER_HALF_WAVE * margin.degree()).max(64);
        let phases: Vec<f64> = (0..=cells)
            .map(|i| if i == cells { PI } else { i as f64 * PI / cells as f64 })
            .collect();
        let mut powers = vec![Vec::with_capacity(phases.len()); margin.powers()];
        let mut values = Vec::new();
        for &phase in &phases {
            margin.powers_at(phase, &mut values);
            let factor = margin.phase_factor(phase);
            for (column, value) in powers.iter_mut().zip(&values) {
                column.push(factor * value);
            }
        }
        Self { margin, phases, powers }
    }

    /// The number of phases.
    pub fn len(&self) -> usize {
        self.phases.len()
    }

    /// Whether there are no phases: never.
    pub fn is_empty(&self) -> bool {
        self.phases.is_empty()
    }

    /// The largest and the smallest `|g|` over `0 ≤ φ ≤ π`; `excess` is scratch space.
    pub fn extrema(&self, courant_number: f64, excess: &mut Vec<f64>) -> (Extremum, Extremum) {
        self.tabulate(courant_number, excess);
        let largest = self.refined(courant_number, excess, 1.0);
        let smallest = self.refined(courant_number, excess, -1.0);
        (largest, smallest)
    }

    /// `|g|² − 1` at every phase.
    fn tabulate(&self, courant_number: f64, excess: &mut Vec<f64>) {
        let (t, scale) =
            (self.margin.parameter(courant_number), -self.margin.courant_factor(courant_number));
        excess.clear();
        match self.powers.as_slice() {
            [] => excess.resize(self.phases.len(), 0.0),
            [first] => excess.extend(first.iter().map(|a| scale * a)),
            [first, second] => {
                excess.extend(first.iter().zip(second).map(|(a, b)| scale * (b * t + a)));
            }
            several => {
                excess.resize(self.phases.len(), 0.0);
                for column in several.iter().rev() {
                    for (sum, value) in excess.iter_mut().zip(column) {
                        *sum = *sum * t + value;
                    }
                }
                excess.iter_mut().for_each(|value| *value *= scale);
            }
        }
    }

    /// The largest value of `sign · excess`, refined between the samples.
    fn refined(&self, courant_number: f64, excess: &[f64], sign: f64) -> Extremum {
        let block_maximum = |block: &[f64]| {
            // Independent lanes, so that the comparison vectorises.
            let mut lanes = [f64::NEG_INFINITY; 8];
            for chunk in block.chunks(8) {
                for (lane, value) in lanes.iter_mut().zip(chunk) {
                    let value = sign * value;
                    *lane = if value > *lane { value } else { *lane };
                }
            }
            lanes.into_iter().fold(f64::NEG_INFINITY, f64::max)
        };
        let maxima: Vec<f64> = excess.chunks(BLOCK).map(block_maximum).collect();
        let best = maxima.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let range = best - excess.iter().fold(f64::INFINITY, |low, value| low.min(sign * value));
        let threshold = best - SLACK * range;
        let mut found = (f64::NEG_INFINITY, 0.0);
        let last = excess.len() - 1;
        for (block, _) in maxima.iter().enumerate().filter(|(_, maximum)| **maximum >= threshold) {
            for index in block * BLOCK..((block + 1) * BLOCK).min(excess.len()) {
                let here = sign * excess[index];
                // The function is even about both ends, so the neighbour beyond an end is its mirror.
                let left = sign * excess[index.abs_diff(1).min(last)];
                let right = sign * excess[if index == last { last - 1 } else { index + 1 }];
                if here < threshold || here < left || here < right {
                    continue;
                }
                let candidate = if index == 0 || index == last {
                    self.near_end(courant_number, sign, (here, self.phases[index]))
                } else {
                    let phases = [index - 1, index, index + 1].map(|i| self.phases[i]);
                    let triple = [left, here, right].into_iter().zip(phases);
                    self.polish(courant_number, sign, triple.collect::<Vec<_>>().as_slice())
                };
                if candidate.0 > found.0 {
                    found = candidate;
                }
            }
        }
        // Adding zero turns a negative zero into a plain one.
        Extremum { growth: growth_from_excess(sign * found.0) + 0.0, phase: found.1 }
    }

    /// The maximum in the cell next to an end of the phase range. The function is even about the end, so
    /// the end is an extremum; but it may be a minimum with maxima inside the cell on both sides.
    fn near_end(&self, courant_number: f64, sign: f64, end: (f64, f64)) -> (f64, f64) {
        let spacing = if end.1 > 0.0 { -self.phases[1] } else { self.phases[1] };
        let inside = |share: f64| {
            let phase = end.1 + share * spacing;
            (-sign * self.margin.at(courant_number, phase), phase)
        };
        let mut points = [0.0, 0.02, 0.1, 0.25, 0.5, 1.0]
            .map(|share| if share > 0.0 { inside(share) } else { end });
        let highest = (1..5).max_by(|&i, &j| points[i].0.total_cmp(&points[j].0)).unwrap_or(1);
        if points[highest].0 <= end.0 {
            return end;
        }
        let triple = &mut points[highest - 1..=highest + 1];
        if spacing < 0.0 {
            triple.reverse();
        }
        self.polish(courant_number, sign, triple)
    }

    /// The maximum between the two neighbours of a sampled one: parabolic interpolation through a
    /// shrinking bracket, with a golden-section step wherever the parabola does not help.
    fn polish(&self, courant_number: f64, sign: f64, triple: &[(f64, f64)]) -> (f64, f64) {
        let at = |phase: f64| (-sign * self.margin.at(courant_number, phase), phase);
        let spacing = self.phases[1];
        let (mut left, mut best, mut right) = (triple[0], triple[1], triple[2]);
        for _ in 0..MAX_POLISH {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{Rational, integer, ratio};
    use crate::exact::rational::{from_f64, to_f64};
    use crate::exact::stencil::Stencil;
    use crate::kernel::Kernel;
    use crate::scheme::testing::{SPH, sph};
    use proptest::prelude::*;

    /// The scheme tabulated, and its coefficients at one Courant number.
    fn at(
        scheme: &str,
        kernel: Kernel,
        ratio: &Rational,
        courant_number: f64,
    ) -> (PhaseTable, Stencil<f64>) {
        let step = sph(scheme, kernel, ratio);
        let margin = step.gain_margin("C", &integer(0)).unwrap().unwrap();
        let value = from_f64(courant_number).unwrap();
        let stencil = step.one_step("C").unwrap().stencil_at(&value).map(to_f64);
        (PhaseTable::new(margin.compile(), 100), stencil)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn extrema_are_within_1e_10_of_the_densely_sampled_ones(
            numerator in 5i64..60, courant_number in 0.01f64..8.0, scheme in 0usize..3
        ) {
            for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
                let (table, gain) = at(SPH[scheme], kernel, &ratio(numerator, 10), courant_number);
                let (largest, smallest) = table.extrema(courant_number, &mut Vec::new());
                let (mut high, mut low) = (0.0f64, f64::INFINITY);
                for i in 0..=4000 {
                    let modulus = gain.at_phase(f64::from(i) * PI / 4000.0).norm();
                    (high, low) = (high.max(modulus), low.min(modulus));
                }
                let scale = 1e-10 * high.max(1.0);
                // Dense samples cannot exceed the extrema, and miss them by at most the curvature.
                prop_assert!(high <= 1.0 + largest.growth + scale);
                // Squares: near a zero of g the margin 1 − |g|² has no more digits than that.
                prop_assert!(low.powi(2) >= (1.0 + smallest.growth).powi(2) - scale * high);
                let direct = gain.at_phase(largest.phase).norm();
                prop_assert!((direct - 1.0 - largest.growth).abs() < scale);
                // |d²|g|²/dφ²| ≤ n² max|g|² with n ≤ 2·3·6 offsets; half the dense spacing squared.
                prop_assert!(1.0 + largest.growth <= high + high * 40f64.powi(2) * (PI / 8000.0).powi(2));
            }
        }
    }

    #[test]
    fn a_minimum_inside_the_first_cell_is_found() {
        // Lax–Wendroff SPH, Gaussian, ratio 1: |g| is smallest at a phase below the first sample.
        for courant_number in [2.917_108_763_299_729_5, 2.965_494_334_501_877_4] {
            let (table, gain) =
                at("lax-wendroff-sph", Kernel::Gaussian, &integer(1), courant_number);
            let (_, smallest) = table.extrema(courant_number, &mut Vec::new());
            let dense = (0..=4000)
                .map(|i| gain.at_phase(f64::from(i) * PI / 4000.0).norm())
                .fold(f64::INFINITY, f64::min);
            assert!(1.0 + smallest.growth <= dense + 1e-10, "{smallest:?} {dense}");
        }
    }
}
