//! What expressions evaluate to: scalars, and linear forms of unknowns.

use super::Place;
use crate::exact::rational::Rational;
use crate::scheme::kernel_function::KernelFunction;
use crate::scheme::names::Fraction;
use num_traits::Zero;

/// A coefficient inside a sum: fractions times functions of the running index; `None` for 1.
pub(super) type Scalar = Vec<(Fraction, Option<KernelFunction>)>;

/// What an expression evaluates to.
pub(super) enum Value {
    Scalar(Scalar),
    Linear(Vec<(Place, Scalar)>),
}

pub(super) fn push(terms: &mut Vec<(Place, Scalar)>, place: Place, scalar: Scalar) {
    match terms.iter_mut().find(|(known, _)| *known == place) {
        Some((_, sum)) => *sum = plus(std::mem::take(sum), scalar),
        None => terms.push((place, scalar)),
    }
}

pub(super) fn number(fraction: Fraction) -> Value {
    Value::Scalar(vec![(fraction, None)])
}

/// A scalar outside a sum.
pub(super) fn single(scalar: Scalar) -> Fraction {
    scalar
        .into_iter()
        .map(|(fraction, _)| fraction)
        .reduce(|sum, fraction| sum.plus(&fraction))
        .unwrap_or_else(|| Fraction::number(&Rational::zero()))
}

pub(super) fn plus(mut left: Scalar, right: Scalar) -> Scalar {
    for (fraction, function) in right {
        match left.iter_mut().find(|(_, known)| *known == function) {
            Some((sum, _)) => *sum = sum.plus(&fraction),
            None => left.push((fraction, function)),
        }
    }
    left
}

pub(super) fn times(left: &Scalar, right: &Scalar) -> Scalar {
    let mut product = Vec::new();
    for (a, f) in left {
        for (b, g) in right {
            let function = match (f, g) {
                (Some(f), Some(g)) => Some(f.times(g)),
                (Some(one), None) | (None, Some(one)) => Some(one.clone()),
                (None, None) => None,
            };
            product = plus(product, vec![(a.times(b), function)]);
        }
    }
    product
}

pub(super) fn scaled(terms: Vec<(Place, Scalar)>, factor: &Scalar) -> Value {
    Value::Linear(terms.into_iter().map(|(place, value)| (place, times(&value, factor))).collect())
}

pub(super) fn minus(scalar: Scalar) -> Scalar {
    scalar.into_iter().map(|(fraction, function)| (fraction.negated(), function)).collect()
}

pub(super) fn negated(value: Value) -> Value {
    match value {
        Value::Scalar(scalar) => Value::Scalar(minus(scalar)),
        Value::Linear(terms) => {
            Value::Linear(terms.into_iter().map(|(place, scalar)| (place, minus(scalar))).collect())
        }
    }
}

/// The sum of two of a kind; a zero is of every kind.
pub(super) fn add(left: Value, right: Value) -> Value {
    match (left, right) {
        (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(plus(a, b)),
        (Value::Linear(mut terms), Value::Linear(more)) => {
            for (place, scalar) in more {
                push(&mut terms, place, scalar);
            }
            Value::Linear(terms)
        }
        (Value::Scalar(_), Value::Linear(terms)) | (Value::Linear(terms), Value::Scalar(_)) => {
            Value::Linear(terms)
        }
    }
}
