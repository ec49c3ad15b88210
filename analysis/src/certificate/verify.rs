//! The checker: derives the polynomials of a certificate again from its text, and recomputes every sign by the plainest means.
//!
//! It shares nothing with the search but fractions of big integers: the text is read by a [parser of its own](super::derive), products
//! are multiplied out term by term in powers of `s`, and Bernstein coefficients come from substituting the interval. Slow and short is
//! the point.

mod arithmetic;
pub(super) mod compare;
mod cube;
mod form;
mod inequality;
mod line;
pub(super) mod torus;

use super::derive::Characteristic;
use super::{Certificate, End, Proof, Question};
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use thiserror::Error;

/// What a certificate proves, now checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verified {
    /// The theorem in one sentence.
    pub statement: String,
    /// How many boxes were recomputed.
    pub boxes: usize,
}

/// The first thing in a certificate that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct CertificateError(pub String);

pub(super) fn ensure(holds: bool, otherwise: &str) -> Result<(), CertificateError> {
    if holds { Ok(()) } else { Err(CertificateError(otherwise.into())) }
}

/// Checks a certificate.
///
/// # Errors
/// Names the first part that does not hold.
pub fn verify(certificate: &Certificate) -> Result<Verified, CertificateError> {
    form::check(certificate)?;
    check_polynomials(certificate)?;
    let boxes = check_interval(certificate)?;
    let (interval, parameter) = (&certificate.interval, &certificate.subject.parameter);
    let property = match certificate.question {
        Question::Stability => format!("|z| <= 1 + {} for all waves", certificate.growth.0),
        Question::Monotonicity => "no coefficient is negative".into(),
    };
    let begin = match interval.begin.square() {
        Some(zero) if zero.is_zero() => String::new(),
        _ => format!("from {parameter} = {} ", interval.begin),
    };
    let end = match &interval.upper {
        _ if interval.lower == End::Infinity => "without end".into(),
        None => format!("at least up to {parameter} = {}", interval.lower),
        Some(upper) if *upper == interval.lower => {
            format!("up to {parameter} = {upper} and not just above")
        }
        Some(upper) => {
            format!("up to {parameter} = {} and not above {upper}", interval.lower)
        }
    };
    let name = certificate.subject.name();
    Ok(Verified { statement: format!("{name}: {property} {begin}{end}"), boxes })
}

/// Whether the polynomials stated are those of the scheme.
fn check_polynomials(certificate: &Certificate) -> Result<(), CertificateError> {
    let stability = certificate.question == Question::Stability;
    let chi = Characteristic::new(&certificate.subject, stability)?;
    let (growth, levels) = (&certificate.growth.0, &certificate.levels);
    let derived = if stability {
        chi.conditions(&certificate.subject, growth, levels)?
    } else {
        ensure(growth.is_zero() && levels.is_empty(), "no growth and no level here")?;
        chi.monotonicity()?
    };
    let own: Vec<(usize, &String)> =
        derived.iter().map(|one| (one.level, &one.condition)).collect();
    let same = |stated: Vec<(usize, &String)>| ensure(own == stated, "the conditions are others");
    let mut all_exact = true;
    match &certificate.proof {
        Proof::Line(line) => {
            same(line.inequalities.iter().map(|one| (one.level, &one.condition)).collect())?;
            for (derived, stated) in derived.iter().zip(&line.inequalities) {
                all_exact &= compare::compare(&derived.polynomial, &chi.letters, stated)?;
            }
        }
        Proof::Torus(torus) => {
            same(torus.inequalities.iter().map(|one| (one.level, &one.condition)).collect())?;
            for (derived, stated) in derived.iter().zip(&torus.inequalities) {
                torus::compare(derived, &chi, &certificate.subject, stated)?;
            }
        }
    }
    let word = if all_exact { "proved" } else { "enclosed" };
    ensure(certificate.evidence == word, "the evidence is not the one the radii give")
}

/// What a proof shows, each value of the parameter by its square.
#[derive(Debug, Default)]
struct Shown {
    /// Where each cover begins and ends; `None` for those without end.
    covers: Vec<(Rational, Option<Rational>)>,
    boxes: usize,
    /// Where the waves outside grow.
    below: Option<Rational>,
    above: Option<Rational>,
}

/// Whether the interval follows from the polynomials; how many boxes it took.
fn check_interval(certificate: &Certificate) -> Result<usize, CertificateError> {
    let interval = &certificate.interval;
    let negative = |end: &End| matches!(end, End::Fraction(value) if value.is_negative());
    let ends = [Some(&interval.begin), Some(&interval.lower), interval.upper.as_ref()];
    ensure(
        !certificate.growth.0.is_negative() && !ends.into_iter().flatten().any(negative),
        "a negative number",
    )?;
    let begin = interval.begin.square();
    let begin = begin.ok_or_else(|| CertificateError("an interval begins somewhere".into()))?;
    let lower = interval.lower.square();
    let nothing = lower.as_ref().is_some_and(Zero::is_zero);
    ensure(
        lower.as_ref().is_none_or(|lower| begin < *lower || nothing && begin.is_zero()),
        "the interval ends before it begins",
    )?;
    let shown = match &certificate.proof {
        Proof::Line(line) => line::shown(line, interval)?,
        Proof::Torus(torus) => torus::shown(torus, interval)?,
    };
    for (low, high) in &shown.covers {
        let reaches = match (&lower, high) {
            (_, None) => true,
            (None, Some(_)) => false,
            (Some(lower), Some(high)) => lower <= high,
        };
        ensure(*low <= begin && reaches, "an interval is not covered")?;
    }
    match shown.below {
        None => ensure(begin.is_zero(), "the interval begins above 0 without a reason")?,
        Some(square) => {
            let gap = &begin - square;
            let near = gap.is_positive() && gap <= &begin * nearness(16);
            ensure(near, "the first wave is not just below the interval")?;
        }
    }
    let Some(grows) = shown.above else {
        ensure(interval.upper.is_none(), "an upper end comes with a growing wave")?;
        return Ok(shown.boxes);
    };
    let (Some(square), Some(lower)) = (interval.upper.as_ref().and_then(End::square), lower) else {
        return Err(CertificateError("a growing wave comes with an upper end".into()));
    };
    ensure(
        lower <= square && &square - &lower <= &lower * nearness(18),
        "the ends of the limit are far apart",
    )?;
    let gap = grows - &square;
    let scale = if square.is_zero() { Rational::one() } else { square };
    let near = gap.is_positive() && gap <= scale * nearness(16);
    ensure(near, "the wave is not just above the limit")?;
    Ok(shown.boxes)
}

fn nearness(bits: u32) -> Rational {
    Rational::new(BigInt::one(), BigInt::one() << bits)
}
