//! Speed and damping of waves for every kernel, at equal resolution.

use super::plan::{Named, lattice, letter, phases};
use crate::cells;
use crate::figure::{Axis, Color, Dash, Figure, Panel, Series};
use crate::page::Item;
use crate::paper_text::{PaperText, csv};
use crate::report::ReportError;
use crate::wave_map::wave_number_axis;
use courant_analysis::exact::rational::{Rational, ratio, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::waves::dispersion::sweep::Quantity;
use courant_analysis::waves::sweep::SweepError;
use serde::Deserialize;
use std::f64::consts::PI;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    /// `h/Δ` of the cubic spline.
    ratio: Named<Rational>,
    panels: Vec<PanelPlan>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct PanelPlan {
    title: String,
    method: String,
    shown: Shown,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Shown {
    Speed,
    Damping,
}

impl Shown {
    fn quantity(self) -> Quantity {
        match self {
            Self::Speed => Quantity::Speed,
            Self::Damping => Quantity::DampingPerWavelength,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Damping => "damping",
        }
    }

    /// Panels side by side are to be compared: one scale.
    fn axis(self) -> Axis {
        match self {
            Self::Speed => Axis::linear("phase speed Re ω/(cκ)").range(0.3, 1.3),
            Self::Damping => Axis::linear("damping per wavelength").range(0.0, 3.2),
        }
    }
}

/// The smoothing ratio, to a thousandth, at which a kernel is as wide as the cubic spline at this one.
fn equal_width_ratio(kernel: Kernel, of_spline: &Rational) -> Rational {
    let width = Kernel::CubicSpline.standard_deviation() * to_f64(of_spline);
    ratio((1000.0 * width / kernel.standard_deviation()).round() as i64, 1000)
}

/// The figure.
///
/// # Errors
/// When a ratio is out of range.
pub fn item(text: &PaperText) -> Result<Item, ReportError> {
    let plan: Plan = text.plan("kernel_waves");
    let phases = phases(240);
    let mut figure = Figure::grid(plan.panels.len().div_ceil(2), 2).size(7.4, 6.2);
    let mut lines = Vec::new();
    for (place, PanelPlan { title, method, shown }) in plan.panels.iter().enumerate() {
        let mut panel = Panel::new(wave_number_axis().range(0.0, PI), shown.axis())
            .title(format!("{}{title}", letter(place)));
        if *shown == Shown::Speed {
            panel = panel.layer(Series::horizontal(1.0).width(0.7));
        }
        for (index, kernel) in Kernel::ALL.into_iter().enumerate() {
            let at = equal_width_ratio(kernel, &plan.ratio.0);
            let waves = lattice(method, kernel, &at)?.waves().map_err(SweepError::from)?.compile();
            let points: Vec<(f64, f64)> = phases
                .iter()
                .map(|&phase| (phase, shown.quantity().of(&waves.mode(phase))))
                .collect();
            for (phase, value) in &points {
                lines.push(cells![method, shown.name(), kernel.name(), to_text(&at), phase, value]);
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
    Ok(text.figure("kernel_waves", &[], figure, vec![("kernel_waves.csv".into(), data)]))
}
