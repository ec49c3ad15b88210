//! Time stepping for `courant`: gases, scenes, and the methods that advance them.

pub mod particles;
pub mod riemann;
