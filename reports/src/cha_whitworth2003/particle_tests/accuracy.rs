//! Errors and conservation of every run.

use super::runs::{Runs, Solved};
use super::text;
use crate::cells;
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::or_dash;

/// `Σ|e|/N`; a run that broke down has no norm.
pub(super) fn errors(runs: &Runs) -> Item {
    let rows = runs.customary().iter().map(|Solved { scene, options, run, .. }| {
        let errors = run.errors.filter(|_| run.completed());
        cells![
            scene.name,
            options.method.name(),
            run.profile.len(),
            errors.map_or_else(|| "–".into(), |e| e.inside.to_string()),
            or_dash(errors.map(|e| e.density), 3),
            or_dash(errors.map(|e| e.velocity), 3),
            or_dash(errors.map(|e| e.pressure), 3),
            or_dash(errors.and_then(|e| e.energy), 3),
            run.failure.map_or_else(|| "completed".into(), |failure| failure.to_string()),
        ]
    });
    text().table("particle_errors", &[], rows)
}

pub(super) fn conservation(runs: &Runs) -> Item {
    let rows = runs.customary().iter().map(|Solved { scene, options, run, .. }| {
        let pairs = run.counters.interactions;
        cells![
            scene.name,
            options.method.name(),
            run.steps,
            significant(run.drift.momentum, 2),
            or_dash(run.drift.energy, 2),
            run.penetration.largest,
            pairs,
            significant(run.counters.riemann_iterations as f64 / pairs as f64, 2),
        ]
    });
    text().table("particle_conservation", &[], rows)
}
