//! Which time steps are stable: sign decisions, stable sets, limits and verdicts, each with its evidence.

mod accuracy_study;
pub(crate) mod at_value;
mod conditions;
pub(crate) mod critical;
mod critical_polynomial;
mod cylinder;
mod decision;
mod inequality;
mod intersection;
mod judgement;
mod limit;
mod limit_on_cells;
pub mod margin;
mod monotone_set;
mod multiplicity;
mod pointwise;
mod sampled;
mod singular;
mod stable_set;
#[cfg(test)]
mod testing;
mod torus;
pub mod verdict;
mod wave;
pub mod weak_instability;

pub use accuracy_study::{AccuracyRow, LimitMethod, accuracy_study};
pub use conditions::{Condition, Conditions, Requirement};
pub use decision::{Demands, SearchPlan, decide_step_at};
pub use inequality::Inequality;
pub(crate) use inequality::{even_series, symmetric};
pub use judgement::{Judgement, judge};
pub use limit::{Binding, Cause, Evidence, ExactValue, Limit};
pub use limit_on_cells::{LimitOnCells, Refinement};
pub use multiplicity::{MultipleMultiplier, Multiplicity, multiplicity_at};
pub use pointwise::{PointVerdict, decide_at};
pub use sampled::{phase_grid, refined_stability_limit, sampled_stability_limit};
pub use singular::SingularStep;
#[cfg(test)]
pub(crate) use stable_set::stable_set_of;
pub use stable_set::{DEFAULT_BITS, StableInterval, StableSet};
pub(crate) use stable_set::{
    FIRST_PATIENCE, MAX_BOXES, MAX_PATIENCE, is_unstable_throughout, phase_of, phase_parameter,
    search_within,
};
pub use torus::TorusDemands;
pub(crate) use torus::{
    Cell, Edge, ExactSpot, StableStretch, StretchEnd, Turn, stretches_on_torus, whole_cells,
};
pub use wave::Wave;
