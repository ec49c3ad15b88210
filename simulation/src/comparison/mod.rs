//! A run against the exact solution: what the eye sees in a figure, as numbers.

mod columns;
mod waves;

pub use columns::Columns;
pub use waves::{WaveKind, WavePosition};

use crate::run::Run;
use crate::scene::Scene;
use columns::per_column;

/// The measures of a run at the time it reached, taken over the particles inside the window.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// How many particles (or cells) are inside the window.
    pub inside: usize,
    /// How many have left it.
    pub outside: usize,
    /// Whether no particle has passed another.
    pub order_preserved: bool,
    /// `Σ|e_i|/N` over the particles inside.
    pub l1: Columns<f64>,
    /// How far the largest value is above the largest exact one or the smallest below the
    /// smallest, over the range of the exact solution in the window (over its largest magnitude
    /// if that is constant).
    pub overshoot: Columns<f64>,
    /// The total variation, `Σ|u_{i+1} − u_i|` from left to right, over that of the exact solution
    /// at the same points, less 1. Smearing leaves it at 0 or below, oscillations raise it. 0
    /// where the exact solution is constant and the run is, too; otherwise infinite.
    pub excess_variation: Columns<f64>,
    /// The acoustic waves and the contact of a Riemann problem.
    pub waves: Vec<WavePosition>,
    /// The distance over which the density covers the middle 80 % of the jump at the
    /// contact; `None` where there is no jump or it is not resolved.
    pub contact_width: Option<f64>,
    /// The largest error of a velocity difference between neighbours well inside a rarefaction,
    /// over the velocity difference across that rarefaction: an entropy glitch is a spike of this
    /// measure. `None` without such neighbours.
    pub glitch: Option<f64>,
}

impl Comparison {
    /// Compares inside the domain of the scene.
    pub fn new(scene: &dyn Scene, run: &Run) -> Self {
        Self::inside(scene, run, scene.domain())
    }

    /// Compares inside a window of one's own.
    pub fn inside(scene: &dyn Scene, run: &Run, window: [f64; 2]) -> Self {
        let (profile, gas) = (&run.profile, scene.gas());
        let indices = profile.inside(window);
        let x: Vec<f64> = indices.iter().map(|&i| profile.x[i]).collect();
        let found = Columns {
            density: &profile.density,
            velocity: &profile.velocity,
            pressure: &profile.pressure,
            energy: &profile.energy,
        }
        .map(|column| indices.iter().map(|&i| column[i]).collect::<Vec<f64>>());
        let states: Vec<_> = x.iter().map(|&x| scene.exact(x, run.time)).collect();
        let exact = Columns {
            density: states.iter().map(|state| state.density()).collect::<Vec<f64>>(),
            velocity: states.iter().map(|state| state.velocity()).collect(),
            pressure: states.iter().map(|state| state.pressure()).collect(),
            energy: states
                .iter()
                .map(|state| gas.internal_energy(state.density(), state.pressure()))
                .collect(),
        };
        let waves = waves::positions(scene, run.time, &x, &found);
        Self {
            inside: indices.len(),
            outside: profile.len() - indices.len(),
            order_preserved: profile.order_preserved(),
            l1: per_column(&found, &exact, mean_error),
            overshoot: per_column(&found, &exact, overshoot),
            excess_variation: per_column(&found, &exact, excess_variation),
            waves,
            contact_width: waves::contact_width(scene, run.time, &x, &found.density),
            glitch: waves::glitch(scene, run.time, &x, &found.velocity),
        }
    }
}

fn mean_error(found: &[f64], exact: &[f64]) -> f64 {
    found.iter().zip(exact).map(|(a, b)| (a - b).abs()).sum::<f64>() / found.len() as f64
}

fn range(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, -f64::INFINITY), |(low, high), &value| {
        (low.min(value), high.max(value))
    })
}

fn overshoot(found: &[f64], exact: &[f64]) -> f64 {
    let ((low, high), (exact_low, exact_high)) = (range(found), range(exact));
    let scale = if exact_high > exact_low {
        exact_high - exact_low
    } else {
        exact_high.abs().max(f64::MIN_POSITIVE)
    };
    (high - exact_high).max(exact_low - low).max(0.0) / scale
}

fn excess_variation(found: &[f64], exact: &[f64]) -> f64 {
    let variation =
        |values: &[f64]| values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>();
    let (found, exact) = (variation(found), variation(exact));
    if found == exact { 0.0 } else { found / exact - 1.0 }
}

#[cfg(test)]
mod tests;
