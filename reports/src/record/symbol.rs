//! What `symbol` says of one scheme.

use super::SubjectRecord;
use serde::Serialize;

/// One coefficient of a scheme: a polynomial in its parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoefficientRecord {
    /// The neighbour's offset.
    pub offset: i64,
    /// `[c0, c1, …]` in powers of the parameter: exact fractions, or decimals where the data are not rational.
    pub polynomial: Vec<String>,
}

/// Orders of accuracy; `null` where there is none, with the reasons in [`SymbolRecord::order_reasons`].
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct OrderRecord {
    /// In space, as the step goes to zero on a given lattice.
    pub space: Option<u32>,
    /// In time, as the spacing goes to zero at a given step.
    pub time: Option<u32>,
    /// At a fixed parameter; 0 when long waves have a wrong speed, `null` when not even constants are kept.
    pub overall: Option<u32>,
}

/// One term of the modified equation `Δt ∂u/∂t = Σ c_m (Δx ∂/∂x)^m u`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ModifiedTermRecord {
    /// How often it is differentiated; in several dimensions along each axis.
    pub derivative: DerivativeRecord,
    /// The factor, exact.
    pub coefficient: String,
}

/// `m`, or `[m_x, m_y, …]`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum DerivativeRecord {
    /// In one dimension.
    Line(u32),
    /// In several.
    Axes(Vec<u32>),
}

/// A value of the parameter at which the leading error vanishes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpecialValueRecord {
    /// The value.
    pub value: f64,
    /// The value, where it is a fraction.
    pub exact: Option<String>,
    /// The overall order there; `null` where the scheme is exact, or the value is no fraction.
    pub order: Option<u32>,
}

/// The answer of `symbol`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SymbolRecord {
    /// What was looked at.
    #[serde(flatten)]
    pub subject: SubjectRecord,
    /// Its equations.
    pub equations: String,
    /// The stencil, of an explicit scheme for one unknown between two levels.
    pub coefficients: Option<Vec<CoefficientRecord>>,
    /// Whether its coefficients are exact.
    pub exact: Option<bool>,
    /// The amplification factor as plain text, or the characteristic polynomial.
    pub text: String,
    /// The same as LaTeX.
    pub latex: String,
    /// `χ(z) = 0` as LaTeX, with `E = e^{iφ}`.
    pub characteristic: String,
    /// The same as plain text.
    pub characteristic_text: String,
    /// The degree of `χ` in `z`.
    pub degree: usize,
    /// The unknowns.
    pub unknowns: Vec<String>,
    /// `P` of `P U = 0`, by rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix: Option<Vec<Vec<String>>>,
    /// Whether what is the same everywhere stays so.
    pub keeps_constants: bool,
    /// Orders of accuracy, where they are known.
    pub order: Option<OrderRecord>,
    /// Why orders are missing, and what they stand for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub order_reasons: Vec<String>,
    /// The exact step that it is compared with, as files state it; `null` for its own leading term.
    pub compared_with: Option<String>,
    /// The first terms of the modified equation.
    pub modified_equation: Option<Vec<ModifiedTermRecord>>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modified_equation_reason: Option<String>,
    /// The first term of the error that changes amplitudes.
    pub dissipation: Option<ModifiedTermRecord>,
    /// The first term of the error that changes speeds.
    pub dispersion: Option<ModifiedTermRecord>,
    /// Positive values of the parameter at which the leading error vanishes.
    pub special_values: Vec<SpecialValueRecord>,
    /// Speed of long waves over the true speed.
    pub long_wave_speed: Option<f64>,
}
