//! Polynomials in several variables with all their coefficients in one array, integers.
//!
//! Schemes in two and three dimensions ask for the sign of such a polynomial on a unit cube: see [`sign_on_cube`].

mod chart;
mod sign;

pub(crate) use chart::{Origin, separating_axis, vanishing_axes};
pub use sign::{CubeSign, sign_on_cube};
pub(crate) use sign::{Cut, cuts_of_cube};

use crate::exact::rational::{Rational, greatest_divisor};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// `Σ_k c_k x_1^{k_1} … x_d^{k_d}` with `k_a ≤ degree_a`, the last index running fastest.
///
/// ```
/// use courant_analysis::exact::rational::{integer, ratio};
/// use courant_analysis::exact::tensor::{CubeSign, Tensor, sign_on_cube};
/// // x² − 2xy + 2y² ≥ 0, though it vanishes at the origin and has a negative coefficient.
/// let form = Tensor::new(vec![2, 2], [([2, 0], 1), ([1, 1], -2), ([0, 2], 2)]);
/// assert_eq!(form.at(&[integer(1), ratio(1, 2)]), ratio(1, 2));
/// assert_eq!(sign_on_cube(&form, 100).0, CubeSign::NowhereNegative);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tensor {
    degrees: Vec<usize>,
    values: Vec<BigInt>,
}

impl Tensor {
    /// The sum of terms, each by its powers and its coefficient.
    ///
    /// # Panics
    /// When a power is above the degree of its variable.
    pub fn new<P: AsRef<[usize]>, T: Into<BigInt>>(
        degrees: Vec<usize>,
        terms: impl IntoIterator<Item = (P, T)>,
    ) -> Self {
        let mut tensor = Self::zero(degrees);
        for (powers, value) in terms {
            let at = tensor.place(powers.as_ref());
            tensor.values[at] += value.into();
        }
        tensor
    }

    /// Zero, with room for these degrees.
    pub(crate) fn zero(degrees: Vec<usize>) -> Self {
        let size = degrees.iter().map(|degree| degree + 1).product();
        Self { degrees, values: vec![BigInt::zero(); size] }
    }

    /// The number of variables.
    pub fn dimension(&self) -> usize {
        self.degrees.len()
    }

    /// The degree in each variable that there is room for.
    pub fn degrees(&self) -> &[usize] {
        &self.degrees
    }

    /// The coefficients.
    pub fn values(&self) -> &[BigInt] {
        &self.values
    }

    /// Whether all coefficients are zero.
    pub fn is_zero(&self) -> bool {
        self.values.iter().all(Zero::is_zero)
    }

    fn place(&self, powers: &[usize]) -> usize {
        assert!(powers.iter().zip(&self.degrees).all(|(power, degree)| power <= degree));
        powers.iter().zip(&self.degrees).fold(0, |at, (power, degree)| at * (degree + 1) + power)
    }

    /// How far apart neighbours along an axis are.
    fn stride(&self, axis: usize) -> usize {
        self.degrees[axis + 1..].iter().map(|degree| degree + 1).product()
    }

    /// The power of a variable at a place.
    fn power(&self, at: usize, axis: usize) -> usize {
        at / self.stride(axis) % (self.degrees[axis] + 1)
    }

    fn powers(&self, at: usize) -> Vec<usize> {
        (0..self.dimension()).map(|axis| self.power(at, axis)).collect()
    }

    pub(crate) fn plus(mut self, other: &Self) -> Self {
        self.values.iter_mut().zip(&other.values).for_each(|(sum, value)| *sum += value);
        self
    }

    pub(crate) fn minus(mut self, other: &Self) -> Self {
        self.values.iter_mut().zip(&other.values).for_each(|(sum, value)| *sum -= value);
        self
    }

    /// The coefficient of a power of one variable, a polynomial in the others.
    pub(crate) fn slice(&self, axis: usize, power: usize) -> Self {
        let mut degrees = self.degrees.clone();
        degrees.remove(axis);
        let on = |at: &usize| self.power(*at, axis) == power;
        let values = (0..self.values.len()).filter(on).map(|at| self.values[at].clone());
        Self { degrees, values: values.collect() }
    }

    /// With one more variable, the last, that does not occur.
    pub(crate) fn with_an_axis(mut self) -> Self {
        self.degrees.push(0);
        self
    }

    /// With `1 − x` for a variable.
    pub(crate) fn flipped(&self, axis: usize) -> Self {
        let row = |power: usize| {
            let value =
                |i: usize| if i % 2 == 1 { -binomial(power, i) } else { binomial(power, i) };
            (0..=power).map(value).collect()
        };
        self.contracted(axis, &(0..=self.degrees[axis]).map(row).collect::<Vec<_>>())
    }

    /// On one half of an axis: `x/2` or `(1 + x)/2` for the variable, times a power of two.
    pub(crate) fn half(&self, axis: usize, upper: bool) -> Self {
        let degree = self.degrees[axis];
        let row = |power: usize| -> Vec<BigInt> {
            let lowest = if upper { 0 } else { power };
            let factor = BigInt::one() << (degree - power);
            let value =
                |i: usize| if i < lowest { BigInt::zero() } else { binomial(power, i) * &factor };
            (0..=power).map(value).collect()
        };
        self.contracted(axis, &(0..=degree).map(row).collect::<Vec<_>>())
    }

    /// `x^n p(1/x)` for one variable of degree `n`.
    pub(crate) fn reversed(&self, axis: usize) -> Self {
        let (stride, degree) = (self.stride(axis), self.degrees[axis]);
        let from = |at: usize| {
            let power = self.power(at, axis);
            at - power * stride + (degree - power) * stride
        };
        let values = (0..self.values.len()).map(|at| self.values[from(at)].clone());
        Self { degrees: self.degrees.clone(), values: values.collect() }
    }

    /// With each power `k` of a variable replaced by the polynomial whose coefficients are `rows[k]`.
    pub(crate) fn contracted(&self, axis: usize, rows: &[Vec<BigInt>]) -> Self {
        let degree = rows.iter().map(Vec::len).max().unwrap_or(1) - 1;
        let mut degrees = self.degrees.clone();
        degrees[axis] = degree;
        let mut result = Self::zero(degrees);
        let (old, new) = (self.stride(axis), result.stride(axis));
        debug_assert_eq!(old, new);
        for (at, value) in self.values.iter().enumerate().filter(|(_, value)| !value.is_zero()) {
            let outer = at / (old * (self.degrees[axis] + 1));
            let start = outer * old * (degree + 1) + at % old;
            for (power, factor) in rows[self.power(at, axis)].iter().enumerate() {
                if !factor.is_zero() {
                    result.values[start + power * old] += value * factor;
                }
            }
        }
        result
    }

    /// Without room for powers that do not occur, and without the integer that all coefficients share.
    pub(crate) fn trimmed(&self) -> Self {
        let content = content(&self.values);
        if content.is_zero() {
            return Self::zero(vec![0; self.dimension()]);
        }
        let occupied = || self.values.iter().enumerate().filter(|(_, value)| !value.is_zero());
        let degree = |axis| occupied().map(|(at, _)| self.power(at, axis)).max().unwrap_or(0);
        let degrees = (0..self.dimension()).map(degree).collect();
        Self::new(degrees, occupied().map(|(at, value)| (self.powers(at), value / &content)))
    }

    /// The value at a point.
    pub fn at(&self, point: &[Rational]) -> Rational {
        let (value, scale) = self.integer_at(point);
        Rational::new(value, scale)
    }

    /// The value at a point as a fraction whose denominator depends on the point and the degrees alone.
    pub(crate) fn integer_at(&self, point: &[Rational]) -> (BigInt, BigInt) {
        let mut values = self.values.clone();
        let mut scale = BigInt::one();
        // From the fastest index up, each fibre by a homogeneous Horner scheme.
        for (degree, x) in self.degrees.iter().zip(point).rev() {
            let step = |fibre: &[BigInt]| {
                let (mut sum, mut power) = (BigInt::zero(), BigInt::one());
                for value in fibre.iter().rev() {
                    sum = sum * x.numer() + value * &power;
                    power *= x.denom();
                }
                sum
            };
            values = values.chunks(degree + 1).map(step).collect();
            scale *= x.denom().pow(*degree as u32);
        }
        (values.into_iter().next().unwrap_or_default(), scale)
    }
}

/// `[C(n, 0), …, C(n, n)]`.
pub(super) fn binomials(degree: usize) -> Vec<BigInt> {
    let mut row = vec![BigInt::one()];
    for index in 0..degree {
        let next = &row[index] * (degree - index) / (index + 1);
        row.push(next);
    }
    row
}

/// A polynomial on the unit cube by positive multiples of its Bernstein coefficients: it is a convex combination of them.
#[derive(Debug, Clone)]
pub(super) struct Bernstein(Tensor);

impl Bernstein {
    pub(super) fn of(polynomial: &Tensor) -> Self {
        let mut tensor = polynomial.clone();
        for axis in 0..tensor.dimension() {
            let degree = tensor.degrees[axis];
            let choices = binomials(degree);
            let common = choices.iter().fold(BigInt::one(), |all, value| all.lcm(value));
            // x^j = Σ_k C(k, j)/C(n, j) B_k.
            let rows: Vec<Vec<BigInt>> = (0..=degree)
                .map(|j| {
                    let factor = &common / &choices[j];
                    (0..=degree).map(|k| binomial(k, j) * &factor).collect()
                })
                .collect();
            tensor = tensor.contracted(axis, &rows);
        }
        Self(tensor)
    }

    /// A positive multiple of the polynomial in powers.
    pub(super) fn powers(&self) -> Tensor {
        let mut tensor = self.0.clone();
        for axis in 0..tensor.dimension() {
            let degree = tensor.degrees[axis];
            let choices = binomials(degree);
            // B_k = C(n, k) x^k (1 − x)^{n−k}
            let rows: Vec<Vec<BigInt>> = (0..=degree)
                .map(|k| {
                    let mut row = vec![BigInt::zero(); k];
                    row.extend((0..=degree - k).map(|i| {
                        let value = binomial(degree - k, i) * &choices[k];
                        if i % 2 == 1 { -value } else { value }
                    }));
                    row
                })
                .collect();
            tensor = tensor.contracted(axis, &rows);
        }
        tensor
    }

    /// The halves of the cube along an axis, by de Casteljau's algorithm without its divisions.
    pub(super) fn halves(&self, axis: usize) -> (Self, Self) {
        let (stride, degree) = (self.0.stride(axis), self.0.degrees[axis]);
        let (mut left, mut right) = (self.0.clone(), self.0.clone());
        let size = self.0.values.len();
        for start in (0..size).filter(|&at| self.0.power(at, axis) == 0) {
            let at = |index: usize| start + index * stride;
            for level in 0..=degree {
                left.values[at(level)] = &right.values[at(0)] << (degree - level);
                for index in 0..degree - level {
                    let next = right.values[at(index + 1)].clone();
                    right.values[at(index)] += next;
                }
                let last = at(degree - level);
                right.values[last] = std::mem::take(&mut right.values[last]) << (degree - level);
            }
        }
        (Self(left).shortened(), Self(right).shortened())
    }

    /// Without the power of two that all coefficients share.
    fn shortened(mut self) -> Self {
        let zeros = self.0.values.iter().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
        if zeros > 0 {
            self.0.values.iter_mut().for_each(|value| *value >>= zeros);
        }
        self
    }

    /// With `1 − x` for a variable.
    pub(super) fn flipped(&self, axis: usize) -> Self {
        Self(self.0.reversed(axis))
    }
}

fn binomial(n: usize, k: usize) -> BigInt {
    if k > n { BigInt::zero() } else { num_integer::binomial(BigInt::from(n), BigInt::from(k)) }
}

/// `3^24 5^12 7^8 11^4 13^4`: what binomials leave in common besides powers of two.
const SMOOTH: u128 = 3u128.pow(24) * 5u128.pow(12) * 7u128.pow(8) * 11u128.pow(4) * 13u128.pow(4);

/// An integer that divides all: the greatest one where machine integers find it, else its part of small primes, as long numbers in common
/// cost more than they save.
fn content(values: &[BigInt]) -> BigInt {
    let occurring = || values.iter().filter(|value| !value.is_zero());
    let Some(least) = occurring().min_by_key(|value| value.bits()) else { return BigInt::zero() };
    let twos = occurring().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
    let mut odd = if least.bits() <= 128 { least.abs() } else { SMOOTH.into() };
    odd >>= odd.trailing_zeros().unwrap_or(0);
    for value in occurring() {
        if odd.is_one() {
            break;
        }
        odd = greatest_divisor(&odd, value);
    }
    odd << twos
}

#[cfg(test)]
mod tests;
