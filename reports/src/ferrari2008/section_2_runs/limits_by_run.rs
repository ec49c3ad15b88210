//! Stability limits found by running, and a million steps on either side of one.

use super::{Detail, discretisation, kernels, text};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::or_dash;
use crate::{cells, words};
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

pub(super) fn section(detail: Detail) -> Section {
    let steps = match detail {
        Detail::Quick => 20_000,
        Detail::Standard => 100_000,
        Detail::Full => 1_000_000,
    };
    let (compared, runs) = rayon::join(|| compare(detail), || long_runs(steps));
    let holds = |found: &LimitComparison| {
        let width = found.measured.unstable - found.measured.stable;
        (found.measured.stable - width..=found.measured.unstable + width).contains(&found.ring)
    };
    let paragraph = words![
        "particles" = PARTICLES,
        "resolution" = format!("{RESOLUTION:.0e}"),
        "inside" = compared.iter().filter(|(_, found)| found.as_ref().is_ok_and(holds)).count(),
        "cases" = compared.len(),
    ];
    let ring = words!["particles" = LONG_PARTICLES, "steps" = steps];
    let items = vec![
        text().paragraph("limits_by_run_text", paragraph),
        text().table(
            "limits_by_run",
            words!["particles" = PARTICLES],
            compared.iter().map(limit_row),
        ),
        text().table("long_runs", ring, runs.iter().map(long_run_row)),
        remarks(&runs),
    ];
    text().section("title_limits_by_run", items)
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

fn limit_row((case, found): &Compared) -> Vec<String> {
    let mut cells = cells![case.scheme().title(), case.kernel().title(), to_text(case.ratio())];
    match found {
        Ok(found) => {
            let measured = &found.measured;
            let limits = [found.proved.value(), found.ring, measured.stable, measured.unstable];
            cells.extend(limits.map(|limit| significant(limit, 8)));
            cells.extend(cells![measured.runs, measured.steps]);
        }
        Err(reason) => {
            cells.extend(cells![format!("not found: {reason}"), "–", "–", "–", "–", "–"]);
        }
    }
    cells
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
fn remarks(runs: &[LongCase]) -> Item {
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
    text().paragraph(
        "long_runs_text",
        words![
            "drift" = or_dash(drifting.growth.mean_gain, 4),
            "doubling" = format!("{:.0}", 2f64.ln() / cut.predicted_gain.ln()),
        ],
    )
}

/// The limit of the waves of a ring, the mean apart: it is no wave, and may drift on its own.
fn ring_limit(case: &Discretisation) -> f64 {
    let modes = RingModes::new(LONG_PARTICLES);
    let phases: Vec<f64> = (1..modes.count()).map(|mode| modes.phase(mode)).collect();
    sampled_stability_limit(&case.margin(), &phases, &integer(20)).value()
}

fn long_run_row(LongCase { what, case, run }: &LongCase) -> Vec<String> {
    // A window of a thousand steps gives a rate to about 1e-15.
    let excess = |gain: f64| match gain - 1.0 {
        excess if excess.abs() < 1e-14 => "0".into(),
        excess => significant(excess, 5),
    };
    let wave = match run.fastest_mode {
        0 => "the mean".into(),
        mode => format!("φ = {} rad", significant(TAU * mode as f64 / LONG_PARTICLES as f64, 4)),
    };
    let gain = run.growth.gain_per_step;
    cells![
        case.scheme().title(),
        case.kernel().title(),
        to_text(case.ratio()),
        significant(run.courant_number, 8),
        what,
        wave,
        excess(run.predicted_gain),
        if gain.is_finite() {
            excess(gain)
        } else {
            format!("overflowed after {} steps", run.steps)
        },
        run.growth.mean_gain.map_or_else(|| "–".into(), excess),
        match run.growth.verdict {
            GrowthVerdict::Growing => "grows",
            GrowthVerdict::Neutral => "stays",
            GrowthVerdict::Decaying => "decays",
            GrowthVerdict::Undecided => "undecided",
        },
    ]
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
