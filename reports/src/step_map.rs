//! The map of the largest stable time step of a particle method over the (h, α) plane.

use crate::figure::{Axis, Bands, ColorBar, ColorMap, Contours, Figure, FigureError, Panel};
use crate::level_set::Field;
use crate::npy;
use courant_analysis::exact::rational::{Rational, to_f64};
use courant_analysis::scheme::{Integrator, LatticeMethod};
use courant_analysis::waves::dispersion::sweep::stable_step_map;
use courant_analysis::waves::sweep::{Progress, SweepError};
use ndarray::Array2;

/// Time steps `c Δt/h` are looked at up to this one: no integrator here comes near it from `h = Δ/2` on.
pub const MAX_STEP: f64 = 8.0;

/// Bands are a tenth wide up to this many: RK4 with the cubic spline reaches 1.75 for `1 ≤ h/Δ ≤ 2`.
const HIGHEST_TENTHS: u32 = 18;

/// The largest stable `c Δt/h` over `(h, α)` for one integrator; arrays are `[h, α]`.
#[derive(Debug, Clone, PartialEq)]
pub struct StepMap {
    /// The integrator.
    pub integrator: &'static Integrator,
    /// `h/Δ`, ascending.
    pub ratios: Vec<f64>,
    /// α, ascending.
    pub alphas: Vec<f64>,
    /// The largest step no sampled wave finds unstable.
    pub steps: Array2<f64>,
}

/// Computes the map; `method` is SPH with α = 1. Looked at on a grid of phases, not proved.
///
/// # Errors
/// When a ratio is out of range or the callback stops the sweep.
pub fn step_map(
    method: &LatticeMethod,
    integrator: &'static Integrator,
    ratios: &[Rational],
    alphas: &[f64],
    progress: Progress<'_>,
) -> Result<StepMap, SweepError> {
    let steps = stable_step_map(method, integrator, ratios, alphas, MAX_STEP, progress)?;
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
        let levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6];
        let x = Axis::linear("smoothing ratio h/Δ").spanning(&self.ratios);
        let y = Axis::linear("viscosity α").spanning(&self.alphas);
        let contours = Contours::new(field).bands(Self::bands()).isolines(levels);
        Ok(Panel::new(x, y).title(title).contours(contours))
    }

    /// The bands of the colour bar.
    pub fn bands() -> Bands {
        let edges = (0..=HIGHEST_TENTHS).map(|tenths| f64::from(tenths) / 10.0).collect();
        let color = |t| ColorMap::Viridis.at(t);
        Bands::new(edges, color).extend_above(color(1.0))
    }

    /// The colour bar of all these maps: with a pointed end only when one of them needs it.
    pub fn color_bar(maps: &[Self]) -> ColorBar {
        let steps = maps.iter().flat_map(|map| map.steps.iter().copied());
        ColorBar::new(Self::bands().needed_for(steps), "largest stable c Δt/h")
    }

    /// The figure with one panel.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn figure(&self, title: &str) -> Result<Figure, FigureError> {
        let bar = Self::color_bar(std::slice::from_ref(self));
        Ok(Figure::single(self.panel(title)?).size(5.2, 4.0).color_bar(bar))
    }

    /// Every data file of the map: names that begin with `stem`, and contents.
    pub fn data_files(&self, stem: &str) -> Vec<(String, Vec<u8>)> {
        let mut text = String::from("ratio,alpha,stable_step\n");
        for ((i, j), step) in self.steps.indexed_iter() {
            text.push_str(&format!("{},{},{step}\n", self.ratios[i], self.alphas[j]));
        }
        let array = (format!("{stem}_stable_step.npy"), npy::encode(&self.steps));
        let axes = npy::axes(stem, &self.ratios, &self.alphas);
        [(format!("{stem}.csv"), text.into_bytes()), array].into_iter().chain(axes).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::integer;
    use courant_analysis::kernel::Kernel;
    use courant_analysis::scheme::catalogue;
    use courant_analysis::waves::sweep::no_progress;

    #[test]
    fn steps_are_limits() {
        let viscous = catalogue::method("sph-av").unwrap();
        let viscous = LatticeMethod::new(viscous, Kernel::CubicSpline, &integer(1)).unwrap();
        let leapfrog = Integrator::named("leapfrog-kdk").unwrap();
        let ratios = [integer(1), integer(2)];
        let map = step_map(&viscous, leapfrog, &ratios, &[0.0, 2.0], &no_progress).unwrap();
        // At h = Δ without viscosity ω0² ≤ 8 c²/Δ²; at h = 2Δ with α = 2 the limit 3/4 is proved.
        assert!((map.steps[[0, 0]] - 0.5f64.sqrt()).abs() < 1e-9);
        assert!((map.steps[[1, 1]] - 0.75).abs() < 1e-6);
    }
}
