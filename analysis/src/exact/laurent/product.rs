//! Products: exponents become one index in a box, and terms are added up there.

use super::{Exponents, Laurent, VARIABLES};
use num_bigint::BigInt;
use num_traits::{ToPrimitive, Zero};
use std::collections::HashMap;

/// Boxes up to this many cells are filled densely whatever the number of terms.
const SMALL_BOX: u128 = 1 << 12;

/// The box that holds all exponents of a product: the last variable runs fastest, so that the order of indices is the
/// order of exponents.
struct ExponentBox {
    lowest: Exponents,
    strides: [u128; VARIABLES],
    cells: u128,
}

impl ExponentBox {
    fn new(left: &Laurent, right: &Laurent) -> Self {
        let bounds = |polynomial: &Laurent| {
            let mut bounds = [(i16::MAX, i16::MIN); VARIABLES];
            for (exponents, _) in polynomial.terms() {
                for (bound, &power) in bounds.iter_mut().zip(exponents) {
                    *bound = (bound.0.min(power), bound.1.max(power));
                }
            }
            bounds
        };
        let (left, right) = (bounds(left), bounds(right));
        let mut lowest = [0; VARIABLES];
        let mut strides = [0; VARIABLES];
        let mut cells: u128 = 1;
        for variable in (0..VARIABLES).rev() {
            let (a, b) = (left[variable], right[variable]);
            lowest[variable] = a.0 + b.0;
            strides[variable] = cells;
            cells *= (i32::from(a.1) + i32::from(b.1) - i32::from(lowest[variable]) + 1) as u128;
        }
        Self { lowest, strides, cells }
    }

    /// The index of a term, measured from the least exponents of its own polynomial.
    fn indices(&self, polynomial: &Laurent) -> Vec<u128> {
        let lowest = polynomial.lowest_powers();
        let index = |exponents: &Exponents| {
            let mut index = 0;
            for ((power, lowest), stride) in exponents.iter().zip(lowest).zip(self.strides) {
                index += (i32::from(*power) - i32::from(lowest)) as u128 * stride;
            }
            index
        };
        polynomial.terms().iter().map(|(exponents, _)| index(exponents)).collect()
    }

    fn exponents(&self, mut index: u128) -> Exponents {
        let mut exponents = self.lowest;
        for (power, stride) in exponents.iter_mut().zip(self.strides) {
            *power += (index / stride) as i16;
            index %= stride;
        }
        exponents
    }

    fn gather(&self, terms: impl Iterator<Item = (u128, BigInt)>) -> Laurent {
        let kept = terms.filter(|(_, value)| !value.is_zero());
        Laurent::from_sorted(kept.map(|(index, value)| (self.exponents(index), value)).collect())
    }
}

/// `left · right`.
pub(super) fn product(left: &Laurent, right: &Laurent) -> Laurent {
    if left.is_zero() || right.is_zero() {
        return Laurent::default();
    }
    if let Some((exponents, value)) = left.as_monomial() {
        return times_monomial(right, exponents, value);
    }
    if let Some((exponents, value)) = right.as_monomial() {
        return times_monomial(left, exponents, value);
    }
    let cells = ExponentBox::new(left, right);
    let (rows, columns) = (cells.indices(left), cells.indices(right));
    let products = (rows.len() * columns.len()) as u128;
    let dense = cells.cells <= SMALL_BOX.max(4 * products);
    let bits = |polynomial: &Laurent| {
        polynomial.terms().iter().map(|(_, value)| value.bits()).max().unwrap_or(0)
    };
    let (left_bits, right_bits) = (bits(left), bits(right));
    let count_bits = u64::from(usize::BITS - rows.len().min(columns.len()).leading_zeros());
    if dense && left_bits + right_bits + count_bits < 127 {
        let small = |polynomial: &Laurent| -> Vec<i128> {
            let values = polynomial.terms().iter();
            values.map(|(_, value)| value.to_i128().expect("below 127 bits")).collect()
        };
        let (a, b) = (small(left), small(right));
        let mut sums = vec![0i128; cells.cells as usize];
        for (row, x) in rows.iter().zip(&a) {
            for (column, y) in columns.iter().zip(&b) {
                sums[(row + column) as usize] += x * y;
            }
        }
        return cells.gather((0..).zip(sums.into_iter().map(BigInt::from)));
    }
    let pairs = || {
        rows.iter().zip(left.terms()).flat_map(|(row, (_, x))| {
            columns.iter().zip(right.terms()).map(move |(column, (_, y))| (row + column, x * y))
        })
    };
    if dense {
        let mut sums = vec![BigInt::zero(); cells.cells as usize];
        pairs().for_each(|(index, value)| sums[index as usize] += value);
        return cells.gather((0..).zip(sums));
    }
    let mut sums: HashMap<u128, BigInt> = HashMap::new();
    pairs().for_each(|(index, value)| *sums.entry(index).or_default() += value);
    let mut sums: Vec<_> = sums.into_iter().collect();
    sums.sort_unstable_by_key(|(index, _)| *index);
    cells.gather(sums.into_iter())
}

fn times_monomial(polynomial: &Laurent, by: &Exponents, factor: &BigInt) -> Laurent {
    let terms = polynomial.terms().iter().map(|(exponents, value)| {
        let mut moved = *exponents;
        moved.iter_mut().zip(by).for_each(|(power, step)| *power += step);
        (moved, value * factor)
    });
    Laurent::from_sorted(terms.collect())
}
