//! Maps of sound waves in particle methods: phase error over the (κ, h) plane, amplitude over (κ, α), the
//! largest stable time step over (h, α).

use crate::figure::{
    Axis, Bands, Color, ColorBar, ColorMap, Field, Figure, FigureError, FilledContours, Isolines,
    Panel, Region, Side,
};
use crate::npy;
use courant_analysis::dispersion::WaveScheme;
use courant_analysis::dispersion::sweep::{
    Quantity, over_phase_and_ratio, over_phase_and_viscosity, stable_step_map,
};
use courant_analysis::integrator::Integrator;
use courant_analysis::rational::{Rational, to_f64};
use courant_analysis::sweep::{Progress, SweepError};
use ndarray::Array2;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Time steps `c Δt/h` are looked at up to this one: no integrator here comes near it from `h = Δ/2` on.
pub const MAX_STEP: f64 = 8.0;

/// Above this the damping ratio is drawn as this: its contour at 1 must not meet an infinite node.
const LARGEST_DAMPING_RATIO: f64 = 4.0;

/// What a map shows of the forward wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// `|cκ − Re ω|/(cκ)`.
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

/// The phase error over `(κ, h)`; of `scheme` all but the ratio is used.
///
/// # Errors
/// When a ratio is out of range or the callback stops the sweep.
pub fn phase_error_map(
    scheme: &WaveScheme,
    kappas: &[f64],
    ratios: &[Rational],
    progress: Progress<'_>,
) -> Result<WaveMap, SweepError> {
    let sweep =
        |quantity, part: Progress<'_>| over_phase_and_ratio(scheme, kappas, ratios, quantity, part);
    let [values, damping_ratio] = both(Quantity::PhaseError, progress, sweep)?;
    let second = ratios.iter().map(to_f64).collect();
    Ok(WaveMap { shown: Shown::PhaseError, kappas: kappas.to_vec(), second, values, damping_ratio })
}

/// The amplitude left at `t = Δ/c` over `(κ, α)`; `scheme` has α = 1.
///
/// # Errors
/// When the callback stops the sweep.
pub fn amplitude_map(
    scheme: &WaveScheme,
    kappas: &[f64],
    alphas: &[f64],
    progress: Progress<'_>,
) -> Result<WaveMap, SweepError> {
    let quantity = Quantity::Amplitude(Default::default());
    let sweep = |quantity, part: Progress<'_>| {
        over_phase_and_viscosity(scheme, kappas, alphas, quantity, part)
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

    /// The panel: bands, isolines, the over-damped region hatched, and where the lattice is unstable.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn panel(&self, title: &str) -> Result<Panel, FigureError> {
        let field =
            |values: Array2<f64>| Field::new(self.kappas.clone(), self.second.clone(), values);
        let (x, y) = (range(&self.kappas), range(&self.second));
        let name = match self.shown {
            Shown::PhaseError => "smoothing ratio h/Δ",
            Shown::Amplitude => "viscosity coefficient α",
        };
        let mut panel =
            Panel::new(wave_number_axis().range(x.0, x.1), Axis::linear(name).range(y.0, y.1))
                .title(title)
                .layer(FilledContours::new(field(self.values.clone())?, self.bands()?));
        // Where nothing travels the error is 1 by definition: its isolines would only crowd the border.
        let mut travelling = self.values.clone();
        travelling.zip_mut_with(&self.damping_ratio, |value, ratio| {
            if *ratio > 1.0 || ratio.is_nan() {
                *value = f64::NAN;
            }
        });
        let levels: &[f64] = match self.shown {
            Shown::PhaseError => &[0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6],
            Shown::Amplitude => &[0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9],
        };
        let shown = match self.shown {
            Shown::PhaseError => travelling,
            Shown::Amplitude => self.values.clone(),
        };
        panel = panel.layer(Isolines::new(field(shown)?, levels.iter().copied()).width(0.6));
        let damping = self
            .damping_ratio
            .mapv(|ratio| if ratio.is_nan() { 0.0 } else { ratio.min(LARGEST_DAMPING_RATIO) });
        let damping = field(damping)?;
        let border =
            Isolines::new(damping.clone(), [1.0]).without_values().color(Color::BLACK).width(1.4);
        let hatch = match self.shown {
            Shown::PhaseError => Color::WHITE,
            Shown::Amplitude => Color::BLACK,
        };
        panel = panel
            .layers(regions(&damping, 1.0, hatch, "over-damped: both waves decay, none travels"))
            .layer(border);
        let unstable =
            field(self.damping_ratio.mapv(|ratio| if ratio.is_nan() { 1.0 } else { 0.0 }))?;
        Ok(panel.layers(regions(
            &unstable,
            0.5,
            Color::VERMILION,
            "lattice unstable: the wave grows",
        )))
    }

    /// The bands of the colour bar.
    ///
    /// # Errors
    /// Never: the edges ascend.
    pub fn bands(&self) -> Result<Bands, FigureError> {
        match self.shown {
            Shown::PhaseError => {
                let edges = vec![0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0];
                Bands::sequential(edges, ColorMap::Blues)
                    .map(|bands| bands.extend_above(ColorMap::Blues.at(1.0)))
            }
            Shown::Amplitude => {
                let edges = (0..=10).map(|tenths| f64::from(tenths) / 10.0).collect();
                let grows = Color::rgb(92, 8, 18);
                Bands::sequential(edges, ColorMap::Viridis).map(|bands| bands.extend_above(grows))
            }
        }
    }

    /// The colour bar.
    ///
    /// # Errors
    /// Never: the edges ascend.
    pub fn color_bar(&self) -> Result<ColorBar, FigureError> {
        let label = match self.shown {
            Shown::PhaseError => "phase error |cκ − Re ω|/(cκ)",
            Shown::Amplitude => "amplitude at t = Δ/c",
        };
        Ok(ColorBar::new(self.bands()?, label))
    }

    /// The figure with one panel.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn figure(&self, title: &str) -> Result<Figure, FigureError> {
        Ok(Figure::single(self.panel(title)?)
            .size(5.4, 4.2)
            .color_bar(self.color_bar()?, Side::Right)
            .legend_below())
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
        vec![
            (format!("{stem}.csv"), text.into_bytes()),
            (format!("{stem}_{value}.npy"), npy::encode(&self.values)),
        ]
    }
}

/// The axis of wave numbers, up to the shortest wave of the lattice.
pub fn wave_number_axis() -> Axis {
    Axis::linear("wave number κΔ (radians per spacing)").ticks([
        (0.0, "0"),
        (0.25 * PI, "π/4"),
        (0.5 * PI, "π/2"),
        (0.75 * PI, "3π/4"),
        (PI, "π"),
    ])
}

fn range(values: &[f64]) -> (f64, f64) {
    (values[0], values[values.len() - 1])
}

/// The regions where a field is at least `level`, hatched.
fn regions<'a>(
    field: &Field,
    level: f64,
    color: Color,
    label: &'a str,
) -> impl Iterator<Item = Region> + use<'a> {
    field.region_at_least(level).into_iter().map(move |ring| {
        Region::polygon(ring.into_iter().map(|point| (point[0], point[1])))
            .hatch(color)
            .label(label)
    })
}

/// The largest stable `c Δt/h` over `(h, α)` for one integrator; arrays are `[h, α]`.
#[derive(Debug, Clone, PartialEq)]
pub struct StepMap {
    /// The integrator.
    pub integrator: Integrator,
    /// `h/Δ`, ascending.
    pub ratios: Vec<f64>,
    /// α, ascending.
    pub alphas: Vec<f64>,
    /// The largest step no sampled wave finds unstable.
    pub steps: Array2<f64>,
}

/// Computes the map; `scheme` is SPH with α = 1. Looked at on a grid of phases, not proved.
///
/// # Errors
/// When a ratio is out of range or the callback stops the sweep.
pub fn step_map(
    scheme: &WaveScheme,
    integrator: Integrator,
    ratios: &[Rational],
    alphas: &[f64],
    progress: Progress<'_>,
) -> Result<StepMap, SweepError> {
    let steps = stable_step_map(scheme, integrator, ratios, alphas, MAX_STEP, progress)?;
    let ratios = ratios.iter().map(to_f64).collect();
    Ok(StepMap { integrator, ratios, alphas: alphas.to_vec(), steps })
}

impl StepMap {
    /// The panel: bands and isolines.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn panel(&self, title: &str) -> Result<Panel, FigureError> {
        let field = Field::new(self.ratios.clone(), self.alphas.clone(), self.steps.clone())?;
        let (x, y) = (range(&self.ratios), range(&self.alphas));
        let levels = [0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4];
        Ok(Panel::new(
            Axis::linear("smoothing ratio h/Δ").range(x.0, x.1),
            Axis::linear("viscosity α").range(y.0, y.1),
        )
        .title(title)
        .layer(FilledContours::new(field.clone(), Self::bands()?))
        .layer(Isolines::new(field, levels).width(0.6)))
    }

    /// The bands of the colour bar.
    ///
    /// # Errors
    /// Never: the edges ascend.
    pub fn bands() -> Result<Bands, FigureError> {
        let edges = vec![0.0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.8];
        Bands::sequential(edges, ColorMap::Viridis)
            .map(|bands| bands.extend_above(ColorMap::Viridis.at(1.0)))
    }

    /// The colour bar.
    ///
    /// # Errors
    /// Never: the edges ascend.
    pub fn color_bar() -> Result<ColorBar, FigureError> {
        Ok(ColorBar::new(Self::bands()?, "largest stable c Δt/h"))
    }

    /// The figure with one panel.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn figure(&self, title: &str) -> Result<Figure, FigureError> {
        Ok(Figure::single(self.panel(title)?)
            .size(5.2, 4.0)
            .color_bar(Self::color_bar()?, Side::Right))
    }

    /// Every data file of the map: names that begin with `stem`, and contents.
    pub fn data_files(&self, stem: &str) -> Vec<(String, Vec<u8>)> {
        let mut text = String::from("ratio,alpha,stable_step\n");
        for ((i, j), step) in self.steps.indexed_iter() {
            text.push_str(&format!("{},{},{step}\n", self.ratios[i], self.alphas[j]));
        }
        vec![
            (format!("{stem}.csv"), text.into_bytes()),
            (format!("{stem}_stable_step.npy"), npy::encode(&self.steps)),
        ]
    }
}
