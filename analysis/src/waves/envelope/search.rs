//! The search for extremes: the best samples of the nodes, then Newton's method in the cells that may hold more, for all lanes together.
//!
//! What comes out of a lane does not depend on the others, so that the bits do not depend on how many lanes the processor has.

use super::cell::{LaneCells, Shape, half, horner_in, newton, polynomials_in};
use super::{Envelope, Extreme, Work};
use pulp::{Simd, WithSimd};
use std::f64::consts::PI;

/// A cell that cannot exceed the best sample by more than this part of the sum of all terms is not looked into.
const NEGLIGIBLE: f64 = 1e-13;

/// Parts of a cell are not halved below this one: `f` then varies by less than `2^−60` of its third derivative.
const LEAST_RADIUS: f64 = 1.0 / (1u32 << 20) as f64;

/// The extremes for each `t`. A type where a closure would do: a closure that is called by reference is compiled apart, for the least
/// processor.
pub(super) struct Search<'a> {
    pub(super) envelope: &'a Envelope,
    pub(super) parameters: &'a [f64],
}

impl WithSimd for Search<'_> {
    type Output = (Vec<[Extreme; 2]>, Work);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut extremes = Vec::with_capacity(self.parameters.len());
        let mut lanes = Lanes {
            simd,
            envelope: self.envelope,
            best: [Best::none(simd); 2],
            parts: Vec::new(),
            work: self.envelope.work,
        };
        for columns in self.parameters.chunks(S::F64_LANES) {
            // Lanes beyond the last column have nothing to exceed: everything vanishes at zero but the constant.
            let t = simd.partial_load_f64s(columns);
            lanes.best = [Best::none(simd); 2];
            lanes.sample(t);
            lanes.look_into_cells(t, columns.len());
            let [high, low] = lanes.best;
            let (high, low) = (high.extremes(simd, 1.0), low.extremes(simd, -1.0));
            extremes.extend((0..columns.len()).map(|lane| [high[lane], low[lane]]));
        }
        (extremes, lanes.work)
    }
}

/// The largest `sign · f` so far in every lane, and where.
#[derive(Clone, Copy)]
struct Best<S: Simd> {
    value: S::f64s,
    phase: S::f64s,
}

impl<S: Simd> Best<S> {
    #[inline(always)]
    fn none(simd: S) -> Self {
        Self { value: simd.splat_f64s(f64::NEG_INFINITY), phase: simd.splat_f64s(0.0) }
    }

    /// Takes what is larger.
    #[inline(always)]
    fn offer(&mut self, simd: S, value: S::f64s, phase: S::f64s) {
        let larger = simd.greater_than_f64s(value, self.value);
        self.phase = simd.select_f64s(larger, phase, self.phase);
        self.value = simd.select_f64s(larger, value, self.value);
    }

    /// With the phases within `[0, π]`, about both ends of which everything is even.
    #[inline(always)]
    fn extremes(self, simd: S, sign: f64) -> [Extreme; MOST_LANES] {
        let (mut values, mut phases) = ([0.0; MOST_LANES], [0.0f64; MOST_LANES]);
        simd.partial_store_f64s(&mut values[..S::F64_LANES], self.value);
        simd.partial_store_f64s(&mut phases[..S::F64_LANES], self.phase);
        let mut extremes = [Extreme { value: 0.0, phase: 0.0 }; MOST_LANES];
        for lane in 0..S::F64_LANES {
            let phase = phases[lane].abs();
            let phase = if phase > PI { 2.0 * PI - phase } else { phase };
            extremes[lane] = Extreme { value: sign * values[lane], phase };
        }
        extremes
    }
}

/// No processor has more lanes.
const MOST_LANES: usize = 8;

/// A part of a cell that may hold more in some lanes: `sign · f` in powers of the distance from its middle over its radius.
struct Part<S: Simd> {
    polynomials: LaneCells<S>,
    /// In halves of a cell from the node.
    middle: f64,
    radius: f64,
    /// What is to be exceeded: infinite in the other lanes.
    bounds: S::f64s,
}

/// Columns that are worked on together.
struct Lanes<'a, S: Simd> {
    simd: S,
    envelope: &'a Envelope,
    /// Of `f` and of `−f`.
    best: [Best<S>; 2],
    /// What waits to be looked into.
    parts: Vec<Part<S>>,
    work: Work,
}

impl<S: Simd> Lanes<'_, S> {
    /// The best of the samples at the nodes.
    #[inline(always)]
    fn sample(&mut self, t: S::f64s) {
        let simd = self.simd;
        let [mut high, mut low] = self.best;
        let Envelope { powers, values, phases, .. } = self.envelope;
        for (node, phase) in phases.iter().enumerate() {
            let value = horner(simd, at(values, node, *powers), t);
            let phase = simd.splat_f64s(*phase);
            high.offer(simd, value, phase);
            low.offer(simd, simd.neg_f64s(value), phase);
        }
        self.best = [high, low];
    }

    /// The cells that may reach beyond the best samples.
    #[inline(always)]
    fn look_into_cells(&mut self, t: S::f64s, columns: usize) {
        let (simd, envelope) = (self.simd, self.envelope);
        let Envelope { powers, values, rises, cells, sizes, .. } = envelope;
        let moduli = simd.abs_f64s(t);
        let size = horner(simd, sizes, moduli);
        let negligible = simd.mul_f64s(simd.splat_f64s(NEGLIGIBLE), size);
        let [high, low] = self.best;
        let bounds = [simd.add_f64s(high.value, negligible), simd.add_f64s(low.value, negligible)];
        for node in 0..envelope.phases.len() {
            let value = horner(simd, at(values, node, *powers), t);
            let rise = horner(simd, at(rises, node, *powers), moduli);
            let above = simd.sub_f64s(simd.add_f64s(value, rise), bounds[0]);
            let below = simd.sub_f64s(simd.sub_f64s(rise, value), bounds[1]);
            let beyond = simd.max_f64s(above, below);
            if !any(simd, simd.greater_than_f64s(beyond, simd.splat_f64s(0.0))) {
                continue;
            }
            let polynomials = polynomials_in(simd, &cells[node * powers..][..*powers], t);
            let shape = Shape::of(simd, &polynomials);
            let mut part = Part { polynomials, middle: 0.0, radius: 1.0, bounds: bounds[0] };
            self.look_into(&part, &shape, (node, 0), columns);
            self.look_into_waiting(node, 0);
            part.bounds = bounds[1];
            for term in &mut part.polynomials {
                *term = simd.neg_f64s(*term);
            }
            self.look_into(&part, &shape, (node, 1), columns);
            self.look_into_waiting(node, 1);
        }
    }

    #[inline(always)]
    fn look_into_waiting(&mut self, node: usize, which: usize) {
        let (simd, envelope) = (self.simd, self.envelope);
        while let Some(part) = self.parts.pop() {
            let middle = envelope.phases[node] + part.middle * envelope.half;
            let value = part.polynomials[0];
            self.best[which].offer(simd, value, simd.splat_f64s(middle));
            let shape = Shape::of(simd, &part.polynomials);
            self.look_into(&part, &shape, (node, which), 0);
        }
    }

    /// Goes for the maximum where the part is concave; where it may not be, its halves wait to be looked into.
    #[inline(always)]
    fn look_into(
        &mut self,
        part: &Part<S>,
        shape: &Shape<S>,
        (node, which): (usize, usize),
        columns: usize,
    ) {
        let (simd, envelope) = (self.simd, self.envelope);
        let Part { polynomials, middle, radius, bounds } = part;
        let zero = simd.splat_f64s(0.0);
        let reach = simd.add_f64s(polynomials[0], shape.rise);
        let reaches = simd.greater_than_f64s(reach, *bounds);
        let slope = simd.abs_f64s(polynomials[1]);
        let open = simd.and_m64s(reaches, simd.less_than_or_equal_f64s(slope, shape.change));
        if !any(simd, open) {
            return;
        }
        let bend = simd.add_f64s(simd.add_f64s(polynomials[2], polynomials[2]), shape.bend);
        let concave = simd.and_m64s(open, simd.less_than_f64s(bend, zero));
        let bent = simd.and_m64s(open, simd.greater_than_or_equal_f64s(bend, zero));
        if *radius == 1.0 {
            self.work.cells += count(simd, open, columns);
            self.work.halved += count(simd, bent, columns);
        }
        if any(simd, concave) {
            let (places, steps) = newton(simd, polynomials, concave);
            self.work.newton_steps += steps;
            let values = horner_in(simd, polynomials, places);
            let values = simd.select_f64s(concave, values, simd.splat_f64s(f64::NEG_INFINITY));
            let place = simd.mul_f64s(places, simd.splat_f64s(*radius));
            let place = simd.add_f64s(simd.splat_f64s(*middle), place);
            let offset = simd.mul_f64s(place, simd.splat_f64s(envelope.half));
            let phase = simd.add_f64s(simd.splat_f64s(envelope.phases[node]), offset);
            self.best[which].offer(simd, values, phase);
        }
        if any(simd, bent) && *radius > LEAST_RADIUS {
            let nothing = simd.splat_f64s(f64::INFINITY);
            let bounds = simd.select_f64s(bent, self.best[which].value, nothing);
            let radius = 0.5 * radius;
            // The left one is looked into first.
            for side in [0.5, -0.5] {
                let polynomials = half(simd, polynomials, side);
                let middle = middle + 2.0 * side * radius;
                self.parts.push(Part { polynomials, middle, radius, bounds });
            }
        }
    }
}

/// The coefficients of a node, by its index: adapters of iterators are not always inlined into code for a wider processor.
#[inline(always)]
fn at(coefficients: &[f64], node: usize, powers: usize) -> &[f64] {
    &coefficients[node * powers..][..powers]
}

#[inline(always)]
fn any<S: Simd>(simd: S, mask: S::m64s) -> bool {
    simd.first_true_m64s(mask) < S::F64_LANES
}

/// In how many of the first lanes it holds.
#[inline(always)]
fn count<S: Simd>(simd: S, mask: S::m64s, columns: usize) -> usize {
    let mut ones = [0.0; MOST_LANES];
    let one = simd.select_f64s(mask, simd.splat_f64s(1.0), simd.splat_f64s(0.0));
    simd.partial_store_f64s(&mut ones[..S::F64_LANES], one);
    ones[..columns].iter().sum::<f64>() as usize
}

/// `Σ_p t^p c_p` in every lane. No fused operation: the bits are not to depend on the processor.
#[inline(always)]
fn horner<S: Simd>(simd: S, coefficients: &[f64], t: S::f64s) -> S::f64s {
    let mut sum = simd.splat_f64s(0.0);
    for coefficient in coefficients.iter().rev() {
        sum = simd.add_f64s(simd.mul_f64s(sum, t), simd.splat_f64s(*coefficient));
    }
    sum
}
