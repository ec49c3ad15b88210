//! Axes: label, range, scale and ticks, as plotters takes them.

use super::{
    error::FigureError,
    number::{format_numbers, power_of_ten},
};
use plotters::coord::{
    ranged1d::{BoldPoints, KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter},
    types::RangedCoordf64,
};
use std::ops::Range;

/// How values are laid out along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    /// Equal differences are equally long.
    Linear,
    /// Equal ratios are equally long; values that are not positive have no place.
    Log10,
}

impl Scale {
    /// The coordinate in which the axis is even; NaN for what has no place on it.
    fn coordinate(self, value: f64) -> f64 {
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
    range: Option<(f64, f64)>,
    scale: Scale,
    ticks: Option<Vec<(f64, String)>>,
}

impl Axis {
    /// A linear axis; the label names quantity and unit.
    pub fn linear(label: impl Into<String>) -> Axis {
        Axis { label: label.into(), range: None, scale: Scale::Linear, ticks: None }
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
        self.ticks = Some(ticks.into_iter().map(|(value, label)| (value, label.into())).collect());
        self
    }

    /// The axis with a definite range, from the data where none was given.
    pub(super) fn resolve(
        &self,
        data: impl Iterator<Item = f64>,
        pad: f64,
    ) -> Result<AxisRange, FigureError> {
        let (low, high) = self.range.unwrap_or_else(|| self.fit(data, pad));
        let (a, b) = (self.scale.coordinate(low), self.scale.coordinate(high));
        if a < b && (b - a).is_finite() {
            Ok(AxisRange {
                axis: self.clone(),
                low,
                high,
                ends: [a, b],
                ticks: vec![],
                minor: vec![],
            })
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
}

/// An axis with a definite range and its ticks.
#[derive(Debug, Clone)]
pub(super) struct AxisRange {
    pub(super) axis: Axis,
    low: f64,
    high: f64,
    ends: [f64; 2],
    pub(super) ticks: Vec<(f64, String)>,
    /// Ticks without numbers.
    pub(super) minor: Vec<f64>,
}

impl AxisRange {
    /// How far along the axis a value lies: 0 at the lower end, 1 at the upper one, NaN if it has no place.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        let [a, b] = self.ends;
        (self.axis.scale.coordinate(value) - a) / (b - a)
    }

    /// How long it is in its own units.
    pub(super) fn length(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// A linear axis made so many times longer, its middle where it was.
    pub(super) fn lengthened(self, times: f64) -> AxisRange {
        let by = 0.5 * (times - 1.0) * self.length();
        let (low, high) = (self.low - by, self.high + by);
        AxisRange { low, high, ends: [low, high], ..self }
    }

    /// The axis with at most `most` labelled ticks.
    pub(super) fn with_ticks(mut self, most: usize) -> AxisRange {
        self.minor.clear();
        self.ticks = match (&self.axis.ticks, self.axis.scale) {
            (Some(ticks), _) => {
                let inside = |t: &&(f64, String)| (self.low..=self.high).contains(&t.0);
                ticks.iter().filter(inside).cloned().collect()
            }
            (None, Scale::Linear) => self.linear_ticks(most),
            (None, Scale::Log10) => self.log_ticks(most),
        };
        self
    }

    fn linear_ticks(&mut self, most: usize) -> Vec<(f64, String)> {
        let values = RangedCoordf64::from(self.low..self.high).key_points(BoldPoints(most));
        if let [first, second, ..] = values[..] {
            // Steps of two are parted in four, others in five.
            let step = second - first;
            let digit = step / 10f64.powf(step.log10().floor());
            let parts = if (1.5..2.2).contains(&digit) { 4 } else { 5 };
            let between = (-parts..parts * (values.len() as i32 + 1)).filter(|j| j % parts != 0);
            let minor = between.map(|j| first + step * f64::from(j) / f64::from(parts));
            self.minor = minor.filter(|v| (0.0..=1.0).contains(&self.fraction(*v))).collect();
        }
        let labels = format_numbers(&values);
        values.into_iter().zip(labels).collect()
    }

    /// Powers of ten; on short ranges numbers between, and where those leave an end bare the ticks of a linear axis.
    fn log_ticks(&mut self, most: usize) -> Vec<(f64, String)> {
        let powers = self.ends[0].floor() as i32..=self.ends[1].ceil() as i32;
        let value = |d: i32, p: i32| format!("{d}e{p}").parse::<f64>().expect("a number");
        let inside = |v: f64| (-1e-9..=1.0 + 1e-9).contains(&self.fraction(v));
        let decades: Vec<i32> = powers.clone().filter(|&p| inside(value(1, p))).collect();
        let among = |digits: &[i32]| -> Vec<f64> {
            let all = powers.clone().flat_map(|p| digits.iter().map(move |&d| value(d, p)));
            all.filter(|&v| inside(v)).collect()
        };
        if decades.len() >= 3 || decades.len() > most / 2 {
            let stride = decades.len().div_ceil(most).max(1);
            let labelled = decades.iter().filter(|p| p.rem_euclid(stride as i32) == 0);
            let ticks = labelled.map(|&p| (value(1, p), power_of_ten(&p.to_string()))).collect();
            self.minor = if stride > 1 { among(&[1]) } else { among(&[2, 3, 4, 5, 6, 7, 8, 9]) };
            return ticks;
        }
        let subsets: [&[i32]; 4] =
            [&[1, 2, 3, 4, 5, 6, 7, 8, 9], &[1, 2, 3, 5], &[1, 2, 5], &[1, 3]];
        let shown = subsets.into_iter().map(among).find(|values| {
            // An end of the axis without a number near leaves the reader to guess what stands there.
            let ends =
                [values.first(), values.last()].map(|v| v.map_or(0.5, |&v| self.fraction(v)));
            (2..=most).contains(&values.len()) && ends[0] <= 0.3 && ends[1] >= 0.7
        });
        match shown {
            Some(values) => {
                self.minor = among(&[1, 2, 3, 4, 5, 6, 7, 8, 9]);
                self.minor.retain(|v| !values.contains(v));
                let label = |v: f64| super::number::format_number(v);
                values.into_iter().map(|v| (v, label(v))).collect()
            }
            None => self.linear_ticks(most),
        }
    }
}

impl Ranged for AxisRange {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        from + (self.fraction(*value) * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match (hint.weight().allow_light_points(), self.axis.scale) {
            (false, _) => self.ticks.iter().map(|tick| tick.0).collect(),
            (true, Scale::Log10) => self.minor.clone(),
            (true, Scale::Linear) => Vec::new(),
        }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for AxisRange {
    fn format_ext(&self, value: &f64) -> String {
        self.ticks.iter().find(|tick| tick.0 == *value).map_or(String::new(), |tick| tick.1.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(axis: Axis, most: usize) -> Vec<String> {
        let range = axis.resolve([].into_iter(), 0.0).unwrap().with_ticks(most);
        range.ticks.into_iter().map(|tick| tick.1).collect()
    }

    #[test]
    fn ranges_fit_the_data() {
        let fit = |axis: Axis, data: &[f64]| axis.resolve(data.iter().copied(), 0.0);
        let r = fit(Axis::log("x"), &[1e-3, 10.0, f64::NAN, -1.0]).unwrap();
        assert!((r.low / 1e-3 - 1.0).abs() < 1e-12 && (r.high / 10.0 - 1.0).abs() < 1e-12);
        assert!((r.fraction(0.1) - 0.5).abs() < 1e-12 && r.fraction(-1.0).is_nan());
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
        assert_eq!((longer.fraction(1.0), longer.fraction(-3.0)), (0.5, 0.0));
    }

    #[test]
    fn impossible_ranges_are_errors() {
        for (axis, low, high) in [
            (Axis::log("x"), 0.0, 1.0),
            (Axis::linear("x"), 1.0, 1.0),
            (Axis::linear("x"), 0.0, f64::INFINITY),
            (Axis::linear("x"), f64::NAN, 1.0),
        ] {
            let range = axis.range(low, high).resolve([].into_iter(), 0.0);
            assert!(matches!(range, Err(FigureError::AxisRange { .. })));
        }
    }

    #[test]
    fn labels_are_round() {
        let linear = |low, high, most| labels(Axis::linear("").range(low, high), most);
        let log = |low, high, most| labels(Axis::log("").range(low, high), most);
        assert_eq!(linear(0.0, 1.0, 6), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(linear(-1.0, 1.0, 5), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(linear(0.0, 3e-5, 4), ["0", "10⁻⁵", "2×10⁻⁵", "3×10⁻⁵"]);
        assert_eq!(log(1e-3, 1.0, 6), ["10⁻³", "10⁻²", "10⁻¹", "10⁰"]);
        assert_eq!(log(1e-12, 1.0, 5), ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]);
        assert_eq!(log(0.1, 1.0, 6), ["0.1", "0.2", "0.3", "0.5", "1"]);
        // 0.5 to 1 alone would leave the upper third bare.
        assert_eq!(log(0.48, 1.55, 7), ["0.6", "0.8", "1.0", "1.2", "1.4"]);
    }

    proptest! {
        #[test]
        fn ticks_are_few_distinct_and_inside(low in -12f64..8.0, span in 0.05f64..14.0, most in 3usize..9) {
            let (a, b) = (10f64.powf(low), 10f64.powf(low + span));
            for axis in [Axis::log(""), Axis::linear("")] {
                let range = axis.range(a, b).resolve([].into_iter(), 0.0).unwrap().with_ticks(most);
                prop_assert!((1..=most).contains(&range.ticks.len()), "{:?}", range.ticks);
                prop_assert!(range.ticks.windows(2).all(|w| w[0].1 != w[1].1), "{:?}", range.ticks);
                prop_assert!(range.ticks.iter().all(|t| (-1e-6..=1.0 + 1e-6).contains(&range.fraction(t.0))));
            }
        }
    }
}
