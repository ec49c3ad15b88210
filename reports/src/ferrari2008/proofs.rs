//! What a proof costs and what sampling misses; limits as roots of polynomials; the hard cases.

mod hard_cases;

use super::{COMMAND, Detail, ReportError};
use crate::figure::{Axis, Color, Figure, Marker, Markers, Panel};
use crate::number::significant;
use crate::page::{Item, Publish, Section};
use crate::table::{Align, Table};
use courant_analysis::exact::rational::{Rational, parse, ratio, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::{
    AccuracyRow, accuracy_study, phase_grid, sampled_stability_limit,
};
use courant_simulation::advection::{AdvectionScheme, Discretisation};
use std::time::Instant;

/// Errors below the rounding of an `f64` are drawn here.
const ERROR_FLOOR: f64 = 1e-17;

/// Longer equations are described, not printed.
const LONGEST_EQUATION: usize = 180;

fn scheme(scheme: AdvectionScheme, kernel: Kernel, l: &Rational) -> Discretisation {
    let discretisation = Discretisation::new(scheme, kernel, l.clone());
    discretisation.expect("the ratios of the report are within range")
}

/// Speed against error of the limits, and the table of hard cases.
///
/// # Errors
/// When a figure cannot be composed or a section cannot be published.
pub fn publish_sections(detail: Detail, publish: &mut Publish<'_>) -> Result<(), ReportError> {
    publish(Section {
        title: "Limits with proof: speed against error".into(),
        items: vec![cost_figure(detail)?, cost_table(detail)],
    })?;
    publish(Section {
        title: "Limits: the hard cases".into(),
        items: vec![hard_cases::table(), roots()],
    })?;
    Ok(())
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
    for (name, l, title) in cases {
        let of = scheme(name, Kernel::CubicSpline, &l);
        let rows = accuracy_study(of.step(), "C", &of.plan().max, repetitions)
            .expect("only the Courant number is free");
        for row in &rows {
            csv.push_str(&format!(
                "{},{},{},{},{},{}\n",
                name,
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
             bits, with 52 the polynomial of which the limit is a root included; where the limit is a fraction the proof is exact from the start. Errors that are not resolved are drawn at 1e-17."
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
    for name in [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph] {
        for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
            for text in ratios {
                let l = parse(text).expect("the list holds decimals");
                let of = scheme(name, kernel, &l);
                let start = Instant::now();
                let set = of.stable_set();
                let proof = start.elapsed();
                let limit = set.limit();
                let (sampling, error) = if limit.is_positive() {
                    let phases = phase_grid(std::f64::consts::PI / 1024.0);
                    let start = Instant::now();
                    let sampled = sampled_stability_limit(&of.margin(), &phases, &of.plan().max);
                    let error = (sampled.value() / limit.value() - 1.0).abs();
                    (significant(1e3 * start.elapsed().as_secs_f64(), 2), significant(error, 2))
                } else {
                    ("–".into(), "no positive limit".into())
                };
                table.push([
                    name.to_string(),
                    kernel.name().into(),
                    (*text).into(),
                    limit.decimal(10).unwrap_or_default(),
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

/// Limits of Lax–Wendroff SPH at interior waves: algebraic numbers.
fn roots() -> Item {
    let mut table = Table::new(
        "Stability limits of Lax–Wendroff SPH with the cubic spline as roots of integer polynomials",
        &[
            ("l/Δξ", Align::Right),
            ("limit", Align::Left),
            ("degree", Align::Right),
            ("equation", Align::Left),
        ],
    );
    for text in ["1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.8", "2", "2.5", "3"] {
        let l = parse(text).expect("the list holds decimals");
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
        table.push([text.into(), limit.decimal(30).unwrap_or_default(), degree, equation]);
    }
    let command = "courant limits --scheme lax-wendroff-sph --kernel cubic-spline --ratio 1.1:1.6:0.1,1.8,2,2.5,3 --digits 30";
    Item::Table { name: "limits_as_roots".into(), table, command: command.into() }
}
