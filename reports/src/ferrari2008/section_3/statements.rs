//! What section 3.3 of the paper says about its figures, each statement beside a number.

use super::runs::{LAGRANGIAN, PARTICLES, Runs, TestRun, tube};
use super::table_item;
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_simulation::comparison::Comparison;
use courant_simulation::lagrangian::LagrangianOptions;
use courant_simulation::lagrangian::flux::{ContactViscosity, Flux, ModifiedRoe};
use courant_simulation::method::Method;
use courant_simulation::riemann::Wave;
use courant_simulation::scene::Scene;

/// What became of a statement. It follows from the numbers, by the conditions written beside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Confirmed,
    Partly,
    Contradicted,
}

impl Verdict {
    /// All, none or some of the conditions hold.
    fn of(conditions: &[bool]) -> Self {
        match conditions.iter().filter(|&&holds| holds).count() {
            0 => Self::Contradicted,
            n if n == conditions.len() => Self::Confirmed,
            _ => Self::Partly,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Partly => "partly",
            Self::Contradicted => "contradicted",
        }
    }
}

/// Number with three digits.
fn n(value: f64) -> String {
    significant(value, 3)
}

/// Per cent.
fn percent(value: f64) -> String {
    format!("{:.1} %", 100.0 * value)
}

/// `exact …, Rusanov …, Roe …`.
fn three(values: [f64; 3], write: impl Fn(f64) -> String) -> String {
    let [exact, rusanov, roe] = values.map(write);
    format!("exact {exact}, Rusanov {rusanov}, Roe {roe}")
}

/// The measures that the statements share.
struct Measures<'a>(&'a Runs);

impl Measures<'_> {
    fn volumes(&self, test: usize) -> &TestRun {
        self.0.get(test, "finite-volume")
    }

    fn standard(&self, test: usize) -> &TestRun {
        self.0.get(test, "sph-adke")
    }

    /// A measure of the exact, Rusanov and Roe runs; NaN where there is none.
    fn lagrangian(&self, test: usize, measure: impl Fn(&TestRun) -> f64) -> [f64; 3] {
        LAGRANGIAN.map(|name| measure(self.0.get(test, name)))
    }
}

fn glitch(run: &TestRun) -> f64 {
    run.comparison.glitch.unwrap_or(f64::NAN)
}

fn width(run: &TestRun) -> f64 {
    run.comparison.contact_width.unwrap_or(f64::NAN)
}

fn contact(run: &TestRun) -> f64 {
    run.contact_error().unwrap_or(f64::NAN)
}

fn spacing(run: &TestRun) -> f64 {
    run.comparison.spacing_mismatch.unwrap_or(f64::NAN)
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

/// The range of the exact density, velocity and pressure of test 2 over which errors count.
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

/// The Roe flux with another contact viscosity, and the three fluxes with another Courant number.
fn density_error_of_roe(test: usize, alpha: f64) -> f64 {
    let contact = ContactViscosity::Printed(alpha);
    let flux = Flux::ModifiedRoe(ModifiedRoe { contact, ..ModifiedRoe::default() });
    let tube = tube(test);
    let run = Method::Lagrangian(LagrangianOptions::new(flux)).run(&tube, PARTICLES);
    Comparison::new(&tube, &run.expect("the options are valid")).l1.density
}

fn spacing_with_small_steps() -> [f64; 3] {
    [Flux::Exact, Flux::Rusanov, Flux::ModifiedRoe(ModifiedRoe::default())].map(|flux| {
        let options = LagrangianOptions { cfl: 0.01, ..LagrangianOptions::new(flux) };
        let tube = tube(4);
        let run = Method::Lagrangian(options).run(&tube, PARTICLES).expect("the options are valid");
        Comparison::new(&tube, &run).spacing_mismatch.unwrap_or(f64::NAN)
    })
}

/// The table.
pub fn table(runs: &Runs) -> Item {
    let mut table = Table::new(
        "Statements of section 3.3 against numbers: N = 100, settings as in the figures",
        &[
            ("test", Align::Left),
            ("the paper says", Align::Left),
            ("measured", Align::Left),
            ("verdict", Align::Left),
        ],
    );
    let measures = Measures(runs);
    let rows = test_1(&measures)
        .into_iter()
        .chain(test_2(&measures))
        .chain(test_3(&measures))
        .chain(test_4(&measures));
    for (test, statement, measured, verdict) in rows {
        table.push([test.to_string(), statement.into(), measured, verdict.name().into()]);
    }
    table_item("section_3_statements", table)
}

type Row = (usize, &'static str, String, Verdict);

fn test_1(m: &Measures<'_>) -> Vec<Row> {
    let glitches = m.lagrangian(1, glitch);
    let volumes = m.volumes(1);
    let standard = m.standard(1);
    let rarefactions = m.lagrangian(1, rarefaction_error);
    let widths = m.lagrangian(1, width);
    let places = m.lagrangian(1, contact);
    let over = m.lagrangian(1, |run| run.comparison.overshoot.energy);
    let energies = m.lagrangian(1, |run| run.comparison.l1.energy);
    let [in_contact, in_shock] =
        [0, 1].map(|which| m.lagrangian(1, |run| points_in_contact_and_shock(run)[which] as f64));
    let drift = standard.run.conservation;
    let variation = &standard.comparison.excess_variation;
    let calm = m.lagrangian(1, |run| run.comparison.excess_variation.pressure);
    vec![
        (
            1,
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
            1,
            "unlike standard SPH, the Lagrangian schemes approximate the rarefaction reasonably well",
            format!(
                "Σ|e|/N of v inside the rarefaction over the difference across it: standard SPH {}; {}",
                percent(rarefaction_error(standard)),
                three(rarefactions, percent)
            ),
            Verdict::of(&rarefactions.map(|error| error < rarefaction_error(standard))),
        ),
        (
            1,
            "the contact is sharper than in finite volumes",
            format!(
                "width of the contact: finite volumes {}; {}",
                n(width(volumes)),
                three(widths, n)
            ),
            Verdict::of(&widths.map(|w| w < width(volumes))),
        ),
        (
            1,
            "in the Lagrangian schemes the contact is resolved better than the shock",
            format!(
                "particles inside the middle 80 % of the jump: contact {}; shock {}",
                three(in_contact, |v| v.to_string()),
                three(in_shock, |v| v.to_string())
            ),
            Verdict::of(&[0, 1, 2].map(|i| in_contact[i] < in_shock[i])),
        ),
        (
            1,
            "the exact flux places the contact very well",
            format!("distance from its exact place: {}", three(places, n)),
            Verdict::of(&[places[0] < places[1], places[0] < places[2], places[0] < 0.01]),
        ),
        (
            1,
            "the exact flux oscillates at the contact",
            format!("overshoot of the internal energy over its range: {}", three(over, percent)),
            Verdict::of(&[over[0] > 0.1]),
        ),
        (
            1,
            "the modified Roe flux resolves the contact better",
            format!(
                "overshoot as above; width {}; Σ|e|/N of e: {}",
                three(widths, n),
                three(energies, n)
            ),
            Verdict::of(&[over[2] < over[0], widths[2] < widths[0], energies[2] < energies[0]]),
        ),
        (
            1,
            "standard SPH is not perfectly conservative",
            format!("drift of momentum {}, of energy {}", n(drift.momentum), n(drift.energy)),
            Verdict::of(&[drift.momentum.abs() > 1e-12, drift.energy.abs() > 1e-12]),
        ),
        (
            1,
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

fn test_2(m: &Measures<'_>) -> Vec<Row> {
    let left = m.lagrangian(2, |run| run.left_in_domain() as f64);
    let worst = m.lagrangian(2, worst_energy);
    let [density, velocity, pressure] =
        [0, 1, 2].map(|which| m.lagrangian(2, |run| relative_errors(run)[which]));
    vec![
        (
            2,
            "points leave the domain, so few are left to resolve the star region",
            format!("left of 100: {}", three(left, |v| v.to_string())),
            Verdict::of(&left.map(|count| count < 60.0)),
        ),
        (
            2,
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
            2,
            "the internal energy is really inaccurate",
            format!("largest computed over exact: {}", three(worst, n)),
            Verdict::of(&worst.map(|ratio| ratio > 1.5)),
        ),
    ]
}

fn test_3(m: &Measures<'_>) -> Vec<Row> {
    let standard = m.standard(3);
    let volumes = &m.volumes(3).comparison;
    let over = m.lagrangian(3, |run| run.comparison.overshoot.velocity);
    let widths = m.lagrangian(3, width);
    let densities = m.lagrangian(3, |run| run.comparison.l1.density);
    let pressures = m.lagrangian(3, |run| run.comparison.l1.pressure);
    let energy = m.lagrangian(3, |run| run.comparison.overshoot.energy);
    let waves_in_energy = m.lagrangian(3, |run| run.comparison.excess_variation.energy);
    let waves_in_density = m.lagrangian(3, |run| run.comparison.excess_variation.density);
    let volumes_width = volumes.contact_width.unwrap_or(f64::NAN);
    vec![
        (
            3,
            "standard SPH fails with 100 points",
            standard.run.failure.map_or("it ends".into(), |failure| failure.to_string()),
            Verdict::of(&[standard.run.failure.is_some()]),
        ),
        (
            3,
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
            3,
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
            3,
            "the shock is more accurate than in finite volumes",
            format!(
                "Σ|e|/N of p, which has no jump at the contact: finite volumes {}; {}",
                n(volumes.l1.pressure),
                three(pressures, n)
            ),
            Verdict::of(&pressures.map(|error| error < volumes.l1.pressure)),
        ),
        (
            3,
            "Rusanov's flux is very diffusive",
            format!("Σ|e|/N of ρ: {}", three(densities, n)),
            Verdict::of(&[densities[1] > 2.0 * densities[2] && densities[1] > 2.0 * densities[0]]),
        ),
        (
            3,
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
            3,
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

fn test_4(m: &Measures<'_>) -> Vec<Row> {
    let volumes = m.volumes(4);
    let standard = m.standard(4);
    let pressures = m.lagrangian(4, |run| run.comparison.l1.pressure);
    let widths = m.lagrangian(4, width);
    let densities = m.lagrangian(4, |run| run.comparison.l1.density);
    let gaps = m.lagrangian(4, spacing);
    let fine = spacing_with_small_steps();
    let drift = standard.run.conservation;
    let variation = &standard.comparison.excess_variation;
    let roe = density_error_of_roe(4, 0.4);
    let out_of_order =
        LAGRANGIAN.iter().filter(|name| !m.0.get(4, name).comparison.order_preserved).count();
    vec![
        (
            4,
            "the shocks are more accurate in finite volumes, as in test 1",
            format!(
                "Σ|e|/N of p: finite volumes {}; {}",
                n(volumes.comparison.l1.pressure),
                three(pressures, n)
            ),
            Verdict::of(&pressures.map(|error| error > volumes.comparison.l1.pressure)),
        ),
        (
            4,
            "the contact is smeared in finite volumes",
            format!("width: finite volumes {}; {}", n(width(volumes)), three(widths, n)),
            // NaN where the jump is not resolved is no evidence.
            Verdict::of(&[width(volumes) > widths[0], width(volumes) > widths[2]]),
        ),
        (
            4,
            "standard SPH oscillates",
            format!(
                "total variation beyond the exact one, over the range: ρ {}, v {}, p {}",
                n(variation.density),
                n(variation.velocity),
                n(variation.pressure)
            ),
            Verdict::of(&[variation.velocity > 0.1, variation.pressure > 0.1]),
        ),
        (
            4,
            "standard SPH does not conserve",
            format!("drift of momentum {}, of energy {}", n(drift.momentum), n(drift.energy)),
            Verdict::of(&[drift.momentum.abs() > 1e-12, drift.energy.abs() > 1e-12]),
        ),
        (
            4,
            "particles interpenetrate: a jump within the contact, in physical space only",
            format!(
                "distance of neighbours over the one their densities ask for, less 1: {}; particles out of \
                 order in {out_of_order} of 3 runs",
                three(gaps, n)
            ),
            Verdict::of(&gaps.map(|gap| gap < -1.0)),
        ),
        (
            4,
            "the jump is more evident with Rusanov's flux",
            format!("as above: {}", three(gaps, n)),
            Verdict::of(&[gaps[1] < gaps[0], gaps[1] < gaps[2]]),
        ),
        (
            4,
            "a more accurate integration of the positions will cure the interpenetration",
            format!("as above with 90 times smaller steps: {}", three(fine, n)),
            Verdict::of(&[fine.iter().all(|&gap| gap > -1.0)]),
        ),
        (
            4,
            "the modified Roe flux is the most accurate",
            format!("Σ|e|/N of ρ: {}; Roe with α̃ = 0.4: {}", three(densities, n), n(roe)),
            Verdict::of(&[
                densities[2] < densities[0] && densities[2] < densities[1],
                roe < densities[0] && roe < densities[1],
            ]),
        ),
    ]
}
