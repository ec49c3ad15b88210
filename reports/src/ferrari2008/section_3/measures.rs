//! What section 3.3 says of its figures: the measures by the names that the claims use.

use super::runs::{Runs, TestRun};
use super::text;
use super::windows::{self, Places, Variable};
use crate::claim::{Claim, Claims, rows};
use crate::page::Item;
use courant_simulation::comparison::Comparison;
use courant_simulation::riemann::{Solution, Wave};
use courant_simulation::scene::Scene;
use std::borrow::Cow;

/// The table of claims. What is said of one wave is measured in the window of that wave, between the exact places of
/// the waves.
pub fn claims(runs: &Runs) -> Item {
    let claims = Claims::from_toml(include_str!("../../../papers/ferrari2008/claims.toml"))
        .expect("the file of claims is read by a test");
    let found = claims
        .judge(|claim, name, arguments, member| {
            measure(run(runs, claim, member)?.as_ref(), name, arguments)
        })
        .expect("the claims are judged by a test");
    text().table("section_3_statements", &[], rows(&found))
}

/// The run of a claim's test by a member: a method, with options where it is not run as in the figures.
fn run<'a>(runs: &'a Runs, claim: &Claim, member: &str) -> Option<Cow<'a, TestRun>> {
    let test = claim.place.strip_prefix("test ")?.parse().ok()?;
    match member.split_once(' ') {
        None => Some(Cow::Borrowed(runs.get(test, member))),
        Some((name, option)) => TestRun::with_option(test, name, option).map(Cow::Owned),
    }
}

/// A number of one run; not a number where there is none.
fn measure(run: &TestRun, name: &str, arguments: &[&str]) -> Option<f64> {
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
        "energy-drift" => drift.energy.abs(),
        "rarefaction-error" => rarefaction_error(run),
        "points-in-contact" => points_in_contact(run),
        "points-in-shock" => points_in_shock(run),
        "worst-energy" => worst_energy(run),
        _ => return None,
    })
}

fn solution(run: &TestRun) -> (&Solution, f64) {
    run.tube.riemann().expect("a tube is a Riemann problem")
}

/// `Σ|e|/N` of the velocity inside the left rarefaction over the difference across it.
fn rarefaction_error(run: &TestRun) -> f64 {
    let across = (solution(run).0.velocity() - run.tube.left().velocity()).abs();
    let window = Places::of(run).window("left-wave").expect("it is a window");
    Comparison::inside(&run.tube, &run.run, window).l1.velocity / across
}

/// Points with a value strictly between 10 and 90 % of the way between two levels, near a place.
fn points_in_jump(run: &TestRun, column: &[f64], levels: [f64; 2], speed: f64) -> f64 {
    let place = solution(run).1 + speed * run.run.time;
    let inside = |(x, value): &(&f64, &f64)| {
        let part = (*value - levels[0]) / (levels[1] - levels[0]);
        (*x - place).abs() < 0.12 && part > 0.1 && part < 0.9
    };
    run.run.profile.x.iter().zip(column).filter(inside).count() as f64
}

fn points_in_contact(run: &TestRun) -> f64 {
    let (solution, _) = solution(run);
    let (left, right) = solution.densities();
    points_in_jump(run, &run.run.profile.density, [left, right], solution.velocity())
}

/// Points in the shock on the right; not a number where there is none.
fn points_in_shock(run: &TestRun) -> f64 {
    let (solution, _) = solution(run);
    let Wave::Shock { speed } = solution.right_wave() else { return f64::NAN };
    let levels = [solution.pressure(), run.tube.right().pressure()];
    points_in_jump(run, &run.run.profile.pressure, levels, speed)
}

/// Largest ratio of computed to exact internal energy inside the domain.
fn worst_energy(run: &TestRun) -> f64 {
    let (tube, profile) = (&run.tube, &run.run.profile);
    let ratio = |i: usize| {
        let exact = tube.exact(profile.x[i], run.run.time);
        profile.energy[i] / tube.gas().internal_energy(exact.density(), exact.pressure())
    };
    profile.inside(tube.domain()).into_iter().map(ratio).fold(0.0, f64::max)
}
