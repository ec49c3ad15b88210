//! The largest and the smallest value, over all waves, of `f(φ, t) = Σ_p t^p f_p(φ)` for many `t` at once, where the `f_p` are
//! cosine polynomials.
//!
//! With `n` the degree in `cos φ`, `[0, π]` is cut at `4n` equal steps `h`. Every node carries the first derivatives of all `f_p`, so that `f`
//! is a short polynomial in its cell `|φ − φ_i| ≤ h/2`, whatever `t`. The samples of the nodes say which cells can hold an extremum: those that
//! reach beyond the best sample by the sum of the moduli of the terms. There Newton's method goes for it, for eight columns at once. A cell
//! that is not certainly concave is halved until its parts are. No extremum is missed between the nodes.

mod cell;

use cell::{CellPolynomial, TERMS, horner_in, is_concave, may_turn, newton, search_halves};
use pulp::Arch;
use std::f64::consts::PI;

/// Cells for each half-wave of the highest frequency.
const CELLS_PER_HALF_WAVE: usize = 4;

/// Columns that are worked on together.
pub(crate) const LANES: usize = 8;

/// What is below this part of the sum of all terms is rounding.
const ROUNDING: f64 = 1e-14;

/// A cell that cannot exceed the best sample by more than this part of the sum of all terms is not looked into.
const NEGLIGIBLE: f64 = 1e-13;

/// Times a cell is halved at most: `f` then varies by less than `2^−60` of its third derivative.
const MOST_HALVINGS: usize = 20;

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

/// A cell of a column that may hold an extreme, the largest value (sign 1) or the smallest (−1).
#[derive(Debug, Clone, Copy)]
struct Candidate {
    column: usize,
    node: usize,
    sign: f64,
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
        let width = TERMS / 2 * powers;
        let mut table = Vec::with_capacity((cells + 1) * powers);
        Arch::new().dispatch(|| {
            let (mut evens, mut odds) = (vec![0.0; width], vec![0.0; width]);
            for node in 0..=cells {
                evens.fill(0.0);
                odds.fill(0.0);
                let terms = even.chunks_exact(width).zip(odd.chunks_exact(width));
                for (order, (even, odd)) in terms.enumerate() {
                    let (sine, cosine) = turns[order * node % (2 * cells)];
                    evens.iter_mut().zip(even).for_each(|(sum, term)| *sum += term * cosine);
                    odds.iter_mut().zip(odd).for_each(|(sum, term)| *sum += term * sine);
                }
                for power in 0..powers {
                    let of = power * TERMS / 2;
                    table.push(std::array::from_fn::<f64, TERMS, _>(|m| {
                        if m % 2 == 0 { evens[of + m / 2] } else { odds[of + m / 2] }
                    }));
                }
            }
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
        Self { powers, half, values, rises, cells: table, sizes, work }
    }

    fn nodes(&self) -> usize {
        self.cells.len() / self.powers
    }

    /// The largest and the smallest value for each `t`, and the work.
    pub(crate) fn extremes(&self, parameters: &[f64]) -> (Vec<[Extreme; 2]>, Work) {
        Arch::new().dispatch(
            #[inline(always)]
            || self.extremes_in_lanes(parameters),
        )
    }

    #[inline(always)]
    fn extremes_in_lanes(&self, parameters: &[f64]) -> (Vec<[Extreme; 2]>, Work) {
        let mut work = self.work;
        let mut extremes = Vec::with_capacity(parameters.len());
        let mut candidates = Vec::new();
        for (block, columns) in parameters.chunks(LANES).enumerate() {
            let t: Lanes = std::array::from_fn(|lane| columns[lane.min(columns.len() - 1)]);
            let (high, low) = self.best_samples(&t);
            self.collect(&t, (block * LANES, columns.len()), (&high, &low), &mut candidates);
            let samples = high.into_iter().zip(low).take(columns.len());
            let open = |value| Extreme { value, phase: f64::NAN };
            extremes.extend(samples.map(|(high, low)| [open(high), open(low)]));
        }
        work.cells += candidates.len();
        for group in candidates.chunks(LANES) {
            self.look_into(group, parameters, &mut extremes, &mut work);
        }
        for (pair, &t) in extremes.iter_mut().zip(parameters) {
            for extreme in pair.iter_mut().filter(|extreme| extreme.phase.is_nan()) {
                // No cell rises above it: the first node that has it.
                let node = (0..self.nodes()).find(|&node| self.at_node(node, t) == extreme.value);
                extreme.phase = self.phase(node.unwrap_or(0), 0.0);
            }
        }
        (extremes, work)
    }

    #[inline(always)]
    fn best_samples(&self, t: &Lanes) -> (Lanes, Lanes) {
        let (mut high, mut low) = ([f64::NEG_INFINITY; LANES], [f64::INFINITY; LANES]);
        for node in self.values.chunks_exact(self.powers) {
            let value = horner(node, t);
            for lane in 0..LANES {
                high[lane] = if value[lane] > high[lane] { value[lane] } else { high[lane] };
                low[lane] = if value[lane] < low[lane] { value[lane] } else { low[lane] };
            }
        }
        (high, low)
    }

    /// The cells that may reach beyond the best samples.
    #[inline(always)]
    fn collect(
        &self,
        t: &Lanes,
        (first, columns): (usize, usize),
        (high, low): (&Lanes, &Lanes),
        candidates: &mut Vec<Candidate>,
    ) {
        let moduli = t.map(f64::abs);
        let margin = horner(&self.sizes, &moduli).map(|size| NEGLIGIBLE * size);
        let (mut above, mut below) = (*high, *low);
        for lane in 0..LANES {
            above[lane] += margin[lane];
            below[lane] -= margin[lane];
        }
        let nodes = self.values.chunks_exact(self.powers).zip(self.rises.chunks_exact(self.powers));
        for (node, (values, rises)) in nodes.enumerate() {
            let (value, rise) = (horner(values, t), horner(rises, &moduli));
            let mut any = 0u64;
            for lane in 0..LANES {
                any |= u64::from(value[lane] + rise[lane] > above[lane]);
                any |= u64::from(value[lane] - rise[lane] < below[lane]);
            }
            if any == 0 {
                continue;
            }
            for lane in 0..columns {
                for (sign, reaches) in [
                    (1.0, value[lane] + rise[lane] > above[lane]),
                    (-1.0, value[lane] - rise[lane] < below[lane]),
                ] {
                    let candidate = Candidate { column: first + lane, node, sign };
                    if reaches && may_turn(&self.polynomial(&candidate, t[lane])) {
                        candidates.push(candidate);
                    }
                }
            }
        }
    }

    /// Goes for the extremes of some cells together.
    #[inline(always)]
    fn look_into(
        &self,
        group: &[Candidate],
        parameters: &[f64],
        extremes: &mut [[Extreme; 2]],
        work: &mut Work,
    ) {
        let mut terms = [[0.0; LANES]; TERMS];
        let mut concave = [true; LANES];
        let mut found = [(f64::NEG_INFINITY, 0.0); LANES];
        for (lane, candidate) in group.iter().enumerate() {
            let cell = self.polynomial(candidate, parameters[candidate.column]);
            concave[lane] = is_concave(&cell);
            if concave[lane] {
                terms.iter_mut().zip(cell).for_each(|(lanes, term)| lanes[lane] = term);
            } else {
                work.halved += 1;
                let best = &mut found[lane];
                *best = (cell[0], 0.0);
                search_halves(&cell, (0.0, 1.0), MOST_HALVINGS, best);
            }
        }
        for lane in (0..LANES).filter(|&lane| lane >= group.len() || !concave[lane]) {
            // A parabola for the lanes that have nothing to do.
            terms[2][lane] = -1.0;
        }
        let (places, steps) = newton(&terms);
        work.newton_steps += steps;
        let values = horner_in(&terms, &places);
        for (lane, candidate) in group.iter().enumerate() {
            let (value, place) =
                if concave[lane] { (values[lane], places[lane]) } else { found[lane] };
            let extreme = &mut extremes[candidate.column][usize::from(candidate.sign < 0.0)];
            let exceeds = candidate.sign * (candidate.sign * value - extreme.value) > 0.0;
            if exceeds || extreme.phase.is_nan() && candidate.sign * value == extreme.value {
                let phase = self.phase(candidate.node, place);
                *extreme = Extreme { value: candidate.sign * value, phase };
            }
        }
    }

    /// `sign · f` in the cell, in powers of the distance from its node over half its width.
    #[inline(always)]
    fn polynomial(&self, candidate: &Candidate, t: f64) -> CellPolynomial {
        let cells = &self.cells[candidate.node * self.powers..][..self.powers];
        let mut sum = [0.0; TERMS];
        for cell in cells.iter().rev() {
            for m in 0..TERMS {
                sum[m] = sum[m] * t + cell[m];
            }
        }
        sum.map(|term| candidate.sign * term)
    }

    fn at_node(&self, node: usize, t: f64) -> f64 {
        horner(&self.values[node * self.powers..][..self.powers], &[t; LANES])[0]
    }

    /// Within `[0, π]`, about both ends of which everything is even.
    fn phase(&self, node: usize, place: f64) -> f64 {
        let phase = (node_phase(node, self.nodes() - 1) + place * self.half).abs();
        if phase > PI { 2.0 * PI - phase } else { phase }
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

/// `Σ_p t^p c_p` in every lane. No `mul_add`: where the target has no such instruction it is a slow library call.
#[inline(always)]
fn horner(coefficients: &[f64], t: &Lanes) -> Lanes {
    let mut sum = [0.0; LANES];
    for coefficient in coefficients.iter().rev() {
        for lane in 0..LANES {
            sum[lane] = sum[lane] * t[lane] + coefficient;
        }
    }
    sum
}

#[cfg(test)]
mod tests;
