//! Time stepping for `courant`: the real schemes, run on particles; gases, scenes, and the methods that
//! advance them.

pub mod advection;
mod bisection;
pub mod boundary;
pub mod comparison;
pub mod field;
pub mod finite_volume;
pub mod gravity;
pub mod lagrangian;
pub mod lattice;
mod linearisation;
pub mod march;
pub mod method;
pub mod particles;
pub mod riemann;
pub mod run;
pub mod scene;
pub mod stepping;
