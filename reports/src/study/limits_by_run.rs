//! Stability limits found by running, and many steps on either side of one.

use super::plan::{ByDetail, Case, Named, discretisation};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::PaperText;
use crate::report::Detail;
use crate::{cells, words};
use courant_analysis::exact::rational::{Rational, integer, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::sampled_stability_limit;
use courant_simulation::advection::{
    AdvectionScheme, Discretisation, GrowthPlan, GrowthVerdict, LimitComparison, LongRun,
    NoBracket, RingModes, compare_limits, long_run,
};
use rayon::prelude::*;
use serde::Deserialize;
use std::f64::consts::TAU;

/// Limits are looked for up to this Courant number.
const RANGE: i64 = 20;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    /// Particles of the rings bisected: few, so that the ring's limit stands apart from the lattice's.
    particles: usize,
    /// Width to which a limit is bisected.
    resolution: f64,
    /// Longest run, in windows of steps over which a rate is taken.
    windows: usize,
    /// Steps of a window: long enough that the slow waves near a limit show their rates settling.
    steps_per_window: u64,
    sweeps: Vec<Sweep>,
    long: LongPlan,
}

/// A scheme with every kernel at every ratio.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sweep {
    scheme: Named<AdvectionScheme>,
    kernels: ByDetail<Vec<Named<Kernel>>>,
    ratios: Vec<Named<Rational>>,
}

/// Long runs.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct LongPlan {
    particles: usize,
    steps: ByDetail<u64>,
    /// Cases run so far below and above the ring's limit, relative to it.
    about: Vec<(Case, f64)>,
    /// Cases run at a Courant number, and what they are.
    at: Vec<(Case, f64, String)>,
    /// The case whose mean drifts.
    drifting: Case,
    /// The case that grows slowly.
    slow: Case,
}

/// The section.
pub fn section(text: &PaperText, detail: Detail) -> Section {
    let plan: Plan = text.plan("limits_by_run");
    let steps = *plan.long.steps.at(detail);
    let (compared, runs) = rayon::join(|| compare(&plan, detail), || long_runs(&plan.long, steps));
    let holds = |found: &LimitComparison| {
        let width = found.measured.unstable - found.measured.stable;
        (found.measured.stable - width..=found.measured.unstable + width).contains(&found.ring)
    };
    let particles = plan.particles;
    let paragraph = words![
        "particles" = particles,
        "resolution" = format!("{:.0e}", plan.resolution),
        "inside" = compared.iter().filter(|(_, found)| found.as_ref().is_ok_and(holds)).count(),
        "cases" = compared.len(),
    ];
    let ring = words!["particles" = plan.long.particles, "steps" = steps];
    let long_rows = runs.iter().map(|run| long_run_row(run, plan.long.particles));
    let items = vec![
        text.paragraph("limits_by_run_text", paragraph),
        text.table(
            "limits_by_run",
            words!["particles" = particles],
            compared.iter().map(limit_row),
        ),
        text.table("long_runs", ring, long_rows),
        remarks(text, &plan.long, &runs),
    ];
    text.section("title_limits_by_run", items)
}

type Compared = (Discretisation, Result<LimitComparison, NoBracket>);

fn compare(plan: &Plan, detail: Detail) -> Vec<Compared> {
    let cases = plan.sweeps.iter().flat_map(|sweep| {
        sweep.kernels.at(detail).iter().flat_map(|kernel| {
            let of = |ratio: &Named<_>| discretisation(sweep.scheme.0, kernel.0, &ratio.0);
            sweep.ratios.iter().map(of)
        })
    });
    let cases: Vec<Discretisation> = cases.collect();
    cases
        .into_par_iter()
        .map(|case| {
            let growth = GrowthPlan::settling(plan.windows, plan.steps_per_window);
            let range = integer(RANGE);
            let found = compare_limits(&case, plan.particles, &range, plan.resolution, &growth);
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

fn long_runs(plan: &LongPlan, steps: u64) -> Vec<LongCase> {
    let about = plan.about.iter().flat_map(|(case, distance)| {
        let case = case.discretisation();
        let limit = ring_limit(&case, plan.particles);
        [("below", -1.0), ("above", 1.0)].map(|(side, sign)| {
            let what = format!("{} {side} the ring's limit", significant(*distance, 1));
            (what, case.clone(), limit * (1.0 + sign * distance))
        })
    });
    let at =
        plan.at.iter().map(|(case, courant, what)| (what.clone(), case.discretisation(), *courant));
    let cases: Vec<(String, Discretisation, f64)> = about.chain(at).collect();
    let growth = GrowthPlan::lattice(steps as usize / 1000, 1000);
    cases
        .into_par_iter()
        .map(|(what, case, courant)| {
            let run = long_run(&case, courant, plan.particles, &growth);
            LongCase { what, case, run }
        })
        .collect()
}

/// What the rows of the long runs say, with their numbers.
fn remarks(text: &PaperText, plan: &LongPlan, runs: &[LongCase]) -> Item {
    let find = |case: &Case| {
        let mut found = runs.iter().filter(|run| case.is(&run.case));
        &found.next().expect("the case is one of the long runs").run
    };
    let (drifting, slow) = (find(&plan.drifting), find(&plan.slow));
    text.paragraph(
        "long_runs_text",
        words![
            "drift" = significant(drifting.growth.mean_gain, 4),
            "doubling" = format!("{:.0}", 2f64.ln() / slow.predicted_gain.ln()),
        ],
    )
}

/// The limit of the waves of a ring, the mean apart: it is no wave, and may drift on its own.
fn ring_limit(case: &Discretisation, particles: usize) -> f64 {
    let modes = RingModes::new(particles);
    let phases: Vec<f64> = (1..modes.count()).map(|mode| modes.phase(mode)).collect();
    sampled_stability_limit(&case.margin(), &phases, &integer(RANGE)).value()
}

fn long_run_row(LongCase { what, case, run }: &LongCase, particles: usize) -> Vec<String> {
    // A window of a thousand steps gives a rate to about 1e-15.
    let excess = |gain: f64| match gain - 1.0 {
        excess if excess.abs() < 1e-14 => "0".into(),
        excess => significant(excess, 5),
    };
    let wave = match run.fastest_mode {
        0 => "the mean".into(),
        mode => format!("φ = {} rad", significant(TAU * mode as f64 / particles as f64, 4)),
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
        excess(run.growth.mean_gain),
        match run.growth.verdict {
            GrowthVerdict::Growing => "grows",
            GrowthVerdict::Neutral => "stays",
            GrowthVerdict::Decaying => "decays",
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan() -> Plan {
        let cubic = "{ scheme = \"godunov-sph\", kernel = \"cubic-spline\", ratio = \"2\" }";
        let kernels = "[\"cubic-spline\", \"gaussian\"]";
        toml::from_str(&format!(
            "particles = 32\nresolution = 1e-6\nwindows = 4000\nsteps_per_window = 500\n\
             [[sweeps]]\nscheme = \"godunov-sph\"\nratios = [\"1\", \"13/10\"]\n\
             kernels = {{ quick = {kernels}, standard = [], full = [] }}\n\
             [long]\nparticles = 16\nsteps = {{ quick = 20000, standard = 0, full = 0 }}\n\
             about = [[{cubic}, 1e-5]]\nat = [[{cubic}, 1.0, \"one\"]]\n\
             drifting = {cubic}\nslow = {cubic}\n"
        ))
        .unwrap()
    }

    #[test]
    fn the_runs_find_the_limit_of_the_symbol_on_the_ring() {
        let plan = plan();
        for (case, found) in compare(&plan, Detail::Quick) {
            let found = found.unwrap();
            // The bracket is that wide, and its ends are one bisection of the limit.
            assert!((found.measured.stable - found.ring).abs() <= plan.resolution, "{case:?}");
            assert!((found.measured.unstable - found.ring).abs() <= plan.resolution, "{case:?}");
            // A ring holds fewer waves than the lattice.
            assert!(found.ring >= found.proved.lower() - 1e-12, "{case:?}");
        }
    }

    #[test]
    fn long_runs_grow_above_a_limit_only() {
        for LongCase { what, run, .. } in long_runs(&plan().long, 20_000) {
            if what.contains("above") {
                assert!(run.predicted_gain > 1.0, "{what}");
            } else if what.contains("below") {
                assert!(run.predicted_gain < 1.0 + 1e-15, "{what}");
                assert_ne!(run.growth.verdict, GrowthVerdict::Growing, "{what}");
            }
        }
    }
}
