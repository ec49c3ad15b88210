//! Polynomials on cubes of waves: substitutions, and cuts replayed one by one.

use super::{CertificateError, ensure};
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use std::collections::{BTreeMap, VecDeque};

/// Degrees that charts may lead to.
const HIGHEST: usize = 400;

/// `Σ value x_1^{k_1} … x_d^{k_d}`, and a power of `t` last where it still occurs.
#[derive(Debug, Clone, Default)]
pub(super) struct Form(pub(super) BTreeMap<Vec<usize>, BigInt>);

/// `(a + b x)^n`.
pub(super) fn linear_power(a: &BigInt, b: &BigInt, n: usize) -> Vec<BigInt> {
    (0..n).fold(vec![BigInt::one()], |power, _| {
        let mut next: Vec<BigInt> = power.iter().map(|value| value * a).collect();
        next.push(BigInt::zero());
        next[1..].iter_mut().zip(&power).for_each(|(sum, value)| *sum += value * b);
        next
    })
}

/// The product of two polynomials.
pub(super) fn times(p: &[BigInt], q: &[BigInt]) -> Vec<BigInt> {
    let mut product = vec![BigInt::zero(); p.len() + q.len() - 1];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

impl Form {
    fn degree(&self, axis: usize) -> usize {
        self.0.keys().map(|powers| powers[axis]).max().unwrap_or(0)
    }

    /// Each power of a variable replaced by a polynomial in it.
    fn substituted(&self, axis: usize, row: impl Fn(usize) -> Vec<BigInt>) -> Self {
        let rows: Vec<Vec<BigInt>> = (0..=self.degree(axis)).map(row).collect();
        let mut result = Self::default();
        for (powers, value) in &self.0 {
            for (power, factor) in rows[powers[axis]].iter().enumerate() {
                let mut powers = powers.clone();
                powers[axis] = power;
                *result.0.entry(powers).or_default() += value * factor;
            }
        }
        result.0.retain(|_, value| !value.is_zero());
        result
    }

    /// `1 − x` for a variable.
    fn flipped(&self, axis: usize) -> Self {
        self.substituted(axis, |power| linear_power(&1.into(), &(-1).into(), power))
    }

    /// `x/2` or `(1 + x)/2` for a variable.
    fn half(&self, axis: usize, upper: bool) -> Self {
        let degree = self.degree(axis);
        let start = BigInt::from(i32::from(upper));
        self.substituted(axis, |power| {
            let scale = BigInt::one() << (degree - power);
            linear_power(&start, &1.into(), power).into_iter().map(|x| x * &scale).collect()
        })
    }

    /// The other axes of a set as multiples of the leader, and the largest power of it divided out.
    fn chart(&self, axes: &[usize], leader: usize) -> Result<Self, CertificateError> {
        let sum = |powers: &Vec<usize>| axes.iter().map(|&axis| powers[axis]).sum::<usize>();
        let order = self.0.keys().map(sum).min().unwrap_or(0);
        let moved = self.0.iter().map(|(powers, value)| {
            let mut moved = powers.clone();
            moved[leader] = sum(powers) - order;
            (moved, value.clone())
        });
        let chart = Self(moved.collect());
        ensure(chart.degree(leader) <= HIGHEST, "a chart in a chart in a chart")?;
        Ok(chart)
    }

    /// Whether no Bernstein coefficient on the unit cube is negative: those of `Π (1 + u_a)^{n_a} p(u/(1 + u))` are positive multiples.
    fn is_positive(&self, dimension: usize) -> bool {
        let expanded = (0..dimension).fold(self.clone(), |form, axis| {
            let degree = form.degree(axis);
            form.substituted(axis, |power| {
                let mut row = vec![BigInt::zero(); power];
                row.extend(linear_power(&1.into(), &1.into(), degree - power));
                row
            })
        });
        !expanded.0.values().any(Signed::is_negative)
    }

    /// The Bernstein coefficients in `t`, the last variable, from `low` to `high`: polynomials in the others, times positive numbers.
    pub(super) fn in_last(&self, low: &Rational, high: &Rational) -> Vec<Self> {
        let axis = self.0.keys().next().map_or(0, |powers| powers.len() - 1);
        let (degree, d) = (self.degree(axis), low.denom().lcm(high.denom()));
        let whole = |value: &Rational| value.numer() * (&d / value.denom());
        let (a, b) = (whole(low), whole(high));
        // t = (a + b u)/(d + d u)
        let mixed = self.substituted(axis, |power| {
            times(&linear_power(&a, &b, power), &linear_power(&d, &d, degree - power))
        });
        let mut rows = vec![Self::default(); degree + 1];
        for (mut powers, value) in mixed.0 {
            let power = powers.pop().unwrap_or(0);
            rows[power].0.insert(powers, value);
        }
        rows
    }

    /// `t^n p(1/t)`.
    pub(super) fn reversed_in_last(&self) -> Self {
        let axis = self.0.keys().next().map_or(0, |powers| powers.len() - 1);
        let degree = self.degree(axis);
        let turned = self.0.iter().map(|(powers, value)| {
            let mut powers = powers.clone();
            powers[axis] = degree - powers[axis];
            (powers, value.clone())
        });
        Self(turned.collect())
    }

    /// Replays cuts; gives their number.
    pub(super) fn nowhere_negative(
        self,
        cuts: &str,
        dimension: usize,
    ) -> Result<usize, CertificateError> {
        let mut waiting = VecDeque::from([self]);
        let (mut signs, mut boxes) = (cuts.chars(), 0);
        while let Some(mut cube) = waiting.pop_front() {
            boxes += 1;
            loop {
                match next(&mut signs)? {
                    '.' => ensure(cube.is_positive(dimension), "a box is not decided")?,
                    '~' => {
                        cube = cube.flipped(axis_of(next(&mut signs)?, dimension)?);
                        continue;
                    }
                    '{' => {
                        let axes = set(&mut signs, dimension)?;
                        for &leader in &axes {
                            waiting.push_back(cube.chart(&axes, leader)?);
                        }
                    }
                    letter => {
                        let axis = axis_of(letter, dimension)?;
                        waiting.extend([cube.half(axis, false), cube.half(axis, true)]);
                    }
                }
                break;
            }
        }
        ensure(signs.next().is_none(), "there are more cuts than cubes")?;
        Ok(boxes)
    }

    /// The polynomial in the chart to which a way leads, powers of the variables divided out.
    pub(super) fn followed(self, way: &str, dimension: usize) -> Result<Self, CertificateError> {
        let (mut form, mut signs) = (self, way.chars());
        while let Some(sign) = signs.next() {
            form = match sign {
                '~' => form.flipped(axis_of(next(&mut signs)?, dimension)?),
                '{' => {
                    let axes = set(&mut signs, dimension)?;
                    let leader = axis_of(next(&mut signs)?, dimension)?;
                    ensure(axes.contains(&leader), "a leader is none of its axes")?;
                    form.chart(&axes, leader)?
                }
                letter => {
                    let upper = next(&mut signs)?;
                    ensure(['<', '>'].contains(&upper), "a way is not understood")?;
                    form.half(axis_of(letter, dimension)?, upper == '>')
                }
            };
        }
        (0..dimension).try_fold(form, |form, axis| form.chart(&[axis], axis))
    }

    /// The coefficients of the powers of `t` at a point, times a positive number.
    pub(super) fn at_point(&self, point: &[Rational]) -> Vec<BigInt> {
        let mut values = vec![Rational::zero(); self.degree(point.len()) + 1];
        for (powers, value) in &self.0 {
            let product = point.iter().zip(powers).map(|(x, &power)| x.pow(power as i32));
            values[powers[point.len()]] +=
                product.fold(value.clone().into(), |a: Rational, b| a * b);
        }
        let common = values.iter().fold(BigInt::one(), |all, value| all.lcm(value.denom()));
        values.iter().map(|value| value.numer() * (&common / value.denom())).collect()
    }
}

fn next(signs: &mut std::str::Chars) -> Result<char, CertificateError> {
    signs.next().ok_or_else(|| CertificateError("cuts end too soon".into()))
}

fn axis_of(letter: char, dimension: usize) -> Result<usize, CertificateError> {
    let axis = ['x', 'y', 'z'][..dimension].iter().position(|axis| *axis == letter);
    axis.ok_or_else(|| CertificateError(format!("there is no axis {letter:?}")))
}

/// The axes up to `}`, in ascending order.
fn set(signs: &mut std::str::Chars, dimension: usize) -> Result<Vec<usize>, CertificateError> {
    let mut axes = Vec::new();
    loop {
        match next(signs)? {
            '}' => break,
            letter => axes.push(axis_of(letter, dimension)?),
        }
    }
    ensure(!axes.is_empty() && axes.is_sorted_by(|a, b| a < b), "no set of axes")?;
    Ok(axes)
}
