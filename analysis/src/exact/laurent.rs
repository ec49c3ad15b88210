//! Laurent polynomials in several variables with integer coefficients.
//!
//! Everything a scheme is made of before a number is put in: the time shift `z`, the shifts `E_1, E_2, E_3` along the axes, and
//! names (parameters, weights that are no fractions). A common integer factor never matters to what is asked, so fractions are
//! cleared at the start and all arithmetic is in integers.

mod divisor;
mod print;
mod product;
mod square_free;

pub(crate) use divisor::common_divisor;
pub use divisor::greatest_common_divisor;
pub use print::latex;

use crate::exact::rational::{Rational, greatest_divisor};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// How many variables there are: the time shift, three axes, and names.
pub const VARIABLES: usize = 16;

/// One power of each variable.
pub type Exponents = [i16; VARIABLES];

/// A variable by its place among the exponents.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Variable(pub usize);

impl Variable {
    /// The shift by one time level, `z`.
    pub const TIME: Self = Self(0);

    /// The shift `E_a` by one cell along axis `a`, from 0.
    pub const fn axis(axis: usize) -> Self {
        Self(1 + axis)
    }

    /// The name with this number, from 0; there are [`NAMES`].
    pub const fn name(number: usize) -> Self {
        Self(4 + number)
    }
}

/// How many names one polynomial can have.
pub const NAMES: usize = VARIABLES - 4;

/// `Σ c x_1^{e_1} x_2^{e_2} …`, terms in ascending order of their exponents, none of them zero.
///
/// ```
/// use courant_analysis::exact::laurent::{Laurent, Variable};
/// let shift = Laurent::variable(Variable::axis(0));
/// let difference = Laurent::integer(1) - shift.inverse_monomial().unwrap();      // 1 − 1/E
/// let product = difference.clone() * difference.conjugate();                     // |1 − 1/E|²
/// assert_eq!(product.to_string(), "-E^-1 + 2 - E");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct Laurent {
    terms: Vec<(Exponents, BigInt)>,
}

impl Laurent {
    /// From terms in any order; equal exponents are added up.
    pub fn new(mut terms: Vec<(Exponents, BigInt)>) -> Self {
        terms.sort_by_key(|term| term.0);
        let mut merged: Vec<(Exponents, BigInt)> = Vec::with_capacity(terms.len());
        for (exponents, value) in terms {
            match merged.last_mut() {
                Some(last) if last.0 == exponents => last.1 += value,
                _ => merged.push((exponents, value)),
            }
        }
        merged.retain(|(_, value)| !value.is_zero());
        Self { terms: merged }
    }

    /// From terms that are in order and not zero.
    fn from_sorted(terms: Vec<(Exponents, BigInt)>) -> Self {
        debug_assert!(terms.windows(2).all(|pair| pair[0].0 < pair[1].0));
        Self { terms }
    }

    /// A constant.
    pub fn constant(value: BigInt) -> Self {
        Self::monomial([0; VARIABLES], value)
    }

    /// A small constant.
    pub fn integer(value: i64) -> Self {
        Self::constant(value.into())
    }

    /// One term.
    pub fn monomial(exponents: Exponents, value: BigInt) -> Self {
        let terms = if value.is_zero() { Vec::new() } else { vec![(exponents, value)] };
        Self { terms }
    }

    /// A variable.
    pub fn variable(variable: Variable) -> Self {
        Self::power_of(variable, 1)
    }

    /// A power of a variable.
    pub fn power_of(variable: Variable, exponent: i16) -> Self {
        let mut exponents = [0; VARIABLES];
        exponents[variable.0] = exponent;
        Self::monomial(exponents, BigInt::one())
    }

    /// The terms.
    pub fn terms(&self) -> &[(Exponents, BigInt)] {
        &self.terms
    }

    /// The only term, if there is just one.
    pub fn as_monomial(&self) -> Option<&(Exponents, BigInt)> {
        match self.terms.as_slice() {
            [term] => Some(term),
            _ => None,
        }
    }

    /// The value of a constant.
    pub fn as_constant(&self) -> Option<BigInt> {
        match self.terms.as_slice() {
            [] => Some(BigInt::zero()),
            [(exponents, value)] if exponents.iter().all(|&e| e == 0) => Some(value.clone()),
            _ => None,
        }
    }

    /// The inverse of a monomial with coefficient ±1.
    pub fn inverse_monomial(&self) -> Option<Self> {
        let (exponents, value) = self.as_monomial()?;
        value.abs().is_one().then(|| Self::monomial(exponents.map(|e| -e), value.clone()))
    }

    /// The least and the greatest power of a variable; `None` for zero.
    pub fn range(&self, variable: Variable) -> Option<(i16, i16)> {
        let powers = self.terms.iter().map(|(exponents, _)| exponents[variable.0]);
        powers.map(|power| (power, power)).reduce(|(a, b), (c, d)| (a.min(c), b.max(d)))
    }

    /// Whether a variable occurs.
    pub fn contains(&self, variable: Variable) -> bool {
        self.terms.iter().any(|(exponents, _)| exponents[variable.0] != 0)
    }

    /// The degree in a variable; 0 for zero.
    pub fn degree(&self, variable: Variable) -> i16 {
        self.range(variable).map_or(0, |(_, highest)| highest)
    }

    /// Multiplied by a power of a variable.
    pub fn shifted(&self, variable: Variable, by: i16) -> Self {
        let terms = self.terms.iter().map(|(exponents, value)| {
            let mut moved = *exponents;
            moved[variable.0] += by;
            (moved, value.clone())
        });
        Self::from_sorted(terms.collect())
    }

    /// The coefficients `[c_0, c_1, …]` of the powers of a variable that has no negative powers.
    ///
    /// # Panics
    /// When it has.
    pub fn coefficients(&self, variable: Variable) -> Vec<Self> {
        let mut rows: Vec<Vec<(Exponents, BigInt)>> = Vec::new();
        for (exponents, value) in &self.terms {
            let power = usize::try_from(exponents[variable.0]).expect("no negative powers");
            if rows.len() <= power {
                rows.resize_with(power + 1, Vec::new);
            }
            let mut rest = *exponents;
            rest[variable.0] = 0;
            rows[power].push((rest, value.clone()));
        }
        // Taking out one power keeps the order of the terms that share it.
        rows.into_iter().map(Self::from_sorted).collect()
    }

    /// `Σ_j c_j x^j` from `[c_0, c_1, …]`.
    pub fn from_coefficients(coefficients: &[Self], variable: Variable) -> Self {
        (0..).zip(coefficients).fold(Self::default(), |sum, (power, coefficient)| {
            sum + coefficient.shifted(variable, power)
        })
    }

    /// Every `E` replaced by `1/E`: the complex conjugate on a wave.
    pub fn conjugate(&self) -> Self {
        let terms = self.terms.iter().map(|(exponents, value)| {
            let mut mirrored = *exponents;
            (1..4).for_each(|axis| mirrored[axis] = -mirrored[axis]);
            (mirrored, value.clone())
        });
        Self::new(terms.collect())
    }

    /// Whether it is its own conjugate: a real function of the wave.
    pub fn is_real(&self) -> bool {
        *self == self.conjugate()
    }

    /// The derivative with respect to a variable.
    pub fn derivative(&self, variable: Variable) -> Self {
        let terms = self.terms.iter().filter(|(exponents, _)| exponents[variable.0] != 0);
        let terms = terms.map(|(exponents, value)| {
            let mut lowered = *exponents;
            lowered[variable.0] -= 1;
            (lowered, value * exponents[variable.0])
        });
        Self::from_sorted(terms.collect())
    }

    /// Every coefficient multiplied by an integer.
    pub fn scaled(&self, factor: &BigInt) -> Self {
        if factor.is_zero() {
            return Self::default();
        }
        let terms = self.terms.iter().map(|(exponents, value)| (*exponents, value * factor));
        Self::from_sorted(terms.collect())
    }

    /// The greatest integer that divides all coefficients; 0 for zero.
    pub fn integer_content(&self) -> BigInt {
        let values = self.terms.iter().map(|(_, value)| value);
        values.fold(
            BigInt::zero(),
            |all, value| {
                if all.is_one() { all } else { greatest_divisor(&all, value) }
            },
        )
    }

    /// Divided by the [content](Self::integer_content), and by the least power of every variable.
    pub fn primitive(&self) -> Self {
        if self.terms.is_empty() {
            return self.clone();
        }
        let content = self.integer_content();
        let lowest = self.lowest_powers();
        let terms = self.terms.iter().map(|(exponents, value)| {
            let mut lowered = *exponents;
            lowered.iter_mut().zip(lowest).for_each(|(power, least)| *power -= least);
            (lowered, value / &content)
        });
        Self::from_sorted(terms.collect())
    }

    /// The least power of every variable: the monomial that divides all terms.
    pub fn lowest_powers(&self) -> Exponents {
        let mut lowest = self.terms.first().map_or([0; VARIABLES], |term| term.0);
        for (exponents, _) in &self.terms {
            for (least, power) in lowest.iter_mut().zip(exponents) {
                *least = (*least).min(*power);
            }
        }
        lowest
    }

    /// With a fraction for a variable that has no negative powers, times a positive integer that clears the denominators: the
    /// denominator to the power of the degree.
    pub fn at_fraction(&self, variable: Variable, value: &Rational) -> Self {
        let degree = self.degree(variable);
        let powers = |base: &BigInt| -> Vec<BigInt> {
            std::iter::successors(Some(BigInt::one()), |power| Some(power * base))
                .take(degree.max(0) as usize + 1)
                .collect()
        };
        let (numerators, denominators) = (powers(value.numer()), powers(value.denom()));
        let terms = self.terms.iter().map(|(exponents, coefficient)| {
            let power = exponents[variable.0];
            let mut rest = *exponents;
            rest[variable.0] = 0;
            let factor = &numerators[power as usize] * &denominators[(degree - power) as usize];
            (rest, coefficient * factor)
        });
        Self::new(terms.collect())
    }

    /// With `numerator/denominator` for a variable that has no negative powers, times `denominator` to the power of the degree.
    pub fn substitute(&self, variable: Variable, numerator: &Self, denominator: &Self) -> Self {
        let coefficients = self.coefficients(variable);
        let mut power = Self::integer(1);
        let mut sum = Self::default();
        for coefficient in coefficients.iter().rev() {
            sum = sum * numerator.clone() + coefficient.clone() * power.clone();
            power = power * denominator.clone();
        }
        sum
    }

    /// The power with a natural exponent.
    pub fn pow(&self, exponent: usize) -> Self {
        (0..exponent).fold(Self::integer(1), |product, _| product * self.clone())
    }

    /// Whether there are no terms.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The sum, or the difference.
    fn merged(self, other: Self, subtracted: bool) -> Self {
        let signed = |value: BigInt| if subtracted { -value } else { value };
        let mut left = self.terms.into_iter().peekable();
        let mut right = other.terms.into_iter().peekable();
        let mut terms = Vec::with_capacity(left.len() + right.len());
        loop {
            let order = match (left.peek(), right.peek()) {
                (Some(a), Some(b)) => a.0.cmp(&b.0),
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (None, None) => break,
            };
            match order {
                Ordering::Less => terms.extend(left.next()),
                Ordering::Greater => {
                    terms.extend(right.next().map(|(exponents, value)| (exponents, signed(value))));
                }
                Ordering::Equal => {
                    if let (Some((exponents, a)), Some((_, b))) = (left.next(), right.next()) {
                        let sum = a + signed(b);
                        if !sum.is_zero() {
                            terms.push((exponents, sum));
                        }
                    }
                }
            }
        }
        Self { terms }
    }
}

impl Add for Laurent {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.merged(other, false)
    }
}

impl Sub for Laurent {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.merged(other, true)
    }
}

impl Neg for Laurent {
    type Output = Self;
    fn neg(mut self) -> Self {
        for (_, value) in &mut self.terms {
            *value = -std::mem::take(value);
        }
        self
    }
}

impl Mul for Laurent {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        product::product(&self, &other)
    }
}

impl Mul for &Laurent {
    type Output = Laurent;
    fn mul(self, other: Self) -> Laurent {
        product::product(self, other)
    }
}

impl Zero for Laurent {
    fn zero() -> Self {
        Self::default()
    }
    fn is_zero(&self) -> bool {
        self.terms().is_empty()
    }
}

impl One for Laurent {
    fn one() -> Self {
        Self::constant(BigInt::one())
    }
}

#[cfg(test)]
mod tests;
