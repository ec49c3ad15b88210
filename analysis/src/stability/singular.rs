//! Where an implicit step cannot be solved: the coefficient of the newest level vanishes for some wave.

use super::inequality::margin_of;
use super::{Evidence, SearchPlan, Wave, search_within};
use crate::exact::laurent::{Exponents, Laurent, Variable, common_divisor};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, simplest_between, to_f64, to_text};
use crate::exact::real_roots::real_roots;
use crate::scheme::{SchemeError, Step};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Bits of the enclosure of a singular value.
const BITS: u32 = 128;

/// A value of the parameter at which a wave's step is singular.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularStep {
    /// The value, rounded.
    pub value: f64,
    /// The value, where it is a fraction.
    pub exact: Option<Rational>,
    /// The wave; nothing where no wave can be stepped.
    pub wave: Option<Wave>,
}

impl Step {
    /// The values of a parameter within `[0, plan.max]` at which no wave can be stepped, or one whose phases are 0 and π; and, in one
    /// dimension, the first one at which any wave cannot, where the leading coefficient is real. Other singular waves are not looked for,
    /// and none where numbers occur that are no fractions.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// use courant_analysis::stability::SearchPlan;
    /// // For every wave, for the shortest.
    /// let nothing = Step::from_text("C*u[n+1,j] = u[n,j]")?.singular_steps("C", &SearchPlan::default())?;
    /// assert_eq!((nothing.len(), nothing[0].value, &nothing[0].wave), (1, 0.0, &None));
    /// let downwind = Step::from_text("u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]")?;
    /// let singular = downwind.singular_steps("C", &SearchPlan::default())?;
    /// assert_eq!((singular[0].value, singular[0].wave.as_ref().unwrap().phases()), (0.5, &[std::f64::consts::PI][..]));
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
        let leading = self.leading()?;
        let mut found: Vec<SingularStep> = Vec::new();
        if self.names.letters().next().is_some() {
            return Ok(found);
        }
        let at_corners = (0..1usize << self.dimension).map(|corner| {
            let phase = |axis: usize| if corner >> axis & 1 == 1 { PI } else { 0.0 };
            let phases = (0..self.dimension).map(phase).collect();
            (at_corner(&leading, corner), Some(Wave::new(phases)))
        });
        for (polynomial, wave) in
            [(of_all_waves(&leading, variable), None)].into_iter().chain(at_corners)
        {
            for (value, exact) in zeros(&polynomial, variable, &plan.max) {
                if found.iter().all(|known| known.wave.is_some() || known.value != value) {
                    found.push(SingularStep { value, exact, wave: wave.clone() });
                }
            }
        }
        if self.dimension == 1
            && let Some(real) = centred(&leading)
        {
            let margin = margin_of(&real, &self.names, Some(variable), &Rational::one());
            let positive = search_within(&margin, &plan.max, &integer(0), plan);
            let limit = positive.limit();
            if limit.upper().is_finite()
                && limit.evidence() != Evidence::Undecided
                && found.iter().all(|known| known.value > limit.value() * (1.0 + 1e-9))
            {
                let exact = limit.exact().and_then(|exact| exact.as_fraction().cloned());
                found.push(SingularStep {
                    value: limit.value(),
                    exact,
                    wave: limit.critical_wave().cloned(),
                });
            }
        }
        found.sort_by(|a, b| a.value.total_cmp(&b.value));
        Ok(found)
    }

    /// Refuses a value at which the step cannot be solved for any wave.
    pub(crate) fn refuse_singular(
        &self,
        parameter: &str,
        value: &Rational,
    ) -> Result<(), SchemeError> {
        match self.leading()?.at_fraction(self.variable(parameter)?, value).is_zero() {
            true => Err(SchemeError::Singular { name: parameter.into(), value: to_text(value) }),
            false => Ok(()),
        }
    }

    /// The coefficient of the newest level: the determinant that a step divides by.
    fn leading(&self) -> Result<Laurent, SchemeError> {
        let coefficients = self.characteristic()?.coefficients(Variable::TIME);
        Ok(coefficients.last().cloned().unwrap_or_default())
    }
}

/// The zeros of a polynomial in a parameter within `[0, max]`, rounded, and exactly where they are fractions.
fn zeros(polynomial: &Laurent, variable: Variable, max: &Rational) -> Vec<(f64, Option<Rational>)> {
    let coefficients = polynomial.coefficients(variable);
    let constant = |c: &Laurent| Rational::from(c.as_constant().unwrap_or_default());
    let lowest = polynomial.range(variable).map_or(0, |(low, _)| low);
    let polynomial = Polynomial::new(coefficients.iter().map(constant).collect());
    let zero = (lowest > 0).then(|| (0.0, Some(Rational::zero())));
    let positive = real_roots(&polynomial, &Rational::zero(), max, BITS).into_iter().map(|root| {
        let simplest = simplest_between(&root.lower, &root.upper);
        let exact = polynomial.evaluate(&simplest).is_zero().then_some(simplest);
        (to_f64(exact.as_ref().unwrap_or(&root.upper)), exact)
    });
    zero.into_iter().chain(positive).collect()
}

/// What divides the coefficients of all waves.
fn of_all_waves(leading: &Laurent, variable: Variable) -> Laurent {
    let mut by_wave: BTreeMap<[i16; 3], Vec<(Exponents, BigInt)>> = BTreeMap::new();
    for (exponents, value) in leading.terms() {
        let mut rest = *exponents;
        let wave = [1, 2, 3].map(|axis| std::mem::take(&mut rest[axis]));
        by_wave.entry(wave).or_default().push((rest, value.clone()));
    }
    let common = common_divisor(by_wave.into_values().map(Laurent::new).collect());
    let low = |one: &Laurent| one.range(variable).map_or(0, |(low, _)| low);
    common.shifted(variable, low(leading) - low(&common))
}

/// The value where each shift is 1, or −1 along the axes of the corner.
fn at_corner(polynomial: &Laurent, corner: usize) -> Laurent {
    let terms = polynomial.terms().iter().map(|(exponents, value)| {
        let mut rest = *exponents;
        let odd = (0..3).filter(|axis| corner >> axis & 1 == 1 && rest[1 + axis] % 2 != 0).count();
        (1..4).for_each(|axis| rest[axis] = 0);
        (rest, if odd % 2 == 1 { -value } else { value.clone() })
    });
    Laurent::new(terms.collect())
}

/// Shifted so that it is real on every wave, if a shift does it, and positive for long waves at first.
fn centred(polynomial: &Laurent) -> Option<Laurent> {
    let (low, high) = polynomial.range(Variable::axis(0))?;
    let shifted = polynomial.shifted(Variable::axis(0), -(low + high) / 2);
    if !shifted.is_real() {
        return None;
    }
    let start = at_corner(&shifted, 0).terms().first().map(|(_, value)| value.clone())?;
    Some(if start.is_negative() { -shifted } else { shifted })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use std::f64::consts::FRAC_PI_2;

    fn singular(text: &str) -> Vec<SingularStep> {
        let plan = SearchPlan::default().up_to(integer(10));
        Step::from_text(text).unwrap().singular_steps("C", &plan).unwrap()
    }

    fn at(exact: Rational, phase: f64) -> SingularStep {
        SingularStep {
            value: to_f64(&exact),
            exact: Some(exact),
            wave: Some(Wave::new(vec![phase])),
        }
    }

    #[test]
    fn both_ends_of_the_phase_range_are_looked_at() {
        // 1 + C (E − 1): 1 − 2C for the shortest wave.
        let downwind = "u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]";
        assert_eq!(singular(downwind), [at(ratio(1, 2), PI)]);
        // cos² φ − C: a quarter of the circle at once, though at both ends only 1 is singular.
        let quarter = "(u[n+1,j+2] + 2*u[n+1,j] + u[n+1,j-2])/4 - C*u[n+1,j] = u[n,j]";
        let found = singular(quarter);
        assert_eq!((found[0].value, &found[0].exact), (0.0, &Some(integer(0))));
        assert!((found[0].wave.as_ref().unwrap().phases()[0] - FRAC_PI_2).abs() < 1e-6);
        assert_eq!(found[1..], [at(integer(1), 0.0), at(integer(1), PI)]);
        // (3s − 1)² + (5C − 4)², which boxes leave open about 4/5.
        let open = "17*u[n+1,j] - 6*(2*u[n+1,j] - u[n+1,j+1] - u[n+1,j-1])/4 \
                    + 9*(6*u[n+1,j] - 4*u[n+1,j+1] - 4*u[n+1,j-1] + u[n+1,j+2] + u[n+1,j-2])/16 \
                    - 40*C*u[n+1,j] + 25*C^2*u[n+1,j] = u[n,j]";
        let plan = SearchPlan { bits: 8, budget: 60, ..SearchPlan::default().up_to(integer(4)) };
        assert_eq!(Step::from_text(open).unwrap().singular_steps("C", &plan).unwrap(), []);
        // 2 − 2C − C E: the longest at 2/3 and the shortest at 2, ascending.
        let both = "2*u[n+1,j] - 2*C*u[n+1,j] - C*u[n+1,j+1] = u[n,j]";
        assert_eq!(singular(both), [at(ratio(2, 3), 0.0), at(integer(2), PI)]);
        // The same root for every wave is no fraction, and named once, without a wave.
        let [irrational] = &singular("(1 - 2*C^2)*u[n+1,j] = u[n,j]")[..] else { panic!() };
        assert!(irrational.wave.is_none() && irrational.exact.is_none());
        assert!((irrational.value - 0.5f64.sqrt()).abs() < 1e-15);
        // (1 − C)(2 − C E): every wave at 1, the longest at 2 as well.
        let every = SingularStep { wave: None, ..at(integer(1), 0.0) };
        let factors = "(1 - C)*(2*u[n+1,j] - C*u[n+1,j+1]) = u[n,j]";
        assert_eq!(singular(factors), [every, at(integer(2), 0.0)]);
        // Numbers that are no fractions are not looked into.
        assert_eq!(singular("(1 - sqrt(2)*C)*u[n+1,j] = u[n,j]"), []);
    }

    #[test]
    fn waves_between_are_found_where_the_leading_coefficient_is_real() {
        // ±(1 − 4C sin²φ), shifted or not.
        let second = "C*(u[n+1,j+2] - 2*u[n+1,j] + u[n+1,j-2])";
        for text in [
            format!("u[n+1,j] + {second} = u[n,j]"),
            format!("-u[n+1,j] - {second} = u[n,j]"),
            "u[n+1,j+1] + C*(u[n+1,j+3] - 2*u[n+1,j+1] + u[n+1,j-1]) = u[n,j]".into(),
        ] {
            let [only] = &singular(&text)[..] else { panic!("{text}") };
            assert_eq!((only.value, only.exact.clone()), (0.25, Some(ratio(1, 4))), "{text}");
            assert!((only.wave.clone().unwrap().phases()[0] - FRAC_PI_2).abs() < 1e-7, "{only:?}");
        }
        // C − s: every wave has its own singular value, from 0 on; the shortest has 1.
        let at_once = "C*u[n+1,j] + (u[n+1,j+1] - 2*u[n+1,j] + u[n+1,j-1])/4 = u[n,j]";
        assert_eq!(singular(at_once), [at(integer(0), 0.0), at(integer(1), PI)]);
        // 1 − C w(s), w = 9s − 8s²: the largest w, 81/32, is at s = 9/16, and w = 1 at the shortest wave.
        let two = "u[n+1,j] - C*(3/2*u[n+1,j] - 1/4*(u[n+1,j+1] + u[n+1,j-1]) - 1/2*(u[n+1,j+2] + u[n+1,j-2])) = u[n,j]";
        let [first, last] = &singular(two)[..] else { panic!() };
        assert_eq!((first.exact.clone(), last), (Some(ratio(32, 81)), &at(integer(1), PI)));
        let s = (0.5 * first.wave.clone().unwrap().phases()[0]).sin().powi(2);
        assert!((s - 9.0 / 16.0).abs() < 1e-7);
        // 1 + 2iC sin φ is real after no shift.
        let not_real = "u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j-1]) = u[n,j]";
        assert!(singular(not_real).is_empty());
    }

    #[test]
    fn what_can_always_be_solved_has_no_singular_step() {
        let explicit = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])";
        let implicit = "u[n+1,j] - C*(u[n+1,j+1] - 2*u[n+1,j] + u[n+1,j-1]) = u[n,j]";
        assert!(singular(explicit).is_empty() && singular(implicit).is_empty());
    }

    #[test]
    fn waves_of_two_dimensions_are_looked_at() {
        // (1 − 2C) for the wave of two cells along x, (1 − 4C) for the checkerboard, 1 − C for none.
        let text =
            "u[n+1,i,j] + C*(u[n+1,i+1,j] - u[n+1,i,j]) + C*(u[n+1,i,j+1] - u[n+1,i,j]) = u[n,i,j]";
        let found = singular(text);
        let waves: Vec<(f64, Vec<f64>)> = found
            .iter()
            .map(|one| (one.value, one.wave.as_ref().unwrap().phases().to_vec()))
            .collect();
        assert_eq!(waves[0], (0.25, vec![PI, PI]));
        assert_eq!(waves[1..], [(0.5, vec![PI, 0.0]), (0.5, vec![0.0, PI])]);
        let all = singular("(1 - C)*u[n+1,i,j] = u[n,i,j] + C*u[n,i-1,j-1]");
        assert!(
            all[0].value == 1.0
                && all[0].wave.is_none()
                && all.iter().all(|one| one.wave.is_none()),
            "{all:?}"
        );
        // Between the corners a wave is looked for on a line only.
        for axes in ["i,j+", "i+"] {
            let [there, back] = [axes.to_string(), axes.replace('+', "-")].map(|axes| {
                if axes.starts_with("i,") {
                    format!("u[n+1,{axes}2]")
                } else {
                    format!("u[n+1,{axes}2,j]")
                }
            });
            let between = format!("u[n+1,i,j] + C*({there} - 2*u[n+1,i,j] + {back}) = u[n,i,j]");
            assert_eq!(singular(&between), [], "{between}");
        }
        // Implicit, and never singular.
        let implicit = "u[n+1,i,j] - r*(u[n+1,i+1,j] + u[n+1,i-1,j] + u[n+1,i,j+1] + u[n+1,i,j-1] - 4*u[n+1,i,j]) = u[n,i,j]";
        assert!(
            Step::from_text(implicit)
                .unwrap()
                .singular_steps("r", &SearchPlan::default())
                .unwrap()
                .is_empty()
        );
    }
}
