//! Figures 2 to 5.

use super::{paper_lattice, text, usual_ratio};
use crate::cha_whitworth2003::published;
use crate::figure::Figure;
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::Words;
use crate::report::{Detail, ReportError};
use crate::study::plan::phases;
use crate::wave_map::{WaveMap, amplitude_map, phase_error_map};
use crate::words;
use courant_analysis::exact::rational::{integer, ratio, to_text};
use courant_analysis::kernel::{Density, Kernel};
use courant_analysis::waves::dispersion::sweep::{Quantity, even_axis};
use courant_analysis::waves::sweep::{SweepError, no_progress};

pub fn items(detail: Detail) -> Result<Vec<Item>, ReportError> {
    let (columns, rows) = if detail == Detail::Quick { (60, 51) } else { (200, 151) };
    let phases = phases(columns);
    let ratios = even_axis(&integer(1), &ratio(3, 2), rows);
    let map = |name: &str| {
        phase_error_map(&paper_lattice(name, &integer(1))?, &phases, &ratios, &no_progress)
    };
    let (sph, viscous, resolved) = (map("sph")?, map("sph-av")?, map("gph")?);
    let (kernel, density) = (Kernel::CubicSpline, Density::MassPerSpacing);
    let published = published::phase_error_map(kernel, density, &phases, &ratios, &no_progress)?;
    let alphas: Vec<f64> = (0..rows).map(|i| 4.0 * i as f64 / (rows - 1) as f64).collect();
    let amplitude =
        amplitude_map(&paper_lattice("sph-av", &usual_ratio())?, &phases, &alphas, &no_progress)?;
    let errors: Result<Vec<String>, SweepError> =
        [105, 110, 130, 150].into_iter().map(long_wave_error).collect();
    let settings = text().text("settings", &[]);
    let settings = words!["settings" = settings];
    let first = words!["errors" = errors?.join(", "), "settings" = settings[0].1];
    let third = words!["ratio" = to_text(&usual_ratio()), "amplitudes" = amplitudes()?];
    Ok(vec![
        single("figure_02", &sph, "SPH without viscosity", first)?,
        single("figure_03", &viscous, "SPH with viscosity, α = 1", settings)?,
        single("figure_04", &amplitude, "SPH with viscosity, h/Δ = 1.2", third)?,
        figure_5(&published, &resolved, settings)?,
    ])
}

fn single(name: &str, map: &WaveMap, title: &str, words: Words<'_>) -> Result<Item, ReportError> {
    Ok(text().figure(name, words, map.figure(title)?, map.data_files(name)))
}

fn figure_5(
    published: &WaveMap,
    resolved: &WaveMap,
    settings: Words<'_>,
) -> Result<Item, ReportError> {
    let figure = Figure::grid(1, 2)
        .size(8.2, 3.9)
        .panel(published.panel("(a) GPH as printed, (64)")?)
        .panel(resolved.panel("(b) GPH resolved: left and right by position")?)
        .color_bar(resolved.color_bar(&[published]));
    let mut data = published.data_files("figure_05a");
    data.extend(resolved.data_files("figure_05b"));
    Ok(text().figure("figure_05", settings, figure, data))
}

/// The error of the speed of long waves, in percent.
fn long_wave_error(numerator: i64) -> Result<String, SweepError> {
    let at = ratio(numerator, 100);
    let waves = paper_lattice("sph", &at)?.waves()?.compile();
    // (κΔ)² of this phase is far below the digits shown.
    let percent = 100.0 * (Quantity::Speed.of(&waves.mode(1e-4)) - 1.0);
    Ok(format!("{percent:+.1} % at h/Δ = {}", significant(numerator as f64 / 100.0, 3)))
}

/// What is left of the amplitude of a wave that travels, for a few viscosities.
fn amplitudes() -> Result<String, SweepError> {
    let waves = paper_lattice("sph-av", &usual_ratio())?.waves()?.compile();
    let amplitudes = [0.5, 1.0, 2.0].map(|alpha| {
        let mode = waves.clone().with_damping_scaled(alpha).mode(1.0);
        let left = Quantity::Amplitude(Default::default()).of(&mode);
        format!("{} for α = {alpha}", significant(left, 3))
    });
    Ok(amplitudes.join(", "))
}
