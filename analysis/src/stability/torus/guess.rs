//! Where stability is lost and regained on cells, seen in `f64` by samples: guesses for the exact decisions.

use super::TorusInequality;
use super::cell::CompiledCell;
use crate::stability::critical::negative_intervals;

/// A wave as a point of a cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Spot {
    /// Which inequality, and which of its cells.
    pub(super) inequality: usize,
    pub(super) cell: usize,
    pub(super) point: Vec<f64>,
}

/// An end of an unstable interval of `t`, and the wave whose condition vanishes there.
#[derive(Debug, Clone)]
pub(super) struct Critical {
    pub(super) parameter: f64,
    pub(super) spot: Spot,
}

/// Steps of a sample grid along an axis, at least and at most, by dimension.
const FEWEST: [usize; 3] = [32, 8, 4];
const MOST: [usize; 3] = [256, 24, 10];

/// Rounds about all neighbours of one refinement at most.
const MOST_PASSES: usize = 400;

/// A coefficient below this share of the largest is a rounding.
const ROUNDING: f64 = 1e-15;

/// The steps of a refinement end here.
const FINEST: f64 = 1e-10;

/// The cells in `f64`, with samples of the condition on them.
pub(super) struct Guesses {
    cells: Vec<Vec<CompiledCell>>,
    /// Samples with the coefficients of the powers of `t` there.
    samples: Vec<(Spot, Vec<f64>)>,
    end: f64,
}

impl Guesses {
    pub(super) fn new(inequalities: &[TorusInequality], end: f64) -> Self {
        let compiled =
            |one: &TorusInequality| one.cells.iter().map(|cell| cell.compile()).collect();
        let cells: Vec<Vec<CompiledCell>> = inequalities.iter().map(compiled).collect();
        let mut samples = Vec::new();
        for (inequality, all) in cells.iter().enumerate() {
            for (cell, compiled) in all.iter().enumerate() {
                for point in grid(compiled.wave_degrees()) {
                    let powers = without_roundings(compiled.at_point(&point));
                    samples.push((Spot { inequality, cell, point }, powers));
                }
            }
        }
        Self { cells, samples, end }
    }

    /// The first stretch of `t` that ends above `reached` in which samples are unstable.
    pub(super) fn next_unstable(&self, reached: f64) -> Option<(Critical, Critical)> {
        let mut all: Vec<(f64, f64, &Spot)> = Vec::new();
        for (spot, powers) in &self.samples {
            for (from, to) in negative_intervals(powers, self.end) {
                if to > reached {
                    all.push((from, to, spot));
                }
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let critical = |parameter: f64, spot: &Spot| Critical { parameter, spot: spot.clone() };
        let mut all = all.into_iter();
        let (from, mut to, spot) = all.next()?;
        let (first, mut last) = (critical(from, spot), spot);
        for (from, end, spot) in all {
            if from > to {
                break;
            }
            if end > to {
                (to, last) = (end, spot);
            }
        }
        Some((first, critical(to, last)))
    }

    /// The samples that are unstable just above `t`, those first that stay so the longest.
    pub(super) fn unstable_above(&self, t: f64) -> Vec<Spot> {
        let nudged = t * (1.0 + 1e-9) + f64::MIN_POSITIVE;
        let mut found: Vec<(f64, &Spot)> = Vec::new();
        for (spot, powers) in &self.samples {
            let unstable = negative_intervals(powers, self.end);
            let around = unstable.iter().find(|(from, to)| *from <= t && *to > nudged);
            found.extend(around.map(|(_, to)| (*to, spot)));
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        found.into_iter().map(|(_, spot)| spot.clone()).collect()
    }

    /// Forgets the samples that seem unstable at once above a value.
    pub(super) fn discard(&mut self, t: f64) {
        let end = self.end;
        self.samples.retain(|(_, powers)| {
            negative_intervals(powers, end).iter().all(|(from, to)| *from > t || *to <= t)
        });
    }

    /// Moves a start (or an end) of instability to the lowest (highest) over all waves of its cell near the sample.
    pub(super) fn refined(&self, guess: &Critical, is_start: bool) -> Critical {
        let cell = &self.cells[guess.spot.inequality][guess.spot.cell];
        let end_at = |point: &[f64]| -> Option<f64> {
            let powers = without_roundings(cell.at_point(point));
            let intervals = negative_intervals(&powers, self.end).into_iter();
            let ends = intervals.map(|(from, to)| if is_start { from } else { to });
            let away = |end: &f64| (end - guess.parameter).abs();
            ends.min_by(|a, b| away(a).total_cmp(&away(b)))
        };
        let better = |a: f64, b: f64| if is_start { a < b } else { a > b };
        let dimension = guess.spot.point.len();
        let mut best = guess.clone();
        let mut step = 1.0 / FEWEST[dimension - 1] as f64;
        // Roundings can be climbed for ever.
        for _ in 0..MOST_PASSES {
            if step <= FINEST {
                break;
            }
            let mut moved = false;
            for direction in directions(dimension) {
                let to = |(x, sign): (&f64, &f64)| (x + sign * step).clamp(0.0, 1.0);
                let point: Vec<f64> = best.spot.point.iter().zip(&direction).map(to).collect();
                if let Some(parameter) = end_at(&point).filter(|&end| better(end, best.parameter)) {
                    best = Critical { parameter, spot: Spot { point, ..best.spot } };
                    moved = true;
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        best
    }
}

/// Without the low powers of `t` whose coefficients are zero: they would place a root at the least positive number.
fn without_roundings(mut powers: Vec<f64>) -> Vec<f64> {
    let largest = powers.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let nothing = |value: &&f64| value.abs() <= ROUNDING * largest;
    let first = powers.iter().take_while(nothing).count();
    powers.drain(..first);
    powers
}

/// A grid on the unit cube that resolves polynomials of these degrees.
fn grid(degrees: &[usize]) -> Vec<Vec<f64>> {
    let at = degrees.len() - 1;
    let mut points = vec![Vec::new()];
    for degree in degrees {
        let steps = if *degree == 0 { 0 } else { (2 * degree).clamp(FEWEST[at], MOST[at]) };
        let coordinates = (0..=steps).map(|i| i as f64 / steps.max(1) as f64);
        let longer =
            |point: Vec<f64>| coordinates.clone().map(move |x| [point.as_slice(), &[x]].concat());
        points = points.into_iter().flat_map(longer).collect();
    }
    points
}

/// Steps to all neighbours.
fn directions(dimension: usize) -> Vec<Vec<f64>> {
    let mut all = vec![Vec::new()];
    for _ in 0..dimension {
        let longer =
            |vector: Vec<f64>| [0.0, 1.0, -1.0].map(|sign| [vector.as_slice(), &[sign]].concat());
        all = all.into_iter().flat_map(longer).collect();
    }
    all.retain(|vector| vector.iter().any(|sign| *sign != 0.0));
    all
}
