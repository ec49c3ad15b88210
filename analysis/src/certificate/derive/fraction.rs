//! Quotients of polynomials, and rows of them without denominators.

use super::polynomial::Poly;
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_traits::One;

/// A quotient of polynomials.
#[derive(Debug, Clone)]
pub struct Fraction {
    pub over: Poly<Rational>,
    pub under: Poly<Rational>,
}

impl Fraction {
    pub fn whole(over: Poly<Rational>) -> Self {
        Self { over, under: Poly::one() }
    }

    pub fn one() -> Self {
        Self::whole(Poly::one())
    }

    pub fn plus(&self, other: &Self) -> Self {
        if self.under == other.under {
            let over = self.over.clone().plus(&other.over);
            return Self { over, under: self.under.clone() };
        }
        Self {
            over: self.over.times(&other.under).plus(&other.over.times(&self.under)),
            under: self.under.times(&other.under),
        }
    }

    pub fn times(&self, other: &Self) -> Self {
        Self { over: self.over.times(&other.over), under: self.under.times(&other.under) }
    }
}

/// Fractions times their denominators, as polynomials with whole coefficients.
pub fn cleared(fractions: &[Fraction]) -> Vec<Poly<BigInt>> {
    let mut denominators: Vec<&Poly<Rational>> = Vec::new();
    for fraction in fractions {
        if fraction.under.as_number().is_none() && !denominators.contains(&&fraction.under) {
            denominators.push(&fraction.under);
        }
    }
    let row: Vec<Poly<Rational>> = fractions
        .iter()
        .map(|fraction| {
            let others = denominators.iter().filter(|other| **other != &fraction.under);
            let over = others.fold(fraction.over.clone(), |product, other| product.times(other));
            match fraction.under.as_number() {
                Some(value) => over.scaled(&value.recip()),
                None => over,
            }
        })
        .collect();
    whole_row(&row)
}

/// Without the denominators of the numbers in it.
pub fn whole_row(row: &[Poly<Rational>]) -> Vec<Poly<BigInt>> {
    let values = row.iter().flat_map(|poly| poly.0.values());
    let common =
        values.fold(BigInt::one(), |all, value| num_integer::lcm(all, value.denom().clone()));
    let whole = |value: &Rational| value.numer() * (&common / value.denom());
    row.iter()
        .map(|poly| {
            Poly(poly.0.iter().map(|(power, value)| (power.clone(), whole(value))).collect())
        })
        .collect()
}
