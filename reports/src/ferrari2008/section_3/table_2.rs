//! Table 2, and what follows from it.

use super::runs::{gas, states, tube};
use super::table_item;
use crate::number::significant;
use crate::page::{Item, Section};
use crate::table::{Align, Table};
use courant_simulation::riemann::Wave;

/// The section.
pub fn section() -> Section {
    Section {
        title: "Table 2: the four shock tubes".into(),
        items: vec![
            table_item("table_2", initial()),
            table_item("table_2_star_states", star_states()),
            Item::Paragraph(
                "The last column is the growth of the largest Lagrangian sound speed C = √(γρp) when the \
                 star states appear. A time step fixed by the initial data has a Courant number that much \
                 larger than intended from the first steps on."
                    .into(),
            ),
        ],
    }
}

fn initial() -> Table {
    let mut columns = vec![("test", Align::Left)];
    columns
        .extend(["ρL", "vL", "pL", "ρR", "vR", "pR", "x₀", "T"].map(|name| (name, Align::Right)));
    let mut table = Table::new(
        "Table 2. Initial conditions of the four tests; γ = 1.4, domain [0, 1], N = 100",
        &columns,
    );
    for test in 1..=4 {
        let tube = tube(test);
        let numbers =
            states(&tube).map(|state| [state.density(), state.velocity(), state.pressure()]);
        let (_, _, diaphragm) = tube.two_states().expect("a tube has two states");
        let mut row = vec![test.to_string()];
        row.extend(numbers.as_flattened().iter().map(f64::to_string));
        row.extend([diaphragm, tube.end_time].map(|number| number.to_string()));
        table.push(row);
    }
    table
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
    let gas = gas(&tube);
    let (solution, _) = tube.riemann().expect("a tube is a Riemann problem");
    let (left, right) = solution.densities();
    let sound = |density, pressure| gas.lagrangian_sound_speed(density, pressure);
    let first = states(&tube).map(|state| sound(state.density(), state.pressure()));
    let star = sound(left, solution.pressure()).max(sound(right, solution.pressure()));
    star / first[0].max(first[1])
}

fn star_states() -> Table {
    let mut table = Table::new(
        "Exact solutions: pressure and velocity of the star region, densities on both sides of the contact",
        &[
            ("test", Align::Left),
            ("left wave", Align::Left),
            ("right wave", Align::Left),
            ("p*", Align::Right),
            ("v*", Align::Right),
            ("ρ* left", Align::Right),
            ("ρ* right", Align::Right),
            ("C growth", Align::Right),
        ],
    );
    for test in 1..=4 {
        let tube = tube(test);
        let (solution, _) = tube.riemann().expect("a tube is a Riemann problem");
        let (left, right) = solution.densities();
        // Test 2 is symmetric: v* is round-off there.
        let velocity = if solution.velocity().abs() < 1e-12 { 0.0 } else { solution.velocity() };
        table.push([
            test.to_string(),
            wave_name(solution.left_wave()).into(),
            wave_name(solution.right_wave()).into(),
            significant(solution.pressure(), 7),
            significant(velocity, 7),
            significant(left, 7),
            significant(right, 7),
            significant(sound_growth(test), 4),
        ]);
    }
    table
}
