//! Waves and offsets: a number in one dimension, a list in more.

use courant_analysis::stability::Wave;
use serde::Serialize;

/// The phases of a wave: a number in one dimension, a list in more.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Phases {
    /// Along a line.
    One(f64),
    /// Along each axis.
    Each(Vec<f64>),
}

impl Phases {
    /// Of a wave.
    pub fn of(wave: &Wave) -> Self {
        match wave.phases() {
            [phase] => Self::One(*phase),
            phases => Self::Each(phases.to_vec()),
        }
    }
}

impl std::fmt::Display for Phases {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::One(phase) => write!(formatter, "{phase}"),
            Self::Each(phases) => {
                let texts: Vec<String> = phases.iter().map(ToString::to_string).collect();
                write!(formatter, "{}", texts.join(";"))
            }
        }
    }
}

/// The unit vector along which a wave of several dimensions varies; `None` in one dimension, or for a constant.
pub fn direction_of(wave: &Wave) -> Option<Vec<f64>> {
    let direction = wave.direction();
    let is_one = direction.len() > 1 && direction.iter().any(|x| *x != 0.0);
    is_one.then(|| direction.to_vec())
}

/// The offset of a coefficient: a number in one dimension, a list in more.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum Offset {
    /// Along a line.
    One(i64),
    /// Along each axis.
    Each(Vec<i64>),
}

impl Offset {
    pub(super) fn of(offset: &[i64]) -> Self {
        match offset {
            [offset] => Self::One(*offset),
            offsets => Self::Each(offsets.to_vec()),
        }
    }
}
