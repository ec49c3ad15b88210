//! A part of wave space as a unit cube, with a condition on it.

use super::piece::Turn;
use crate::exact::bernstein::polar_weights;
use crate::exact::rational::{Rational, from_f64, numerator_over, to_f64};
use crate::exact::tensor::{Origin, Tensor};
use crate::stability::Wave;
use num_bigint::BigInt;
use num_traits::One;
use std::f64::consts::PI;
use std::rc::Rc;
use std::sync::Arc;

/// A condition on a unit cube of waves.
#[derive(Debug, Clone)]
pub(crate) struct Cell {
    /// What the axes of the piece are, from which it was blown up.
    pub(crate) turns: Arc<[Turn]>,
    /// Where the cube lies in the piece.
    pub(crate) origin: Rc<Origin>,
    /// `P(x_1, …, x_d, t)`, the parameter last.
    pub(crate) polynomial: Tensor,
}

/// Where a wave stands for a long one, the direction is seen from this near.
const NEAR: f64 = 1e-12;

impl Cell {
    pub(crate) fn dimension(&self) -> usize {
        self.turns.len()
    }

    /// The coefficients `[p_0, p_1, …]` of the powers of `t` at a point, times a positive integer.
    pub(crate) fn at_point(&self, point: &[Rational]) -> Vec<BigInt> {
        let parameter_degree = *self.polynomial.degrees().last().expect("the parameter is an axis");
        (0..=parameter_degree)
            .map(|power| self.polynomial.slice(self.dimension(), power).integer_at(point).0)
            .collect()
    }

    /// The polynomial in the waves at a value of `t`, times a positive integer.
    pub(crate) fn at_parameter(&self, t: &Rational) -> Tensor {
        let axis = self.dimension();
        let degree = self.polynomial.degrees()[axis];
        let weight = |power: usize| {
            vec![t.numer().pow(power as u32) * t.denom().pow((degree - power) as u32)]
        };
        let rows: Vec<Vec<BigInt>> = (0..=degree).map(weight).collect();
        self.polynomial.contracted(axis, &rows).slice(axis, 0)
    }

    /// With a value for `t`.
    pub(crate) fn with_parameter(&self, t: &Rational) -> Self {
        Self { polynomial: self.at_parameter(t).with_an_axis(), ..self.clone() }
    }

    /// Whether the condition says nothing.
    pub(crate) fn is_zero(&self) -> bool {
        self.polynomial.is_zero()
    }

    /// Multiples of the Bernstein coefficients in `t` on an interval, polynomials in the waves: where all of them are nowhere negative,
    /// so is the condition for every `t` of the interval. The first and the last are its values at the ends.
    pub(crate) fn between(&self, from: &Rational, to: &Rational) -> Vec<Tensor> {
        let axis = self.dimension();
        let degree = self.polynomial.degrees()[axis];
        let weights = polar_weights(degree, from, to);
        let rows: Vec<Vec<BigInt>> = (0..=degree)
            .map(|power| weights.iter().map(|row| row[power].clone()).collect())
            .collect();
        let mixed = self.polynomial.contracted(axis, &rows);
        (0..=degree).map(|index| mixed.slice(axis, index)).collect()
    }

    /// The coefficients in `t` in reversed order: `t` becomes `1/t`.
    pub(crate) fn reversed(&self) -> Self {
        Self { polynomial: self.polynomial.reversed(self.dimension()), ..self.clone() }
    }

    /// The wave at a point of the cube.
    pub(crate) fn wave(&self, point: &[Rational]) -> Wave {
        let phases = self.phases(point);
        if phases.iter().any(|phase| *phase != 0.0) {
            return Wave::new(phases);
        }
        let inside = from_f64(NEAR).expect("a number");
        let towards = |x: &Rational| if *x < inside { inside.clone() } else { x.clone() };
        Wave::long(&self.phases(&point.iter().map(towards).collect::<Vec<_>>()))
    }

    fn phases(&self, point: &[Rational]) -> Vec<f64> {
        let in_piece = self.origin.in_whole(point.to_vec());
        self.turns.iter().zip(&in_piece).map(|(turn, x)| turn.phase(x)).collect()
    }

    /// Prepared for values in `f64`.
    pub(crate) fn compile(&self) -> CompiledCell {
        let bits = self.polynomial.values().iter().map(BigInt::bits).max().unwrap_or(0);
        let unit = BigInt::from(1) << bits;
        let value = |value: &BigInt| crate::exact::rational::quotient_to_f64(value, &unit);
        CompiledCell {
            degrees: self.polynomial.degrees().to_vec(),
            values: self.polynomial.values().iter().map(value).collect(),
        }
    }
}

impl Turn {
    /// The phase at a point of `[0, 1]`, in `(−π, π]`, to all digits next to both ends.
    pub(super) fn phase(self, x: &Rational) -> f64 {
        let complement = Rational::one() - x;
        let is_upper = *x > complement;
        match self {
            Self::Half if is_upper => PI - 2.0 * to_f64(&complement).max(0.0).sqrt().asin(),
            Self::Half => 2.0 * to_f64(x).max(0.0).sqrt().asin(),
            Self::Quarter(turn) if is_upper => {
                // atan x = π/4 − atan((1 − x)/(1 + x))
                let before = 2.0 * to_f64(&(complement / (Rational::one() + x))).atan();
                match turn {
                    3 => -before,
                    turn => in_range(f64::from(turn + 1) * 0.5 * PI, -before),
                }
            }
            Self::Quarter(0) => 2.0 * to_f64(x).atan(),
            Self::Quarter(turn) => in_range(f64::from(turn) * 0.5 * PI, 2.0 * to_f64(x).atan()),
        }
    }
}

/// A multiple of π/2 and a little, in `(−π, π]`.
fn in_range(quarters: f64, more: f64) -> f64 {
    let phase = quarters + more;
    if phase > PI { (quarters - 2.0 * PI) + more } else { phase }
}

/// A [`Cell`] in `f64`.
#[derive(Debug, Clone)]
pub(crate) struct CompiledCell {
    degrees: Vec<usize>,
    values: Vec<f64>,
}

impl CompiledCell {
    /// The degrees in the waves.
    pub(crate) fn wave_degrees(&self) -> &[usize] {
        &self.degrees[..self.degrees.len() - 1]
    }

    /// The coefficients of the powers of `t` at a point.
    pub(crate) fn at_point(&self, point: &[f64]) -> Vec<f64> {
        let mut values = self.values.clone();
        for (degree, x) in self.degrees.iter().zip(point) {
            // From the slowest index on: whole blocks by Horner's rule.
            let block = values.len() / (degree + 1);
            let (head, tail) = values.split_at(block * degree);
            let mut sum = tail.to_vec();
            for chunk in head.rchunks(block) {
                sum.iter_mut().zip(chunk).for_each(|(sum, value)| *sum = *sum * x + value);
            }
            values = sum;
        }
        values
    }
}

/// A fraction with few digits near a coordinate.
pub(crate) fn rounded(x: f64, bits: u32) -> Rational {
    let unit = BigInt::from(1) << bits;
    let value = from_f64(x.clamp(0.0, 1.0)).expect("a coordinate is a number");
    Rational::new(numerator_over(&(value * Rational::from(unit.clone())).round(), &1.into()), unit)
}
