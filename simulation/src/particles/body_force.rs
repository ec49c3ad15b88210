//! What acts on particles one by one, at a distance: gravity, in particular.

use super::gas::Gas;
use super::system::{ParticleSystem, Particles};
use super::thermal::ThermalState;
use super::vector::{Vector, dot};

/// Accelerations that depend on where the particles are. A particle of step `Δ` gets half the impulse of where its step
/// begins and half of where it ends.
///
/// `()` is their absence: nothing is stored. What is not said otherwise is that of no force, or follows from the acceleration.
pub trait BodyForce<const D: usize>: Sync {
    /// The accelerations of the active particles where they are now.
    fn update<T: ThermalState>(
        &mut self,
        _particles: &Particles<D, T>,
        _active: &(dyn Fn(usize) -> bool + Sync),
    ) {
    }

    /// The acceleration of a particle, as of its last update.
    #[inline]
    fn acceleration(&self, _particle: usize) -> Vector<D> {
        [0.0; D]
    }

    /// The change of velocity by that acceleration in a time, of a particle of that mass. Whatever exerts it takes the
    /// reaction.
    #[inline]
    fn impulse(&mut self, particle: usize, _mass: f64, duration: f64) -> Vector<D> {
        self.acceleration(particle).map(|a| duration * a)
    }

    /// The longest step for a particle of smoothing length `h`: the Courant number times the time in which it would fall
    /// through `h`, `√(h/|g|)`.
    #[inline]
    fn longest_step(&self, particle: usize, courant: f64, h: f64) -> f64 {
        let a = self.acceleration(particle);
        courant * (h / dot(&a, &a).sqrt()).sqrt()
    }

    /// Moves what exerts the force, if it moves, by a step in which all particles drift.
    fn drift(&mut self, _duration: f64) {}

    /// What happens to the particles between steps: some may be taken out.
    fn settle<G: Gas>(&mut self, _system: &mut ParticleSystem<D, G>) {}

    /// Remembers its state before a step that may be rejected.
    fn keep(&mut self) {}

    /// Returns to that state; accelerations are updated anew.
    fn restore(&mut self) {}
}

impl<const D: usize> BodyForce<D> for () {}
