//! A wave by its phases along the axes.

use std::f64::consts::PI;

/// A component of a direction below this share of the largest is none.
const NEGLIGIBLE: f64 = 1e-5;

/// `e^{i(φ_1 j_1 + … + φ_d j_d)}`: phases in radians per cell, each in `(−π, π]`, and a direction, which the limit of long waves keeps.
///
/// ```
/// use courant_analysis::stability::Wave;
/// use std::f64::consts::PI;
/// let wave = Wave::new(vec![PI / 2.0, PI / 2.0]);
/// // Lines of crests along the diagonal, 4/√2 cells apart.
/// assert!((wave.wavelength() - 8f64.sqrt()).abs() < 1e-15);
/// assert!((wave.direction()[0] - 0.5f64.sqrt()).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Wave {
    phases: Vec<f64>,
    direction: Vec<f64>,
}

impl Wave {
    /// From phases that are not all zero; for zero ones the direction is zero as well.
    pub fn new(phases: Vec<f64>) -> Self {
        let direction = normalised(&phases);
        Self { phases, direction }
    }

    /// In one dimension.
    pub fn along_a_line(phase: f64) -> Self {
        Self { phases: vec![phase], direction: vec![1.0] }
    }

    /// The limit of long waves in a direction; components that are small next to the largest count as zero.
    pub fn long(direction: &[f64]) -> Self {
        let largest = direction.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let cut = |x: &f64| if x.abs() < NEGLIGIBLE * largest { 0.0 } else { *x };
        let direction: Vec<f64> = direction.iter().map(cut).collect();
        Self { phases: vec![0.0; direction.len()], direction: normalised(&direction) }
    }

    /// The phases.
    pub fn phases(&self) -> &[f64] {
        &self.phases
    }

    /// The only phase in one dimension.
    pub fn phase(&self) -> Option<f64> {
        match self.phases.as_slice() {
            [phase] => Some(*phase),
            _ => None,
        }
    }

    /// The unit vector along which it varies.
    pub fn direction(&self) -> &[f64] {
        &self.direction
    }

    /// From crest to crest, in cells; infinite for the limit of long waves.
    pub fn wavelength(&self) -> f64 {
        2.0 * PI / self.phases.iter().map(|phase| phase * phase).sum::<f64>().sqrt()
    }
}

fn normalised(vector: &[f64]) -> Vec<f64> {
    let norm = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    vector.iter().map(|x| if norm > 0.0 { x / norm } else { 0.0 }).collect()
}
