//! What a run says of itself.

use super::{Conservation, Counters, Penetration};

/// How well a method promises to conserve the total energy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Promise {
    /// To round-off.
    RoundOff,
    /// To the order of the integrator in time.
    Integrator,
    /// To the order of the integrator, and momentum as well as a tree of attractions is exact.
    Tree,
}

/// An energy error of the time steps above this part of the energy spoils the third digit of everything.
const NOTABLE: f64 = 1e-3;

/// Warnings about drifts beyond what was promised, about particles that passed each other, and about what was assumed.
pub(crate) fn warnings(
    drift: &Conservation,
    promise: Promise,
    steps: usize,
    penetration: &Penetration,
    counters: &Counters,
) -> Vec<String> {
    let mut warnings = Vec::new();
    // Every step rounds a sum of many numbers a few times.
    let round_off = 1e-13 + 1e-14 * steps as f64;
    let mut judge = |what: &str, value: f64, bound: f64, why: &str| {
        // A NaN is told too.
        if value.is_nan() || value.abs() > bound {
            warnings.push(format!("{what} drifted by {value:.1e} of its scale: {why}"));
        }
    };
    let broken = "the method conserves it to round-off, so the run has lost its meaning";
    judge("mass", drift.mass, round_off, broken);
    match promise {
        Promise::RoundOff | Promise::Integrator => {
            judge("momentum", drift.momentum, round_off, broken);
        }
        Promise::Tree => {
            let why = "the attractions of cells are not exactly opposite; more than this is an error of the time steps (--cfl)";
            judge("momentum", drift.momentum, NOTABLE, why);
        }
    }
    match (drift.energy, promise) {
        (Some(energy), Promise::RoundOff) => judge("energy", energy, round_off, broken),
        (Some(energy), Promise::Integrator | Promise::Tree) => {
            let why = "an error of the time steps; smaller ones (--cfl) or work at the mean velocity \
                       (--work centred) reduce it";
            judge("energy", energy, NOTABLE, why);
        }
        (None, _) => {}
    }
    if penetration.at_end > 0 {
        warnings.push(format!(
            "particles have passed through each other: at the end neighbours stand in the wrong order {} times",
            penetration.at_end
        ));
    }
    if counters.kept_lengths > 0 {
        warnings.push(format!(
            "the gas that was left was too little for any smoothing length: the last {} particles kept theirs",
            counters.kept_lengths
        ));
    }
    warnings
}
