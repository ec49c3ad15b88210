//! What the paper says of test 2: two rarefactions, nearly a vacuum between.

use super::{Row, Verdict, n, percent, three};
use crate::ferrari2008::section_3::runs::{Runs, TestRun};
use courant_simulation::scene::Scene;

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let left = runs.lagrangian(2, |run| run.left_in_domain() as f64);
    let worst = runs.lagrangian(2, worst_energy);
    let [density, velocity, pressure] =
        [0, 1, 2].map(|which| runs.lagrangian(2, |run| relative_errors(run)[which]));
    vec![
        (
            "points leave the domain, so few are left to resolve the star region",
            format!("left of 100: {}", three(left, |v| v.to_string())),
            Verdict::of(&left.map(|count| count < 60.0)),
        ),
        (
            "density, velocity and pressure are quite satisfactory",
            format!(
                "Σ|e|/N over the range: ρ {}; v {}; p {} (satisfactory: below 10 %)",
                three(density, percent),
                three(velocity, percent),
                three(pressure, percent)
            ),
            Verdict::of(&[density, velocity, pressure].map(|e| e.iter().all(|&e| e < 0.1))),
        ),
        (
            "the internal energy is really inaccurate",
            format!("largest computed over exact: {}", three(worst, n)),
            Verdict::of(&worst.map(|ratio| ratio > 1.5)),
        ),
    ]
}

/// `Σ|e|/N` of density, velocity and pressure over the ranges of the exact ones.
fn relative_errors(run: &TestRun) -> [f64; 3] {
    let tube = &run.tube;
    let (solution, _) = tube.riemann().expect("a tube is a Riemann problem");
    let star = solution.sample(solution.velocity());
    let (outer, l1) = (tube.left(), &run.comparison.l1);
    [
        l1.density / (outer.density() - star.density()),
        l1.velocity / (tube.right().velocity() - outer.velocity()),
        l1.pressure / (outer.pressure() - star.pressure()),
    ]
}

/// Largest ratio of computed to exact internal energy inside the domain.
fn worst_energy(run: &TestRun) -> f64 {
    let (tube, profile) = (&run.tube, &run.run.profile);
    profile
        .inside(tube.domain())
        .into_iter()
        .map(|i| {
            let exact = tube.exact(profile.x[i], run.run.time);
            profile.energy[i] / tube.gas().internal_energy(exact.density(), exact.pressure())
        })
        .fold(0.0, f64::max)
}
