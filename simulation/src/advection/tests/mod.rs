mod paths;
mod runs;
mod validation;

use super::*;
use crate::run::InvalidOptions;
use courant_analysis::exact::rational::{Rational, from_f64, parse, to_f64};
use courant_analysis::kernel::Kernel;

/// Both codes on one lattice.
const EQUALLY_SPACED: [Layout; 2] = [Layout::Uniform, Layout::Lattice];

fn discretisation(scheme: AdvectionScheme, kernel: Kernel, ratio: &str) -> Discretisation {
    Discretisation::new(scheme, kernel, exact(ratio)).unwrap()
}

fn exact(text: &str) -> Rational {
    parse(text).unwrap()
}

/// Noise between −1 and 1.
fn noise(count: usize, seed: u64) -> Vec<f64> {
    let mut random = SplitMix64::new(seed);
    (0..count).map(|_| random.symmetric()).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
