//! Runs from noise.

use courant_simulation::advection::SplitMix64;
use courant_simulation::stepping::TorusScheme;
use std::f64::consts::LN_2;

/// Whether noise in all arrays of the history grows exponentially within so many steps.
pub fn grows(scheme: &TorusScheme, points: &[usize], most_steps: usize) -> bool {
    let torus = scheme.torus(points).unwrap();
    let mut random = SplitMix64::new(0x006e_6f69_7365);
    let mut state: Vec<Vec<f64>> = (0..torus.history())
        .map(|_| (0..torus.cells()).map(|_| random.symmetric()).collect())
        .collect();
    // `max` drops what is no number: it must not.
    let larger = |most: f64, x: &f64| if x.abs() > most || x.is_nan() { x.abs() } else { most };
    let norm = |state: &[Vec<f64>]| state.iter().flatten().fold(0.0, larger);
    let (start, mut growths) = (norm(&state), vec![1.0]);
    // Far enough for the second half to show how it grows; what is no number ends too.
    while growths.len() <= most_steps && growths.last().is_some_and(|growth| *growth <= 1e12) {
        torus.step(&mut state);
        growths.push(norm(&state) / start);
    }
    let (growth, middle) = (growths[growths.len() - 1], growths[(growths.len() - 1) / 2]);
    // n³, as of three multipliers that meet, is no exponential growth.
    !growth.is_finite() || (growth > 1e4 && (growth / middle).ln() > 3.0 * LN_2)
}
