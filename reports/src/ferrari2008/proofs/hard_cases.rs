//! The hard cases of the limits, each answered by a computation.

use super::super::COMMAND;
use super::super::table_1::{LimitKind, published_values, recipe};
use super::scheme;
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
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
    let mut table = Table::new(
        "Hard cases of the limits",
        &[("case", Align::Left), ("question", Align::Left), ("answer", Align::Left)],
    );
    let godunov = |l: &Rational| scheme(AdvectionScheme::GodunovSph, Kernel::CubicSpline, l);
    let limit_text = |l: &Rational| digits(&godunov(l).stable_set().limit());
    let small = ratio(1, 1_000_000_000);
    for (name, edge) in [
        ("a lattice point on the edge of the support", integer(2)),
        ("a lattice point on a knot", ratio(3, 2)),
    ] {
        table.push([
            name.to_string(),
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
    table.push([
        "ratio 1/3 with the Gaussian".into(),
        "is the neighbour at exactly q = 3 counted?".into(),
        format!("yes: {neighbours} neighbour on each side"),
    ]);
    let margin = godunov(&integer(1)).margin().compile();
    let phase = 1e-9_f64;
    let exact = (0.5 * phase).sin().powi(2);
    table.push([
        "phase 1e-9".into(),
        "Godunov, cubic, ratio 1, C = 1/2: relative error of 1 − |g|²".into(),
        significant((margin.at(0.5, phase) / exact - 1.0).abs(), 2),
    ]);
    let shift = check(godunov(&integer(1)).step(), "C", &integer(1), &SearchPlan::default())
        .expect("only the Courant number is free");
    table.push([
        "exactly neutral".into(),
        "Godunov, cubic, ratio 1, C = 1 is the exact shift".into(),
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
    table.push([
        "weak instability".into(),
        "Lax–Wendroff, cut Gaussian, ratio 3: limit for a growth per step of".into(),
        budgets.join("; "),
    ]);
    let drifting = scheme(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, &ratio(13, 10));
    let drift = to_f64(&(drifting.one_step().mean_gain().evaluate(&integer(1)) - integer(1)));
    table.push([
        "the mean drifts".into(),
        "Lax–Wendroff, cubic, ratio 1.3, C = 1: change of a constant per step".into(),
        significant(drift, 6),
    ]);
    let above = godunov(&integer(2)).margin();
    if let Some(leading) = long_wave_behaviour(&above) {
        let amplitude = to_f64(&leading.amplitude.evaluate(&ratio(19, 10)));
        table.push([
            "just above a long-wave limit".into(),
            "Godunov, cubic, ratio 2, C = 1.9: |g|² − 1 for long waves".into(),
            format!("{} φ^{}", significant(amplitude, 6), leading.power),
        ]);
    }
    let set = godunov(&integer(50)).stable_set();
    table.push([
        "ratio 50".into(),
        "Godunov, cubic: limit, and boxes looked at".into(),
        format!("{}, {}", digits(&set.limit()), set.work.boxes),
    ]);
    let tolerance = LimitMethod::Proved(52).size();
    table.push([
        "whole ratios".into(),
        format!("Lax–Wendroff, cubic, to {tolerance} bits: limits at ratio 2, 3, 5, 10"),
        [2, 3, 5, 10]
            .map(|l| {
                let of = scheme(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, &integer(l));
                let limit = of.stable_set().limit();
                limit.exact().map_or_else(|| digits(&limit), ToString::to_string)
            })
            .join(", "),
    ]);
    for (case, question, text) in CONSTRUCTED {
        let step = Step::from_text(text).expect("a scheme");
        let plan = SearchPlan::default().up_to(integer(10));
        let set = step.stable_set("C", &plan).expect("only C is free");
        table.push([case.into(), question.into(), stable_intervals(&set)]);
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
    table.push([
        "a coarse grid of phases".into(),
        "how many of the 12 printed stability limits follow from phases πj/N, N =".into(),
        reproduced.join("; "),
    ]);
    Item::Table { name: "limits_hard_cases".into(), table, command: COMMAND.into() }
}

fn digits(limit: &Limit) -> String {
    limit.decimal(13).unwrap_or_else(|| "none".into())
}

/// Schemes made to be hard.
const CONSTRUCTED: [(&str, &str, &str); 5] = [
    (
        "touching, not crossing",
        "g = 1 − C ((2s² − 1)² + (C² − 2)²)/40: the wave s = √(1/2) is neutral at C = √2 alone; stable C",
        // w = 2 s² − 1 with s = (2 − E − 1/E)/4, taken twice.
        "s[n,j] = (2*u[n,j] - u[n,j+1] - u[n,j-1])/4; t[n,j] = (2*s[n,j] - s[n,j+1] - s[n,j-1])/2 - u[n,j]; \
         a[n,j] = (2*t[n,j] - t[n,j+1] - t[n,j-1])/4; b[n,j] = (2*a[n,j] - a[n,j+1] - a[n,j-1])/2 - t[n,j]; \
         u[n+1,j] = u[n,j] - C/40*(b[n,j] + (C^2 - 2)^2*u[n,j])",
    ),
    (
        "an interior wave and a fraction",
        "g = 1 − C (2 − (2s² − 1)²): the wave s = √(1/2) binds; stable C",
        "s[n,j] = (2*u[n,j] - u[n,j+1] - u[n,j-1])/4; t[n,j] = (2*s[n,j] - s[n,j+1] - s[n,j-1])/2 - u[n,j]; \
         a[n,j] = (2*t[n,j] - t[n,j+1] - t[n,j-1])/4; b[n,j] = (2*a[n,j] - a[n,j+1] - a[n,j-1])/2 - t[n,j]; \
         u[n+1,j] = u[n,j] - C*(2*u[n,j] - b[n,j])",
    ),
    (
        "disconnected stable sets",
        "g = 1 − a (1 − e^{−iφ}), a = C (C² − 6C + 19/2)/3: stable C up to 10",
        "u[n+1,j] = u[n,j] - C*(C^2 - 6*C + 19/2)/3*(u[n,j] - u[n,j-1])",
    ),
    (
        "a polynomial of degree 8 in C",
        "upwind differences, four stages of Runge and Kutta: stable C",
        "a[n,j] = -C*(u[n,j] - u[n,j-1]); b[n,j] = -C/2*(a[n,j] - a[n,j-1]); c[n,j] = -C/3*(b[n,j] - b[n,j-1]); \
         u[n+1,j] = u[n,j] + a[n,j] + b[n,j] + c[n,j] - C/4*(c[n,j] - c[n,j-1])",
    ),
    (
        "coefficients of very different size",
        "the upwind scheme with −10^{−12} C³ of diffusion: stable C up to 10",
        "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]) - C^3/10^12*(u[n,j+1] - 2*u[n,j] + u[n,j-1])",
    ),
];

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
