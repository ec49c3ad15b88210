//! Bernstein coefficients in a fixed unit, cut off downwards: halving by de Casteljau, and the sign that follows.

use super::{Sign, Work};
use crate::exact::rational::Rational;
use crate::interest::Interest;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::VecDeque;
use std::ops::AddAssign;

/// How many bits the Bernstein coefficients of this degree may exceed the polynomial by.
pub(super) fn amplification(degree: usize) -> i64 {
    3 * degree as i64 / 2
}

/// What fixed point is made of: long integers, or machine integers where they suffice.
pub(super) trait Fixed:
    Signed + Clone + Default + Ord + From<i32> + for<'a> AddAssign<&'a Self>
{
    /// `⌊self/2^bits⌋`.
    fn halved(self, bits: usize) -> Self;
}

impl Fixed for i128 {
    fn halved(self, bits: usize) -> Self {
        self >> bits
    }
}

impl Fixed for BigInt {
    fn halved(self, bits: usize) -> Self {
        self >> bits
    }
}

/// Whether the polynomial with these Bernstein coefficients over `0 ≤ s ≤ 1` and a range of `t`, `[index in t][index in s]`, each cut
/// off downwards by less than one unit, is nowhere negative. `None` where rounding alone may make a corner negative, if that is to stop it.
pub(super) fn nowhere_negative<T: Fixed>(
    first: Vec<Vec<T>>,
    [from, to]: [&Rational; 2],
    max_boxes: usize,
    stops_at_doubts: bool,
    interest: &Interest,
) -> Option<(Sign, Work)> {
    let mut work = Work::default();
    // Boxes with the left end of their s-interval in units of 2^−depth, coarse ones first: a
    // counterexample elsewhere is met before a touching zero is pursued without end.
    let mut pending = VecDeque::from([(first, BigInt::zero(), 0)]);
    while let Some((current, left_end, depth)) = pending.pop_front() {
        work.boxes += 1;
        if current.iter().flatten().all(|value| !value.is_negative()) {
            continue;
        }
        // Each of the `depth + 1` roundings lowered a number by less than one unit.
        let rounding = -T::from(depth + 1);
        let corners = [(&current[0], from), (&current[current.len() - 1], to)];
        for (row, t) in corners {
            for (value, step) in [(&row[0], 0), (&row[row.len() - 1], 1)] {
                if *value < rounding {
                    let s = Rational::new(&left_end + step, BigInt::one() << depth);
                    let corner = Sign::SomewhereNegative {
                        phase_parameter: s,
                        courant_parameter: t.clone(),
                    };
                    return Some((corner, work));
                }
                if stops_at_doubts && value.is_negative() {
                    return None;
                }
            }
        }
        if work.boxes + pending.len() + 2 > max_boxes || interest.is_lost() {
            return Some((Sign::Undecided, work));
        }
        let (left, right) = halve(current, |sum, _, level| sum.halved(level));
        let first: BigInt = left_end << 1;
        pending.push_back((left, first.clone(), depth + 1));
        pending.push_back((right, first + 1, depth + 1));
    }
    Some((Sign::NowhereNegative, work))
}

/// The halves at the middle of the `s`-interval by de Casteljau's algorithm on every row. Sums are taken
/// instead of means: `scale` gets a final one with the degree and with its level `r`, at which it is `2^r`
/// times the true coefficient.
pub(super) fn halve<T: Clone + Default + for<'a> AddAssign<&'a T>>(
    mut rows: Vec<Vec<T>>,
    scale: impl Fn(T, usize, usize) -> T,
) -> (Vec<Vec<T>>, Vec<Vec<T>>) {
    let mut left_rows = Vec::with_capacity(rows.len());
    for row in &mut rows {
        let degree = row.len() - 1;
        let mut left = Vec::with_capacity(row.len());
        for level in 0..=degree {
            left.push(scale(row[0].clone(), degree, level));
            for index in 0..degree - level {
                let (head, tail) = row.split_at_mut(index + 1);
                head[index] += &tail[0];
            }
            // The last sum of the level is final: the right half's coefficient.
            let last = &mut row[degree - level];
            *last = scale(std::mem::take(last), degree, level);
        }
        left_rows.push(left);
    }
    (left_rows, rows)
}
