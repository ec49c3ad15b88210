//! Roots of integer polynomials counted by Descartes' rule of signs and isolated by halving.
//!
//! Sturm's chain ([`real_roots`](crate::exact::real_roots)) counts exactly but divides polynomials, whose coefficients then grow
//! quadratically with the degree; Descartes' rule needs additions only and suffices where roots are simple.

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Sign changes of the Bernstein coefficients on the open interval `(from, to)`: at least the number of
/// roots there, counted with multiplicity, and of the same parity. 0 and 1 are therefore exact.
///
/// ```
/// use courant_analysis::{exact::descartes::sign_changes, exact::polynomial::Polynomial, exact::rational::integer};
/// let p = Polynomial::new([-2, 0, 1].map(Into::into).to_vec());   // t² − 2
/// assert_eq!(sign_changes(&p, &integer(1), &integer(2)), 1);
/// assert_eq!(sign_changes(&p, &integer(2), &integer(3)), 0);
/// ```
pub fn sign_changes(polynomial: &Polynomial<BigInt>, from: &Rational, to: &Rational) -> usize {
    changes(&on_unit_interval(polynomial, from, to))
}

/// Intervals `[lower, upper]` within `(from, to)`, ascending, that hold exactly one root each, inside; a root met as the
/// middle of an interval comes as `lower = upper`. Roots at `from` and `to` are left out.
///
/// `None` when two roots are closer than `2^−max_halvings` of the range, as the parts of a multiple one are.
pub fn isolate(
    polynomial: &Polynomial<BigInt>,
    from: &Rational,
    to: &Rational,
    max_halvings: u32,
) -> Option<Vec<(Rational, Rational)>> {
    let mut found = Vec::new();
    if polynomial.is_zero() {
        return None;
    }
    let point = |position: &BigInt, depth: u32| {
        from + (to - from) * Rational::new(position.clone(), BigInt::one() << depth)
    };
    // The polynomial moved to the unit interval, the left end in units of 2^−depth, the depth.
    let mut pending = vec![(on_unit_interval(polynomial, from, to), BigInt::zero(), 0)];
    while let Some((coefficients, position, depth)) = pending.pop() {
        // No end is a root, so that signs at the ends tell the root inside.
        let ends: [BigInt; 2] = [coefficients[0].clone(), coefficients.iter().sum()];
        match changes(&coefficients) {
            0 => {}
            1 if !ends.iter().any(Zero::is_zero) => {
                found.push((point(&position, depth), point(&(&position + 1), depth)))
            }
            _ if depth == max_halvings => return None,
            _ => {
                // q(x/2) and q((x + 1)/2), times 2^n.
                let degree = coefficients.len() - 1;
                let left: Vec<BigInt> =
                    (0..).zip(&coefficients).map(|(i, value)| value << (degree - i)).collect();
                let right = shift_by_one(left.clone());
                let position: BigInt = position << 1;
                let middle: BigInt = &position + 1;
                let at_middle = right[0].is_zero();
                pending.push((right, middle.clone(), depth + 1));
                if at_middle {
                    // Visited after the left half, before the right one.
                    let root = point(&middle, depth + 1);
                    found.push((root.clone(), root));
                }
                pending.push((left, position, depth + 1));
            }
        }
    }
    found.sort();
    Some(found)
}

/// A positive multiple of `p(from + (to − from) x)`, in powers of `x`.
fn on_unit_interval(
    polynomial: &Polynomial<BigInt>,
    from: &Rational,
    to: &Rational,
) -> Vec<BigInt> {
    let common = from.denom().lcm(to.denom());
    let start = from.numer() * (&common / from.denom());
    let width = to.numer() * (&common / to.denom()) - &start;
    // Homogeneous Horner scheme: multiply by (start + width x), add c common^k.
    let mut moved: Vec<BigInt> = Vec::with_capacity(polynomial.coefficients().len());
    let mut weight = BigInt::one();
    for coefficient in polynomial.coefficients().iter().rev() {
        moved.push(BigInt::zero());
        for i in (0..moved.len()).rev() {
            let carried = if i == 0 { BigInt::zero() } else { &moved[i - 1] * &width };
            moved[i] = &moved[i] * &start + carried;
        }
        moved[0] += coefficient * &weight;
        weight *= &common;
    }
    moved
}

/// Sign changes of `(1 + x)^n q(1/(1 + x))`, whose coefficients are multiples of the Bernstein coefficients.
fn changes(coefficients: &[BigInt]) -> usize {
    let reversed = coefficients.iter().rev().cloned().collect();
    let signs: Vec<bool> = shift_by_one(reversed)
        .iter()
        .filter(|value| !value.is_zero())
        .map(Signed::is_positive)
        .collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// `q(x + 1)`.
fn shift_by_one(mut coefficients: Vec<BigInt>) -> Vec<BigInt> {
    for start in 0..coefficients.len() {
        for i in (start..coefficients.len() - 1).rev() {
            let (head, tail) = coefficients.split_at_mut(i + 1);
            head[i] += &tail[0];
        }
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{integer, ratio};
    use crate::exact::real_roots::SturmChain;
    use proptest::prelude::*;

    #[test]
    fn roots_at_ends_and_middles() {
        // t (t − 1)(t − 2)(2t − 1) on (0, 2): the ends are left out, 1 is the first middle.
        let p = [[0, 1], [-1, 1], [-2, 1], [-1, 2]]
            .map(|values| Polynomial::new(values.map(BigInt::from).to_vec()))
            .into_iter()
            .fold(Polynomial::one(), |product: Polynomial<BigInt>, factor| product * factor);
        let found = isolate(&p, &integer(0), &integer(2), 60).unwrap();
        assert_eq!(found.len(), 2);
        assert!(found[0].0 <= ratio(1, 2) && ratio(1, 2) <= found[0].1);
        assert_eq!(found[1], (integer(1), integer(1)));
        // A double root is not isolated.
        let double = Polynomial::new(vec![BigInt::from(1), BigInt::from(-6), BigInt::from(9)]);
        assert_eq!(isolate(&double, &integer(0), &integer(1), 60), None);
        assert_eq!(isolate(&Polynomial::zero(), &integer(0), &integer(1), 60), None);
    }

    proptest! {
        #[test]
        fn the_count_is_sturms(values in prop::collection::vec(-30i64..30, 1..8), a in -9i64..9, b in 1i64..9) {
            let p = Polynomial::new(values.into_iter().map(BigInt::from).collect());
            prop_assume!(!p.is_zero());
            let exact = p.map(|value| Rational::from(value.clone()));
            let (from, to) = (ratio(a, 3), ratio(a, 3) + ratio(b, 2));
            prop_assume!(!exact.evaluate(&to).is_zero());
            let chain = SturmChain::new(&exact);
            if let Some(found) = isolate(&p, &from, &to, 80) {
                prop_assert_eq!(found.len(), chain.count(&from, &to));
                for (lower, upper) in found {
                    if lower == upper {
                        prop_assert!(exact.evaluate(&lower).is_zero());
                    } else {
                        let at_upper = usize::from(exact.evaluate(&upper).is_zero());
                        prop_assert_eq!(chain.count(&lower, &upper), 1 + at_upper);
                    }
                }
            } else {
                prop_assert!(exact.degree() > Some(0));
            }
        }
    }
}
