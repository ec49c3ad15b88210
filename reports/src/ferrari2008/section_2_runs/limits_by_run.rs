//! Stability limits found by running, and a million steps on either side of one.

use super::super::{COMMAND, Detail, ReportError};
use super::{discretisation, kernels};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::table::{Align, Table};
use courant_analysis::exact::rational::{Rational, integer, ratio, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::sampled_stability_limit;
use courant_simulation::advection::{
    AdvectionScheme, Discretisation, GrowthPlan, GrowthVerdict, LimitComparison, LongRun,
    NoBracket, RingModes, compare_limits, long_run,
};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Particles of the rings bisected: few, so that the ring's limit stands apart from the lattice's.
const PARTICLES: usize = 32;

/// Width to which a limit is bisected.
const RESOLUTION: f64 = 1e-6;

/// Longest run, in windows of steps over which a rate is taken.
const WINDOWS: usize = 4_000;

/// Steps of a window: long enough that the slow waves near a limit show their rates settling.
const STEPS_PER_WINDOW: u64 = 500;

/// Particles of the rings of long runs.
const LONG_PARTICLES: usize = 16;

pub(super) fn section(detail: Detail) -> Result<Section, ReportError> {
    let compared = compare(detail);
    let steps = match detail {
        Detail::Full => 1_000_000,
        Detail::Quick => 100_000,
    };
    let inside = compared
        .iter()
        .filter(|(_, found)| {
            found.as_ref().is_ok_and(|found| {
                let width = found.measured.unstable - found.measured.stable;
                (found.measured.stable - width..=found.measured.unstable + width)
                    .contains(&found.ring)
            })
        })
        .count();
    let text = format!(
        "The limit is looked for by running: noise on a ring of {PARTICLES} particles, stepped until the rate \
         of growth has settled, and the Courant number bisected to {RESOLUTION:.0e}. A ring holds the waves \
         φ = 2πm/{PARTICLES} only, so where the longest wave binds its limit lies above the proved limit of the \
         lattice, by a part that shrinks with the square of the number of particles. The bracket found by \
         running holds the symbol's limit on the ring in {inside} of {} cases.",
        compared.len()
    );
    let runs = long_runs(steps);
    Ok(Section {
        title: "Limits by run".into(),
        items: vec![
            Item::Paragraph(text),
            Item::Table {
                name: "limits_by_run".into(),
                table: limits_table(&compared),
                command: COMMAND.into(),
            },
            Item::Table {
                name: "long_runs".into(),
                table: long_runs_table(&runs, steps),
                command: COMMAND.into(),
            },
            Item::Paragraph(remarks(&runs)),
        ],
    })
}

type Compared = (Discretisation, Result<LimitComparison, NoBracket>);

fn compare(detail: Detail) -> Vec<Compared> {
    let ratios = [integer(1), ratio(13, 10), integer(2), integer(3)];
    let mut cases: Vec<Discretisation> = kernels(detail)
        .iter()
        .flat_map(|&kernel| {
            let godunov = AdvectionScheme::GodunovSph;
            ratios.clone().map(|ratio| discretisation(godunov, kernel, ratio))
        })
        .collect();
    for ratio in [integer(1), integer(2)] {
        cases.push(discretisation(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, ratio));
    }
    cases
        .into_par_iter()
        .map(|case| {
            let plan = GrowthPlan::settling(WINDOWS, STEPS_PER_WINDOW);
            let found = compare_limits(&case, PARTICLES, &integer(20), RESOLUTION, &plan);
            (case, found)
        })
        .collect()
}

fn limits_table(compared: &[Compared]) -> Table {
    let mut table = Table::new(
        format!(
            "Stability limits: proved, of the symbol on {PARTICLES} particles, and by running there"
        ),
        &[
            ("scheme", Align::Left),
            ("kernel", Align::Left),
            ("l/Δξ", Align::Right),
            ("proved (lattice)", Align::Right),
            ("symbol (ring)", Align::Right),
            ("no growth at", Align::Right),
            ("growth at", Align::Right),
            ("runs", Align::Right),
            ("steps", Align::Right),
        ],
    );
    for (case, found) in compared {
        let mut cells = vec![
            case.scheme().title().to_string(),
            case.kernel().title().into(),
            to_text(case.ratio()),
        ];
        match found {
            Ok(found) => cells.extend([
                significant(found.proved.value(), 8),
                significant(found.ring, 8),
                significant(found.measured.stable, 8),
                significant(found.measured.unstable, 8),
                found.measured.runs.to_string(),
                found.measured.steps.to_string(),
            ]),
            Err(reason) => cells.extend([
                format!("not found: {reason}"),
                "–".into(),
                "–".into(),
                "–".into(),
                "–".into(),
                "–".into(),
            ]),
        }
        table.push(cells);
    }
    table
}

/// What a long run is to show.
struct LongCase {
    what: String,
    case: Discretisation,
    run: LongRun,
}

fn long_runs(steps: u64) -> Vec<LongCase> {
    let mut plans: Vec<(String, Discretisation, f64)> = Vec::new();
    let mut about = |scheme, kernel, ratio: Rational, distance: f64| {
        let case = discretisation(scheme, kernel, ratio);
        let limit = ring_limit(&case);
        for (side, sign) in [("below", -1.0), ("above", 1.0)] {
            let what = format!("{} {side} the ring's limit", significant(distance, 1));
            plans.push((what, case.clone(), limit * (1.0 + sign * distance)));
        }
    };
    let (godunov, lax_wendroff) = (AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph);
    about(godunov, Kernel::CubicSpline, integer(2), 1e-5);
    about(godunov, Kernel::Gaussian, integer(2), 1e-5);
    about(lax_wendroff, Kernel::CubicSpline, integer(2), 1e-3);
    about(lax_wendroff, Kernel::CubicSpline, ratio(13, 10), 1e-4);
    let shift = discretisation(godunov, Kernel::CubicSpline, integer(1));
    plans.push(("the exact shift".into(), shift, 1.0));
    let cut = discretisation(lax_wendroff, Kernel::Gaussian, ratio(5, 2));
    plans.push(("the cut Gaussian".into(), cut, 1.0));
    let plan = GrowthPlan::lattice(steps as usize / 1000, 1000);
    plans
        .into_par_iter()
        .map(|(what, case, courant)| {
            let run = long_run(&case, courant, LONG_PARTICLES, &plan);
            LongCase { what, case, run }
        })
        .collect()
}

/// What the rows of the long runs say, with their numbers.
fn remarks(runs: &[LongCase]) -> String {
    let find = |kernel: Kernel, ratio: &Rational| {
        let scheme = AdvectionScheme::LaxWendroffSph;
        let mut found = runs.iter().filter(|run| {
            let case = &run.case;
            case.scheme() == scheme && case.kernel() == kernel && case.ratio() == ratio
        });
        &found.next().expect("the case is one of the long runs").run
    };
    let drifting = find(Kernel::CubicSpline, &ratio(13, 10));
    let cut = find(Kernel::Gaussian, &ratio(5, 2));
    format!(
        "Just below a limit a long run shows no growth, just above it growth at the predicted rate. \
         Lax–Wendroff SPH with the cubic spline at l/Δξ = 2 leaves the shortest wave as it is: below the limit \
         that wave stays. At l/Δξ = 1.3 the scheme does not keep a constant: its mean is multiplied by {} at \
         every step, whatever the waves do. With the cut Gaussian at l/Δξ = 2.5 it is strictly unstable, but so \
         slowly that a wave takes {:.0} steps to double.",
        drifting.growth.mean_gain.map_or_else(|| "–".into(), |gain| significant(gain, 4)),
        2f64.ln() / cut.predicted_gain.ln(),
    )
}

/// The limit of the waves of a ring, the mean apart: it is no wave, and may drift on its own.
fn ring_limit(case: &Discretisation) -> f64 {
    let modes = RingModes::new(LONG_PARTICLES);
    let phases: Vec<f64> = (1..modes.count()).map(|mode| modes.phase(mode)).collect();
    sampled_stability_limit(&case.margin(), &phases, &integer(20)).value()
}

fn long_runs_table(runs: &[LongCase], steps: u64) -> Table {
    let mut table = Table::new(
        format!("Noise on {LONG_PARTICLES} particles, {steps} steps"),
        &[
            ("scheme", Align::Left),
            ("kernel", Align::Left),
            ("l/Δξ", Align::Right),
            ("C", Align::Right),
            ("which is", Align::Left),
            ("leading wave", Align::Left),
            ("predicted |g| − 1", Align::Right),
            ("measured |g| − 1", Align::Right),
            ("factor of the mean − 1", Align::Right),
            ("the run", Align::Left),
        ],
    );
    // A window of a thousand steps gives a rate to about 1e-15.
    let excess = |gain: f64| match gain - 1.0 {
        excess if excess.abs() < 1e-14 => "0".into(),
        excess => significant(excess, 5),
    };
    for LongCase { what, case, run } in runs {
        let wave = match run.fastest_mode {
            0 => "the mean".into(),
            mode => {
                format!("φ = {} rad", significant(TAU * mode as f64 / LONG_PARTICLES as f64, 4))
            }
        };
        table.push([
            case.scheme().title().to_string(),
            case.kernel().title().into(),
            to_text(case.ratio()),
            significant(run.courant_number, 8),
            what.clone(),
            wave,
            excess(run.predicted_gain),
            if run.growth.gain_per_step.is_finite() {
                excess(run.growth.gain_per_step)
            } else {
                format!("overflowed after {} steps", run.steps)
            },
            run.growth.mean_gain.map_or_else(|| "–".into(), excess),
            match run.growth.verdict {
                GrowthVerdict::Growing => "grows",
                GrowthVerdict::Neutral => "stays",
                GrowthVerdict::Decaying => "decays",
                GrowthVerdict::Undecided => "undecided",
            }
            .into(),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_runs_find_the_limit_of_the_symbol_on_the_ring() {
        for (case, found) in compare(Detail::Quick) {
            let found = found.unwrap();
            // The bracket is that wide, and its ends are one bisection of the limit.
            assert!((found.measured.stable - found.ring).abs() <= RESOLUTION, "{case:?}");
            assert!((found.measured.unstable - found.ring).abs() <= RESOLUTION, "{case:?}");
            // A ring holds fewer waves than the lattice.
            assert!(found.ring >= found.proved.lower() - 1e-12, "{case:?}");
        }
    }

    #[test]
    fn long_runs_grow_above_a_limit_only() {
        for LongCase { what, run, .. } in long_runs(20_000) {
            if what.contains("above") {
                assert!(run.predicted_gain > 1.0, "{what}");
            } else if what.contains("below") {
                assert!(run.predicted_gain < 1.0 + 1e-15, "{what}");
                assert_ne!(run.growth.verdict, GrowthVerdict::Growing, "{what}");
            }
        }
    }
}
