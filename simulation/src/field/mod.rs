//! Flows in two and three dimensions in a box, with exact solutions: a shear, a vortex, an explosion.
//!
//! A [`FieldScene`] is data; [`run_field`] lets a particle method run it.

mod measures;
mod run;
mod scene;
mod sedov;
mod shear_viscosity;

pub use measures::Measure;
pub use run::{FieldErrors, FieldProfile, FieldRun, Sample, run_field};
pub use scene::{FieldFlow, FieldScene, FieldSolution, FieldState, VORTEX_RADIUS};
pub use sedov::SedovBlast;
pub use shear_viscosity::{ShearResponse, shear_response};

#[cfg(test)]
mod tests;
