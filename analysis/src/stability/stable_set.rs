//! The stable set of Courant numbers, decided in exact arithmetic.
//!
//! Floating point only guesses where stability ends. Every interval that is reported is then proved
//! stable (no Bernstein coefficient of the margin is negative) or unstable (one phase whose margin is
//! negative throughout), and a guess that does not stand is replaced by exact bisection.

mod cells;
mod edge;
mod search;
mod stable_stretch;
mod unstable_stretch;

use super::{Binding, Evidence, ExactValue, Limit, SearchPlan, Wave};
use crate::exact::bernstein::Work;
use crate::exact::rational::{Rational, from_f64, to_f64};
use crate::interest::Interest;
use crate::scheme::Step;
use crate::stability::margin::Margin;
pub(crate) use edge::fraction_or_root;
use num_traits::Zero;
use search::Search;

/// Boxes one decision may look at.
pub(crate) const MAX_BOXES: usize = 2000;

/// The relative width of an enclosure when no other is asked for, as a power of one half: that of an `f64`.
pub const DEFAULT_BITS: u32 = 52;

/// A maximal interval of stable Courant numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct StableInterval {
    /// Where it begins; exactly 0 for the first one.
    pub from: Limit,
    /// Where it ends.
    pub to: Limit,
}

/// All stable Courant numbers within `[0, max_courant]`.
#[derive(Debug, Clone, PartialEq)]
pub struct StableSet {
    /// The stable intervals of positive length, ascending.
    pub intervals: Vec<StableInterval>,
    /// Intervals of Courant numbers that could not be decided.
    pub undecided: Vec<(f64, f64)>,
    /// A wave that grows as `C → 0` when no small Courant number is stable: in one dimension the fastest.
    pub immediately_unstable: Option<Wave>,
    /// The condition that fails at once, when no small Courant number is stable.
    pub immediate_binding: Option<Binding>,
    /// For monotonicity: the coefficient that is negative at once.
    pub immediate_offset: Option<Vec<i64>>,
    /// `|g| = 1` for every wave and every Courant number.
    pub neutral: bool,
    /// What stands behind the answer.
    pub evidence: Evidence,
    /// How much work it took.
    pub work: Work,
    /// Whether 0 itself belongs to the set.
    pub at_zero: bool,
}

impl StableSet {
    /// Without any value.
    pub(crate) fn empty(evidence: Evidence) -> Self {
        Self {
            intervals: Vec::new(),
            undecided: Vec::new(),
            immediately_unstable: None,
            immediate_binding: None,
            immediate_offset: None,
            neutral: false,
            evidence,
            work: Work::default(),
            at_zero: false,
        }
    }

    /// The end of the stable interval that begins at 0; exactly 0 when there is none, and `[0, ∞]` when
    /// nothing could be decided from 0 on.
    pub fn limit(&self) -> Limit {
        match self.intervals.first() {
            Some(first) if first.from.upper() == 0.0 => first.to.clone(),
            _ if self.undecided.first().is_some_and(|open| open.0 == 0.0) => {
                Limit::between(0.0, f64::INFINITY, Evidence::Undecided)
            }
            _ => {
                let zero = Limit::exactly(ExactValue::Fraction(Rational::zero()), self.evidence);
                let zero = match self.immediate_binding {
                    Some(binding) => zero.bound_by(binding),
                    None => zero,
                };
                let zero = zero.included_if(self.at_zero);
                let zero = match &self.immediate_offset {
                    Some(offset) => zero.at_offset(offset.clone()),
                    None => zero,
                };
                match &self.immediately_unstable {
                    Some(wave) => zero.at_wave(wave.clone()),
                    None => zero,
                }
            }
        }
    }

    /// The set of a step: what its coefficients are known by stands behind it.
    pub(crate) fn of_step(mut self, step: &Step) -> Self {
        if step.measured {
            self.evidence = Evidence::Measured;
            for interval in &mut self.intervals {
                let StableInterval { from, to } = interval.clone();
                *interval = StableInterval { from: from.measured(), to: to.measured() };
            }
        }
        self
    }

    /// Whether a Courant number lies in a stable interval; at an end that is enclosed and not exact,
    /// only the inner side counts.
    pub fn contains(&self, courant_number: &Rational) -> bool {
        courant_number.is_zero() && self.at_zero
            || self.intervals.iter().any(|interval| {
                let above =
                    interval.from.certain_upper().is_some_and(|from| *courant_number >= from);
                let below = *courant_number <= interval.to.certain_lower();
                above && below
            })
    }
}

/// Every `C` in `[0, max_courant]` where a margin is nowhere negative.
#[cfg(test)]
pub(crate) fn stable_set_of(margin: &Margin, max_courant: &Rational) -> StableSet {
    Search::new(margin, max_courant, DEFAULT_BITS).run(max_courant, evidence(margin))
}

/// Every `C` in `[0, max_courant]` where a margin that is not neutral is nowhere negative, from a known value on, as precise and with as
/// much work as the plan says.
pub(crate) fn search_within(
    margin: &Margin,
    max_courant: &Rational,
    known: &Rational,
    plan: &SearchPlan,
) -> StableSet {
    Search::new(margin, max_courant, plan.bits)
        .within(plan.budget)
        .while_wanted(&plan.interest)
        .first_only(plan.first_only)
        .patient(FIRST_PATIENCE)
        .knowing(known)
        .run(max_courant, evidence(margin))
}

fn evidence(margin: &Margin) -> Evidence {
    if margin.is_exact() { Evidence::Proved } else { Evidence::Enclosed }
}

/// How many pieces of an unstable stretch may resist before it is no longer halved.
pub(crate) const MAX_PATIENCE: usize = 2000;

/// Pieces of an unstable stretch that may resist one condition at first: another may be violated there.
pub(crate) const FIRST_PATIENCE: usize = 100;

/// Whether some wave violates a margin that is not neutral at every value of the parameter between two: proved, or not known after so many pieces that
/// resist.
pub(crate) fn is_unstable_throughout(
    margin: &Margin,
    lower: &Rational,
    upper: &Rational,
    patience: usize,
    interest: &Interest,
) -> bool {
    let search = Search::new(margin, upper, DEFAULT_BITS).patient(patience);
    let mut search = search.while_wanted(interest);
    search.is_unstable_throughout(lower, upper)
}

/// `s = sin²(φ/2)`, the exact value of a nearby float.
pub(crate) fn phase_parameter(phase: f64) -> Rational {
    let inside = phase.clamp(0.0, std::f64::consts::PI);
    from_f64((0.5 * inside).sin().powi(2)).expect("a square of a sine is finite")
}

/// `φ = 2 arcsin √s`.
pub(crate) fn phase_of(s: &Rational) -> f64 {
    2.0 * to_f64(s).sqrt().min(1.0).asin()
}

#[cfg(test)]
mod tests;
