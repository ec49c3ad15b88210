//! An edge between stability and instability: located, enclosed, and recognised.

use super::phase_of;
use super::search::{Search, power_of_half};
use crate::exact::algebraic_number::AlgebraicNumber;
use crate::exact::descartes::sign_changes;
use crate::exact::discriminant::primitive;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{
    Rational, compare, equal, from_f64, integer, product, simplest_between, square_root_enclosure,
    to_f64, to_f64_above, to_f64_below,
};
use crate::exact::real_roots::{RealRoot, real_roots, root_near};
use crate::stability::critical::{Critical, refine};
use crate::stability::margin::Margin;
use crate::stability::{Evidence, ExactValue, Limit};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::f64::consts::PI;

/// Roots in `t` are enclosed to so many bits more than an edge: far below its width.
const GUARD_BITS: u32 = 20;

/// Roots that may be fractions are enclosed to at least this many: two fractions that close together have
/// denominators above 2^100.
const FRACTION_BITS: u32 = 200;

/// Enclosures of up to this width, as a power of one half, take the wave from floating point.
const FLOAT_BITS: u32 = 48;

/// What is below this part of the sum of all terms may be zero.
const ROUNDING: f64 = 1e-11;

/// An end of a stretch in `t`: nothing is claimed strictly between `lower` and `upper`.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    pub(super) lower: Rational,
    pub(super) upper: Rational,
    /// The `s` of the wave that binds.
    pub(super) s: Rational,
}

impl Edge {
    pub(super) fn zero() -> Self {
        Self { lower: Rational::zero(), upper: Rational::zero(), s: Rational::zero() }
    }
}

impl Search<'_> {
    pub(super) fn root_bits(&self) -> u32 {
        self.bits.max(super::DEFAULT_BITS) + GUARD_BITS
    }

    /// The edge where instability ends and stability returns.
    pub(super) fn upper_edge(&mut self, guess: Critical) -> Option<Edge> {
        let refined = refine(&self.compiled, guess, false, to_f64(&self.end));
        for s in [integer(0), integer(1)] {
            let Some(root) = self.root_near(&s, refined.parameter, 1e-9) else { continue };
            let beyond = &root.upper * (integer(1) + power_of_half(30));
            if self.is_stable(&root.upper, &beyond).is_ok() {
                return Some(Edge { lower: root.lower, upper: root.upper, s });
            }
        }
        let edge = self.interior_edge(refined)?;
        for bits in self.widths() {
            let upper = &edge.lower * (integer(1) + power_of_half(bits));
            let beyond = &upper * (integer(1) + power_of_half(bits - 6));
            if self.is_stable(&upper, &beyond).is_ok() {
                return Some(Edge { upper, ..edge });
            }
        }
        None
    }

    /// The critical `t` at the refined phase, exactly: stability certainly fails on one side of it.
    pub(super) fn interior_edge(&mut self, refined: Critical) -> Option<Edge> {
        // The wave enters squared: half the digits, which floating point has, serve a limit of its width.
        let exactly = || touching_point(self.margin, refined, self.root_bits());
        let s = (self.bits > FLOAT_BITS).then(exactly).flatten();
        let s = s.unwrap_or_else(|| short_phase_parameter(refined.phase));
        let root = self.root_near(&s, refined.parameter, 1e-3)?;
        Some(Edge { lower: root.lower, upper: root.upper, s })
    }

    /// The root in `t` of the margin at a fixed `s` nearest to a guess; enclosed, and widened by the
    /// uncertainty of the data.
    pub(super) fn root_near(
        &mut self,
        s: &Rational,
        guess: f64,
        tolerance: f64,
    ) -> Option<RealRoot> {
        if guess <= 0.0 {
            return None;
        }
        if s.is_integer() && !self.may_vanish_at_end(s.is_one(), guess, tolerance) {
            return None;
        }
        let mut enclosure: Option<RealRoot> = None;
        let shifts: &[i64] = if self.margin.is_exact() { &[0] } else { &[-1, 1] };
        let center = from_f64(guess)?;
        let from = product(&center, &from_f64(1.0 - tolerance)?);
        let to = product(&center, &from_f64(1.0 + tolerance)?).min(self.end.clone());
        for &shift in shifts {
            self.work.evaluations += 1;
            let coefficients = self.integers_at(s, shift);
            let nearest = if s.is_integer() && self.margin.is_exact() {
                fraction_or_root(coefficients, guess, &from, &to, self.root_bits())
            } else {
                root_near(&coefficients, guess, self.root_bits())
            };
            let nearest = nearest.filter(|root| {
                compare(&root.lower, &from).is_gt() && compare(&root.upper, &to).is_le()
            })?;
            enclosure = Some(match enclosure {
                None => nearest,
                Some(first) => RealRoot {
                    lower: first.lower.min(nearest.lower),
                    upper: first.upper.max(nearest.upper),
                },
            });
        }
        enclosure
    }

    /// Whether floating point sees the margin vanish at an end of the phase range, `s = 1` or 0, within a part of `t`.
    fn may_vanish_at_end(&self, shortest: bool, t: f64, tolerance: f64) -> bool {
        let mut powers = Vec::new();
        self.compiled.powers_at(if shortest { PI } else { 0.0 }, &mut powers);
        let value = powers.iter().rev().fold(0.0, |sum, power| sum * t + power);
        let (change, _) = powers.iter().zip(0..).fold((0.0, 1.0), |(sum, t_power), (power, j)| {
            (sum + f64::from(j) * (power * t_power).abs(), t_power * t)
        });
        value.abs() <= 4.0 * tolerance * change + ROUNDING * self.compiled.size_at(t)
    }

    /// An edge in `t` as a limit on `C`: a closed form, a root of a polynomial, or an enclosure.
    pub(super) fn limit(&self, edge: &Edge, evidence: Evidence) -> Limit {
        if edge.upper.is_zero() {
            return Limit::exactly(ExactValue::Fraction(Rational::zero()), evidence);
        }
        let closed = |t: Rational| match self.margin.stride() {
            2 => ExactValue::square_root(t),
            _ => ExactValue::Fraction(t),
        };
        let limit = if equal(&edge.lower, &edge.upper) {
            Limit::exactly(closed(edge.lower.clone()), evidence)
        } else if let Some(root) = self
            .critical_polynomials()
            .and_then(|critical| critical.root_between(&edge.lower, &edge.upper))
            .or_else(|| self.root_of_an_end(edge))
        {
            match root.power_as_fraction() {
                Some(t) => Limit::exactly(closed(t), evidence),
                None if self.margin.stride() == 2 => Limit::root_of(root.square_root(), evidence),
                None => Limit::root_of(root, evidence),
            }
        } else {
            let (lower, upper) = self.courant_enclosure(&edge.lower, &edge.upper);
            Limit::enclosed(lower, upper, evidence)
        };
        limit.at_phase(phase_of(&edge.s))
    }

    /// The root where an end of the phase range binds and discriminants were not asked for.
    fn root_of_an_end(&self, edge: &Edge) -> Option<AlgebraicNumber> {
        if !self.margin.is_exact() || !edge.s.is_integer() {
            return None;
        }
        let polynomial = primitive(&Polynomial::new(self.form.integers_at(&edge.s, 0)));
        (sign_changes(&polynomial, &edge.lower, &edge.upper) == 1)
            .then(|| AlgebraicNumber::between(polynomial, edge.lower.clone(), edge.upper.clone()))
            .flatten()
    }

    pub(super) fn courant_numbers(&self, lower: &Rational, upper: &Rational) -> (f64, f64) {
        let (lower, upper) = self.courant_enclosure(lower, upper);
        (to_f64_below(&lower), to_f64_above(&upper))
    }

    fn courant_enclosure(&self, lower: &Rational, upper: &Rational) -> (Rational, Rational) {
        match self.margin.stride() {
            2 => square_root_enclosure(lower, upper, self.root_bits()),
            _ => (lower.clone(), upper.clone()),
        }
    }
}

/// `s = sin²(φ/2)` of a wave known to half the digits of an `f64`, with no more than these.
fn short_phase_parameter(phase: f64) -> Rational {
    let s = to_f64(&super::phase_parameter(phase));
    from_f64(f64::from_bits(s.to_bits() >> 24 << 24)).expect("it was finite")
}

/// Where the margin touches zero, `P = ∂P/∂s = 0`, by Newton's method from a guess that floating point finds to
/// half its digits only: the guess sits on a flat extremum. The `s`, cut to as many bits as an error that enters
/// squared needs.
fn touching_point(margin: &Margin, guess: Critical, bits: u32) -> Option<Rational> {
    // Fixed point with a unit of 2^−digits; powers of s cancel by up to two bits for each degree.
    let digits = 2 * u64::from(bits) + 4 * margin.degree() as u64;
    let one: BigInt = BigInt::one() << digits;
    let fixed = |value: f64| Some((from_f64(value)? * Rational::from(one.clone())).to_integer());
    let cut = |value: BigInt| value >> digits;
    let largest = margin.integer_series().iter().flat_map(|series| series.coefficients());
    let size = largest.map(BigInt::bits).max()?;
    let scaled = |value: &BigInt| {
        let shift = digits as i64 - size as i64;
        if shift >= 0 { value << shift as u64 } else { value >> (-shift) as u64 }
    };
    let rows: Vec<Vec<BigInt>> = margin
        .integer_series()
        .iter()
        .map(|series| series.in_powers_of_s().coefficients().iter().map(scaled).collect())
        .collect();
    let (start, range) = (guess.parameter, 1e-3 * guess.parameter);
    let (mut s, mut t) = (fixed((0.5 * guess.phase).sin().powi(2))?, fixed(start)?);
    for _ in 0..(bits / 5).max(2).ilog2() + 3 {
        // P, its first derivatives and those of ∂P/∂s, by Horner's rule in s and then in t.
        let [mut p, mut p_s, mut p_ss, mut p_t, mut p_st] = [const { BigInt::ZERO }; 5];
        for row in rows.iter().rev() {
            let [mut value, mut slope, mut bend] = [const { BigInt::ZERO }; 3];
            for coefficient in row.iter().rev() {
                bend = cut(bend * &s) + &slope;
                slope = cut(slope * &s) + &value;
                value = cut(value * &s) + coefficient;
            }
            p_t = cut(p_t * &t) + &p;
            p_st = cut(p_st * &t) + &p_s;
            p = cut(p * &t) + value;
            p_s = cut(p_s * &t) + slope;
            p_ss = cut(p_ss * &t) + (bend << 1);
        }
        let determinant = cut(&p_s * &p_st - &p_t * &p_ss);
        if determinant.is_zero() {
            return None;
        }
        s += (&p_t * &p_s - &p * &p_st) / &determinant;
        t += (&p * &p_ss - &p_s * &p_s) / &determinant;
    }
    let moved = to_f64(&Rational::new(t, one.clone())) - start;
    let s = Rational::new(s >> (digits - u64::from(bits)), BigInt::one() << bits);
    let inside = s > integer(0) && s < integer(1);
    (inside && moved.abs() <= range).then_some(s)
}

/// The root at an end of the phase range, where it may be a fraction: the simplest fraction within a
/// narrow enclosure is tried. A multiple root, which Newton's method does not enclose, goes to Sturm.
pub(crate) fn fraction_or_root(
    coefficients: Vec<BigInt>,
    guess: f64,
    from: &Rational,
    to: &Rational,
    bits: u32,
) -> Option<RealRoot> {
    if let [constant, slope] = coefficients.as_slice()
        && !slope.is_zero()
    {
        let value = Rational::new(-constant, slope.clone());
        return Some(RealRoot { lower: value.clone(), upper: value });
    }
    let narrow = root_near(&coefficients, guess, bits.max(FRACTION_BITS));
    let exact = Polynomial::new(coefficients.into_iter().map(Rational::from).collect());
    match narrow {
        Some(root) => {
            let simplest = simplest_between(&root.lower, &root.upper);
            let is_root = exact.evaluate(&simplest).is_zero();
            Some(if is_root { RealRoot { lower: simplest.clone(), upper: simplest } } else { root })
        }
        None => real_roots(&exact, from, to, bits).into_iter().min_by(|a, b| {
            let distance = |root: &RealRoot| (to_f64(&root.lower) - guess).abs();
            distance(a).total_cmp(&distance(b))
        }),
    }
}

#[cfg(test)]
mod tests;
