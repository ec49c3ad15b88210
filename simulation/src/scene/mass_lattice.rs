//! The particles of a scene at the start: equal masses in the mass coordinate.

use super::Scene;
use crate::riemann::{IdealGas, State};

/// Particles of equal mass, from left to right: `N` in the domain, and beyond an end through
/// which gas flows in as many as will enter until the end time.
///
/// Particle `i` of the domain holds the mass between `iΔξ` and `(i + 1)Δξ` from its left end, `Δξ = M/N`.
/// Its state is the mean of the conserved quantities there and its position the point that halves its
/// mass. Where the jump of a tube falls inside a particle, that particle gets the mean, so that
/// the totals and the place of the jump are exact, at the price of one intermediate state:
/// in test 1 of Ferrari et al. 2008 with N = 100 it is particle 77, of which 42 % is gas of the left side.
///
/// Without the particles that enter, the gas of test 4 would end between 0.69 and 0.78, and
/// neither shock would be in it.
pub(crate) struct MassLattice {
    /// The mass Δξ of a particle.
    pub spacing: f64,
    /// The states.
    pub states: Vec<State>,
    /// The positions.
    pub x: Vec<f64>,
    /// How many particles are beyond the left and the right end.
    pub waiting: [usize; 2],
}

impl MassLattice {
    /// `particles` of them in the domain of the scene, of an ideal gas.
    pub fn new(scene: &Scene, gas: IdealGas, particles: usize) -> Self {
        let (mass, count) = (scene.mass(), particles as f64);
        let waiting = Self::waiting(scene, particles);
        let at = |index: f64| scene.position_at_mass(mass * (index / count));
        let first = -(waiting[0] as f64);
        let all = waiting[0] + particles + waiting[1];
        let index = |i: usize| first + i as f64;
        let states =
            (0..all).map(|i| scene.average(gas, at(index(i)), at(index(i) + 1.0))).collect();
        let x = (0..all).map(|i| at(index(i) + 0.5)).collect();
        Self { spacing: mass / count, states, x, waiting }
    }

    /// How many particles will stand beyond the left and the right end.
    pub fn waiting(scene: &Scene, particles: usize) -> [usize; 2] {
        let spacing = scene.mass() / particles as f64;
        scene.inflow().map(|inflow| (inflow / spacing).ceil() as usize)
    }
}
