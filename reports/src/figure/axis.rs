//! Axes: label, range, scale and ticks, as plotters takes them.

use super::FigureError;
use crate::number::{format_number, format_numbers, power_of_ten};
use plotters::coord::ranged1d::{
    BoldPoints, KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter,
};
use plotters::coord::types::RangedCoordf64;
use std::ops::Range;

/// One axis of a panel. Without a range it fits the data of the panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub(super) label: String,
    range: Option<(f64, f64)>,
    log: bool,
    pub(super) ticks: Option<Vec<(f64, String)>>,
}

impl Axis {
    /// A linear axis; the label names quantity and unit.
    pub fn linear(label: impl Into<String>) -> Axis {
        Axis { label: label.into(), range: None, log: false, ticks: None }
    }

    /// A logarithmic axis (base ten); values that are not positive have no place on it.
    pub fn log(label: impl Into<String>) -> Axis {
        Axis { log: true, ..Axis::linear(label) }
    }

    /// Sets the ends of the axis.
    pub fn range(self, low: f64, high: f64) -> Axis {
        Axis { range: Some((low, high)), ..self }
    }

    /// Sets the ends of the axis to the first and the last of ascending values.
    ///
    /// # Panics
    /// When there are no values.
    pub fn spanning(self, values: &[f64]) -> Axis {
        self.range(values[0], values[values.len() - 1])
    }

    /// Sets the ticks: value and label each, where round numbers are not what is wanted (as π/2).
    pub fn ticks(self, ticks: impl IntoIterator<Item = (f64, impl Into<String>)>) -> Axis {
        let ticks = ticks.into_iter().map(|(value, label)| (value, label.into())).collect();
        Axis { ticks: Some(ticks), ..self }
    }

    /// The coordinate in which the axis is even; not finite for what has no place on it.
    fn coordinate(&self, value: f64) -> f64 {
        if self.log { value.log10() } else { value }
    }

    /// The axis with a definite range, from the data where none was given.
    pub(super) fn resolve(
        &self,
        data: impl Iterator<Item = f64>,
        pad: f64,
    ) -> Result<Axis, FigureError> {
        let (low, high) = self.range.unwrap_or_else(|| self.fit(data, pad));
        let length = self.coordinate(high) - self.coordinate(low);
        match length > 0.0 && length.is_finite() {
            true => Ok(self.clone().range(low, high)),
            false => Err(FigureError::AxisRange(self.label.clone(), low, high)),
        }
    }

    fn fit(&self, data: impl Iterator<Item = f64>, pad: f64) -> (f64, f64) {
        let finite = data.map(|v| self.coordinate(v)).filter(|v| v.is_finite());
        let ends = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |e, v| (e.0.min(v), e.1.max(v)));
        let (a, b) = match ends {
            (a, b) if a > b => (0.0, 1.0), // no data: any axis will do
            (a, b) if b - a <= 1e-12 * a.abs().max(b.abs()).max(1e-300) => {
                let half = if a == 0.0 || self.log { 0.5 } else { 0.1 * a.abs() };
                (a - half, b + half)
            }
            (a, b) => (a - pad * (b - a), b + pad * (b - a)),
        };
        if self.log { (10f64.powf(a), 10f64.powf(b)) } else { (a, b) }
    }

    /// The ends in the coordinate in which the axis is even.
    pub(super) fn ends(&self) -> (f64, f64) {
        let (low, high) = self.range.unwrap_or((0.0, 1.0));
        (self.coordinate(low), self.coordinate(high))
    }

    /// How far along the axis a value lies: 0 at the lower end, 1 at the upper one.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        let (a, b) = self.ends();
        (self.coordinate(value) - a) / (b - a)
    }

    pub(super) fn labels(&self) -> impl Iterator<Item = &str> {
        self.ticks.iter().flatten().map(|tick| tick.1.as_str())
    }

    fn shows(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.fraction(value))
    }

    /// The axis with its own ticks, or with at most `most` round ones.
    pub(super) fn with_ticks(mut self, most: usize) -> Axis {
        let ticks = match self.ticks.take() {
            Some(ticks) => ticks.into_iter().filter(|tick| self.shows(tick.0)).collect(),
            None if self.log => self.log_ticks(most).unwrap_or_else(|| self.linear_ticks(most)),
            None => self.linear_ticks(most),
        };
        self.ticks(ticks)
    }

    fn linear_ticks(&self, most: usize) -> Vec<(f64, String)> {
        let values = RangedCoordf64::from(self.range()).key_points(BoldPoints(most));
        let labels = format_numbers(&values);
        values.into_iter().zip(labels).collect()
    }

    /// The shown values of these digits times powers of ten.
    fn decimals(&self, digits: &[i32]) -> Vec<f64> {
        let powers = self.ends().0.floor() as i32..=self.ends().1.ceil() as i32;
        let value = |p: i32, d: i32| format!("{d}e{p}").parse::<f64>().expect("a number");
        let all = powers.flat_map(|p| digits.iter().map(move |&d| value(p, d)));
        all.filter(|&v| self.shows(v)).collect()
    }

    /// Powers of ten; on short ranges digits between, unless they leave an end bare.
    fn log_ticks(&self, most: usize) -> Option<Vec<(f64, String)>> {
        let decades = self.decimals(&[1]);
        if decades.len() >= 3 {
            let stride = decades.len().div_ceil(most) as i32;
            let powers = decades.into_iter().map(|v| (v, v.log10().round() as i32));
            let shown = powers.filter(|(_, p)| p.rem_euclid(stride) == 0);
            return Some(shown.map(|(v, p)| (v, power_of_ten(&p.to_string()))).collect());
        }
        let digits: [&[i32]; 4] =
            [&[1, 2, 3, 4, 5, 6, 7, 8, 9], &[1, 2, 3, 5], &[1, 2, 5], &[1, 3]];
        let reaches = |v: &Vec<f64>| {
            (2..=most).contains(&v.len())
                && self.fraction(v[0]) <= 0.3
                && self.fraction(v[v.len() - 1]) >= 0.7
        };
        let values = digits.into_iter().map(|digits| self.decimals(digits)).find(reaches)?;
        Some(values.into_iter().map(|v| (v, format_number(v))).collect())
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        from + (self.fraction(*value) * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match hint.weight().allow_light_points() {
            false => self.ticks.iter().flatten().map(|tick| tick.0).collect(),
            true if self.log => self.decimals(&[2, 3, 4, 5, 6, 7, 8, 9]),
            true => Vec::new(),
        }
    }

    fn range(&self) -> Range<f64> {
        self.range.map_or(0.0..1.0, |(low, high)| low..high)
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.iter().flatten().find(|tick| tick.0 == *value);
        tick.map_or_else(String::new, |tick| tick.1.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn resolved(axis: Axis, data: &[f64]) -> Result<Axis, FigureError> {
        axis.resolve(data.iter().copied(), 0.0)
    }

    #[test]
    fn ranges_fit_the_data_and_impossible_ones_are_errors() {
        let log = resolved(Axis::log("x"), &[1e-3, 10.0, f64::NAN, -1.0]).unwrap();
        assert!((log.ends().0 + 3.0).abs() < 1e-12 && (log.ends().1 - 1.0).abs() < 1e-12);
        assert!((log.fraction(0.1) - 0.5).abs() < 1e-12 && log.fraction(-1.0).is_nan());
        for data in [&[][..], &[0.0], &[5.0], &[-3.0, f64::INFINITY]] {
            let (low, high) = resolved(Axis::linear("x"), data).unwrap().ends();
            assert!(low < high);
        }
        for (low, high) in [(0.0, 1.0), (1.0, 1.0), (1.0, f64::INFINITY), (f64::NAN, 1.0)] {
            let axis = resolved(Axis::log("x").range(low, high), &[]);
            assert!(matches!(axis, Err(FigureError::AxisRange(..))));
        }
    }

    #[test]
    fn labels_are_round() {
        let labels = |axis: Axis, most: usize| -> Vec<String> {
            axis.with_ticks(most).ticks.unwrap().into_iter().map(|tick| tick.1).collect()
        };
        let linear = |low, high, most| labels(Axis::linear("").range(low, high), most);
        let log = |low, high, most| labels(Axis::log("").range(low, high), most);
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
                let axis = axis.range(a, b).with_ticks(most);
                let ticks = axis.ticks.clone().unwrap();
                prop_assert!((1..=most).contains(&ticks.len()), "{ticks:?}");
                prop_assert!(ticks.windows(2).all(|w| w[0].1 != w[1].1), "{ticks:?}");
                prop_assert!(ticks.iter().all(|t| axis.shows(t.0)), "{ticks:?}");
            }
        }
    }
}
