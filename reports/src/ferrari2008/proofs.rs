//! What a proof costs and what sampling misses; limits as roots of polynomials; the hard cases.

mod hard_cases;

use super::{Detail, text};
use crate::cells;
use crate::figure::{Axis, Color, Dash, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::paper_text::csv;
use crate::timing::timed;
use courant_analysis::exact::rational::{Rational, parse, ratio, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::{
    AccuracyRow, accuracy_study, phase_grid, sampled_stability_limit,
};
use courant_simulation::advection::{AdvectionScheme, Discretisation};

/// Errors below the rounding of an `f64` are drawn here.
const ERROR_FLOOR: f64 = 1e-17;

/// Longer equations are described, not printed.
const LONGEST_EQUATION: usize = 180;

fn scheme(scheme: AdvectionScheme, kernel: Kernel, l: &Rational) -> Discretisation {
    let discretisation = Discretisation::new(scheme, kernel, l.clone());
    discretisation.expect("the ratios of the report are within range")
}

/// Work against error of the limits, and the tables of hard cases and of roots.
pub fn section(detail: Detail) -> Vec<Section> {
    let (cost, hard) = rayon::join(
        || vec![cost_figure(), cost_table(detail)],
        || vec![hard_cases::table(), roots()],
    );
    vec![text().section("title_limits_cost", cost), text().section("title_hard_cases", hard)]
}

/// Work against error for two schemes: one bound by the longest waves, one by an interior wave.
fn cost_figure() -> Item {
    let cases = [
        (AdvectionScheme::GodunovSph, ratio(5, 1), "(a) Godunov SPH, l/Δξ = 5"),
        (AdvectionScheme::LaxWendroffSph, ratio(13, 10), "(b) Lax–Wendroff SPH, l/Δξ = 1.3"),
    ];
    let mut figure = Figure::grid(1, 2).size(7.2, 3.4);
    let mut lines = Vec::new();
    for (name, l, title) in cases {
        let of = scheme(name, Kernel::CubicSpline, &l);
        let (rows, _) = timed(|| accuracy_study(of.step(), "C", &of.plan().max));
        let rows = rows.expect("only the Courant number is free");
        lines.extend(rows.iter().map(|row| {
            let (method, error) = (row.method, row.relative_error);
            cells![name, to_text(&l), method.name(), method.size(), error, row.work, row.seconds]
        }));
        figure = figure.panel(cost_panel(&rows, title));
    }
    let header = "scheme,ratio,method,size,relative_error,work,seconds";
    let data = vec![("limits_cost.csv".into(), csv(header, lines))];
    text().figure("limits_cost", &[], figure, data)
}

fn cost_panel(rows: &[AccuracyRow], title: &str) -> Panel {
    let mut panel = Panel::new(
        Axis::log("phases or boxes looked at"),
        Axis::log("relative error of the limit").range(0.2 * ERROR_FLOOR, 1.0),
    )
    .title(title)
    .layer(Series::horizontal(ERROR_FLOOR).dash(Dash::Dashed).label("no error that an f64 shows"));
    for (name, color, marker) in [
        ("sampled", Color::VERMILION, Marker::Circle),
        ("refined", Color::ORANGE, Marker::Square),
        ("proved", Color::BLUE, Marker::Triangle),
    ] {
        let points: Vec<(f64, f64)> = rows
            .iter()
            .filter(|row| row.method.name() == name)
            .map(|row| (row.work as f64, row.relative_error.max(ERROR_FLOOR)))
            .collect();
        panel = panel
            .layer(Series::line(points.clone()).color(color).width(0.7).label(name))
            .layer(Series::markers(points, marker).color(color).size(4.0).label(name));
    }
    panel
}

/// Proof and samples over the smoothing ratio.
fn cost_table(detail: Detail) -> Item {
    let ratios: &[&str] = match detail {
        Detail::Quick => &["1", "1.3", "5"],
        Detail::Standard | Detail::Full => &["1", "1.3", "2", "5", "10", "20", "50"],
    };
    let schemes = [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph];
    let cases = schemes.into_iter().flat_map(|name| {
        [Kernel::CubicSpline, Kernel::Gaussian]
            .into_iter()
            .flat_map(move |kernel| ratios.iter().map(move |&written| (name, kernel, written)))
    });
    let rows = cases.map(|(name, kernel, written)| {
        let of = scheme(name, kernel, &parse(written).expect("the list holds decimals"));
        let (set, proof) = timed(|| of.stable_set());
        let limit = set.limit();
        let milliseconds = |seconds: f64| significant(1e3 * seconds, 2);
        let (sampling, error) = if limit.is_positive() {
            let phases = phase_grid(std::f64::consts::PI / 1024.0);
            let (sampled, seconds) =
                timed(|| sampled_stability_limit(&of.margin(), &phases, &of.plan().max));
            let error = (sampled.value() / limit.value() - 1.0).abs();
            (milliseconds(seconds), significant(error, 2))
        } else {
            ("–".into(), "no positive limit".into())
        };
        let proof = milliseconds(proof);
        let decimal = limit.decimal(10).unwrap_or_default();
        cells![name, kernel.name(), written, decimal, set.work.boxes, proof, sampling, error]
    });
    text().table("limits_cost_table", &[], rows)
}

/// Limits of Lax–Wendroff SPH at interior waves: algebraic numbers.
fn roots() -> Item {
    let ratios = ["1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.8", "2", "2.5", "3"];
    let rows = ratios.into_iter().map(|written| {
        let l = parse(written).expect("the list holds decimals");
        let of = scheme(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, &l);
        let limit = of.stable_set().limit();
        let (degree, equation) = match (limit.exact(), limit.equation()) {
            (Some(exact), _) => (String::new(), exact.to_string()),
            (None, Some(root)) => {
                let equation = root.equation("C");
                let longest = root.polynomial().coefficients().iter().map(|c| c.bits()).max();
                let shown = if equation.len() <= LONGEST_EQUATION {
                    equation
                } else {
                    format!("integers of up to {} bits", longest.unwrap_or(0))
                };
                (root.degree().to_string(), shown)
            }
            (None, None) => (String::new(), "not sought".into()),
        };
        cells![written, limit.decimal(30).unwrap_or_default(), degree, equation]
    });
    text().table("limits_as_roots", &[], rows)
}
