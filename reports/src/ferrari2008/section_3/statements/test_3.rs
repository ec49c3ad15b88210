//! What the paper says of test 3: a strong shock.

use super::windows::{Places, Variable, oscillation, overshoot};
use super::{Row, Verdict, density_error_of_roe, n, percent, three, wave_error, width};
use crate::ferrari2008::section_3::runs::{Runs, TestRun};

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let standard = runs.standard(3);
    let volumes = runs.volumes(3);
    let over_tail = |run: &TestRun| overshoot(run, Variable::Velocity, Places::of(run).left_tail());
    let over = runs.lagrangian(3, over_tail);
    let at_contact = wave_error(Variable::Density, Places::contact);
    let contacts = runs.lagrangian(3, &at_contact);
    let shock_pressure = wave_error(Variable::Pressure, Places::right_of_contact);
    let shock_velocity = wave_error(Variable::Velocity, Places::right_of_contact);
    let shocks = [&shock_pressure as &dyn Fn(&TestRun) -> f64, &shock_velocity]
        .map(|error| (error(volumes), runs.lagrangian(3, error)));
    let widths = runs.lagrangian(3, width);
    let densities = runs.lagrangian(3, |run| run.comparison.l1.density);
    let window = |run: &TestRun| Places::of(run).contact();
    let energy = runs.lagrangian(3, |run| overshoot(run, Variable::Energy, window(run)));
    let [waves_in_energy, waves_in_density] = [Variable::Energy, Variable::Density]
        .map(|variable| runs.lagrangian(3, |run| oscillation(run, variable, window(run))));
    vec![
        (
            "standard SPH fails with 100 points",
            standard.run.failure.map_or("it ends".into(), |failure| failure.to_string()),
            Verdict::of(&[standard.run.failure.is_some()]),
        ),
        (
            "the velocity overshoots at the tail of the rarefaction in finite volumes, and less in the \
             Lagrangian schemes",
            format!(
                "there, over the range: finite volumes {}; {}",
                percent(over_tail(volumes)),
                three(over, percent)
            ),
            Verdict::of(&[over_tail(volumes) > 0.01, over.iter().all(|&v| v < over_tail(volumes))]),
        ),
        (
            "the contact is more accurate than in finite volumes",
            format!(
                "width: finite volumes {}; {}; ∫|e| dx of ρ at the contact: {}; {}",
                n(width(volumes)),
                three(widths, n),
                n(at_contact(volumes)),
                three(contacts, n)
            ),
            Verdict::of(&contacts.map(|error| error < at_contact(volumes))),
        ),
        (
            "the shock is more accurate than in finite volumes",
            format!(
                "∫|e| dx right of the contact: of p finite volumes {}, {}; of v {}, {}",
                n(shocks[0].0),
                three(shocks[0].1, n),
                n(shocks[1].0),
                three(shocks[1].1, n)
            ),
            Verdict::of(
                &shocks.map(|(volumes, errors)| errors.iter().all(|&error| error < volumes)),
            ),
        ),
        (
            "Rusanov's flux is very diffusive",
            format!("Σ|e|/N of ρ: {}", three(densities, n)),
            Verdict::of(&[densities[1] > 2.0 * densities[2] && densities[1] > 2.0 * densities[0]]),
        ),
        (
            "the exact flux oscillates at the contact",
            format!(
                "there: overshoot of the internal energy over its range: {}; total variation beyond that of a \
                 monotone profile, over the range: of e {}, of ρ {}",
                three(energy, percent),
                three(waves_in_energy, percent),
                three(waves_in_density, percent)
            ),
            Verdict::of(&[energy[0] > 0.01, waves_in_energy[0].max(waves_in_density[0]) > 0.01]),
        ),
        (
            "the modified Roe flux follows the exact solution best",
            {
                let best =
                    [0.0, 0.05, 0.1, 0.2, 0.5, 1.0].map(|alpha| density_error_of_roe(3, alpha));
                format!(
                    "Σ|e|/N of ρ: {}; Roe at its best α̃ of 0, 0.05, 0.1, 0.2, 0.5, 1: {}",
                    three(densities, n),
                    n(best.into_iter().fold(f64::INFINITY, f64::min))
                )
            },
            Verdict::of(&[densities[2] < densities[0]]),
        ),
    ]
}
