//! Errors and conservation of every run.

use super::COMMAND;
use super::runs::{Runs, Solved};
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".into(), |value| significant(value, digits))
}

fn outcome(solved: &Solved) -> String {
    solved.run.failure.map_or_else(|| "completed".into(), |failure| failure.to_string())
}

/// `Σ|e|/N`; a run that broke down has no norm.
pub(super) fn errors(runs: &Runs) -> Item {
    let mut table = Table::new(
        "L1 errors Σ|e|/N over the particles inside the comparison window, against the exact solution \
         (sound wave: linear acoustics; Woodward & Colella's blasts have none). Cubic spline with h = 1 spacing, \
         case 4 Gaussian with 1.05; step 0.5 of the shortest crossing time; the paper's Riemann solvers; SPH α = 1, β = 2.",
        &[
            ("scene", Align::Left),
            ("method", Align::Left),
            ("N", Align::Right),
            ("inside", Align::Right),
            ("density", Align::Right),
            ("velocity", Align::Right),
            ("pressure", Align::Right),
            ("energy", Align::Right),
            ("outcome", Align::Left),
        ],
    );
    for solved in runs.to_the_end() {
        let errors = solved.errors.as_ref();
        let inside = solved.run.profile.inside(solved.scene.window).len();
        table.push([
            solved.scene.name.to_string(),
            solved.options.method.name().into(),
            solved.run.profile.len().to_string(),
            errors.map_or_else(|| "–".into(), |_| inside.to_string()),
            number(errors.map(|e| e.density), 3),
            number(errors.map(|e| e.velocity), 3),
            number(errors.map(|e| e.pressure), 3),
            number(errors.map(|e| e.energy).filter(|energy| energy.is_finite()), 3),
            outcome(solved),
        ]);
    }
    Item::Table { name: "particle_errors".into(), table, command: COMMAND.into() }
}

pub(super) fn conservation(runs: &Runs) -> Item {
    let mut table = Table::new(
        "Conservation, penetration and work of the same runs. Momentum: change less the impulse of the walls over \
         Σ m (|v| + c); energy: relative change of the total. Out of order: neighbours that have passed each other, the \
         most after any step. A pair interaction is one force between two particles.",
        &[
            ("scene", Align::Left),
            ("method", Align::Left),
            ("steps", Align::Right),
            ("momentum", Align::Right),
            ("energy", Align::Right),
            ("out of order", Align::Right),
            ("pair interactions", Align::Right),
            ("Riemann iterations per pair", Align::Right),
        ],
    );
    for solved in runs.to_the_end() {
        let run = &solved.run;
        let pairs = run.counters.interactions;
        table.push([
            solved.scene.name.to_string(),
            solved.options.method.name().into(),
            run.steps.to_string(),
            significant(run.conservation.momentum.abs(), 2),
            number(run.conservation.energy.map(f64::abs), 2),
            run.penetration.largest.to_string(),
            pairs.to_string(),
            significant(run.counters.riemann_iterations as f64 / pairs as f64, 2),
        ]);
    }
    Item::Table { name: "particle_conservation".into(), table, command: COMMAND.into() }
}
