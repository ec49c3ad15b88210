//! Why a run cannot start.

use crate::lagrangian::InvalidLattice;
use crate::particles::NotExplicit;
use courant_analysis::kernel::Kernel;

/// Options that do not make sense, alone or with the scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InvalidOptions {
    /// The lattice cannot be made.
    #[error(transparent)]
    Lattice(#[from] InvalidLattice),
    /// A number that must be positive is not, or is not finite.
    #[error("{name} = {value}: a finite number above 0 is needed")]
    NotPositive {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number that may be 0 is negative, or is not finite.
    #[error("{name} = {value}: a finite number, not negative, is needed")]
    Negative {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Neighbours displaced by half a spacing could meet.
    #[error("disorder = {0}: at least 0 and below 1/2 spacing is needed")]
    Disorder(f64),
    /// Fewer particles than the method needs.
    #[error("particles = {particles}: at least {least} are needed")]
    Particles {
        /// What was asked for.
        particles: usize,
        /// What is needed.
        least: usize,
    },
    /// More work or memory than a run may take.
    #[error("{what}: {needed:.3e} would be needed, at most {most} are run")]
    TooMuch {
        /// Particles or steps.
        what: &'static str,
        /// How many.
        needed: f64,
        /// The bound.
        most: usize,
    },
    /// The scene has physics that the method does not know.
    #[error("{method} does not run {scene}: {problem}")]
    Uncovered {
        /// The method.
        method: &'static str,
        /// The scene.
        scene: String,
        /// What is missing.
        problem: &'static str,
    },
    /// The convolution of case 4 is known for the Gaussian.
    #[error("kernel = {0}: gph4 needs the gaussian")]
    Kernel(Kernel),
    /// Particles are not stepped so.
    #[error(transparent)]
    Integrator(#[from] NotExplicit),
    /// Block steps are first order.
    #[error("integrator = {0}: block steps need centred-euler")]
    BlockIntegrator(&'static str),
    /// More levels than counting of steps allows.
    #[error("levels = {0}: at most 20")]
    Levels(u32),
}

/// Accepts a positive finite number.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), InvalidOptions> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(InvalidOptions::NotPositive { name, value })
    }
}

/// Accepts a finite number that is not negative.
pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<(), InvalidOptions> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(InvalidOptions::Negative { name, value })
    }
}
