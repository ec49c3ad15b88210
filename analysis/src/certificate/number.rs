//! Exact numbers as text: `-15/8`, `3`.

use crate::exact::rational::{Rational, to_text};
use num_bigint::BigInt;
use num_traits::Zero;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A fraction that is written as text in lowest terms, of any length, and read back strictly: a number
/// has one spelling only.
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
        Self::read(&text).ok_or_else(|| {
            serde::de::Error::custom(format!("`{text}` is not a fraction in lowest terms"))
        })
    }
}
