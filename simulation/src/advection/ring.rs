//! Particle positions on a periodic line, and the volume each particle stands for.

use super::random::SplitMix64;
use crate::run::{InvalidOptions, positive};

/// Particles on a periodic line of a given length, in ascending order.
#[derive(Debug, Clone, PartialEq)]
pub struct Ring {
    length: f64,
    positions: Vec<f64>,
    volumes: Vec<f64>,
}

impl Ring {
    /// `ξ_j = (j + 1/2) Δξ` with `Δξ = length/particles`. The particles sit in the middle of equal cells,
    /// so that a jump of the data on a cell's edge falls on no particle. With `length = particles` the
    /// spacing is 1 and differences of positions carry no rounding.
    ///
    /// # Errors
    /// When there are no particles or no length.
    pub fn uniform(particles: usize, length: f64) -> Result<Self, InvalidOptions> {
        let spacing = checked_spacing(particles, length)?;
        let positions = (0..particles).map(|j| (j as f64 + 0.5) * spacing).collect();
        Ok(Self { length, positions, volumes: vec![spacing; particles] })
    }

    /// The uniform ring with each particle displaced by a uniformly distributed amount within
    /// `± disorder Δξ`; volumes by Voronoi cells, `V_j = (ξ_{j+1} − ξ_{j−1})/2`.
    ///
    /// # Errors
    /// As [`uniform`](Self::uniform), and when the disorder is not in `[0, 0.5)`.
    pub fn disordered(
        particles: usize,
        length: f64,
        disorder: f64,
        seed: u64,
    ) -> Result<Self, InvalidOptions> {
        if !(0.0..0.5).contains(&disorder) {
            return Err(InvalidOptions::Disorder(disorder));
        }
        let spacing = checked_spacing(particles, length)?;
        let mut random = SplitMix64::new(seed);
        // Displaced by less than half a spacing they stay in order, and on the line.
        let positions: Vec<f64> = (0..particles)
            .map(|j| (j as f64 + 0.5 + disorder * random.symmetric()) * spacing)
            .collect();
        let count = particles;
        let volumes = (0..count)
            .map(|j| {
                let left = if j == 0 { positions[count - 1] - length } else { positions[j - 1] };
                let right = if j + 1 == count { positions[0] + length } else { positions[j + 1] };
                0.5 * (right - left)
            })
            .collect();
        Ok(Self { length, positions, volumes })
    }

    /// The period of the line.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// `ξ_j`, ascending.
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// `V_j`; they add up to the length.
    pub fn volumes(&self) -> &[f64] {
        &self.volumes
    }

    /// The mean spacing `Δξ`.
    pub fn spacing(&self) -> f64 {
        self.length / self.positions.len() as f64
    }
}

fn checked_spacing(particles: usize, length: f64) -> Result<f64, InvalidOptions> {
    if particles == 0 {
        return Err(InvalidOptions::Particles { particles, least: 1 });
    }
    positive("length", length)?;
    Ok(length / particles as f64)
}
