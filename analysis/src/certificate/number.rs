//! Exact numbers as text: `-15/8`, `3`, `sqrt(8/3)`, `inf`.

use crate::exact::rational::{Rational, to_text};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Longer texts are no numbers here.
const LONGEST: usize = 20_000;

/// A fraction that is written as text in lowest terms, and read back strictly: a number has one spelling only.
///
/// ```
/// use courant_analysis::{certificate::Exact, exact::rational::ratio};
/// assert_eq!(Exact::read("-15/8"), Some(Exact(ratio(-15, 8))));
/// assert_eq!(Exact::read("30/16"), None);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exact(pub Rational);

impl Exact {
    /// Reads the one spelling of a number.
    pub fn read(text: &str) -> Option<Self> {
        if text.len() > LONGEST {
            return None;
        }
        let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
        let (numerator, denominator): (BigInt, BigInt) =
            (numerator.parse().ok()?, denominator.parse().ok()?);
        if denominator.is_zero() {
            return None;
        }
        let value = Rational::new(numerator, denominator);
        (to_text(&value) == text).then_some(Self(value))
    }
}

impl From<Rational> for Exact {
    fn from(value: Rational) -> Self {
        Self(value)
    }
}

impl From<BigInt> for Exact {
    fn from(value: BigInt) -> Self {
        Self(value.into())
    }
}

impl Serialize for Exact {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&to_text(&self.0))
    }
}

impl<'de> Deserialize<'de> for Exact {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::read(&text)
            .ok_or_else(|| serde::de::Error::custom("a fraction in lowest terms is expected"))
    }
}

/// The end of an interval: a fraction, the square root of one that is no square, or infinity.
///
/// ```
/// use courant_analysis::certificate::End;
/// assert_eq!(End::read("sqrt(8/3)").unwrap().to_string(), "sqrt(8/3)");
/// assert_eq!(End::read("sqrt(4)"), None);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// A fraction.
    Fraction(Rational),
    /// The root of a positive fraction that is no square.
    Root(Rational),
    /// No end.
    Infinity,
}

impl End {
    /// Reads the one spelling of an end.
    pub fn read(text: &str) -> Option<Self> {
        if text == "inf" {
            return Some(Self::Infinity);
        }
        match text.strip_prefix("sqrt(").and_then(|rest| rest.strip_suffix(')')) {
            None => Exact::read(text).map(|value| Self::Fraction(value.0)),
            Some(inner) => {
                let square = Exact::read(inner)?.0;
                let is_square = |value: &BigInt| {
                    let root = value.sqrt();
                    &root * &root == *value
                };
                let irrational = square.is_positive()
                    && !(is_square(square.numer()) && is_square(square.denom()));
                irrational.then_some(Self::Root(square))
            }
        }
    }

    /// The square; `None` for infinity.
    pub fn square(&self) -> Option<Rational> {
        match self {
            Self::Fraction(value) => Some(value * value),
            Self::Root(square) => Some(square.clone()),
            Self::Infinity => None,
        }
    }
}

impl std::fmt::Display for End {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fraction(value) => formatter.write_str(&to_text(value)),
            Self::Root(square) => write!(formatter, "sqrt({})", to_text(square)),
            Self::Infinity => formatter.write_str("inf"),
        }
    }
}

impl Serialize for End {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for End {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::read(&text)
            .ok_or_else(|| serde::de::Error::custom("15/8, sqrt(8/3) or inf is expected"))
    }
}
