//! The particle code against slower or independent computations.

mod linear;
mod pairs;
mod runs;
