//! What runs do at the Courant numbers that Table 1 prints as stable, step by step.

use super::table_1::{LimitKind, published_values};
use super::text;
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::number::significant;
use crate::page::Section;
use crate::paper_text::csv;
use crate::study::plan::{discretisation, letter};
use crate::{cells, words};
use courant_analysis::exact::rational::{to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::weak_instability::{
    fastest_growth, growth_seen_by, steps_to_double,
};
use courant_simulation::advection::{
    AdvectionScheme, Discretisation, ParticlePath, Ring, RingModes, Stepper,
};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// Steps of each run.
const STEPS: u64 = 1000;

/// Steps between two points of the figure.
const EVERY: u64 = 50;

/// Particles of the rings to choose from.
const SIZES: RangeInclusive<usize> = 32..=256;

/// The kernels of the panels.
const PANELS: [Kernel; 2] = [Kernel::Gaussian, Kernel::CubicSpline];

/// The fastest-growing wave at one Courant number, predicted and run.
#[derive(Debug)]
struct Run {
    of: Discretisation,
    courant_number: f64,
    /// The phase with the largest gain on the infinite lattice, in radians.
    critical_phase: f64,
    /// That gain.
    largest_gain: f64,
    /// Particles on the ring that was run: the smallest of those with a mode closest to that gain.
    particles: usize,
    /// The mode that was excited: the ring's fastest, so that rounding in the others stays below it however long the run is.
    mode: usize,
    /// Its predicted gain per step.
    predicted_gain: f64,
    /// Steps in which it doubles, as predicted; `None` when it does not grow.
    steps_to_double: Option<f64>,
    /// `(steps, log10 of its amplitude over the first)`, on particles with neighbours found.
    history: Vec<(f64, f64)>,
}

impl Run {
    fn new(of: Discretisation, courant_number: f64) -> Self {
        let margin = of.margin();
        let critical = fastest_growth(&margin, courant_number);
        let seen = |particles| (particles, growth_seen_by(&margin, courant_number, particles));
        let (particles, wave) = (SIZES.map(seen))
            .reduce(|best, other| if other.1.growth > best.1.growth { other } else { best })
            .expect("there are sizes to choose from");
        let mode = (wave.phase / TAU * particles as f64).round() as usize;
        let history = history(&of, courant_number, particles, mode);
        Self {
            of,
            courant_number,
            critical_phase: critical.phase,
            largest_gain: 1.0 + critical.growth,
            particles,
            mode,
            predicted_gain: 1.0 + wave.growth,
            steps_to_double: steps_to_double(wave.growth),
            history,
        }
    }

    /// Its gain per step in the run; `None` when the run overflowed.
    fn measured_gain(&self) -> Option<f64> {
        let &(steps, log) = self.history.last()?;
        log.is_finite().then(|| 10f64.powf(log / steps))
    }
}

/// The amplitude of a mode over a free run that begins with nothing else.
fn history(
    of: &Discretisation,
    courant_number: f64,
    particles: usize,
    mode: usize,
) -> Vec<(f64, f64)> {
    let ring = Ring::uniform(particles, particles as f64)
        .expect("a ring of 32 or more particles has room");
    let mut stepper = ParticlePath::new(of, courant_number, &ring);
    let modes = RingModes::new(particles);
    let mut amplitudes = vec![Complex64::ZERO; modes.count()];
    amplitudes[mode] = Complex64::ONE;
    stepper.set_state(&modes.state(&amplitudes));
    let amplitude = |stepper: &ParticlePath| modes.amplitude(mode, stepper.state()).norm();
    let first = amplitude(&stepper);
    let mut history = vec![(0.0, 0.0)];
    for step in 1..=STEPS {
        stepper.step();
        if step.is_multiple_of(EVERY) {
            history.push((step as f64, (amplitude(&stepper) / first).log10()));
        }
    }
    history
}

/// A run at every printed stability limit.
fn runs() -> Vec<Run> {
    let printed = published_values().into_par_iter();
    let printed = printed.filter(|value| value.kind == LimitKind::Stability);
    let run = |value: super::PublishedValue| {
        let of = discretisation(AdvectionScheme::GodunovSph, value.kernel, &value.ratio);
        Run::new(of, to_f64(&value.courant))
    };
    printed.map(run).collect()
}

/// The section. These runs take milliseconds and are the same in a quick report.
pub(super) fn section() -> Section {
    let runs = runs();
    let worst = runs
        .iter()
        .filter_map(|run| Some((run.measured_gain()? - run.predicted_gain).abs()))
        .fold(0.0, f64::max);
    let history = runs.iter().flat_map(|run| {
        run.history.iter().map(|&(steps, measured)| {
            let predicted = steps * run.predicted_gain.log10();
            let (kernel, ratio) = (run.of.kernel().name(), to_text(run.of.ratio()));
            cells![kernel, ratio, run.courant_number, steps, predicted, measured]
        })
    });
    let data = csv("kernel,ratio,cfl,steps,predicted_log10,measured_log10", history);
    let data = vec![("figure_printed_growth.csv".into(), data)];
    let steps = words!["steps" = STEPS];
    let items = vec![
        text().paragraph("printed_growth_text", words!["worst" = significant(worst, 2)]),
        text().table("printed_growth", steps, runs.iter().map(row)),
        text().figure("figure_printed_growth", steps, figure(&runs), data),
    ];
    text().section("title_printed_growth", items)
}

fn row(run: &Run) -> Vec<String> {
    // Rounding of a gain of 1 is no growth.
    let excess = |gain: f64| {
        if (gain - 1.0).abs() < 1e-14 { "0".into() } else { significant(gain - 1.0, 6) }
    };
    let if_it_grows = |text: Option<String>| {
        text.filter(|_| run.largest_gain - 1.0 > 1e-14).unwrap_or_else(|| "–".into())
    };
    let wavelength = TAU / run.critical_phase;
    cells![
        run.of.kernel().title(),
        to_text(run.of.ratio()),
        format!("{:.2}", run.courant_number),
        excess(run.largest_gain),
        if_it_grows(Some(format!("{} Δξ", significant(wavelength, 4)))),
        run.particles,
        run.mode,
        excess(run.predicted_gain),
        run.measured_gain().map_or_else(|| "overflowed".into(), excess),
        if_it_grows(run.steps_to_double.map(|steps| format!("{steps:.0}"))),
    ]
}

fn figure(runs: &[Run]) -> Figure {
    let mut figure = Figure::grid(1, PANELS.len()).size(7.2, 3.7);
    for (index, kernel) in PANELS.into_iter().enumerate() {
        let mut panel = Panel::new(
            // Growth at a constant rate is a line of slope one; both kernels on the same scale.
            Axis::log("steps").range(0.8 * EVERY as f64, 1.2 * STEPS as f64),
            Axis::log("decades grown, log₁₀ |û/û₀|").range(2e-3, 10.0),
        )
        .title(format!(
            "{}{}, {}",
            letter(index),
            AdvectionScheme::GodunovSph.title(),
            kernel.title()
        ));
        let chosen = runs.iter().filter(|run| run.of.kernel() == kernel);
        for (k, run) in chosen.enumerate() {
            let color = Color::qualitative(k);
            let label = format!("l/Δξ = {}", to_text(run.of.ratio()));
            let slope = run.predicted_gain.log10();
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
    use super::*;
    use courant_analysis::exact::rational::integer;

    #[test]
    fn the_printed_limits_grow_at_the_predicted_rate() {
        let runs = runs();
        assert_eq!(runs.len(), 12);
        for run in runs {
            // A thousand steps of rounding in a wave of amplitude 1, spread over them.
            let measured = run.measured_gain().unwrap();
            assert!((measured - run.predicted_gain).abs() < 1e-14, "{run:?}");
            for (steps, log) in &run.history {
                assert!((log - steps * run.predicted_gain.log10()).abs() < 1e-11, "{run:?}");
            }
            // The ring's mode reaches the growth of the lattice but for a few per cent.
            assert!(run.largest_gain >= run.predicted_gain - 1e-14);
            let shortfall =
                (run.largest_gain - run.predicted_gain) / (run.largest_gain - 1.0).max(1e-12);
            assert!(shortfall < 0.02, "{run:?}");
            // Only the exact shift (cubic, ratio 1, C = 1) is truly neutral; the rest were printed too high.
            let shift = run.of.kernel() == Kernel::CubicSpline && *run.of.ratio() == integer(1);
            assert_eq!(run.predicted_gain > 1.0 + 1e-6, !shift);
            assert!(measured < 1.02);
        }
    }
}
