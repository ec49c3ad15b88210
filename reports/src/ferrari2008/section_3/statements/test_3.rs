//! What the paper says of test 3: a strong shock.

use super::{Row, Verdict, density_error_of_roe, n, percent, three, width};
use crate::ferrari2008::section_3::runs::Runs;

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let standard = runs.standard(3);
    let volumes = &runs.volumes(3).comparison;
    let over = runs.lagrangian(3, |run| run.comparison.overshoot.velocity);
    let widths = runs.lagrangian(3, width);
    let densities = runs.lagrangian(3, |run| run.comparison.l1.density);
    let pressures = runs.lagrangian(3, |run| run.comparison.l1.pressure);
    let energy = runs.lagrangian(3, |run| run.comparison.overshoot.energy);
    let waves_in_energy = runs.lagrangian(3, |run| run.comparison.excess_variation.energy);
    let waves_in_density = runs.lagrangian(3, |run| run.comparison.excess_variation.density);
    let volumes_width = volumes.contact_width.unwrap_or(f64::NAN);
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
                "over the range: finite volumes {}; {}",
                percent(volumes.overshoot.velocity),
                three(over, percent)
            ),
            Verdict::of(&[
                volumes.overshoot.velocity > 0.01,
                over.iter().all(|&v| v < volumes.overshoot.velocity),
            ]),
        ),
        (
            "the contact is more accurate than in finite volumes",
            format!(
                "width: finite volumes {}; {}; Σ|e|/N of ρ: {}; {}",
                n(volumes_width),
                three(widths, n),
                n(volumes.l1.density),
                three(densities, n)
            ),
            Verdict::of(&[
                densities[0] < volumes.l1.density,
                densities[1] < volumes.l1.density,
                densities[2] < volumes.l1.density,
            ]),
        ),
        (
            "the shock is more accurate than in finite volumes",
            format!(
                "Σ|e|/N of p, which has no jump at the contact: finite volumes {}; {}",
                n(volumes.l1.pressure),
                three(pressures, n)
            ),
            Verdict::of(&pressures.map(|error| error < volumes.l1.pressure)),
        ),
        (
            "Rusanov's flux is very diffusive",
            format!("Σ|e|/N of ρ: {}", three(densities, n)),
            Verdict::of(&[densities[1] > 2.0 * densities[2] && densities[1] > 2.0 * densities[0]]),
        ),
        (
            "the exact flux oscillates at the contact",
            format!(
                "overshoot of the internal energy over its range: {}; total variation beyond the exact \
                 one over the range: of e {}, of ρ {}",
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
