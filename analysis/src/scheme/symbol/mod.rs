//! Symbols: what a one-step scheme does to `e^{iκx}`, as a polynomial in the Courant number `C` whose
//! coefficients are stencils.

mod enclosed;
mod print;

pub use enclosed::EnclosedSymbol;

use crate::exact::polynomial::{Polynomial, Ring};
use crate::exact::rational::{Rational, to_f64};
use crate::exact::stencil::Stencil;
use num_complex::Complex64;
use num_traits::{One, Zero};
use std::ops::{Add, Mul, Neg, Sub};

/// `S = Σ_j C^j S_j` with stencils `S_j`; one step of the scheme is `u ← S u`, and its amplification
/// factor is `g(φ) = Σ_j C^j Σ_k S_{j,k} e^{ikφ}`.
///
/// ```
/// use courant_analysis::{exact::stencil::Stencil, scheme::symbol::Symbol};
/// // First-order upwind: u_i − C (u_i − u_{i−1}).
/// let backward: Stencil<i64> = Stencil::shift(0) - Stencil::shift(-1);
/// let upwind = Symbol::identity() - Symbol::courant_power(1, backward);
/// assert_eq!(upwind.coefficient(-1).coefficients(), &[0, 1]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Symbol<T>(Polynomial<Stencil<T>>);

impl<T: Ring> Symbol<T> {
    /// The scheme that does nothing.
    pub fn identity() -> Self {
        Self(Polynomial::one())
    }

    /// `C^power` times a stencil.
    pub fn courant_power(power: usize, stencil: Stencil<T>) -> Self {
        Self(Polynomial::monomial(stencil, power))
    }

    /// The stencils `[S_0, S_1, …]` by power of `C`.
    pub fn stencils(&self) -> &[Stencil<T>] {
        self.0.coefficients()
    }

    /// The lowest and the highest offset; `None` for the zero symbol.
    pub fn reach(&self) -> Option<(i64, i64)> {
        let reaches = self.stencils().iter().filter_map(Stencil::reach);
        reaches.reduce(|(a, b), (c, d)| (a.min(c), b.max(d)))
    }

    /// The coefficient of `E^offset`, a polynomial in `C`.
    pub fn coefficient(&self, offset: i64) -> Polynomial<T> {
        Polynomial::new(self.stencils().iter().map(|s| s.coefficient(offset)).collect())
    }

    /// The stencil at one Courant number.
    pub fn at_courant_number(&self, courant_number: &T) -> Stencil<T> {
        self.0.evaluate(&Stencil::term(0, courant_number.clone()))
    }

    /// The derivative with respect to the Courant number.
    pub fn courant_derivative(&self) -> Self {
        Self(self.0.derivative())
    }

    /// The moment `Σ_k c_k k^power`, a polynomial in `C`.
    pub fn moment(&self, power: u32, integer: impl Fn(i64) -> T + Copy) -> Polynomial<T> {
        Polynomial::new(self.stencils().iter().map(|s| s.moment(power, integer)).collect())
    }

    /// Every coefficient passed through `change`, which may change the ring.
    pub fn map<U: Ring>(&self, mut change: impl FnMut(&T) -> U) -> Symbol<U> {
        Symbol(self.0.map(|stencil| stencil.map(&mut change)))
    }
}

impl Symbol<Rational> {
    /// The numeric form, each coefficient correctly rounded.
    pub fn compile(&self) -> Symbol<f64> {
        self.map(to_f64)
    }
}

impl Symbol<f64> {
    /// The amplification factor `g` at a Courant number and a phase in radians.
    pub fn amplification(&self, courant_number: f64, phase: f64) -> Complex64 {
        let powers = self.stencils().iter().rev().map(|stencil| stencil.at_phase(phase));
        powers.fold(Complex64::zero(), |sum, value| sum * courant_number + value)
    }
}

impl<T: Ring> Add for Symbol<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<T: Ring> Sub for Symbol<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<T: Ring> Neg for Symbol<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<T: Ring> Mul for Symbol<T> {
    type Output = Self;
    /// One scheme after the other.
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{integer, ratio};
    use proptest::prelude::*;

    pub(super) fn symbol() -> impl Strategy<Value = Symbol<Rational>> {
        let stencil =
            (-3i64..3, prop::collection::vec(-9i64..9, 0..4)).prop_map(|(low, values)| {
                Stencil::new(low, values.into_iter().map(integer).collect::<Vec<_>>())
            });
        prop::collection::vec(stencil, 0..4).prop_map(|stencils| Symbol(Polynomial::new(stencils)))
    }

    proptest! {
        #[test]
        fn ring_laws(a in symbol(), b in symbol(), c in symbol()) {
            prop_assert_eq!(a.clone() * b.clone(), b.clone() * a.clone());
            prop_assert_eq!(
                a.clone() * (b.clone() + c.clone()),
                a.clone() * b.clone() + a.clone() * c.clone()
            );
            prop_assert_eq!((a.clone() * b.clone()) * c.clone(), a.clone() * (b * c));
            prop_assert_eq!(a.clone() * Symbol::identity(), a);
        }

        #[test]
        fn fixing_the_courant_number_is_a_homomorphism(a in symbol(), b in symbol(), n in -20i64..20) {
            let courant_number = ratio(n, 7);
            prop_assert_eq!(
                (a.clone() * b.clone()).at_courant_number(&courant_number),
                a.at_courant_number(&courant_number) * b.at_courant_number(&courant_number)
            );
        }

        #[test]
        fn the_compiled_form_agrees_with_complex_exponentials(
            a in symbol(), courant_number in -2.0f64..2.0, phase in 0.0f64..3.2
        ) {
            let mut plain = Complex64::zero();
            for (power, stencil) in (0..).zip(a.stencils()) {
                for (offset, value) in stencil.terms() {
                    plain += to_f64(value) * courant_number.powi(power)
                        * Complex64::new(0.0, offset as f64 * phase).exp();
                }
            }
            // At most 16 terms below 72 in size.
            prop_assert!((a.compile().amplification(courant_number, phase) - plain).norm() < 1e-11);
        }

        #[test]
        fn the_derivative_is_the_limit_of_differences(a in symbol(), n in -9i64..9) {
            // Degree at most 3: the central difference is the derivative plus step² times the cubic term.
            let (point, step) = (integer(n), ratio(1, 1000));
            let difference = (a.at_courant_number(&(&point + &step))
                - a.at_courant_number(&(&point - &step))) * Stencil::term(0, integer(500));
            let cubic = a.stencils().get(3).cloned().unwrap_or_else(Stencil::zero)
                * Stencil::term(0, &step * &step);
            prop_assert_eq!(difference - cubic, a.courant_derivative().at_courant_number(&point));
        }
    }
}
