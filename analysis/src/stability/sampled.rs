//! Stability looked at on a finite set of phases: what the literature does, and what goes wrong.

use super::critical::{refine, sampled_unstable_set};
use super::{Evidence, Limit};
use crate::exact::rational::{Rational, to_f64};
use crate::stability::margin::Margin;

/// The phases `0, step, 2 step, …` up to and including π, in radians.
///
/// ```
/// use courant_analysis::stability::phase_grid;
/// assert_eq!(phase_grid(0.1).len(), 32);   // 0, 0.1, …, 3.1
/// ```
///
/// # Panics
/// When `step` is not positive.
pub fn phase_grid(step: f64) -> Vec<f64> {
    assert!(step > 0.0, "a phase grid needs a positive step");
    let last = (std::f64::consts::PI / step * (1.0 + 4.0 * f64::EPSILON)).floor() as usize;
    (0..=last).map(|index| (index as f64 * step).min(std::f64::consts::PI)).collect()
}

/// The largest Courant number in `[0, max_courant]` up to which a margin is not negative at any given phase.
///
/// The true limit is at most this. A phase of exactly zero says nothing about a scheme that keeps
/// constants, because `g(0) = 1` whatever the Courant number; it is passed over.
pub fn sampled_stability_limit(margin: &Margin, phases: &[f64], max_courant: &Rational) -> Limit {
    sampled_limit(margin, phases, max_courant, false)
}

/// [`sampled_stability_limit`], then the phase that binds refined in floating point between its
/// neighbours: accurate where the samples lead to the right neighbourhood, and no proof.
pub fn refined_stability_limit(margin: &Margin, phases: &[f64], max_courant: &Rational) -> Limit {
    sampled_limit(margin, phases, max_courant, true)
}

fn sampled_limit(margin: &Margin, phases: &[f64], max_courant: &Rational, refined: bool) -> Limit {
    let evidence = Evidence::Sampled { phases: phases.len() };
    let compiled = margin.compile();
    let useful = phases.iter().copied().filter(|&phase| phase > 0.0 || margin.phase_power() == 0);
    let max_parameter = compiled.parameter(to_f64(max_courant));
    let unstable = sampled_unstable_set(&compiled, useful, max_parameter);
    let Some(first) = unstable.first() else { return Limit::beyond(max_courant, evidence) };
    let mut end = first.from;
    if refined && end.parameter > 0.0 {
        end = refine(&compiled, end, true, max_parameter);
    }
    let value = end.parameter.powf(1.0 / margin.stride() as f64);
    Limit::between(value, value, evidence).at_phase(end.phase)
}
