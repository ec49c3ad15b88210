//! What a proof of a limit costs, what sampling misses, and limits as roots of polynomials.

use super::plan::{ByDetail, Case, Named, discretisation, letter};
use crate::cells;
use crate::figure::{Axis, Color, Dash, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::{PaperText, csv};
use crate::report::Detail;
use crate::timing::timed;
use courant_analysis::exact::rational::{Rational, parse, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::{
    AccuracyRow, accuracy_study, phase_grid, sampled_stability_limit,
};
use courant_simulation::advection::AdvectionScheme;
use serde::Deserialize;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    /// The cases of the figure.
    shown: Vec<Case>,
    schemes: Vec<Named<AdvectionScheme>>,
    kernels: Vec<Named<Kernel>>,
    /// Smoothing ratios as they are written.
    ratios: ByDetail<Vec<String>>,
    /// The scheme, the kernel and the ratios whose limits are roots.
    roots: (Named<AdvectionScheme>, Named<Kernel>, Vec<String>),
}

/// A ratio as it is written.
fn read(written: &str) -> Rational {
    parse(written).expect("the list holds decimals")
}

/// Errors below the rounding of an `f64` are drawn here.
const ERROR_FLOOR: f64 = 1e-17;

/// Longer equations are described, not printed.
const LONGEST_EQUATION: usize = 180;

/// Work against error in a figure and a table.
pub fn items(text: &PaperText, detail: Detail) -> Vec<Item> {
    let plan: Plan = text.plan("limits_cost");
    vec![cost_figure(text, &plan), cost_table(text, &plan, detail)]
}

fn cost_figure(text: &PaperText, plan: &Plan) -> Item {
    let mut figure = Figure::grid(1, plan.shown.len()).size(7.2, 3.4);
    let mut lines = Vec::new();
    for (index, case) in plan.shown.iter().enumerate() {
        let (of, name) = (case.discretisation(), case.scheme.0);
        let l = to_text(&case.ratio.0);
        let l_decimal = to_f64(&case.ratio.0);
        let title = format!("{}{}, l/Δξ = {l_decimal}", letter(index), name.title());
        let (rows, _) = timed(|| accuracy_study(of.step(), "C", &of.plan().max));
        let rows = rows.expect("only the Courant number is free");
        lines.extend(rows.iter().map(|row| {
            let (method, error) = (row.method, row.relative_error);
            cells![name, l, method.name(), method.size(), error, row.work, row.seconds]
        }));
        figure = figure.panel(cost_panel(&rows, &title));
    }
    let header = "scheme,ratio,method,size,relative_error,work,seconds";
    let data = vec![("limits_cost.csv".into(), csv(header, lines))];
    text.figure("limits_cost", &[], figure, data)
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
fn cost_table(text: &PaperText, plan: &Plan, detail: Detail) -> Item {
    let ratios = plan.ratios.at(detail);
    let cases = plan.schemes.iter().flat_map(|name| {
        plan.kernels
            .iter()
            .flat_map(move |kernel| ratios.iter().map(move |written| (name.0, kernel.0, written)))
    });
    let rows = cases.map(|(name, kernel, written)| {
        let of = discretisation(name, kernel, &read(written));
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
    text.table("limits_cost_table", &[], rows)
}

/// Limits at interior waves: algebraic numbers.
pub fn roots(text: &PaperText) -> Item {
    let plan: Plan = text.plan("limits_cost");
    let (scheme, kernel, ratios) = &plan.roots;
    let rows = ratios.iter().map(|written| {
        let of = discretisation(scheme.0, kernel.0, &read(written));
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
    text.table("limits_as_roots", &[], rows)
}
