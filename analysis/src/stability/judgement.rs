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
