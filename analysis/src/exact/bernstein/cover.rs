//! A cover of `0 ≤ s ≤ 1` by intervals on each of which no Bernstein coefficient is negative, with the
//! signs of all coefficients: exact, so that anybody can recompute them.

use super::MarginForm;
use super::fixed_point::halve;
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// An interval of `s` and the signs of the Bernstein coefficients of the margin above it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SignedBox {
    /// Where the interval begins.
    pub from: Rational,
    /// Where it ends.
    pub to: Rational,
    /// One string for each Bernstein index in `t`; in it one `+` or `0` for each index in `s`.
    pub signs: Vec<String>,
}

/// The cover over `from ≤ t ≤ to`, from left to right; `None` when `max_boxes` do not suffice (always
/// so when the polynomial is negative somewhere).
///
/// The same halving as in [`MarginForm::sign`], without cutting anything off.
pub fn exact_cover(
    form: &MarginForm,
    from: &Rational,
    to: &Rational,
    max_boxes: usize,
) -> Option<Vec<SignedBox>> {
    let all = form.binomials.iter().fold(BigInt::one(), |all, value| all.lcm(value));
    let factors: Vec<BigInt> = form.binomials.iter().map(|value| &all / value).collect();
    let mut first = form.scaled_box(from, to);
    for row in &mut first {
        row.iter_mut().zip(&factors).for_each(|(value, factor)| *value *= factor);
    }
    let mut cover = Vec::new();
    let mut pending = vec![(first, BigInt::zero(), 0u32)];
    while let Some((current, left_end, depth)) = pending.pop() {
        if current.iter().flatten().all(|value| !value.is_negative()) {
            let power = BigInt::one() << depth;
            cover.push(SignedBox {
                from: Rational::new(left_end.clone(), power.clone()),
                to: Rational::new(left_end + 1, power),
                signs: current.iter().map(|row| signs(row)).collect(),
            });
            continue;
        }
        let enough = cover.len() + pending.len() + 2 <= max_boxes && form.is_wanted();
        if !enough || is_negative_at_a_corner(&current) {
            return None;
        }
        // Both halves `2^degree` times too large, which changes no sign.
        let (left, right) = halve(current, |sum, degree, level| sum << (degree - level));
        let first = left_end << 1;
        pending.push((right, &first + 1, depth + 1));
        pending.push((left, first, depth + 1));
    }
    Some(cover)
}

fn signs(row: &[BigInt]) -> String {
    row.iter().map(|value| if value.is_zero() { '0' } else { '+' }).collect()
}

fn is_negative_at_a_corner(rows: &[Vec<BigInt>]) -> bool {
    let ends = rows.first().into_iter().chain(rows.last());
    ends.flat_map(|row| row.first().into_iter().chain(row.last())).any(Signed::is_negative)
}
