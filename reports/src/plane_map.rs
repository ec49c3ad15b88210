//! Maps of the amplification of any scheme over the plane of two of its parameters.

use crate::figure::{
    Axis, Color, Field, Figure, FigureError, FilledContours, Line, Marker, Markers, Panel, Side,
};
use crate::npy;
use crate::stability_map::{bands, color_bar};
use courant_analysis::exact::rational::{Rational, to_f64, to_text};
use courant_analysis::scheme::Step;
use courant_analysis::stability::{SearchPlan, StableSet};
use courant_analysis::waves::sweep::{GainMap, Progress, SweepError, with_progress};
use ndarray::Array2;
use num_traits::Signed;
use rayon::prelude::*;
use std::fmt::Write;

/// Growth that counts as round-off in the colours.
const ROUND_OFF: f64 = 1e-9;

/// A parameter and its values, ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneAxis {
    /// The parameter.
    pub name: String,
    /// The values.
    pub values: Vec<Rational>,
}

/// The gains on a plane of two parameters, and which values of the second are stable for each of the first.
#[derive(Debug, Clone)]
pub struct PlaneMap {
    /// The parameter to the right.
    pub x: PlaneAxis,
    /// The parameter upwards, along which stability is decided.
    pub y: PlaneAxis,
    /// The largest `|z|` over waves and branches; `[x, y]`.
    pub largest: Array2<f64>,
    /// The smallest over waves of the largest `|z|` over branches.
    pub lowest: Array2<f64>,
    /// The stable values of the second parameter for each value of the first: proved.
    pub stable: Vec<StableSet>,
}

/// Computes a map; all other parameters of the step have their values. `progress` is told how many columns are done.
///
/// # Errors
/// When a parameter does not occur or another has no value.
pub fn plane_map(
    step: &Step,
    x: PlaneAxis,
    y: PlaneAxis,
    plan: &SearchPlan,
    progress: Progress<'_>,
) -> Result<PlaneMap, SweepError> {
    let ys: Vec<f64> = y.values.iter().map(to_f64).collect();
    let highest = y.values.iter().max().filter(|value| value.is_positive());
    let plan = plan.clone().up_to(highest.cloned().unwrap_or_else(|| plan.max.clone()));
    let rows = with_progress(x.values.par_iter(), progress, |value| {
        let step = step.with(&x.name, value)?;
        Ok((step.gain_extremes(&y.name, &ys)?, step.stable_set(&y.name, &plan)?))
    })?;
    let (gains, stable): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
    let gains = GainMap::from_rows(&gains, ys.len());
    Ok(PlaneMap { x, y, largest: 1.0 + gains.growth, lowest: gains.lowest_gain, stable })
}

impl PlaneMap {
    /// `max |z|` where a wave grows, and what is left of the most damped wave where none does.
    fn extreme(&self) -> Array2<f64> {
        let mut values = self.largest.clone();
        values.zip_mut_with(&self.lowest, |most, least| {
            if *most <= 1.0 + ROUND_OFF {
                *most = *least;
            }
        });
        values
    }

    /// The figure: colours and the proved boundary.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn figure(&self, title: &str) -> Result<Figure, FigureError> {
        let floats = |axis: &PlaneAxis| axis.values.iter().map(to_f64).collect::<Vec<f64>>();
        let (xs, ys) = (floats(&self.x), floats(&self.y));
        let field = Field::new(xs.clone(), ys.clone(), self.extreme())?;
        let mut panel = Panel::new(
            Axis::linear(self.x.name.as_str()).spanning(&xs),
            Axis::linear(self.y.name.as_str()).spanning(&ys),
        )
        .title(title)
        .layer(FilledContours::new(field, bands()?));
        let limits: Vec<(f64, f64)> =
            xs.iter().zip(&self.stable).map(|(&x, set)| (x, set.limit().value())).collect();
        let mut labelled = false;
        for stretch in limits.chunk_by(|a, b| drawn(a.1) == drawn(b.1)) {
            if drawn(stretch[0].1) && stretch.len() > 1 {
                let mut line = Line::new(stretch.iter().copied()).color(Color::BLACK).width(1.8);
                if !labelled {
                    line = line.label("stability limit");
                    labelled = true;
                }
                panel = panel.layer(line);
            }
        }
        // Other ends: of windows that do not begin at 0.
        let others = xs.iter().zip(&self.stable).flat_map(|(&x, set)| {
            let windows = set.intervals.iter().filter(|interval| interval.from.upper() > 0.0);
            let ends = windows.flat_map(|window| [window.from.value(), window.to.value()]);
            ends.filter(|end| drawn(*end)).map(move |end| (x, end)).collect::<Vec<_>>()
        });
        let others: Vec<(f64, f64)> = others.collect();
        if !others.is_empty() {
            let markers = Markers::new(others, Marker::Square).color(Color::BLACK).size(1.8);
            panel = panel.layer(markers.label("ends of stable windows"));
        }
        Ok(Figure::single(panel).size(5.2, 4.3).legend_below().color_bar(color_bar()?, Side::Right))
    }

    /// Every data file of the map: names that begin with `stem`, and contents.
    pub fn data_files(&self, stem: &str) -> Vec<(String, Vec<u8>)> {
        let (x, y) = (&self.x, &self.y);
        let text_of = |value: &Rational| to_f64(value).to_string();
        let seconds: Vec<String> = y.values.iter().map(text_of).collect();
        let row = |(i, first): (usize, &Rational)| {
            let (first, mut text) = (text_of(first), String::new());
            for (j, second) in seconds.iter().enumerate() {
                let (most, least) = (self.largest[[i, j]], self.lowest[[i, j]]);
                writeln!(text, "{first},{second},{most},{least}")
                    .expect("a string takes what is written");
            }
            text
        };
        let rows: Vec<String> = x.values.par_iter().enumerate().map(row).collect();
        let points = format!("{},{},max_gain,min_gain\n", x.name, y.name) + &rows.concat();
        let mut limits = format!("{},{}_exact,from,to,evidence\n", x.name, x.name);
        for (value, set) in x.values.iter().zip(&self.stable) {
            let row = |from: f64, to: f64| {
                let to = if to.is_finite() { to.to_string() } else { String::new() };
                let evidence = set.limit().evidence().name();
                format!("{},{},{from},{to},{evidence}\n", to_f64(value), to_text(value))
            };
            if set.intervals.is_empty() {
                limits.push_str(&row(0.0, 0.0));
            }
            for interval in &set.intervals {
                limits.push_str(&row(interval.from.upper(), interval.to.value()));
            }
        }
        let axis = |axis: &PlaneAxis| {
            npy::encode(&Array2::from_shape_fn((1, axis.values.len()), |(_, i)| {
                to_f64(&axis.values[i])
            }))
        };
        vec![
            (format!("{stem}.csv"), points.into_bytes()),
            (format!("{stem}_limits.csv"), limits.into_bytes()),
            (format!("{stem}_max_gain.npy"), npy::encode(&self.largest)),
            (format!("{stem}_min_gain.npy"), npy::encode(&self.lowest)),
            (format!("{stem}_x.npy"), axis(x)),
            (format!("{stem}_y.npy"), axis(y)),
        ]
    }
}

fn drawn(limit: f64) -> bool {
    limit.is_finite() && limit > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::ratio;
    use courant_analysis::waves::sweep::no_progress;

    #[test]
    fn colours_and_boundary_agree() {
        // Stable for C² ≤ 2 r ≤ 1.
        let text =
            "u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
        let step = Step::from_text(text).unwrap();
        let axis = |name: &str, last: i64| PlaneAxis {
            name: name.into(),
            values: (1..=last).map(|value| ratio(value, 10)).collect(),
        };
        let map =
            plane_map(&step, axis("r", 6), axis("C", 12), &SearchPlan::default(), &no_progress)
                .unwrap();
        for (i, r) in map.x.values.iter().enumerate() {
            for (j, c) in map.y.values.iter().enumerate() {
                let stable = c * c <= r * ratio(2, 1) && *r <= ratio(1, 2);
                assert_eq!(map.stable[i].contains(c), stable, "r = {r}, C = {c}");
                assert_eq!(map.largest[[i, j]] <= 1.0 + 1e-12, stable, "r = {r}, C = {c}");
            }
        }
        assert!(map.figure("").unwrap().svg().unwrap().contains("stability limit"));
    }
}
