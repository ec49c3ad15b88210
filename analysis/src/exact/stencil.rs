//! Stencils: Laurent polynomials `Σ_k c_k E^k` in the shift operator `(E u)_i = u_{i+1}`.

use crate::exact::polynomial::{Polynomial, Ring};
use num_complex::Complex64;
use num_traits::{One, Zero};
use std::ops::{Add, Mul, Neg, Sub};

/// `Σ_k c_k E^k = E^lowest p(E)`, with a polynomial `p` whose constant term is not zero.
///
/// ```
/// use courant_analysis::exact::stencil::Stencil;
/// let difference = Stencil::shift(0) - Stencil::shift(-1);   // u_i − u_{i−1}
/// let second = difference.clone() * difference;              // u_i − 2u_{i−1} + u_{i−2}
/// assert_eq!(second, Stencil::new(-2, vec![1, -2, 1]));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stencil<T> {
    lowest: i64,
    polynomial: Polynomial<T>,
}

impl<T: Ring> Stencil<T> {
    /// From the lowest offset and the coefficients above it.
    pub fn new(lowest: i64, mut coefficients: Vec<T>) -> Self {
        let leading = coefficients.iter().take_while(|value| value.is_zero()).count();
        coefficients.drain(..leading);
        let lowest = if coefficients.is_empty() { 0 } else { lowest + leading as i64 };
        Self { lowest, polynomial: Polynomial::new(coefficients) }
    }

    /// `E^offset`.
    pub fn shift(offset: i64) -> Self {
        Self::new(offset, vec![T::one()])
    }

    /// `value E^offset`.
    pub fn term(offset: i64, value: T) -> Self {
        Self::new(offset, vec![value])
    }

    /// The offsets and their coefficients, ascending; zeros in between included.
    pub fn terms(&self) -> impl Iterator<Item = (i64, &T)> {
        (self.lowest..).zip(self.polynomial.coefficients())
    }

    /// The lowest and the highest offset; `None` for the zero stencil.
    pub fn reach(&self) -> Option<(i64, i64)> {
        let degree = self.polynomial.degree()?;
        Some((self.lowest, self.lowest + degree as i64))
    }

    /// Every coefficient passed through `change`, which may change the ring.
    pub fn map<U: Ring>(&self, change: impl FnMut(&T) -> U) -> Stencil<U> {
        Stencil::new(self.lowest, self.polynomial.coefficients().iter().map(change).collect())
    }
}

impl Stencil<f64> {
    /// What the stencil does to `e^{iφj}`: `Σ_k c_k e^{ikφ}`, `phase` in radians.
    pub fn at_phase(&self, phase: f64) -> Complex64 {
        self.terms()
            .map(|(offset, value)| value * Complex64::from_polar(1.0, offset as f64 * phase))
            .sum()
    }
}

impl<T: Ring> Add for Stencil<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (Some((a, b)), Some((c, d))) = (self.reach(), other.reach()) else {
            return if self.is_zero() { other } else { self };
        };
        let lowest = a.min(c);
        let mut sum = vec![T::zero(); (b.max(d) - lowest + 1) as usize];
        for stencil in [self, other] {
            let start = (stencil.lowest - lowest) as usize;
            for (target, value) in
                sum[start..].iter_mut().zip(stencil.polynomial.into_coefficients())
            {
                *target = target.clone() + value;
            }
        }
        Self::new(lowest, sum)
    }
}

impl<T: Ring> Neg for Stencil<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lowest: self.lowest, polynomial: -self.polynomial }
    }
}

impl<T: Ring> Sub for Stencil<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Ring> Mul for Stencil<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.polynomial * other.polynomial;
        Self::new(self.lowest + other.lowest, product.into_coefficients())
    }
}

impl<T: Ring> Zero for Stencil<T> {
    fn zero() -> Self {
        Self { lowest: 0, polynomial: Polynomial::zero() }
    }
    fn is_zero(&self) -> bool {
        self.polynomial.is_zero()
    }
}

impl<T: Ring> One for Stencil<T> {
    fn one() -> Self {
        Self::shift(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn stencil() -> impl Strategy<Value = Stencil<i64>> {
        (-4i64..4, prop::collection::vec(-9i64..9, 0..6))
            .prop_map(|(lowest, coefficients)| Stencil::new(lowest, coefficients))
    }

    proptest! {
        #[test]
        fn ring_laws(a in stencil(), b in stencil(), c in stencil()) {
            prop_assert_eq!(a.clone() + b.clone(), b.clone() + a.clone());
            prop_assert_eq!(a.clone() * b.clone(), b.clone() * a.clone());
            prop_assert_eq!((a.clone() + b.clone()) + c.clone(), a.clone() + (b.clone() + c.clone()));
            prop_assert_eq!((a.clone() * b.clone()) * c.clone(), a.clone() * (b.clone() * c.clone()));
            prop_assert_eq!(
                a.clone() * (b.clone() + c.clone()),
                a.clone() * b.clone() + a.clone() * c
            );
            prop_assert!((a.clone() - a.clone()).is_zero());
            prop_assert_eq!(a.clone() * Stencil::one(), a.clone());
            prop_assert!((b * Stencil::zero()).is_zero());
            prop_assert_eq!(a.clone() * Stencil::shift(3) * Stencil::shift(-3), a);
        }

        #[test]
        fn the_symbol_of_a_product_is_the_product_of_symbols(
            a in stencil(), b in stencil(), phase in -3.2f64..3.2
        ) {
            let (x, y) = (a.map(|&v| v as f64), b.map(|&v| v as f64));
            let product = (a * b).map(|&v| v as f64);
            // At most 36 products of size 81, each rounded once.
            prop_assert!((product.at_phase(phase) - x.at_phase(phase) * y.at_phase(phase)).norm() < 1e-11);
        }
    }
}
