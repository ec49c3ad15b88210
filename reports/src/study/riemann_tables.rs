//! Runs of Riemann problems in numbers.

use super::riemann_run::RiemannRun;
use crate::cells;
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::{PaperText, or_dash};
use courant_simulation::comparison::{WaveKind, WavePosition};

/// Errors, overshoot, conservation, work. A run that failed has a row of its own kind.
pub fn errors(text: &PaperText, name: &str, runs: &[RiemannRun]) -> Item {
    text.table(name, &[], runs.iter().map(row))
}

fn row(run: &RiemannRun) -> Vec<String> {
    let (comparison, record) = (&run.comparison, &run.run);
    let mut row = cells![run.test, run.method.name()];
    if let Some(failure) = record.failure {
        row.extend(std::iter::repeat_n("–".to_string(), 11));
        row.extend(cells![record.steps, record.counters.interactions, failure]);
        return row;
    }
    let (l1, over) = (&comparison.l1, &comparison.overshoot);
    row.extend(
        [l1.density, l1.velocity, l1.pressure, l1.energy].map(|value| significant(value, 3)),
    );
    row.extend(
        [over.density, over.velocity, over.pressure, over.energy]
            .map(|value| format!("{:.1} %", 100.0 * value)),
    );
    let cells = record.profile.mass.is_empty();
    row.push(if cells { "–".into() } else { run.left_in_domain().to_string() });
    row.push(significant(record.conservation.momentum, 1));
    row.push(significant(record.conservation.energy.unwrap_or(f64::NAN), 1));
    row.extend(cells![record.steps, record.counters.interactions, ""]);
    row
}

/// Where the waves are.
pub fn waves(text: &PaperText, name: &str, runs: &[RiemannRun]) -> Item {
    let completed = runs.iter().filter(|run| run.run.completed());
    let rows = completed.map(|run| {
        let comparison = &run.comparison;
        let (contacts, acoustic): (Vec<&WavePosition>, Vec<&WavePosition>) =
            comparison.waves.iter().partition(|wave| wave.kind == WaveKind::Contact);
        // Left before right, as the comparison lists them.
        let [left, contact, right] = [acoustic.first(), contacts.first(), acoustic.last()]
            .map(|wave| or_dash(wave.and_then(|wave| wave.error()), 2));
        cells![
            run.test,
            run.method.name(),
            left,
            contact,
            right,
            or_dash(comparison.contact_width, 3),
            or_dash(comparison.glitch, 3),
            match run.run.profile.mass.is_empty() {
                true => "–",
                false if comparison.order_preserved => "yes",
                false => "no",
            },
            or_dash(comparison.spacing_mismatch, 3),
        ]
    });
    text.table(name, &[], rows)
}
