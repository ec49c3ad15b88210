//! Squares that divide several integer polynomials at once, found modulo primes and verified exactly.
//!
//! A wave that a scheme leaves neutral at every Courant number — the zeros of the kernel's transform
//! on the lattice — makes all coefficients of the margin vanish together, and no amount of
//! subdivision decides the sign of a touching zero. Taking the common square out does.

use crate::exact::cosine_series::CosineSeries;
use crate::exact::modular::{PrimeField, Reconstruction};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Primes tried before a common divisor is given up; more than any common factor met here needs.
const MAX_PRIMES: usize = 64;

/// The largest `H`, monic, such that `H²` divides every polynomial; 1 when there is none.
///
/// ```
/// use courant_analysis::{exact::common_factor::common_square_root, exact::polynomial::Polynomial};
/// use courant_analysis::exact::rational::{Rational, integer, ratio};
/// let touching = Polynomial::new(vec![integer(-1), integer(2)]).pow(2);   // (2s − 1)²
/// let first = touching.clone() * Polynomial::new(vec![integer(3), integer(1)]);
/// let root = common_square_root(&[first, touching]);
/// assert_eq!(root.coefficients(), &[ratio(-1, 2), integer(1)]);
/// ```
pub fn common_square_root(polynomials: &[Polynomial<Rational>]) -> Polynomial<Rational> {
    let mut common = Polynomial::zero();
    for polynomial in polynomials {
        common = match greatest_common_divisor(&common, polynomial) {
            Some(divisor) => divisor,
            None => return Polynomial::one(),
        };
    }
    square_root_part(common).unwrap_or_else(Polynomial::one)
}

/// Whether cosine series, as polynomials in `cos φ`, certainly have no factor in common: they then have none modulo a prime that
/// does not divide the leading coefficient of the first.
pub(crate) fn have_no_common_factor(series: &[CosineSeries<BigInt>]) -> bool {
    // A constant that is not zero is divided by no wave.
    if series.iter().any(|one| one.coefficients().len() == 1) {
        return true;
    }
    let field = PrimeField::largest();
    let mut images = series.iter().map(|series| {
        let values: Vec<u64> = series.coefficients().iter().map(|v| field.embed(v)).collect();
        polynomial_modulo(&values, &field)
    });
    let Some(first) = images.next() else { return false };
    if first.len() != series[0].coefficients().len() || first.is_empty() {
        return false;
    }
    let divisor = images.try_fold(first, |common, image| {
        (common.len() > 1).then(|| divisor_modulo(common, image, &field))
    });
    divisor.is_none_or(|common| common.len() == 1)
}

/// Twice a cosine series as a polynomial in `y = 2 cos φ`, modulo a prime: Clenshaw's recurrence `b_m = r_m + y b_{m+1} − b_{m+2}`.
fn polynomial_modulo(series: &[u64], field: &PrimeField) -> Vec<u64> {
    let Some((&constant, rest)) = series.split_first() else { return Vec::new() };
    let double = |value: u64| field.add(value, value);
    let (mut first, mut second): (Vec<u64>, Vec<u64>) = (Vec::new(), Vec::new());
    for &value in rest.iter().rev() {
        // The new `first` takes the place of the old `second`.
        let mut next = std::mem::take(&mut second);
        next.iter_mut().for_each(|value| *value = field.subtract(0, *value));
        next.resize(first.len() + 1, 0);
        next[0] = field.add(next[0], value);
        for (target, &value) in next[1..].iter_mut().zip(&first) {
            *target = field.add(*target, value);
        }
        second = std::mem::replace(&mut first, next);
    }
    let mut sum = vec![0; first.len() + 1];
    sum[0] = double(constant);
    for (target, &value) in sum[1..].iter_mut().zip(&first) {
        *target = field.add(*target, value);
    }
    for (target, &value) in sum.iter_mut().zip(&second) {
        *target = field.subtract(*target, double(value));
    }
    while sum.last() == Some(&0) {
        sum.pop();
    }
    sum
}

/// `H = f_2 f_3 f_4² f_5² …` of the decomposition `p = f_1 f_2² f_3³ …`.
fn square_root_part(polynomial: Polynomial<Rational>) -> Option<Polynomial<Rational>> {
    let factors = square_free_factors(polynomial)?;
    Some((1..).zip(factors).fold(Polynomial::one(), |root, (multiplicity, factor)| {
        root * factor.pow(multiplicity / 2)
    }))
}

/// Yun's decomposition `p = f_1 f_2² f_3³ …` into monic factors without multiple roots, up to a constant:
/// `[f_1, f_2, …]`, empty for a constant. `None` when the primes do not suffice.
pub(crate) fn square_free_factors(
    polynomial: Polynomial<Rational>,
) -> Option<Vec<Polynomial<Rational>>> {
    let mut factors = Vec::new();
    if polynomial.is_zero() {
        return Some(factors);
    }
    let derivative = polynomial.derivative();
    let repeated = greatest_common_divisor(&polynomial, &derivative)?;
    let mut simple = polynomial.divide(&repeated).0;
    let mut rest = derivative.divide(&repeated).0 - simple.derivative();
    while simple.degree() > Some(0) {
        let factor = greatest_common_divisor(&simple, &rest)?;
        simple = simple.divide(&factor).0;
        rest = rest.divide(&factor).0 - simple.derivative();
        factors.push(factor);
    }
    Some(factors)
}

/// Whether an integer polynomial certainly has no multiple root: it then has none modulo some prime.
pub(crate) fn is_square_free(polynomial: &Polynomial<BigInt>) -> bool {
    PrimeField::descending().take(2).any(|field| {
        let image: Vec<u64> = polynomial.coefficients().iter().map(|v| field.embed(v)).collect();
        let derivative = polynomial.derivative();
        let slope: Vec<u64> = derivative.coefficients().iter().map(|v| field.embed(v)).collect();
        let whole = |values: &[u64]| values.last().is_none_or(|&leading| leading != 0);
        whole(&image) && whole(&slope) && divisor_modulo(image, slope, &field).len() == 1
    })
}

/// The monic greatest common divisor; `None` when the primes do not suffice to reconstruct it.
pub(crate) fn greatest_common_divisor(
    left: &Polynomial<Rational>,
    right: &Polynomial<Rational>,
) -> Option<Polynomial<Rational>> {
    if left.is_zero() || right.is_zero() {
        return Some(monic(if left.is_zero() { right } else { left }));
    }
    let (left_integers, right_integers) = (integers(left), integers(right));
    let mut images: Option<Reconstruction> = None;
    for field in PrimeField::descending().take(MAX_PRIMES) {
        let image = |values: &[BigInt]| -> Option<Vec<u64>> {
            let residues: Vec<u64> = values.iter().map(|value| field.embed(value)).collect();
            // A prime that divides the leading coefficient tells nothing.
            residues.last().is_some_and(|&leading| leading != 0).then_some(residues)
        };
        let (Some(a), Some(b)) = (image(&left_integers), image(&right_integers)) else { continue };
        let divisor = divisor_modulo(a, b, &field);
        if divisor.len() == 1 {
            return Some(Polynomial::one());
        }
        // An unlucky prime shows a divisor of too high degree.
        let found = images.as_ref().map(|images| images.residues().len());
        match images.as_mut() {
            Some(_) if found < Some(divisor.len()) => continue,
            Some(images) if found == Some(divisor.len()) => images.extend(&field, &divisor),
            _ => images = Some(Reconstruction::new(&field, &divisor)),
        }
        let candidate: Option<Vec<Rational>> = images.as_ref().and_then(|images| {
            images.residues().iter().map(|r| reconstruct(r, images.modulus())).collect()
        });
        if let Some(candidate) = candidate.map(Polynomial::new)
            && left.divide(&candidate).1.is_zero()
            && right.divide(&candidate).1.is_zero()
        {
            return Some(candidate);
        }
    }
    None
}

/// Coefficients over their common denominator.
fn integers(polynomial: &Polynomial<Rational>) -> Vec<BigInt> {
    let coefficients = polynomial.coefficients();
    let common = coefficients.iter().fold(BigInt::one(), |all, value| all.lcm(value.denom()));
    coefficients.iter().map(|value| value.numer() * (&common / value.denom())).collect()
}

fn monic(polynomial: &Polynomial<Rational>) -> Polynomial<Rational> {
    match polynomial.coefficients().last() {
        Some(leading) => polynomial.scale(&(integer(1) / leading)),
        None => Polynomial::zero(),
    }
}

/// Euclid's algorithm modulo a prime; the result is monic.
fn divisor_modulo(mut a: Vec<u64>, mut b: Vec<u64>, field: &PrimeField) -> Vec<u64> {
    while !b.is_empty() {
        (a, b) = (b.clone(), field.remainder(a, &b));
    }
    let inverse = field.inverse(a[a.len() - 1]);
    a.iter().map(|&value| field.multiply(value, inverse)).collect()
}

/// The fraction of small numerator and denominator with this residue (Wang's algorithm).
fn reconstruct(residue: &BigInt, modulus: &BigInt) -> Option<Rational> {
    let half: BigInt = modulus / 2;
    let bound = half.sqrt();
    let (mut remainder, mut next) = (modulus.clone(), residue.mod_floor(modulus));
    let (mut cofactor, mut next_cofactor) = (BigInt::zero(), BigInt::one());
    while next > bound {
        let quotient = &remainder / &next;
        (remainder, next) = (next.clone(), remainder - &quotient * &next);
        (cofactor, next_cofactor) = (next_cofactor.clone(), cofactor - quotient * next_cofactor);
    }
    // Cofactors after the first grow in size: none is zero.
    (next_cofactor.abs() <= bound).then(|| Rational::new(next, next_cofactor))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polynomial(values: Vec<i64>) -> Polynomial<Rational> {
        Polynomial::new(values.into_iter().map(integer).collect())
    }

    proptest! {
        #[test]
        fn series_without_a_common_factor_are_told_as_their_polynomials_are(
            factor in prop::collection::vec(-9i64..9, 0..3),
            a in prop::collection::vec(-9i64..9, 1..5),
            b in prop::collection::vec(-9i64..9, 1..5),
        ) {
            let factor = if factor.is_empty() { polynomial(vec![1]) } else { polynomial(factor) };
            let both = [factor.clone() * polynomial(a), factor * polynomial(b)];
            prop_assume!(both.iter().all(|one| !one.is_zero()));
            let series = both.each_ref().map(|one| {
                let integers = one.map(|value| value.numer().clone());
                CosineSeries::from_powers_of_s(&integers, 8)
            });
            let common = greatest_common_divisor(&both[0], &both[1]).unwrap();
            prop_assert_eq!(have_no_common_factor(&series), common.degree() == Some(0));
        }

        #[test]
        fn planted_squares_come_out(
            planted in prop::collection::vec(-30i64..30, 1..5),
            a in prop::collection::vec(-99i64..99, 1..6),
            b in prop::collection::vec(-99i64..99, 1..6),
        ) {
            let (planted, a, b) = (polynomial(planted), polynomial(a), polynomial(b));
            prop_assume!(!planted.is_zero() && !a.is_zero() && !b.is_zero());
            let square = planted.pow(2);
            let (p, q) = (square.clone() * a, square * b);
            let root = common_square_root(&[p.clone(), q.clone()]);
            prop_assert!(p.divide(&root.pow(2)).1.is_zero());
            prop_assert!(q.divide(&root.pow(2)).1.is_zero());
            prop_assert!(root.divide(&planted).1.is_zero(), "{:?} misses {:?}", root, planted);
        }
    }

    /// The primes in the order in which they are tried.
    fn prime(place: usize) -> BigInt {
        PrimeField::descending().nth(place).unwrap().prime().into()
    }

    fn product(factors: &[[BigInt; 2]]) -> Polynomial<Rational> {
        let line = |[a, b]: &[BigInt; 2]| {
            Polynomial::new([a, b].map(|value| Rational::from(value.clone())).to_vec())
        };
        factors.iter().map(line).fold(Polynomial::one(), |all, factor| all * factor)
    }

    #[test]
    fn primes_at_which_more_or_less_seems_common_mislead_nobody() {
        let line = |a: BigInt| [a, BigInt::from(1)];
        let common = |left: &[[BigInt; 2]], right: &[[BigInt; 2]]| {
            greatest_common_divisor(&product(left), &product(right)).unwrap()
        };
        // x (x + 1) and x (x + 1 + p): modulo p the same.
        for place in 0..3 {
            let other = line(prime(place) + 1);
            let (left, right) = ([line(0.into()), line(1.into())], [line(0.into()), other]);
            assert_eq!(common(&left, &right), product(&[line(0.into())]));
            assert_eq!(common(&right, &left), product(&[line(0.into())]));
        }
        // The same with a common root that takes several primes, of which the first or a later one is unlucky.
        let long = || line(BigInt::from(3).pow(100));
        for place in 0..4 {
            let other = line(prime(place) + 1);
            assert_eq!(common(&[long(), line(1.into())], &[long(), other]), product(&[long()]));
        }
        // p x + 1 has no root modulo p.
        for place in 0..2 {
            let steep = || [BigInt::from(1), prime(place)];
            let found = common(&[steep(), line(1.into())], &[steep(), line(2.into())]);
            assert_eq!(found, monic(&product(&[steep()])));
        }
    }

    #[test]
    fn constants_have_no_square() {
        let one = Polynomial::one();
        let constants = [Vec::new(), vec![Polynomial::zero()], vec![polynomial(vec![4])]];
        assert_eq!(constants.map(|all| common_square_root(&all)), [(); 3].map(|()| one.clone()));
        let factors = [Polynomial::zero(), polynomial(vec![4])].map(square_free_factors);
        assert_eq!(factors, [Some(Vec::new()), Some(Vec::new())]);
    }

    #[test]
    fn primes_that_divide_a_leading_coefficient_prove_nothing() {
        let integers = |p: Polynomial<Rational>| p.map(|value| value.numer().clone());
        let square_free = |factors: &[[BigInt; 2]]| is_square_free(&integers(product(factors)));
        let line = |a: i64| [BigInt::from(a), BigInt::from(1)];
        let steep = |value: BigInt| [BigInt::from(1), value];
        assert!(square_free(&[line(1), line(2)]) && !square_free(&[line(1), line(1)]));
        // Another prime tells.
        assert!(square_free(&[steep(prime(0)), line(1)]));
        // No prime that is tried sees the double root.
        let hidden = || steep(prime(0) * prime(1));
        assert!(!square_free(&[hidden(), hidden(), line(1)]));
        // Cosine series: 1 + p cos φ and twice that have a common root, which is not seen either.
        let series = |values: &[BigInt]| CosineSeries::new(values.to_vec());
        let first = series(&[1.into(), prime(0)]);
        let second = series(&[2.into(), prime(0) * 2]);
        let plain = series(&[1.into(), 1.into()]);
        assert!(!have_no_common_factor(&[first.clone(), second]));
        assert!(have_no_common_factor(&[plain.clone(), first]));
        // Nothing, and zero.
        assert!(!have_no_common_factor(&[]) && !have_no_common_factor(&[series(&[]), series(&[])]));
        assert!(have_no_common_factor(&[plain.clone(), series(&[1.into()])]));
        assert!(!have_no_common_factor(&[plain, series(&[])]));
    }

    #[test]
    fn residues_are_those_of_the_only_short_fraction() {
        for modulus in [5i64, 7, 11, 13, 31, 37, 53, 97, 101] {
            let bound = (0..modulus).take_while(|one| one * one <= modulus / 2).last().unwrap();
            for residue in 0..modulus {
                let is_one = |(above, below): &(i64, i64)| {
                    (above - residue * below).rem_euclid(modulus) == 0
                };
                let all = (-bound..=bound).flat_map(|a| (1..=bound).map(move |b| (a, b)));
                let expected = all.filter(is_one).map(|(a, b)| Rational::new(a.into(), b.into()));
                let found = reconstruct(&residue.into(), &modulus.into());
                assert_eq!(found, expected.min(), "{residue} modulo {modulus}");
            }
        }
    }
}
