//! Results as the JSON objects that scripts rely on. The keys are a contract: add, do not rename.

use crate::number::{finite, significant};
use courant_analysis::exact::rational::to_latex;
use courant_analysis::stability::{Evidence, Limit, StableSet, Wave};
use serde::Serialize;
use std::collections::BTreeMap;

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

/// A limit. A number that is not finite is `null`, and `reason` says why.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitRecord {
    /// The largest number known not to be above the limit.
    pub value: Option<f64>,
    /// The property holds from 0 up to here.
    pub lower: f64,
    /// The property is lost above here.
    pub upper: Option<f64>,
    /// A fraction or a root of one, as text.
    pub exact: Option<String>,
    /// The first digits, cut off, when more than a number of JSON holds were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decimal: Option<String>,
    /// The polynomial of which it is a root, when it has no closed form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equation: Option<EquationRecord>,
    /// `proved`, `enclosed`, `sampled`, `measured` or `undecided`.
    pub evidence: &'static str,
    /// How many phases a sampled limit looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phases: Option<usize>,
    /// The phase that binds, in radians; a list in two and three dimensions.
    pub critical_phase: Option<Phases>,
    /// The direction along which the wave that binds varies, a unit vector, in two and three dimensions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub critical_direction: Option<Vec<f64>>,
    /// `long-wave`, `interior` or `shortest-wave`.
    pub cause: Option<&'static str>,
    /// For monotonicity: the offset of the coefficient that turns negative.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub binding_offset: Option<Offset>,
    /// The condition on the multipliers that fails beyond.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub binding: Option<String>,
    /// Whether the property holds at the limit itself.
    pub included: bool,
    /// Whether no limit was met in the range looked at.
    pub unbounded: bool,
    /// Whether it is proved that there is none at all.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub without_end: bool,
    /// Why the value is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

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
    fn of(offset: &[i64]) -> Self {
        match offset {
            [offset] => Self::One(*offset),
            offsets => Self::Each(offsets.to_vec()),
        }
    }
}

impl LimitRecord {
    /// The record of a limit of what is called `symbol`, with its digits where they were asked for.
    pub fn new(limit: &Limit, symbol: &str, digits: Option<usize>) -> Self {
        let unlimited = limit.value().is_infinite();
        let undecided = limit.evidence() == Evidence::Undecided;
        Self {
            value: finite(limit.value()),
            lower: limit.lower() + 0.0,
            upper: finite(limit.upper()),
            exact: limit.closed_form(),
            decimal: digits.and_then(|digits| limit.decimal(digits)),
            equation: limit.equation().map(|root| EquationRecord {
                text: root.equation(symbol),
                polynomial: {
                    let polynomial = root.polynomial();
                    polynomial.coefficients().iter().map(ToString::to_string).collect()
                },
            }),
            evidence: limit.evidence().name(),
            phases: match limit.evidence() {
                Evidence::Sampled { phases } => Some(phases),
                _ => None,
            },
            critical_phase: limit.critical_wave().map(Phases::of),
            critical_direction: limit.critical_wave().and_then(direction_of),
            cause: limit.cause().map(|cause| cause.name()),
            binding_offset: limit.binding_offset().map(Offset::of),
            binding: limit.binding().map(|binding| binding.name()),
            included: limit.is_included() && !unlimited,
            unbounded: unlimited && !undecided,
            without_end: limit.is_unbounded(),
            reason: unlimited.then(|| {
                let lower = significant(limit.lower(), 6);
                match limit.evidence() {
                    Evidence::Undecided if limit.lower() > 0.0 => {
                        format!("undecided beyond {symbol} = {lower}")
                    }
                    Evidence::Undecided => "undecided".into(),
                    _ => format!("no limit up to {symbol} = {lower}"),
                }
            }),
        }
    }
}

/// A polynomial equation in the Courant number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EquationRecord {
    /// As one writes it.
    pub text: String,
    /// The integer coefficients of `1, C, C², …`.
    pub polynomial: Vec<String>,
}

/// One interval of values of a parameter; `to` is `null` where it goes on beyond the range.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IntervalRecord {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: Option<f64>,
    /// Why the end is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_note: Option<String>,
    /// Everything about where it begins.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub begin: Option<LimitRecord>,
    /// Everything about where it ends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<LimitRecord>,
}

impl IntervalRecord {
    /// From one number to another; without an end where the interval goes on beyond what was looked at.
    pub fn new(from: f64, to: f64, range_end: f64) -> Self {
        let note = format!("no end up to {}", significant(range_end, 6));
        // Adding zero turns −0 into 0.
        let to_note = to.is_infinite().then_some(note);
        Self { from: from + 0.0, to: finite(to), to_note, begin: None, end: None }
    }

    /// From 0 to a limit.
    pub fn up_to(limit: &Limit) -> Self {
        Self::new(0.0, limit.value(), limit.lower())
    }
}

/// A growth budget and the limit it allows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GrowthRecord {
    /// The permitted growth per step.
    pub growth: f64,
    /// The largest value up to which no multiplier exceeds `1 + growth`.
    pub value: Option<f64>,
    /// The enclosure.
    pub limit: LimitRecord,
}

/// A value of the parameter at which an implicit step cannot be solved.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SingularRecord {
    /// The value, rounded.
    pub value: f64,
    /// The value, where it is a fraction.
    pub exact: Option<String>,
    /// The phase of the wave, in radians.
    pub phase: Option<f64>,
    /// Why it is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
}

/// One row of `limits`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitsRow {
    /// What was judged.
    #[serde(flatten)]
    pub subject: SubjectRecord,
    /// No wave grows.
    pub stability: LimitRecord,
    /// All stable intervals in the range.
    pub stable_set: Vec<IntervalRecord>,
    /// Intervals that could not be decided.
    pub undecided: Vec<IntervalRecord>,
    /// The limit as `c Δt/Δ`, of a particle method.
    pub per_spacing: Option<f64>,
    /// The limit as `c Δt/σ` with the standard deviation σ of the kernel.
    pub per_standard_deviation: Option<f64>,
    /// The condition on the multipliers that fails beyond the limit.
    pub binding: Option<String>,
    /// Whether the limit itself is stable.
    pub limit_included: bool,
    /// The phase of a wave whose amplitude grows like the number of steps, where every wave has such a multiplier at every value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub double_multiplier_phase: Option<Phases>,
    /// All coefficients non-negative.
    pub monotonicity: Option<LimitRecord>,
    /// All intervals where they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monotone_set: Option<Vec<IntervalRecord>>,
    /// Why there is no monotone limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monotonicity_reason: Option<&'static str>,
    /// Where an implicit step cannot be solved.
    pub singular: Vec<SingularRecord>,
    /// Limits for the growth budgets asked for.
    pub growth_limits: Vec<GrowthRecord>,
    /// Whether what is the same everywhere and does not move stays so.
    pub keeps_constants: bool,
}

/// The intervals of a set; 0 alone where it is the limit.
pub fn intervals(set: &StableSet, symbol: &str) -> Vec<IntervalRecord> {
    let limit = set.limit();
    let zero = (limit.upper() == 0.0 && set.at_zero).then(|| IntervalRecord::new(0.0, 0.0, 0.0));
    let others = set.intervals.iter().map(|interval| IntervalRecord {
        begin: Some(LimitRecord::new(&interval.from, symbol, None)),
        end: Some(LimitRecord::new(&interval.to, symbol, None)),
        ..IntervalRecord::new(interval.from.upper(), interval.to.value(), interval.to.lower())
    });
    zero.into_iter().chain(others).collect()
}

/// What could not be decided.
pub fn undecided(set: &StableSet) -> Vec<IntervalRecord> {
    set.undecided.iter().map(|&(from, to)| IntervalRecord::new(from, to, from)).collect()
}

/// The answer of `check`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckRecord {
    /// What was judged.
    #[serde(flatten)]
    pub subject: SubjectRecord,
    /// The value of the parameter, rounded.
    pub cfl: f64,
    /// `stable`, `marginal`, `weakly-unstable`, `unstable` or `undecided`.
    pub verdict: &'static str,
    /// Whether all coefficients are non-negative; nothing where that is not asked or not decided.
    pub monotone: Option<bool>,
    /// The largest `|z|` over all waves.
    pub max_gain: Option<f64>,
    /// The phase of the wave that grows, or of the one that binds the limit, in radians.
    pub critical_phase: Option<Phases>,
    /// `max |z| − 1`.
    pub growth_per_step: Option<f64>,
    /// Why it is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub growth_reason: Option<&'static str>,
    /// Steps until the fastest wave has doubled.
    pub steps_to_double: Option<f64>,
    /// Whether the growth is within what was accepted: `yes`, `no` or `undecided`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within_growth: Option<&'static str>,
    /// The phase of a wave whose amplitude grows like a power of the number of steps.
    pub double_multiplier_phase: Option<Phases>,
    /// The phase of a wave that nothing pulls back.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift_phase: Option<Phases>,
    /// The stability limit.
    pub stability: LimitRecord,
    /// The monotonicity limit.
    pub monotonicity: Option<LimitRecord>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monotonicity_reason: Option<&'static str>,
}

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

/// LaTeX of a limit's exact form, if it has one.
pub fn exact_latex(limit: &Limit) -> Option<String> {
    let fraction = limit.exact().and_then(|exact| exact.as_fraction()).map(to_latex);
    fraction.or_else(|| limit.exact().map(|exact| exact.to_latex()))
}
