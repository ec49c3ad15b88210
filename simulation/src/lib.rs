//! Time stepping for `courant`: gases, scenes, and the methods that advance them.

pub mod adaptive_sph;
pub mod comparison;
pub mod finite_volume;
pub mod lagrangian;
pub mod method;
pub mod particles;
pub mod riemann;
pub mod run;
pub mod scene;
