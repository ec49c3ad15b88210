//! What the paper says of test 1: a sonic rarefaction, a contact and a shock.

use super::{Row, Verdict, conservation, n, percent, three, width};
use crate::ferrari2008::section_3::runs::{Runs, TestRun};
use courant_simulation::comparison::Comparison;
use courant_simulation::riemann::Wave;
use courant_simulation::scene::Scene;

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let glitches = runs.lagrangian(1, glitch);
    let volumes = runs.volumes(1);
    let standard = runs.standard(1);
    let rarefactions = runs.lagrangian(1, rarefaction_error);
    let widths = runs.lagrangian(1, width);
    let places = runs.lagrangian(1, contact);
    let over = runs.lagrangian(1, |run| run.comparison.overshoot.energy);
    let energies = runs.lagrangian(1, |run| run.comparison.l1.energy);
    let [in_contact, in_shock] = [0, 1]
        .map(|which| runs.lagrangian(1, |run| points_in_contact_and_shock(run)[which] as f64));
    let (drift, not_conserved) = conservation(standard);
    let variation = &standard.comparison.excess_variation;
    let calm = runs.lagrangian(1, |run| run.comparison.excess_variation.pressure);
    vec![
        (
            "finite volumes have an entropy glitch in the rarefaction, the Lagrangian schemes none",
            format!(
                "largest error of a velocity difference of neighbours over that of the wave: finite \
                 volumes {}; {}",
                percent(glitch(volumes)),
                three(glitches, percent)
            ),
            Verdict::of(&[glitch(volumes) > 0.1, glitches.iter().all(|&g| g < 0.03)]),
        ),
        (
            "unlike standard SPH, the Lagrangian schemes approximate the rarefaction reasonably well",
            format!(
                "Σ|e|/N of v inside the rarefaction over the difference across it: standard SPH {}; {}",
                percent(rarefaction_error(standard)),
                three(rarefactions, percent)
            ),
            Verdict::of(&rarefactions.map(|error| error < rarefaction_error(standard))),
        ),
        (
            "the contact is sharper than in finite volumes",
            format!(
                "width of the contact: finite volumes {}; {}",
                n(width(volumes)),
                three(widths, n)
            ),
            Verdict::of(&widths.map(|w| w < width(volumes))),
        ),
        (
            "in the Lagrangian schemes the contact is resolved better than the shock",
            format!(
                "particles inside the middle 80 % of the jump: contact {}; shock {}",
                three(in_contact, |v| v.to_string()),
                three(in_shock, |v| v.to_string())
            ),
            Verdict::of(&[0, 1, 2].map(|i| in_contact[i] < in_shock[i])),
        ),
        (
            "the exact flux places the contact very well",
            format!("distance from its exact place: {}", three(places, n)),
            Verdict::of(&[places[0] < places[1], places[0] < places[2], places[0] < 0.01]),
        ),
        (
            "the exact flux oscillates at the contact",
            format!("overshoot of the internal energy over its range: {}", three(over, percent)),
            Verdict::of(&[over[0] > 0.1]),
        ),
        (
            "the modified Roe flux resolves the contact better",
            format!(
                "overshoot as above; width {}; Σ|e|/N of e: {}",
                three(widths, n),
                three(energies, n)
            ),
            Verdict::of(&[over[2] < over[0], widths[2] < widths[0], energies[2] < energies[0]]),
        ),
        ("standard SPH is not perfectly conservative", drift, not_conserved),
        (
            "standard SPH oscillates at the contact in velocity and pressure",
            format!(
                "total variation beyond the exact one, over the range: v {}, p {}; the Lagrangian schemes \
                 in p: {}",
                n(variation.velocity),
                n(variation.pressure),
                three(calm, n)
            ),
            Verdict::of(&[
                variation.velocity > 0.1,
                variation.pressure > 0.1,
                calm.iter().all(|&v| v < 0.1),
            ]),
        ),
    ]
}

fn glitch(run: &TestRun) -> f64 {
    run.comparison.glitch.unwrap_or(f64::NAN)
}

fn contact(run: &TestRun) -> f64 {
    run.contact_error().unwrap_or(f64::NAN)
}

/// `Σ|e|/N` of the velocity inside the left rarefaction over the difference across it.
fn rarefaction_error(run: &TestRun) -> f64 {
    let (solution, origin) = run.tube.riemann().expect("a tube is a Riemann problem");
    let Wave::Rarefaction { head, tail } = solution.left_wave() else { return f64::NAN };
    let window = [head, tail].map(|speed| origin + speed * run.run.time);
    let across = (solution.velocity() - run.tube.left().velocity()).abs();
    Comparison::inside(&run.tube, &run.run, window).l1.velocity / across
}

/// Points with a value strictly between 10 and 90 % of the way between two levels, near a place.
fn points_in_jump(run: &TestRun, column: &[f64], levels: [f64; 2], place: f64) -> usize {
    let reach = 0.12;
    let profile = &run.run.profile;
    (0..profile.len())
        .filter(|&i| (profile.x[i] - place).abs() < reach)
        .filter(|&i| {
            let part = (column[i] - levels[0]) / (levels[1] - levels[0]);
            part > 0.1 && part < 0.9
        })
        .count()
}

/// Points in the contact and in the shock to its right.
fn points_in_contact_and_shock(run: &TestRun) -> [usize; 2] {
    let (solution, origin) = run.tube.riemann().expect("a tube is a Riemann problem");
    let (left, right) = solution.densities();
    let Wave::Shock { speed } = solution.right_wave() else { return [0, 0] };
    let at = |speed: f64| origin + speed * run.run.time;
    let profile = &run.run.profile;
    let pressures = [solution.pressure(), run.tube.right().pressure()];
    [
        points_in_jump(run, &profile.density, [left, right], at(solution.velocity())),
        points_in_jump(run, &profile.pressure, pressures, at(speed)),
    ]
}
