//! What the paper says of test 4: two colliding shocks and a contact.

use super::{Row, Verdict, compared, conservation, density_error_of_roe, n, three, width};
use crate::ferrari2008::section_3::runs::{LAGRANGIAN, Runs, TestRun};
use courant_simulation::lagrangian::LagrangianOptions;
use courant_simulation::lagrangian::flux::{Flux, ModifiedRoe};

pub(super) fn rows(runs: &Runs) -> Vec<Row> {
    let volumes = runs.volumes(4);
    let standard = runs.standard(4);
    let pressures = runs.lagrangian(4, |run| run.comparison.l1.pressure);
    let widths = runs.lagrangian(4, width);
    let densities = runs.lagrangian(4, |run| run.comparison.l1.density);
    let gaps = runs.lagrangian(4, spacing);
    let fine = spacing_with_small_steps();
    let (drift, not_conserved) = conservation(standard);
    let variation = &standard.comparison.excess_variation;
    let roe = density_error_of_roe(4, 0.4);
    let out_of_order =
        LAGRANGIAN.iter().filter(|name| !runs.get(4, name).comparison.order_preserved).count();
    vec![
        (
            "the shocks are more accurate in finite volumes, as in test 1",
            format!(
                "Σ|e|/N of p: finite volumes {}; {}",
                n(volumes.comparison.l1.pressure),
                three(pressures, n)
            ),
            Verdict::of(&pressures.map(|error| error > volumes.comparison.l1.pressure)),
        ),
        (
            "the contact is smeared in finite volumes",
            format!("width: finite volumes {}; {}", n(width(volumes)), three(widths, n)),
            // NaN where the jump is not resolved is no evidence.
            Verdict::of(&[width(volumes) > widths[0], width(volumes) > widths[2]]),
        ),
        (
            "standard SPH oscillates",
            format!(
                "total variation beyond the exact one, over the range: ρ {}, v {}, p {}",
                n(variation.density),
                n(variation.velocity),
                n(variation.pressure)
            ),
            Verdict::of(&[variation.velocity > 0.1, variation.pressure > 0.1]),
        ),
        ("standard SPH does not conserve", drift, not_conserved),
        (
            "particles interpenetrate: a jump within the contact, in physical space only",
            format!(
                "distance of neighbours over the one their densities ask for, less 1: {}; particles out of \
                 order in {out_of_order} of 3 runs",
                three(gaps, n)
            ),
            Verdict::of(&gaps.map(|gap| gap < -1.0)),
        ),
        (
            "the jump is more evident with Rusanov's flux",
            format!("as above: {}", three(gaps, n)),
            Verdict::of(&[gaps[1] < gaps[0], gaps[1] < gaps[2]]),
        ),
        (
            "a more accurate integration of the positions will cure the interpenetration",
            format!("as above with 90 times smaller steps: {}", three(fine, n)),
            Verdict::of(&[fine.iter().all(|&gap| gap > -1.0)]),
        ),
        (
            "the modified Roe flux is the most accurate",
            format!("Σ|e|/N of ρ: {}; Roe with α̃ = 0.4: {}", three(densities, n), n(roe)),
            Verdict::of(&[
                densities[2] < densities[0] && densities[2] < densities[1],
                roe < densities[0] && roe < densities[1],
            ]),
        ),
    ]
}

fn spacing(run: &TestRun) -> f64 {
    run.comparison.spacing_mismatch.unwrap_or(f64::NAN)
}

/// [`spacing`] of the three fluxes with small steps.
fn spacing_with_small_steps() -> [f64; 3] {
    [Flux::Exact, Flux::Rusanov, Flux::ModifiedRoe(ModifiedRoe::default())].map(|flux| {
        let options = LagrangianOptions { cfl: 0.01, ..LagrangianOptions::new(flux) };
        compared(4, options).spacing_mismatch.unwrap_or(f64::NAN)
    })
}
