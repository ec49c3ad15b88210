//! Maps of the amplification of any scheme over the plane of two of its parameters.

use crate::figure::{Axis, Contours, Figure, FigureError, Panel};
use crate::level_set::Field;
use crate::npy;
use crate::stability_map::{damped_side, damping_bar, growing_side, growth_bar};
use courant_analysis::exact::rational::{Rational, to_f64, to_text};
use courant_analysis::scheme::Step;
use courant_analysis::stability::{Limit, SearchPlan, StableSet};
use courant_analysis::waves::sweep::{GainMap, Progress, SweepError, with_progress};
use ndarray::Array2;
use num_traits::Signed;
use rayon::prelude::*;
use std::fmt::Write;

/// Boxes that a decision along the first parameter may look at: it adds lines to the picture, and where it takes many, as for directions in which
/// nothing is damped, it seldom ends at all.
const BOXES_ACROSS: usize = 2000;

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
    /// The ends of the stable intervals of the first parameter for each value of the second, proved; none where it does not occur any more or they
    /// cost too much.
    pub ends_across: Vec<Vec<f64>>,
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
    let mut gains = GainMap::new(x.values.len(), ys.len());
    let items = x.values.par_iter().zip(gains.rows_mut());
    let stable = with_progress(items, progress, |(value, mut row)| {
        let step = step.with(&x.name, value)?;
        row.set(&step.gain_extremes(&y.name, &ys)?);
        Ok(step.stable_set(&y.name, &plan)?)
    })?;
    let widest = x.values.iter().max().filter(|value| value.is_positive());
    let across = widest.map_or_else(|| plan.clone(), |widest| plan.clone().up_to(widest.clone()));
    let across = SearchPlan { budget: across.budget.min(BOXES_ACROSS), ..across };
    let row = |value: &Rational| {
        let set = step.with(&y.name, value).and_then(|row| row.stable_set(&x.name, &across));
        set.map_or_else(|_| Vec::new(), |set| ends(&set))
    };
    let ends_across = y.values.par_iter().map(row).collect();
    let (largest, lowest) = (1.0 + gains.growth, gains.lowest_gain);
    Ok(PlaneMap { x, y, largest, lowest, stable, ends_across })
}

impl PlaneMap {
    /// How far each place is from the nearest proved end of stability, in cells; above 0 where it is stable. Linear in
    /// between, it is 0 on the ends themselves.
    fn depth(&self) -> Array2<f64> {
        let (xs, ys) = (floats(&self.x), floats(&self.y));
        let cells =
            |values: &[f64]| (values[values.len() - 1] - values[0]) / (values.len() - 1) as f64;
        let along_y: Vec<Vec<f64>> = self.stable.iter().map(ends).collect();
        Array2::from_shape_fn((xs.len(), ys.len()), |(i, j)| {
            let up = along_y[i].iter().map(|end| (end - ys[j]).abs() / cells(&ys));
            let across = self.ends_across[j].iter().map(|end| (end - xs[i]).abs() / cells(&xs));
            let depth = up.chain(across).fold(1.0, f64::min);
            if self.stable[i].contains(&self.y.values[j]) { depth } else { -depth }
        })
    }

    /// The figure: each side of the proved boundary in colours of its own.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn figure(&self, title: &str) -> Result<Figure, FigureError> {
        let (xs, ys) = (floats(&self.x), floats(&self.y));
        let (axes, depth) = ((xs.as_slice(), ys.as_slice()), self.depth());
        let limit = Field::new(xs.clone(), ys.clone(), depth.clone())?;
        let limit = Contours::new(limit).isolines([0.0]).width(1.8);
        let panel = Panel::new(
            Axis::linear(self.x.name.as_str()).spanning(&xs),
            Axis::linear(self.y.name.as_str()).spanning(&ys),
        )
        .contours(growing_side(axes, &self.largest, depth.mapv(|depth| -depth))?)
        .contours(damped_side(axes, &self.lowest, depth)?)
        .contours(limit.label(
            match self.stable.iter().all(|set| set.undecided.is_empty()) {
                true => "stability limit",
                false => "end of what is proved stable; not all beyond is decided",
            },
        ));
        let figure = Figure::single(panel).title(title).size(5.2, 4.3);
        Ok(figure.color_bar(damping_bar()).color_bar(growth_bar()))
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
                // Nothing but 0 itself, or nothing at all.
                limits.push_str(&match set.at_zero {
                    true => row(0.0, 0.0),
                    false => {
                        let evidence = set.limit().evidence().name();
                        format!("{},{},,,{evidence}\n", to_f64(value), to_text(value))
                    }
                });
            }
            for interval in &set.intervals {
                limits.push_str(&row(interval.from.upper(), interval.to.value()));
            }
        }
        [
            (format!("{stem}.csv"), points.into_bytes()),
            (format!("{stem}_limits.csv"), limits.into_bytes()),
            (format!("{stem}_max_gain.npy"), npy::encode(&self.largest)),
            (format!("{stem}_min_gain.npy"), npy::encode(&self.lowest)),
        ]
        .into_iter()
        .chain(npy::axes(stem, &floats(x), &floats(y)))
        .collect()
    }
}

/// The positive ends of the stable intervals.
fn ends(set: &StableSet) -> Vec<f64> {
    let both = set.intervals.iter().flat_map(|interval| [&interval.from, &interval.to]);
    both.map(Limit::value).filter(|end| end.is_finite() && *end > 0.0).collect()
}

fn floats(axis: &PlaneAxis) -> Vec<f64> {
    axis.values.iter().map(to_f64).collect()
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
        assert!(map.figure("").unwrap().svg().unwrap().0.contains("stability limit"));
    }
}
