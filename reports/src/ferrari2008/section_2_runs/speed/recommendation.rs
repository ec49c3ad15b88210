//! The cheapest choice for an error.

use super::{Choice, Neighbours, Test};
use crate::number::significant;
use crate::table::{Align, Table};
use courant_simulation::advection::{CostMeasure, Method, Seconds, recommend};

/// Errors to recommend for.
const TARGETS: [f64; 5] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3];

fn describe(choice: &Choice) -> String {
    let Method { scheme, kernel, ratio, courant_number } = choice.method;
    format!(
        "{}, {}, l/Δξ = {ratio}, C = {}",
        scheme.title(),
        kernel.title(),
        significant(courant_number, 3)
    )
}

/// For each test, set of ratios and error the cheapest choice.
pub(super) fn table(tests: &[Test], choices: &[Choice]) -> Table {
    let mut table = Table::new(
        "The cheapest choice for an error after one period, by interactions and by time on this machine",
        &[
            ("test", Align::Left),
            ("l/Δξ", Align::Left),
            ("L1 error wanted", Align::Right),
            ("cheapest by interactions", Align::Left),
            ("N", Align::Right),
            ("interactions", Align::Right),
            ("error", Align::Right),
            ("cheapest by time", Align::Left),
            ("N", Align::Right),
            ("ms: median (range)", Align::Right),
        ],
    );
    for test in tests {
        for neighbours in Neighbours::ALL {
            let recommended = |measure: CostMeasure| {
                recommend(&test.costs_among(measure, neighbours, choices), &TARGETS)
            };
            let by_work = recommended(CostMeasure::Interactions);
            let by_time = recommended(CostMeasure::Seconds);
            for (work, time) in by_work.into_iter().zip(by_time) {
                let head =
                    [test.name().into(), neighbours.name().into(), format!("{:.0e}", work.target)];
                let by_work = match work.choice.map(|index| &test.points[index]) {
                    Some(point) => [
                        describe(&choices[point.choice]),
                        point.cost.plan.particles.to_string(),
                        significant(point.cost.interactions as f64, 3),
                        significant(point.cost.comparison.l1, 3),
                    ],
                    None => ["none of these runs", "–", "–", "–"].map(String::from),
                };
                let by_time = match time.choice.map(|index| &test.points[index]) {
                    Some(point) => [
                        describe(&choices[point.choice]),
                        point.cost.plan.particles.to_string(),
                        milliseconds(point.cost.seconds),
                    ],
                    None => ["none of these runs", "–", "–"].map(String::from),
                };
                table.push(head.into_iter().chain(by_work).chain(by_time));
            }
        }
    }
    table
}

fn milliseconds(seconds: Seconds) -> String {
    let text = |seconds: f64| significant(1e3 * seconds, 2);
    format!("{} ({} to {})", text(seconds.median), text(seconds.lowest), text(seconds.highest))
}
