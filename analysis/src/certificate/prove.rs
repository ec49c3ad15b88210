//! Certificates written down from the limits that were found.
//!
//! The polynomials are those that the [checker](super::derive) derives, not those of the search: where they do not bear out what was
//! found, no certificate can be written.

mod conditions;
mod ends;
mod interval;
mod levels;
mod torus;

use super::derive::Characteristic;
use super::verify::CertificateError;
use super::{Certificate, LineProof, Proof, Question, Subject};
use crate::exact::rational::Rational;
use crate::scheme::{SchemeError, Step};
use crate::stability::{SearchPlan, StableSet};
use conditions::Condition;
use interval::Prover;
use num_traits::Zero;
use thiserror::Error;

/// Boxes that one cover may have.
const MAX_BOXES: usize = 20_000;

/// Why no certificate can be written.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum CertificationError {
    /// The limit itself is not decided.
    #[error("the limit is not decided near {0}: there is nothing to certify")]
    Undecided(String),
    /// The claim holds, but the permitted number of boxes does not show it.
    #[error("the certificate would need more than {MAX_BOXES} boxes")]
    TooLarge,
    /// No growing wave was found just above the limit.
    #[error("no growing wave was found just above the limit")]
    NoWitness,
    /// The conditions are of a kind for which there is no certificate yet.
    #[error("no certificate is written where {0}")]
    NotWritten(&'static str),
    /// The checker does not understand the text.
    #[error("the checker refuses the scheme: {0}")]
    Text(#[from] CertificateError),
    /// The scheme itself is refused.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
}

/// The certificates of all stable intervals of a parameter within a plan.
///
/// ```
/// use courant_analysis::certificate::{Subject, certify, verify};
/// use courant_analysis::scheme::Step;
/// use courant_analysis::stability::SearchPlan;
/// let text = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])";
/// let step = Step::from_text(text)?;
/// let subject = Subject::new(text, None, None, &step, "C").unwrap();
/// let certificates = certify(&subject, &step, &SearchPlan::default())?;
/// let statement = verify(&certificates[0])?.statement;
/// assert!(statement.ends_with("|z| <= 1 + 0 for all waves up to C = 1 and not just above"), "{statement}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When a limit is not decided, or when a certificate would be too large.
pub fn certify(
    subject: &Subject,
    step: &Step,
    plan: &SearchPlan,
) -> Result<Vec<Certificate>, CertificationError> {
    certify_stability(subject, &step.stable_set(&subject.parameter, plan)?, plan)
}

/// [`certify`] for a stable set that is known: one certificate for each of its intervals, and one that says that no small value is
/// stable where none is.
///
/// # Errors
/// As [`certify`].
pub fn certify_stability(
    subject: &Subject,
    set: &StableSet,
    plan: &SearchPlan,
) -> Result<Vec<Certificate>, CertificationError> {
    written(subject, set, plan).or_else(|error| {
        // What ends because nobody waits for it fails for no other reason.
        plan.goes_on()?;
        Err(error)
    })
}

fn written(
    subject: &Subject,
    set: &StableSet,
    plan: &SearchPlan,
) -> Result<Vec<Certificate>, CertificationError> {
    let chi = Characteristic::new(subject, true)?;
    let levels = levels::levels(&chi, subject, &plan.growth)?;
    let derived = chi.conditions(subject, &plan.growth, &levels)?;
    if chi.dimension > 1 {
        decided(set)?;
        let base = base(subject, Question::Stability, &plan.growth, &[]);
        let base = Certificate { levels, ..base };
        return torus::certificates(&base, &derived, &chi, set, plan);
    }
    let condition = |one| Condition::new(one, &chi.letters, subject);
    let conditions = derived.iter().map(condition).collect::<Result<Vec<_>, _>>()?;
    let wanted = |one: Condition| one.while_wanted(&plan.interest);
    let conditions: Vec<_> = conditions.into_iter().map(wanted).collect();
    let base = base(subject, Question::Stability, &plan.growth, &conditions);
    certificates(Certificate { levels, ..base }, &conditions, set, &plan.max)
}

/// The certificates of the intervals in which no coefficient of an explicit one-step scheme is negative.
///
/// # Errors
/// As [`certify`].
pub fn certify_monotonicity(
    subject: &Subject,
    set: &StableSet,
    max: &Rational,
) -> Result<Vec<Certificate>, CertificationError> {
    let chi = Characteristic::new(subject, false)?;
    let derived = chi.monotonicity()?;
    let conditions = derived.iter().map(|one| Condition::new(one, &chi.letters, subject));
    let conditions = conditions.collect::<Result<Vec<_>, _>>()?;
    let base = base(subject, Question::Monotonicity, &Rational::zero(), &conditions);
    certificates(base, &conditions, set, max)
}

/// A certificate without an interval.
fn base(
    subject: &Subject,
    question: Question,
    growth: &Rational,
    conditions: &[Condition],
) -> Certificate {
    let exact = conditions.iter().all(|condition| condition.margin.is_exact());
    Certificate {
        subject: subject.clone(),
        question,
        growth: growth.clone().into(),
        evidence: if exact { "proved" } else { "enclosed" }.into(),
        levels: Vec::new(),
        interval: ends::zero(),
        proof: Proof::Line(LineProof {
            inequalities: Vec::new(),
            below: None,
            covers: Vec::new(),
            above: None,
        }),
    }
}

fn decided(set: &StableSet) -> Result<(), CertificationError> {
    match set.undecided.first() {
        Some((from, to)) => Err(CertificationError::Undecided(format!("{from} … {to}"))),
        None => Ok(()),
    }
}

fn certificates(
    base: Certificate,
    conditions: &[Condition],
    set: &StableSet,
    max: &Rational,
) -> Result<Vec<Certificate>, CertificationError> {
    decided(set)?;
    let prover = Prover::new(conditions, max);
    let mut all = Vec::new();
    if set.intervals.first().is_none_or(|first| first.from.upper() > 0.0) {
        all.push(prover.no_limit(&base, &set.limit())?);
    }
    for interval in &set.intervals {
        all.push(prover.interval(&base, interval)?);
    }
    Ok(all)
}
