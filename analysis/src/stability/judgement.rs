//! The verdict on a step in which everything has a value, in one to three dimensions.

use super::verdict::{Verdict, WEAK_GROWTH};
use super::{PointVerdict, Wave, decide_step_at, multiplicity_at};
use crate::exact::rational::{Rational, to_f64};
use crate::scheme::{SchemeError, Step};
use num_traits::Signed;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Phases from 0 to 2π along an axis, in one, two and three dimensions.
const PHASES: [usize; 3] = [256, 64, 24];

/// What becomes of the waves of one step.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// Whether a wave grows: decided in exact arithmetic. Whether values nearby are stable as well is not asked: [`Verdict::Marginal`]
    /// means a wave that grows like a power of the number of steps.
    pub verdict: Verdict,
    /// The largest `|z|` over waves of a grid, and the wave that the decision names as growing.
    pub largest: f64,
    /// The wave of the largest `|z|`.
    pub wave: Wave,
}

/// Whether `|z| ≤ 1 + growth` for every wave of a step, and the largest `|z|` that was seen.
///
/// ```
/// use courant_analysis::exact::rational::{integer, ratio};
/// use courant_analysis::scheme::Step;
/// use courant_analysis::stability::{judge, verdict::Verdict};
/// let donor = "u[n+1,i,j] = u[n,i,j] - C*(u[n,i,j] - u[n,i-1,j]) - C*(u[n,i,j] - u[n,i,j-1])";
/// let at = |c| judge(&Step::from_text(donor)?.with("C", &c)?, &integer(0));
/// assert_eq!(at(ratio(1, 2))?.verdict, Verdict::Stable);
/// let unstable = at(ratio(3, 4))?;
/// // 1 − 4C at the shortest wave of both axes.
/// assert_eq!((unstable.verdict, unstable.largest), (Verdict::Unstable, 2.0));
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
///
/// # Errors
/// When a parameter has no value.
pub fn judge(step: &Step, growth: &Rational) -> Result<Judgement, SchemeError> {
    let decided = decide_step_at(step, growth)?;
    let compiled = step.compile()?;
    let dimension = step.dimension();
    let phases = PHASES[dimension - 1];
    let grid = (0..phases.pow(dimension as u32)).into_par_iter().map(|mut number| {
        let mut along = || {
            let index = number % phases;
            number /= phases;
            // In (−π, π].
            let signed =
                if 2 * index > phases { index as f64 - phases as f64 } else { index as f64 };
            2.0 * PI * signed / phases as f64
        };
        (0..dimension).map(|_| along()).collect::<Vec<f64>>()
    });
    let of =
        |wave: &[f64]| compiled.multipliers(&[], wave).iter().map(|z| z.norm()).fold(0.0, f64::max);
    let gains: Vec<(f64, Vec<f64>)> = grid.map(|wave| (of(&wave), wave)).collect();
    let named = match &decided {
        PointVerdict::Unstable(wave) => Some((of(wave.phases()), wave.phases().to_vec())),
        _ => None,
    };
    // Of equal ones the first: the constant comes before all others.
    let (largest, wave) = gains
        .into_iter()
        .chain(named)
        .reduce(|most, next| if next.0 > most.0 { next } else { most })
        .expect("a grid has waves");
    let weak = largest - 1.0 <= WEAK_GROWTH.max(to_f64(growth));
    let verdict = match decided {
        PointVerdict::Undecided => Verdict::Undecided,
        PointVerdict::Unstable(_) if weak => Verdict::WeaklyUnstable,
        PointVerdict::Unstable(_) => Verdict::Unstable,
        PointVerdict::Stable if drifts(step, growth)? => Verdict::Marginal,
        PointVerdict::Stable => Verdict::Stable,
    };
    Ok(Judgement { verdict, largest, wave: Wave::new(wave) })
}

/// Whether a multiple multiplier grows like a power of the number of steps; known in one dimension and of exact coefficients.
fn drifts(step: &Step, growth: &Rational) -> Result<bool, SchemeError> {
    let is_asked = step.dimension() == 1 && !growth.is_positive();
    Ok(is_asked && multiplicity_at(step)?.growing.is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{integer, ratio};
    use std::f64::consts::FRAC_PI_2;

    fn judged(text: &str, value: Rational, growth: Rational) -> Judgement {
        judge(&Step::from_text(text).unwrap().with("C", &value).unwrap(), &growth).unwrap()
    }

    /// One multiplier, `C` for every wave.
    const FACTOR: &str = "u[n+1,j] = C*u[n,j]";

    #[test]
    fn the_largest_multiplier_is_that_of_the_formula() {
        let zero = || integer(0);
        let found = |text: &str, value| {
            let Judgement { verdict, largest, wave } = judged(text, value, zero());
            (verdict, largest, wave.phases().to_vec())
        };
        // |g|² = 1 − 4C (1 − C) s: the constant wave, or the shortest, which is π and not −π.
        let upwind = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])";
        assert_eq!(found(upwind, ratio(1, 2)), (Verdict::Stable, 1.0, vec![0.0]));
        assert_eq!(found(upwind, ratio(3, 2)), (Verdict::Unstable, 2.0, vec![PI]));
        // All waves alike: the first one, the constant.
        assert_eq!(found(FACTOR, integer(2)), (Verdict::Unstable, 2.0, vec![0.0]));
        assert_eq!(found(FACTOR, integer(1)), (Verdict::Stable, 1.0, vec![0.0]));
        // |g|² = 1 + C² (sin φ_x − sin φ_y)²: phases of opposite signs, none beyond ±π.
        let centred =
            "u[n+1,i,j] = u[n,i,j] - C/2*(u[n,i+1,j] - u[n,i-1,j]) + C/2*(u[n,i,j+1] - u[n,i,j-1])";
        let (verdict, largest, wave) = found(centred, ratio(1, 2));
        assert_eq!(verdict, Verdict::Unstable);
        assert!((largest - 2f64.sqrt()).abs() < 1e-14);
        assert!(wave[0] == -wave[1] && (wave[0].abs() - FRAC_PI_2).abs() < 1e-14, "{wave:?}");
    }

    #[test]
    fn a_wave_between_the_nodes_of_the_grid_is_the_one_that_was_proved_to_grow() {
        // g = 1 + C − 3 (s − 1/4)²: the band |s − 1/4| < 3.2e-3 holds no multiple of 2π/256.
        let text = "u[n+1,j] = (1 + C)*u[n,j] \
                    - 3/16*(3*u[n,j] - 2*u[n,j+1] - 2*u[n,j-1] + u[n,j+2] + u[n,j-2])";
        let found = judged(text, ratio(3, 100_000), integer(0));
        assert_eq!(found.verdict, Verdict::WeaklyUnstable);
        assert!(found.largest > 1.0 && found.largest <= 1.0 + 3.1e-5, "{found:?}");
        let s = (0.5 * found.wave.phases()[0]).sin().powi(2);
        assert!((s - 0.25).abs() < 3.2e-3, "{found:?}");
    }

    #[test]
    fn growth_is_weak_up_to_what_is_permitted_or_hardly_seen() {
        let verdict = |more: Rational, growth| judged(FACTOR, integer(1) + more, growth).verdict;
        // 2^−14 < 10^−4 < 2^−13.
        assert_eq!(verdict(ratio(1, 1 << 14), integer(0)), Verdict::WeaklyUnstable);
        assert_eq!(verdict(ratio(1, 1 << 13), integer(0)), Verdict::Unstable);
        // By less than a rounding beyond what is permitted, by a factor of two, and within it.
        let permitted = ratio(1, 1 << 9);
        let hardly = &permitted + ratio(1, 1 << 60);
        assert_eq!(verdict(hardly, permitted.clone()), Verdict::WeaklyUnstable);
        assert_eq!(verdict(ratio(1, 1 << 8), permitted.clone()), Verdict::Unstable);
        assert_eq!(verdict(permitted.clone(), permitted), Verdict::Stable);
    }

    #[test]
    fn multiple_multipliers_are_looked_for_in_one_dimension_where_nothing_may_grow() {
        let leapfrog = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])";
        let verdict = |text: &str, value, growth| judged(text, value, growth).verdict;
        assert_eq!(verdict(leapfrog, integer(1), integer(0)), Verdict::Marginal);
        assert_eq!(verdict(leapfrog, ratio(1, 2), integer(0)), Verdict::Stable);
        assert_eq!(verdict(leapfrog, integer(1), ratio(1, 10)), Verdict::Stable);
        let plane =
            "u[n+1,i,j] = u[n-1,i,j] - C*(u[n,i+1,j] - u[n,i-1,j]) - C*(u[n,i,j+1] - u[n,i,j-1])";
        assert_eq!(verdict(plane, ratio(1, 2), integer(0)), Verdict::Stable);
    }

    #[test]
    fn what_no_halving_of_waves_decides_is_not_called_stable() {
        // g = 1 − C ((3 s_x − 1)² + (3 s_y − 1)²) touches 1 at s_x = s_y = 1/3.
        let square = |e: fn(i32) -> String| {
            format!("22*u[n,i,j] - 12*({} + {}) + 9*({} + {})", e(1), e(-1), e(2), e(-2))
        };
        let x = square(|shift| format!("u[n,i+{shift},j]").replace("+-", "-"));
        let y = square(|shift| format!("u[n,i,j+{shift}]").replace("+-", "-"));
        let text = format!("u[n+1,i,j] = u[n,i,j] - C/16*({x} + {y})");
        let found = judged(&text, ratio(1, 8), integer(0));
        assert_eq!(found.verdict, Verdict::Undecided);
        assert!(found.largest <= 1.0 + 1e-15);
    }
}
