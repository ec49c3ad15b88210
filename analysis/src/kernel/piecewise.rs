//! Piecewise polynomials in `q`, exact and compiled for fast evaluation in `f64`.

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{
    Rational, common_denominator, integer, numerator_over, ratio, reduced, to_f64,
};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// One polynomial on `[previous piece's end, end]`.
#[derive(Debug, Clone)]
pub struct Piece {
    /// The last `q` of the piece.
    pub end: Rational,
    /// The shape in powers of `q`.
    pub shape: Polynomial<Rational>,
    /// The shape and its two derivatives in whole numbers over one denominator: a fraction is reduced once, at the end.
    exact: [(Vec<BigInt>, BigInt); 3],
    compiled: CompiledPiece,
}

/// The shape and its two derivatives in powers of `q − origin`. The origin is 0 for the innermost
/// piece, so that the slope there is exactly zero, and the end of the piece otherwise, so that the
/// kernel vanishes without cancellation at the edge of its support.
#[derive(Debug, Clone)]
struct CompiledPiece {
    end: f64,
    origin: f64,
    derivatives: [Vec<f64>; 3],
}

/// A kernel shape made of polynomial pieces from `q = 0` to the edge of its support.
#[derive(Debug, Clone)]
pub struct PiecewisePolynomial {
    pieces: Vec<Piece>,
}

impl PiecewisePolynomial {
    /// From `(end, polynomial in q)` pairs in ascending order of `end`.
    pub(super) fn new(pieces: Vec<(Rational, Polynomial<Rational>)>) -> Self {
        let pieces = pieces
            .into_iter()
            .enumerate()
            .map(|(index, (end, shape))| {
                let origin = if index == 0 { Rational::zero() } else { end.clone() };
                let shift = Polynomial::new(vec![origin.clone(), integer(1)]);
                let first = shape.derivative();
                let second = first.derivative();
                let derivatives = [&shape, &first, &second].map(|polynomial| {
                    polynomial.compose(&shift).coefficients().iter().map(to_f64).collect()
                });
                let compiled =
                    CompiledPiece { end: to_f64(&end), origin: to_f64(&origin), derivatives };
                let exact = [&shape, &first, &second].map(|polynomial| {
                    let common = common_denominator(polynomial.coefficients());
                    let over = |value: &Rational| numerator_over(value, &common);
                    (polynomial.coefficients().iter().map(over).collect(), common)
                });
                Piece { end, shape, exact, compiled }
            })
            .collect();
        Self { pieces }
    }

    /// The pieces from the centre outwards.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The edge of the support.
    pub fn support(&self) -> &Rational {
        &self.pieces[self.pieces.len() - 1].end
    }

    /// `w(q)` for `q ≥ 0`.
    pub fn value(&self, q: f64) -> f64 {
        self.derivative(q, 0)
    }

    /// `w'(q)` for `q ≥ 0`.
    pub fn slope(&self, q: f64) -> f64 {
        self.derivative(q, 1)
    }

    /// `w''(q)` for `q ≥ 0`.
    pub fn curvature(&self, q: f64) -> f64 {
        self.derivative(q, 2)
    }

    #[inline]
    fn derivative(&self, q: f64, order: usize) -> f64 {
        for piece in &self.pieces {
            let piece = &piece.compiled;
            if q <= piece.end {
                let offset = q - piece.origin;
                return piece.derivatives[order]
                    .iter()
                    .rev()
                    .fold(0.0, |sum, coefficient| sum * offset + coefficient);
            }
        }
        0.0
    }

    /// The exact `order`-th derivative at `q ≥ 0`, `order ≤ 2`, at a knot that of the inner piece (the shapes here
    /// are at least twice continuously differentiable for `q > 0`).
    pub fn exact(&self, q: &Rational, order: usize) -> Rational {
        self.exact_at(1, q, order, &Rational::one())
    }

    /// [`exact`](Self::exact) at `q = k spacing`, times a factor: one fraction, reduced once.
    pub(crate) fn exact_at(
        &self,
        k: i64,
        spacing: &Rational,
        order: usize,
        factor: &Rational,
    ) -> Rational {
        let (n, d) = (spacing.numer() * k, spacing.denom());
        let reaches = |piece: &&Piece| &n * piece.end.denom() <= piece.end.numer() * d;
        let Some(piece) = self.pieces.iter().find(reaches) else {
            return Rational::zero();
        };
        // Σ a_i (n/d)^i = Σ a_i n^i d^(m−i) / d^m
        let (coefficients, denominator) = &piece.exact[order];
        let (mut sum, mut power) = (BigInt::zero(), BigInt::one());
        for coefficient in coefficients.iter().rev() {
            sum = sum * &n + coefficient * &power;
            power *= d;
        }
        reduced(sum * d * factor.numer(), power * denominator * factor.denom())
    }

    /// `∫_0^support q^power w(q) dq`, exactly.
    pub fn half_moment(&self, power: usize) -> Rational {
        let mut start = Rational::zero();
        let mut total = Rational::zero();
        for piece in &self.pieces {
            let weighted = piece.shape.clone() * Polynomial::monomial(integer(1), power);
            let mut antiderivative = vec![Rational::zero()];
            for (degree, coefficient) in (1i64..).zip(weighted.coefficients()) {
                antiderivative.push(coefficient * ratio(1, degree));
            }
            let antiderivative = Polynomial::new(antiderivative);
            total += antiderivative.evaluate(&piece.end) - antiderivative.evaluate(&start);
            start = piece.end.clone();
        }
        total
    }
}
