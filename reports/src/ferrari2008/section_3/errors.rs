//! Every run in numbers.

use super::runs::{Runs, TestRun};
use super::table_item;
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_simulation::comparison::WaveKind;

fn optional(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".into(), |value| significant(value, digits))
}

/// Errors, overshoot, conservation, work. A run that failed has a row of its own kind.
pub fn table(runs: &Runs) -> Item {
    let mut columns = vec![("test", Align::Left), ("method", Align::Left)];
    columns.extend(
        [
            "L1 ρ",
            "L1 v",
            "L1 p",
            "L1 e",
            "over ρ",
            "over v",
            "over p",
            "over e",
            "left in [0, 1]",
            "drift momentum",
            "drift energy",
            "steps",
            "pairs",
        ]
        .map(|name| (name, Align::Right)),
    );
    columns.push(("failure", Align::Left));
    let mut table = Table::new(
        "Errors at the end time, N = 100, settings as in the figures. L1: Σ|e|/N over the particles inside \
         [0, 1]; over: how far values leave the range of the exact solution, over that range; left: of \
         the 100 that started inside; drift: momentum over Σm(|v| + c) and energy over itself, beyond what \
         flowed through the ends",
        &columns,
    );
    for run in runs.all() {
        table.push(row(run));
    }
    table_item("section_3_errors", table)
}

fn row(run: &TestRun) -> Vec<String> {
    let (comparison, record) = (&run.comparison, &run.run);
    let mut row = vec![run.test.to_string(), run.method.name().into()];
    if let Some(failure) = record.failure {
        row.extend(std::iter::repeat_n("–".to_string(), 11));
        row.extend([
            record.steps.to_string(),
            record.counters.interactions.to_string(),
            failure.to_string(),
        ]);
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
    row.extend([record.steps.to_string(), record.counters.interactions.to_string(), String::new()]);
    row
}

/// Where the waves are.
pub fn waves(runs: &Runs) -> Item {
    let mut columns = vec![("test", Align::Left), ("method", Align::Left)];
    columns.extend(
        [
            "left wave",
            "contact",
            "right wave",
            "width of contact",
            "glitch",
            "order kept",
            "spacing",
        ]
        .map(|name| (name, Align::Right)),
    );
    let mut table = Table::new(
        "Waves at the end time, N = 100. Positions: found less exact, where pressure (contact: density) is \
         midway between its two sides; width: over the middle 80 % of the density jump; glitch: largest \
         error of a velocity difference of neighbours inside a rarefaction, over the difference across it; \
         order kept: no particle has passed another; spacing: distance of neighbours over the one their \
         densities ask for, less 1 (below −1: they have passed each other)",
        &columns,
    );
    for run in runs.all().iter().filter(|run| run.run.completed()) {
        let comparison = &run.comparison;
        let acoustic = |left: bool| {
            let waves = comparison.waves.iter().filter(|wave| wave.kind != WaveKind::Contact);
            // Left before right, as the comparison lists them.
            let found: Vec<_> = waves.collect();
            let wave = if left { found.first() } else { found.last() };
            wave.and_then(|wave| wave.error())
        };
        let contact = comparison
            .waves
            .iter()
            .find(|wave| wave.kind == WaveKind::Contact)
            .and_then(|wave| wave.error());
        table.push([
            run.test.to_string(),
            run.method.name().into(),
            optional(acoustic(true), 2),
            optional(contact, 2),
            optional(acoustic(false), 2),
            optional(comparison.contact_width, 3),
            optional(comparison.glitch, 3),
            match run.run.profile.mass.is_empty() {
                true => "–".into(),
                false if comparison.order_preserved => "yes".to_string(),
                false => "no".into(),
            },
            optional(comparison.spacing_mismatch, 3),
        ]);
    }
    table_item("section_3_waves", table)
}
