//! Stable intervals: covers of all waves in between, a growing wave at either end.

use super::super::{
    Certificate, Cover, End, Exact, GrowingWave, Interval, LineProof, LossClaim, Piece, Proof,
};
use super::conditions::Condition;
use super::ends::{BEYOND, above, closed_form, just_above, just_below, touches, zero};
use super::{CertificationError, MAX_BOXES};
use crate::exact::bernstein::{MarginForm, Sign, exact_cover, is_negative_between};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, square_root_enclosure};
use crate::stability::{Limit, StableInterval, phase_parameter};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Boxes a cover may have before its piece of `t` is halved, and how many pieces are looked at.
const BOXES_OF_A_PIECE: usize = 400;
const MAX_PIECES: usize = 400;

/// Boxes that are tried where they may not suffice however many there are.
const BOXES_AT_A_DOUBLE_ZERO: usize = 60;

/// How near a root is enclosed for conditions in the first power of the parameter.
const ROOT_BITS: u32 = 80;

pub(super) struct Prover<'a> {
    conditions: &'a [Condition],
    max: &'a Rational,
}

impl<'a> Prover<'a> {
    pub(super) fn new(conditions: &'a [Condition], max: &'a Rational) -> Self {
        Self { conditions, max }
    }

    /// One interval; at ends that boxes do not reach exactly it is a little shorter.
    pub(super) fn interval(
        &self,
        base: &Certificate,
        found: &StableInterval,
    ) -> Result<Certificate, CertificationError> {
        let exactly = self.with_ends(base, found, true);
        match exactly {
            Err(CertificationError::TooLarge | CertificationError::NoWitness) => {
                self.with_ends(base, found, false)
            }
            decided => decided,
        }
    }

    fn with_ends(
        &self,
        base: &Certificate,
        found: &StableInterval,
        exactly: bool,
    ) -> Result<Certificate, CertificationError> {
        let lost = || CertificationError::NotWritten("an end is not known");
        let closed = |limit: &Limit| closed_form(limit).filter(|_| exactly);
        let begin = if found.from.upper() == 0.0 {
            End::Fraction(Rational::zero())
        } else {
            match closed(&found.from) {
                Some(end) => end,
                None => End::Fraction(just_above(&found.from).ok_or_else(lost)?),
            }
        };
        let (lower, upper) = if found.to.is_unbounded() {
            (End::Infinity, None)
        } else if found.to.upper().is_infinite() {
            (End::Fraction(self.max.clone()), None)
        } else if let Some(end) = closed(&found.to) {
            (end.clone(), Some(end))
        } else {
            let fraction = |value: Option<Rational>| value.map(End::Fraction).ok_or_else(lost);
            (fraction(just_below(&found.to))?, Some(fraction(just_above(&found.to))?))
        };
        let above = match &upper {
            Some(upper) => Some(self.above(&found.to, upper)?),
            None => None,
        };
        let below = match &begin {
            End::Fraction(value) if value.is_zero() => None,
            _ => Some(self.below(&found.from)?),
        };
        let few = exactly && (touches(&found.from) || touches(&found.to));
        let most = if few { BOXES_AT_A_DOUBLE_ZERO } else { MAX_BOXES };
        let covers = self.conditions.iter().map(|one| self.cover(one, &begin, &lower, most));
        let covers = covers.collect::<Result<Vec<_>, _>>()?;
        let interval = Interval { begin, lower, upper };
        let proof = LineProof { inequalities: Vec::new(), below, covers, above };
        Ok(self.certificate(base, interval, proof))
    }

    /// No small value is stable.
    pub(super) fn no_limit(
        &self,
        base: &Certificate,
        limit: &Limit,
    ) -> Result<Certificate, CertificationError> {
        let above = Some(self.above(limit, &End::Fraction(Rational::zero()))?);
        let (inequalities, covers) = (Vec::new(), Vec::new());
        let proof = LineProof { inequalities, below: None, covers, above };
        Ok(self.certificate(base, zero(), proof))
    }

    /// With the inequalities stated.
    fn certificate(&self, base: &Certificate, interval: Interval, proof: LineProof) -> Certificate {
        let inequalities = self.conditions.iter().map(|one| one.stated.clone()).collect();
        let proof = Proof::Line(LineProof { inequalities, ..proof });
        Certificate { interval, proof, ..base.clone() }
    }

    /// Covers of all waves over an interval of `t`, which is halved where boxes over all of it would never
    /// do: of a degree above one in `t` the Bernstein coefficients may stay negative however small `s` is.
    fn cover(
        &self,
        condition: &Condition,
        begin: &End,
        lower: &End,
        most: usize,
    ) -> Result<Cover, CertificationError> {
        let stride = condition.margin.stride();
        if condition.margin.is_neutral() {
            return Err(CertificationError::NotWritten("a condition vanishes identically"));
        }
        // Where t is no fraction the cover begins a little before and ends a little behind.
        let t = |end: &End, below: bool| match end {
            End::Fraction(value) => Some(value.pow(stride as i32)),
            End::Root(square) if stride == 2 => Some(square.clone()),
            End::Root(square) => {
                let (low, high) = square_root_enclosure(square, square, ROOT_BITS);
                Some(if below { low } else { high })
            }
            End::Infinity => None,
        };
        let from = t(begin, true).unwrap_or_default();
        // What is stable for ever needs some beginning of its last piece.
        let last = self.max.pow(stride as i32).max(&from * integer(2));
        let to = t(lower, false).unwrap_or(last);
        let mut pieces = self.pieces(condition, &from, &to, most)?;
        if *lower == End::Infinity {
            let reversed = condition.form.clone().reversed();
            let waves = exact_cover(&reversed, &Rational::zero(), &to.recip(), MAX_BOXES);
            let waves = waves.ok_or(CertificationError::TooLarge)?;
            let waves = waves.into_iter().map(|part| part.to.into()).collect();
            pieces.push(Piece { end: End::Infinity, waves });
        }
        Ok(Cover { begin: from.into(), pieces })
    }

    fn pieces(
        &self,
        condition: &Condition,
        from: &Rational,
        to: &Rational,
        most: usize,
    ) -> Result<Vec<Piece>, CertificationError> {
        let linear = condition.margin.powers() <= 2;
        let (boxes, mut left) =
            if linear { (most, 1) } else { (BOXES_OF_A_PIECE.min(most), MAX_PIECES.min(most)) };
        let mut pieces = Vec::new();
        let mut pending = vec![(from.clone(), to.clone())];
        while let Some((from, to)) = pending.pop() {
            if left == 0 {
                return Err(CertificationError::TooLarge);
            }
            left -= 1;
            match exact_cover(&condition.form, &from, &to, boxes) {
                Some(cover) => {
                    let waves = cover.into_iter().map(|part| Exact(part.to)).collect();
                    pieces.push(Piece { end: End::Fraction(to), waves });
                }
                None => {
                    let middle = (&from + &to) / integer(2);
                    pending.push((middle.clone(), to));
                    pending.push((from, middle));
                }
            }
        }
        Ok(pieces)
    }

    /// A wave that is unstable from `upper` to a little above it.
    fn above(&self, limit: &Limit, upper: &End) -> Result<LossClaim, CertificationError> {
        let near = match upper {
            End::Fraction(value) => Some(value.clone()),
            _ => just_above(limit),
        };
        let near = near.ok_or(CertificationError::NoWitness)?;
        let square = upper.square().unwrap_or_default();
        for value in above(&near, self.max) {
            if &value * &value <= square {
                continue;
            }
            for (number, condition) in self.conditions.iter().enumerate() {
                let stride = condition.margin.stride();
                let t = match (upper, stride) {
                    (End::Fraction(upper), 1) => upper.clone(),
                    (_, 2) => square.clone(),
                    _ => continue,
                };
                if let Some(claim) = loss(number, condition, limit, &t, &value) {
                    return Ok(claim);
                }
            }
        }
        Err(CertificationError::NoWitness)
    }

    /// A wave that grows just below the beginning of a stable interval.
    fn below(&self, begin: &Limit) -> Result<GrowingWave, CertificationError> {
        let near = just_below(begin).ok_or(CertificationError::NoWitness)?;
        for bits in BEYOND {
            let value = &near - &near * Rational::new(BigInt::one(), BigInt::one() << bits);
            for (number, condition) in self.conditions.iter().enumerate() {
                let t = value.pow(condition.margin.stride() as i32);
                let (Sign::SomewhereNegative { phase_parameter, .. }, _) =
                    condition.form.sign(&t, &t, MAX_BOXES)
                else {
                    continue;
                };
                if let Some(s) = growing_wave(condition, &phase_parameter, &value) {
                    return Ok(GrowingWave {
                        inequality: number,
                        s: s.into(),
                        value: value.into(),
                    });
                }
            }
        }
        Err(CertificationError::NoWitness)
    }
}

/// Where a condition fails from `t` on, as far as the power of `value`.
fn loss(
    number: usize,
    condition: &Condition,
    limit: &Limit,
    t: &Rational,
    value: &Rational,
) -> Option<LossClaim> {
    let beyond = value.pow(condition.margin.stride() as i32);
    let critical = limit.critical_phase().filter(|_| condition.margin.degree() > 0);
    let mut candidates = vec![phase_parameter(critical.unwrap_or(0.0))];
    if let (Sign::SomewhereNegative { phase_parameter, .. }, _) =
        condition.form.sign(&beyond, &beyond, MAX_BOXES)
    {
        candidates.push(phase_parameter);
    }
    candidates.into_iter().find_map(|s| {
        let values = condition.form.at_phase_parameter(&s, 1);
        if is_negative_between(&values, t, &beyond) != Some(true) {
            return None;
        }
        let grows = growing_wave(condition, &s, value)?;
        let wave = GrowingWave { inequality: number, s: grows.into(), value: value.clone().into() };
        Some(LossClaim { s: s.into(), wave })
    })
}

/// A wave near `s`, itself neither infinitely long nor neutral at every value, whose margin is negative.
fn growing_wave(condition: &Condition, s: &Rational, value: &Rational) -> Option<Rational> {
    let (stated, form): (_, &MarginForm) = (&condition.stated, &condition.form);
    let t = value.pow(condition.margin.stride() as i32);
    let steps = (4..400).step_by(2).flat_map(|bits| {
        let step = Rational::new(BigInt::one(), BigInt::one() << bits);
        [s + &step, s - step]
    });
    let polynomial =
        |row: &[Exact]| Polynomial::new(row.iter().map(|value| value.0.clone()).collect());
    std::iter::once(s.clone()).chain(steps).find(|candidate| {
        let in_range = candidate.is_positive() && *candidate <= integer(1);
        let complement = condition.margin.complement_power() == 0 || !candidate.is_one();
        let squared: Vec<Rational> =
            stated.square.iter().map(|row| polynomial(row).evaluate(candidate)).collect();
        in_range
            && complement
            && !condition.margin.neutral_waves().evaluate(candidate).is_zero()
            && polynomial(&stated.weight).evaluate(candidate).is_positive()
            && !Polynomial::new(squared).evaluate(value).is_zero()
            && Polynomial::new(form.at_phase_parameter(candidate, 1)).evaluate(&t).is_negative()
    })
}
