//! The waves that grow: where a condition is violated, between exactly isolated zeros.

use crate::exact::rational::{Rational, integer};
use crate::exact::real_roots::power_of_two;
use crate::exact::unit_interval::Zeros;
use num_traits::Signed;

/// Bits to which zeros are enclosed at first.
const BITS: u32 = 96;

/// Two zeros that agree to so many bits less are told apart with more bits.
const SPARE: u32 = 40;

/// More bits than any two zeros here need.
const MOST_BITS: u32 = 1 << 14;

/// A stretch of `s = sin²(φ/2)` between neighbouring zeros.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cell {
    pub(super) from: Rational,
    pub(super) to: Rational,
    /// Whether a condition is violated inside.
    pub(super) grows: bool,
}

/// `[0, 1]` cut at the zeros of all conditions, and at `more` points.
pub(super) fn cells<'a>(
    conditions: impl Iterator<Item = &'a Zeros>,
    more: impl IntoIterator<Item = Rational>,
) -> Vec<Cell> {
    let mut knots = vec![integer(0), integer(1)];
    let mut negative: Vec<(Rational, Rational)> = Vec::new();
    for zeros in conditions {
        let ends = ends(zeros);
        for pair in ends.windows(2) {
            if zeros.is_negative_at(&((&pair[0] + &pair[1]) / integer(2))) {
                negative.push((pair[0].clone(), pair[1].clone()));
            }
        }
        knots.extend(ends);
    }
    knots.extend(more);
    knots.sort();
    knots.dedup();
    // Zeros that two conditions share are enclosed twice.
    let sliver = power_of_two(-i64::from(BITS - SPARE / 2));
    let wide = |pair: &&[Rational]| {
        let size = (&pair[1]).min(&(integer(1) - &pair[0])).clone();
        &pair[1] - &pair[0] > size * &sliver
    };
    let cell = |pair: &[Rational]| {
        let middle = (&pair[0] + &pair[1]) / integer(2);
        let grows = negative.iter().any(|(from, to)| *from < middle && middle < *to);
        Cell { from: pair[0].clone(), to: pair[1].clone(), grows }
    };
    knots.windows(2).filter(wide).map(cell).collect()
}

/// 0, the zeros inside `(0, 1)`, and 1: so many bits that neighbours are told apart.
fn ends(zeros: &Zeros) -> Vec<Rational> {
    let mut bits = BITS;
    let mut found = zeros.enclosed(bits);
    let close = |found: &[(Rational, Rational)], bits: u32| {
        found.windows(2).any(|pair| {
            let gap = &pair[1].0 - &pair[0].1;
            let fine = power_of_two(i64::from(SPARE) - i64::from(bits));
            !gap.is_positive() || gap < &pair[1].0 * fine
        })
    };
    while close(&found, bits) && bits < MOST_BITS {
        bits *= 2;
        found = zeros.enclosed(bits);
    }
    let inside = found.into_iter().map(|(lower, upper)| (lower + upper) / integer(2));
    std::iter::once(integer(0)).chain(inside).chain([integer(1)]).collect()
}
