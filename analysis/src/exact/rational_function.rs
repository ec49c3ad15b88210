//! Fractions of polynomials in names, in lowest terms.

use crate::exact::laurent::{Laurent, VARIABLES, Variable, greatest_common_divisor};
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use std::ops::{Add, Mul, Neg, Sub};

/// `numerator/denominator` without a common divisor and without negative powers; the last coefficient below is positive.
///
/// ```
/// use courant_analysis::exact::laurent::{Laurent, Variable};
/// use courant_analysis::exact::rational_function::RationalFunction;
/// let c = RationalFunction::from(Laurent::variable(Variable::name(0)));
/// let one = RationalFunction::from(Laurent::integer(1));
/// let quotient = (c.clone() * c.clone() - one.clone()).over(&(c.clone() - one.clone())).unwrap();
/// assert_eq!(quotient, c + one);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RationalFunction {
    numerator: Laurent,
    denominator: Laurent,
}

impl RationalFunction {
    /// In lowest terms.
    fn reduced(numerator: Laurent, denominator: Laurent) -> Self {
        if numerator.is_zero() {
            return Self { numerator, denominator: Laurent::integer(1) };
        }
        let (mut above, mut below) = (numerator, denominator);
        let single = |p: &Laurent| p.as_monomial().is_some();
        if !single(&above) && !single(&below) {
            let common = greatest_common_divisor(&above, &below);
            let exactly = |p: &Laurent| p.divide_exactly(&common).expect("a divisor divides");
            (above, below) = (exactly(&above), exactly(&below));
        }
        let (a, b) = (above.lowest_powers(), below.lowest_powers());
        let powers: [i16; VARIABLES] = std::array::from_fn(|v| a[v].min(b[v]));
        let mut content = above.integer_content().gcd(&below.integer_content());
        if below.terms().last().is_some_and(|(_, value)| value.is_negative()) {
            content = -content;
        }
        let common = Laurent::monomial(powers, content);
        let exactly = |p: &Laurent| p.divide_exactly(&common).expect("a divisor divides");
        Self { numerator: exactly(&above), denominator: exactly(&below) }
    }

    /// The polynomial above.
    pub fn numerator(&self) -> &Laurent {
        &self.numerator
    }

    /// The polynomial below.
    pub fn denominator(&self) -> &Laurent {
        &self.denominator
    }

    /// The value where no name occurs.
    pub fn as_number(&self) -> Option<Rational> {
        Some(Rational::new(self.numerator.as_constant()?, self.denominator.as_constant()?))
    }

    /// The quotient by another; `None` by zero.
    pub fn over(&self, other: &Self) -> Option<Self> {
        let below = &self.denominator * &other.numerator;
        (!other.is_zero()).then(|| Self::reduced(&self.numerator * &other.denominator, below))
    }

    /// The power with a natural exponent.
    pub fn pow(&self, exponent: usize) -> Self {
        (0..exponent).fold(Self::one(), |product, _| product * self.clone())
    }

    /// With a fraction for a variable; `None` at a pole.
    pub fn at(&self, variable: Variable, value: &Rational) -> Option<Self> {
        // Each is multiplied by the value's denominator to the power of its own degree.
        let scaled = |p: &Laurent, by: i16| {
            p.at_fraction(variable, value).scaled(&value.denom().pow(by.max(0) as u32))
        };
        let (a, b) = (self.numerator.degree(variable), self.denominator.degree(variable));
        let below = scaled(&self.denominator, a - b);
        (!below.is_zero()).then(|| Self::reduced(scaled(&self.numerator, b - a), below))
    }

    /// With every square of `root` replaced, and none of it below.
    pub fn with_square(self, root: Variable, square: &Self) -> Self {
        let halves = |p: &Laurent| {
            let mut halves = [Self::zero(), Self::zero()];
            for (power, coefficient) in p.coefficients(root).into_iter().enumerate() {
                let half = &mut halves[power % 2];
                let term = Self::from(coefficient) * square.pow(power / 2);
                *half = std::mem::replace(half, Self::zero()) + term;
            }
            halves
        };
        if self.numerator.degree(root) < 2 && !self.denominator.contains(root) {
            return self;
        }
        let variable = || Self::from(Laurent::variable(root));
        let [a, b] = halves(&self.numerator);
        let [c, d] = halves(&self.denominator);
        // (a + b w)/(c + d w) = (a + b w)(c − d w)/(c² − d² w²).
        let norm = c.clone() * c.clone() - d.clone() * d.clone() * square.clone();
        let plain = a.clone() * c.clone() - b.clone() * d.clone() * square.clone();
        let rooted = b * c - a * d;
        let over = |p: &Self| p.over(&norm).expect("a field has no divisors of zero");
        over(&plain) + over(&rooted) * variable()
    }

    /// Its square root as `factor · sqrt(rest)` with `rest` a polynomial without squares: 1 where the root is rational.
    pub fn square_root(&self) -> (Self, Laurent) {
        // sqrt(a/b) = sqrt(a b)/b.
        let (root, rest) = (&self.numerator * &self.denominator).square_part();
        (Self::reduced(root, self.denominator.clone()), rest)
    }
}

impl From<Laurent> for RationalFunction {
    fn from(polynomial: Laurent) -> Self {
        let lowest = polynomial.lowest_powers();
        debug_assert!(lowest.iter().all(|&power| power >= 0));
        Self { numerator: polynomial, denominator: Laurent::integer(1) }
    }
}

impl From<Rational> for RationalFunction {
    fn from(value: Rational) -> Self {
        let (numerator, denominator) = value.into_raw();
        Self {
            numerator: Laurent::constant(numerator),
            denominator: Laurent::constant(denominator),
        }
    }
}

impl Add for RationalFunction {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (a, b) = (self.denominator, other.denominator);
        if a == b {
            return Self::reduced(self.numerator + other.numerator, a);
        }
        if let (Some(m), Some(n)) = (a.as_constant(), b.as_constant()) {
            let common: BigInt = m.lcm(&n);
            let above = self.numerator.scaled(&(&common / m));
            let above = above + other.numerator.scaled(&(&common / n));
            return Self::reduced(above, Laurent::constant(common));
        }
        Self::reduced(self.numerator * b.clone() + other.numerator * a.clone(), a * b)
    }
}

impl Neg for RationalFunction {
    type Output = Self;
    fn neg(self) -> Self {
        Self { numerator: -self.numerator, denominator: self.denominator }
    }
}

impl Sub for RationalFunction {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for RationalFunction {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::reduced(self.numerator * other.numerator, self.denominator * other.denominator)
    }
}

impl Zero for RationalFunction {
    fn zero() -> Self {
        Self::from(Laurent::default())
    }
    fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }
}

impl One for RationalFunction {
    fn one() -> Self {
        Self::from(Laurent::integer(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use proptest::prelude::*;

    fn function() -> impl Strategy<Value = RationalFunction> {
        let term = (0i16..3, 0i16..3, -6i64..7);
        let polynomial = prop::collection::vec(term, 1..4).prop_map(|terms| {
            let place = |(a, b, value): (i16, i16, i64)| {
                let mut exponents = [0; VARIABLES];
                (exponents[4], exponents[5]) = (a, b);
                (exponents, BigInt::from(value))
            };
            RationalFunction::from(Laurent::new(terms.into_iter().map(place).collect()))
        });
        (polynomial.clone(), polynomial).prop_map(|(a, b)| a.over(&b).unwrap_or(a))
    }

    fn value(f: &RationalFunction) -> Option<Rational> {
        f.at(Variable::name(0), &ratio(7, 3))?.at(Variable::name(1), &ratio(-5, 11))?.as_number()
    }

    #[test]
    fn a_pole_has_no_value() {
        let line = RationalFunction::from(Laurent::variable(Variable::TIME) - Laurent::integer(2));
        let inverse = RationalFunction::from(Laurent::integer(1)).over(&line).unwrap();
        let at = |value: i64| inverse.at(Variable::TIME, &ratio(value, 1));
        assert_eq!((at(2), at(3)), (None, Some(RationalFunction::from(Laurent::integer(1)))));
    }

    proptest! {
        #[test]
        fn arithmetic_is_that_of_values(f in function(), g in function()) {
            if let (Some(a), Some(b)) = (value(&f), value(&g)) {
                prop_assert_eq!(value(&(f.clone() + g.clone())), Some(&a + &b));
                prop_assert_eq!(value(&(f.clone() - g.clone())), Some(&a - &b));
                prop_assert_eq!(value(&(f.clone() * g.clone())), Some(&a * &b));
                if !b.is_zero() {
                    prop_assert_eq!(value(&f.over(&g).unwrap()), Some(a / b));
                }
            }
            prop_assert!((f.clone() - f.clone()).is_zero());
            if let Some(quotient) = f.over(&g) {
                // Lowest terms are unique.
                prop_assert_eq!(quotient * g, f);
            }
        }

        #[test]
        fn square_roots_square(f in function(), g in function()) {
            let (factor, rest) = (f.clone() * f.clone() * g.clone()).square_root();
            let square = factor.clone() * factor * RationalFunction::from(rest.clone());
            prop_assert_eq!(square, f.clone() * f.clone() * g);
            let (root, one) = (f.clone() * f).square_root();
            prop_assert!(root.is_zero() || one == Laurent::integer(1));
        }

        #[test]
        fn a_quotient_with_a_root_is_undone(f in function(), g in function()) {
            // w² = 3 p: (f + w)/(g + w) times (g + w).
            let root = Variable::TIME;
            let square = RationalFunction::from(Laurent::variable(Variable::name(0)).scaled(&3.into()));
            let w = || RationalFunction::from(Laurent::variable(root));
            let below = g + w();
            let quotient = (f.clone() + w()).over(&below).unwrap().with_square(root, &square);
            prop_assert!(!quotient.denominator().contains(root));
            prop_assert_eq!((quotient * below).with_square(root, &square), f + w());
        }
    }
}
