//! Whether an end of a stable set is stable itself: no multiplier on the circle there lacks eigenvectors.

use super::{BITS, MultipleMultiplier, Tolerance, multiple_at, multiplicity_among};
use crate::exact::laurent::Variable;
use crate::exact::rational::{Rational, from_f64};
use crate::scheme::{SchemeError, Step};
use crate::stability::{Limit, StableSet};
use crate::waves::precise::PreciseStep;
use crate::waves::torus_growth::place;
use crate::waves::wave_terms::{difference_terms, primitive_characteristic};

/// An end that is no fraction and its wave are known to an `f64`: multipliers that meet there are apart by the root of a rounding.
const NEAR: Tolerance = Tolerance { close: -16, nothing: -16 };

impl StableSet {
    /// With what is known of the ends: [`Limit::is_included`].
    pub(crate) fn with_ends(mut self, step: &Step, parameter: &str) -> Result<Self, SchemeError> {
        let reduced = step.reduced();
        let is_scalar = reduced.size() == 1;
        let levels = reduced.rows()[0][0].range(Variable::TIME);
        if self.neutral || is_scalar && levels.is_none_or(|(low, high)| high - low < 2) {
            // A single multiplier.
            return Ok(self);
        }
        let is_end = |end: &Limit| end.is_positive() && end.upper().is_finite();
        let all =
            self.intervals.iter_mut().flat_map(|interval| [&mut interval.from, &mut interval.to]);
        for end in all.filter(|end| is_end(end)) {
            // Multipliers that meet on the circle and part from it: one equation has one eigenvector for both.
            let meet = end.binding().is_some_and(|binding| binding.on_circle);
            let included = !(meet && is_scalar) && is_stable(step, parameter, end)?;
            *end = end.clone().included_if(included);
        }
        Ok(self)
    }
}

/// For a fraction all waves are looked at, for other ends the wave that binds.
fn is_stable(step: &Step, parameter: &str, end: &Limit) -> Result<bool, SchemeError> {
    let at = |value: &Rational| -> Result<Step, SchemeError> {
        Ok(step.with(parameter, value)?.expanded())
    };
    if let Some(value) = end.exact().and_then(|exact| exact.as_fraction()) {
        return Ok(multiplicity_among(&at(value)?, end.critical_wave())?.growing.is_none());
    }
    let (Some(value), Some(wave)) = (from_f64(end.value()), end.critical_wave()) else {
        return Ok(true);
    };
    let step = at(&value)?;
    let precise =
        PreciseStep::new(&step, &difference_terms(&primitive_characteristic(&step)?), BITS);
    let place = place(&precise, wave.phases());
    let found = multiple_at(&step, &step.reduced(), &precise, &place, NEAR);
    let is_drift = |found: &MultipleMultiplier| (found.multiplier - 1.0).norm() < 1e-3;
    Ok(found.iter().all(is_drift))
}
