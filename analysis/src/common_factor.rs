//! Squares that divide several integer polynomials at once, found modulo primes and verified exactly.
//!
//! A wave that a scheme leaves neutral at every Courant number — the zeros of the kernel's transform
//! on the lattice — makes all coefficients of the margin vanish together, and no amount of
//! subdivision decides the sign of a touching zero. Taking the common square out does.

use crate::polynomial::Polynomial;
use crate::rational::{Rational, integer};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Primes just below 2^61; more than any common factor met here needs.
const PRIMES: [u64; 24] = [
    2305843009213693951,
    2305843009213693921,
    2305843009213693907,
    2305843009213693723,
    2305843009213693693,
    2305843009213693669,
    2305843009213693613,
    2305843009213693561,
    2305843009213693549,
    2305843009213693487,
    2305843009213693421,
    2305843009213693373,
    2305843009213693277,
    2305843009213693193,
    2305843009213693153,
    2305843009213693133,
    2305843009213693123,
    2305843009213693109,
    2305843009213693093,
    2305843009213693013,
    2305843009213692967,
    2305843009213692937,
    2305843009213692799,
    2305843009213692757,
];

/// The largest `H`, monic, such that `H²` divides every polynomial; 1 when there is none.
///
/// ```
/// use courant_analysis::{common_factor::common_square_root, polynomial::Polynomial};
/// use courant_analysis::rational::{Rational, integer, ratio};
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

/// Yun's decomposition `p = f_1 f_2² f_3³ …`, from which `H = f_2 f_3 f_4² f_5² …`.
fn square_root_part(polynomial: Polynomial<Rational>) -> Option<Polynomial<Rational>> {
    let mut root = Polynomial::one();
    if polynomial.degree() < Some(2) {
        return Some(root);
    }
    let derivative = polynomial.derivative();
    let repeated = greatest_common_divisor(&polynomial, &derivative)?;
    let mut simple = polynomial.divide(&repeated).0;
    let mut rest = derivative.divide(&repeated).0 - simple.derivative();
    let mut multiplicity = 1;
    while simple.degree() > Some(0) {
        let factor = greatest_common_divisor(&simple, &rest)?;
        root = root * factor.pow(multiplicity / 2);
        simple = simple.divide(&factor).0;
        rest = rest.divide(&factor).0 - simple.derivative();
        multiplicity += 1;
    }
    Some(root)
}

/// The monic greatest common divisor; `None` when the primes do not suffice to reconstruct it.
fn greatest_common_divisor(
    left: &Polynomial<Rational>,
    right: &Polynomial<Rational>,
) -> Option<Polynomial<Rational>> {
    if left.is_zero() || right.is_zero() {
        return Some(monic(if left.is_zero() { right } else { left }));
    }
    let (left_integers, right_integers) = (integers(left), integers(right));
    let (mut modulus, mut residues): (BigInt, Vec<BigInt>) = (BigInt::one(), Vec::new());
    for prime in PRIMES {
        let image = |values: &[BigInt]| -> Option<Vec<u64>> {
            let residues: Vec<u64> = values
                .iter()
                .map(|v| v.mod_floor(&prime.into()).to_u64())
                .collect::<Option<_>>()?;
            // A prime that divides the leading coefficient tells nothing.
            residues.last().is_some_and(|&leading| leading != 0).then_some(residues)
        };
        let (Some(a), Some(b)) = (image(&left_integers), image(&right_integers)) else { continue };
        let divisor = divisor_modulo(a, b, prime);
        if divisor.len() == 1 {
            return Some(Polynomial::one());
        }
        if !residues.is_empty() && divisor.len() > residues.len() {
            continue;
        }
        if divisor.len() < residues.len() || residues.is_empty() {
            (modulus, residues) =
                (BigInt::from(prime), divisor.into_iter().map(BigInt::from).collect());
        } else {
            // Chinese remainders.
            let inverse = inverse_modulo((&modulus % prime).to_u64()?, prime);
            for (residue, value) in residues.iter_mut().zip(divisor) {
                let step = (BigInt::from(value) - &*residue).mod_floor(&prime.into()) * inverse;
                *residue += &modulus * step.mod_floor(&prime.into());
            }
            modulus *= prime;
        }
        let candidate: Option<Vec<Rational>> =
            residues.iter().map(|residue| reconstruct(residue, &modulus)).collect();
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
fn divisor_modulo(mut a: Vec<u64>, mut b: Vec<u64>, prime: u64) -> Vec<u64> {
    let multiply = |x: u64, y: u64| (u128::from(x) * u128::from(y) % u128::from(prime)) as u64;
    while !b.is_empty() {
        let inverse = inverse_modulo(b[b.len() - 1], prime);
        b.iter_mut().for_each(|value| *value = multiply(*value, inverse));
        while a.len() >= b.len() {
            let factor = a[a.len() - 1];
            let shift = a.len() - b.len();
            for (target, value) in a[shift..].iter_mut().zip(&b) {
                *target = (*target + prime - multiply(factor, *value)) % prime;
            }
            while a.last() == Some(&0) {
                a.pop();
            }
        }
        std::mem::swap(&mut a, &mut b);
    }
    let inverse = inverse_modulo(a[a.len() - 1], prime);
    a.iter().map(|&value| multiply(value, inverse)).collect()
}

/// Fermat: `x^(p−2)`.
fn inverse_modulo(value: u64, prime: u64) -> u64 {
    let multiply = |x: u64, y: u64| (u128::from(x) * u128::from(y) % u128::from(prime)) as u64;
    let (mut result, mut base, mut exponent) = (1, value, prime - 2);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = multiply(result, base);
        }
        base = multiply(base, base);
        exponent >>= 1;
    }
    result
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
    let usable = !next_cofactor.is_zero() && next_cofactor.abs() <= bound;
    usable.then(|| Rational::new(next, next_cofactor))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polynomial(values: Vec<i64>) -> Polynomial<Rational> {
        Polynomial::new(values.into_iter().map(integer).collect())
    }

    #[test]
    fn the_moduli_are_prime() {
        // Miller–Rabin with the bases that decide every 64-bit number.
        for prime in PRIMES {
            let multiply =
                |x: u64, y: u64| (u128::from(x) * u128::from(y) % u128::from(prime)) as u64;
            let twos = (prime - 1).trailing_zeros();
            for base in [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37] {
                let (mut x, mut square, mut exponent) = (1, base, (prime - 1) >> twos);
                while exponent > 0 {
                    if exponent & 1 == 1 {
                        x = multiply(x, square)
                    }
                    square = multiply(square, square);
                    exponent >>= 1;
                }
                let mut passes = x == 1;
                for _ in 0..twos {
                    passes |= x == prime - 1;
                    x = multiply(x, x);
                }
                assert!(passes, "{prime}");
            }
        }
    }

    proptest! {
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
}
