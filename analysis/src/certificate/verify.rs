//! The checker: recomputes a certificate from its names by the plainest means.
//!
//! It shares nothing with the search but fractions of big integers: kernels are sums of truncated
//! powers, `|g|²` is multiplied out term by term in powers of `s`, and Bernstein coefficients come from
//! substituting the interval. Slow and short is the point.

mod arithmetic;
mod margin;
mod monotonicity;
mod stability;
mod subject;

use super::{Certificate, CertifiedLimit, CertifiedSymbol, Exact, Proof};
use crate::exact::rational::{Rational, integer};
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

fn ensure(holds: bool, otherwise: &str) -> Result<(), CertificateError> {
    if holds { Ok(()) } else { Err(CertificateError(otherwise.into())) }
}

/// Checks a certificate.
///
/// # Errors
/// Names the first part that does not hold.
pub fn verify(certificate: &Certificate) -> Result<Verified, CertificateError> {
    let symbol = &certificate.symbol;
    check_symbol(symbol)?;
    let exact = is_exact(symbol);
    let word = if exact { "proved" } else { "enclosed" };
    ensure(certificate.evidence == word, "the evidence is not the one the radii give")?;
    let mut name = String::from("the scheme with the given coefficients");
    if let Some(subject) = &certificate.subject {
        subject::check(subject, symbol)?;
        name = format!(
            "{} with {} at ratio {}",
            subject.scheme,
            subject.kernel,
            text(&subject.ratio.0)
        );
    }
    let (property, boxes, limit, stride) = match &certificate.proof {
        Proof::Stability(proof) => {
            let boxes = stability::check_stability(symbol, proof)?;
            let property = format!("|g| <= 1 + {} for all waves", text(&proof.growth.0));
            (property, boxes, &proof.limit, proof.margin.stride)
        }
        Proof::Monotonicity(proof) => {
            let boxes = monotonicity::check_monotonicity(symbol, proof)?;
            ("no coefficient is negative".to_owned(), boxes, &proof.limit, 1)
        }
    };
    let variable = if stride == 1 { "C".to_owned() } else { format!("C^{stride}") };
    let begin = match &certificate.proof {
        Proof::Stability(proof) if !proof.from.0.is_zero() => {
            format!("from {variable} = {} ", text(&proof.from.0))
        }
        _ => String::new(),
    };
    let end = match (&limit.courant_number, &limit.upper) {
        (Some(exact), _) => format!("up to C = {exact} and not just above"),
        (None, Some(upper)) => {
            format!("up to {variable} = {} and not above {}", text(&limit.lower.0), text(&upper.0))
        }
        (None, None) => format!("at least up to {variable} = {}", text(&limit.lower.0)),
    };
    Ok(Verified { statement: format!("{name}: {property} {begin}{end}"), boxes })
}

fn text(value: &Rational) -> String {
    value.to_string()
}

fn values(list: &[Exact]) -> Vec<Rational> {
    list.iter().map(|value| value.0.clone()).collect()
}

fn is_exact(symbol: &CertifiedSymbol) -> bool {
    let radii = symbol.stencils.iter().flat_map(|stencil| &stencil.radius);
    radii.chain(&symbol.even_radius).chain(&symbol.odd_radius).all(|radius| radius.0.is_zero())
}

fn coefficient(list: &[Exact], lowest: i64, offset: i64) -> Rational {
    let index = usize::try_from(offset - lowest).ok();
    index.and_then(|index| list.get(index)).map_or_else(Rational::zero, |value| value.0.clone())
}

/// Shapes, signs of radii, and that the three kinds of radii agree with each other.
fn check_symbol(symbol: &CertifiedSymbol) -> Result<(), CertificateError> {
    let powers = symbol.stencils.len();
    ensure((1..=64).contains(&powers), "a symbol has a stencil for each power of C")?;
    ensure(
        symbol.even_radius.len() == powers && symbol.odd_radius.len() == powers,
        "a symbol has two radii for each power of C",
    )?;
    for (power, stencil) in symbol.stencils.iter().enumerate() {
        ensure(
            stencil.coefficients.len() == stencil.radius.len()
                && stencil.radius.len() <= 1000
                && stencil.lowest.abs() <= 1000,
            "a stencil has a radius for each coefficient",
        )?;
        let (even, odd) = (&symbol.even_radius[power].0, &symbol.odd_radius[power].0);
        let total: Rational = stencil.radius.iter().map(|radius| &radius.0).sum();
        let consistent =
            stencil.radius.iter().all(|radius| !radius.0.is_negative() && radius.0 <= even + odd)
                && !even.is_negative()
                && !odd.is_negative()
                && *even <= total
                && *odd <= total;
        ensure(consistent, "the radii of a stencil contradict each other")?;
    }
    let mut moments = symbol.stencils.iter().enumerate().map(|(power, stencil)| {
        let sum: Rational = stencil.coefficients.iter().map(|value| &value.0).sum();
        sum == integer(i64::from(power == 0))
    });
    let center_keeps_constants = moments.all(|one| one);
    ensure(
        center_keeps_constants || !symbol.keeps_constants,
        "the coefficients do not keep a constant",
    )?;
    ensure(
        symbol.keeps_constants == center_keeps_constants || !is_exact(symbol),
        "the coefficients do keep a constant",
    )
}

/// The end is stated consistently, and tightly.
fn check_limit(limit: &CertifiedLimit, stride: usize) -> Result<(), CertificateError> {
    let lower = &limit.lower.0;
    ensure(!lower.is_negative(), "the limit is negative")?;
    let Some(upper) = limit.upper.as_ref().map(|upper| &upper.0) else {
        return ensure(limit.courant_number.is_none(), "there is no limit to write down");
    };
    ensure(
        lower <= upper && upper - lower <= lower * nearness(20),
        "the ends of the limit are far apart",
    )?;
    if lower < upper {
        return ensure(limit.courant_number.is_none(), "an enclosed limit has no closed form");
    }
    let fraction = (stride == 1).then(|| lower.clone()).or_else(|| square_root(lower));
    let expected =
        fraction.map_or_else(|| format!("sqrt({})", text(lower)), |fraction| text(&fraction));
    ensure(
        limit.courant_number.as_deref() == Some(expected.as_str()),
        "the closed form is not that of the limit",
    )
}

fn square_root(square: &Rational) -> Option<Rational> {
    let root = Rational::new(square.numer().sqrt(), square.denom().sqrt());
    (&root * &root == *square).then_some(root)
}

fn nearness(bits: u32) -> Rational {
    Rational::new(BigInt::one(), BigInt::one() << bits)
}
