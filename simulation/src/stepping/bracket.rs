//! Limits confirmed by runs from noise.

use super::SteppingError;
use super::torus_scheme::{Torus, TorusScheme};
use crate::advection::SplitMix64;
use serde::Serialize;

/// Values that have grown by so much, and still grow, blow up.
const GROWN: f64 = 1e4;

/// What runs from noise are allowed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoisePlan {
    /// Cells along each axis: a wave that binds must be near one of the waves of this torus.
    pub points: Vec<usize>,
    /// A run that has not grown by then is bounded.
    pub most_steps: usize,
}

impl NoisePlan {
    /// 64 cells, 16 × 16 or 8 × 8 × 8, 16384 steps.
    ///
    /// # Panics
    /// For other dimensions than 1, 2 and 3.
    pub fn in_dimension(dimension: usize) -> Self {
        let along = [64, 16, 8][dimension - 1];
        Self { points: vec![along; dimension], most_steps: 16_384 }
    }
}

/// One run from noise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NoiseRun {
    /// The value of the parameter.
    pub value: f64,
    /// Steps made: a run that grows ends early.
    pub steps: usize,
    /// The largest value at the end, relative to the start.
    pub growth: f64,
    /// Growth per step over the second half of the run, less what a power of the steps may make of it: positive where the growth is
    /// exponential.
    pub rate: f64,
    /// Whether it blew up.
    pub grew: bool,
}

/// A limit between a value whose run stays bounded and one whose run grows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bracket {
    /// The largest value below the limit that was run.
    pub below: NoiseRun,
    /// The smallest value above it whose run grew; the nearest that was tried where none did.
    pub above: NoiseRun,
    /// Whether the run below is bounded and the one above grew.
    pub confirmed: bool,
}

/// Runs from noise below a limit and above it, at a tenth, a hundredth, … of the limit as long as the two sides can be told apart.
///
/// ```
/// use courant_analysis::scheme::language::parse;
/// use courant_simulation::stepping::{NoisePlan, TorusScheme, bracket_limit};
/// let upwind = parse("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
/// let scheme_at = |value| TorusScheme::new(&upwind, None, None, &[("C".into(), value)]);
/// let bracket = bracket_limit(scheme_at, 1.0, &NoisePlan::in_dimension(1))?;
/// assert!(bracket.confirmed && bracket.above.value - bracket.below.value < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the scheme cannot be run at one of the values.
pub fn bracket_limit(
    scheme_at: impl Fn(f64) -> Result<TorusScheme, SteppingError>,
    limit: f64,
    plan: &NoisePlan,
) -> Result<Bracket, SteppingError> {
    let at = |distance: f64| -> Result<Bracket, SteppingError> {
        let run = |value: f64| {
            scheme_at(value)?.torus(&plan.points).map(|t| noise_run(&t, value, plan.most_steps))
        };
        let (below, above) = (run(limit * (1.0 - distance))?, run(limit * (1.0 + distance))?);
        Ok(Bracket { below, above, confirmed: !below.grew && above.grew })
    };
    let mut best = at(0.1)?;
    for power in 2..=4 {
        // What grows below a limit contradicts it.
        if best.below.grew {
            break;
        }
        let nearer = at(10f64.powi(-power))?;
        if best.confirmed && !nearer.confirmed && !nearer.below.grew {
            // The run above is too slow to be told from a bounded one.
            break;
        }
        best = nearer;
    }
    Ok(best)
}

/// Starts from noise in all arrays of the history and steps until the values have grown beyond doubt, or to the end.
pub fn noise_run(torus: &Torus<'_>, value: f64, most_steps: usize) -> NoiseRun {
    let mut random = SplitMix64::new(0x006e_6f69_7365);
    let mut state: Vec<Vec<f64>> = (0..torus.history())
        .map(|_| (0..torus.cells()).map(|_| random.symmetric()).collect())
        .collect();
    let norm = |state: &[Vec<f64>]| -> f64 {
        state
            .iter()
            .flatten()
            .fold(0.0, |most: f64, x| if x.abs() > most || x.is_nan() { x.abs() } else { most })
    };
    let start = norm(&state);
    let mut growths = vec![1.0];
    for _ in 0..most_steps {
        torus.step(&mut state);
        let growth = norm(&state) / start;
        growths.push(growth);
        // Far enough for the second half to show how it grows; what is no number ends too.
        if growth.is_nan() || growth > GROWN.powi(3) {
            break;
        }
    }
    let steps = growths.len() - 1;
    let growth = growths[steps];
    // Over the second half; n^3 at most, as of three multipliers that meet, is no exponential growth.
    let half = (steps / 2).max(1);
    let rate = ((growth / growths[steps - half]).ln() - 3.0 * std::f64::consts::LN_2) / half as f64;
    let grew = !growth.is_finite() || (growth > GROWN && rate > 0.0);
    NoiseRun { value, steps, growth, rate, grew }
}
