//! The extremes of the largest multiplier over the waves of two and three dimensions, by samples that are refined.

use super::super::CompiledStep;
use super::super::envelope::{LANES, Lanes};
use super::super::torus_growth::half_of_all_waves;
use super::{LargestRoots, largest_excess};
use num_complex::Complex64;
use pulp::Arch;
use std::f64::consts::TAU;

/// Samples along an axis for each order of a cosine; at least and at most, by dimension.
const SAMPLES: usize = 6;
const FEWEST: [usize; 3] = [64, 24, 12];
const MOST: [usize; 3] = [512, 64, 16];

/// Steps of the refinement end at this share of the first one: the value is then wrong by the square of it.
const FINE: f64 = 1e-5;

/// Rounds about all neighbours of one refinement at most.
const MOST_PASSES: usize = 80;

/// The largest and the smallest `|z|² − 1` of the largest multiplier, for each value of the one parameter that is free.
pub(crate) fn extremes_on_torus(compiled: &CompiledStep, parameters: &[f64]) -> Vec<[f64; 2]> {
    let (_, powers) = compiled.parameter_powers();
    let (width, at) = (powers * (compiled.degree() + 1), compiled.dimension() - 1);
    let steps = (SAMPLES * compiled.span()).clamp(FEWEST[at], MOST[at]) & !1;
    let phases: Vec<Vec<f64>> = half_of_all_waves(compiled.dimension(), steps).collect();
    let mut coefficients = vec![Complex64::ZERO; phases.len() * width];
    for (phase, values) in phases.iter().zip(coefficients.chunks_exact_mut(width)) {
        compiled.coefficients_in_parameter(phase, values);
    }
    let mut extremes = Vec::with_capacity(parameters.len());
    for columns in parameters.chunks(LANES) {
        let t: Lanes = std::array::from_fn(|lane| columns[lane.min(columns.len() - 1)]);
        let samples: Vec<Lanes> = Arch::new().dispatch(
            #[inline(always)]
            || {
                let mut roots = LargestRoots::new(compiled.degree());
                coefficients
                    .chunks_exact(width)
                    .map(|node| roots.excess(node, powers, &t))
                    .collect()
            },
        );
        for (lane, &parameter) in columns.iter().enumerate() {
            extremes.push([1.0, -1.0].map(|sign| {
                let value = |index: &usize| sign * samples[*index][lane];
                let best = (0..samples.len()).max_by(|a, b| value(a).total_cmp(&value(b)));
                let start = &phases[best.unwrap_or(0)];
                let mut values = vec![Complex64::ZERO; width];
                let at = |phase: &[f64]| {
                    compiled.coefficients_in_parameter(phase, &mut values);
                    sign * largest_excess(&values, powers, parameter)
                };
                sign * refined(at, start.clone(), TAU / steps as f64)
            }));
        }
    }
    extremes
}

/// The maximum about a sampled one, by ever smaller steps along the axes and diagonals.
fn refined(mut at: impl FnMut(&[f64]) -> f64, mut phase: Vec<f64>, spacing: f64) -> f64 {
    let (mut best, mut step) = (at(&phase), 0.5 * spacing);
    let directions = 3usize.pow(phase.len() as u32);
    // Roundings can be climbed for ever.
    for _ in 0..MOST_PASSES {
        if step <= FINE * spacing {
            break;
        }
        let mut moved = false;
        for direction in 1..directions {
            let sign = |axis: usize| [0.0, 1.0, -1.0][direction / 3usize.pow(axis as u32) % 3];
            let to = |(axis, x): (usize, &f64)| x + sign(axis) * step;
            let tried: Vec<f64> = phase.iter().enumerate().map(to).collect();
            let value = at(&tried);
            if value > best {
                (best, phase, moved) = (value, tried, true);
            }
        }
        if !moved {
            step *= 0.4;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use crate::scheme::Step;

    #[test]
    fn extremes_of_known_symbols() {
        // |g| = 1 − 4r(s_x + s_y), from 1 to |1 − 8r|.
        let heat = "u[n+1,i,j] = u[n,i,j] + r*(u[n,i+1,j] + u[n,i-1,j] + u[n,i,j+1] + u[n,i,j-1] - 4*u[n,i,j])";
        let gains = Step::from_text(heat).unwrap().gain_extremes("r", &[0.1, 0.3]).unwrap();
        assert!(gains.growth[0].abs() < 1e-14 && (gains.growth[1] - 0.4).abs() < 1e-12);
        assert!((gains.lowest_gain[0] - 0.2).abs() < 1e-9 && gains.lowest_gain[1] < 1e-4);
        // Leapfrog: z² + 2iaz − 1 with a = C(sin φ_x + sin φ_y), |z| = |a| + √(a² − 1) beyond |a| = 1.
        let leapfrog =
            "u[n+1,i,j] = u[n-1,i,j] - C*(u[n,i+1,j] - u[n,i-1,j]) - C*(u[n,i,j+1] - u[n,i,j-1])";
        let gains = Step::from_text(leapfrog).unwrap().gain_extremes("C", &[0.4, 0.6]).unwrap();
        let expected = 1.2 + (1.2f64 * 1.2 - 1.0).sqrt() - 1.0;
        assert!(gains.growth[0].abs() < 1e-12 && (gains.growth[1] - expected).abs() < 1e-9);
    }
}
