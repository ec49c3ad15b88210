//! Polynomials of the checker: sums of powers of `z`, `E_1, E_2, E_3`, the sought parameter and letters.

use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::{BTreeMap, HashMap};
use std::ops::{AddAssign, Mul, Neg};

/// What coefficients are: whole numbers or fractions.
pub trait Number:
    Clone + Zero + One + PartialEq + Neg<Output = Self> + AddAssign + From<BigInt>
where
    for<'a> &'a Self: Mul<&'a Self, Output = Self>,
{
}
impl Number for BigInt {}
impl Number for crate::exact::rational::Rational {}

/// A number, or an even function of the wave, that is no fraction.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Letter {
    /// `sqrt(n)`: its square is `n`.
    Root(BigInt),
    /// The one with this number among the [letters](super::letters::Letters).
    Enclosed(usize),
}

/// Powers of the shifts by one cell along the axes.
pub type Shifts = [i32; 3];

/// One power of everything.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Power {
    pub z: i32,
    pub e: Shifts,
    pub c: i32,
    pub letters: Vec<(Letter, u32)>,
}

/// `Σ coefficient · power`, no coefficient zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Poly<T>(pub BTreeMap<Power, T>);

impl<T> Default for Poly<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<T: Number> Poly<T>
where
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    pub fn number(value: T) -> Self {
        Self::term(Power::default(), value)
    }

    pub fn one() -> Self {
        Self::number(T::one())
    }

    pub fn term(power: Power, value: T) -> Self {
        Self(if value.is_zero() { BTreeMap::new() } else { [(power, value)].into() })
    }

    pub fn letter(letter: Letter) -> Self {
        Self::term(Power { letters: vec![(letter, 1)], ..Power::default() }, T::one())
    }

    /// `z`, the shifts, `C` to powers.
    pub fn monomial(z: i32, e: Shifts, c: i32) -> Self {
        Self::term(Power { z, e, c, letters: Vec::new() }, T::one())
    }

    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    pub fn plus(mut self, other: &Self) -> Self {
        for (power, value) in &other.0 {
            *self.0.entry(power.clone()).or_insert_with(T::zero) += value.clone();
        }
        self.0.retain(|_, value| !value.is_zero());
        self
    }

    pub fn negated(&self) -> Self {
        Self(self.0.iter().map(|(power, value)| (power.clone(), -value.clone())).collect())
    }

    pub fn minus(self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    pub fn scaled(&self, factor: &T) -> Self {
        if factor.is_zero() {
            return Self::default();
        }
        Self(self.0.iter().map(|(power, value)| (power.clone(), value * factor)).collect())
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut sums: HashMap<Power, T> = HashMap::new();
        for (p, a) in &self.0 {
            for (q, b) in &other.0 {
                let mut value = a * b;
                let letters = together(&p.letters, &q.letters, &mut value);
                let e = std::array::from_fn(|axis| p.e[axis] + q.e[axis]);
                let power = Power { z: p.z + q.z, e, c: p.c + q.c, letters };
                *sums.entry(power).or_insert_with(T::zero) += value;
            }
        }
        Self(sums.into_iter().filter(|(_, value)| !value.is_zero()).collect())
    }

    pub fn pow(&self, exponent: usize) -> Self {
        (0..exponent).fold(Self::one(), |power, _| power.times(self))
    }

    fn mapped(&self, change: impl Fn(&mut Power)) -> Self {
        let moved = self.0.iter().map(|(power, value)| {
            let mut power = power.clone();
            change(&mut power);
            (power, value.clone())
        });
        Self(moved.collect())
    }

    pub fn moved(&self, z: i32, e: Shifts) -> Self {
        self.mapped(|power| {
            power.z += z;
            power.e.iter_mut().zip(e).for_each(|(power, by)| *power += by);
        })
    }

    /// Each `E` becomes `1/E`: the complex conjugate on a wave.
    pub fn conjugate(&self) -> Self {
        self.mapped(|power| power.e = power.e.map(|e| -e))
    }

    /// `[coefficient of z^0, of z^1, …]`; powers below zero must not occur.
    pub fn by_z(&self) -> Vec<Self> {
        let highest = self.0.keys().map(|power| power.z).max().unwrap_or(0);
        let mut parts = vec![Self::default(); highest.max(0) as usize + 1];
        for (power, value) in &self.0 {
            let rest = Power { z: 0, ..power.clone() };
            parts[power.z as usize].0.insert(rest, value.clone());
        }
        parts
    }

    /// The value where nothing but a number is left.
    pub fn as_number(&self) -> Option<T> {
        match self.0.len() {
            0 => Some(T::zero()),
            1 => self.0.get(&Power::default()).cloned(),
            _ => None,
        }
    }

    /// A number times powers of `z` and `E`.
    pub fn is_unit(&self) -> bool {
        self.0.len() == 1 && self.0.keys().all(|power| power.c == 0 && power.letters.is_empty())
    }
}

/// Powers of letters multiplied; squares of roots go into `value`.
fn together<T: Number>(
    left: &[(Letter, u32)],
    right: &[(Letter, u32)],
    value: &mut T,
) -> Vec<(Letter, u32)>
where
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    if left.is_empty() || right.is_empty() {
        return [left, right].concat();
    }
    let mut powers: BTreeMap<&Letter, u32> = BTreeMap::new();
    for (letter, power) in left.iter().chain(right) {
        *powers.entry(letter).or_default() += power;
    }
    let mut letters = Vec::new();
    for (letter, mut power) in powers {
        if let Letter::Root(square) = letter {
            for _ in 0..power / 2 {
                *value = &*value * &T::from(square.clone());
            }
            power %= 2;
        }
        if power > 0 {
            letters.push((letter.clone(), power));
        }
    }
    letters
}
