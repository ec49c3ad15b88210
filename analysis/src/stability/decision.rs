//! The stable set of a scheme: where all its conditions hold.

use super::DEFAULT_BITS;
use super::at_value::DemandsAt;
use super::conditions::{Conditions, Requirement};
use super::inequality::{Inequality, margin_of, series_of};
use super::intersection::{intersection, nowhere, unknown};
use super::limit::Limit;
use super::margin::Margin;
use super::pointwise::PointVerdict;
use super::stable_set::StableSet;
use super::torus::{TorusDemands, stable_set_on_torus};
use super::wave::Wave;
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::rational::{Rational, integer};
use crate::interest::Interest;
use crate::scheme::{LetterKind, SchemeError, Step};
use crate::stability::conditions::Condition;
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
    /// Whether the search ends where the first stretch of stable values does: all that a limit asks for.
    pub first_only: bool,
    /// Whether the answer is still wanted.
    pub interest: Interest,
}

/// What a scheme asks for.
#[derive(Debug, Clone)]
pub enum Demands {
    /// All of these.
    All(Vec<Inequality>),
    /// All of these, in two and three dimensions.
    OnTorus(TorusDemands),
    /// What cannot be: a multiplier lies outside for every wave and every value.
    Nowhere(usize),
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
            first_only: false,
            interest: Interest::default(),
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
        Self { known: strict.certain_lower(), ..self }
    }

    /// Only as long as the answer is wanted.
    #[must_use]
    pub fn while_wanted(self, interest: Interest) -> Self {
        Self { interest, ..self }
    }

    /// That the answer is still wanted.
    ///
    /// # Errors
    /// When it is not.
    pub(crate) fn goes_on(&self) -> Result<(), SchemeError> {
        if self.interest.is_lost() { Err(SchemeError::Cancelled) } else { Ok(()) }
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
        self.limit_by(parameter, &SearchPlan::default())
    }

    /// [`limit`](Self::limit), looked for in one's own way: as of the [stable set](Self::stable_set), of which nothing beyond is searched.
    ///
    /// # Errors
    /// As [`limit`](Self::limit).
    pub fn limit_by(&self, parameter: &str, plan: &SearchPlan) -> Result<Limit, SchemeError> {
        let plan = SearchPlan { first_only: true, ..plan.clone() };
        Ok(self.stable_set(parameter, &plan)?.limit())
    }

    /// The limits for several permitted growths, ascending, each searched from the one before on.
    ///
    /// # Errors
    /// As [`limit`](Self::limit).
    pub fn limits_by(
        &self,
        parameter: &str,
        plan: &SearchPlan,
        growths: &[Rational],
    ) -> Result<Vec<Limit>, SchemeError> {
        let variable = self.sought(parameter)?;
        // Of one multiplier the margins differ by a constant.
        let gain = match self.dimension {
            1 => squared_gain(&self.characteristic()?, self, &Rational::zero()),
            _ => None,
        };
        let series =
            gain.map(|gain| series_of(&gain.margin, &self.names, Some(variable), &gain.scale));
        let mut plan = SearchPlan { first_only: true, ..plan.clone() };
        let mut limits: Vec<Limit> = Vec::with_capacity(growths.len());
        for growth in growths {
            plan = plan.growing(growth.clone());
            let demands = match &series {
                Some(series) => Demands::All(vec![Inequality::of_gain(series.growing(growth))]),
                None => self.inequalities_while(parameter, &plan)?,
            };
            let limit = self.stable_set_under(parameter, &demands, &plan)?.limit();
            plan = plan.knowing(&limit);
            limits.push(limit);
        }
        Ok(limits)
    }

    /// All values of a parameter for which no wave grows.
    ///
    /// # Errors
    /// As [`limit`](Self::limit), and when the plan's [interest](Interest) is lost.
    pub fn stable_set(&self, parameter: &str, plan: &SearchPlan) -> Result<StableSet, SchemeError> {
        if plan.growth.is_positive() && plan.known.is_zero() {
            // What does not grow at all does not grow too fast: only the rest is searched.
            let strict = SearchPlan { growth: Rational::zero(), ..plan.clone() };
            let strict = self.stable_set(parameter, &strict)?.limit();
            if strict.is_positive() {
                return self.stable_set(parameter, &plan.clone().knowing(&strict));
            }
        }
        self.stable_set_under(parameter, &self.inequalities_while(parameter, plan)?, plan)
    }

    /// [`stable_set`](Self::stable_set) with what is asked for known.
    pub(crate) fn stable_set_under(
        &self,
        parameter: &str,
        demands: &Demands,
        plan: &SearchPlan,
    ) -> Result<StableSet, SchemeError> {
        let mut set = match demands {
            Demands::Nowhere(dimension) => nowhere(*dimension),
            Demands::Unknown => unknown(plan),
            Demands::All(inequalities) => intersection(inequalities, plan),
            Demands::OnTorus(demands) => stable_set_on_torus(demands, plan),
        };
        plan.goes_on()?;
        // One condition of one multiplier knows how fast each wave grows; of others only signs are known.
        let one = set.immediate_binding.is_some_and(|b| b.condition == Condition::Minor(1));
        if set.immediately_unstable.is_some() && !one {
            let small = Rational::new(BigInt::one(), BigInt::from(SMALL));
            let growth = self.with(parameter, &small).and_then(|small| growth_at(&small));
            // Measured, only to name a wave: what was decided stands without it.
            if let Some(growth) = growth.ok().filter(|growth| growth.per_step > 0.0) {
                set.immediately_unstable = Some(growth.wave);
            }
        }
        // 0 itself is a stable value where stability begins there; else it is decided like any other.
        set.at_zero = set.intervals.first().is_some_and(|first| first.from.upper() == 0.0)
            || self.with(parameter, &Rational::zero()).is_ok_and(|at_zero| {
                decide_step_while(&at_zero, &plan.growth, &plan.interest)
                    == Ok(PointVerdict::Stable)
            });
        plan.goes_on()?;
        // Beyond a budget for growth a multiple multiplier outside the circle is nothing special.
        let set = if plan.growth.is_zero() { set.with_ends(self, parameter)? } else { set };
        Ok(set.of_step(self))
    }

    /// The conditions for `|z| ≤ 1 + growth` as polynomials in the wave and one parameter.
    ///
    /// # Errors
    /// As [`limit`](Self::limit).
    pub fn inequalities(&self, parameter: &str, growth: &Rational) -> Result<Demands, SchemeError> {
        self.inequalities_while(parameter, &SearchPlan::default().growing(growth.clone()))
    }

    /// [`inequalities`](Self::inequalities) for a plan, as long as they are wanted.
    pub(crate) fn inequalities_while(
        &self,
        parameter: &str,
        plan: &SearchPlan,
    ) -> Result<Demands, SchemeError> {
        self.inequalities_in(Some(self.sought(parameter)?), &plan.growth, &plan.interest)
    }

    /// The only parameter without a value.
    fn sought(&self, parameter: &str) -> Result<Variable, SchemeError> {
        let variable = self.variable(parameter)?;
        let open: Vec<String> =
            self.free_parameters().into_iter().filter(|name| name != parameter).collect();
        if open.is_empty() { Ok(variable) } else { Err(SchemeError::NotSet(open)) }
    }

    pub(crate) fn inequalities_in(
        &self,
        variable: Option<Variable>,
        growth: &Rational,
        interest: &Interest,
    ) -> Result<Demands, SchemeError> {
        let characteristic = self.characteristic()?;
        if self.dimension != 1 {
            let demands = self.demands_on_torus(&characteristic, variable, growth, interest);
            return if interest.is_lost() { Err(SchemeError::Cancelled) } else { Ok(demands) };
        }
        if let Some(margin) = gain_margin(&characteristic, self, variable, growth) {
            return Ok(Demands::All(vec![Inequality::of_gain(margin)]));
        }
        let conditions = Conditions::while_wanted(&characteristic, growth, &self.names, interest);
        if interest.is_lost() {
            return Err(SchemeError::Cancelled);
        }
        if conditions.nowhere {
            return Ok(self.nowhere());
        }
        if conditions.undecided {
            return Ok(Demands::Unknown);
        }
        let inequality = |one: &Requirement| Inequality::new(one, &self.names, variable);
        let inequalities: Vec<Inequality> =
            conditions.requirements.iter().map(inequality).collect();
        let vanishes = |one: &Inequality| one.margin.is_neutral();
        if inequalities.iter().any(vanishes) {
            // What vanishes for these values of the letters only is not seen in letters.
            return self.expanded().inequalities_in(variable, growth, interest);
        }
        Ok(Demands::All(inequalities))
    }

    /// Unstable whatever the parameters, as polynomials in the irrational numbers say: `π (1/π) − 1` is no zero to them.
    fn nowhere(&self) -> Demands {
        match self.names.are_independent() {
            true => Demands::Nowhere(self.dimension),
            false => Demands::Unknown,
        }
    }

    /// What a scheme asks for, on unit cubes of waves.
    pub(crate) fn demands_on_torus(
        &self,
        characteristic: &Laurent,
        variable: Option<Variable>,
        growth: &Rational,
        interest: &Interest,
    ) -> Demands {
        let requirements = match squared_gain(characteristic, self, growth) {
            Some(gain) => vec![Requirement {
                condition: Condition::Minor(1),
                on_circle: false,
                polynomial: gain.margin,
                square: Laurent::integer(1),
            }],
            None => {
                let conditions =
                    Conditions::while_wanted(characteristic, growth, &self.names, interest);
                if conditions.nowhere {
                    return self.nowhere();
                }
                if conditions.undecided {
                    return Demands::Unknown;
                }
                conditions.requirements
            }
        };
        match TorusDemands::new(&requirements, self.dimension, variable, interest) {
            Some(demands) => Demands::OnTorus(demands),
            None => Demands::Unknown,
        }
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

/// `(1 + growth)² − |g|²` times a positive number, and one over that number.
struct SquaredGain {
    margin: Laurent,
    scale: Rational,
}

fn squared_gain(characteristic: &Laurent, step: &Step, growth: &Rational) -> Option<SquaredGain> {
    let coefficients = characteristic.coefficients(Variable::TIME);
    let [old, new] = coefficients.as_slice() else { return None };
    let (exponents, unit) = new.as_monomial()?;
    if exponents[4..].iter().any(|&power| power != 0) {
        return None;
    }
    // Their squares are to be reduced: schemes with square roots go the general way.
    let is_root = |kind: &LetterKind| matches!(kind, LetterKind::SquareRoot(_));
    if step.names.letters().any(|(_, letter)| is_root(&letter.kind)) {
        return None;
    }
    let radius = growth + Rational::one();
    let squared_unit: BigInt = unit * unit;
    let budget = Laurent::constant(&squared_unit * radius.numer() * radius.numer());
    let squared = (old * &old.conjugate()).scaled(&(radius.denom() * radius.denom()));
    let scale = Rational::new(BigInt::one(), squared_unit * radius.denom() * radius.denom());
    Some(SquaredGain { margin: budget - squared, scale })
}

fn gain_margin(
    characteristic: &Laurent,
    step: &Step,
    variable: Option<Variable>,
    growth: &Rational,
) -> Option<Margin> {
    let gain = squared_gain(characteristic, step, growth)?;
    Some(margin_of(&gain.margin, &step.names, variable, &gain.scale).with_growth(growth))
}

/// Whether a scheme whose parameters all have values is stable: decided exactly, by the zeros of its conditions.
///
/// # Errors
/// When a parameter has no value.
pub fn decide_step_at(step: &Step, growth: &Rational) -> Result<PointVerdict<Wave>, SchemeError> {
    decide_step_while(step, growth, &Interest::default())
}

/// [`decide_step_at`], undecided where nobody wants to know any longer.
fn decide_step_while(
    step: &Step,
    growth: &Rational,
    interest: &Interest,
) -> Result<PointVerdict<Wave>, SchemeError> {
    let open = step.free_parameters();
    if !open.is_empty() {
        return Err(SchemeError::NotSet(open));
    }
    Ok(DemandsAt::new(&step.inequalities_in(None, growth, interest)?).decide_while(interest))
}

#[cfg(test)]
mod tests;
