//! Table 2, and what follows from it.

use super::{text, tubes};
use crate::cells;
use crate::number::significant;
use crate::page::{Item, Section};
use crate::study::riemann_run::{solution, sound_growth, states};
use courant_simulation::riemann::Wave;

/// The section.
pub fn section() -> Section {
    let items = vec![initial(), star_states(), text().paragraph("table_2_text", &[])];
    text().section("title_table_2", items)
}

fn initial() -> Item {
    let tubes = tubes();
    let rows = (0..tubes.tests.len()).map(|index| {
        let (test, tube) = (&tubes.tests[index].0, tubes.scene(index));
        let numbers =
            states(&tube).map(|state| [state.density(), state.velocity(), state.pressure()]);
        let (_, _, diaphragm) = tube.two_states().expect("a tube has two states");
        let numbers = numbers.as_flattened().iter().chain([&diaphragm, &tube.end_time]);
        cells![test].into_iter().chain(numbers.map(f64::to_string)).collect::<Vec<_>>()
    });
    text().table("table_2", &[], rows)
}

fn wave_name(wave: Wave) -> &'static str {
    match wave {
        Wave::Absent => "none",
        Wave::Shock { .. } => "shock",
        Wave::Rarefaction { .. } => "rarefaction",
    }
}

fn star_states() -> Item {
    let tubes = tubes();
    let rows = (0..tubes.tests.len()).map(|index| {
        let (test, tube) = (&tubes.tests[index].0, tubes.scene(index));
        let (solution, _) = solution(&tube);
        let (left, right) = solution.densities();
        // Test 2 is symmetric: v* is round-off there.
        let velocity = if solution.velocity().abs() < 1e-12 { 0.0 } else { solution.velocity() };
        let mut row =
            cells![test, wave_name(solution.left_wave()), wave_name(solution.right_wave())];
        let numbers = [solution.pressure(), velocity, left, right];
        row.extend(numbers.map(|number| significant(number, 7)));
        row.push(significant(sound_growth(&tube), 4));
        row
    });
    text().table("table_2_star_states", &[], rows)
}
