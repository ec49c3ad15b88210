//! What acts on particles one by one, at a distance: gravity, in particular.

use super::gas::Gas;
use super::system::{ParticleSystem, Particles};
use super::thermal::ThermalState;
use super::vector::Vector;

/// Accelerations that depend on where the particles are. A particle of step `Δ` gets half the impulse of where its step
/// begins and half of where it ends.
///
/// `()` is their absence: nothing is stored and nothing computed.
pub trait BodyForce<const D: usize>: Sync {
    /// The accelerations of the active particles where they are now.
    fn update<T: ThermalState>(
        &mut self,
        particles: &Particles<D, T>,
        active: &(dyn Fn(usize) -> bool + Sync),
    );

    /// The acceleration of a particle, as of its last update.
    fn acceleration(&self, particle: usize) -> Vector<D>;

    /// The change of velocity by that acceleration in a time, of a particle of that mass. Whatever exerts it takes the
    /// reaction.
    fn impulse(&mut self, particle: usize, mass: f64, duration: f64) -> Vector<D>;

    /// The longest step for a particle of smoothing length `h`: the Courant number times the time in which it would fall
    /// through `h`, `√(h/|g|)`.
    fn longest_step(&self, particle: usize, courant: f64, h: f64) -> f64;

    /// Moves what exerts the force, if it moves, by a step in which all particles drift.
    fn drift(&mut self, duration: f64);

    /// What happens to the particles between steps: some may be taken out.
    fn settle<G: Gas>(&mut self, system: &mut ParticleSystem<D, G>);

    /// Remembers its state before a step that may be rejected.
    fn keep(&mut self);

    /// Returns to that state; accelerations are updated anew.
    fn restore(&mut self);
}

impl<const D: usize> BodyForce<D> for () {
    #[inline]
    fn update<T: ThermalState>(&mut self, _: &Particles<D, T>, _: &(dyn Fn(usize) -> bool + Sync)) {
    }

    #[inline]
    fn acceleration(&self, _: usize) -> Vector<D> {
        [0.0; D]
    }

    #[inline]
    fn impulse(&mut self, _: usize, _: f64, _: f64) -> Vector<D> {
        [0.0; D]
    }

    #[inline]
    fn longest_step(&self, _: usize, _: f64, _: f64) -> f64 {
        f64::INFINITY
    }

    fn drift(&mut self, _: f64) {}

    fn settle<G: Gas>(&mut self, _: &mut ParticleSystem<D, G>) {}

    fn keep(&mut self) {}

    fn restore(&mut self) {}
}
