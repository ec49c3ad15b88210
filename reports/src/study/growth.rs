//! What runs do at given Courant numbers, such as printed limits, step by step.

use super::plan::letter;
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Section;
use crate::paper_text::{PaperText, csv};
use crate::{cells, words};
use courant_analysis::exact::rational::to_text;
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::{
    CriticalGrowth, Discretisation, Method, ParticlePath, Ring, RingModes, Stepper, growth_at,
};
use rayon::prelude::*;

/// Steps of each run.
const STEPS: u64 = 1000;

/// Steps between two points of the figure.
const EVERY: u64 = 50;

/// One Courant number, run.
struct Run {
    of: Discretisation,
    growth: CriticalGrowth,
    /// `(steps, log10 of the amplitude over the first)`, on particles with neighbours found.
    history: Vec<(f64, f64)>,
}

fn runs(cases: &[(Discretisation, f64)]) -> Vec<Run> {
    let run = |(of, courant): &(Discretisation, f64)| {
        let growth = growth_at(of, *courant, 32..=256, STEPS);
        Run { history: history(of, &growth), of: of.clone(), growth }
    };
    cases.par_iter().map(run).collect()
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

/// The section: Courant numbers of a scheme, with a panel for each of `panels`. These runs take milliseconds and are the
/// same in a quick report.
pub fn section(text: &PaperText, cases: &[(Discretisation, f64)], panels: &[Kernel]) -> Section {
    let runs = runs(cases);
    let worst = runs
        .iter()
        .filter_map(|run| Some((run.growth.measured_gain? - run.growth.predicted_gain).abs()))
        .fold(0.0, f64::max);
    let history = runs.iter().flat_map(|Run { of, growth, history }| {
        history.iter().map(|&(steps, measured)| {
            let predicted = steps * growth.predicted_gain.log10();
            let (kernel, ratio) = (of.kernel().name(), to_text(of.ratio()));
            cells![kernel, ratio, growth.courant_number, steps, predicted, measured]
        })
    });
    let data = csv("kernel,ratio,cfl,steps,predicted_log10,measured_log10", history);
    let data = vec![("figure_printed_growth.csv".into(), data)];
    let steps = words!["steps" = STEPS];
    let items = vec![
        text.paragraph("printed_growth_text", words!["worst" = significant(worst, 2)]),
        text.table("printed_growth", steps, runs.iter().map(row)),
        text.figure("figure_printed_growth", steps, figure(&runs, panels), data),
    ];
    text.section("title_printed_growth", items)
}

fn row(Run { of, growth, .. }: &Run) -> Vec<String> {
    // Rounding of a gain of 1 is no growth.
    let excess = |gain: f64| {
        if (gain - 1.0).abs() < 1e-14 { "0".into() } else { significant(gain - 1.0, 6) }
    };
    let if_it_grows = |text: Option<String>| {
        text.filter(|_| growth.largest_gain - 1.0 > 1e-14).unwrap_or_else(|| "–".into())
    };
    let wavelength = 2.0 * std::f64::consts::PI / growth.critical_phase;
    cells![
        of.kernel().title(),
        to_text(of.ratio()),
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

fn figure(runs: &[Run], kernels: &[Kernel]) -> Figure {
    let mut figure = Figure::grid(1, kernels.len()).size(7.2, 3.7);
    for (index, kernel) in kernels.iter().enumerate() {
        let mut panel = Panel::new(
            // Growth at a constant rate is a line of slope one; both kernels on the same scale.
            Axis::log("steps").range(0.8 * EVERY as f64, 1.2 * STEPS as f64),
            Axis::log("decades grown, log₁₀ |û/û₀|").range(2e-3, 10.0),
        )
        .title(format!(
            "{}{}, {}",
            letter(index),
            runs[0].of.scheme().title(),
            kernel.title()
        ));
        let chosen = runs.iter().filter(|run| run.of.kernel() == *kernel);
        for (k, run) in chosen.enumerate() {
            let color = Color::qualitative(k);
            let label = format!("l/Δξ = {}", to_text(run.of.ratio()));
            let slope = run.growth.predicted_gain.log10();
            panel = panel
                .layer(
                    Series::line([1.0, 2.0 * STEPS as f64].map(|steps| (steps, slope * steps)))
                        .color(color)
                        .width(0.9)
                        .label(&label),
                )
                .layer(
                    Series::markers(run.history.iter().copied(), Marker::nth(k))
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
    use super::super::plan::discretisation;
    use super::*;
    use courant_analysis::exact::rational::integer;
    use courant_simulation::advection::AdvectionScheme;

    #[test]
    fn the_amplitude_on_particles_grows_at_the_predicted_rate() {
        let kernels = [Kernel::CubicSpline, Kernel::Gaussian];
        let of =
            kernels.map(|kernel| discretisation(AdvectionScheme::GodunovSph, kernel, &integer(2)));
        let cases = of.map(|of| (of.clone(), 1.02 * of.stable_set().limit().value()));
        for run in runs(&cases) {
            let &(steps, log) = run.history.last().unwrap();
            let predicted = steps * run.growth.predicted_gain.log10();
            // A thousand steps of rounding in a wave of amplitude 1.
            assert!(predicted > 0.1 && (log - predicted).abs() < 1e-11, "{log} {predicted}");
        }
    }
}
