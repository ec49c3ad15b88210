//! What an index or an exponent says: a rational number plus multiples of names.

use super::syntax::{Expression, Node, Span};
use crate::exact::rational::Rational;
use num_traits::{One, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// Indices and exponents are small; what grows beyond this is a mistake.
const LONGEST: u64 = 256;

/// `constant + Σ multiple · name`; no multiple is zero.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Affine {
    pub constant: Rational,
    /// With the place where the name stands first.
    pub multiples: BTreeMap<String, (Rational, Span)>,
}

impl Affine {
    /// What an expression says; the place of the first thing that is neither number nor name nor a
    /// combination of them.
    pub(super) fn of(expression: &Expression) -> Result<Self, Span> {
        let refused = || expression.span.clone();
        let value = match &expression.node {
            Node::Number(value) => Self::constant(value.clone()),
            Node::Name(name) => {
                let multiple = (Rational::one(), expression.span.clone());
                Self { multiples: [(name.clone(), multiple)].into(), ..Self::default() }
            }
            Node::Negative(argument) => Self::of(argument)?.times(&-Rational::one()),
            Node::Add(left, right) => Self::of(left)?.plus(Self::of(right)?),
            Node::Subtract(left, right) => {
                Self::of(left)?.plus(Self::of(right)?.times(&-Rational::one()))
            }
            Node::Multiply(left, right) => match (Self::of(left)?, Self::of(right)?) {
                (left, right) if left.multiples.is_empty() => right.times(&left.constant),
                (left, right) if right.multiples.is_empty() => left.times(&right.constant),
                _ => return Err(refused()),
            },
            Node::Divide(left, right) => match Self::of(right)? {
                right if right.multiples.is_empty() && !right.constant.is_zero() => {
                    Self::of(left)?.times(&right.constant.recip())
                }
                _ => return Err(refused()),
            },
            Node::Power(base, exponent) => match Self::of(base)? {
                base if base.multiples.is_empty() => {
                    let size = base.constant.numer().bits().max(base.constant.denom().bits());
                    let too_long = size * u64::from(exponent.unsigned_abs()) > 2 * LONGEST;
                    if too_long || (base.constant.is_zero() && *exponent < 0) {
                        return Err(refused());
                    }
                    Self::constant(base.constant.pow(*exponent))
                }
                _ => return Err(refused()),
            },
            Node::Pi
            | Node::SquareRoot(_)
            | Node::Unknown(_)
            | Node::Weight { .. }
            | Node::Sum { .. } => return Err(refused()),
        };
        if value.numbers().any(|n| n.numer().bits().max(n.denom().bits()) > LONGEST) {
            return Err(refused());
        }
        Ok(value)
    }

    /// The multiple of a name.
    pub(super) fn multiple(&self, name: &str) -> Rational {
        self.multiples.get(name).map_or_else(Rational::zero, |(multiple, _)| multiple.clone())
    }

    fn constant(constant: Rational) -> Self {
        Self { constant, ..Self::default() }
    }

    fn numbers(&self) -> impl Iterator<Item = &Rational> {
        self.multiples.values().map(|(multiple, _)| multiple).chain([&self.constant])
    }

    fn plus(mut self, other: Self) -> Self {
        self.constant += other.constant;
        for (name, (multiple, span)) in other.multiples {
            self.multiples.entry(name).or_insert((Rational::zero(), span)).0 += multiple;
        }
        self.multiples.retain(|_, (multiple, _)| !multiple.is_zero());
        self
    }

    fn times(mut self, factor: &Rational) -> Self {
        self.constant *= factor;
        self.multiples.values_mut().for_each(|(multiple, _)| *multiple *= factor);
        self.multiples.retain(|_, (multiple, _)| !multiple.is_zero());
        self
    }
}

/// A whole number that is not absurdly large.
pub(super) fn whole(value: &Rational, largest: i32) -> Option<i32> {
    let value = value.is_integer().then(|| value.to_integer().to_i32()).flatten()?;
    (value.unsigned_abs() <= largest.unsigned_abs()).then_some(value)
}
