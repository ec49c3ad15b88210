//! The particle code against slower or independent computations.

mod blocks;
mod few;
mod neighbours;
mod pairs;
mod runs;

use crate::particles::{Integrator, Nystrom, table};

/// The table of an integrator of the catalogue.
fn explicit(name: &str) -> Nystrom<f64> {
    table(Integrator::named(name).expect("it is in the list")).expect("it is explicit")
}

/// Numbers in (0, 1) that look random and are the same everywhere.
fn scatter(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed;
    (0..count)
        .map(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        })
        .collect()
}
