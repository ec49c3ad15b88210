//! Results as the JSON objects that scripts rely on. The keys are a contract: add, do not rename.

use serde::Serialize;
use std::collections::BTreeMap;

mod check;
mod limit;
mod probe;
mod symbol;
mod wave;

pub use check::*;
pub use limit::*;
pub use probe::*;
pub use symbol::*;
pub use wave::*;

/// What was judged, by its names.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SubjectRecord {
    /// The scheme's name, or its equations as they were typed.
    pub scheme: String,
    /// The same for a particle method.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// Which relation of Godunov particle hydrodynamics.
    pub form: Option<&'static str>,
    /// The same for a space that an integrator completes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub space: Option<String>,
    /// The time integrator.
    pub integrator: Option<String>,
    /// The coefficient of viscosity.
    pub alpha: Option<f64>,
    /// The kernel's name.
    pub kernel: Option<&'static str>,
    /// The smoothing ratio, exactly.
    pub ratio: Option<String>,
    /// The equation of state of a particle method.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub eos: Option<String>,
    /// Where its density comes from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<&'static str>,
    /// How its particles lie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lattice: Option<&'static str>,
    /// The number of space dimensions.
    pub dimension: usize,
    /// The parameter in question.
    pub parameter: Option<String>,
    /// The values of the others, exactly.
    pub parameters: BTreeMap<String, String>,
}
