//! Certificates: a limit together with everything needed to check it without trusting this program.
//!
//! A certificate states the scheme as it was typed, the polynomials that must not be negative, for each a cover of all waves by
//! boxes above which no Bernstein coefficient is negative, and a wave that grows just above the limit.
//! [`verify`] derives the polynomials again from the text, with a parser and an algebra of its own, and recomputes every sign;
//! `docs/verify_certificate.py` and `docs/verify_coefficients.py` do the same in another language.

mod derive;
mod number;
mod prove;
mod statement;
mod torus;
mod verify;

pub use number::{End, Exact};
pub use prove::{CertificationError, certify, certify_monotonicity, certify_stability};
pub use statement::{IntegratorStatement, KernelStatement, Subject};
pub use torus::{
    CosineTerm, TorusCell, TorusInequality, TorusPiece, TorusPoint, TorusProof, TorusWave,
};
pub use verify::{CertificateError, Verified, verify};

use serde::{Deserialize, Deserializer, Serialize};

/// An interval in which a property holds, and its proof.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// The scheme.
    pub subject: Subject,
    /// What is claimed of it.
    pub question: Question,
    /// The permitted growth per step.
    pub growth: Exact,
    /// `proved` when all polynomials are exact, `enclosed` when one has a radius.
    pub evidence: String,
    /// How the conditions are derived; none for monotonicity.
    pub levels: Vec<Level>,
    /// Where it is claimed.
    pub interval: Interval,
    /// Why.
    pub proof: Proof,
}

/// Why the property holds in the interval and not beyond.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Proof {
    /// Functions of one phase, or of none.
    Line(LineProof),
    /// Functions of several phases.
    Torus(TorusProof),
}

/// A proof about functions of one phase.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineProof {
    /// What must not be negative.
    pub inequalities: Vec<StatedInequality>,
    /// A wave that grows just below the interval; `None` when it begins at 0.
    #[serde(deserialize_with = "stated")]
    pub below: Option<GrowingWave>,
    /// For each inequality why it holds in the interval; empty when the limit is 0.
    pub covers: Vec<Cover>,
    /// Why the property is lost; `None` when the interval reaches the end of the range looked at.
    #[serde(deserialize_with = "stated")]
    pub above: Option<LossClaim>,
}

/// An entry that must be there even when it is null.
fn stated<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    source: D,
) -> Result<Option<T>, D::Error> {
    Option::deserialize(source)
}

/// What is claimed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Question {
    /// All multipliers have `|z| ≤ 1 + growth`.
    Stability,
    /// No coefficient of the explicit one-step scheme is negative.
    Monotonicity,
}

/// One polynomial in `z` whose roots are asked about: `χ` first, then the derivative of each part with its roots on the circle.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Level {
    /// The conditions that are used.
    pub rule: Rule,
    /// The factors; `None` where the whole polynomial is self-inversive or none of it is to be split off.
    #[serde(deserialize_with = "stated")]
    pub split: Option<Split>,
}

/// The conditions for all roots to lie in the closed disc.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// `χ(±1)` and the inner determinants, for coefficients that are real on every wave.
    Jury,
    /// The leading minors of the Schur–Cohn matrix.
    SchurCohn,
}

/// A polynomial as a product, up to a factor without `z`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Split {
    /// `h`, a polynomial in `z`, `E` and the parameter.
    pub inside: String,
    /// `f`, self-inversive: its roots lie on the circle or in pairs `z, 1/z̄`.
    pub circle: String,
}

/// A condition: the polynomial derived is `Q(s, C)² W(s)` times the margin, and `W` is not negative.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StatedInequality {
    /// The number of its level.
    pub level: usize,
    /// Which of its conditions: `plus-one`, `minus-one`, `inner-2+`, `minor-1`; `coefficient -3` for monotonicity.
    pub condition: String,
    /// `Q`: for each power of `C` the powers of `s`.
    pub square: Vec<Vec<Exact>>,
    /// `W` in powers of `s`.
    pub weight: Vec<Exact>,
    /// The polynomial that decides, with its factors.
    pub margin: FactoredMargin,
}

/// `s^phase_power (1 − s)^complement_power H(s)² C^courant_power Σ_j t^j p_j(s)` with `s = (1 − cos φ)/2` and `t = C^stride`.
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

/// The interval of the parameter: nothing is claimed strictly between `lower` and `upper`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Interval {
    /// Where it begins.
    pub begin: End,
    /// The property holds up to here.
    pub lower: End,
    /// It is lost above here; `None` when nothing is claimed beyond `lower`, or there is nothing beyond.
    #[serde(deserialize_with = "stated")]
    pub upper: Option<End>,
}

/// Why one inequality holds throughout the interval.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cover {
    /// Where the first piece begins, in `t`.
    pub begin: Exact,
    /// The interval of `t` piece by piece, each from the end of the one before.
    pub pieces: Vec<Piece>,
}

/// A piece of an interval of `t`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Piece {
    /// Where it ends, in `t`; `inf` for all that is beyond.
    pub end: End,
    /// The ends of the boxes that cover `0 ≤ s ≤ 1`: above none is a Bernstein coefficient negative.
    pub waves: Vec<Exact>,
}

/// A wave that grows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GrowingWave {
    /// The number of the inequality that it violates.
    pub inequality: usize,
    /// `0 < s ≤ 1`.
    pub s: Exact,
    /// The value of the parameter.
    pub value: Exact,
}

/// Why the property is lost at the limit.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LossClaim {
    /// At this `s` the polynomial is negative above `upper`, as far as the value of the wave below: its Bernstein coefficients in `t` are at
    /// most zero and not all zero.
    pub s: Exact,
    /// A wave that grows just above the limit: one point to check by hand.
    pub wave: GrowingWave,
}

#[cfg(test)]
mod tests;
