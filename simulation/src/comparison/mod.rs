//! A run against the exact solution: what the eye sees in a figure, as numbers.

mod columns;
mod waves;

pub use columns::Columns;
pub use waves::{WaveKind, WavePosition};

use crate::run::{Profile, Run};
use crate::scene::Scene;

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
    /// The largest part by which the distance of two neighbours (in the order of the start) differs from
    /// the one that their densities ask for, `m (1/ρ_i + 1/ρ_{i+1})/2`; below −1 they have passed
    /// each other. `None` for cells.
    pub spacing_mismatch: Option<f64>,
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
    /// Compares inside the window of the scene; `None` if it has no exact solution.
    ///
    /// The solution is that without ends: see [`Scene::holds_until`].
    pub fn new(scene: &Scene, run: &Run) -> Option<Self> {
        Self::inside(scene, run, scene.window)
    }

    /// Compares inside a window of one's own.
    pub fn inside(scene: &Scene, run: &Run, window: [f64; 2]) -> Option<Self> {
        let (profile, material) = (&run.profile, scene.material);
        let indices = profile.inside(window);
        let x: Vec<f64> = indices.iter().map(|&i| profile.x[i]).collect();
        let found = Columns {
            density: &profile.density,
            velocity: &profile.velocity,
            pressure: &profile.pressure,
            energy: &profile.energy,
        }
        .map(|column| {
            let value = |&i: &usize| column.get(i).copied().unwrap_or(f64::NAN);
            indices.iter().map(value).collect::<Vec<f64>>()
        });
        scene.exact(window[0], run.time)?;
        let states: Vec<_> = x.iter().filter_map(|&x| scene.exact(x, run.time)).collect();
        let exact = Columns {
            density: states.iter().map(|state| state.density()).collect::<Vec<f64>>(),
            velocity: states.iter().map(|state| state.velocity()).collect(),
            pressure: states.iter().map(|state| state.pressure()).collect(),
            energy: states
                .iter()
                .map(|state| material.internal_energy(state).unwrap_or(f64::NAN))
                .collect(),
        };
        let fastest = states.iter().map(|state| material.sound_speed(state)).fold(0.0, f64::max);
        let extent = extent(scene, run.time, window);
        let scale = Columns {
            density: scale(extent.density, 0.0),
            velocity: scale(extent.velocity, fastest),
            pressure: scale(extent.pressure, 0.0),
            energy: scale(extent.energy, 0.0),
        };
        let waves = waves::positions(scene, run.time, &x, &found);
        Some(Self {
            inside: indices.len(),
            outside: profile.len() - indices.len(),
            order_preserved: profile.order_preserved(),
            l1: found.each().zip(exact.each()).map(|(found, exact)| mean_error(found, exact)),
            overshoot: (found.each().zip(extent).zip(scale))
                .map(|((found, extent), scale)| beyond(found, extent) / scale),
            excess_variation: (found.each().zip(exact.each()).zip(scale))
                .map(|((found, exact), scale)| (variation(found) - variation(exact)) / scale),
            spacing_mismatch: spacing_mismatch(&run.profile, window),
            waves,
            contact_width: waves::contact_width(scene, run.time, &x, &found.density),
            glitch: waves::glitch(scene, run.time, &x, &found.velocity),
        })
    }
}

/// The mean error where the exact value is a number: a vacuum has no energy.
fn mean_error(found: &[f64], exact: &[f64]) -> f64 {
    let errors = found.iter().zip(exact).filter(|(_, exact)| !exact.is_nan());
    let (sum, count) = errors.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + (a - b).abs(), n + 1.0));
    sum / count
}

/// The mismatch of largest magnitude among the neighbours that are both in the window.
fn spacing_mismatch(profile: &Profile, [from, to]: [f64; 2]) -> Option<f64> {
    profile
        .x
        .windows(2)
        .zip(profile.density.windows(2).zip(profile.mass.windows(2)))
        .filter(|(x, _)| x.iter().all(|&x| x >= from && x <= to))
        .map(|(x, (rho, mass))| (x[1] - x[0]) / (0.5 * (mass[0] / rho[0] + mass[1] / rho[1])) - 1.0)
        .max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Where the exact solution is sampled for its extent, besides the ends of the window.
const SAMPLES: usize = 4000;

/// The smallest and largest values of the exact solution in the window. A run may have no particle where
/// they are taken.
fn extent(scene: &Scene, time: f64, [from, to]: [f64; 2]) -> Columns<(f64, f64)> {
    let none = (f64::INFINITY, -f64::INFINITY);
    let mut extent = Columns { density: none, velocity: none, pressure: none, energy: none };
    let widen = |(low, high): &mut (f64, f64), value: f64| {
        *low = low.min(value);
        *high = high.max(value);
    };
    for i in 0..=SAMPLES {
        let x = from + (to - from) * (i as f64 / SAMPLES as f64);
        let Some(state) = scene.exact(x, time) else { continue };
        let (density, pressure) = (state.density(), state.pressure());
        widen(&mut extent.density, density);
        widen(&mut extent.velocity, state.velocity());
        widen(&mut extent.pressure, pressure);
        if let Some(energy) = scene.material.internal_energy(&state) {
            widen(&mut extent.energy, energy);
        }
    }
    extent
}

/// The range; where the values are constant their magnitude and `more`.
fn scale((low, high): (f64, f64), more: f64) -> f64 {
    let magnitude = low.abs().max(high.abs()) + more;
    if high - low > 1e-9 * magnitude { high - low } else { magnitude }
}

/// How far values lie outside `[low, high]`.
fn beyond(values: &[f64], (low, high): (f64, f64)) -> f64 {
    values.iter().map(|&value| (value - high).max(low - value)).fold(0.0, f64::max)
}

fn variation(values: &[f64]) -> f64 {
    values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum()
}

#[cfg(test)]
mod tests;
