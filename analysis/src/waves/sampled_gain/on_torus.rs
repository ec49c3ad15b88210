//! The extremes of the largest multiplier over the waves of two and three dimensions, by samples that are refined.

use super::super::CompiledStep;
use super::super::compass_search::CompassSearch;
use super::super::envelope::LANES;
use super::super::torus_growth::half_of_all_waves;
use super::Table;
use std::f64::consts::TAU;

/// Samples along an axis for each order of a cosine; at least and at most, by dimension.
const SAMPLES: usize = 6;
const FEWEST: [usize; 3] = [64, 24, 12];
const MOST: [usize; 3] = [512, 64, 16];

/// Steps of the refinement end at this share of the first one: the value is then wrong by the square of it.
const FINE: f64 = 1e-5;

/// The largest and the smallest `|z|² − 1` of the largest multiplier, for each value of the one parameter that is free.
pub(crate) fn extremes_on_torus(compiled: &CompiledStep, parameters: &[f64]) -> Vec<[f64; 2]> {
    let at = compiled.dimension() - 1;
    let steps = (SAMPLES * compiled.span()).clamp(FEWEST[at], MOST[at]) & !1;
    let spacing = TAU / steps as f64;
    let search = CompassSearch::free(0.5 * spacing, FINE * spacing);
    let phases: Vec<Vec<f64>> = half_of_all_waves(compiled.dimension(), steps).collect();
    let table = Table::new(compiled, phases.iter().map(Vec::as_slice));
    let mut extremes = Vec::with_capacity(parameters.len());
    for columns in parameters.chunks(LANES) {
        let samples = table.excess(columns);
        for (lane, &parameter) in columns.iter().enumerate() {
            extremes.push([1.0, -1.0].map(|sign| {
                let value = |index: &usize| sign * samples[*index][lane];
                let best = (0..samples.len()).max_by(|a, b| value(a).total_cmp(&value(b)));
                let start = phases[best.unwrap_or(0)].clone();
                let at = |phase: &[f64]| sign * table.excess_at(compiled, parameter, phase);
                sign * search.maximum(at, start).0
            }));
        }
    }
    extremes
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
