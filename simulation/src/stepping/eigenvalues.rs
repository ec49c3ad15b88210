//! Eigenvalues of small complex matrices.

use num_complex::Complex64;

/// The eigenvalues of a matrix given by rows, in no particular order; not a number where the matrix holds one, or where the iteration
/// does not end.
///
/// Hessenberg form by reflections, then QR steps with Wilkinson's shift (Golub & Van Loan 2013, chapter 7): each is exact for a
/// matrix within a few `ε ‖A‖`.
///
/// ```
/// use num_complex::Complex64;
/// let turn = [[0.0, -1.0], [1.0, 0.0]].map(|row| row.map(Complex64::from).to_vec());
/// for value in courant_simulation::stepping::eigenvalues(&turn) {
///     assert!((value * value + 1.0).norm() < 1e-15);   // i and −i
/// }
/// ```
pub fn eigenvalues(matrix: &[Vec<Complex64>]) -> Vec<Complex64> {
    let mut a = matrix.to_vec();
    let size = a.len();
    let unknown = Complex64::new(f64::NAN, f64::NAN);
    if a.iter().flatten().any(|entry| !entry.is_finite()) {
        return vec![unknown; size];
    }
    to_hessenberg(&mut a);
    let mut found = vec![unknown; size];
    let mut end = size;
    let mut rounds = 0;
    while end > 0 {
        let start = (1..end).rev().find(|&row| is_negligible(&a, row)).unwrap_or(0);
        if start + 1 == end {
            end -= 1;
            found[end] = a[end][end];
            rounds = 0;
            continue;
        }
        rounds += 1;
        if rounds > 60 {
            return vec![unknown; size];
        }
        // Now and then another shift, against cycles.
        let shift = match rounds % 11 {
            10 => a[end - 1][end - 1] + a[end - 1][end - 2].norm(),
            _ => wilkinson(&a, end),
        };
        qr_step(&mut a, start, end, shift);
    }
    found
}

/// Whether the entry left of the diagonal is round-off; then it is made zero for good.
fn is_negligible(a: &[Vec<Complex64>], row: usize) -> bool {
    let around = a[row - 1][row - 1].norm() + a[row][row].norm();
    let around = if around > 0.0 {
        around
    } else {
        a.iter().flatten().map(|e| e.norm()).fold(0.0, f64::max)
    };
    a[row][row - 1].norm() <= f64::EPSILON * around
}

/// The eigenvalue of the last two rows that is nearer to the last entry.
fn wilkinson(a: &[Vec<Complex64>], end: usize) -> Complex64 {
    let [p, q] = [a[end - 2][end - 2], a[end - 2][end - 1]];
    let [r, s] = [a[end - 1][end - 2], a[end - 1][end - 1]];
    let half = (p - s) / 2.0;
    let root = (half * half + q * r).sqrt();
    let larger =
        if (half + root).norm() >= (half - root).norm() { half + root } else { half - root };
    if larger.norm() == 0.0 { s } else { s - q * r / larger }
}

/// Zeros below the first subdiagonal, by reflections from both sides.
fn to_hessenberg(a: &mut [Vec<Complex64>]) {
    let size = a.len();
    for column in 0..size.saturating_sub(2) {
        let mut reflector: Vec<Complex64> = (column + 1..size).map(|row| a[row][column]).collect();
        let length = reflector.iter().map(|entry| entry.norm_sqr()).sum::<f64>().sqrt();
        if reflector[1..].iter().all(|entry| entry.norm() == 0.0) {
            continue;
        }
        let first = reflector[0];
        let phase =
            if first.norm() > 0.0 { first / first.norm() } else { Complex64::new(1.0, 0.0) };
        reflector[0] += phase * length;
        let square: f64 = reflector.iter().map(|entry| entry.norm_sqr()).sum();
        let mut products = vec![Complex64::default(); size];
        for (v, row) in reflector.iter().zip(&a[column + 1..]) {
            products.iter_mut().zip(row).for_each(|(sum, entry)| *sum += v.conj() * entry);
        }
        for (v, row) in reflector.iter().zip(&mut a[column + 1..]) {
            let changes = products.iter().map(|product| v * product * (2.0 / square));
            row.iter_mut().zip(changes).for_each(|(entry, change)| *entry -= change);
        }
        for row in a.iter_mut() {
            let product: Complex64 =
                reflector.iter().enumerate().map(|(k, v)| row[column + 1 + k] * v).sum();
            for (k, v) in reflector.iter().enumerate() {
                row[column + 1 + k] -= product * v.conj() * (2.0 / square);
            }
        }
    }
}

/// `A − σ = QR`, `A := RQ + σ` on the rows from `start` to `end`.
fn qr_step(a: &mut [Vec<Complex64>], start: usize, end: usize, shift: Complex64) {
    let shifted = |a: &mut [Vec<Complex64>], by: Complex64| {
        a.iter_mut().enumerate().take(end).skip(start).for_each(|(place, row)| row[place] += by);
    };
    shifted(a, -shift);
    let mut rotations = Vec::with_capacity(end - start);
    for row in start..end - 1 {
        let (x, y) = (a[row][row], a[row + 1][row]);
        let length = x.norm().hypot(y.norm());
        let (c, s) =
            if length > 0.0 { (x / length, y / length) } else { (Complex64::new(1.0, 0.0), y) };
        let (above, below) = a.split_at_mut(row + 1);
        let pairs = above[row].iter_mut().zip(&mut below[0]);
        for (upper, lower) in pairs.take(end).skip(row) {
            let turned = c.conj() * *upper + s.conj() * *lower;
            *lower = c * *lower - s * *upper;
            *upper = turned;
        }
        rotations.push((c, s));
    }
    for (row, (c, s)) in (start..).zip(rotations) {
        for line in a.iter_mut().take((row + 2).min(end)).skip(start) {
            let (left, right) = (line[row], line[row + 1]);
            line[row] = left * c + right * s;
            line[row + 1] = right * c.conj() - left * s.conj();
        }
    }
    shifted(a, shift);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sorted(mut values: Vec<Complex64>) -> Vec<Complex64> {
        values.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
        values
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// The companion matrix of `Π (z − z_i)`, mixed by a similarity, has the `z_i` back.
        #[test]
        fn the_roots_of_a_polynomial_come_back(
            roots in prop::collection::vec((-9i32..10, -9i32..10), 1..6),
            mix in prop::collection::vec(-3i32..4, 25),
        ) {
            let mut roots: Vec<_> =
                roots.iter().map(|&(x, y)| Complex64::new(f64::from(x), f64::from(y)) / 4.0).collect();
            roots = sorted(roots);
            roots.dedup();
            let size = roots.len();
            let mut polynomial = vec![Complex64::new(1.0, 0.0)];
            for root in &roots {
                polynomial.push(Complex64::new(0.0, 0.0));
                for place in (1..polynomial.len()).rev() {
                    let before = polynomial[place - 1];
                    polynomial[place] -= root * before;
                }
            }
            let zero = Complex64::new(0.0, 0.0);
            let mut a = vec![vec![zero; size]; size];
            for place in 0..size {
                a[0][place] = -polynomial[place + 1];
                if place > 0 {
                    a[place][place - 1] = Complex64::new(1.0, 0.0);
                }
            }
            // Rows and columns mixed by shears: exact similarities.
            for (number, factor) in mix.iter().enumerate() {
                let (i, j) = (number / 5 % size, number % size);
                if i != j {
                    let factor = f64::from(*factor) / 4.0;
                    let added = a[j].clone();
                    a[i].iter_mut().zip(added).for_each(|(entry, value)| *entry += value * factor);
                    for row in &mut a { let value = row[i]; row[j] -= value * factor; }
                }
            }
            let norm = a.iter().flatten().map(|e| e.norm()).fold(1.0, f64::max);
            let found = sorted(eigenvalues(&a));
            for root in &roots {
                let nearest = found.iter().map(|z| (z - root).norm()).fold(f64::MAX, f64::min);
                // Simple roots at distances of at least 1/4.
                prop_assert!(nearest < 1e-9 * norm.powi(size as i32), "{root} in {found:?}");
            }
        }
    }

    #[test]
    fn a_double_eigenvalue_is_found_to_half_the_digits() {
        let one = Complex64::new(1.0, 0.0);
        let found = eigenvalues(&[vec![2.0 * one, -one], vec![one, 0.0 * one]]);
        assert!(found.iter().all(|z| (z - one).norm() < 1e-7), "{found:?}");
    }

    #[test]
    fn a_shift_of_levels_has_zeros_and_what_is_no_number_stays_so() {
        let (zero, one) = (Complex64::new(0.0, 0.0), Complex64::new(1.0, 0.0));
        let nilpotent = [vec![zero, one, zero], vec![zero, zero, one], vec![zero, zero, zero]];
        assert_eq!(eigenvalues(&nilpotent), [zero; 3]);
        assert!(eigenvalues(&[vec![Complex64::new(f64::NAN, 0.0)]])[0].is_nan());
        assert!(eigenvalues(&[]).is_empty());
    }

    #[test]
    fn a_cycle_of_unit_shifts_ends() {
        // The companion of z⁴ = 1, on which unshifted steps turn in a circle.
        let mut a = vec![vec![Complex64::new(0.0, 0.0); 4]; 4];
        for place in 0..4 {
            a[(place + 1) % 4][place] = Complex64::new(1.0, 0.0);
        }
        let found = eigenvalues(&a);
        assert!(found.iter().all(|z| (z.powu(4) - 1.0).norm() < 1e-14), "{found:?}");
    }
}
