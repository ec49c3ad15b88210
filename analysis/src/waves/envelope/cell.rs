//! The polynomial of `f` in one cell, in powers of the distance from its node over half its width, and its maximum on `[−1, 1]`.

use pulp::Simd;

/// Terms of the polynomial of a cell: what is left out is below `(π/8)^12/12! = 3e-14` of the range (Bernstein's inequality).
pub(super) const TERMS: usize = 12;

/// Newton's method stops at steps of this part of half a cell.
const CLOSE: f64 = 1e-12;

/// Steps of the safeguarded Newton's method at most: bisection alone gets there.
const MOST_STEPS: usize = 60;

pub(super) type CellPolynomial = [f64; TERMS];

/// The polynomials of the lanes, term by term.
pub(super) type LaneCells<S> = [<S as Simd>::f64s; TERMS];

/// The polynomials of one cell, from those of all powers of `t`.
#[inline(always)]
pub(super) fn polynomials_in<S: Simd>(
    simd: S,
    cells: &[CellPolynomial],
    t: S::f64s,
) -> LaneCells<S> {
    let mut sums = [simd.splat_f64s(0.0); TERMS];
    for cell in cells.iter().rev() {
        for m in 0..TERMS {
            sums[m] = simd.add_f64s(simd.mul_f64s(sums[m], t), simd.splat_f64s(cell[m]));
        }
    }
    sums
}

/// The polynomials of the lanes at their places.
#[inline(always)]
pub(super) fn horner_in<S: Simd>(simd: S, terms: &LaneCells<S>, places: S::f64s) -> S::f64s {
    let mut sum = terms[TERMS - 1];
    for m in (0..TERMS - 1).rev() {
        sum = simd.add_f64s(simd.mul_f64s(sum, places), terms[m]);
    }
    sum
}

/// The polynomials about the middle of a half of `[−1, 1]`, ±1/2, in powers of the distance over half its width.
#[inline(always)]
pub(super) fn half<S: Simd>(simd: S, terms: &LaneCells<S>, middle: f64) -> LaneCells<S> {
    let mut here = *terms;
    let middle = simd.splat_f64s(middle);
    for first in 0..TERMS {
        for m in (first..TERMS - 1).rev() {
            here[m] = simd.add_f64s(here[m], simd.mul_f64s(middle, here[m + 1]));
        }
    }
    let mut scale = 1.0;
    for term in &mut here {
        *term = simd.mul_f64s(*term, simd.splat_f64s(scale));
        scale *= 0.5;
    }
    here
}

/// Bounds on what polynomials do on `[−1, 1]`.
pub(super) struct Shape<S: Simd> {
    /// How far they may rise above, or fall below, their value in the middle.
    pub(super) rise: S::f64s,
    /// How much the slope may change.
    pub(super) change: S::f64s,
    /// How much the second derivative may change.
    pub(super) bend: S::f64s,
}

impl<S: Simd> Shape<S> {
    #[inline(always)]
    pub(super) fn of(simd: S, terms: &LaneCells<S>) -> Self {
        let zero = simd.splat_f64s(0.0);
        let mut shape = Self { rise: zero, change: zero, bend: zero };
        for (m, term) in terms.iter().enumerate().skip(1) {
            let modulus = simd.abs_f64s(*term);
            shape.rise = simd.add_f64s(shape.rise, modulus);
            if m >= 2 {
                let slope = simd.mul_f64s(simd.splat_f64s(m as f64), modulus);
                shape.change = simd.add_f64s(shape.change, slope);
            }
            if m >= 3 {
                let second = simd.mul_f64s(simd.splat_f64s((m * (m - 1)) as f64), modulus);
                shape.bend = simd.add_f64s(shape.bend, second);
            }
        }
        shape
    }
}

/// The maxima of concave polynomials on `[−1, 1]`, and the steps it took: Newton's method for the slope within a bracket. A lane that
/// has found its maximum waits for the others; those that are not live end anywhere.
#[inline(always)]
pub(super) fn newton<S: Simd>(
    simd: S,
    terms: &LaneCells<S>,
    mut live: S::m64s,
) -> (S::f64s, usize) {
    let [zero, one, close] = [simd.splat_f64s(0.0), simd.splat_f64s(1.0), simd.splat_f64s(CLOSE)];
    let [minus_one, one_half] = [simd.splat_f64s(-1.0), simd.splat_f64s(0.5)];
    let mut slopes = *terms;
    let (mut first, mut last) = (zero, zero);
    for m in 1..TERMS {
        slopes[m] = simd.mul_f64s(simd.splat_f64s(m as f64), terms[m]);
        last = simd.add_f64s(last, slopes[m]);
        first = match m % 2 {
            0 => simd.sub_f64s(first, slopes[m]),
            _ => simd.add_f64s(first, slopes[m]),
        };
    }
    // A cell that only rises or only falls has its maximum at an end.
    let mut lower = simd.select_f64s(simd.greater_than_or_equal_f64s(last, zero), one, minus_one);
    let mut upper = simd.select_f64s(simd.less_than_or_equal_f64s(first, zero), minus_one, one);
    let vertex = simd.div_f64s(simd.mul_f64s(simd.splat_f64s(-0.5), terms[1]), terms[2]);
    let raised = simd.select_f64s(simd.less_than_f64s(vertex, lower), lower, vertex);
    let mut places = simd.select_f64s(simd.greater_than_f64s(raised, upper), upper, raised);
    for step in 1..=MOST_STEPS {
        let (mut slope, mut bend) = (slopes[TERMS - 1], zero);
        for m in (1..TERMS - 1).rev() {
            bend = simd.add_f64s(simd.mul_f64s(bend, places), slope);
            slope = simd.add_f64s(simd.mul_f64s(slope, places), slopes[m]);
        }
        let rises = simd.greater_than_f64s(slope, zero);
        lower = simd.select_f64s(rises, places, lower);
        upper = simd.select_f64s(rises, upper, places);
        let next = simd.sub_f64s(places, simd.div_f64s(slope, bend));
        let inside = simd.and_m64s(
            simd.greater_than_or_equal_f64s(next, lower),
            simd.less_than_or_equal_f64s(next, upper),
        );
        let middle = simd.mul_f64s(one_half, simd.add_f64s(lower, upper));
        let next = simd.select_f64s(inside, next, middle);
        let distance = simd.abs_f64s(simd.sub_f64s(next, places));
        places = simd.select_f64s(live, next, places);
        live = simd.and_m64s(live, simd.greater_than_f64s(distance, close));
        if simd.first_true_m64s(live) >= S::F64_LANES {
            return (places, step);
        }
    }
    (places, MOST_STEPS)
}
