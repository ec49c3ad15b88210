//! A step that is only known by what it does to states: measured impulse by impulse, fitted in its parameter, and made a [`Step`].
//!
//! [`Step`]: crate::scheme::Step

mod equation_text;
mod experiment;
mod fit;
mod from_stencil;
mod layout;
mod probe;

pub use experiment::{Base, Experiment, MeasuredStencil, Objection};
pub use fit::{MOST_DEGREE, MeasuredStep, NoFit};
pub use from_stencil::{Place, StencilTerm};
pub use layout::{MOST_VALUES, StateLayout};
pub use probe::{Probe, Probed, Refused};
