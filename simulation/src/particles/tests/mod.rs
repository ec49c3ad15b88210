//! The particle code against slower or independent computations.

mod blocks;
mod few;
mod neighbours;
mod pairs;
mod runs;

use crate::advection::SplitMix64;
use crate::particles::{Integrator, Nystrom, Particles, table};

/// The table of an integrator of the catalogue.
fn explicit(name: &str) -> Nystrom<f64> {
    table(Integrator::named(name).expect("it is in the list")).expect("it is explicit")
}

/// Equal particles at rest on a line.
fn at_rest<T: Clone>(x: &[f64], mass: f64, thermal: T, smoothing: f64) -> Particles<1, T> {
    Particles {
        position: x.iter().map(|&x| [x]).collect(),
        velocity: vec![[0.0]; x.len()],
        mass: vec![mass; x.len()],
        thermal: vec![thermal; x.len()],
        smoothing: vec![smoothing; x.len()],
    }
}

/// Numbers between 0 and 1 that look random and are the same everywhere.
fn scatter(count: usize, seed: u64) -> Vec<f64> {
    let mut random = SplitMix64::new(seed);
    (0..count).map(|_| random.unit()).collect()
}
