//! Axes: label, range and scale.

use super::{
    error::FigureError,
    ticks::{Tick, linear_ticks, log_ticks},
};

/// How values are laid out along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// Equal differences are equally long.
    Linear,
    /// Equal ratios are equally long; values that are not positive have no place.
    Log10,
}

impl Scale {
    /// The coordinate in which the axis is even; NaN for what has no place on it.
    pub(super) fn coordinate(self, value: f64) -> f64 {
        match self {
            Scale::Linear => value,
            Scale::Log10 if value > 0.0 => value.log10(),
            Scale::Log10 => f64::NAN,
        }
    }
}

/// One axis of a panel. Without a range it fits the data of the panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub(super) label: String,
    pub(super) range: Option<(f64, f64)>,
    pub(super) scale: Scale,
    pub(super) ticks: Option<Vec<Tick>>,
    pub(super) show_tick_labels: bool,
}

impl Axis {
    /// A linear axis; the label names quantity and unit.
    pub fn linear(label: impl Into<String>) -> Axis {
        Axis {
            label: label.into(),
            range: None,
            scale: Scale::Linear,
            ticks: None,
            show_tick_labels: true,
        }
    }

    /// A logarithmic axis (base ten).
    pub fn log(label: impl Into<String>) -> Axis {
        Axis { scale: Scale::Log10, ..Axis::linear(label) }
    }

    /// Sets the ends of the axis.
    pub fn range(mut self, low: f64, high: f64) -> Axis {
        self.range = Some((low, high));
        self
    }

    /// Sets the ends of the axis to the first and the last of ascending values.
    ///
    /// # Panics
    /// When there are no values.
    pub fn spanning(self, values: &[f64]) -> Axis {
        self.range(values[0], values[values.len() - 1])
    }

    /// Sets the ticks: value and label each, where round numbers are not what is wanted (as π/2).
    pub fn ticks(mut self, ticks: impl IntoIterator<Item = (f64, impl Into<String>)>) -> Axis {
        self.ticks =
            Some(ticks.into_iter().map(|(value, l)| Tick { value, label: l.into() }).collect());
        self
    }

    /// Leaves out the numbers at the ticks, for panels that share the axis of a neighbour.
    pub fn without_tick_labels(mut self) -> Axis {
        self.show_tick_labels = false;
        self
    }

    /// The range shown, from the data where none was given.
    pub(super) fn resolve(
        &self,
        data: impl Iterator<Item = f64>,
        pad: f64,
    ) -> Result<ResolvedAxis, FigureError> {
        let (low, high) = self.range.unwrap_or_else(|| self.fit(data, pad));
        let (a, b) = (self.scale.coordinate(low), self.scale.coordinate(high));
        if a < b && (b - a).is_finite() {
            Ok(ResolvedAxis { scale: self.scale, low, high, a, b })
        } else {
            Err(FigureError::AxisRange { label: self.label.clone(), low, high })
        }
    }

    fn fit(&self, data: impl Iterator<Item = f64>, pad: f64) -> (f64, f64) {
        let (mut a, mut b) = (f64::INFINITY, f64::NEG_INFINITY);
        for v in data.map(|v| self.scale.coordinate(v)).filter(|v| v.is_finite()) {
            a = a.min(v);
            b = b.max(v);
        }
        if a > b {
            (a, b) = (0.0, 1.0); // no data: any axis will do
        } else if b - a <= 1e-12 * a.abs().max(b.abs()).max(1e-300) {
            let half = if a == 0.0 || self.scale == Scale::Log10 { 0.5 } else { 0.1 * a.abs() };
            (a, b) = (a - half, b + half);
        } else {
            (a, b) = (a - pad * (b - a), b + pad * (b - a));
        }
        match self.scale {
            Scale::Linear => (a, b),
            Scale::Log10 => (10f64.powf(a), 10f64.powf(b)),
        }
    }

    /// The ticks for a range with room for at most `most` labels.
    pub(super) fn ticks_for(&self, range: &ResolvedAxis, most: usize) -> Vec<Tick> {
        let mut ticks = match (&self.ticks, self.scale) {
            (Some(ticks), _) => ticks
                .iter()
                .filter(|t| t.value >= range.low && t.value <= range.high)
                .cloned()
                .collect(),
            (None, Scale::Linear) => linear_ticks(range.low, range.high, most),
            (None, Scale::Log10) => log_ticks(range.low, range.high, most),
        };
        // Minor ticks and numbers left out differ in length of the tick: keep which is which.
        if !self.show_tick_labels {
            for tick in ticks.iter_mut().filter(|t| !t.label.is_empty()) {
                tick.label = " ".into();
            }
        }
        ticks
    }
}

/// An axis with a definite range.
#[derive(Debug, Clone, Copy)]
pub(super) struct ResolvedAxis {
    pub(super) scale: Scale,
    pub(super) low: f64,
    pub(super) high: f64,
    a: f64,
    b: f64,
}

impl ResolvedAxis {
    /// How far along the axis a value lies: 0 at the lower end, 1 at the upper one, NaN if it has no place.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        (self.scale.coordinate(value) - self.a) / (self.b - self.a)
    }

    /// How long it is in its own units.
    pub(super) fn length(&self) -> f64 {
        self.b - self.a
    }

    /// A linear axis made so many times longer, its middle where it was.
    pub(super) fn lengthened(self, times: f64) -> ResolvedAxis {
        let by = 0.5 * (times - 1.0) * self.length();
        let (low, high) = (self.low - by, self.high + by);
        ResolvedAxis { low, high, a: low, b: high, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_fit_the_data() {
        let fit = |axis: Axis, data: &[f64]| axis.resolve(data.iter().copied(), 0.0);
        let r = fit(Axis::log("x"), &[1e-3, 10.0, f64::NAN, -1.0]).unwrap();
        assert!((r.low / 1e-3 - 1.0).abs() < 1e-12 && (r.high / 10.0 - 1.0).abs() < 1e-12);
        assert!((r.fraction(0.1) - 0.5).abs() < 1e-12);
        assert!(r.fraction(-1.0).is_nan());
        for data in [&[][..], &[0.0], &[5.0], &[-3.0, f64::INFINITY]] {
            let r = fit(Axis::linear("x"), data).unwrap();
            assert!(r.low < r.high);
        }
    }

    #[test]
    fn a_longer_axis_keeps_its_middle() {
        let axis = Axis::linear("x").range(-1.0, 3.0).resolve([].into_iter(), 0.0).unwrap();
        let longer = axis.lengthened(2.0);
        assert_eq!((longer.low, longer.high, longer.length()), (-3.0, 5.0, 8.0));
        assert_eq!((axis.fraction(1.0), longer.fraction(1.0)), (0.5, 0.5));
    }

    #[test]
    fn impossible_ranges_are_errors() {
        for axis in [
            Axis::log("x").range(0.0, 1.0),
            Axis::linear("x").range(1.0, 1.0),
            Axis::linear("x").range(0.0, f64::INFINITY),
            Axis::linear("x").range(f64::NAN, 1.0),
        ] {
            assert!(matches!(
                axis.resolve([].into_iter(), 0.0),
                Err(FigureError::AxisRange { .. })
            ));
        }
    }
}
