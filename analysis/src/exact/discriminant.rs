//! Where a polynomial in two variables has a multiple root in one of them.

use crate::exact::modular::{BITS_PER_PRIME, PrimeField, Reconstruction};
use crate::exact::polynomial::Polynomial;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// What a discriminant costs: counts, known before the work is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DiscriminantCost {
    /// Primes that Hadamard's bound asks for.
    pub primes: usize,
    /// Values of `t` looked at for each prime.
    pub points: usize,
    /// Products of residues in one of Euclid's algorithms, about `2 n²`.
    pub products: usize,
}

impl DiscriminantCost {
    /// Products of residues in all.
    pub fn total(&self) -> usize {
        self.primes * self.points * self.products
    }
}

/// `P(s, t) = Σ_j t^j p_j(s)` of degree `n` in `s`, prepared for its discriminant in `s`.
///
/// The discriminant is the determinant of Sylvester's matrix of `P` and `∂P/∂s`, divided by the leading
/// coefficient: a polynomial in `t` of degree at most `(2n − 2) deg_t P` that vanishes wherever
/// `P(·, t)` has a multiple root. It is computed modulo primes at many `t` by Euclid's algorithm,
/// interpolated, and put together by Chinese remainders; Hadamard's bound on the matrix says
/// how many primes make that exact.
///
/// ```
/// use courant_analysis::exact::discriminant::Bivariate;
/// use courant_analysis::exact::polynomial::Polynomial;
/// // t − 4s + 3s²: a double root where 16 − 12t = 0
/// let p = |values: &[i64]| Polynomial::new(values.iter().map(|&v| v.into()).collect());
/// let discriminant = Bivariate::new(vec![p(&[0, -4, 3]), p(&[1])]).discriminant();
/// assert_eq!(discriminant, p(&[-4, 3]));
/// ```
#[derive(Debug, Clone)]
pub struct Bivariate {
    powers: Vec<Polynomial<BigInt>>,
    degree: usize,
}

impl Bivariate {
    /// From `[p_0, p_1, …]`.
    pub fn new(powers: Vec<Polynomial<BigInt>>) -> Self {
        let content =
            powers.iter().flat_map(Polynomial::coefficients).fold(BigInt::zero(), common_divisor);
        let degree = powers.iter().filter_map(Polynomial::degree).max().unwrap_or(0);
        // Where it is zero there is no coefficient.
        let powers = powers.iter().map(|power| power.map(|value| value / &content)).collect();
        Self { powers, degree }
    }

    /// What [`discriminant`](Self::discriminant) will cost.
    pub fn cost(&self) -> DiscriminantCost {
        let (n, degree_in_t) = (self.degree, self.powers.len().saturating_sub(1));
        let norm: BigInt =
            self.powers.iter().flat_map(Polynomial::coefficients).map(Signed::abs).sum();
        // The determinant is at most the product of the l1 norms of the rows: n − 1 rows of P and n rows
        // of its derivative, at most n times as large; the first column, divided by the leading
        // coefficient, adds 1 and n. One bit more for the sign.
        let row = (norm + 1u32).bits();
        let derived_row = row + u64::from((n.max(1)).ilog2()) + 1;
        let bits = n.saturating_sub(1) as u64 * row + n as u64 * derived_row + 1;
        DiscriminantCost {
            primes: bits.div_ceil(BITS_PER_PRIME) as usize,
            points: (2 * n).saturating_sub(2) * degree_in_t + 1,
            products: 2 * n * n,
        }
    }

    /// The discriminant in `s` divided by its content; zero when `P` has a repeated factor for every `t`.
    pub fn discriminant(&self) -> Polynomial<BigInt> {
        if self.degree < 2 {
            return Polynomial::one();
        }
        let cost = self.cost();
        let mut reconstruction: Option<Reconstruction> = None;
        let images = PrimeField::descending()
            .filter_map(|field| self.image(&field, cost.points).map(|image| (field, image)));
        for (field, image) in images.take(cost.primes) {
            match reconstruction.as_mut() {
                Some(reconstruction) => reconstruction.extend(&field, &image),
                None => reconstruction = Some(Reconstruction::new(&field, &image)),
            }
        }
        let integers = reconstruction.map_or_else(Vec::new, |images| images.integers());
        primitive(&Polynomial::new(integers))
    }

    /// The coefficients of the discriminant modulo a prime; `None` when the prime divides the leading
    /// coefficient for every `t`.
    fn image(&self, field: &PrimeField, points: usize) -> Option<Vec<u64>> {
        let powers: Vec<Vec<u64>> = self
            .powers
            .iter()
            .map(|power| (0..=self.degree).map(|i| field.embed(&power.coefficient(i))).collect())
            .collect();
        if powers.iter().all(|power| power[self.degree] == 0) {
            return None;
        }
        let value_at = |node: usize| -> Option<(usize, u64)> {
            let t = field.embed(&node.into());
            let at_t: Vec<u64> = (0..=self.degree)
                .map(|i| {
                    powers
                        .iter()
                        .rev()
                        .fold(0, |sum, power| field.add(field.multiply(sum, t), power[i]))
                })
                .collect();
            // Where the leading coefficient vanishes the degrees are not those of the matrix.
            (at_t[self.degree] != 0).then(|| (node, discriminant_modulo(field, at_t)))
        };
        let (nodes, values): (Vec<_>, _) = (0..).filter_map(value_at).take(points).unzip();
        Some(interpolate(field, &nodes, values))
    }
}

/// `Res(f, f')/lc(f)` modulo a prime above the degree, up to a sign that depends on the degree alone.
fn discriminant_modulo(field: &PrimeField, polynomial: Vec<u64>) -> u64 {
    let mut factor = 0;
    let derivative: Vec<u64> = polynomial
        .iter()
        .map(|&value| {
            let derived = field.multiply(value, factor);
            factor = field.add(factor, field.one());
            derived
        })
        .skip(1)
        .collect();
    let leading = polynomial[polynomial.len() - 1];
    let (mut a, mut b) = (polynomial, derivative);
    // With r = lc(b)^{m − n + 1} a mod b, which needs no inverse,
    // Res(a, b) = (−1)^{mn} lc(b)^{m − deg r − n (m − n + 1)} Res(b, r).
    let (mut numerator, mut denominator) = (field.one(), leading);
    while b.len() > 1 {
        let (m, n) = (a.len() - 1, b.len() - 1);
        let rest = field.pseudo_remainder(a, &b);
        if rest.is_empty() {
            return 0;
        }
        if m * n % 2 == 1 {
            numerator = field.subtract(0, numerator);
        }
        let leading = b[n];
        let power = |exponent: usize| field.power(leading, exponent as u64);
        numerator = field.multiply(numerator, power(m + 1 - rest.len()));
        denominator = field.multiply(denominator, power(n * (m - n + 1)));
        (a, b) = (b, rest);
    }
    numerator = field.multiply(numerator, field.power(b[0], (a.len() - 1) as u64));
    field.multiply(numerator, field.inverse(denominator))
}

/// The polynomial with these values at ascending whole numbers, by Newton's divided differences.
fn interpolate(field: &PrimeField, nodes: &[usize], mut values: Vec<u64>) -> Vec<u64> {
    let count = nodes.len();
    let farthest = nodes.last().map_or(0, |last| last - nodes[0]);
    // No two nodes are 0 apart.
    let inverses: Vec<u64> =
        (0..=farthest).map(|distance| field.inverse(field.embed(&distance.into()))).collect();
    for level in 1..count {
        for i in (level..count).rev() {
            let rise = field.subtract(values[i], values[i - 1]);
            values[i] = field.multiply(rise, inverses[nodes[i] - nodes[i - level]]);
        }
    }
    let mut coefficients: Vec<u64> = Vec::with_capacity(count);
    for (&node, &difference) in nodes.iter().zip(&values).rev() {
        // Multiply by (t − node), then add.
        let node = field.embed(&node.into());
        coefficients.insert(0, 0);
        for i in 0..coefficients.len() - 1 {
            let product = field.multiply(node, coefficients[i + 1]);
            coefficients[i] = field.subtract(coefficients[i], product);
        }
        coefficients[0] = field.add(coefficients[0], difference);
    }
    coefficients
}

/// The remainder first: the binary algorithm is slow on numbers of very different length.
fn common_divisor(content: BigInt, value: &BigInt) -> BigInt {
    if content.is_zero() { value.clone() } else { (value % &content).gcd(&content) }
}

/// Divided by the content, with a positive leading coefficient.
pub(crate) fn primitive(polynomial: &Polynomial<BigInt>) -> Polynomial<BigInt> {
    let coefficients = polynomial.coefficients();
    let Some(leading) = coefficients.last() else { return Polynomial::zero() };
    let content = coefficients.iter().fold(BigInt::zero(), common_divisor);
    let content = if leading.is_negative() { -content } else { content };
    polynomial.map(|value| value / &content)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{Rational, integer};
    use proptest::prelude::*;

    /// The determinant of Sylvester's matrix at one `t`, by elimination with fractions.
    fn resultant_at(powers: &[Polynomial<BigInt>], degree: usize, t: i64) -> Rational {
        let value = powers.iter().rev().fold(Polynomial::<Rational>::zero(), |sum, power| {
            sum.scale(&integer(t)) + power.map(|v| Rational::from(v.clone()))
        });
        let derivative = value.derivative();
        let size = 2 * degree - 1;
        let mut rows: Vec<Vec<Rational>> = (0..size)
            .map(|row| {
                let (source, shift, top) = if row < degree - 1 {
                    (&value, row, degree)
                } else {
                    (&derivative, row - (degree - 1), degree - 1)
                };
                (0..size)
                    .map(|column| match column.checked_sub(shift) {
                        Some(index) if index <= top => source.coefficient(top - index),
                        _ => Rational::zero(),
                    })
                    .collect()
            })
            .collect();
        let mut determinant = integer(1);
        for column in 0..size {
            let Some(pivot) = (column..size).find(|&row| !rows[row][column].is_zero()) else {
                return Rational::zero();
            };
            if pivot != column {
                rows.swap(pivot, column);
                determinant = -determinant;
            }
            determinant *= rows[column][column].clone();
            for row in column + 1..size {
                let factor = &rows[row][column] / &rows[column][column];
                let (above, below) = rows.split_at_mut(row);
                for (target, value) in below[0].iter_mut().zip(&above[column]).skip(column) {
                    *target -= &factor * value;
                }
            }
        }
        determinant
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn it_is_the_determinant_of_sylvester(
            values in prop::collection::vec(prop::collection::vec(-50i64..50, 2..6), 1..4)
        ) {
            let powers: Vec<Polynomial<BigInt>> = values
                .iter()
                .map(|row| Polynomial::new(row.iter().map(|&v| v.into()).collect()))
                .collect();
            let bivariate = Bivariate::new(powers.clone());
            let degree = bivariate.degree;
            prop_assume!(degree >= 2);
            let found = bivariate.discriminant().map(|v| Rational::from(v.clone()));
            // Both are polynomials in t; up to one factor they agree at every t.
            let leading = |t: i64| -> Rational {
                powers.iter().rev().fold(integer(0), |sum, power| {
                    sum * integer(t) + Rational::from(power.coefficient(degree))
                })
            };
            let mut factor: Option<Rational> = None;
            for t in -20..20 {
                let expected = resultant_at(&powers, degree, t);
                let stated = found.evaluate(&integer(t)) * leading(t);
                prop_assert_eq!(expected.is_zero(), stated.is_zero(), "t = {}", t);
                if !stated.is_zero() {
                    let quotient = expected / stated;
                    prop_assert_eq!(factor.get_or_insert_with(|| quotient.clone()).clone(), quotient);
                }
            }
        }

        #[test]
        fn a_repeated_factor_gives_zero(a in -9i64..9, b in 1i64..9, c in -9i64..9) {
            // (a + b s + t)² (c + s) = Σ t^j p_j(s)
            let line = Polynomial::new(vec![BigInt::from(a), BigInt::from(b)]);
            let other = Polynomial::new(vec![BigInt::from(c), BigInt::one()]);
            let powers = vec![
                line.pow(2) * other.clone(),
                line.scale(&2.into()) * other.clone(),
                other,
            ];
            prop_assert!(Bivariate::new(powers).discriminant().is_zero());
        }
    }

    #[test]
    fn degrees_that_drop_by_two_change_the_sign() {
        // Of s⁴ + q s + r it is 256 r³ − 27 q⁴, up to its sign; only where q is not zero do the degrees go 4, 3, 1.
        let p = |values: &[i64]| Polynomial::new(values.iter().map(|&v| v.into()).collect());
        let found = Bivariate::new(vec![p(&[1, 0, 0, 0, 1]), p(&[0, 1])]).discriminant();
        assert_eq!(found, p(&[-256, 0, 0, 0, 27]));
        // Of s³ + t s + 1 it is 4t³ + 27: the degrees go 3, 2, 1, at 0 they go 3, 2, 0.
        let found = Bivariate::new(vec![p(&[1, 0, 0, 1]), p(&[0, 1])]).discriminant();
        assert_eq!(found, p(&[27, 0, 0, 4]));
    }

    #[test]
    fn the_cost_is_counted_beforehand() {
        let p = |values: &[i64]| Polynomial::new(values.iter().map(|&v| v.into()).collect());
        let cost = Bivariate::new(vec![p(&[1, 2, 3, 4]), p(&[4, 3, 2, 1])]).cost();
        assert_eq!(cost, DiscriminantCost { primes: 1, points: 5, products: 18 });
        assert_eq!(cost.total(), 90);
        // Of what is common to all coefficients nothing is said.
        let large = BigInt::from(7).pow(50);
        let scaled = [p(&[1, 2, 3, 4]), p(&[4, 3, 2, 1])].map(|one| one.scale(&large));
        assert_eq!(Bivariate::new(scaled.to_vec()).cost(), cost);
        assert!(Bivariate::new(vec![p(&[])]).cost().total() < 9);
    }

    #[test]
    fn a_prime_that_divides_the_leading_coefficient_is_passed_over() {
        // (p s)² + s + t for the largest prime p: 1 − 4p² t, and 2s + 1 with a positive first coefficient.
        let square = BigInt::from(PrimeField::largest().prime()).pow(2);
        let of = |values: [BigInt; 3]| Polynomial::new(values.to_vec());
        let powers =
            vec![of([0.into(), 1.into(), square.clone()]), of([1.into(), 0.into(), 0.into()])];
        let expected = Polynomial::new(vec![BigInt::from(-1), square * 4]);
        assert_eq!(Bivariate::new(powers).discriminant(), expected);
        let p = |values: &[i64]| Polynomial::new(values.iter().map(|&v| v.into()).collect());
        assert_eq!(primitive(&p(&[-2, -4])), p(&[1, 2]));
        assert_eq!(primitive(&p(&[-2, 4])), p(&[-1, 2]));
    }
}
