//! What schemes do to waves as one figure: gain, phase error, group speed, multipliers in the complex plane; with the direction in two
//! dimensions.

use crate::figure::{Axis, Color, Dash, Figure, Panel, Series};
use crate::wave_map::wave_number_axis;
use courant_analysis::waves::branches::{Branch, BranchWave};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Speeds relative to the equation are drawn up to this far from 1: spurious branches have no bounds.
const FARTHEST: f64 = 4.0;
/// The gain is drawn up to this value.
const HIGHEST_GAIN: f64 = 2.0;

/// The branches of one scheme along one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveCurve {
    /// Its name in the legend.
    pub name: String,
    /// Which colour.
    pub color: usize,
    /// Which dash pattern.
    pub dash: usize,
    /// What it does.
    pub branches: Vec<Branch>,
}

/// What the physical branch of one scheme does to waves of one length in all directions.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectionCurve {
    /// Which colour.
    pub color: usize,
    /// Which of the wavelengths: the first is drawn boldest.
    pub rank: usize,
    /// The wavelength in cells.
    pub wavelength: f64,
    /// Angle in degrees and what happens there.
    pub waves: Vec<(f64, BranchWave)>,
}

impl WaveCurve {
    fn line(&self, points: impl IntoIterator<Item = (f64, f64)>, is_physical: bool) -> Series {
        let color = Color::qualitative(self.color);
        let line = Series::line(points).dash(Dash::nth(self.dash));
        match is_physical {
            true => line.color(color).width(1.4),
            false => line.color(color.mix(Color::WHITE, 0.45)).width(0.6),
        }
    }

    /// What the figure tells of: all but the second of two waves of an equation, which mirrors the first.
    fn shown(&self) -> impl Iterator<Item = (&Branch, bool)> {
        let shown = self.branches.iter().filter(|branch| branch.physical.is_none_or(|p| p == 0));
        shown.map(|branch| (branch, branch.physical.is_some()))
    }

    /// Lines of a quantity over the phase, physical branches on top.
    fn lines(&self, of: impl Fn(&BranchWave) -> Option<f64>, spurious: bool) -> Vec<Series> {
        let mut shown: Vec<(&Branch, bool)> =
            self.shown().filter(|(_, is_physical)| *is_physical || spurious).collect();
        shown.reverse();
        let line = |(branch, is_physical): (&Branch, bool)| {
            let points = branch.waves.iter().map(|w| (w.phase, of(w).unwrap_or(f64::NAN)));
            self.line(points, is_physical)
        };
        shown.into_iter().map(line).collect()
    }
}

/// An axis that shows all values within bounds, and the value that is no error.
fn bounded(label: &str, values: impl Iterator<Item = f64>, right: f64, far: f64) -> Axis {
    let finite = values.filter(|value| value.is_finite());
    let (least, most) = finite.fold((right, right), |(a, b), value| (a.min(value), b.max(value)));
    let (least, most) = (least.max(right - far), most.min(right + far));
    // Rounding errors are not drawn large.
    let room = 0.06 * (most - least).max(0.02);
    Axis::linear(label).range(least - room, most + room)
}

/// Values of a quantity on physical branches.
fn physical(curves: &[WaveCurve], of: impl Fn(&BranchWave) -> Option<f64>) -> Vec<f64> {
    let branches = curves.iter().flat_map(|curve| &curve.branches);
    let waves = branches.filter(|branch| branch.physical == Some(0)).flat_map(|b| &b.waves);
    waves.filter_map(of).collect()
}

/// The figure: gain, signed phase error, group speed and multipliers in the complex plane; with directions also phase speed and gain,
/// or group speed where nothing is damped, against the direction.
pub fn figure(title: &str, curves: &[WaveCurve], directions: &[DirectionCurve]) -> Figure {
    let (error, error_title) = phase_error(curves);
    let group = relative(curves, "group speed / exact", 1.0, true, BranchWave::group_speed);
    let mut panels = vec![gain(curves), error, group, multipliers(curves)];
    if !directions.is_empty() {
        panels.push(against_direction(directions, "phase speed / exact", BranchWave::phase_speed));
        panels.push(match damps(directions) {
            true => against_direction(directions, "gain |z|", |wave| Some(wave.gain())),
            false => against_direction(directions, "group speed / exact", BranchWave::group_speed),
        });
    }
    let letters = ["a", "b", "c", "d", "e", "f"];
    let titles = [
        "gain in one step",
        error_title,
        "group speed",
        "multipliers",
        "phase speed and direction",
        if damps(directions) { "gain and direction" } else { "group speed and direction" },
    ];
    let panels = panels.into_iter().zip(letters.into_iter().zip(titles));
    let panels = panels.map(|(panel, (letter, title))| panel.title(format!("({letter}) {title}")));
    let (columns, width) = if directions.is_empty() { (2, 7.4) } else { (3, 10.6) };
    let rows = curves.len().div_ceil(columns + 1) as f64;
    Figure::grid(2, columns).size(width, 6.0 + 0.16 * rows).title(title).panels(panels)
}

fn phase_axis(curves: &[WaveCurve]) -> Axis {
    let waves = curves.iter().flat_map(|c| &c.branches).flat_map(|branch| &branch.waves);
    let (low, high) = waves.fold((f64::INFINITY, 0.0f64), |(low, high), wave| {
        (low.min(wave.phase), high.max(wave.phase))
    });
    // From the longest waves on, unless a part was asked for.
    let low = if low < 0.1 * high { 0.0 } else { low };
    match low < high {
        true => wave_number_axis().range(low, high),
        false => wave_number_axis(),
    }
}

fn gain(curves: &[WaveCurve]) -> Panel {
    let values = physical(curves, |wave| Some(wave.gain())).into_iter();
    let axis = bounded("gain |z|", values.chain([0.9]), 1.0, HIGHEST_GAIN - 1.0);
    let mut panel = Panel::new(phase_axis(curves), axis).layer(Series::horizontal(1.0));
    for curve in curves {
        let exact = |wave: &BranchWave| wave.exact.map(|(exact, _)| exact.re.exp());
        // What the equation itself damps.
        if physical(std::slice::from_ref(curve), exact).iter().any(|gain| *gain < 1.0) {
            let lines = curve.lines(exact, false).into_iter();
            panel = panel.layers(lines.map(|line| line.dash(Dash::Dotted).width(0.8)));
        }
        panel = panel.layers(curve.lines(|wave| Some(wave.gain()), true));
        // A name of its own, so that it is in the legend once.
        panel = panel.layer(curve.line([], true).label(curve.name.clone()));
    }
    panel
}

/// What an equation that moves no wave leaves empty.
const NO_WAVE: &str = "nothing travels, or nothing is known of the equation";

/// A panel of a quantity relative to the equation.
fn relative(
    curves: &[WaveCurve],
    label: &str,
    right: f64,
    spurious: bool,
    of: impl Fn(&BranchWave) -> Option<f64> + Copy,
) -> Panel {
    let values = physical(curves, of);
    let phases = phase_axis(curves);
    if values.is_empty() {
        let axis = Axis::linear(label).range(right - 1.0, right + 1.0);
        return Panel::new(phases.range(0.0, PI), axis).note(FRAC_PI_2, right, NO_WAVE);
    }
    let axis = bounded(label, values.into_iter(), right, FARTHEST);
    let lines = curves.iter().flat_map(|curve| curve.lines(of, spurious));
    Panel::new(phases, axis).layer(Series::horizontal(right)).layers(lines)
}

/// The error of the phase speed, or of the rate of decay where the equation only damps.
fn phase_error(curves: &[WaveCurve]) -> (Panel, &'static str) {
    let decay = |wave: &BranchWave| Some(wave.decay_ratio()? - 1.0);
    let damps = physical(curves, BranchWave::phase_error).is_empty();
    if damps && !physical(curves, decay).is_empty() {
        let panel = relative(curves, "rate / exact − 1", 0.0, false, decay);
        return (panel, "error of the rate of decay");
    }
    let panel = relative(curves, "phase speed / exact − 1", 0.0, false, BranchWave::phase_error);
    (panel, "phase error: lead +, lag −")
}

/// The path of every multiplier from long waves to short ones, with the unit circle.
fn multipliers(curves: &[WaveCurve]) -> Panel {
    let circle = (0..=180).map(|k| (TAU * f64::from(k) / 180.0).sin_cos());
    let circle = Series::line(circle).color(Color::GREY).width(0.8).label("unit circle");
    let reach = physical(curves, |wave| Some(wave.gain())).into_iter().fold(1.0, f64::max);
    let reach = 1.08 * reach.min(HIGHEST_GAIN);
    let axis = |label| Axis::linear(label).range(-reach, reach);
    let mut panel = Panel::new(axis("Re z"), axis("Im z")).equal_units().layer(circle);
    for curve in curves {
        let shown: Vec<(&Branch, bool)> = curve.shown().collect();
        for (branch, is_physical) in shown.into_iter().rev() {
            let points = branch.waves.iter().map(|w| (w.multiplier.re, w.multiplier.im));
            panel = panel.layer(curve.line(points, is_physical));
        }
    }
    panel
}

/// Whether any wave loses or gains more than rounding errors.
fn damps(curves: &[DirectionCurve]) -> bool {
    let mut waves = curves.iter().flat_map(|curve| &curve.waves);
    waves.any(|(_, wave)| (wave.gain() - 1.0).abs() > 1e-9)
}

fn against_direction(
    curves: &[DirectionCurve],
    label: &str,
    of: impl Fn(&BranchWave) -> Option<f64>,
) -> Panel {
    let waves = || curves.iter().flat_map(|curve| &curve.waves);
    let values = waves().filter_map(|(_, wave)| of(wave));
    let y = bounded(label, values, 1.0, FARTHEST);
    let x = Axis::linear("direction (degrees)").range(0.0, 90.0);
    let x = x.ticks((0..=6).map(|k| (15.0 * f64::from(k), (15 * k).to_string())));
    let mut panel = Panel::new(x, y).layer(Series::horizontal(1.0));
    for curve in curves {
        let points: Vec<(f64, f64)> =
            curve.waves.iter().map(|(angle, w)| (*angle, of(w).unwrap_or(f64::NAN))).collect();
        // Dashes tell directions in the other panels: here lengths are told by weight, and named.
        let fades = 0.28 * curve.rank as f64;
        let color = Color::qualitative(curve.color).mix(Color::WHITE, fades);
        panel = panel.layer(Series::line(points).color(color).width(1.8 - 1.6 * fades));
    }
    for curve in curves.iter().filter(|curve| curve.color == curves[0].color) {
        // Beside the first line of each length.
        if let Some((angle, wave)) = curve.waves.get(curve.waves.len() / 8)
            && let Some(value) = of(wave)
        {
            panel = panel.note(*angle, value, format!("{} cells", curve.wavelength));
        }
    }
    panel
}

/// The angles that are drawn: every second degree from the first axis to the second, both with it.
pub fn angles() -> impl Iterator<Item = f64> {
    (0..=45).map(|k| 2.0 * f64::from(k))
}

/// The unit vector of an angle in degrees; along the axes exactly.
///
/// ```
/// assert_eq!(courant_reports::wave_curves::unit_vector(90.0), [0.0, 1.0]);
/// ```
pub fn unit_vector(degrees: f64) -> [f64; 2] {
    let turn = degrees.rem_euclid(360.0);
    let (sine, cosine) = ((turn % 90.0) / 90.0 * FRAC_PI_2).sin_cos();
    match (turn / 90.0) as u8 {
        0 => [cosine, sine],
        1 => [-sine + 0.0, cosine],
        2 => [-cosine, -sine + 0.0],
        _ => [sine, -cosine],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::ratio;
    use courant_analysis::scheme::catalogue;
    use courant_analysis::waves::branches::Branches;
    use courant_analysis::waves::exact_wave::ExactWave;

    #[test]
    fn a_figure_of_several_schemes_names_each_once() {
        let phases: Vec<f64> =
            (1..=32).map(|k| f64::from(k) / 32.0 * std::f64::consts::PI).collect();
        let curve = |(index, name): (usize, &str)| {
            let file = catalogue::scheme(name).unwrap();
            let step = file.step(None, None, &[("C".into(), ratio(1, 2))], None).unwrap();
            let exact = ExactWave::stated(file.exact.as_deref().unwrap(), &step).unwrap();
            let branches = Branches::of_step(&step, exact).unwrap().along(&[1.0], &phases);
            WaveCurve { name: name.into(), color: index, dash: 0, branches }
        };
        let curves: Vec<WaveCurve> =
            ["upwind", "leapfrog"].into_iter().enumerate().map(curve).collect();
        // The computational branch of the leapfrog is drawn, but not in the phase error.
        assert_eq!(curves[1].lines(|w| Some(w.gain()), true).len(), 2);
        assert_eq!(curves[1].lines(BranchWave::phase_error, false).len(), 1);
        let figure = figure("test", &curves, &[]);
        let svg = figure.svg().unwrap();
        assert!(svg.png().is_ok() && svg.0.starts_with("<svg"));
    }

    #[test]
    fn a_figure_of_diffusion_shows_the_rate_of_decay() {
        let file = catalogue::scheme("heat-ftcs").unwrap();
        let step = file.step(None, None, &[("r".into(), ratio(1, 6))], None).unwrap();
        let exact = ExactWave::stated(file.exact.as_deref().unwrap(), &step).unwrap();
        let branches = Branches::of_step(&step, exact).unwrap().along(&[1.0], &[1.0, 2.0, 3.0]);
        let curve = WaveCurve { name: "heat".into(), color: 0, dash: 0, branches };
        assert_eq!(phase_error(std::slice::from_ref(&curve)).1, "error of the rate of decay");
        assert!(figure("heat", &[curve], &[]).svg().is_ok());
    }

    #[test]
    fn unit_vectors_have_the_signs_of_their_quadrant() {
        for degrees in [0.0, 30.0, 45.0, 90.0, 135.0, 180.0, 250.0, 270.0, 300.0] {
            let [x, y] = unit_vector(degrees);
            let (sine, cosine) = f64::to_radians(degrees).sin_cos();
            assert!((x - cosine).abs() < 1e-15 && (y - sine).abs() < 1e-15, "{degrees}");
        }
        assert_eq!(unit_vector(180.0), [-1.0, 0.0]);
    }
}
