//! What a run leaves behind.

use super::scene::{Material, ParticleScene};
use super::system::Counters;
use crate::run::{Failure, Profile};

/// The change of conserved quantities, without sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// Over the mass at the start; zero by construction.
    pub mass: f64,
    /// Less the impulse of the walls, over `Σ m (|v| + c)` at the start.
    pub momentum: f64,
    /// Over the total energy at the start; `None` where no energy is carried.
    pub energy: Option<f64>,
}

/// Neighbours that stand in the wrong order: one has passed through the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Penetration {
    /// After the last step.
    pub at_end: usize,
    /// The most after any step.
    pub largest: usize,
}

impl Penetration {
    pub(super) fn observe(&mut self, positions: &[[f64; 1]]) {
        self.at_end = positions.windows(2).filter(|pair| pair[0][0] >= pair[1][0]).count();
        self.largest = self.largest.max(self.at_end);
    }
}

/// `Σ|e_i|/N` against the exact solution, over the particles inside the scene's window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// How many particles are inside.
    pub inside: usize,
    /// Of the density.
    pub density: f64,
    /// Of the velocity.
    pub velocity: f64,
    /// Of the pressure.
    pub pressure: f64,
    /// Of the specific internal energy; `None` where there is none.
    pub energy: Option<f64>,
}

impl Errors {
    /// `None` if the scene has no exact solution or no particle is inside.
    pub fn new(scene: &ParticleScene, profile: &Profile, time: f64) -> Option<Self> {
        let [from, to] = scene.window;
        let (mut inside, mut sums) = (0, [0.0; 4]);
        for (i, &x) in profile.x.iter().enumerate().filter(|(_, x)| (from..=to).contains(*x)) {
            let exact = scene.exact(x, time)?;
            inside += 1;
            sums[0] += (profile.density[i] - exact.density()).abs();
            sums[1] += (profile.velocity[i] - exact.velocity()).abs();
            sums[2] += (profile.pressure[i] - exact.pressure()).abs();
            if let Material::Ideal(gas) = scene.material {
                let energy = gas.internal_energy(exact.density(), exact.pressure());
                sums[3] += (profile.energy[i] - energy).abs();
            }
        }
        let [density, velocity, pressure, energy] = sums.map(|sum| sum / f64::from(inside));
        let has_energy = matches!(scene.material, Material::Ideal(_));
        (inside > 0).then_some(Self {
            inside: inside as usize,
            density,
            velocity,
            pressure,
            energy: has_energy.then_some(energy),
        })
    }
}

/// The result of a run. A run that broke down is a result too.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleRun {
    /// The state at [`time`](Self::time); no energies for an isothermal gas.
    pub profile: Profile,
    /// Smoothing lengths, in the same order.
    pub smoothing: Vec<f64>,
    /// How many steps were taken; with block steps, substeps.
    pub steps: u64,
    /// How many steps, or blocks, broke and were repeated with half their length.
    pub rejected: usize,
    /// The time reached.
    pub time: f64,
    /// Why the run broke down; `None` if it reached the end.
    pub failure: Option<Failure>,
    /// Conservation.
    pub drift: Drift,
    /// Work: pair interactions and Riemann iterations.
    pub counters: Counters,
    /// Penetration.
    pub penetration: Penetration,
    /// Errors at the time reached, if the scene has an exact solution.
    pub errors: Option<Errors>,
}

impl ParticleRun {
    /// Whether the run reached its end time.
    pub fn completed(&self) -> bool {
        self.failure.is_none()
    }
}
