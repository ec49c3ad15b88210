//! Certificates: a limit together with everything needed to check it without trusting this program.
//!
//! A certificate states the scheme, the polynomial that decides, a cover of all waves by intervals with
//! the signs of the Bernstein coefficients above each, and a wave that grows just above the limit.
//! [`verify`] recomputes all of it from the names alone, by plain means and with code of its own;
//! `docs/verify_certificate.py` and `docs/verify_coefficients.py` do the same in another language.

mod number;
mod prove;
mod verify;

pub use number::Exact;
pub use prove::{CertificationError, certify_monotonicity, certify_stability};
pub use verify::{CertificateError, Verified, verify};

use serde::{Deserialize, Deserializer, Serialize};

/// A limit and its proof.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// The scheme by name; `None` for one that is given by its coefficients alone.
    #[serde(deserialize_with = "stated")]
    pub subject: Option<Subject>,
    /// `proved` when the coefficients are exact, `enclosed` when they have radii.
    pub evidence: String,
    /// The coefficients of the scheme.
    pub symbol: CertifiedSymbol,
    /// What is claimed of it, and why it holds.
    pub proof: Proof,
}

/// An entry that must be there even when it is null.
fn stated<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    source: D,
) -> Result<Option<T>, D::Error> {
    Option::deserialize(source)
}

/// A scheme of the catalogue: a checker derives its coefficients from these three names.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// Such as `godunov-sph`.
    pub scheme: String,
    /// Such as `cubic-spline`.
    pub kernel: String,
    /// The smoothing ratio `l/Δξ`.
    pub ratio: Exact,
}

/// `g(φ) = Σ_j C^j Σ_k c_{j,k} e^{ikφ}`, and how far the true coefficients may be from these.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertifiedSymbol {
    /// One stencil for each power of `C`.
    pub stencils: Vec<CertifiedStencil>,
    /// For each power of `C` a bound on `Σ_k |error of (c_k + c_{−k})/2|`.
    pub even_radius: Vec<Exact>,
    /// For each power of `C` a bound on `Σ_k |error of (c_k − c_{−k})/2|`.
    pub odd_radius: Vec<Exact>,
    /// Whether `g(0) = 1` at every Courant number, for the true coefficients.
    pub keeps_constants: bool,
}

/// The coefficients of one power of `C`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertifiedStencil {
    /// The offset of the first coefficient.
    pub lowest: i64,
    /// The coefficients from there on.
    pub coefficients: Vec<Exact>,
    /// How far each may be from the true one.
    pub radius: Vec<Exact>,
}

/// What is claimed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "question", rename_all = "kebab-case")]
pub enum Proof {
    /// `|g| ≤ 1 + growth`.
    Stability(Box<StabilityProof>),
    /// Every coefficient is at least zero.
    Monotonicity(Box<MonotonicityProof>),
}

/// `|g| ≤ 1 + growth` for all waves while `from ≤ t ≤ limit.lower`, and not just above `limit.upper`;
/// here and below `t = C^stride`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StabilityProof {
    /// The permitted growth per step.
    pub growth: Exact,
    /// The polynomial that decides.
    pub margin: FactoredMargin,
    /// Where the stable interval begins, in `t`.
    pub from: Exact,
    /// A growing wave just below the beginning; `None` when the interval begins at 0.
    #[serde(deserialize_with = "stated")]
    pub below: Option<GrowingWave>,
    /// Where it ends.
    pub limit: CertifiedLimit,
    /// The interval of `t` piece by piece; empty when the limit is 0.
    pub pieces: Vec<CertifiedPiece>,
    /// Why stability is lost; `None` when the interval reaches the end of the range looked at.
    #[serde(deserialize_with = "stated")]
    pub unstable: Option<UnstableClaim>,
}

/// `(1 + growth)² − |g|² = s^phase_power (1 − s)^complement_power H(s)² C^courant_power Σ_j t^j p_j(s)`
/// with `s = (1 − cos φ)/2`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FactoredMargin {
    /// The power of `s`.
    pub phase_power: usize,
    /// The power of `1 − s`.
    pub complement_power: usize,
    /// `H` in powers of `s`.
    pub neutral_waves: Vec<Exact>,
    /// The power of `C`.
    pub courant_power: usize,
    /// `t = C^stride`.
    pub stride: usize,
    /// Divides all coefficients and radii.
    pub denominator: Exact,
    /// `p_j` in powers of `s`, times the denominator: whole numbers.
    pub coefficients: Vec<Vec<Exact>>,
    /// How far each `p_j` may be from the true function, times the denominator.
    pub radius: Vec<Exact>,
}

/// The end of the interval in `t`: nothing is claimed strictly between the two numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertifiedLimit {
    /// Holds up to here.
    pub lower: Exact,
    /// Lost above here; `None` when the range looked at ends at `lower`.
    #[serde(deserialize_with = "stated")]
    pub upper: Option<Exact>,
    /// The limit on `C` in closed form when the two agree, such as `15/8` or `sqrt(8/3)`.
    #[serde(deserialize_with = "stated")]
    pub courant_number: Option<String>,
}

/// A piece of the stable interval: it begins where the one before it ends.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertifiedPiece {
    /// Where it ends, in `t`; the last one at `limit.lower`.
    pub to: Exact,
    /// A cover of `0 ≤ s ≤ 1` without a negative Bernstein coefficient.
    pub boxes: Vec<CertifiedBox>,
}

/// An interval of `s` (or of `C`, for monotonicity) with the signs of the Bernstein coefficients above it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertifiedBox {
    /// Where it begins.
    pub from: Exact,
    /// Where it ends.
    pub to: Exact,
    /// For each Bernstein index in `t` a string with `+` or `0` for each index in `s`; for monotonicity
    /// a single string.
    pub signs: Vec<String>,
}

/// A wave that grows at one Courant number.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GrowingWave {
    /// `0 < s ≤ 1`.
    pub s: Exact,
    /// The Courant number.
    pub courant_number: Exact,
}

/// Why stability is lost at the limit.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnstableClaim {
    /// At this `s` the polynomial is negative for `limit.upper < t < witness.courant_number^stride`: its
    /// Bernstein coefficients in `t` are at most zero and not all zero.
    pub s: Exact,
    /// A wave that grows just above the limit: one point to check by hand.
    pub witness: GrowingWave,
}

/// Every coefficient is at least zero while `0 ≤ C ≤ limit.lower`, and one is not just above
/// `limit.upper`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MonotonicityProof {
    /// The end of the interval, in `C`.
    pub limit: CertifiedLimit,
    /// Every offset whose coefficient is not identically zero; empty when the limit is 0.
    pub coefficients: Vec<CertifiedCoefficient>,
    /// The coefficient that turns negative.
    #[serde(deserialize_with = "stated")]
    pub binding: Option<BindingCoefficient>,
}

/// Why one coefficient is not negative.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertifiedCoefficient {
    /// The offset `k` of `c_k`.
    pub offset: i64,
    /// A cover of `0 ≤ C ≤ limit.lower` without a negative Bernstein coefficient.
    pub boxes: Vec<CertifiedBox>,
}

/// The coefficient that turns negative at the limit: the one of lowest offset, if there are several.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BindingCoefficient {
    /// Its offset.
    pub offset: i64,
    /// It is negative for `limit.upper < C < to`.
    pub to: Exact,
}

#[cfg(test)]
mod tests;
