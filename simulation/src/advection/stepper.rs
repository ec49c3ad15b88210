//! What the two paths have in common.

use super::lattice_path::LatticePath;
use super::method::Method;
use super::particle_path::ParticlePath;
use super::ring::Ring;

/// Something that advances one number per particle, step by step.
pub trait Stepper {
    /// One time step.
    fn step(&mut self);

    /// The present values, one per particle in the order of their positions.
    fn state(&self) -> &[f64];

    /// Replaces the values.
    ///
    /// # Panics
    /// When there are not as many values as particles.
    fn set_state(&mut self, values: &[f64]);

    /// Terms with another particle's value that one step adds up: the work, whatever the machine.
    fn interactions_per_step(&self) -> u64;
}

/// Which code does the stepping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PathKind {
    /// Neighbours found among positions: [`ParticlePath`].
    Particles,
    /// The stencil of the uniform lattice: [`LatticePath`].
    Lattice,
}

impl PathKind {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Particles, Self::Lattice];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Particles => "particles",
            Self::Lattice => "lattice",
        }
    }

    /// The path over a uniform ring, all values zero.
    pub(super) fn on_uniform(self, method: Method, ring: &Ring) -> Box<dyn Stepper> {
        match self {
            Self::Particles => Box::new(ParticlePath::new(method, ring)),
            Self::Lattice => Box::new(LatticePath::new(method, ring.positions().len())),
        }
    }
}

impl<S: Stepper + ?Sized> Stepper for Box<S> {
    fn step(&mut self) {
        (**self).step();
    }
    fn state(&self) -> &[f64] {
        (**self).state()
    }
    fn set_state(&mut self, values: &[f64]) {
        (**self).set_state(values);
    }
    fn interactions_per_step(&self) -> u64 {
        (**self).interactions_per_step()
    }
}
