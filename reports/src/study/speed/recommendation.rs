//! The cheapest choice for an error.

use super::pareto::cheapest;
use super::{Choice, Test};
use crate::cells;
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::PaperText;
use courant_analysis::exact::rational::to_text;

fn describe(choice: &Choice) -> String {
    format!(
        "{}, {}, l/Δξ = {}, C = {}",
        choice.of.scheme().title(),
        choice.of.kernel().title(),
        to_text(choice.of.ratio()),
        significant(choice.courant_number, 3)
    )
}

/// For each test, set of ratios and error the choice with the least work.
pub(super) fn table(text: &PaperText, tests: &[Test<'_>]) -> Item {
    let mut rows = Vec::new();
    for test in tests {
        for among in &test.plan.among {
            let costs = test.costs(among);
            for &target in &test.plan.targets {
                let mut row = cells![test.data.name, among.name, format!("{target:.0e}")];
                row.extend(match cheapest(&costs, target).map(|index| &test.points[index]) {
                    Some(point) => cells![
                        describe(&test.choices[point.choice]),
                        point.particles,
                        significant(point.run.run.counters.interactions as f64, 3),
                        significant(point.run.comparison.l1, 3),
                        significant(1e3 * point.seconds, 2),
                    ],
                    None => cells!["none of these runs", "–", "–", "–", "–"],
                });
                rows.push(row);
            }
        }
    }
    text.table("speed_recommendation", &[], rows)
}
