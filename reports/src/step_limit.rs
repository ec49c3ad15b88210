//! What is said before a run whose step is beyond the proved limit of its scheme.

use crate::number::significant;
use courant_analysis::exact::rational::{Rational, from_f64, to_text};
use courant_analysis::stability::StableSet;
use courant_simulation::advection::{Discretisation, Method, RunPlan};

/// Equal steps to an end have a Courant number that was rounded.
const ROUNDING: f64 = 1.0 - 1e-12;

/// Whether a step that may have been rounded is stable.
fn allows(set: &StableSet, used: f64) -> bool {
    [used, used * ROUNDING].into_iter().filter_map(from_f64).any(|used| set.contains(&used))
}

/// Which steps are stable, in words.
fn stable_steps(set: &StableSet, name: &str) -> String {
    let limit = set.limit();
    match limit.exact() {
        _ if !limit.is_positive() => "no step, however small".to_string(),
        Some(exact) if exact.to_string().len() <= 12 => format!("steps up to {name} = {exact}"),
        _ => format!("steps up to {name} = {}", significant(limit.value(), 6)),
    }
}

/// Of an advection scheme on the uniform lattice; `None` where the step is proved to be stable.
pub fn advection(plan: &RunPlan, ratio: &Rational) -> Option<String> {
    let Method { scheme, kernel, .. } = plan.method;
    let used = plan.check().ok()?;
    let set = Discretisation::new(scheme, kernel, ratio.clone()).ok()?.stable_set();
    (!allows(&set, used)).then(|| {
        format!(
            "C = {} is beyond the stability limit of {}: {}, by proof, with {} at l/Δξ = {}; waves grow",
            significant(used, 6),
            scheme.name(),
            stable_steps(&set, "C"),
            kernel.name(),
            to_text(ratio)
        )
    })
}
