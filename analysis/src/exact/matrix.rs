//! Square matrices of Laurent polynomials: elimination by units, determinants.

use crate::exact::laurent::{Laurent, VARIABLES};
use crate::interest::Interest;
use num_traits::Zero;

/// A matrix by rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Matrix {
    rows: Vec<Vec<Laurent>>,
}

/// The largest matrix whose determinant is expanded; `2^m m` products.
pub const MOST_ROWS: usize = 12;

impl Matrix {
    /// From rows of equal length.
    pub fn new(rows: Vec<Vec<Laurent>>) -> Self {
        Self { rows }
    }

    /// The zero matrix.
    pub fn zero(rows: usize, columns: usize) -> Self {
        Self { rows: vec![vec![Laurent::default(); columns]; rows] }
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<Laurent>] {
        &self.rows
    }

    /// An entry that can be changed.
    pub fn entry(&mut self, row: usize, column: usize) -> &mut Laurent {
        &mut self.rows[row][column]
    }

    /// How many rows there are.
    pub fn size(&self) -> usize {
        self.rows.len()
    }

    /// Every entry passed through `change`.
    pub fn map(&self, change: impl Fn(&Laurent) -> Laurent) -> Self {
        Self { rows: self.rows.iter().map(|row| row.iter().map(&change).collect()).collect() }
    }

    /// Substitutes the unknowns `eliminable` wherever an equation gives one of them: an entry that is an integer times powers of `z`
    /// and `E`. The determinant changes by such a unit only. Returns the unknowns that are left.
    ///
    /// ```
    /// use courant_analysis::exact::{laurent::{Laurent, Variable}, matrix::Matrix};
    /// let (z, e) = (Laurent::variable(Variable::TIME), Laurent::variable(Variable::axis(0)));
    /// // p = E u;  z u = p:  z − E.
    /// let one = Laurent::integer(1);
    /// let mut matrix = Matrix::new(vec![vec![-e.clone(), one.clone()], vec![z.clone(), -one]]);
    /// assert_eq!(matrix.substitute(&[1]), [0]);
    /// assert_eq!(matrix.determinant(), z - e);
    /// ```
    pub fn substitute(&mut self, eliminable: &[usize]) -> Vec<usize> {
        let mut columns: Vec<usize> = (0..self.rows.first().map_or(0, Vec::len)).collect();
        let mut candidates = eliminable.to_vec();
        while let Some((place, row, column)) = self.cheapest_unit(&candidates, &columns) {
            let column_place = columns.iter().position(|&c| c == column).unwrap_or(0);
            let pivot_row = self.rows.remove(row);
            let pivot = pivot_row[column_place].clone();
            for row in &mut self.rows {
                let factor = std::mem::take(&mut row[column_place]);
                if factor.is_zero() {
                    continue;
                }
                for (entry, value) in row.iter_mut().zip(&pivot_row) {
                    *entry = &*entry * &pivot - &factor * value;
                }
            }
            for row in &mut self.rows {
                row.remove(column_place);
                reduce(row);
            }
            columns.remove(column_place);
            candidates.remove(place);
        }
        columns
    }

    /// The unit entry of a candidate whose row and column have the fewest terms.
    fn cheapest_unit(
        &self,
        candidates: &[usize],
        columns: &[usize],
    ) -> Option<(usize, usize, usize)> {
        let mut best: Option<(usize, (usize, usize, usize))> = None;
        for (place, &column) in candidates.iter().enumerate() {
            let at = columns.iter().position(|&c| c == column)?;
            for (row, entries) in self.rows.iter().enumerate() {
                let is_unit = entries[at]
                    .as_monomial()
                    .is_some_and(|(exponents, _)| exponents[4..VARIABLES].iter().all(|&e| e == 0));
                if !is_unit {
                    continue;
                }
                let in_row: usize = entries.iter().map(|entry| entry.terms().len()).sum();
                let in_column: usize = self.rows.iter().map(|row| row[at].terms().len()).sum();
                let cost = (in_row - 1) * (in_column - 1);
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, (place, row, column)));
                }
            }
        }
        best.map(|(_, found)| found)
    }

    /// The determinant, by minors of the first rows: no divisions.
    ///
    /// # Panics
    /// When it is not square, or has more than [`MOST_ROWS`] rows.
    pub fn determinant(&self) -> Laurent {
        self.determinant_while(&Interest::default())
    }

    /// [`determinant`](Self::determinant), and zero once nobody wants it.
    pub(crate) fn determinant_while(&self, interest: &Interest) -> Laurent {
        let size = self.size();
        assert!(size <= MOST_ROWS && self.rows.iter().all(|row| row.len() == size));
        // minors[set]: the determinant of the first |set| rows and the columns of the set.
        let mut minors = vec![Laurent::default(); 1 << size];
        minors[0] = Laurent::integer(1);
        for set in 1usize..1 << size {
            let row = set.count_ones() as usize - 1;
            let mut sum = Laurent::default();
            let mut sign = row.is_multiple_of(2);
            for column in (0..size).filter(|column| set & (1 << column) != 0) {
                if interest.is_lost() {
                    return Laurent::default();
                }
                let entry = &self.rows[row][column];
                let minor = &minors[set & !(1 << column)];
                if !entry.is_zero() && !minor.is_zero() {
                    let product = entry * minor;
                    sum = if sign { sum + product } else { sum - product };
                }
                sign = !sign;
            }
            minors[set] = sum;
        }
        minors.pop().unwrap_or_default()
    }
}

/// Divides a row by the integer that all its entries share.
fn reduce(row: &mut [Laurent]) {
    use num_integer::Integer;
    let content =
        row.iter().fold(num_bigint::BigInt::zero(), |all, entry| all.gcd(&entry.integer_content()));
    if content > 1.into() {
        let content = Laurent::constant(content);
        for entry in row {
            *entry = entry.divide_exactly(&content).expect("the content divides");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::laurent::Variable;
    use proptest::prelude::*;

    fn entry() -> impl Strategy<Value = Laurent> {
        prop::collection::vec((-1i64..2, -1i16..2, 0i16..2), 0..3).prop_map(|terms| {
            terms.into_iter().fold(Laurent::default(), |sum, (value, e, z)| {
                sum + Laurent::integer(value)
                    .shifted(Variable::axis(0), e)
                    .shifted(Variable::TIME, z)
            })
        })
    }

    proptest! {
        #[test]
        fn substitution_keeps_the_determinant_up_to_a_unit(
            entries in prop::collection::vec(entry(), 9), rows in prop::collection::vec(entry(), 3)
        ) {
            // A fourth unknown given by the others.
            let mut whole: Vec<Vec<Laurent>> = entries.chunks(3).map(<[Laurent]>::to_vec).collect();
            for (row, value) in whole.iter_mut().zip(&rows) {
                row.push(value.clone());
            }
            let mut last: Vec<Laurent> = rows.iter().rev().cloned().collect();
            last.push(Laurent::integer(2).shifted(Variable::TIME, 1));
            whole.push(last);
            let full = Matrix::new(whole.clone()).determinant();
            let mut smaller = Matrix::new(whole);
            let left = smaller.substitute(&[3]);
            prop_assert_eq!(left, [0, 1, 2]);
            let found = smaller.determinant().primitive();
            let full = full.primitive();
            prop_assert!(found == full || found == -full);
        }

        #[test]
        fn unknowns_leave_where_an_entry_is_a_unit(entries in prop::collection::vec(entry(), 16), name in 0usize..17) {
            let mut whole: Vec<Vec<Laurent>> = entries.chunks(4).map(<[Laurent]>::to_vec).collect();
            // A parameter is no unit.
            if let Some(entry) = whole.iter_mut().flatten().nth(name) {
                *entry = Laurent::variable(Variable::name(0));
            }
            let full = Matrix::new(whole.clone()).determinant();
            let mut smaller = Matrix::new(whole.clone());
            let left = smaller.substitute(&[1, 3]);
            prop_assert!(left.contains(&0) && left.contains(&2) && smaller.size() == left.len());
            let is_unit = |p: &Laurent| p.as_monomial().is_some_and(|(e, _)| e[4..].iter().all(|&e| e == 0));
            let any = |column: usize| whole.iter().any(|row| is_unit(&row[column]));
            prop_assert_eq!(left.len() < 4, any(1) || any(3));
            let (found, full) = (smaller.determinant().primitive(), full.primitive());
            prop_assert!(found == full || found == -full);
        }

        #[test]
        fn a_product_has_the_product_of_the_determinants(
            a in prop::collection::vec(entry(), 9), b in prop::collection::vec(entry(), 9)
        ) {
            let product: Vec<Vec<Laurent>> = (0..3).map(|i| (0..3).map(|j| {
                (0..3).fold(Laurent::default(), |sum, k| sum + &a[3 * i + k] * &b[3 * k + j])
            }).collect()).collect();
            let of = |values: &[Laurent]| {
                Matrix::new(values.chunks(3).map(<[Laurent]>::to_vec).collect()).determinant()
            };
            prop_assert_eq!(Matrix::new(product).determinant(), &of(&a) * &of(&b));
        }
    }
}
