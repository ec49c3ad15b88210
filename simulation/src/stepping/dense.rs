//! Linear equations with a full matrix.

use num_complex::ComplexFloat;

/// A square matrix as a product of triangular ones, rows exchanged for the largest pivots.
#[derive(Debug, Clone)]
pub(super) struct Factors<T> {
    size: usize,
    /// Both triangles in one array, row by row.
    entries: Vec<T>,
    /// With which row each was exchanged.
    exchanged: Vec<usize>,
}

impl<T: ComplexFloat<Real = f64>> Factors<T> {
    /// Of a matrix given row by row; `None` where it is singular to round-off.
    pub fn new(size: usize, mut entries: Vec<T>) -> Option<Self> {
        let largest = entries.iter().map(|entry| entry.abs()).fold(0.0, f64::max);
        let least = 4.0 * size as f64 * f64::EPSILON * largest;
        let mut exchanged = Vec::with_capacity(size);
        for step in 0..size {
            let magnitude = |row: usize| entries[row * size + step].abs();
            let pivot = (step..size).max_by(|&a, &b| magnitude(a).total_cmp(&magnitude(b)))?;
            if magnitude(pivot).is_nan() || magnitude(pivot) <= least {
                return None;
            }
            exchanged.push(pivot);
            if pivot != step {
                for column in 0..size {
                    entries.swap(pivot * size + column, step * size + column);
                }
            }
            let (above, below) = entries.split_at_mut((step + 1) * size);
            let pivot_row = &above[step * size..];
            for row in below.chunks_exact_mut(size) {
                if row[step] == T::zero() {
                    continue;
                }
                let factor = row[step] / pivot_row[step];
                row[step] = factor;
                for column in step + 1..size {
                    row[column] = row[column] - factor * pivot_row[column];
                }
            }
        }
        Some(Self { size, entries, exchanged })
    }

    /// The solution in place of the right-hand side.
    pub fn solve(&self, values: &mut [T]) {
        for (row, &other) in self.exchanged.iter().enumerate() {
            values.swap(row, other);
        }
        for row in 0..self.size {
            let line = &self.entries[row * self.size..][..row];
            let known = line.iter().zip(&*values).fold(T::zero(), |sum, (&a, &x)| sum + a * x);
            values[row] = values[row] - known;
        }
        for row in (0..self.size).rev() {
            let line = &self.entries[row * self.size..][..self.size];
            let later = line.iter().zip(&*values).skip(row + 1);
            let known = later.fold(T::zero(), |sum, (&a, &x)| sum + a * x);
            values[row] = (values[row] - known) / line[row];
        }
    }

    /// The determinant.
    pub fn determinant(&self) -> T {
        (0..self.size).fold(T::one(), |product, step| {
            let pivot = self.entries[step * (self.size + 1)];
            product * if self.exchanged[step] == step { pivot } else { -pivot }
        })
    }

    /// The inverse, column by column.
    pub fn inverse_columns(&self) -> Vec<Vec<T>> {
        (0..self.size)
            .map(|place| {
                let mut column = vec![T::zero(); self.size];
                column[place] = T::one();
                self.solve(&mut column);
                column
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn what_is_solved_fulfils_the_equations(
            size in 1usize..9,
            numbers in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0), 81),
            right in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0), 9),
        ) {
            let complex = |&(re, im): &(f64, f64)| Complex64::new(re, im);
            let matrix: Vec<_> = numbers.iter().take(size * size).map(complex).collect();
            let right: Vec<_> = right.iter().take(size).map(complex).collect();
            if let Some(factors) = Factors::new(size, matrix.clone()) {
                let mut solution = right.clone();
                factors.solve(&mut solution);
                let scale: f64 = solution.iter().map(|x| x.norm()).sum::<f64>() + 1.0;
                for (row, wanted) in right.iter().enumerate() {
                    let line = &matrix[row * size..][..size];
                    let sum: Complex64 = line.iter().zip(&solution).map(|(a, x)| a * x).sum();
                    prop_assert!((sum - wanted).norm() < 1e-13 * scale);
                }
            }
        }
    }

    #[test]
    fn rows_are_exchanged_where_a_pivot_vanishes() {
        let factors = Factors::new(2, vec![0.0, 2.0, 4.0, 0.0]).unwrap();
        let mut values = [6.0, 8.0];
        factors.solve(&mut values);
        assert_eq!(values, [2.0, 3.0]);
        assert_eq!(factors.determinant(), -8.0);
        assert_eq!(factors.inverse_columns(), [vec![0.0, 0.5], vec![0.25, 0.0]]);
    }

    #[test]
    fn singular_matrices_are_refused() {
        assert!(Factors::new(2, vec![1.0, 2.0, 2.0, 4.0]).is_none());
        assert!(Factors::new(2, vec![0.1, 0.3, 0.3, 0.9]).is_none());
        assert!(Factors::new(1, vec![f64::NAN]).is_none());
        assert!(Factors::new(2, vec![1.0, 0.0, 0.0, 1e-9]).is_some());
    }
}
