//! What a proof in two and three dimensions states: conditions as cosine series, cubes of waves, and how each is cut.
//!
//! A **cube** of waves has a letter for each axis: `h`, a half turn by `x = sin²(φ/2)`, where the condition is even in this phase alone, or
//! `0` to `3`, the quarter turn `φ = qπ/2 + θ` by `x = tan(θ/2)`; `x` runs from 0 to 1.
//!
//! **Cuts** say what is done about one cube after the other, in the order in which they come up: those that take the place of a cube wait
//! behind all that are waiting. The axes are `x`, `y`, `z`:
//!
//! - `.`: no Bernstein coefficient is negative;
//! - `x`: two halves take its place, the lower one first;
//! - `{xy}`: the charts of these axes do, one for each axis as the leader: the other axes of the set become multiples of the leader, of
//!   which the largest power is divided out. `~x` before it puts `1 − x` for `x`.

use super::{End, Exact};
use serde::{Deserialize, Serialize};

/// A proof about functions of several phases.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TorusProof {
    /// `t = C^stride`.
    pub stride: usize,
    /// What must not be negative, and why it is not.
    pub inequalities: Vec<TorusInequality>,
    /// A wave that grows just below the interval; `None` when it begins at 0.
    #[serde(deserialize_with = "super::stated")]
    pub below: Option<TorusWave>,
    /// A wave that grows just above it; `None` when the interval reaches the end of the range looked at.
    #[serde(deserialize_with = "super::stated")]
    pub above: Option<TorusWave>,
}

/// A condition: the polynomial derived is `|Q|²` times the margin.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TorusInequality {
    /// The number of its level.
    pub level: usize,
    /// Which of its conditions.
    pub condition: String,
    /// `Q`, a polynomial in `E_1, E_2, E_3` and the parameter.
    pub square: String,
    /// The margin, `Σ value C^power cos(k·φ)`.
    pub margin: Vec<CosineTerm>,
    /// The cubes that cover all waves up to symmetries of the margin; empty when the limit is 0.
    pub cells: Vec<TorusCell>,
}

/// `value C^power cos(k·φ)`, the first multiple that is not zero positive.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CosineTerm {
    /// The power of the parameter.
    pub power: usize,
    /// Multiples of the phases.
    pub k: Vec<i32>,
    /// The coefficient.
    pub value: Exact,
}

/// A cube of waves and why the condition holds on it throughout the interval.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TorusCell {
    /// A letter for each axis.
    pub cube: String,
    /// Where the first piece begins, in `t`.
    pub begin: Exact,
    /// The interval of `t` piece by piece.
    pub pieces: Vec<TorusPiece>,
}

/// A piece of an interval of `t`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TorusPiece {
    /// Where it ends, in `t`; `inf` for all that is beyond.
    pub end: End,
    /// For each Bernstein coefficient in `t`, a polynomial on the cube, the cuts that show that it is nowhere negative.
    pub cuts: Vec<String>,
}

/// A wave at which a condition fails: a point of a cube, or the limit of such points in charts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TorusPoint {
    /// The number of the inequality that fails.
    pub inequality: usize,
    /// A letter for each axis.
    pub cube: String,
    /// The way to a chart: `~x` for `1 − x`, `{xy}x` for the chart whose leader is `x`, `x<` and `x>` for the halves along `x`.
    pub way: String,
    /// The coordinates in it.
    pub point: Vec<Exact>,
}

/// A wave that grows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TorusWave {
    /// Which one.
    pub wave: TorusPoint,
    /// A value of the parameter just beyond the end: between the two no Bernstein coefficient in `t` of the margin at the wave, the
    /// powers of the leaders divided out, is positive, and one is negative.
    pub value: Exact,
}
