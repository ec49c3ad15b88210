//! The particle code against slower or independent computations.

mod blocks;
mod few;
mod neighbours;
mod pairs;
mod runs;

use crate::advection::SplitMix64;
use crate::particles::{Integrator, Nystrom, table};

/// The table of an integrator of the catalogue.
fn explicit(name: &str) -> Nystrom<f64> {
    table(Integrator::named(name).expect("it is in the list")).expect("it is explicit")
}

/// Numbers between 0 and 1 that look random and are the same everywhere.
fn scatter(count: usize, seed: u64) -> Vec<f64> {
    let mut random = SplitMix64::new(seed);
    (0..count).map(|_| random.unit()).collect()
}
