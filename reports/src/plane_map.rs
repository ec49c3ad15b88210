//! Maps of the amplification of any scheme over the plane of two of its parameters.

use crate::figure::{
    Axis, Color, ColorBar, Field, Figure, FigureError, FilledContours, Line, Marker, Markers,
    Panel, Side,
};
use crate::npy;
use crate::stability_map::{COLOR_BAR_LABEL, bands};
use courant_analysis::exact::rational::{Rational, to_f64, to_text};
use courant_analysis::scheme::{SchemeError, Step};
use courant_analysis::stability::{SearchPlan, StableSet};
use ndarray::Array2;
use num_traits::Signed;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Phases looked at for the colours; the boundary is proved and not read off them.
const PHASES: usize = 256;

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
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<PlaneMap, SchemeError> {
    let compiled = step.compile()?;
    let ys: Vec<f64> = y.values.iter().map(to_f64).collect();
    let highest = y.values.iter().max().filter(|value| value.is_positive());
    let plan = plan.clone().up_to(highest.cloned().unwrap_or_else(|| plan.max.clone()));
    let done = AtomicUsize::new(0);
    let columns: Vec<_> = x
        .values
        .par_iter()
        .map(|value| {
            let stable = step.with(&x.name, value)?.stable_set(&y.name, &plan)?;
            let gains: Vec<[f64; 2]> = ys
                .iter()
                .map(|&second| {
                    let values: Vec<f64> = compiled
                        .parameters()
                        .iter()
                        .map(|name| if *name == x.name { to_f64(value) } else { second })
                        .collect();
                    (0..=PHASES).fold([0.0, f64::INFINITY], |[most, least]: [f64; 2], index| {
                        let phase = PI * index as f64 / PHASES as f64;
                        let multipliers = compiled.multipliers(&values, &[phase]);
                        let gain = multipliers.iter().map(|z| z.norm()).fold(0.0, f64::max);
                        [most.max(gain), least.min(gain)]
                    })
                })
                .collect();
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, x.values.len());
            Ok((stable, gains))
        })
        .collect::<Result<_, SchemeError>>()?;
    let shape = (x.values.len(), y.values.len());
    let which = |part: usize| Array2::from_shape_fn(shape, |(i, j)| columns[i].1[j][part]);
    let (largest, lowest) = (which(0), which(1));
    Ok(PlaneMap {
        x,
        y,
        largest,
        lowest,
        stable: columns.into_iter().map(|(set, _)| set).collect(),
    })
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
        Ok(Figure::single(panel)
            .size(5.2, 4.3)
            .legend_below()
            .color_bar(ColorBar::new(bands()?, COLOR_BAR_LABEL), Side::Right))
    }

    /// Every data file of the map: names that begin with `stem`, and contents.
    pub fn data_files(&self, stem: &str) -> Vec<(String, Vec<u8>)> {
        let (x, y) = (&self.x, &self.y);
        let mut points = format!("{},{},max_gain,min_gain\n", x.name, y.name);
        for (i, first) in x.values.iter().enumerate() {
            for (j, second) in y.values.iter().enumerate() {
                let (most, least) = (self.largest[[i, j]], self.lowest[[i, j]]);
                points.push_str(&format!("{},{},{most},{least}\n", to_f64(first), to_f64(second)));
            }
        }
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
        let map = plane_map(&step, axis("r", 6), axis("C", 12), &SearchPlan::default(), &|_, _| {})
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
