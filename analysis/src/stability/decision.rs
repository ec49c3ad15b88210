//! The stable set of a scheme: where all its conditions hold.

use super::at_value::DemandsAt;
use super::conditions::{Conditions, Requirement};
use super::inequality::{Inequality, margin_of};
use super::limit::{Binding, Evidence, ExactValue, Limit};
use super::margin::Margin;
use super::pointwise::PointVerdict;
use super::stable_set::{StableInterval, StableSet};
use super::{
    DEFAULT_BITS, FIRST_PATIENCE, MAX_BOXES, MAX_PATIENCE, is_unstable_throughout, search_within,
};
use crate::exact::bernstein::{MarginForm, Sign, Work};
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::rational::{Rational, from_f64, integer, simplest_between, to_f64};
use crate::scheme::{SchemeError, Step};
use crate::stability::conditions::Condition;
use crate::stability::critical::{resolving_phases, sampled_unstable_set};
use crate::waves::growth_at;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// How far and how hard a stable set is searched.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchPlan {
    /// The permitted growth per step, `|z| ≤ 1 + growth`.
    pub growth: Rational,
    /// The largest value of the parameter that is looked at; whether all larger ones are stable is asked at the end.
    pub max: Rational,
    /// The relative width of enclosures, as a power of one half.
    pub bits: u32,
    /// Boxes that one decision may look at.
    pub budget: usize,
    /// Up to here everything is known to keep the conditions: a strict limit, when growth is permitted.
    pub known: Rational,
}

/// What a scheme asks for.
#[derive(Debug, Clone)]
pub enum Demands {
    /// All of these.
    All(Vec<Inequality>),
    /// What cannot be: a multiplier lies outside for every wave and every value.
    Nowhere,
    /// What is not known: see [`Conditions::undecided`].
    Unknown,
}

/// With fewer boxes than this nothing is decided about a single value either: see [`check`](super::verdict::check).
pub(crate) const LEAST_BUDGET: usize = 100;

/// One over a value of a parameter that stands for all small ones.
const SMALL: i64 = 1 << 10;

/// Values looked at when nobody says how far.
pub const DEFAULT_RANGE: i64 = 100;

impl Default for SearchPlan {
    fn default() -> Self {
        Self {
            growth: Rational::zero(),
            max: integer(DEFAULT_RANGE),
            bits: DEFAULT_BITS,
            budget: usize::MAX,
            known: Rational::zero(),
        }
    }
}

impl SearchPlan {
    /// Up to another value.
    #[must_use]
    pub fn up_to(self, max: Rational) -> Self {
        Self { max, ..self }
    }

    /// With a permitted growth.
    #[must_use]
    pub fn growing(self, growth: Rational) -> Self {
        Self { growth, ..self }
    }

    /// With values known to keep the conditions: what does not grow at all does not grow too fast.
    #[must_use]
    pub fn knowing(self, strict: &Limit) -> Self {
        Self { known: strict.certain_lower().unwrap_or_default(), ..self }
    }

    /// With narrower enclosures.
    #[must_use]
    pub fn to_bits(self, bits: u32) -> Self {
        Self { bits, ..self }
    }
}

impl Step {
    /// The largest value of a parameter up to which no wave grows.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?;
    /// let limit = leapfrog.limit("C")?;
    /// // At C = 1 two multipliers meet at φ = π/2: the limit itself is not stable.
    /// assert_eq!((limit.value(), limit.is_included()), (1.0, false));
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Errors
    /// When the parameter does not occur or another has no value.
    pub fn limit(&self, parameter: &str) -> Result<Limit, SchemeError> {
        Ok(self.stable_set(parameter, &SearchPlan::default())?.limit())
    }

    /// All values of a parameter for which no wave grows.
    ///
    /// # Errors
    /// As [`limit`](Self::limit).
    pub fn stable_set(&self, parameter: &str, plan: &SearchPlan) -> Result<StableSet, SchemeError> {
        if plan.growth.is_positive() && plan.known.is_zero() {
            // What does not grow at all does not grow too fast: only the rest is searched.
            let strict = SearchPlan { growth: Rational::zero(), ..plan.clone() };
            let strict = self.stable_set(parameter, &strict)?.limit();
            if strict.is_positive() {
                return self.stable_set(parameter, &plan.clone().knowing(&strict));
            }
        }
        self.stable_set_under(parameter, &self.inequalities(parameter, &plan.growth)?, plan)
    }

    /// [`stable_set`](Self::stable_set) with what is asked for known.
    pub(crate) fn stable_set_under(
        &self,
        parameter: &str,
        demands: &Demands,
        plan: &SearchPlan,
    ) -> Result<StableSet, SchemeError> {
        let mut set = match demands {
            Demands::Nowhere => nowhere(),
            Demands::Unknown => unknown(plan),
            Demands::All(inequalities) => intersection(inequalities, plan),
        };
        // One condition of one multiplier knows how fast each wave grows; of others only signs are known.
        let one = set.immediate_binding.is_some_and(|b| b.condition == Condition::Minor(1));
        if set.immediately_unstable_phase.is_some()
            && !one
            && let [parameter] = &self.free_parameters()[..]
        {
            let small = Rational::new(BigInt::one(), BigInt::from(SMALL));
            let growth = growth_at(&self.with(parameter, &small)?)?;
            if growth.per_step > 0.0 {
                set.immediately_unstable_phase = Some(growth.phase);
            }
        }
        // 0 itself is a stable value where stability begins there; else it is decided like any other.
        set.at_zero = set.intervals.first().is_some_and(|first| first.from.upper() == 0.0)
            || match &self.free_parameters()[..] {
                [parameter] => self.with(parameter, &Rational::zero()).is_ok_and(|at_zero| {
                    at_zero.characteristic().is_ok()
                        && decide_step_at(&at_zero, &plan.growth) == Ok(PointVerdict::Stable)
                }),
                _ => false,
            };
        // Beyond a budget for growth a multiple multiplier outside the circle is nothing special.
        if plan.growth.is_zero() { set.with_ends(self, parameter) } else { Ok(set) }
    }

    /// The conditions for `|z| ≤ 1 + growth` as polynomials in the wave and one parameter.
    ///
    /// # Errors
    /// As [`limit`](Self::limit).
    pub fn inequalities(&self, parameter: &str, growth: &Rational) -> Result<Demands, SchemeError> {
        let variable = self.variable(parameter)?;
        let open: Vec<String> =
            self.free_parameters().into_iter().filter(|name| name != parameter).collect();
        if !open.is_empty() {
            return Err(SchemeError::NotSet(open));
        }
        self.inequalities_in(Some(variable), growth)
    }

    pub(crate) fn inequalities_in(
        &self,
        variable: Option<Variable>,
        growth: &Rational,
    ) -> Result<Demands, SchemeError> {
        if self.dimension != 1 {
            return Err(SchemeError::Dimension(self.dimension));
        }
        let characteristic = self.characteristic()?;
        if let Some(margin) = gain_margin(&characteristic, self, variable, growth) {
            let condition = Condition::Minor(1);
            let whatever_the_step = false;
            return Ok(Demands::All(vec![Inequality {
                condition,
                on_circle: false,
                margin,
                whatever_the_step,
                thinned: false,
            }]));
        }
        let conditions = Conditions::new(&characteristic, growth, &self.names);
        if conditions.nowhere {
            return Ok(Demands::Nowhere);
        }
        if conditions.undecided {
            return Ok(Demands::Unknown);
        }
        let inequality = |one: &Requirement| Inequality::new(one, &self.names, variable);
        let inequalities: Vec<Inequality> =
            conditions.requirements.iter().map(inequality).collect();
        let vanishes = |one: &Inequality| one.margin.is_neutral();
        if inequalities.iter().any(vanishes) && self.names.letters().next().is_some() {
            // What vanishes for these values of the letters only is not seen in letters.
            if let Some(expanded) = self.expanded() {
                return expanded.inequalities_in(variable, growth);
            }
        }
        Ok(Demands::All(inequalities))
    }

    /// `(1 + growth)² − |g|²` of an explicit scheme for one unknown between two levels, with its parameter; `None` for other schemes.
    ///
    /// # Errors
    /// As [`limit`](Self::limit).
    pub fn gain_margin(
        &self,
        parameter: &str,
        growth: &Rational,
    ) -> Result<Option<Margin>, SchemeError> {
        let variable = self.variable(parameter)?;
        Ok(gain_margin(&self.characteristic()?, self, Some(variable), growth))
    }
}

fn gain_margin(
    characteristic: &Laurent,
    step: &Step,
    variable: Option<Variable>,
    growth: &Rational,
) -> Option<Margin> {
    let coefficients = characteristic.coefficients(Variable::TIME);
    let [old, new] = coefficients.as_slice() else { return None };
    let (exponents, unit) = new.as_monomial()?;
    if exponents[4..].iter().any(|&power| power != 0) {
        return None;
    }
    let radius = growth + Rational::one();
    let squared_unit: BigInt = unit * unit;
    let budget = Laurent::constant(&squared_unit * radius.numer() * radius.numer());
    let squared =
        step.names.reduce((old * &old.conjugate()).scaled(&(radius.denom() * radius.denom())));
    // Reduction of square roots may scale; schemes with them go the general way.
    if step
        .names
        .letters()
        .any(|(_, letter)| matches!(letter.kind, crate::scheme::LetterKind::SquareRoot(_)))
    {
        return None;
    }
    let scale = Rational::new(BigInt::one(), squared_unit * radius.denom() * radius.denom());
    Some(margin_of(&(budget - squared), &step.names, variable, &scale).with_growth(growth))
}

/// Stable nowhere: some multiplier is outside whatever the wave and the value.
fn nowhere() -> StableSet {
    StableSet {
        intervals: Vec::new(),
        undecided: Vec::new(),
        // Any wave will do.
        immediately_unstable_phase: Some(std::f64::consts::FRAC_PI_2),
        immediate_binding: None,
        immediate_offset: None,
        neutral: false,
        evidence: Evidence::Proved,
        work: Work::default(),
        at_zero: false,
    }
}

/// Nothing is decided.
fn unknown(plan: &SearchPlan) -> StableSet {
    StableSet {
        undecided: vec![(0.0, to_f64(&plan.max))],
        immediately_unstable_phase: None,
        evidence: Evidence::Undecided,
        ..nowhere()
    }
}

/// Everything from 0 on.
fn everything(plan: &SearchPlan, evidence: Evidence) -> StableSet {
    StableSet {
        intervals: vec![StableInterval {
            from: Limit::exactly(ExactValue::Fraction(Rational::zero()), evidence),
            to: Limit::unbounded(&plan.max, evidence),
        }],
        undecided: Vec::new(),
        immediately_unstable_phase: None,
        immediate_binding: None,
        immediate_offset: None,
        neutral: true,
        evidence,
        work: Work::default(),
        at_zero: true,
    }
}

/// Failures are told apart that differ by more than about this part of a factor of two.
const SAME_FAILURE: f64 = (1 << 24) as f64;

/// Where all conditions hold.
fn intersection(inequalities: &[Inequality], plan: &SearchPlan) -> StableSet {
    let exact = inequalities.iter().all(|one| one.margin.is_exact());
    let evidence = if exact { Evidence::Proved } else { Evidence::Enclosed };
    let mut set = everything(plan, evidence);
    // The condition that floating point sees fail first goes first: the others need not look beyond.
    let mut ordered: Vec<(f64, &Inequality)> =
        inequalities.iter().filter(|one| !one.margin.is_neutral()).map(|one| (0.0, one)).collect();
    if ordered.len() > 1 {
        for (first, inequality) in &mut ordered {
            let failure = first_failure(&inequality.margin, &plan.max);
            *first = (failure.log2() * SAME_FAILURE).round();
        }
    }
    // Where several fail at once, multipliers at +1 and −1 say more than a circle that is left.
    ordered.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.condition.cmp(&b.1.condition)));
    if ordered.is_empty() {
        return set;
    }
    set.neutral = false;
    for (_, inequality) in &ordered {
        set = restricted(set, inequality, plan);
    }
    // What one condition leaves open another may exclude; only then it is worth more effort.
    let excluded = |&(lower, upper): &(f64, f64)| {
        let (Some(lower), Some(upper)) = (from_f64(lower), from_f64(upper)) else { return false };
        let mut allowed =
            [FIRST_PATIENCE, MAX_PATIENCE].into_iter().filter(|one| *one <= plan.budget);
        allowed.any(|patience| {
            let outside =
                |one: &Inequality| is_unstable_throughout(&one.margin, &lower, &upper, patience);
            inequalities.iter().any(outside)
        })
    };
    set.undecided.retain(|gap| !excluded(gap));
    // Beyond the range: what no condition stops there may be stable for ever.
    let all = || ordered.iter().map(|(_, inequality)| *inequality);
    if let Some(last) = set.intervals.last_mut()
        && last.to.is_unbounded()
        && !all().all(|one| holds_beyond(&one.margin, plan))
    {
        last.to = Limit::beyond(&plan.max, evidence);
    }
    set
}

/// The first value at which a sampled wave violates the condition.
fn first_failure(margin: &Margin, max: &Rational) -> f64 {
    let compiled = margin.compile();
    let end = compiled.parameter(to_f64(max));
    let seen = sampled_unstable_set(&compiled, resolving_phases(margin.degree()), end);
    seen.first()
        .map_or(f64::INFINITY, |first| first.from.parameter.powf(1.0 / margin.stride() as f64))
}

/// The part of a set in which one more condition holds.
fn restricted(set: StableSet, inequality: &Inequality, plan: &SearchPlan) -> StableSet {
    let binding = Binding {
        condition: inequality.condition,
        on_circle: inequality.on_circle,
        whatever_the_step: inequality.whatever_the_step,
    };
    let first = set.work == Work::default();
    let mut result = StableSet { intervals: Vec::new(), ..set.clone() };
    for interval in &set.intervals {
        let end = window_end(&interval.to, &plan.max);
        let known = match interval.from.certain_lower() {
            Some(from) if !first => from.min(end.clone()),
            _ => plan.known.clone().min(end.clone()),
        };
        let found = search_within(&inequality.margin, &end, &known, plan.bits, plan.budget);
        result.work += found.work;
        let inside = |value: f64| value < interval.to.upper();
        result.undecided.extend(found.undecided.iter().filter(|(from, _)| inside(*from)));
        if let Some(phase) = found.immediately_unstable_phase
            && interval.from.upper() == 0.0
            && result.immediately_unstable_phase.is_none()
        {
            result.immediately_unstable_phase = Some(phase);
            result.immediate_binding = Some(binding);
        }
        for other in found.intervals {
            let from = if other.from.upper() > interval.from.upper() {
                other.from.bound_by(binding)
            } else {
                interval.from.clone()
            };
            let to = match order(&interval.to, &other.to) {
                Order::Known => interval.to.clone(),
                Order::Other => other.to.bound_by(binding),
                Order::Unclear(lower) => {
                    // Not told apart: is this condition kept up to where the known one certainly is?
                    let again =
                        search_within(&inequality.margin, &lower, &known, plan.bits, plan.budget);
                    result.work += again.work;
                    let kept = again.undecided.is_empty()
                        && again.intervals.last().is_some_and(|last| last.to.upper().is_infinite());
                    if kept { interval.to.clone() } else { other.to.bound_by(binding) }
                }
            };
            match (from.certain_upper(), to.certain_lower()) {
                // The end of one condition and the beginning of another are not told apart: a point, a sliver, or nothing.
                (Some(after), Some(before)) if after > before => {
                    result.undecided.push((from.lower(), to.upper()));
                }
                // A single value is no stretch to choose a step from.
                (Some(after), Some(before)) if after == before => {}
                _ => result.intervals.push(StableInterval { from, to }),
            }
        }
    }
    result
}

/// Which of two ends comes first.
enum Order {
    Known,
    Other,
    /// Their enclosures overlap; the known one is certainly not before this.
    Unclear(Rational),
}

fn order(known: &Limit, other: &Limit) -> Order {
    if other.upper().is_infinite() && other.evidence() != Evidence::Undecided {
        // Nothing was met in the window.
        return Order::Known;
    }
    let (Some(other_lower), Some(known_lower)) = (other.certain_lower(), known.certain_lower())
    else {
        return Order::Other;
    };
    if known.upper().is_infinite() {
        return Order::Other;
    }
    if other_lower >= known_lower {
        return Order::Known;
    }
    match other.certain_upper() {
        Some(upper) if upper < known_lower => Order::Other,
        _ => Order::Unclear(known_lower),
    }
}

/// A short fraction a little above a limit: conditions that touch zero beyond it are not asked about.
fn window_end(limit: &Limit, max: &Rational) -> Rational {
    if limit.upper().is_infinite() {
        return max.clone();
    }
    let value = limit.upper();
    match (from_f64(value * (1.0 + 1e-8)), from_f64(value * (1.0 + 2e-8))) {
        (Some(lower), Some(upper)) if lower < *max && lower.is_positive() => {
            simplest_between(&lower, &upper.min(max.clone()))
        }
        _ => max.clone(),
    }
}

/// Whether a condition holds for every value from the end of the range on.
fn holds_beyond(margin: &Margin, plan: &SearchPlan) -> bool {
    let t = plan.max.pow(margin.stride() as i32);
    let boxes = MAX_BOXES.min(plan.budget);
    MarginForm::new(margin).reversed().sign(&Rational::zero(), &t.recip(), boxes).0
        == Sign::NowhereNegative
}

/// Whether a scheme whose parameters all have values is stable: decided exactly, by the zeros of its conditions.
///
/// # Errors
/// When a parameter has no value.
pub fn decide_step_at(step: &Step, growth: &Rational) -> Result<PointVerdict, SchemeError> {
    let open = step.free_parameters();
    if !open.is_empty() {
        return Err(SchemeError::NotSet(open));
    }
    Ok(DemandsAt::new(&step.inequalities_in(None, growth)?).decide())
}
