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
    /// smallest, over the range of the exact solution.
    ///
    /// Where the exact solution is constant, its magnitude takes the place of its range (for the
    /// velocity, with the speed of sound added), here and below.
    pub overshoot: Columns<f64>,
    /// The total variation `Σ|u_{i+1} − u_i|` from left to right, less that of the exact solution
    /// at the same points, over the range of the exact solution. Smearing leaves it at 0 or
    /// below, oscillations raise it.
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
        let fastest = states
            .iter()
            .map(|state| gas.sound_speed(state.density(), state.pressure()))
            .fold(0.0, f64::max);
        let scale = Columns {
            density: scale(&exact.density, 0.0),
            velocity: scale(&exact.velocity, fastest),
            pressure: scale(&exact.pressure, 0.0),
            energy: scale(&exact.energy, 0.0),
        };
        let waves = waves::positions(scene, run.time, &x, &found);
        Self {
            inside: indices.len(),
            outside: profile.len() - indices.len(),
            order_preserved: profile.order_preserved(),
            l1: per_column(&found, &exact, &scale, |found, exact, _| mean_error(found, exact)),
            overshoot: per_column(&found, &exact, &scale, overshoot),
            excess_variation: per_column(&found, &exact, &scale, excess_variation),
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

/// The range of the values; where they are constant their magnitude and `more`.
fn scale(exact: &[f64], more: f64) -> f64 {
    let (low, high) = range(exact);
    let magnitude = low.abs().max(high.abs()) + more;
    if high - low > 1e-9 * magnitude { high - low } else { magnitude }
}

fn overshoot(found: &[f64], exact: &[f64], scale: f64) -> f64 {
    let ((low, high), (exact_low, exact_high)) = (range(found), range(exact));
    (high - exact_high).max(exact_low - low).max(0.0) / scale
}

fn excess_variation(found: &[f64], exact: &[f64], scale: f64) -> f64 {
    let variation =
        |values: &[f64]| values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>();
    (variation(found) - variation(exact)) / scale
}

#[cfg(test)]
mod tests;
