//! Speed and damping of waves for every kernel, at equal resolution.

use super::super::ReportError;
use super::{lattice, phases, text, usual_ratio};
use crate::cells;
use crate::figure::{Axis, Color, Dash, Figure, Panel, Series};
use crate::page::Item;
use crate::paper_text::csv;
use crate::wave_map::wave_number_axis;
use courant_analysis::exact::rational::{Rational, ratio, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::waves::dispersion::sweep::Quantity;
use courant_analysis::waves::sweep::SweepError;
use std::f64::consts::PI;

/// The smoothing ratio, to a thousandth, at which a kernel is as wide as the cubic spline at the usual one.
fn equal_width_ratio(kernel: Kernel) -> Rational {
    let width = Kernel::CubicSpline.standard_deviation() * to_f64(&usual_ratio());
    ratio((1000.0 * width / kernel.standard_deviation()).round() as i64, 1000)
}

pub fn item() -> Result<Item, ReportError> {
    // Panels side by side are to be compared: one scale.
    let speed = ("phase speed Re ω/(cκ)", 0.3, 1.3);
    let damping = ("damping per wavelength", 0.0, 3.2);
    let panels = [
        ("(a) SPH: speed", "sph", Quantity::Speed, speed),
        ("(b) GPH, resolved: speed", "gph", Quantity::Speed, speed),
        ("(c) SPH, α = 1: damping", "sph-av", Quantity::DampingPerWavelength, damping),
        ("(d) GPH, resolved: damping", "gph", Quantity::DampingPerWavelength, damping),
    ];
    let phases = phases(240);
    let mut figure = Figure::grid(2, 2).size(7.4, 6.2);
    let mut lines = Vec::new();
    for (title, method, quantity, (label, low, high)) in panels {
        let mut panel =
            Panel::new(wave_number_axis().range(0.0, PI), Axis::linear(label).range(low, high))
                .title(title);
        if quantity == Quantity::Speed {
            panel = panel.layer(Series::horizontal(1.0).width(0.7));
        }
        for (index, kernel) in Kernel::ALL.into_iter().enumerate() {
            let at = equal_width_ratio(kernel);
            let waves = lattice(method, kernel, &at)?.waves().map_err(SweepError::from)?.compile();
            let points: Vec<(f64, f64)> =
                phases.iter().map(|&phase| (phase, quantity.of(&waves.mode(phase)))).collect();
            for (phase, value) in &points {
                let what = if quantity == Quantity::Speed { "speed" } else { "damping" };
                lines.push(cells![method, what, kernel.name(), to_text(&at), phase, value]);
            }
            let line = Series::line(points)
                .color(Color::qualitative(index))
                .width(1.2)
                .dash(Dash::nth(index % 4))
                .label(format!("{}, h/Δ = {}", kernel.title(), to_f64(&at)));
            panel = panel.layer(line);
        }
        figure = figure.panel(panel);
    }
    let data = csv("method,quantity,kernel,ratio,kappa,value", lines);
    Ok(text().figure("kernel_waves", &[], figure, vec![("kernel_waves.csv".into(), data)]))
}
