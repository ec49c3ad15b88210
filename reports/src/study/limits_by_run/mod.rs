//! Stability limits found by running, beside the proved ones, and many steps on either side of one.

mod growth;

use self::growth::{Growth, GrowthPlan, GrowthVerdict, noise_growth};
use super::plan::{ByDetail, Case, Named, discretisation};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::PaperText;
use crate::report::Detail;
use crate::{cells, words};
use courant_analysis::exact::rational::{Rational, integer, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::{Limit, SearchPlan, sampled_stability_limit};
use courant_simulation::advection::{AdvectionScheme, Discretisation, RingModes};
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

/// Proved, restricted to the modes of a ring, and measured on that ring.
#[derive(Debug)]
struct LimitComparison {
    /// The limit of the infinite lattice.
    proved: Limit,
    /// The limit of the gain at the ring's phases.
    ring: f64,
    /// The limit of the runs on the ring.
    measured: MeasuredLimit,
}

/// Where a scheme stops being stable, as its runs tell.
#[derive(Debug, PartialEq)]
struct MeasuredLimit {
    /// The largest Courant number whose run did not grow; 0 when all grew.
    stable: f64,
    /// The smallest Courant number above it whose run grew.
    unstable: f64,
    /// Runs done.
    runs: u32,
    /// Steps of all runs together.
    steps: u64,
}

/// The ends of a bracket do not differ.
#[derive(Debug, PartialEq, thiserror::Error)]
enum NoBracket {
    #[error("the run at C = {0} grows already")]
    LowerGrows(f64),
    #[error("the run at C = {0} does not grow")]
    UpperDoesNotGrow(f64),
}

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
            let found = compare_limits(&case, plan);
            (case, found)
        })
        .collect()
}

/// Bisects by runs between 2 % below and 2 % above the limit that the gain has on a ring, or below the end of the range where
/// that is 0, and sets both beside the proved limit.
fn compare_limits(case: &Discretisation, plan: &Plan) -> Result<LimitComparison, NoBracket> {
    let proved = case.stable_set_by(&SearchPlan::default().up_to(integer(RANGE))).limit();
    let ring = ring_limit(case, plan.particles, 0);
    let end = RANGE as f64;
    let bracket = if ring > 0.0 { (0.98 * ring, (1.02 * ring).min(end)) } else { (0.0, end) };
    Ok(LimitComparison { proved, ring, measured: measured_limit(case, bracket, plan)? })
}

/// The limit of the gain at the phases `2πm/N` of a ring from the mode `first` on.
fn ring_limit(case: &Discretisation, particles: usize, first: usize) -> f64 {
    let modes = RingModes::new(particles);
    let phases: Vec<f64> = (first..modes.count()).map(|mode| modes.phase(mode)).collect();
    sampled_stability_limit(&case.margin(), &phases, &integer(RANGE)).value()
}

/// Bisects the Courant number at which runs on a ring begin to grow, between `lower` (0 counts as stable:
/// nothing moves) and `upper`.
///
/// A ring holds the phases `2πm/N` only, so the answer is the limit of these modes: at least the
/// lattice's, by `O(1/N²)` where the long wave binds. Where the stable set has gaps, one of its ends
/// within the bracket is found. Each run must be long enough for the fastest mode to be left alone, which
/// near a limit may take some 100,000 steps: it stops when it is. Where the modes that compete are all slow (long waves of
/// Lax–Wendroff SPH) windows of hundreds of steps are needed to see their rates settle. A mode that grows by less than
/// `1e-13` per step counts as stable.
fn measured_limit(
    case: &Discretisation,
    (lower, upper): (f64, f64),
    plan: &Plan,
) -> Result<MeasuredLimit, NoBracket> {
    let Plan { particles, resolution, windows, steps_per_window, .. } = *plan;
    let growth = GrowthPlan { windows, steps_per_window, stop_when_settled: true };
    let (mut runs, mut steps) = (0, 0);
    let mut grows = |courant_number: f64| {
        let growth = noise_growth(case, courant_number, particles, &growth);
        runs += 1;
        steps += growth.steps;
        growth.verdict == GrowthVerdict::Growing
    };
    if lower > 0.0 && grows(lower) {
        return Err(NoBracket::LowerGrows(lower));
    }
    if !grows(upper) {
        return Err(NoBracket::UpperDoesNotGrow(upper));
    }
    let (mut stable, mut unstable) = (lower, upper);
    while unstable - stable > resolution {
        let middle = stable.midpoint(unstable);
        if middle <= stable || middle >= unstable {
            break;
        }
        if grows(middle) { unstable = middle } else { stable = middle }
    }
    Ok(MeasuredLimit { stable, unstable, runs, steps })
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

/// A long run from noise, with the growth that the gain predicts for the ring.
#[derive(Debug)]
struct LongRun {
    /// What it is to show.
    what: String,
    case: Discretisation,
    courant_number: f64,
    /// The mode with the largest predicted gain, the mean excluded unless it grows.
    fastest_mode: usize,
    /// Its predicted gain per step.
    predicted_gain: f64,
    /// What the run did.
    growth: Growth,
}

impl LongRun {
    fn new(
        what: String,
        case: Discretisation,
        courant_number: f64,
        particles: usize,
        plan: &GrowthPlan,
    ) -> Self {
        let stencil = case.stencil(courant_number);
        let modes = RingModes::new(particles);
        let gain = |mode| stencil.at_phase(modes.phase(mode)).norm();
        // The mean has gain 1 but for rounding where the scheme keeps constants, and leads only if it grows.
        let start = if gain(0) > 1.0 + 1e-12 || modes.count() == 1 { 0 } else { 1 };
        let (fastest_mode, predicted_gain) = (start..modes.count())
            .map(|mode| (mode, gain(mode)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .expect("the range holds at least one mode");
        let growth = noise_growth(&case, courant_number, particles, plan);
        Self { what, case, courant_number, fastest_mode, predicted_gain, growth }
    }
}

fn long_runs(plan: &LongPlan, steps: u64) -> Vec<LongRun> {
    let about = plan.about.iter().flat_map(|(case, distance)| {
        let case = case.discretisation();
        // Of its waves: the mean is none, and may drift on its own.
        let limit = ring_limit(&case, plan.particles, 1);
        [("below", -1.0), ("above", 1.0)].map(|(side, sign)| {
            let what = format!("{} {side} the ring's limit", significant(*distance, 1));
            (what, case.clone(), limit * (1.0 + sign * distance))
        })
    });
    let at =
        plan.at.iter().map(|(case, courant, what)| (what.clone(), case.discretisation(), *courant));
    let cases: Vec<(String, Discretisation, f64)> = about.chain(at).collect();
    let growth = GrowthPlan {
        windows: steps as usize / 1000,
        steps_per_window: 1000,
        stop_when_settled: false,
    };
    cases
        .into_par_iter()
        .map(|(what, case, courant)| LongRun::new(what, case, courant, plan.particles, &growth))
        .collect()
}

/// What the rows of the long runs say, with their numbers.
fn remarks(text: &PaperText, plan: &LongPlan, runs: &[LongRun]) -> Item {
    let find = |case: &Case| {
        let mut found = runs.iter().filter(|run| case.is(&run.case));
        found.next().expect("the case is one of the long runs")
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

fn long_run_row(run: &LongRun, particles: usize) -> Vec<String> {
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
        run.case.scheme().title(),
        run.case.kernel().title(),
        to_text(run.case.ratio()),
        significant(run.courant_number, 8),
        run.what,
        wave,
        excess(run.predicted_gain),
        if gain.is_finite() {
            excess(gain)
        } else {
            format!("overflowed after {} steps", run.growth.steps)
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
mod tests;
