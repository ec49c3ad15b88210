//! Maps of sound waves in particle methods: phase error over the (κ, h) plane, amplitude over (κ, α).

use crate::figure::{Axis, Bands, Color, ColorBar, ColorMap, Contours, Figure, FigureError, Panel};
use crate::level_set::Field;
use crate::npy;
use crate::stability_map::shades_of_damping;
use courant_analysis::exact::rational::{Rational, to_f64};
use courant_analysis::scheme::LatticeMethod;
use courant_analysis::waves::dispersion::sweep::{
    Quantity, over_phase_and_ratio, over_phase_and_viscosity,
};
use courant_analysis::waves::sweep::{Progress, SweepError};
use ndarray::Array2;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Where no wave travels.
const OVER_DAMPED: Color = Color(168, 168, 168);

/// What a map shows of the forward wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// `(Re ω − cκ)/(cκ)`: lead +, lag −.
    PhaseError,
    /// `exp(Im ω t)` at `t = Δ/c`.
    Amplitude,
}

/// A quantity over the wave number `κΔ` and a second axis; arrays are `[κ, second]`.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveMap {
    /// What is shown.
    pub shown: Shown,
    /// `κΔ > 0` in radians, ascending.
    pub kappas: Vec<f64>,
    /// `h/Δ` or α, ascending.
    pub second: Vec<f64>,
    /// The quantity.
    pub values: Array2<f64>,
    /// `b/(2ω0)`: above 1 the wave is over-damped; NaN where the lattice is unstable.
    pub damping_ratio: Array2<f64>,
}

/// The phase error over `(κ, h)`; of `method` all but the ratio is used.
///
/// ```
/// use courant_analysis::scheme::{LatticeMethod, catalogue};
/// use courant_analysis::{kernel::Kernel, exact::rational::integer, waves::sweep::no_progress};
/// use courant_reports::wave_map::phase_error_map;
/// let sph = catalogue::method("sph").unwrap();
/// let sph = LatticeMethod::new(sph, Kernel::CubicSpline, &integer(1))?;
/// let map = phase_error_map(&sph, &[1.0, 2.0], &[integer(1), integer(2)], &no_progress)?;
/// // At h = Δ: ω² = 4(1 − cos κ) − sin²κ, in units of c²/Δ².
/// let exact = 1.0 - (4.0 * (1.0 - 2f64.cos()) - 2f64.sin().powi(2)).sqrt() / 2.0;
/// assert!((map.values[[1, 0]] + exact).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When a ratio is out of range or the callback stops the sweep.
pub fn phase_error_map(
    method: &LatticeMethod,
    kappas: &[f64],
    ratios: &[Rational],
    progress: Progress<'_>,
) -> Result<WaveMap, SweepError> {
    let sweep =
        |quantity, part: Progress<'_>| over_phase_and_ratio(method, kappas, ratios, quantity, part);
    let [values, damping_ratio] = both(Quantity::PhaseError, progress, sweep)?;
    let second = ratios.iter().map(to_f64).collect();
    Ok(WaveMap { shown: Shown::PhaseError, kappas: kappas.to_vec(), second, values, damping_ratio })
}

/// The amplitude left at `t = Δ/c` over `(κ, α)`; `method` has α = 1.
///
/// # Errors
/// When the callback stops the sweep.
pub fn amplitude_map(
    method: &LatticeMethod,
    kappas: &[f64],
    alphas: &[f64],
    progress: Progress<'_>,
) -> Result<WaveMap, SweepError> {
    let quantity = Quantity::Amplitude(Default::default());
    let sweep = |quantity, part: Progress<'_>| {
        over_phase_and_viscosity(method, kappas, alphas, quantity, part)
    };
    let [values, damping_ratio] = both(quantity, progress, sweep)?;
    Ok(WaveMap {
        shown: Shown::Amplitude,
        kappas: kappas.to_vec(),
        second: alphas.to_vec(),
        values,
        damping_ratio,
    })
}

/// The quantity and the damping ratio, each swept `[second, κ]` and returned `[κ, second]`.
fn both(
    quantity: Quantity,
    progress: Progress<'_>,
    sweep: impl Fn(Quantity, Progress<'_>) -> Result<Array2<f64>, SweepError>,
) -> Result<[Array2<f64>; 2], SweepError> {
    let first = |done: usize, all: usize| -> ControlFlow<()> { progress(done, 2 * all) };
    let second = |done: usize, all: usize| -> ControlFlow<()> { progress(all + done, 2 * all) };
    let turned = |map: Array2<f64>| map.t().as_standard_layout().into_owned();
    Ok([turned(sweep(quantity, &first)?), turned(sweep(Quantity::DampingRatio, &second)?)])
}

impl WaveMap {
    /// Whether any wave of the map is over-damped.
    pub fn has_over_damped(&self) -> bool {
        self.damping_ratio.iter().any(|value| *value > 1.0)
    }

    /// The panel: bands, isolines, where waves are over-damped, and where the lattice is unstable.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn panel(&self, title: &str) -> Result<Panel, FigureError> {
        let (low, high) = self.ends();
        let last = self.kappas.len() - 1;
        // Up to the ends of the axis values are those of the nearest wave: they are even in κ.
        let before = (low < self.kappas[0]).then_some((low, 0));
        let after = (high > self.kappas[last]).then_some((high, last));
        let inner = self.kappas.iter().copied().zip(0..);
        let (nodes, waves): (Vec<f64>, Vec<usize>) =
            before.into_iter().chain(inner).chain(after).unzip();
        let all = |values: &Array2<f64>| values.select(ndarray::Axis(0), &waves);
        let field = |values: Array2<f64>| Field::new(nodes.clone(), self.second.clone(), values);
        // Above 0 where waves travel; in this measure the damping ratio has no poles.
        let damping = all(&self.damping_ratio);
        let travels = damping.mapv(|ratio| match ratio.is_infinite() {
            true => -1.0,
            false => (1.0 - ratio) / (1.0 + ratio),
        });
        let still = travels.mapv(|travels| -travels);
        let values = field(all(&self.values))?;
        let name = match self.shown {
            Shown::PhaseError => "smoothing ratio h/Δ",
            Shown::Amplitude => "viscosity coefficient α",
        };
        let x = wave_number_axis().range(low, high);
        let mut panel = Panel::new(x, Axis::linear(name).spanning(&self.second)).title(title);
        // A single wave is rounding at the end of the lattice's stability.
        if damping.iter().filter(|ratio| ratio.is_nan()).count() > 1 {
            let everywhere = field(damping.mapv(|_| 0.0))?;
            let grows = Contours::region(everywhere, 0.0, Color::DARK_RED);
            panel = panel.contours(grows.label("lattice unstable: the wave grows"));
        }
        let border = Contours::new(field(travels.clone())?).isolines([0.0]);
        let border = border.width(1.4);
        let levels: &[f64] = match self.shown {
            Shown::PhaseError => &[-0.6, -0.4, -0.2, -0.1, -0.05, -0.02, 0.02, 0.05, 0.1, 0.2],
            Shown::Amplitude => &[0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9],
        };
        let contours = |field| {
            let lines = levels.iter().copied();
            Contours::new(field).bands(self.bands()).isolines(lines).width(0.5)
        };
        // The two sides of the border each by themselves: there the amplitude has a cusp.
        let travelling = values.clone().within(travels)?;
        panel = panel.contours(contours(travelling.clone()));
        let leads = self.values.iter().any(|error| *error > 0.0);
        if self.shown == Shown::PhaseError && leads {
            let exact = Contours::new(travelling).isolines([0.0]).width(1.2);
            panel = panel.contours(exact.label("exact speed"));
        }
        Ok(match (self.has_over_damped(), self.shown) {
            (false, _) => panel,
            (true, Shown::PhaseError) => {
                let still = Contours::region(field(still)?, 0.0, OVER_DAMPED);
                let still = still.label("over-damped: both waves decay, none travels");
                panel.contours(still).contours(border)
            }
            (true, Shown::Amplitude) => panel
                .contours(contours(values.within(still)?))
                .contours(border.label("beyond: over-damped, no wave travels")),
        })
    }

    /// The ends of the axis of wave numbers. One that stops less than a step short of 0 or of a labelled tick is drawn up
    /// to it: a map cannot begin at 0, and decimals do not reach π.
    fn ends(&self) -> (f64, f64) {
        let kappas = &self.kappas;
        let (low, high) = (kappas[0], kappas[kappas.len() - 1]);
        let steps = || kappas.windows(2).map(|pair| 1.0001 * (pair[1] - pair[0]));
        let low = if steps().next().is_some_and(|step| low <= step) { 0.0 } else { low };
        let next = 0.25 * PI * (high / (0.25 * PI)).ceil();
        let short = steps().next_back().is_some_and(|step| next - high < step);
        (low, if short { next } else { high })
    }

    /// The bands of the colour bar.
    pub fn bands(&self) -> Bands {
        match self.shown {
            Shown::PhaseError => {
                let half = [0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6];
                let edges = half.iter().rev().map(|edge| -edge).chain(half).collect();
                let bands = Bands::new(edges, |t| ColorMap::BluesReds.at(t));
                bands.extend_below(Color(8, 38, 76)).extend_above(Color::DARK_RED)
            }
            Shown::Amplitude => shades_of_damping(10).extend_above(Color::DARK_RED),
        }
    }

    /// The colour bar of this map and of others that show the same: with a pointed end only when one of them needs it.
    pub fn color_bar(&self, others: &[&Self]) -> ColorBar {
        let label = match self.shown {
            Shown::PhaseError => "phase error Re ω/(cκ) − 1 (lead +, lag −)",
            Shown::Amplitude => "amplitude at t = Δ/c",
        };
        let maps = std::iter::once(self).chain(others.iter().copied());
        let values = maps.flat_map(|map| map.values.iter().copied());
        ColorBar::new(self.bands().needed_for(values), label)
    }

    /// The figure with one panel.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn figure(&self, title: &str) -> Result<Figure, FigureError> {
        Ok(Figure::single(self.panel(title)?).size(5.4, 4.2).color_bar(self.color_bar(&[])))
    }

    /// Every data file of the map: names that begin with `stem`, and contents.
    pub fn data_files(&self, stem: &str) -> Vec<(String, Vec<u8>)> {
        let (second, value) = match self.shown {
            Shown::PhaseError => ("ratio", "phase_error"),
            Shown::Amplitude => ("alpha", "amplitude"),
        };
        let mut text = format!("kappa,{second},{value},damping_ratio\n");
        for ((i, j), shown) in self.values.indexed_iter() {
            let (kappa, other) = (self.kappas[i], self.second[j]);
            let damping = self.damping_ratio[[i, j]];
            text.push_str(&format!("{kappa},{other},{shown},{damping}\n"));
        }
        let array = (format!("{stem}_{value}.npy"), npy::encode(&self.values));
        let axes = npy::axes(stem, &self.kappas, &self.second);
        [(format!("{stem}.csv"), text.into_bytes()), array].into_iter().chain(axes).collect()
    }
}

/// The axis of wave numbers: ticks up to 2π, where the waves of the lattice begin again.
pub fn wave_number_axis() -> Axis {
    Axis::linear("wave number κΔ (radians per spacing)").ticks([
        (0.0, "0"),
        (0.25 * PI, "π/4"),
        (0.5 * PI, "π/2"),
        (0.75 * PI, "3π/4"),
        (PI, "π"),
        (1.25 * PI, "5π/4"),
        (1.5 * PI, "3π/2"),
        (1.75 * PI, "7π/4"),
        (2.0 * PI, "2π"),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::{integer, ratio};
    use courant_analysis::kernel::Kernel;
    use courant_analysis::scheme::catalogue;
    use courant_analysis::waves::dispersion::{Frequencies, Regime};
    use courant_analysis::waves::sweep::no_progress;

    fn lattice(name: &str, kernel: Kernel) -> LatticeMethod {
        LatticeMethod::new(catalogue::method(name).unwrap(), kernel, &ratio(6, 5)).unwrap()
    }

    #[test]
    fn amplitudes_are_where_they_belong() {
        let viscous = lattice("sph-av", Kernel::CubicSpline);
        let (kappas, alphas) = ([0.5, 1.5, 3.0], [0.0, 2.0]);
        let map = amplitude_map(&viscous, &kappas, &alphas, &no_progress).unwrap();
        assert_eq!(map.values.dim(), (3, 2));
        for ((i, j), value) in map.values.indexed_iter() {
            let mode = viscous.waves().unwrap().compile().mode(kappas[i]);
            let waves = Frequencies::of(mode.restoring, alphas[j] * mode.damping);
            assert!((value - waves.forward.im.exp()).abs() < 1e-15);
            assert_eq!(map.damping_ratio[[i, j]] > 1.0, waves.regime == Regime::OverDamped);
        }
        assert!(map.has_over_damped());
        let svg = map.figure("waves").unwrap().svg().unwrap();
        assert!(svg.0.contains("over-damped") && !svg.0.contains("lattice unstable"));
    }

    #[test]
    fn ends_of_the_axis_of_wave_numbers_are_ticks() {
        let axis = |kappas: &[f64]| {
            let kappas = kappas.to_vec();
            let values = Array2::zeros((kappas.len(), 2));
            let second = vec![1.0, 2.0];
            let damping_ratio = values.clone();
            WaveMap { shown: Shown::Amplitude, kappas, second, values, damping_ratio }.ends()
        };
        let even = |from: i32, to: i32| -> Vec<f64> {
            (from..=to).map(|index| f64::from(index) * 0.02).collect()
        };
        assert_eq!(axis(&even(1, 157)), (0.0, PI));
        assert_eq!(axis(&even(1, 314)), (0.0, 2.0 * PI));
        assert_eq!(axis(&even(50, 100)), (1.0, 2.0));
    }

    #[test]
    fn an_unstable_lattice_is_named() {
        // The quartic spline loses its restoring force from h/Δ of about 2.1 on.
        let sph = lattice("sph", Kernel::QuarticSpline);
        let kappas: Vec<f64> = (1..=60).map(|index| f64::from(index) * PI / 60.0).collect();
        let ratios = [integer(2), ratio(9, 4), ratio(12, 5)];
        let map = phase_error_map(&sph, &kappas, &ratios, &no_progress).unwrap();
        assert!(map.damping_ratio.column(0).iter().all(|value| value.is_finite()));
        assert!(map.damping_ratio.column(2).iter().any(|value| value.is_nan()));
        assert!(map.figure("waves").unwrap().svg().unwrap().0.contains("lattice unstable"));
    }
}
