//! The verdict on one choice of the Courant number.

use crate::exact::rational::{Rational, from_f64, integer, to_f64};
use crate::scheme::symbol::EnclosedSymbol;
use crate::stability::margin::Margin;
use crate::stability::{Limit, StableSet, monotonicity_limit, stable_set};
use crate::waves::growth::{Extremum, PhaseTable};
use num_traits::{Signed, Zero};
use std::f64::consts::LN_2;

/// Growth per step up to which an instability is called weak: doubling takes more than 6900 steps.
pub const WEAK_GROWTH: f64 = 1e-4;

/// What becomes of the waves at a Courant number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// No wave grows, and the Courant number may be raised a little without any wave growing.
    Stable,
    /// No wave grows, but the Courant number lies on the limit (or closer to it than it is known).
    Marginal,
    /// A wave grows, by at most [`WEAK_GROWTH`] per step.
    WeaklyUnstable,
    /// A wave grows.
    Unstable,
}

impl Verdict {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Marginal => "marginal",
            Self::WeaklyUnstable => "weakly-unstable",
            Self::Unstable => "unstable",
        }
    }

    /// Whether no wave grows.
    pub fn is_stable(self) -> bool {
        matches!(self, Self::Stable | Self::Marginal)
    }
}

/// All that is known about one Courant number.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// The verdict, decided exactly.
    pub verdict: Verdict,
    /// Whether every coefficient is non-negative, decided exactly.
    pub monotone: bool,
    /// The wave that grows most (or the one that does nothing, `φ = 0`, when none grows).
    pub strongest: Extremum,
    /// Steps until the strongest wave has doubled; `None` when none grows.
    pub steps_to_double: Option<f64>,
    /// All stable Courant numbers.
    pub stable_set: StableSet,
    /// The monotonicity limit.
    pub monotonicity: Limit,
}

impl Check {
    /// The phase of the wave that grows, or that binds the limit when none grows.
    pub fn critical_phase(&self) -> Option<f64> {
        if self.verdict.is_stable() {
            self.stable_set.limit().critical_phase()
        } else {
            Some(self.strongest.phase)
        }
    }
}

/// Judges a positive Courant number. The stable set is searched up to `max_courant` or four times the
/// Courant number, whichever is more.
///
/// ```
/// use courant_analysis::{kernel::Kernel, exact::rational::{integer, ratio}, stability::verdict::{Verdict, check}};
/// use courant_analysis::scheme::{AdvectionScheme, Discretisation, Scheme};
/// let scheme = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::Gaussian, integer(1)).unwrap();
/// let verdict = |courant| check(&scheme.symbol(), &courant, &integer(10)).verdict;
/// assert_eq!(verdict(ratio(11, 10)), Verdict::Stable);
/// assert_eq!(verdict(ratio(12, 10)), Verdict::Unstable);   // the value printed in the literature
/// ```
pub fn check(symbol: &EnclosedSymbol, courant: &Rational, max_courant: &Rational) -> Check {
    let range = max_courant.clone().max(courant * integer(4));
    let stable_set = stable_set(symbol, &Rational::zero(), &range);
    let monotonicity = monotonicity_limit(symbol, &range);
    let table = PhaseTable::new(Margin::new(symbol, &Rational::zero()).compile(), 1000);
    let (strongest, _) = table.extrema(to_f64(courant), &mut Vec::new());
    let verdict = verdict(&stable_set, courant, strongest.growth);
    let growing = !verdict.is_stable() && strongest.growth > 0.0;
    let steps_to_double = growing.then(|| LN_2 / strongest.growth.ln_1p());
    Check {
        verdict,
        monotone: is_monotone(symbol, courant),
        strongest,
        steps_to_double,
        stable_set,
        monotonicity,
    }
}

fn verdict(set: &StableSet, courant: &Rational, growth: f64) -> Verdict {
    let on_an_end = |limit: &Limit| match limit.exact().and_then(|exact| exact.as_fraction()) {
        Some(exact) => exact == courant && courant.is_positive(),
        None => {
            let within = |bound: f64, below: bool| {
                from_f64(bound).is_some_and(|b| if below { b <= *courant } else { *courant <= b })
            };
            within(limit.lower(), true) && within(limit.upper(), false)
        }
    };
    if set.neutral {
        return Verdict::Marginal;
    }
    if set.intervals.iter().any(|interval| on_an_end(&interval.from) || on_an_end(&interval.to)) {
        Verdict::Marginal
    } else if set.contains(courant) {
        Verdict::Stable
    } else if growth <= WEAK_GROWTH {
        Verdict::WeaklyUnstable
    } else {
        Verdict::Unstable
    }
}

/// Whether every coefficient is non-negative at this Courant number, beyond the uncertainty of the data.
fn is_monotone(symbol: &EnclosedSymbol, courant: &Rational) -> bool {
    let Some((low, high)) = symbol.center().reach() else { return true };
    let mut power = integer(1);
    let mut radius = Rational::zero();
    for (even, odd) in symbol.even_radius().iter().zip(symbol.odd_radius()) {
        radius += (even + odd) * &power;
        power *= courant;
    }
    let mut coefficients = (low..=high).map(|offset| symbol.center().coefficient(offset));
    coefficients.all(|c| {
        let value = c.evaluate(courant);
        c.degree().is_none() || value.is_zero() && radius.is_zero() || value > radius
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use crate::kernel::Kernel;
    use crate::scheme::{AdvectionScheme, Discretisation, Scheme};

    fn judge(scheme: AdvectionScheme, kernel: Kernel, l: Rational, courant: Rational) -> Check {
        let symbol = Discretisation::new(scheme, kernel, l).unwrap().symbol();
        check(&symbol, &courant, &integer(20))
    }

    #[test]
    fn the_exact_shift_is_marginal_and_monotone() {
        let found = judge(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(1), integer(1));
        assert_eq!((found.verdict, found.monotone), (Verdict::Marginal, true));
        assert_eq!(found.strongest.growth, 0.0);
        assert_eq!(found.steps_to_double, None);
    }

    #[test]
    fn the_limit_itself_is_marginal_and_a_hair_above_is_unstable() {
        let godunov = |c| judge(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(2), c);
        assert_eq!(godunov(ratio(15, 8)).verdict, Verdict::Marginal);
        let above = godunov(ratio(15, 8) + ratio(1, 1_000_000));
        assert_eq!(above.verdict, Verdict::WeaklyUnstable);
        assert!(above.strongest.growth > 0.0 && above.steps_to_double.is_some());
        assert_eq!(godunov(ratio(18, 10)).verdict, Verdict::Stable);
    }

    #[test]
    fn steps_to_double_double() {
        let found = judge(AdvectionScheme::GodunovSph, Kernel::Gaussian, integer(1), ratio(12, 10));
        assert_eq!((found.verdict, found.monotone), (Verdict::Unstable, false));
        let steps = found.steps_to_double.unwrap();
        assert!(((1.0 + found.strongest.growth).powf(steps) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn lax_wendroff_with_the_cut_gaussian_is_weakly_unstable() {
        let found =
            judge(AdvectionScheme::LaxWendroffSph, Kernel::Gaussian, integer(3), integer(2));
        assert_eq!(found.verdict, Verdict::WeaklyUnstable);
        assert!(found.strongest.growth > 0.0 && found.strongest.growth < 1e-4);
    }

    #[test]
    fn monotone_exactly_up_to_the_limit() {
        let godunov = |c| judge(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(2), c);
        assert!(godunov(ratio(8, 5)).monotone);
        assert!(!godunov(ratio(8, 5) + ratio(1, 1 << 40)).monotone);
    }
}
