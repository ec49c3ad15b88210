//! Table 2, and what follows from it.

use super::runs::tube;
use super::text;
use crate::cells;
use crate::number::significant;
use crate::page::{Item, Section};
use courant_simulation::riemann::Wave;
use courant_simulation::scene::Scene;

/// The section.
pub fn section() -> Section {
    let items = vec![initial(), star_states(), text().paragraph("table_2_text", &[])];
    text().section("title_table_2", items)
}

fn initial() -> Item {
    let rows = (1..=4).map(|test| {
        let tube = tube(test);
        let data = tube.data();
        let numbers = data.left.iter().chain(&data.right);
        let numbers = numbers.chain([&data.diaphragm, &data.end_time]).map(f64::to_string);
        cells![test].into_iter().chain(numbers).collect::<Vec<_>>()
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

/// `max C` of the star states over `max C` of the initial ones.
pub fn sound_growth(test: usize) -> f64 {
    let tube = tube(test);
    let gas = tube.gas();
    let (solution, _) = tube.riemann().expect("a tube is a Riemann problem");
    let (left, right) = solution.densities();
    let sound = |density, pressure| gas.lagrangian_sound_speed(density, pressure);
    let first = sound(tube.left().density(), tube.left().pressure())
        .max(sound(tube.right().density(), tube.right().pressure()));
    let star = sound(left, solution.pressure()).max(sound(right, solution.pressure()));
    star / first
}

fn star_states() -> Item {
    let rows = (1..=4).map(|test| {
        let tube = tube(test);
        let (solution, _) = tube.riemann().expect("a tube is a Riemann problem");
        let (left, right) = solution.densities();
        // Test 2 is symmetric: v* is round-off there.
        let velocity = if solution.velocity().abs() < 1e-12 { 0.0 } else { solution.velocity() };
        let mut row =
            cells![test, wave_name(solution.left_wave()), wave_name(solution.right_wave())];
        let numbers = [solution.pressure(), velocity, left, right];
        row.extend(numbers.map(|number| significant(number, 7)));
        row.push(significant(sound_growth(test), 4));
        row
    });
    text().table("table_2_star_states", &[], rows)
}
