//! Matrices of the checker, and their determinants.

use super::super::verify::{CertificateError, ensure};
use super::polynomial::Poly;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

pub type Whole = Poly<BigInt>;
pub type Matrix = Vec<Vec<Whole>>;

/// Solves equations for the unknowns `columns` where one stands with a number times powers of `z` and `E`; gives the unknowns left.
/// The determinant changes by such a factor only.
pub fn without_units(matrix: &mut Matrix, columns: &[usize]) -> Vec<usize> {
    let mut left: Vec<usize> = (0..matrix.first().map_or(0, Vec::len)).collect();
    let mut columns = columns.to_vec();
    loop {
        let mut best: Option<(usize, usize, usize, usize)> = None;
        for (i, row) in matrix.iter().enumerate() {
            let in_row = row.iter().filter(|entry| !entry.is_zero()).count();
            for &column in &columns {
                let Some(place) = left.iter().position(|&c| c == column) else { continue };
                if !row[place].is_unit() {
                    continue;
                }
                let in_column = matrix.iter().filter(|other| !other[place].is_zero()).count();
                let found = ((in_row - 1) * in_column, i, place, column);
                best = Some(best.map_or(found, |known| known.min(found)));
            }
        }
        let Some((_, i, place, column)) = best else { return left };
        let pivot_row = matrix.remove(i);
        for row in matrix.iter_mut() {
            if !row[place].is_zero() {
                let factor = row[place].clone();
                for (entry, value) in row.iter_mut().zip(&pivot_row) {
                    *entry = entry.times(&pivot_row[place]).minus(&factor.times(value));
                }
                reduce(row);
            }
            row.remove(place);
        }
        left.remove(place);
        columns.retain(|&other| other != column);
    }
}

/// Divides by the number that all entries share.
pub fn reduce(row: &mut [Whole]) {
    let values = row.iter().flat_map(|poly| poly.0.values());
    let common = values.fold(BigInt::zero(), |all, value| all.gcd(value));
    if common > BigInt::one() {
        row.iter_mut().flat_map(|poly| poly.0.values_mut()).for_each(|value| *value /= &common);
    }
}

/// By minors of the first rows, without divisions.
pub fn determinant(matrix: &Matrix) -> Result<Whole, CertificateError> {
    ensure(matrix.len() <= 12, "a determinant is too large")?;
    let mut minors: BTreeMap<usize, Whole> = [(0, Poly::one())].into();
    for row in matrix {
        let mut next: BTreeMap<usize, Whole> = BTreeMap::new();
        for (columns, minor) in &minors {
            for (column, entry) in row.iter().enumerate() {
                if columns >> column & 1 == 1 || entry.is_zero() || minor.is_zero() {
                    continue;
                }
                let term = entry.times(minor);
                let odd = (columns >> column).count_ones() % 2 == 1;
                let sum = next.entry(columns | 1 << column).or_default();
                let known = std::mem::take(sum);
                *sum = if odd { known.minus(&term) } else { known.plus(&term) };
            }
        }
        minors = next;
    }
    Ok(minors.remove(&((1 << matrix.len()) - 1)).unwrap_or_default())
}

/// The determinant up to a number times powers of `z` and `E`.
pub fn determinant_up_to_units(mut matrix: Matrix) -> Result<Whole, CertificateError> {
    if matrix.len() > 1 {
        let all: Vec<usize> = (0..matrix.len()).collect();
        without_units(&mut matrix, &all);
    }
    determinant(&matrix)
}
