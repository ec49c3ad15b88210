//! Where an implicit step cannot be solved: the coefficient of the newest level vanishes for some wave.

use super::inequality::margin_of;
use super::{SearchPlan, search_within};
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, simplest_between, to_f64};
use crate::exact::real_roots::real_roots;
use crate::scheme::{SchemeError, Step};
use num_traits::{One, Zero};

/// Bits of the enclosure of a singular value.
const BITS: u32 = 128;

/// A value of the parameter at which a wave's step is singular.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularStep {
    /// The value, rounded.
    pub value: f64,
    /// The value, where it is a fraction.
    pub exact: Option<Rational>,
    /// The wave's phase in radians.
    pub phase: f64,
}

impl Step {
    /// The values of a parameter within `(0, plan.max]` at which the longest or the shortest wave cannot be stepped, and the first one at
    /// which any wave cannot, where the leading coefficient is real. Other singular waves are not looked for.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// use courant_analysis::stability::SearchPlan;
    /// let downwind = Step::from_text("u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]")?;
    /// let singular = downwind.singular_steps("C", &SearchPlan::default())?;
    /// assert_eq!((singular[0].value, singular[0].phase), (0.5, std::f64::consts::PI));
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Errors
    /// When the parameter does not occur.
    pub fn singular_steps(
        &self,
        parameter: &str,
        plan: &SearchPlan,
    ) -> Result<Vec<SingularStep>, SchemeError> {
        let variable = self.variable(parameter)?;
        let characteristic = self.characteristic()?;
        let coefficients = characteristic.coefficients(Variable::TIME);
        let leading = coefficients.last().cloned().unwrap_or_default();
        let mut found = Vec::new();
        if leading.as_monomial().is_some() || self.names.letters().next().is_some() {
            return Ok(found);
        }
        for phase in [0.0, std::f64::consts::PI] {
            let at_end = at_end(&leading, phase > 0.0);
            let polynomial = Polynomial::new(
                at_end
                    .coefficients(variable)
                    .iter()
                    .map(|c| Rational::from(c.as_constant().unwrap_or_default()))
                    .collect(),
            );
            if polynomial.degree() < Some(1) {
                continue;
            }
            for root in real_roots(&polynomial, &Rational::zero(), &plan.max, BITS) {
                let simplest = simplest_between(&root.lower, &root.upper);
                let exact = polynomial.evaluate(&simplest).is_zero().then_some(simplest);
                let value = to_f64(exact.as_ref().unwrap_or(&root.upper));
                found.push(SingularStep { value, exact, phase });
            }
        }
        if let Some(real) = centred(&leading) {
            let margin = margin_of(&real, &self.names, Some(variable), &Rational::one());
            let positive = search_within(&margin, &plan.max, &integer(0), plan.bits, plan.budget);
            let limit = positive.limit();
            if limit.upper().is_finite()
                && limit.is_positive()
                && found.iter().all(|known| known.value > limit.value() * (1.0 + 1e-9))
            {
                let exact = limit.exact().and_then(|exact| exact.as_fraction().cloned());
                found.push(SingularStep {
                    value: limit.value(),
                    exact,
                    phase: limit.critical_phase().unwrap_or(0.0),
                });
            }
        }
        found.sort_by(|a, b| a.value.total_cmp(&b.value));
        Ok(found)
    }
}

/// The value at `E = 1` or `E = −1`.
fn at_end(polynomial: &Laurent, shortest: bool) -> Laurent {
    let axis = Variable::axis(0).0;
    let terms = polynomial.terms().iter().map(|(exponents, value)| {
        let mut rest = *exponents;
        let odd = rest[axis] % 2 != 0;
        rest[axis] = 0;
        (rest, if shortest && odd { -value } else { value.clone() })
    });
    Laurent::new(terms.collect())
}

/// Shifted so that it is real on every wave, if a shift does it, and positive for long waves at first.
fn centred(polynomial: &Laurent) -> Option<Laurent> {
    let (low, high) = polynomial.range(Variable::axis(0))?;
    if (low + high) % 2 != 0 {
        return None;
    }
    let shifted = polynomial.shifted(Variable::axis(0), -(low + high) / 2);
    if !shifted.is_real() {
        return None;
    }
    let start = at_end(&shifted, false).terms().first().map(|(_, value)| value.clone())?;
    Some(if start < 0.into() { -shifted } else { shifted })
}
