//! Positive numbers given as roots of integer polynomials.

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, simplest_between, square_root_enclosure, to_f64};
use crate::exact::real_roots::{power_of_two, root_near, sign_at};
use num_bigint::{BigInt, Sign};
use num_traits::{Signed, Zero};

/// A fraction is looked for in an enclosure of so many bits: two fractions that close together have
/// denominators above `2^100`.
const FRACTION_BITS: u32 = 200;

/// Roots of fractions are looked for up to this index.
const MOST_ROOT: usize = 12;

/// The only root of an integer polynomial in an interval, positive and of odd multiplicity, or the square
/// root of it.
///
/// ```
/// use courant_analysis::{exact::algebraic_number::AlgebraicNumber, exact::polynomial::Polynomial, exact::rational::integer};
/// let cubic = Polynomial::new([-2, 0, 0, 1].map(Into::into).to_vec());
/// let root = AlgebraicNumber::between(cubic, integer(1), integer(2)).unwrap();
/// let (lower, upper) = root.enclosure(300);
/// assert!(&lower * &lower * &lower <= integer(2) && integer(2) <= &upper * &upper * &upper);
/// assert_eq!(root.equation("C"), "C^3 - 2 = 0");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AlgebraicNumber {
    polynomial: Polynomial<BigInt>,
    lower: Rational,
    upper: Rational,
    /// The number is this root of what the fields above describe: 1 or 2.
    index: usize,
}

impl AlgebraicNumber {
    /// The root of a polynomial that has exactly one in `[lower, upper]`, which the caller knows; `None` when
    /// the interval reaches below 0 or the signs of the polynomial at its ends are not opposite.
    pub fn between(
        polynomial: Polynomial<BigInt>,
        lower: Rational,
        upper: Rational,
    ) -> Option<Self> {
        let signs = (sign_at(&polynomial, &lower), sign_at(&polynomial, &upper));
        let opposite = matches!(signs, (Sign::Minus, Sign::Plus) | (Sign::Plus, Sign::Minus));
        (opposite && !lower.is_negative()).then_some(Self { polynomial, lower, upper, index: 1 })
    }

    /// The square root of a number that is no square root itself.
    pub fn square_root(self) -> Self {
        Self { index: 2, ..self }
    }

    /// The polynomial, in powers of the number.
    pub fn polynomial(&self) -> Polynomial<BigInt> {
        let coefficients = self.polynomial.coefficients().iter();
        let zeros = vec![BigInt::zero(); self.index - 1];
        Polynomial::new(
            coefficients
                .flat_map(|value| std::iter::once(value.clone()).chain(zeros.clone()))
                .collect(),
        )
    }

    /// The degree of the polynomial. No smaller one is claimed not to exist.
    pub fn degree(&self) -> usize {
        self.index * self.polynomial.degree().unwrap_or(0)
    }

    /// Two fractions around the number that differ by less than about `2^−bits` of it.
    pub fn enclosure(&self, bits: u32) -> (Rational, Rational) {
        let (lower, upper) = self.enclosure_of_power(bits + 2);
        match self.index {
            1 => (lower, upper),
            _ => square_root_enclosure(&lower, &upper, bits + 2),
        }
    }

    /// The enclosure of the number to the power of its index.
    pub(crate) fn enclosure_of_power(&self, bits: u32) -> (Rational, Rational) {
        let middle = (&self.lower + &self.upper) / integer(2);
        let quick = root_near(self.polynomial.coefficients(), to_f64(&middle), bits)
            .filter(|root| root.lower >= self.lower && root.upper <= self.upper);
        match quick {
            Some(root) => (root.lower, root.upper),
            None => self.halved(bits),
        }
    }

    /// The enclosure by halving the interval, where Newton's method left it.
    fn halved(&self, bits: u32) -> (Rational, Rational) {
        let (mut lower, mut upper) = (self.lower.clone(), self.upper.clone());
        let sign = sign_at(&self.polynomial, &lower);
        let fine = power_of_two(-i64::from(bits));
        while &upper - &lower > &upper * &fine {
            let middle = (&lower + &upper) / integer(2);
            match sign_at(&self.polynomial, &middle) {
                Sign::NoSign => return (middle.clone(), middle),
                at_middle if at_middle == sign => lower = middle,
                _ => upper = middle,
            }
        }
        (lower, upper)
    }

    /// The number to the power of its index as a fraction, if it is one of moderate size.
    pub(crate) fn power_as_fraction(&self) -> Option<Rational> {
        if let [constant, slope] = self.polynomial.coefficients() {
            return Some(Rational::new(-constant.clone(), slope.clone()));
        }
        let (lower, upper) = self.enclosure_of_power(FRACTION_BITS);
        let simplest = simplest_between(&lower, &upper);
        (sign_at(&self.polynomial, &simplest) == Sign::NoSign).then_some(simplest)
    }

    /// `(r, k)` when it is the `k`-th root of a fraction `r` of moderate size: then `x^k − r` divides its polynomial.
    ///
    /// ```
    /// use courant_analysis::exact::{algebraic_number::AlgebraicNumber, polynomial::Polynomial, rational::{integer, ratio}};
    /// // (3x³ − 2)(x + 1)
    /// let polynomial = Polynomial::new([-2, -2, 0, 3, 3].map(Into::into).to_vec());
    /// let root = AlgebraicNumber::between(polynomial, ratio(1, 2), integer(1)).unwrap();
    /// assert_eq!(root.radical(), Some((ratio(2, 3), 3)));
    /// ```
    pub fn radical(&self) -> Option<(Rational, usize)> {
        let polynomial = self.polynomial();
        let (lower, upper) = self.enclosure(FRACTION_BITS);
        (2..=polynomial.degree()?.min(MOST_ROOT)).find_map(|index| {
            let power = simplest_between(&lower.pow(index as i32), &upper.pow(index as i32));
            if power.numer().bits().max(power.denom().bits()) > 64 {
                return None;
            }
            let mut factor = vec![BigInt::zero(); index + 1];
            factor[0] = -power.numer().clone();
            factor[index] = power.denom().clone();
            polynomial.divide_exactly(&Polynomial::new(factor)).map(|_| (power, index))
        })
    }

    /// The equation it solves, as text: `4 C^2 - C - 2 = 0`.
    pub fn equation(&self, variable: &str) -> String {
        let mut text = String::new();
        let polynomial = self.polynomial();
        for (power, value) in polynomial.coefficients().iter().enumerate().rev() {
            if value.is_zero() {
                continue;
            }
            text += match (text.is_empty(), value.is_negative()) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            };
            let magnitude = value.magnitude();
            let unit = *magnitude == num_bigint::BigUint::from(1u32);
            text += &match (power, unit) {
                (0, _) => magnitude.to_string(),
                (1, true) => variable.to_string(),
                (1, false) => format!("{magnitude} {variable}"),
                (_, true) => format!("{variable}^{power}"),
                (_, false) => format!("{magnitude} {variable}^{power}"),
            };
        }
        text + " = 0"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use proptest::prelude::*;

    fn polynomial(values: &[i64]) -> Polynomial<BigInt> {
        Polynomial::new(values.iter().map(|&value| value.into()).collect())
    }

    #[test]
    fn equations_are_printed_as_one_writes_them() {
        let number = |values: &[i64]| {
            AlgebraicNumber::between(polynomial(values), integer(1), integer(2)).unwrap()
        };
        assert_eq!(number(&[-5, -1, 4, -1]).equation("C"), "-C^3 + 4 C^2 - C - 5 = 0");
        assert_eq!(number(&[-3, 0, 1]).square_root().equation("C"), "C^4 - 3 = 0");
        assert_eq!(number(&[-3, 0, 1]).square_root().degree(), 4);
    }

    #[test]
    fn a_number_is_the_root_in_its_interval_wherever_newtons_method_ends() {
        // (t − 1)(t − 6)(t − 17): from 11, the middle of this interval, it goes to 7/2 and 17.
        let three = polynomial(&[-102, 125, -24, 1]);
        let number = AlgebraicNumber::between(three, ratio(11, 2), ratio(33, 2)).unwrap();
        let (lower, upper) = number.enclosure(60);
        assert!(lower <= integer(6) && integer(6) <= upper && upper < integer(7));
    }

    #[test]
    fn a_polynomial_without_change_of_sign_defines_nothing() {
        assert_eq!(AlgebraicNumber::between(polynomial(&[-2, 0, 1]), integer(2), integer(3)), None);
        assert_eq!(AlgebraicNumber::between(polynomial(&[0, 1]), integer(-1), integer(1)), None);
    }

    #[test]
    fn halving_ends_as_soon_as_the_enclosure_is_narrow() {
        // √3 in [1, 2]: half of 2 is not more than 2^−1 of it.
        let root = AlgebraicNumber::between(polynomial(&[-3, 0, 1]), integer(1), integer(2));
        let root = root.unwrap();
        assert_eq!(root.halved(1), (integer(1), integer(2)));
        assert_eq!(root.halved(2), (ratio(3, 2), integer(2)));
    }

    #[test]
    fn newton_may_leave_the_interval_and_lines_may_be_long() {
        // (5x − 24)(x − 5)(x − 11): from the middle Newton's method goes to the left of it.
        let product = polynomial(&[-24, 5]) * polynomial(&[55, -16, 1]);
        let root = AlgebraicNumber::between(product, ratio(501, 100), ratio(1101, 100)).unwrap();
        assert_eq!(root.power_as_fraction(), Some(integer(11)));
        let (above, below) = (BigInt::from(3).pow(400), BigInt::from(2).pow(633));
        let value = Rational::new(above.clone(), below.clone());
        let line = Polynomial::new(vec![-above, below]);
        let root = AlgebraicNumber::between(line, integer(0), integer(5)).unwrap();
        assert_eq!(root.power_as_fraction(), Some(value));
    }

    #[test]
    fn radicands_have_up_to_64_bits() {
        // The greatest prime below 2^64 and the least one above.
        for (offset, known) in [(-59i64, true), (13, false)] {
            let radicand: BigInt = (BigInt::from(1) << 64u32) + offset;
            let bound = Rational::from(radicand.clone());
            let square = Polynomial::new(vec![-radicand, BigInt::zero(), BigInt::from(1)]);
            let root = AlgebraicNumber::between(square, integer(1), bound.clone()).unwrap();
            assert_eq!(root.radical(), known.then_some((bound, 2)));
        }
    }

    proptest! {
        #[test]
        fn fractions_are_recognised(numerator in 1i64..500, denominator in 1i64..500) {
            // (qt − p)(t² + 1)
            let p = polynomial(&[-numerator, denominator]) * polynomial(&[1, 0, 1]);
            let exact = ratio(numerator, denominator);
            let number =
                AlgebraicNumber::between(p, &exact / integer(2), &exact * ratio(5, 3)).unwrap();
            prop_assert_eq!(number.power_as_fraction(), Some(exact));
        }

        #[test]
        fn enclosures_hold_the_number_and_are_as_narrow_as_asked(
            radicand in 2i64..1000, bits in 10u32..400
        ) {
            prop_assume!(ratio(radicand, 1).numer().sqrt().pow(2) != BigInt::from(radicand));
            // The fourth root: the square root of the root of t² − a.
            let p = polynomial(&[-radicand, 0, 1]);
            let number = AlgebraicNumber::between(p, integer(1), integer(radicand)).unwrap();
            prop_assert_eq!(number.power_as_fraction(), None);
            for (number, power) in [(number.clone(), 2), (number.square_root(), 4)] {
                let (lower, upper) = number.enclosure(bits);
                prop_assert!(lower.pow(power) < integer(radicand));
                prop_assert!(integer(radicand) < upper.pow(power));
                prop_assert!(&upper - &lower <= &upper * power_of_two(3 - i64::from(bits)));
            }
        }
    }
}
