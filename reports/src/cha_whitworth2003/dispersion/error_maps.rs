//! Figures 2 to 5.

use super::super::{Detail, ReportError};
use super::{figure_item, paper_lattice, phases, usual_ratio};
use crate::cha_whitworth2003::published;
use crate::figure::Figure;
use crate::number::significant;
use crate::page::Item;
use crate::wave_map::{WaveMap, amplitude_map, phase_error_map};
use courant_analysis::exact::rational::{integer, ratio, to_text};
use courant_analysis::kernel::{Density, Kernel};
use courant_analysis::waves::dispersion::sweep::{Quantity, even_axis};
use courant_analysis::waves::sweep::{Progress, SweepError};
use std::ops::ControlFlow;

/// What all captions state.
const SETTINGS: &str = "Cubic B-spline, ρ0 = M/Δ with M = Δ = c = 1 as in the paper (the density that the \
                        particles sum themselves differs from it between whole h/Δ), 1 ≤ h/Δ ≤ 1.5, \
                        0 < κΔ ≤ π, forward wave, exact in time.";

pub fn items(detail: Detail, progress: Progress<'_>) -> Result<Vec<Item>, ReportError> {
    let (columns, rows) = match detail {
        Detail::Full => (200, 151),
        Detail::Quick => (60, 51),
    };
    let phases = phases(columns);
    let ratios = even_axis(&integer(1), &ratio(3, 2), rows);
    let part = |index: usize| {
        move |done: usize, all: usize| -> ControlFlow<()> { progress(index * all + done, 4 * all) }
    };
    let map = |index, name: &str| {
        phase_error_map(&paper_lattice(name, &integer(1))?, &phases, &ratios, &part(index))
    };
    let (sph, viscous, resolved) = (map(0, "sph")?, map(1, "sph-av")?, map(2, "gph")?);
    let (kernel, density) = (Kernel::CubicSpline, Density::MassPerSpacing);
    let published = published::phase_error_map(kernel, density, &phases, &ratios, &part(3))?;
    let alphas: Vec<f64> = (0..rows).map(|i| 4.0 * i as f64 / (rows - 1) as f64).collect();
    let amplitude =
        amplitude_map(&paper_lattice("sph-av", &usual_ratio())?, &phases, &alphas, progress)?;
    Ok(vec![
        single("figure_02", &sph, "SPH without viscosity", figure_2_caption()?)?,
        single("figure_03", &viscous, "SPH with viscosity, α = 1", figure_3_caption())?,
        single("figure_04", &amplitude, "SPH with viscosity, h/Δ = 1.2", figure_4_caption()?)?,
        figure_5(&published, &resolved)?,
    ])
}

fn single(name: &str, map: &WaveMap, title: &str, caption: String) -> Result<Item, ReportError> {
    Ok(figure_item(name, map.figure(title)?, caption, map.data_files(name)))
}

fn figure_5(published: &WaveMap, resolved: &WaveMap) -> Result<Item, ReportError> {
    let figure = Figure::grid(1, 2)
        .size(8.2, 3.9)
        .panel(published.panel("(a) GPH as printed, (64)")?)
        .panel(resolved.panel("(b) GPH resolved: left and right by position")?)
        .color_bar(resolved.color_bar(&[published])?)
        .legend_below();
    let mut data = published.data_files("figure_05a");
    data.extend(resolved.data_files("figure_05b"));
    let caption = format!(
        "Figure 5. Phase error of Godunov particle hydrodynamics. (a) The relation as printed, ω² + cSω = ω_SPH²: no \
         damping, and an error that stays large for long waves. It takes each particle as the left state towards \
         every neighbour, which no running scheme does. (b) The relation of the scheme, ω² + icDω = ω_SPH²: waves are \
         damped, long ones travel at the speed of SPH. {SETTINGS}"
    );
    Ok(figure_item("figure_05", figure, caption, data))
}

/// The error of the speed of long waves, in percent.
fn long_wave_error(numerator: i64) -> Result<String, SweepError> {
    let at = ratio(numerator, 100);
    let waves = paper_lattice("sph", &at)?.waves()?.compile();
    // (κΔ)² of this phase is far below the digits shown.
    let percent = 100.0 * (Quantity::Speed.of(&waves.mode(1e-4)) - 1.0);
    Ok(format!("{percent:+.1} % at h/Δ = {}", significant(numerator as f64 / 100.0, 3)))
}

fn figure_2_caption() -> Result<String, SweepError> {
    let errors: Result<Vec<String>, SweepError> =
        [105, 110, 130, 150].into_iter().map(long_wave_error).collect();
    Ok(format!(
        "Figure 2. Phase error of SPH without viscosity, ω² = c²(2T − S²). The printed caption says that the error \
         vanishes for long waves throughout 1 < h < 1.5. It does not: the lattice sums are consistent only at single \
         values of h, and the speed of infinitely long waves is wrong by {}. The white valley is where it changes \
         sign. At h/Δ = 1.5 the shortest wave (κΔ = π) has ω² = 0 exactly: it does not travel, and ω² is not positive \
         everywhere as the caption claims. {SETTINGS}",
        errors?.join(", ")
    ))
}

fn figure_3_caption() -> String {
    format!(
        "Figure 3. Phase error of SPH with viscosity, α = 1: ω² + iαhcBω = ω_SPH² (the denominator of (59) with the \
         sign that damps). The hatched region, black in the paper and called unstable there, is over-damped: both \
         roots decay and the wave does not travel, so the error is 1. Nothing grows. {SETTINGS}"
    )
}

fn figure_4_caption() -> Result<String, SweepError> {
    let waves = paper_lattice("sph-av", &usual_ratio())?.waves()?.compile();
    let amplitudes: Vec<String> = [0.5, 1.0, 2.0]
        .into_iter()
        .map(|alpha| {
            let mode = waves.clone().with_damping_scaled(alpha).mode(1.0);
            let left = Quantity::Amplitude(Default::default()).of(&mode);
            format!("{} for α = {alpha}", significant(left, 3))
        })
        .collect();
    Ok(format!(
        "Figure 4. What is left of the amplitude at t = 1 (in Δ/c) of SPH with viscosity; the paper does not print h, \
         here h/Δ = {}. Beyond the line (hatched) the waves are over-damped, and the slower of the two decays the more \
         slowly the larger α is. Two statements of the printed caption do not hold: t = 1 is not one period, which \
         lasts 2π/κ ≥ 2 for every wave of the lattice; and the amplitude does depend on α where waves travel, at \
         κΔ = 1 it is {}. Cubic B-spline, ρ0 = M/Δ with M = Δ = c = 1, 0 < κΔ ≤ π, 0 ≤ α ≤ 4, forward wave, exact in \
         time.",
        to_text(&usual_ratio()),
        amplitudes.join(", ")
    ))
}
