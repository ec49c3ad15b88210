//! One inequality: its signs above boxes, and where it fails.

use super::super::{Cover, End, GrowingWave, StatedInequality};
use super::arithmetic::{bernstein, value};
use super::{CertificateError, ensure};
use crate::exact::rational::{Rational, integer};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Halvings that may show that a weight is not negative.
const MOST_BOXES: usize = 4096;

/// An inequality as it is stated.
pub(super) struct Checked<'a> {
    stated: &'a StatedInequality,
    pub(super) stride: usize,
    /// `[power of t][power of s]` times the denominator.
    rows: Vec<Vec<BigInt>>,
    radius: Vec<BigInt>,
}

impl<'a> Checked<'a> {
    pub(super) fn new(stated: &'a StatedInequality) -> Result<Self, CertificateError> {
        let margin = &stated.margin;
        let whole = |row: &Vec<super::super::Exact>| row.iter().map(|v| v.0.to_integer()).collect();
        let weight: Vec<Rational> = stated.weight.iter().map(|value| value.0.clone()).collect();
        nowhere_negative(&weight)?;
        Ok(Self {
            stated,
            stride: margin.stride,
            rows: margin.coefficients.iter().map(whole).collect(),
            radius: whole(&margin.radius),
        })
    }

    /// Checks a cover; gives the squares of the values where it begins and ends.
    pub(super) fn holds(
        &self,
        cover: &Cover,
    ) -> Result<(Rational, Option<Rational>), CertificateError> {
        let mut rows = self.rows.clone();
        for (row, radius) in rows.iter_mut().zip(&self.radius) {
            row[0] -= radius;
        }
        let says_something = rows.iter().flatten().any(|value| !value.is_zero());
        ensure(says_something, "a polynomial that is zero says nothing")?;
        let begin = cover.begin.0.clone();
        ensure(!begin.is_negative() && !cover.pieces.is_empty(), "an interval is not covered")?;
        let mut reached = Some(begin.clone());
        for piece in &cover.pieces {
            let from =
                reached.ok_or_else(|| CertificateError("something beyond everything".into()))?;
            let (low, high) = match &piece.end {
                End::Fraction(to) => (from, to.clone()),
                End::Infinity => {
                    // From t₀ on: t^n P(1/t) from 0 to 1/t₀.
                    ensure(from.is_positive(), "an interval is not covered")?;
                    (Rational::zero(), from.recip())
                }
                End::Root(_) => return Err(CertificateError("t is no fraction".into())),
            };
            ensure(low < high, "an interval is not covered")?;
            let ordered: Vec<_> = match &piece.end {
                End::Infinity => rows.iter().rev().cloned().collect(),
                _ => rows.clone(),
            };
            let mut left = Rational::zero();
            for right in &piece.waves {
                ensure(left < right.0, "not all waves are covered")?;
                check_box(&ordered, (&left, &right.0), (&low, &high))?;
                left = right.0.clone();
            }
            ensure(left.is_one(), "not all waves are covered")?;
            reached = match &piece.end {
                End::Fraction(to) => Some(to.clone()),
                _ => None,
            };
        }
        let square = |t: Rational| if self.stride == 1 { &t * &t } else { t };
        Ok((square(begin), reached.map(square)))
    }

    /// The polynomial in `t` at one `s`, raised by the radii, up to a positive factor.
    fn raised_at(&self, s: &Rational) -> Vec<BigInt> {
        let (a, d, length) = (s.numer(), s.denom(), self.rows[0].len() as u32);
        let terms = |(row, radius): (&Vec<BigInt>, &BigInt)| {
            let sum: BigInt =
                (0u32..).zip(row).map(|(i, value)| value * a.pow(i) * d.pow(length - i)).sum();
            sum + radius * d.pow(length)
        };
        self.rows.iter().zip(&self.radius).map(terms).collect()
    }

    /// The polynomial is negative at this wave and value, whatever the truth within the radii, and no factor vanishes; gives the square
    /// of the value.
    pub(super) fn grows(&self, wave: &GrowingWave) -> Result<Rational, CertificateError> {
        let (s, at, margin) = (&wave.s.0, &wave.value.0, &self.stated.margin);
        let number = |list: &[super::super::Exact]| {
            value(&list.iter().map(|value| value.0.clone()).collect::<Vec<_>>(), s)
        };
        let squared: Vec<Rational> = self.stated.square.iter().map(|row| number(row)).collect();
        ensure(
            at.is_positive()
                && s.is_positive()
                && *s <= Rational::one()
                && (margin.complement_power == 0 || !s.is_one())
                && !number(&margin.neutral_waves).is_zero()
                && number(&self.stated.weight).is_positive()
                && !value(&squared, at).is_zero(),
            "the wave is not one that can grow",
        )?;
        let raised: Vec<Rational> = self.raised_at(s).into_iter().map(Rational::from).collect();
        let grows = value(&raised, &at.pow(self.stride as i32)).is_negative();
        ensure(grows, "the wave does not grow")?;
        Ok(at * at)
    }

    /// The polynomial at `s` is negative from `t` to the power of a value.
    pub(super) fn turns_negative(
        &self,
        s: &Rational,
        t: &Rational,
        at: &Rational,
    ) -> Result<(), CertificateError> {
        ensure(!s.is_negative() && *s <= Rational::one(), "s is not in [0, 1]")?;
        let signs = bernstein(&self.raised_at(s), t, &at.pow(self.stride as i32));
        ensure(
            signs.iter().all(|value| !value.is_positive()) && signs.iter().any(Signed::is_negative),
            "the wave at s does not grow throughout",
        )
    }
}

fn check_box(
    rows: &[Vec<BigInt>],
    (left, right): (&Rational, &Rational),
    (low, high): (&Rational, &Rational),
) -> Result<(), CertificateError> {
    let rows: Vec<_> = rows.iter().map(|row| bernstein(row, left, right)).collect();
    for i in 0..rows[0].len() {
        let column: Vec<_> = rows.iter().map(|row| row[i].clone()).collect();
        let negative = bernstein(&column, low, high).iter().any(Signed::is_negative);
        ensure(!negative, "a box is not decided")?;
    }
    Ok(())
}

/// On `[0, 1]`, by halving.
fn nowhere_negative(polynomial: &[Rational]) -> Result<(), CertificateError> {
    let common =
        polynomial.iter().fold(BigInt::one(), |all, v| num_integer::lcm(all, v.denom().clone()));
    let whole: Vec<BigInt> = polynomial.iter().map(|v| v.numer() * (&common / v.denom())).collect();
    let mut pending = vec![(Rational::zero(), Rational::one())];
    let mut boxes = 0;
    while let Some((from, to)) = pending.pop() {
        boxes += 1;
        ensure(
            boxes < MOST_BOXES && !value(polynomial, &from).is_negative(),
            "a weight is negative",
        )?;
        if bernstein(&whole, &from, &to).iter().any(Signed::is_negative) {
            let middle = (&from + &to) / integer(2);
            pending.push((from, middle.clone()));
            pending.push((middle, to));
        }
    }
    Ok(())
}
