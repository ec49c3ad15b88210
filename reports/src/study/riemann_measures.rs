//! What is measured of a run of a Riemann problem, by the names that claims use. What is said of one wave is measured in
//! the window of that wave, between the exact places of the waves.

use super::riemann_run::{RiemannRun, exact, gas, solution, states};
use super::wave_windows::{self as windows, Places, Variable};
use courant_simulation::comparison::Comparison;
use courant_simulation::riemann::Wave;

/// A number of one run, by the name that claims use; not a number where there is none, `None` where nothing has that name.
pub fn measure(run: &RiemannRun, name: &str, arguments: &[&str]) -> Option<f64> {
    let comparison = &run.comparison;
    let or_none = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let flag = |holds: bool| f64::from(u8::from(holds));
    let drift = run.run.conservation;
    if let [variable, window] = arguments {
        let variable = Variable::named(variable)?;
        let window = Places::of(run).window(window)?;
        return Some(match name {
            "error" => windows::error(run, variable, window),
            "overshoot" => windows::overshoot(run, variable, window),
            "oscillation" => windows::oscillation(run, variable, window),
            _ => return None,
        });
    }
    if let [variable] = arguments {
        let variable = Variable::named(variable)?;
        return Some(match name {
            "relative-error" => variable.column(&comparison.l1) / windows::range(run, variable),
            "excess-variation" => variable.column(&comparison.excess_variation),
            _ => return None,
        });
    }
    Some(match name {
        "glitch" => or_none(comparison.glitch),
        "contact-width" => or_none(comparison.contact_width),
        "contact-distance" => or_none(run.contact_error()),
        "density-error" => comparison.l1.density,
        "spacing" => or_none(comparison.spacing_mismatch),
        "out-of-order" => flag(!comparison.order_preserved),
        "left-in-domain" => run.left_in_domain() as f64,
        "failed" => flag(run.run.failure.is_some()),
        "momentum-drift" => drift.momentum.abs(),
        "energy-drift" => or_none(drift.energy).abs(),
        "rarefaction-error" => rarefaction_error(run),
        "points-in-contact" => points_in_contact(run),
        "points-in-shock" => points_in_shock(run),
        "worst-energy" => worst_energy(run),
        _ => return None,
    })
}

/// `Σ|e|/N` of the velocity inside the left rarefaction over the difference across it.
fn rarefaction_error(run: &RiemannRun) -> f64 {
    let across = (solution(&run.tube).0.velocity() - states(&run.tube)[0].velocity()).abs();
    let window = Places::of(run).window("left-wave").expect("it is a window");
    Comparison::inside(&run.tube, &run.run, window).map_or(f64::NAN, |found| found.l1.velocity)
        / across
}

/// Points with a value strictly between 10 and 90 % of the way between two levels, near a place.
fn points_in_jump(run: &RiemannRun, column: &[f64], levels: [f64; 2], speed: f64) -> f64 {
    let place = solution(&run.tube).1 + speed * run.run.time;
    let inside = |(x, value): &(&f64, &f64)| {
        let part = (*value - levels[0]) / (levels[1] - levels[0]);
        (*x - place).abs() < 0.12 && part > 0.1 && part < 0.9
    };
    run.run.profile.x.iter().zip(column).filter(inside).count() as f64
}

fn points_in_contact(run: &RiemannRun) -> f64 {
    let (solution, _) = solution(&run.tube);
    let (left, right) = solution.densities();
    points_in_jump(run, &run.run.profile.density, [left, right], solution.velocity())
}

/// Points in the shock on the right; not a number where there is none.
fn points_in_shock(run: &RiemannRun) -> f64 {
    let (solution, _) = solution(&run.tube);
    let Wave::Shock { speed } = solution.right_wave() else { return f64::NAN };
    let levels = [solution.pressure(), states(&run.tube)[1].pressure()];
    points_in_jump(run, &run.run.profile.pressure, levels, speed)
}

/// Largest ratio of computed to exact internal energy inside the domain.
fn worst_energy(run: &RiemannRun) -> f64 {
    let (tube, profile) = (&run.tube, &run.run.profile);
    let ratio = |i: usize| {
        let exact = exact(tube, profile.x[i], run.run.time);
        profile.energy[i] / gas(tube).internal_energy(exact.density(), exact.pressure())
    };
    profile.inside(tube.domain).into_iter().map(ratio).fold(0.0, f64::max)
}
