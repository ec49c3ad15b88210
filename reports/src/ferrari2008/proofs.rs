//! What a proof costs and what sampling misses; the hard cases of the limits.

use super::{COMMAND, Detail, ReportError};
use crate::figure::{Axis, Color, Figure, Marker, Markers, Panel};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::table::{Align, Table};
use courant_analysis::kernel::Kernel;
use courant_analysis::limit::{
    AccuracyRow, LimitMethod, accuracy_study, growth_limit, stability_limit, stable_set,
};
use courant_analysis::margin::Margin;
use courant_analysis::rational::{Rational, integer, parse, ratio, to_f64, to_text};
use courant_analysis::scheme::{AdvectionScheme, Discretisation, Scheme, search_range};
use courant_analysis::symbol::EnclosedSymbol;
use courant_analysis::verdict::check;
use courant_analysis::weak_instability::long_wave_behaviour;
use num_traits::Zero;
use std::time::Instant;

/// Errors below the rounding of an `f64` are drawn here.
const ERROR_FLOOR: f64 = 1e-17;

fn symbol(scheme: AdvectionScheme, kernel: Kernel, l: &Rational) -> EnclosedSymbol {
    let discretisation = Discretisation::new(scheme, kernel, l.clone());
    discretisation.expect("the ratios of the report are within range").symbol()
}

/// Speed against error of the limits, and the table of hard cases.
///
/// # Errors
/// When a figure cannot be composed.
pub fn sections(detail: Detail) -> Result<Vec<Section>, ReportError> {
    Ok(vec![
        Section {
            title: "Limits with proof: speed against error".into(),
            items: vec![cost_figure(detail)?, cost_table(detail)],
        },
        Section { title: "Limits: the hard cases".into(), items: vec![hard_cases()] },
    ])
}

/// Time against error for two schemes: one bound by the longest waves, one by an interior wave.
fn cost_figure(detail: Detail) -> Result<Item, ReportError> {
    let repetitions = if detail == Detail::Full { 5 } else { 1 };
    let cases = [
        (AdvectionScheme::GodunovSph, ratio(5, 1), "(a) Godunov SPH, l/Δξ = 5"),
        (AdvectionScheme::LaxWendroffSph, ratio(13, 10), "(b) Lax–Wendroff SPH, l/Δξ = 1.3"),
    ];
    let mut figure = Figure::grid(1, 2).size(7.2, 3.4);
    let mut csv = String::from("scheme,ratio,method,size,relative_error,seconds\n");
    for (scheme, l, title) in cases {
        let rows = accuracy_study(
            &symbol(scheme, Kernel::CubicSpline, &l),
            &search_range(&l),
            repetitions,
        );
        for row in &rows {
            csv.push_str(&format!(
                "{},{},{},{},{},{}\n",
                scheme.name(),
                to_text(&l),
                row.method.name(),
                row.method.size(),
                row.relative_error,
                row.seconds
            ));
        }
        figure = figure.panel(cost_panel(&rows, title));
    }
    Ok(Item::Figure {
        name: "limits_cost".into(),
        figure: Box::new(figure.legend_below()),
        caption: format!(
            "Relative error of a stability limit against the time it takes (least of {repetitions}), cubic spline; (a) long waves bind, (b) an interior wave. Sampled: 8 to 65,536 equal \
             steps of the phase. Refined: the worst sampled phase improved in floating point. Proved: to 16, 24, 32, 40 and 52 \
             bits; where the limit is a fraction the proof is exact from the start. Errors that are not resolved are drawn at 1e-17."
        ),
        data: vec![("limits_cost.csv".into(), csv.into_bytes())],
        command: COMMAND.into(),
    })
}

fn cost_panel(rows: &[AccuracyRow], title: &str) -> Panel {
    let mut panel = Panel::new(
        Axis::log("relative error of the limit").range(0.3 * ERROR_FLOOR, 1.0),
        Axis::log("time in seconds"),
    )
    .title(title);
    for (name, color, marker) in [
        ("sampled", Color::VERMILION, Marker::Circle),
        ("refined", Color::ORANGE, Marker::Square),
        ("proved", Color::BLUE, Marker::Triangle),
    ] {
        let points: Vec<(f64, f64)> = rows
            .iter()
            .filter(|row| row.method.name() == name)
            .map(|row| (row.relative_error.max(ERROR_FLOOR), row.seconds))
            .collect();
        panel = panel.layer(Markers::new(points, marker).color(color).size(4.0).label(name));
    }
    panel
}

/// Proof and samples over the smoothing ratio.
fn cost_table(detail: Detail) -> Item {
    let ratios: &[&str] = match detail {
        Detail::Full => &["1", "1.3", "2", "5", "10", "20", "50"],
        Detail::Quick => &["1", "1.3", "5"],
    };
    let mut table = Table::new(
        "Proof against samples over the smoothing ratio",
        &[
            ("scheme", Align::Left),
            ("kernel", Align::Left),
            ("l/Δξ", Align::Right),
            ("limit", Align::Right),
            ("proof, ms", Align::Right),
            ("boxes", Align::Right),
            ("1024 samples, ms", Align::Right),
            ("their error", Align::Right),
        ],
    );
    for scheme in [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph] {
        for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
            for text in ratios {
                let l = parse(text).expect("the list holds decimals");
                let symbol = symbol(scheme, kernel, &l);
                let start = Instant::now();
                let set = stable_set(&symbol, &Rational::zero(), &search_range(&l));
                let proof = start.elapsed();
                let limit = set.limit();
                let (sampling, error) = if limit.is_positive() {
                    let phases = courant_analysis::limit::phase_grid(std::f64::consts::PI / 1024.0);
                    let start = Instant::now();
                    let sampled = courant_analysis::limit::sampled_stability_limit(
                        &symbol,
                        &phases,
                        &search_range(&l),
                    );
                    let error = (sampled.value() / limit.value() - 1.0).abs();
                    (significant(1e3 * start.elapsed().as_secs_f64(), 2), significant(error, 2))
                } else {
                    ("–".into(), "no positive limit".into())
                };
                table.push([
                    scheme.name().to_string(),
                    kernel.name().into(),
                    (*text).into(),
                    significant(limit.value(), 10),
                    significant(1e3 * proof.as_secs_f64(), 2),
                    set.work.boxes.to_string(),
                    sampling,
                    error,
                ]);
            }
        }
    }
    Item::Table { name: "limits_cost_table".into(), table, command: COMMAND.into() }
}

/// The hard cases, each answered by a computation.
fn hard_cases() -> Item {
    let mut table = Table::new(
        "Hard cases of the limits",
        &[("case", Align::Left), ("question", Align::Left), ("answer", Align::Left)],
    );
    let godunov = |l: &Rational| symbol(AdvectionScheme::GodunovSph, Kernel::CubicSpline, l);
    let limit_text =
        |l: &Rational| significant(stability_limit(&godunov(l), &search_range(l)).value(), 13);
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
    let neighbours =
        courant_analysis::lattice::LatticeWeights::new(Kernel::Gaussian, &(&typed + ratio(1, 30)))
            .map_or(0, |weights| weights.reach());
    table.push([
        "ratio 1/3 with the Gaussian".into(),
        "is the neighbour at exactly q = 3 counted?".into(),
        format!("yes: {neighbours} neighbour on each side"),
    ]);
    let margin = Margin::new(&godunov(&integer(1)), &Rational::zero()).compile();
    let phase = 1e-9_f64;
    let exact = (0.5 * phase).sin().powi(2);
    table.push([
        "phase 1e-9".into(),
        "Godunov, cubic, ratio 1, C = 1/2: relative error of 1 − |g|²".into(),
        significant((margin.at(0.5, phase) / exact - 1.0).abs(), 2),
    ]);
    let shift = check(&godunov(&integer(1)), &integer(1), &integer(20));
    table.push([
        "exactly neutral".into(),
        "Godunov, cubic, ratio 1, C = 1 is the exact shift".into(),
        format!("{}, growth {}", shift.verdict.name(), shift.strongest.growth),
    ]);
    let weak = symbol(AdvectionScheme::LaxWendroffSph, Kernel::Gaussian, &integer(3));
    let budgets: Vec<String> = ["0", "1e-9", "1e-6", "1e-4", "1e-3", "1e-2"]
        .into_iter()
        .map(|growth| {
            let budget = parse(growth).expect("a decimal");
            format!(
                "{growth}: {}",
                significant(growth_limit(&weak, &budget, &integer(30)).value(), 6)
            )
        })
        .collect();
    table.push([
        "weak instability".into(),
        "Lax–Wendroff, cut Gaussian, ratio 3: limit for a growth per step of".into(),
        budgets.join("; "),
    ]);
    let drifting = symbol(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, &ratio(13, 10));
    let drift = to_f64(&(drifting.mean_gain().evaluate(&integer(1)) - integer(1)));
    table.push([
        "the mean drifts".into(),
        "Lax–Wendroff, cubic, ratio 1.3, C = 1: change of a constant per step".into(),
        significant(drift, 6),
    ]);
    let above = Margin::new(&godunov(&integer(2)), &Rational::zero());
    if let Some(leading) = long_wave_behaviour(&above) {
        let amplitude = to_f64(&leading.amplitude.evaluate(&ratio(19, 10)));
        table.push([
            "just above a long-wave limit".into(),
            "Godunov, cubic, ratio 2, C = 1.9: |g|² − 1 for long waves".into(),
            format!("{} φ^{}", significant(amplitude, 6), leading.power),
        ]);
    }
    let wide = integer(50);
    let set = stable_set(&godunov(&wide), &Rational::zero(), &search_range(&wide));
    table.push([
        "ratio 50".into(),
        "Godunov, cubic: limit, and boxes looked at".into(),
        format!("{}, {}", significant(set.limit().value(), 13), set.work.boxes),
    ]);
    let tolerance = LimitMethod::Proved(52).size();
    table.push([
        "whole ratios".into(),
        format!("Lax–Wendroff, cubic, to {tolerance} bits: limits at ratio 2, 3, 5, 10"),
        [2, 3, 5, 10]
            .map(|l| {
                let symbol =
                    symbol(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, &integer(l));
                let limit = stability_limit(&symbol, &search_range(&integer(l)));
                limit.exact().map_or_else(|| significant(limit.value(), 12), ToString::to_string)
            })
            .join(", "),
    ]);
    Item::Table { name: "limits_hard_cases".into(), table, command: COMMAND.into() }
}
