//! Dense univariate polynomials over any commutative ring.

use num_traits::{One, Zero};
use std::ops::{Add, Mul, Neg, Sub};

/// What a coefficient must be able to do: the operations of a commutative ring.
pub trait Ring:
    Clone + PartialEq + Zero + One + Sub<Output = Self> + Neg<Output = Self> + Mul<Output = Self>
{
}

impl<T> Ring for T where
    T: Clone + PartialEq + Zero + One + Sub<Output = T> + Neg<Output = T> + Mul<Output = T>
{
}

/// `Σ_j c_j t^j`, stored as `[c_0, c_1, …]` without trailing zeros.
///
/// ```
/// use courant_analysis::exact::polynomial::Polynomial;
/// let p = Polynomial::new(vec![1, 2]);          // 1 + 2t
/// assert_eq!((p.clone() * p).coefficients(), &[1, 4, 4]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Polynomial<T> {
    coefficients: Vec<T>,
}

impl<T: Ring> Polynomial<T> {
    /// From the coefficients `[c_0, c_1, …]`; trailing zeros are dropped.
    pub fn new(mut coefficients: Vec<T>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Self { coefficients }
    }

    /// A constant.
    pub fn constant(value: T) -> Self {
        Self::new(vec![value])
    }

    /// `value t^degree`.
    pub fn monomial(value: T, degree: usize) -> Self {
        let mut coefficients = vec![T::zero(); degree];
        coefficients.push(value);
        Self::new(coefficients)
    }

    /// The coefficients `[c_0, c_1, …]`, the last one non-zero.
    pub fn coefficients(&self) -> &[T] {
        &self.coefficients
    }

    /// [`coefficients`](Self::coefficients) of a polynomial that is no longer needed.
    pub fn into_coefficients(self) -> Vec<T> {
        self.coefficients
    }

    /// The coefficient of `t^degree`.
    pub fn coefficient(&self, degree: usize) -> T {
        self.coefficients.get(degree).cloned().unwrap_or_else(T::zero)
    }

    /// The degree; `None` for the zero polynomial.
    pub fn degree(&self) -> Option<usize> {
        self.coefficients.len().checked_sub(1)
    }

    /// The value at `point` by Horner's rule.
    pub fn evaluate(&self, point: &T) -> T {
        self.coefficients
            .iter()
            .rev()
            .fold(T::zero(), |sum, coefficient| sum * point.clone() + coefficient.clone())
    }

    /// The derivative.
    pub fn derivative(&self) -> Self {
        let mut factor = T::zero();
        let mut derived = Vec::with_capacity(self.coefficients.len());
        for coefficient in self.coefficients.iter().skip(1) {
            factor = factor + T::one();
            derived.push(coefficient.clone() * factor.clone());
        }
        Self::new(derived)
    }

    /// `p(q(t))`.
    pub fn compose(&self, inner: &Self) -> Self {
        self.coefficients.iter().rev().fold(Self::zero(), |sum, coefficient| {
            sum * inner.clone() + Self::constant(coefficient.clone())
        })
    }

    /// Every coefficient multiplied by `factor`.
    pub fn scale(&self, factor: &T) -> Self {
        self.map(|coefficient| coefficient.clone() * factor.clone())
    }

    /// Every coefficient passed through `change`, which may change the ring.
    pub fn map<U: Ring>(&self, change: impl FnMut(&T) -> U) -> Polynomial<U> {
        Polynomial::new(self.coefficients.iter().map(change).collect())
    }

    /// `p^exponent`.
    pub fn pow(&self, exponent: usize) -> Self {
        (0..exponent).fold(Self::one(), |product, _| product * self.clone())
    }
}

impl Polynomial<crate::exact::rational::Rational> {
    /// Quotient and remainder of the division by a non-zero polynomial.
    ///
    /// # Panics
    /// When `divisor` is zero.
    pub fn divide(&self, divisor: &Self) -> (Self, Self) {
        let degree = divisor.degree().expect("a polynomial is divided by a non-zero one");
        let leading = &divisor.coefficients[degree];
        let mut rest = self.coefficients.clone();
        let mut quotient = vec![Zero::zero(); (rest.len() + 1).saturating_sub(degree + 1)];
        for shift in (0..quotient.len()).rev() {
            let factor = &rest[shift + degree] / leading;
            for (target, value) in rest[shift..].iter_mut().zip(&divisor.coefficients) {
                *target -= &factor * value;
            }
            quotient[shift] = factor;
        }
        (Self::new(quotient), Self::new(rest))
    }
}

impl Polynomial<num_bigint::BigInt> {
    /// The quotient by a non-zero polynomial, if it has integer coefficients and nothing is left over.
    ///
    /// # Panics
    /// When `divisor` is zero.
    pub fn divide_exactly(&self, divisor: &Self) -> Option<Self> {
        let degree = divisor.degree().expect("a polynomial is divided by a non-zero one");
        let leading = &divisor.coefficients[degree];
        let mut rest = self.coefficients.clone();
        let mut quotient = vec![Zero::zero(); (rest.len() + 1).saturating_sub(degree + 1)];
        for shift in (0..quotient.len()).rev() {
            // What this leaves over stays there to the end.
            let factor = &rest[shift + degree] / leading;
            for (target, value) in rest[shift..].iter_mut().zip(&divisor.coefficients) {
                *target -= &factor * value;
            }
            quotient[shift] = factor;
        }
        rest.iter().all(Zero::is_zero).then(|| Self::new(quotient))
    }
}

impl<T: Ring> Add for Polynomial<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (mut long, short) = if self.coefficients.len() >= other.coefficients.len() {
            (self, other)
        } else {
            (other, self)
        };
        for (target, summand) in long.coefficients.iter_mut().zip(short.coefficients) {
            *target = target.clone() + summand;
        }
        Self::new(long.coefficients)
    }
}

impl<T: Ring> Neg for Polynomial<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { coefficients: self.coefficients.into_iter().map(Neg::neg).collect() }
    }
}

impl<T: Ring> Sub for Polynomial<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Ring> Mul for Polynomial<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        let mut product = vec![T::zero(); self.coefficients.len() + other.coefficients.len() - 1];
        for (i, left) in self.coefficients.iter().enumerate() {
            for (j, right) in other.coefficients.iter().enumerate() {
                product[i + j] = product[i + j].clone() + left.clone() * right.clone();
            }
        }
        Self::new(product)
    }
}

impl<T: Ring> Zero for Polynomial<T> {
    fn zero() -> Self {
        Self { coefficients: Vec::new() }
    }
    fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }
}

impl<T: Ring> One for Polynomial<T> {
    fn one() -> Self {
        Self::constant(T::one())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::integer;
    use proptest::prelude::*;

    fn polynomial() -> impl Strategy<Value = Polynomial<i64>> {
        prop::collection::vec(-20i64..20, 0..5).prop_map(Polynomial::new)
    }

    proptest! {
        #[test]
        fn ring_laws(p in polynomial(), q in polynomial(), r in polynomial()) {
            prop_assert_eq!(p.clone() * q.clone(), q.clone() * p.clone());
            prop_assert_eq!(
                p.clone() * (q.clone() + r.clone()),
                p.clone() * q.clone() + p.clone() * r.clone()
            );
            prop_assert_eq!((p.clone() * q.clone()) * r.clone(), p.clone() * (q.clone() * r));
            prop_assert!((p.clone() - p.clone()).is_zero());
            prop_assert_eq!(p.clone() * Polynomial::one(), p);
            prop_assert!((q * Polynomial::zero()).is_zero());
        }

        #[test]
        fn evaluation_is_a_homomorphism(p in polynomial(), q in polynomial(), t in -9i64..9) {
            prop_assert_eq!((p.clone() * q.clone()).evaluate(&t), p.evaluate(&t) * q.evaluate(&t));
            prop_assert_eq!((p.clone() + q.clone()).evaluate(&t), p.evaluate(&t) + q.evaluate(&t));
            prop_assert_eq!(p.compose(&q).evaluate(&t), p.evaluate(&q.evaluate(&t)));
        }

        #[test]
        fn division_is_undone_by_multiplication(p in polynomial(), q in polynomial()) {
            prop_assume!(!q.is_zero());
            let whole = |p: &Polynomial<i64>| p.map(|&v| num_bigint::BigInt::from(v));
            let product = whole(&p) * whole(&q);
            prop_assert_eq!(product.divide_exactly(&whole(&q)), Some(whole(&p)));
            let one_more = product + Polynomial::one();
            prop_assert!(q.degree() == Some(0) || one_more.divide_exactly(&whole(&q)).is_none());
            let (p, q) = (p.map(|&v| integer(v)), q.map(|&v| integer(v)));
            let (quotient, rest) = p.divide(&q);
            prop_assert!(rest.degree() < q.degree() || rest.is_zero());
            prop_assert_eq!(quotient * q + rest, p);
        }

        #[test]
        fn the_product_rule(p in polynomial(), q in polynomial()) {
            prop_assert_eq!(
                (p.clone() * q.clone()).derivative(),
                p.derivative() * q.clone() + p * q.derivative()
            );
        }
    }
}
