//! What a run does at the Courant numbers that Table 1 prints as stable.

use super::super::{LimitKind, PublishedValue, published_values};
use super::{discretisation, text};
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Section;
use crate::paper_text::csv;
use crate::{cells, words};
use courant_analysis::exact::rational::{to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::{
    AdvectionScheme, CriticalGrowth, Discretisation, Method, ParticlePath, Ring, RingModes,
    Stepper, growth_at,
};
use rayon::prelude::*;

/// Steps of each run.
const STEPS: u64 = 1000;

/// Steps between two points of the figure.
const EVERY: u64 = 50;

/// One printed Courant number, run.
struct Case {
    printed: PublishedValue,
    growth: CriticalGrowth,
    /// `(steps, log10 of the amplitude over the first)`, on particles with neighbours found.
    history: Vec<(f64, f64)>,
}

fn cases() -> Vec<Case> {
    let stability: Vec<PublishedValue> =
        published_values().into_iter().filter(|v| v.kind == LimitKind::Stability).collect();
    stability
        .into_par_iter()
        .map(|printed| {
            let scheme = AdvectionScheme::GodunovSph;
            let discretisation = discretisation(scheme, printed.kernel, printed.ratio.clone());
            let growth = growth_at(&discretisation, to_f64(&printed.courant), 32..=256, STEPS);
            let history = history(&discretisation, &growth);
            Case { printed, growth, history }
        })
        .collect()
}

/// The amplitude of the excited mode over a free run.
fn history(discretisation: &Discretisation, growth: &CriticalGrowth) -> Vec<(f64, f64)> {
    let ring = Ring::uniform(growth.particles, growth.particles as f64)
        .expect("a ring of 32 or more particles has room");
    let method = Method::of(discretisation, growth.courant_number);
    let mut stepper = ParticlePath::new(method, &ring);
    let modes = RingModes::new(growth.particles);
    let wave: Vec<f64> =
        ring.positions().iter().map(|position| (growth.phase * position).cos()).collect();
    stepper.set_state(&wave);
    let first = modes.amplitude(growth.mode, &wave).norm();
    let mut history = vec![(0.0, 0.0)];
    for step in 1..=STEPS {
        stepper.step();
        if step % EVERY == 0 {
            let amplitude = modes.amplitude(growth.mode, stepper.state()).norm() / first;
            history.push((step as f64, amplitude.log10()));
        }
    }
    history
}

/// These runs take milliseconds and are the same in a quick report.
pub(super) fn section() -> Section {
    let cases = cases();
    let worst = cases
        .iter()
        .filter_map(|case| Some((case.growth.measured_gain? - case.growth.predicted_gain).abs()))
        .fold(0.0, f64::max);
    let history = cases.iter().flat_map(|Case { printed, growth, history }| {
        history.iter().map(|&(steps, measured)| {
            let predicted = steps * growth.predicted_gain.log10();
            let (kernel, ratio) = (printed.kernel.name(), to_text(&printed.ratio));
            cells![kernel, ratio, growth.courant_number, steps, predicted, measured]
        })
    });
    let data = csv("kernel,ratio,cfl,steps,predicted_log10,measured_log10", history);
    let data = vec![("figure_printed_growth.csv".into(), data)];
    let items = vec![
        text().paragraph("printed_growth_text", words!["worst" = significant(worst, 2)]),
        text().table("printed_growth", words!["steps" = STEPS], cases.iter().map(row)),
        text().figure("figure_printed_growth", words!["steps" = STEPS], figure(&cases), data),
    ];
    text().section("title_printed_growth", items)
}

fn row(Case { printed, growth, .. }: &Case) -> Vec<String> {
    // Rounding of a gain of 1 is no growth.
    let excess = |gain: f64| {
        if (gain - 1.0).abs() < 1e-14 { "0".into() } else { significant(gain - 1.0, 6) }
    };
    let if_it_grows = |text: Option<String>| {
        text.filter(|_| growth.largest_gain - 1.0 > 1e-14).unwrap_or_else(|| "–".into())
    };
    let wavelength = 2.0 * std::f64::consts::PI / growth.critical_phase;
    cells![
        printed.kernel.title(),
        to_text(&printed.ratio),
        format!("{:.2}", growth.courant_number),
        excess(growth.largest_gain),
        if_it_grows(Some(format!("{} Δξ", significant(wavelength, 4)))),
        growth.particles,
        growth.mode,
        excess(growth.predicted_gain),
        growth.measured_gain.map_or_else(|| "overflowed".into(), excess),
        if_it_grows(growth.steps_to_double.map(|steps| format!("{steps:.0}"))),
    ]
}

fn figure(cases: &[Case]) -> Figure {
    let mut figure = Figure::grid(1, 2).size(7.2, 3.7);
    for (letter, kernel) in [('a', Kernel::Gaussian), ('b', Kernel::CubicSpline)] {
        let mut panel = Panel::new(
            // Growth at a constant rate is a line of slope one; both kernels on the same scale.
            Axis::log("steps").range(0.8 * EVERY as f64, 1.2 * STEPS as f64),
            Axis::log("decades grown, log₁₀ |û/û₀|").range(2e-3, 10.0),
        )
        .title(format!("({letter}) Godunov SPH, {}", kernel.title()));
        let chosen = cases.iter().filter(|case| case.printed.kernel == kernel);
        for (k, case) in chosen.enumerate() {
            let color = Color::qualitative(k);
            let label = format!("l/Δξ = {}", to_text(&case.printed.ratio));
            let slope = case.growth.predicted_gain.log10();
            panel = panel
                .layer(
                    Series::line([1.0, 2.0 * STEPS as f64].map(|steps| (steps, slope * steps)))
                        .color(color)
                        .width(0.9)
                        .label(&label),
                )
                .layer(
                    Series::markers(case.history.iter().copied(), Marker::nth(k))
                        .color(color)
                        .fill(Color::WHITE)
                        .size(3.4)
                        .label(label),
                );
        }
        figure = figure.panel(panel);
    }
    figure
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_amplitude_on_particles_grows_at_the_predicted_rate() {
        for case in cases() {
            let &(steps, log) = case.history.last().unwrap();
            let predicted = steps * case.growth.predicted_gain.log10();
            // A thousand steps of rounding in a wave of amplitude 1.
            assert!((log - predicted).abs() < 1e-11, "{} {log} {predicted}", case.printed.courant);
        }
    }
}
