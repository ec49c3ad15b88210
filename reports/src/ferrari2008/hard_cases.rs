//! The hard cases of the limits, each answered by a computation.

use super::table_1::{LimitKind, published_values, recipe};
use super::text;
use crate::cells;
use crate::number::significant;
use crate::page::Item;
use crate::study::plan::discretisation as scheme;
use courant_analysis::exact::rational::{Rational, integer, parse, ratio, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::Step;
use courant_analysis::stability::verdict::check;
use courant_analysis::stability::weak_instability::long_wave_behaviour;
use courant_analysis::stability::{Limit, LimitMethod, SearchPlan, StableSet};
use courant_simulation::advection::AdvectionScheme;

/// Longer equations are described, not printed.
const SHORT_EQUATION: usize = 60;

/// The hard cases, each answered by a computation.
pub(super) fn table() -> Item {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let godunov = |l: &Rational| scheme(AdvectionScheme::GodunovSph, Kernel::CubicSpline, l);
    let limit_text = |l: &Rational| digits(&godunov(l).stable_set().limit());
    let small = ratio(1, 1_000_000_000);
    for (name, edge) in [
        ("a lattice point on the edge of the support", integer(2)),
        ("a lattice point on a knot", ratio(3, 2)),
    ] {
        rows.push(cells![
            name,
            format!("Godunov, cubic: limit at {0} − 1e-9, {0}, {0} + 1e-9", to_text(&edge)),
            [&edge - &small, edge.clone(), &edge + &small].map(|l| limit_text(&l)).join(", "),
        ]);
    }
    let typed = parse("0.3").expect("a decimal");
    let neighbours = courant_analysis::kernel::lattice::LatticeWeights::new(
        Kernel::Gaussian,
        &(&typed + ratio(1, 30)),
    )
    .map_or(0, |weights| weights.reach());
    rows.push(cells![
        "ratio 1/3 with the Gaussian",
        "is the neighbour at exactly q = 3 counted?",
        format!("yes: {neighbours} neighbour on each side"),
    ]);
    let margin = godunov(&integer(1)).margin().compile();
    let phase = 1e-9_f64;
    let exact = (0.5 * phase).sin().powi(2);
    rows.push(cells![
        "phase 1e-9",
        "Godunov, cubic, ratio 1, C = 1/2: relative error of 1 − |g|²",
        significant((margin.at(0.5, phase) / exact - 1.0).abs(), 2),
    ]);
    let shift = check(godunov(&integer(1)).step(), "C", &integer(1), &SearchPlan::default())
        .expect("only the Courant number is free");
    rows.push(cells![
        "exactly neutral",
        "Godunov, cubic, ratio 1, C = 1 is the exact shift",
        format!("{}, growth {}", shift.verdict.name(), shift.growth.per_step),
    ]);
    let weak = scheme(AdvectionScheme::LaxWendroffSph, Kernel::Gaussian, &integer(3));
    let budgets: Vec<String> = ["0", "1e-9", "1e-6", "1e-4", "1e-3", "1e-2"]
        .into_iter()
        .map(|growth| {
            let budget = parse(growth).expect("a decimal");
            let set = weak.stable_set_by(&weak.plan().growing(budget));
            format!("{growth}: {}", significant(set.limit().value(), 6))
        })
        .collect();
    rows.push(cells![
        "weak instability",
        "Lax–Wendroff, cut Gaussian, ratio 3: limit for a growth per step of",
        budgets.join("; "),
    ]);
    let drifting = scheme(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, &ratio(13, 10));
    let drift = to_f64(&(drifting.one_step().mean_gain().evaluate(&integer(1)) - integer(1)));
    rows.push(cells![
        "the mean drifts",
        "Lax–Wendroff, cubic, ratio 1.3, C = 1: change of a constant per step",
        significant(drift, 6),
    ]);
    let above = godunov(&integer(2)).margin();
    if let Some(leading) = long_wave_behaviour(&above) {
        let amplitude = to_f64(&leading.amplitude.evaluate(&ratio(19, 10)));
        rows.push(cells![
            "just above a long-wave limit",
            "Godunov, cubic, ratio 2, C = 1.9: |g|² − 1 for long waves",
            format!("{} φ^{}", significant(amplitude, 6), leading.power),
        ]);
    }
    let set = godunov(&integer(50)).stable_set();
    rows.push(cells![
        "ratio 50",
        "Godunov, cubic: limit, and boxes looked at",
        format!("{}, {}", digits(&set.limit()), set.work.boxes),
    ]);
    let tolerance = LimitMethod::Proved(52).size();
    rows.push(cells![
        "whole ratios",
        format!("Lax–Wendroff, cubic, to {tolerance} bits: limits at ratio 2, 3, 5, 10"),
        [2, 3, 5, 10]
            .map(|l| {
                let of = scheme(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, &integer(l));
                let limit = of.stable_set().limit();
                limit.exact().map_or_else(|| digits(&limit), ToString::to_string)
            })
            .join(", "),
    ]);
    for Constructed { case, question, equation } in constructed() {
        let step = Step::from_text(&equation).expect("a scheme");
        let plan = SearchPlan::default().up_to(integer(10));
        let set = step.stable_set("C", &plan).expect("only C is free");
        rows.push(vec![case, question, stable_intervals(&set)]);
    }
    let reproduced: Vec<String> = (28..=33)
        .map(|cells| {
            let phases: Vec<f64> = (0..=cells)
                .map(|i| f64::from(i) / f64::from(cells) * std::f64::consts::PI)
                .collect();
            let printed = published_values().into_iter().filter(|v| v.kind == LimitKind::Stability);
            let same = printed.filter(|value| {
                let of = scheme(AdvectionScheme::GodunovSph, value.kernel, &value.ratio);
                (recipe(&of.margin(), &phases) - to_f64(&value.courant)).abs() < 1e-9
            });
            format!("{cells}: {}", same.count())
        })
        .collect();
    rows.push(cells![
        "a coarse grid of phases",
        "how many of the 12 printed stability limits follow from phases πj/N, N =",
        reproduced.join("; "),
    ]);
    text().table("limits_hard_cases", &[], rows)
}

fn digits(limit: &Limit) -> String {
    limit.decimal(13).unwrap_or_else(|| "none".into())
}

/// A scheme made to be hard.
#[derive(serde::Deserialize)]
struct Constructed {
    case: String,
    question: String,
    equation: String,
}

fn constructed() -> Vec<Constructed> {
    let file = include_str!("../../papers/ferrari2008/hard_cases.toml");
    let mut lists: std::collections::BTreeMap<String, Vec<Constructed>> =
        toml::from_str(file).expect("the file is read by a test");
    lists.remove("scheme").unwrap_or_default()
}

/// The intervals, with closed forms or equations where there are any.
fn stable_intervals(set: &StableSet) -> String {
    let end = |limit: &Limit| match (limit.exact(), limit.equation()) {
        (Some(exact), _) => exact.to_string(),
        (None, Some(root)) if root.equation("C").len() <= SHORT_EQUATION => {
            format!("{} (root of {})", digits(limit), root.equation("C"))
        }
        (None, Some(root)) => format!("{} (root, degree {})", digits(limit), root.degree()),
        (None, None) => digits(limit),
    };
    let mut parts: Vec<String> =
        set.intervals.iter().map(|i| format!("[{}, {}]", end(&i.from), end(&i.to))).collect();
    parts.extend(set.undecided.iter().map(|(from, to)| format!("undecided from {from} to {to}")));
    parts.join(" and ")
}
