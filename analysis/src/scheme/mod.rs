//! Schemes: what one is, the language in which one is typed, integrators that complete equations in space, and the catalogue.

pub mod catalogue;
mod constants;
mod equation_text;
mod integrator;
mod kernel_function;
pub mod language;
mod lattice_method;
mod linear;
mod lines;
pub mod measurement;
mod names;
mod one_step;
mod step;
#[cfg(test)]
pub(crate) mod testing;

pub use equation_text::EquationText;
pub use integrator::{Coefficient, Integrator, IntegratorFileError, IntegratorForm, Nystrom};
pub use kernel_function::KernelLattice;
pub use lattice_method::{COURANT, LatticeMethod};
pub(crate) use linear::constant;
pub use lines::Lines;
pub use names::{Letter, LetterKind, Name, Names};
pub(crate) use one_step::OffsetCoefficient;
pub use one_step::OneStep;
pub use step::{SchemeError, Step};
