//! Time stepping for `courant`: the real schemes, run on particles.

pub mod advection;
