//! The polynomial of `f` in one cell, in powers of the distance from its node over half its width, and its maximum on `[−1, 1]`.

use super::{LANES, Lanes};

/// Terms of the polynomial of a cell: what is left out is below `(π/8)^12/12! = 3e-14` of the range (Bernstein's inequality).
pub(super) const TERMS: usize = 12;

/// Newton's method stops at steps of this part of half a cell.
const CLOSE: f64 = 1e-12;

/// Steps of the safeguarded Newton's method at most: bisection alone gets there.
const MOST_STEPS: usize = 60;

pub(super) type CellPolynomial = [f64; TERMS];

/// The polynomials of the lanes at their places.
#[inline(always)]
pub(super) fn horner_in(terms: &[Lanes; TERMS], places: &Lanes) -> Lanes {
    let mut sum = [0.0; LANES];
    for term in terms.iter().rev() {
        for lane in 0..LANES {
            sum[lane] = sum[lane] * places[lane] + term[lane];
        }
    }
    sum
}

/// Whether the polynomial is certainly concave in the cell.
#[inline(always)]
pub(super) fn is_concave(cell: &CellPolynomial) -> bool {
    let bend: f64 = (3..TERMS).map(|m| (m * (m - 1)) as f64 * cell[m].abs()).sum();
    2.0 * cell[2] + bend < 0.0
}

/// Whether the slope may vanish in the cell.
#[inline(always)]
pub(super) fn may_turn(cell: &CellPolynomial) -> bool {
    let change: f64 = (2..TERMS).map(|m| m as f64 * cell[m].abs()).sum();
    cell[1].abs() <= change
}

/// The maxima of concave polynomials on `[−1, 1]`, and the steps it took: Newton's method for the slope within a bracket.
#[inline(always)]
pub(super) fn newton(terms: &[Lanes; TERMS]) -> (Lanes, usize) {
    let (mut lower, mut upper) = ([-1.0; LANES], [1.0; LANES]);
    let (mut first, mut last) = ([0.0; LANES], [0.0; LANES]);
    for (m, term) in terms.iter().enumerate().skip(1) {
        let sign = if m % 2 == 0 { -1.0 } else { 1.0 };
        for lane in 0..LANES {
            let slope = m as f64 * term[lane];
            last[lane] += slope;
            first[lane] += sign * slope;
        }
    }
    let mut places = [0.0; LANES];
    for lane in 0..LANES {
        // A cell that only rises or only falls has its maximum at an end.
        lower[lane] = if last[lane] >= 0.0 { 1.0 } else { -1.0 };
        upper[lane] = if first[lane] <= 0.0 { -1.0 } else { 1.0 };
        let vertex = -0.5 * terms[1][lane] / terms[2][lane];
        let vertex = if vertex < lower[lane] { lower[lane] } else { vertex };
        places[lane] = if vertex > upper[lane] { upper[lane] } else { vertex };
    }
    for step in 1..=MOST_STEPS {
        let (mut slope, mut bend) = ([0.0; LANES], [0.0; LANES]);
        for m in (1..TERMS).rev() {
            for lane in 0..LANES {
                bend[lane] = bend[lane] * places[lane] + slope[lane];
                slope[lane] = slope[lane] * places[lane] + m as f64 * terms[m][lane];
            }
        }
        let mut moved = 0.0f64;
        for lane in 0..LANES {
            let (at, rises) = (places[lane], slope[lane] > 0.0);
            lower[lane] = if rises { at } else { lower[lane] };
            upper[lane] = if rises { upper[lane] } else { at };
            let next = at - slope[lane] / bend[lane];
            let inside = next >= lower[lane] && next <= upper[lane];
            let middle = 0.5 * (lower[lane] + upper[lane]);
            places[lane] = if inside { next } else { middle };
            let distance = (places[lane] - at).abs();
            moved = if distance > moved { distance } else { moved };
        }
        if moved <= CLOSE {
            return (places, step);
        }
    }
    (places, MOST_STEPS)
}

/// The maximum on `[middle − radius, middle + radius]`, if it exceeds the best known `(value, place)`.
pub(super) fn search_halves(
    cell: &CellPolynomial,
    (middle, radius): (f64, f64),
    halvings: usize,
    best: &mut (f64, f64),
) {
    // The polynomial about the middle, in powers of the distance over the radius.
    let mut here = *cell;
    for first in 0..TERMS {
        for m in (first..TERMS - 1).rev() {
            here[m] += middle * here[m + 1];
        }
    }
    let mut scale = 1.0;
    for term in &mut here {
        *term *= scale;
        scale *= radius;
    }
    let rise: f64 = here[1..].iter().map(|term| term.abs()).sum();
    if here[0] > best.0 {
        *best = (here[0], middle);
    }
    if here[0] + rise <= best.0 || !may_turn(&here) || halvings == 0 {
        return;
    }
    if is_concave(&here) {
        let terms = here.map(|term| [term; LANES]);
        let places = newton(&terms).0;
        let value = horner_in(&terms, &places)[0];
        if value > best.0 {
            *best = (value, middle + radius * places[0]);
        }
        return;
    }
    let half = 0.5 * radius;
    search_halves(cell, (middle - half, half), halvings - 1, best);
    search_halves(cell, (middle + half, half), halvings - 1, best);
}
