//! Coefficients that are not negative below the limit, and the one that is above it.

use super::super::{
    BindingCoefficient, Certificate, CertifiedBox, CertifiedCoefficient, MonotonicityProof, Proof,
};
use super::limit_ends::{above, certified_limit, ends};
use super::statement::certificate;
use super::{CertificationError, MAX_BOXES};
use crate::exact::bernstein::is_negative_between;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer};
use crate::scheme::symbol::EnclosedSymbol;
use crate::stability::{enclosed_coefficients, monotonicity_limit};
use num_traits::{One, Signed, Zero};

/// The certificate of the monotonicity limit within `[0, max_courant]`.
///
/// # Errors
/// When the limit is not decided, or when the certificate would be too large.
pub fn certify_monotonicity(
    symbol: &EnclosedSymbol,
    subject: Option<&crate::scheme::Discretisation>,
    max_courant: &Rational,
) -> Result<Certificate, CertificationError> {
    let limit = monotonicity_limit(symbol, max_courant);
    let (lower, upper) = ends(&limit, 1, max_courant);
    let coefficients = enclosed_coefficients(symbol);
    let mut proof = MonotonicityProof {
        limit: certified_limit(&limit, lower.clone(), upper.clone()),
        coefficients: Vec::new(),
        binding: None,
    };
    if lower.is_positive() {
        for (offset, center, radius) in &coefficients {
            let lowered = center.clone() - radius.clone();
            let boxes = non_negative_cover(&lowered, &lower).ok_or(CertificationError::TooLarge)?;
            proof.coefficients.push(CertifiedCoefficient { offset: *offset, boxes });
        }
    }
    if let (Some(offset), Some(upper)) = (limit.binding_offset(), &upper) {
        let binding = coefficients.iter().find(|(candidate, ..)| *candidate == offset);
        let (_, center, radius) = binding.ok_or(CertificationError::NoWitness)?;
        let raised = center.clone() + radius.clone();
        let mut beyond = above(upper, max_courant);
        let to = beyond
            .find(|to| is_negative_between(raised.coefficients(), upper, to) == Some(true))
            .ok_or(CertificationError::NoWitness)?;
        proof.binding = Some(BindingCoefficient { offset, to: to.into() });
    }
    Ok(certificate(symbol, subject, Proof::Monotonicity(Box::new(proof))))
}

/// A cover of `[0, end]` on which the polynomial has no negative Bernstein coefficient.
fn non_negative_cover(
    polynomial: &Polynomial<Rational>,
    end: &Rational,
) -> Option<Vec<CertifiedBox>> {
    let mut cover = Vec::new();
    let mut pending = vec![(Rational::zero(), end.clone())];
    while let Some((from, to)) = pending.pop() {
        let values = bernstein(polynomial, &from, &to);
        if values.iter().all(|value| !value.is_negative()) {
            let signs = values.iter().map(|v| if v.is_zero() { '0' } else { '+' }).collect();
            cover.push(CertifiedBox { from: from.into(), to: to.into(), signs: vec![signs] });
            continue;
        }
        if cover.len() + pending.len() >= MAX_BOXES {
            return None;
        }
        let middle = (&from + &to) / integer(2);
        pending.push((middle.clone(), to));
        pending.push((from, middle));
    }
    Some(cover)
}

/// Bernstein coefficients on `[from, to]` as blossoms: the symmetric multi-affine form of the
/// polynomial at `n − k` times `from` and `k` times `to`.
fn bernstein(polynomial: &Polynomial<Rational>, from: &Rational, to: &Rational) -> Vec<Rational> {
    let degree = polynomial.degree().unwrap_or(0);
    let choices = binomial_row(degree);
    (0..=degree)
        .map(|k| {
            let arguments = std::iter::repeat_n(from, degree - k).chain(std::iter::repeat_n(to, k));
            let symmetric = arguments.fold(vec![Rational::one()], |mut sums, value| {
                sums.push(Rational::zero());
                for index in (1..sums.len()).rev() {
                    let product = &sums[index - 1] * value;
                    sums[index] += product;
                }
                sums
            });
            (0..=degree).map(|j| polynomial.coefficient(j) * &symmetric[j] / &choices[j]).sum()
        })
        .collect()
}

fn binomial_row(degree: usize) -> Vec<Rational> {
    let mut row = vec![Rational::one()];
    for index in 0..degree {
        let next = &row[index] * integer((degree - index) as i64) / integer(index as i64 + 1);
        row.push(next);
    }
    row
}
