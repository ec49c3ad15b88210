//! When both multipliers of a step lie in the unit disc: the Schur–Cohn (Jury) conditions as
//! polynomials in `f = FΔt²` and `g = GΔt`.

use super::{Integrator, Number};
use crate::exact::polynomial::{Polynomial, Ring};
use crate::exact::rational::{Rational, integer, to_f64};
use num_traits::{One, Zero};
use std::sync::LazyLock;

/// `Σ c_{ij} f^i g^j`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BivariatePolynomial {
    /// Outer powers of `f`, inner powers of `g`.
    rows: Polynomial<Polynomial<Rational>>,
}

impl BivariatePolynomial {
    /// The non-zero terms `(i, j, c_ij)`.
    pub fn terms(&self) -> impl Iterator<Item = (usize, usize, &Rational)> {
        self.rows.coefficients().iter().enumerate().flat_map(|(i, row)| {
            let terms = row.coefficients().iter().enumerate();
            terms.filter(|(_, value)| !value.is_zero()).map(move |(j, value)| (i, j, value))
        })
    }

    /// The value, by Horner's rule in both variables.
    pub fn evaluate<T: Ring>(&self, f: &T, g: &T, lift: impl Fn(&Rational) -> T) -> T {
        self.rows.coefficients().iter().rev().fold(T::zero(), |sum, row| {
            let inner = row.coefficients().iter().rev();
            let inner = inner.fold(T::zero(), |sum, c| sum * g.clone() + lift(c));
            sum * f.clone() + inner
        })
    }

    /// The coefficients rounded to `f64`, `[power of f][power of g]`.
    pub fn compile(&self) -> CompiledBivariate {
        let rows = self.rows.coefficients().iter();
        CompiledBivariate(rows.map(|row| row.coefficients().iter().map(to_f64).collect()).collect())
    }
}

/// A [`BivariatePolynomial`] in `f64`.
#[derive(Debug, Clone)]
pub struct CompiledBivariate(Vec<Vec<f64>>);

impl CompiledBivariate {
    /// The value by Horner's rule, for real or complex arguments.
    #[inline]
    pub fn at<T>(&self, f: T, g: T) -> T
    where
        T: Copy + Zero + std::ops::Mul<Output = T> + std::ops::Add<f64, Output = T>,
    {
        self.0.iter().rev().fold(T::zero(), |sum, row| {
            sum * f + row.iter().rev().fold(T::zero(), |sum, &c| sum * g + c)
        })
    }
}

/// What decides the multipliers `z` of a step with matrix `A`, `τ = tr A`, `δ = det A`.
///
/// With `z = 1 + y`, `y² − e y + d = 0`, where `e = τ − 2` and `d = 1 − τ + δ = det(I − A)`. None of
/// `e`, `d` and `1 − δ` has a constant term, so small steps lose no digits.
///
/// ```
/// use courant_analysis::scheme::integrator::Integrator;
/// use courant_analysis::exact::rational::{Rational, ratio};
/// // RK2 at ωΔt = 1/2: |z|² = 1 + (ωΔt)⁴/4.
/// let polynomials = Integrator::Rk2Heun.polynomials();
/// let f = ratio(-1, 4);
/// let loss = polynomials.loss().evaluate(&f, &ratio(0, 1), Rational::clone);
/// assert_eq!(loss, -ratio(1, 64));
/// ```
#[derive(Debug, Clone)]
pub struct StepPolynomials {
    excess_trace: BivariatePolynomial,
    determinant_of_difference: BivariatePolynomial,
    loss: BivariatePolynomial,
    pub(super) compiled: [CompiledBivariate; 3],
}

impl StepPolynomials {
    fn new(integrator: Integrator) -> Self {
        type Bivariate = Polynomial<Polynomial<Rational>>;
        let f = Bivariate::monomial(Polynomial::one(), 1);
        let g = Bivariate::constant(Polynomial::monomial(integer(1), 1));
        let [[a, b], [c, d]] = integrator.matrix(&f, &g);
        let trace = a.clone() + d.clone();
        let determinant = a * d - b * c;
        let wrap = |rows| BivariatePolynomial { rows };
        let excess_trace = wrap(trace.clone() - Bivariate::fraction(2, 1));
        let determinant_of_difference = wrap(Bivariate::one() - trace + determinant.clone());
        let loss = wrap(Bivariate::one() - determinant);
        let compiled =
            [&excess_trace, &determinant_of_difference, &loss].map(BivariatePolynomial::compile);
        Self { excess_trace, determinant_of_difference, loss, compiled }
    }

    /// `e = τ − 2`, the sum of the `z − 1`.
    pub fn excess_trace(&self) -> &BivariatePolynomial {
        &self.excess_trace
    }

    /// `d = 1 − τ + δ`, the product of the `z − 1`.
    pub fn determinant_of_difference(&self) -> &BivariatePolynomial {
        &self.determinant_of_difference
    }

    /// `1 − δ`: `1 − |z|²` of a complex pair.
    pub fn loss(&self) -> &BivariatePolynomial {
        &self.loss
    }

    /// The conditions for `|z| ≤ r` of both multipliers, `r = 1 + growth`, each to be non-negative:
    /// `[r² − rτ + δ, r² + rτ + δ, r² − δ]` — none passes `+r`, none passes `−r`, no pair leaves the
    /// circle. Necessary and sufficient for real `f`, `g`; a double multiplier *on* the circle passes.
    pub fn conditions(&self, growth: &Rational) -> [BivariatePolynomial; 3] {
        type Bivariate = Polynomial<Polynomial<Rational>>;
        let constant = |value: Rational| Bivariate::constant(Polynomial::constant(value));
        let scale = |rows: &Bivariate, factor: Rational| rows.clone() * constant(factor);
        let r = growth + integer(1);
        let (e, d) = (&self.excess_trace.rows, &self.determinant_of_difference.rows);
        // δ = 1 − loss, τ = e + 2, and r² − rτ + δ = d − (r − 1)e + (r − 1)².
        let first = d.clone() - scale(e, growth.clone()) + constant(growth * growth);
        let determinant = Bivariate::one() - self.loss.rows.clone();
        let second = scale(e, r.clone()) + constant(&r * &r + integer(2) * &r) + determinant;
        let third = self.loss.rows.clone() + constant(&r * &r - integer(1));
        [first, second, third].map(|rows| BivariatePolynomial { rows })
    }
}

impl Integrator {
    /// The polynomials that decide the multipliers of one step.
    pub fn polynomials(self) -> &'static StepPolynomials {
        static ALL: LazyLock<Vec<StepPolynomials>> =
            LazyLock::new(|| Integrator::ALL.into_iter().map(StepPolynomials::new).collect());
        // The declaration order is the order of ALL: held by a test.
        &ALL[self as usize]
    }
}
