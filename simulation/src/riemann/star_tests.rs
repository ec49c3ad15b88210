//! The star-state solvers against the exact solution, a bisection, and hard cases.

use super::isothermal::{Expansion, Isothermal};
use super::{ExactIdeal, IdealGas, Star, StarSolver, State, Stopping, VanLeer, solve};
use crate::bisection::root;
use proptest::prelude::*;

fn van_leer(gamma: f64, stopping: Stopping) -> VanLeer {
    VanLeer { gas: IdealGas::new(gamma).expect("gamma > 1"), stopping }
}

fn state(density: f64, velocity: f64, pressure: f64) -> State {
    State::new(density, velocity, pressure).expect("physical")
}

/// Van Leer's `W` of a rarefaction makes `v*` exact at any `P*` (it is the chord of the isentrope), so
/// the converged iteration solves the exact problem.
fn agrees_with_the_exact_solution(left: &State, right: &State, gamma: f64) {
    let solver = van_leer(gamma, Stopping::Converged);
    let star = solver.star(left, right);
    let exact = solve(solver.gas, left, right);
    assert!(star.pressure > 0.0 && star.velocity.is_finite());
    assert!(star.iterations < 100, "{left:?} {right:?} {star:?}");
    if matches!(exact.star(), Star::Contact { .. })
        && exact.pressure() > 1e-9 * left.pressure().min(right.pressure())
    {
        // v* loses digits relative to the speeds in play, P* those of P^(1/7) near a vacuum.
        let speed = left.velocity().abs()
            + right.velocity().abs()
            + solver.gas.sound_speed(left.density(), left.pressure())
            + solver.gas.sound_speed(right.density(), right.pressure());
        let error = (star.pressure / exact.pressure() - 1.0).abs();
        assert!(error < 1e-9, "{left:?} {right:?} {error:e}");
        assert!((star.velocity - exact.velocity()).abs() < 1e-10 * speed);
    }
}

#[test]
fn published_rule_keeps_close_guesses_and_stops_early() {
    let published = van_leer(1.4, Stopping::Published);
    let quiet = published.star(&state(1.0, 0.0, 1.0), &state(1.0, 0.0, 1.005));
    assert_eq!(quiet.iterations, 0);
    let (left, right) = (state(1.0, 0.0, 3e3), state(1.0, 0.0, 1e-7));
    let star = published.star(&left, &right);
    let converged = van_leer(1.4, Stopping::Converged).star(&left, &right);
    assert!(star.iterations > 0 && star.iterations < converged.iterations);
    // Newton squares its last step of less than 1.5 per cent.
    assert!((star.pressure / converged.pressure - 1.0).abs() < 1e-3);
}

#[test]
fn guess_is_negative_for_the_123_problem_and_is_protected() {
    let (left, right) = (state(1.0, -2.0, 0.4), state(1.0, 2.0, 0.4));
    for stopping in [Stopping::Published, Stopping::Converged] {
        let solver = van_leer(1.4, stopping);
        assert!(solver.first_guess(&left, &right) < 0.0);
        assert!(solver.star(&left, &right).pressure > 0.0);
    }
    // A vacuum: no root, the floor.
    let (left, right) = (state(1.0, -20.0, 0.4), state(1.0, 20.0, 0.4));
    let star = van_leer(1.4, Stopping::Converged).star(&left, &right);
    assert_eq!(star.pressure, super::PRESSURE_FLOOR * 0.4);
    assert_eq!(star.velocity, 0.0);
}

/// Bisection on `ln ρ*`, sharing nothing with the solver but the jump relations.
fn bisected_density(left: &State, right: &State, c: f64, expansion: Expansion) -> f64 {
    let jump = |y: f64| {
        if y > 0.0 || expansion == Expansion::AsShock { 2.0 * (0.5 * y).sinh() } else { y }
    };
    let excess = |y: f64| {
        jump(y - left.density().ln()) + jump(y - right.density().ln())
            - (left.velocity() - right.velocity()) / c
    };
    root(-300.0, 300.0, excess).exp()
}

prop_compose! {
    fn any_state()(density in -7.0..7.0_f64, velocity in -30.0..30.0_f64, pressure in -6.0..6.0_f64)
        -> State { state(10f64.powf(density), velocity, 10f64.powf(pressure)) }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn converged_iteration_is_exact(left in any_state(), right in any_state(), gamma in 1.1..2.0_f64) {
        agrees_with_the_exact_solution(&left, &right, gamma);
    }

    #[test]
    fn no_solver_fails(left in any_state(), right in any_state()) {
        let gas = IdealGas::new(1.4).expect("gamma > 1");
        let solvers: [&dyn StarSolver; 5] = [
            &van_leer(1.4, Stopping::Published),
            &van_leer(1.4, Stopping::Converged),
            &ExactIdeal(gas),
            &Isothermal { sound_speed: 1.0, expansion: Expansion::Exact },
            &Isothermal { sound_speed: 1.0, expansion: Expansion::AsShock },
        ];
        for solver in solvers {
            let star = solver.star(&left, &right);
            prop_assert!(star.pressure >= 0.0 && star.pressure.is_finite());
            prop_assert!(star.velocity.is_finite());
            // The problem in a mirror has the mirrored answer.
            let mirror = |s: &State| state(s.density(), -s.velocity(), s.pressure());
            let mirrored = solver.star(&mirror(&right), &mirror(&left));
            prop_assert!((mirrored.pressure - star.pressure).abs() <= 1e-9 * star.pressure);
        }
    }

    #[test]
    fn isothermal_star_state_is_the_bisected_one(
        densities in (-3.0..3.0_f64, -3.0..3.0_f64),
        velocities in (-9.0..9.0_f64, -9.0..9.0_f64),
        c in 0.5..2.0_f64,
    ) {
        let make = |exponent: f64, velocity| {
            let density = 10f64.powf(exponent);
            state(density, velocity, c * c * density)
        };
        let (left, right) = (make(densities.0, velocities.0), make(densities.1, velocities.1));
        for expansion in [Expansion::Exact, Expansion::AsShock] {
            let star = Isothermal { sound_speed: c, expansion }.star(&left, &right);
            let density = bisected_density(&left, &right, c, expansion);
            prop_assert!((star.pressure / (c * c * density) - 1.0).abs() < 1e-11);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50))]

    /// Integrating the sampled solution over x gives the mass and momentum that the end states' fluxes
    /// bring in: the fan is consistent with the star state.
    #[test]
    fn isothermal_solution_conserves(ratio in 0.1..10.0_f64, approach in -2.0..2.0_f64) {
        let solver = Isothermal { sound_speed: 1.0, expansion: Expansion::Exact };
        let (left, right) = (state(1.0, approach, 1.0), state(ratio, 0.0, ratio));
        let (cells, half_width) = (8_000, 8.0);
        let dx = 2.0 * half_width / f64::from(cells);
        let (mut mass, mut momentum) = (0.0, 0.0);
        for cell in 0..cells {
            let at = solver.sample(&left, &right, (f64::from(cell) + 0.5) * dx - half_width);
            mass += at.density() * dx;
            momentum += at.density() * at.velocity() * dx;
        }
        // At t = 1: what was there, and what the two ends let through.
        prop_assert!((mass - (half_width * (1.0 + ratio) + approach)).abs() < 20.0 * dx * (1.0 + ratio));
        let flux = (approach * approach + 1.0) - ratio;
        prop_assert!((momentum - (half_width * approach + flux)).abs() < 60.0 * dx * (1.0 + ratio));
    }
}
