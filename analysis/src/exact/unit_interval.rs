//! Integer polynomials on `[0, 1]`: where they vanish and where they are negative, exactly.

use crate::exact::algebraic_number::AlgebraicNumber;
use crate::exact::descartes::isolate;
use crate::exact::laurent::{Laurent, VARIABLES, Variable, greatest_common_divisor};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer};
use crate::exact::real_roots::{real_roots, sign_at};
use num_bigint::{BigInt, Sign};
use num_traits::Zero;

/// Halvings after which zeros are suspected to be one multiple zero.
const FEW_HALVINGS: u32 = 128;

/// Halvings that part the zeros of any polynomial met here, if they are simple.
const MANY_HALVINGS: u32 = 1 << 13;

/// The zeros of a polynomial inside `(0, 1)`, each alone in its interval, ascending; multiple ones count once.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Zeros {
    polynomial: Polynomial<BigInt>,
    /// The polynomial with simple zeros.
    simple: Polynomial<BigInt>,
    intervals: Vec<(Rational, Rational)>,
}

impl Zeros {
    /// Of a polynomial that is not zero, by Descartes' rule of signs; by Sturm's theorem where that does not come to an end.
    pub(crate) fn of(polynomial: &Polynomial<BigInt>) -> Self {
        let (zero, one) = (integer(0), integer(1));
        let mut simple = polynomial.clone();
        let intervals = isolate(&simple, &zero, &one, FEW_HALVINGS).unwrap_or_else(|| {
            simple = square_free(polynomial);
            isolate(&simple, &zero, &one, MANY_HALVINGS).unwrap_or_else(|| {
                let exact = simple.map(|value| Rational::from(value.clone()));
                let roots = real_roots(&exact, &zero, &one, MANY_HALVINGS);
                roots.into_iter().map(|root| (root.lower, root.upper)).collect()
            })
        });
        Self { polynomial: polynomial.clone(), simple, intervals }
    }

    /// Whether it vanishes at this end of the interval, 0 or 1.
    pub(crate) fn at_end(&self, end: i64) -> bool {
        sign_at(&self.polynomial, &integer(end)) == Sign::NoSign
    }

    /// Whether there are none inside.
    pub(crate) fn is_empty(&self) -> bool {
        self.intervals.is_empty()
    }

    /// The zeros inside, ascending, to so many bits of their size.
    pub(crate) fn enclosed(&self, bits: u32) -> Vec<(Rational, Rational)> {
        let enclosed = |(lower, upper): &(Rational, Rational)| {
            let (lower, upper) = (lower.clone(), upper.clone());
            // One that was met as a middle changes no sign.
            match AlgebraicNumber::between(self.simple.clone(), lower.clone(), upper.clone()) {
                Some(number) => number.enclosure(bits),
                None => (lower, upper),
            }
        };
        self.intervals.iter().map(enclosed).collect()
    }

    /// A point of `[0, 1]` where the polynomial is negative.
    pub(crate) fn negative_point(&self) -> Option<Rational> {
        // No interval of positive length has a zero at an end, so that between two neighbours there is always a point that is none.
        let (mut points, mut before) = (vec![integer(0)], integer(0));
        for (lower, upper) in &self.intervals {
            points.push((&before + lower) / integer(2));
            before = upper.clone();
        }
        points.push((&before + integer(1)) / integer(2));
        points.push(integer(1));
        points.into_iter().find(|point| sign_at(&self.polynomial, point) == Sign::Minus)
    }

    /// Whether the polynomial is negative at a point.
    pub(crate) fn is_negative_at(&self, point: &Rational) -> bool {
        sign_at(&self.polynomial, point) == Sign::Minus
    }
}

/// The polynomial divided by what it has in common with its derivative.
fn square_free(polynomial: &Polynomial<BigInt>) -> Polynomial<BigInt> {
    let terms = polynomial.coefficients().iter().enumerate().map(|(power, value)| {
        let mut exponents = [0; VARIABLES];
        exponents[Variable::TIME.0] = power as i16;
        (exponents, value.clone())
    });
    let whole = Laurent::new(terms.collect());
    let common = greatest_common_divisor(&whole, &whole.derivative(Variable::TIME));
    let mut quotient = whole.primitive().divide_exactly(&common).expect("a common divisor");
    if whole.lowest_powers()[Variable::TIME.0] > 0 {
        // Powers of the variable are left out of both.
        quotient = quotient.shifted(Variable::TIME, 1);
    }
    let coefficients = quotient.coefficients(Variable::TIME);
    let value = |c: &Laurent| c.as_constant().unwrap_or_else(BigInt::zero);
    Polynomial::new(coefficients.iter().map(value).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn chosen_zeros_and_signs_are_found(
            roots in prop::collection::vec((0i64..=12, 1usize..4), 0..4), sign in prop::bool::ANY
        ) {
            // (12 s − a)^m …, a root inside the interval wherever 0 < a < 12.
            let one = Polynomial::constant(BigInt::from(if sign { 1 } else { -1 }));
            let p = roots.iter().fold(one, |p, &(a, m)| {
                p * Polynomial::new(vec![(-a).into(), 12.into()]).pow(m)
            });
            let zeros = Zeros::of(&p);
            let mut inside: Vec<i64> = roots.iter().map(|r| r.0).filter(|a| (1..12).contains(a)).collect();
            inside.sort_unstable();
            inside.dedup();
            let found = zeros.enclosed(60);
            prop_assert_eq!(found.len(), inside.len());
            for ((lower, upper), a) in found.iter().zip(&inside) {
                prop_assert!(*lower <= ratio(*a, 12) && ratio(*a, 12) <= *upper);
            }
            for (end, a) in [(0, 0), (1, 12)] {
                prop_assert_eq!(zeros.at_end(end), roots.iter().any(|root| root.0 == a));
            }
            // Between twelfths the sign is constant.
            let exact = p.map(|value| Rational::from(value.clone()));
            let value = |numerator: i64| exact.evaluate(&ratio(numerator, 24));
            let negative = (0..=24).any(|i| value(i) < integer(0));
            let point = zeros.negative_point();
            prop_assert_eq!(point.is_some(), negative);
            for i in 0..=24 {
                prop_assert_eq!(zeros.is_negative_at(&ratio(i, 24)), value(i) < integer(0));
            }
            prop_assert!(point.is_none_or(|point| exact.evaluate(&point) < integer(0)));
        }
    }

    #[test]
    fn between_a_zero_at_the_end_and_the_next_there_is_a_point() {
        // s (12s − 7)³
        let root = Polynomial::new(vec![(-7).into(), 12.into()]).pow(3);
        let zeros = Zeros::of(&(Polynomial::new(vec![0.into(), 1.into()]) * root));
        assert!(zeros.negative_point().is_some_and(|point| point < ratio(7, 12)));
    }
}
