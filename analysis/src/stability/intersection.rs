//! Where all conditions of a scheme hold: the intersection of what each allows.

use super::decision::SearchPlan;
use super::inequality::Inequality;
use super::limit::{Binding, Evidence, ExactValue, Limit};
use super::margin::Margin;
use super::stable_set::{StableInterval, StableSet};
use super::wave::Wave;
use super::{FIRST_PATIENCE, MAX_BOXES, MAX_PATIENCE, is_unstable_throughout, search_within};
use crate::exact::bernstein::{MarginForm, Sign, Work};
use crate::exact::rational::{Rational, from_f64, simplest_between, to_f64, to_f64_below};
use crate::stability::critical::{resolving_phases, sampled_unstable_set};
use num_traits::{Signed, Zero};

/// Stable nowhere: some multiplier is outside whatever the wave and the value.
pub(super) fn nowhere(dimension: usize) -> StableSet {
    // Any wave will do.
    let wave = Wave::new(vec![std::f64::consts::FRAC_PI_2; dimension]);
    StableSet { immediately_unstable: Some(wave), ..StableSet::empty(Evidence::Proved) }
}

/// Nothing is decided beyond what is known.
pub(super) fn unknown(plan: &SearchPlan) -> StableSet {
    let open = (to_f64_below(&plan.known.clone().min(plan.max.clone())), to_f64(&plan.max));
    let mut set = StableSet { undecided: vec![open], ..StableSet::empty(Evidence::Undecided) };
    if plan.known.is_positive() {
        let from = Limit::exactly(ExactValue::Fraction(Rational::zero()), Evidence::Proved);
        let to = Limit::between(open.0, open.1, Evidence::Undecided);
        set.intervals.push(StableInterval { from, to });
    }
    set
}

/// Everything from 0 on.
fn everything(plan: &SearchPlan, evidence: Evidence) -> StableSet {
    StableSet {
        intervals: vec![StableInterval {
            from: Limit::exactly(ExactValue::Fraction(Rational::zero()), evidence),
            to: Limit::unbounded(&plan.max, evidence),
        }],
        ..StableSet::empty(evidence)
    }
}

/// Failures are told apart that differ by more than about this part of a factor of two.
const SAME_FAILURE: f64 = (1 << 24) as f64;

/// Where all conditions hold.
pub(super) fn intersection(inequalities: &[Inequality], plan: &SearchPlan) -> StableSet {
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
    set.neutral = ordered.is_empty();
    for (_, inequality) in &ordered {
        set = restricted(set, inequality, plan);
    }
    // What one condition leaves open another may exclude; only then it is worth more effort.
    let excluded = |&(lower, upper): &(f64, f64)| {
        let (Some(lower), Some(upper)) = (from_f64(lower), from_f64(upper)) else { return false };
        let mut allowed =
            [FIRST_PATIENCE, MAX_PATIENCE].into_iter().filter(|one| *one <= plan.budget);
        allowed.any(|patience| {
            let outside = |one: &Inequality| {
                is_unstable_throughout(&one.margin, &lower, &upper, patience, &plan.interest)
            };
            ordered.iter().any(|(_, one)| outside(one))
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
        let known = if first { plan.known.clone() } else { interval.from.certain_lower() };
        let known = known.min(end.clone());
        let found = search_within(&inequality.margin, &end, &known, plan);
        result.work += found.work;
        result.undecided.extend(found.undecided);
        // Only where nothing was known yet: what begins later is searched from there on, and no second condition begins at 0.
        if let Some(wave) = found.immediately_unstable {
            result.immediately_unstable = Some(wave);
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
                    // Is this condition kept up to where the known one certainly is?
                    let again = search_within(&inequality.margin, &lower, &known, plan);
                    result.work += again.work;
                    let kept = again.undecided.is_empty()
                        && again.intervals.last().is_some_and(|last| last.to.upper().is_infinite());
                    if kept { interval.to.clone() } else { other.to.bound_by(binding) }
                }
            };
            match (from.certain_upper(), to.certain_lower()) {
                // The end of one condition and the beginning of another are not told apart: a point, a sliver, or nothing.
                (Some(after), before) if after > before => {
                    result.undecided.push((from.lower(), to.upper()));
                }
                // A single value is no stretch to choose a step from.
                (Some(after), before) if after == before => {}
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
    /// The other one may come first; the known one is certainly not before this.
    Unclear(Rational),
}

fn order(known: &Limit, other: &Limit) -> Order {
    if other.upper().is_infinite() && other.evidence() != Evidence::Undecided {
        // Nothing was met in the window.
        return Order::Known;
    }
    if known.upper().is_infinite() {
        return Order::Other;
    }
    let (other_lower, known_lower) = (other.certain_lower(), known.certain_lower());
    if other_lower >= known_lower { Order::Known } else { Order::Unclear(known_lower) }
}

/// A short fraction a little above a limit: conditions that touch zero beyond it are not asked about.
fn window_end(limit: &Limit, max: &Rational) -> Rational {
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
    let form = MarginForm::new(margin).while_wanted(&plan.interest).reversed();
    form.sign(&Rational::zero(), &t.recip(), boxes).0 == Sign::NowhereNegative
}

#[cfg(test)]
mod tests;
