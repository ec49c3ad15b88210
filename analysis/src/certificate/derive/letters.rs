//! Letters and their values: numbers and even functions of the wave within a stated error.

use super::polynomial::{Letter, Poly};
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Values are kept in units of `2^−BITS`.
pub const BITS: u32 = 320;

/// A symmetric series `[…, x_{−1}, x_0, x_1, …]` in powers of `E`, and a bound on the sum of the moduli of all errors; in units.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub values: Vec<BigInt>,
    pub error: BigInt,
}

impl Series {
    pub fn times(&self, other: &Self) -> Self {
        let length = self.values.len() + other.values.len() - 1;
        let mut product = vec![BigInt::zero(); length];
        for (i, left) in self.values.iter().enumerate() {
            for (j, right) in other.values.iter().enumerate() {
                product[i + j] += left * right;
            }
        }
        let norm = |series: &Self| series.values.iter().map(Signed::abs).sum::<BigInt>();
        let error =
            norm(self) * &other.error + norm(other) * &self.error + &self.error * &other.error;
        Self {
            values: product.into_iter().map(|value| value >> BITS).collect(),
            error: (error >> BITS) + 1 + length,
        }
    }
}

/// What a letter was made of: two of the same are one.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    Constant(Rational, Rational),
    Versines(Vec<(Rational, Rational)>),
    Sines(Vec<(Rational, Rational)>),
}

/// All letters of one scheme but square roots, which know themselves.
#[derive(Debug, Default)]
pub struct Letters(Vec<(Origin, Series)>);

impl Letters {
    pub fn value(&self, letter: &Letter) -> Series {
        match letter {
            Letter::Enclosed(number) => self.0[*number].1.clone(),
            Letter::Root(square) => {
                Series { values: vec![(square << (2 * BITS)).sqrt()], error: BigInt::one() }
            }
        }
    }

    fn insert(&mut self, origin: Origin, make: impl FnOnce() -> Series) -> Poly<Rational> {
        let known = self.0.iter().position(|(other, _)| *other == origin);
        let number = known.unwrap_or_else(|| {
            self.0.push((origin, make()));
            self.0.len() - 1
        });
        Poly::letter(Letter::Enclosed(number))
    }

    /// A number within an error.
    pub fn constant(&mut self, value: &Rational, error: &Rational) -> Poly<Rational> {
        if error.is_zero() {
            return Poly::number(value.clone());
        }
        self.insert(Origin::Constant(value.clone(), error.clone()), || Series {
            values: vec![in_units(value)],
            error: in_units(error) + 2,
        })
    }

    /// `Σ_k f(k) (1 − cos kφ)/s`, where `(1 − cos kφ)/s = 2 Σ_{|m|<k} (k − |m|) E^m`.
    pub fn versines(&mut self, function: &[(Rational, Rational)]) -> Poly<Rational> {
        self.insert(Origin::Versines(function.to_vec()), || {
            series(function, |k| (1 - k..k).map(|m| (m, 2 * (k - m.abs()))).collect())
        })
    }

    /// `Σ_k f(k) sin kφ/sin φ`, where `sin kφ/sin φ = E^{1−k} + E^{3−k} + … + E^{k−1}`.
    pub fn sines(&mut self, function: &[(Rational, Rational)]) -> Poly<Rational> {
        self.insert(Origin::Sines(function.to_vec()), || {
            series(function, |k| (1 - k..k).step_by(2).map(|m| (m, 1)).collect())
        })
    }

    /// The value of a polynomial in letters that are constants, and its error; `None` where one depends on the wave.
    pub fn ball(&self, poly: &Poly<Rational>) -> Option<(Rational, Rational)> {
        let unit = Rational::from(BigInt::one() << BITS);
        let (mut total, mut error) = (Rational::zero(), Rational::zero());
        for (power, factor) in &poly.0 {
            let mut term = Series { values: vec![BigInt::one() << BITS], error: BigInt::zero() };
            for (letter, times) in &power.letters {
                for _ in 0..*times {
                    term = term.times(&self.value(letter));
                }
            }
            let [value] = term.values.as_slice() else { return None };
            total += factor * Rational::from(value.clone()) / &unit;
            error += factor.abs() * Rational::from(term.error) / &unit;
        }
        Some((total, error))
    }
}

/// Rounded down to units.
pub fn in_units(value: &Rational) -> BigInt {
    (value * Rational::from(BigInt::one() << BITS)).floor().to_integer()
}

fn series(function: &[(Rational, Rational)], quotient: impl Fn(i64) -> Vec<(i64, i64)>) -> Series {
    let reach = function.len() as i64;
    let mut values = vec![BigInt::zero(); (2 * reach - 1).max(1) as usize];
    let mut error = BigInt::zero();
    for (k, (value, radius)) in (1..).zip(function) {
        let terms = quotient(k);
        let total: i64 = terms.iter().map(|(_, factor)| factor).sum();
        error += (in_units(radius) + 2) * total + 1;
        let units = in_units(value);
        for (m, factor) in terms {
            values[(m + reach - 1) as usize] += &units * factor;
        }
    }
    Series { values, error }
}

/// `sqrt(p/q) = sqrt(pq)/q`.
pub fn root(square: &Rational) -> Poly<Rational> {
    let n = square.numer() * square.denom();
    let whole = n.sqrt();
    if &whole * &whole == n {
        return Poly::number(Rational::new(whole, square.denom().clone()));
    }
    Poly::letter(Letter::Root(n)).scaled(&Rational::new(BigInt::one(), square.denom().clone()))
}

/// π in units, wrong by less than `2^16`. Gauss: π = 48 arctan 1/18 + 32 arctan 1/57 − 20 arctan 1/239.
pub fn pi() -> BigInt {
    let one = BigInt::one() << BITS;
    let arctan = |n: u32| -> BigInt {
        (0u32..130).fold(BigInt::zero(), |sum, k| {
            let term = &one / (BigInt::from(n).pow(2 * k + 1) * (2 * k + 1));
            if k % 2 == 0 { sum + term } else { sum - term }
        })
    };
    arctan(18) * 48 + arctan(57) * 32 - arctan(239) * 20
}

/// `e^{−x}` for `0 ≤ x ≤ 9` in units, wrong by less than `2^22`.
pub fn exponential(x: &Rational) -> BigInt {
    let (mut sum, mut term) = (BigInt::zero(), BigInt::one() << BITS);
    for n in 1u32.. {
        sum += &term;
        term = -(term * x.numer()) / (x.denom() * n);
        // Beyond n = x the terms fall in size and alternate.
        if n > 9 && term.abs() <= BigInt::one() {
            break;
        }
    }
    sum
}
