//! The largest and the smallest value, over all waves, of `f(φ, t) = Σ_p t^p f_p(φ)` for many `t` at once, where the `f_p` are
//! cosine polynomials.
//!
//! With `n` the degree in `cos φ`, `[0, π]` is cut at `4n` equal steps `h`. Every node carries the first derivatives of all `f_p`, so that `f`
//! is a short polynomial in its cell `|φ − φ_i| ≤ h/2`, whatever `t`. The samples of the nodes say which cells can hold an extremum: those that
//! reach beyond the best sample by the sum of the moduli of the terms. There Newton's method goes for it, for eight columns at once. A cell
//! that is not certainly concave is halved until its parts are. No extremum is missed between the nodes.

mod cell;
mod search;

use cell::{CellPolynomial, TERMS};
use pulp::{Arch, Simd, WithSimd};
use search::Search;
use std::f64::consts::PI;

/// Cells for each half-wave of the highest frequency.
const CELLS_PER_HALF_WAVE: usize = 4;

/// Columns that are worked on together.
pub(crate) const LANES: usize = 8;

/// What is below this part of the sum of all terms is rounding.
const ROUNDING: f64 = 1e-14;

/// One number for each of the columns.
pub(crate) type Lanes = [f64; LANES];

/// An extreme value and the phase at which it is taken, in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extreme {
    pub(crate) value: f64,
    pub(crate) phase: f64,
}

/// How much was done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Work {
    /// Waves at which the polynomials were tabulated.
    pub(crate) phases: usize,
    /// Cells that were looked into, over all columns and both extremes.
    pub(crate) cells: usize,
    /// Steps of Newton's method, each for eight of them.
    pub(crate) newton_steps: usize,
    /// Cells that had to be halved.
    pub(crate) halved: usize,
}

/// `f(φ, t)` prepared for any number of `t`.
#[derive(Debug, Clone)]
pub(crate) struct Envelope {
    /// Powers of `t`.
    powers: usize,
    /// Half a cell, in radians.
    half: f64,
    /// The nodes, in radians.
    phases: Vec<f64>,
    /// `f_p` at the nodes: `[node][power]`.
    values: Vec<f64>,
    /// How much `f_p` can rise within the cell at most.
    rises: Vec<f64>,
    /// The terms of the cells: `[node][power]`.
    cells: Vec<CellPolynomial>,
    /// The largest modulus of each `f_p` at the nodes.
    sizes: Vec<f64>,
    work: Work,
}

impl Envelope {
    /// From functions of degree at most `degree` in `cos φ`: `at(φ, values)` writes `f_p(φ)` for all powers.
    pub(crate) fn new(degree: usize, powers: usize, mut at: impl FnMut(f64, &mut [f64])) -> Self {
        let samples = degree.max(1);
        let mut sampled = vec![0.0; (samples + 1) * powers];
        for (index, values) in sampled.chunks_exact_mut(powers).enumerate() {
            at(node_phase(index, samples), values);
        }
        let series = cosine_coefficients(&sampled, samples, powers);
        let (first, last) = (sampled[..powers].to_vec(), sampled[samples * powers..].to_vec());
        Self::of_series(&series, powers, &first, &last, samples + 1)
    }

    /// From the coefficients `[order][power]`, with the values at both ends, where cancellation is to be exact.
    fn of_series(
        series: &[f64],
        powers: usize,
        first: &[f64],
        last: &[f64],
        sampled: usize,
    ) -> Self {
        let degree = series.len() / powers - 1;
        let cells = CELLS_PER_HALF_WAVE * degree.max(1);
        let half = 0.5 * PI / cells as f64;
        // r_k (k h/2)^m/m!, even m for cosines and odd m for sines, with the signs of the derivatives.
        let (mut even, mut odd) = (Vec::new(), Vec::new());
        for (order, values) in series.chunks_exact(powers).enumerate() {
            for value in values {
                let mut term = *value;
                for m in 0..TERMS {
                    let signed = if m % 4 == 1 || m % 4 == 2 { -term } else { term };
                    if m % 2 == 0 {
                        even.push(signed)
                    } else {
                        odd.push(signed)
                    }
                    term *= order as f64 * half / (m + 1) as f64;
                }
            }
        }
        let turns: Vec<(f64, f64)> = (0..2 * cells).map(|j| exact_turn(j, cells)).collect();
        let mut table = Vec::new();
        Arch::new().dispatch(Tabulation {
            even: &even,
            odd: &odd,
            turns: &turns,
            table: &mut table,
            powers,
        });
        for power in 0..powers {
            table[power][0] = first[power];
            table[cells * powers + power][0] = last[power];
        }
        let rise = |cell: &CellPolynomial| cell[1..].iter().map(|term| term.abs()).sum();
        let values: Vec<f64> = table.iter().map(|cell| cell[0]).collect();
        let mut sizes = vec![0.0f64; powers];
        for node in values.chunks_exact(powers) {
            sizes.iter_mut().zip(node).for_each(|(size, value)| *size = size.max(value.abs()));
        }
        let rises = table.iter().map(rise).collect();
        let work = Work { phases: sampled + cells + 1, ..Work::default() };
        let phases = (0..=cells).map(|node| node_phase(node, cells)).collect();
        Self { powers, half, phases, values, rises, cells: table, sizes, work }
    }

    /// The largest and the smallest value for each `t`, and the work.
    pub(crate) fn extremes(&self, parameters: &[f64]) -> (Vec<[Extreme; 2]>, Work) {
        Arch::new().dispatch(Search { envelope: self, parameters })
    }
}

/// The terms of all cells from those of the series, `[order][power][term]`, and the turns.
struct Tabulation<'a> {
    even: &'a [f64],
    odd: &'a [f64],
    turns: &'a [(f64, f64)],
    table: &'a mut Vec<CellPolynomial>,
    powers: usize,
}

impl WithSimd for Tabulation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let width = TERMS / 2 * self.powers;
        let cells = self.turns.len() / 2;
        self.table.resize((cells + 1) * self.powers, [0.0; TERMS]);
        // The sums of even and of odd orders: cos k(π − φ) = (−1)^k cos kφ and sin k(π − φ) = −(−1)^k sin kφ, so two nodes have them in common.
        let mut cosines = [vec![0.0; width], vec![0.0; width]];
        let mut sines = [vec![0.0; width], vec![0.0; width]];
        for node in 0..=cells / 2 {
            cosines.iter_mut().chain(&mut sines).for_each(|sums| sums.fill(0.0));
            // By index: adapters of iterators are not always inlined into code for a wider processor.
            for order in 0..self.even.len() / width {
                let (sine, cosine) = self.turns[order * node % self.turns.len()];
                let even = &self.even[order * width..][..width];
                let odd = &self.odd[order * width..][..width];
                let cosines = &mut cosines[order % 2][..width];
                let sines = &mut sines[order % 2][..width];
                for term in 0..width {
                    cosines[term] += even[term] * cosine;
                    sines[term] += odd[term] * sine;
                }
            }
            for power in 0..self.powers {
                let term = |m: usize, sign: f64| {
                    let at = power * TERMS / 2 + m / 2;
                    if m.is_multiple_of(2) {
                        cosines[0][at] + sign * cosines[1][at]
                    } else {
                        sign * sines[0][at] + sines[1][at]
                    }
                };
                self.table[node * self.powers + power] = std::array::from_fn(|m| term(m, 1.0));
                let mirrored = (cells - node) * self.powers + power;
                self.table[mirrored] = std::array::from_fn(|m| term(m, -1.0));
            }
        }
    }
}

/// `index π/cells`, exactly π at the end.
fn node_phase(index: usize, cells: usize) -> f64 {
    if index == cells { PI } else { index as f64 * PI / cells as f64 }
}

/// Sine and cosine of `j π/cells`, exact at quarters of the circle.
fn exact_turn(j: usize, cells: usize) -> (f64, f64) {
    match 2 * j {
        0 => (0.0, 1.0),
        double if double == cells => (1.0, 0.0),
        double if double == 2 * cells => (0.0, -1.0),
        double if double == 3 * cells => (-1.0, 0.0),
        _ => (j as f64 * PI / cells as f64).sin_cos(),
    }
}

/// `[order][power]` from values at `samples + 1` equal steps of `[0, π]`, without the orders that are rounding.
fn cosine_coefficients(values: &[f64], samples: usize, powers: usize) -> Vec<f64> {
    let turns: Vec<f64> = (0..2 * samples).map(|j| exact_turn(j, samples).1).collect();
    let mut series = vec![0.0; values.len()];
    for (order, sums) in series.chunks_exact_mut(powers).enumerate() {
        for (index, values) in values.chunks_exact(powers).enumerate() {
            let halved = if index == 0 || index == samples { 0.5 } else { 1.0 };
            let weight = halved * turns[order * index % (2 * samples)];
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
        let halved = if order == 0 || order == samples { 1.0 } else { 2.0 };
        sums.iter_mut().for_each(|sum| *sum *= halved / samples as f64);
    }
    let mut sizes = vec![0.0f64; powers];
    for values in values.chunks_exact(powers) {
        sizes.iter_mut().zip(values).for_each(|(size, value)| *size = size.max(value.abs()));
    }
    let (mut kept, mut tails) = (samples, vec![0.0; powers]);
    while kept > 0 {
        let last = &series[kept * powers..(kept + 1) * powers];
        tails.iter_mut().zip(last).for_each(|(tail, value)| *tail += value.abs());
        if tails.iter().zip(&sizes).any(|(tail, size)| *tail > ROUNDING * size) {
            break;
        }
        kept -= 1;
    }
    series.truncate((kept + 1) * powers);
    series
}

#[cfg(test)]
mod tests;
