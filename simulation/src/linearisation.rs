//! What a running step does to small waves on a ring.

use num_complex::Complex64;
use std::f64::consts::TAU;

/// The matrix that a step is on the amplitudes of `K` quantities of a mode (phase angle `φ = 2π mode/N` per particle), rows first.
///
/// `step` takes the disturbances of all `N` particles and says what is left of them after it. Each quantity is disturbed by a
/// cosine wave of its size, up and down: central differences, off by `O(size²)` where the step is smooth.
///
/// # Errors
/// Those of `step`.
pub(crate) fn linearisation<const K: usize, E>(
    particles: usize,
    mode: usize,
    sizes: [f64; K],
    step: impl Fn(&[[f64; K]]) -> Result<Vec<[f64; K]>, E>,
) -> Result<[[Complex64; K]; K], E> {
    // Angles reduced exactly before they are multiplied by an inexact π.
    let angle = |j: usize| TAU * ((mode * j) % particles) as f64 / particles as f64;
    // cos is half of two conjugate modes, except where these are the same.
    let share = if (2 * mode).is_multiple_of(particles) { 1.0 } else { 2.0 };
    let mut matrix = [[Complex64::ZERO; K]; K];
    for (column, size) in sizes.into_iter().enumerate() {
        let run = |size: f64| {
            let mut disturbances = vec![[0.0; K]; particles];
            for (j, disturbance) in disturbances.iter_mut().enumerate() {
                disturbance[column] = size * angle(j).cos();
            }
            step(&disturbances)
        };
        let (plus, minus) = (run(size)?, run(-size)?);
        for (row, line) in matrix.iter_mut().enumerate() {
            let response = |j: usize| (plus[j][row] - minus[j][row]) / (2.0 * size);
            let turned = (0..particles).map(|j| Complex64::from_polar(response(j), -angle(j)));
            line[column] = turned.sum::<Complex64>() * (share / particles as f64);
        }
    }
    Ok(matrix)
}
