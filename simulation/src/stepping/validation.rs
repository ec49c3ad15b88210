//! Predicted against measured: every wave of a torus, every branch.

use super::lattice::PerAxis;
use super::propagator::Propagator;
use super::rounded::largest;
use super::runs::{Run, Runs};
use super::torus_scheme::TorusScheme;
use super::{SteppingError, pairing};
use courant_analysis::waves::WavePolynomial;
use num_complex::Complex64;
use serde::Serialize;
use std::f64::consts::TAU;

/// What a validation runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ValidationPlan {
    /// Cells along each axis.
    pub points: Vec<usize>,
    /// Steps of the runs on each branch.
    pub steps: usize,
}

impl ValidationPlan {
    /// 32 cells, 12 × 10 or 6 × 5 × 4, of which no two axes are alike; 100 steps.
    ///
    /// # Panics
    /// For other dimensions than 1, 2 and 3.
    pub fn in_dimension(dimension: usize) -> Self {
        let points: [&[usize]; 3] = [&[32], &[12, 10], &[6, 5, 4]];
        Self { points: points[dimension - 1].to_vec(), steps: 100 }
    }
}

/// A multiplier by what it does to a wave.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Multiplier {
    /// Its modulus.
    pub gain: f64,
    /// Its argument in radians.
    pub phase: f64,
}

/// One branch of one wave.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Waves along each axis.
    pub mode: PerAxis<i64>,
    /// `2π mode_a/N_a`.
    pub phase: PerAxis<f64>,
    /// Which of the multipliers of this wave, from 0; followed from wave to wave.
    pub branch: usize,
    /// What was predicted.
    pub predicted: Multiplier,
    /// What the equations did.
    pub measured: Multiplier,
    /// `|measured − predicted|`.
    pub error: f64,
    /// How large the error may be for round-off.
    pub tolerance: f64,
    /// The run along this branch; `None` where round-off covers it within a step.
    pub run: Option<Run>,
}

/// Predicted against measured for all waves of a torus.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Validation {
    /// One row for each wave, of a wave and its conjugate one, and each branch.
    pub rows: Vec<Row>,
    /// Cells along each axis.
    pub cells: PerAxis<usize>,
    /// Steps of the runs.
    pub steps: usize,
    /// The largest error of a row.
    pub max_error: f64,
    /// The largest tolerance of a row; where a row fails, that of the row that fails by most.
    pub tolerance: f64,
    /// What the tolerances are, in words.
    pub tolerance_meaning: &'static str,
    /// Whether every row and every run agrees and no step made a wave of another.
    pub passed: bool,
    /// What failed first, in words.
    pub failure: Option<String>,
}

const TOLERANCE_MEANING: &str = "round-off of the step (running error analysis of its sums and of its solver) and of the predicted \
    coefficients, carried to each multiplier by its condition: some 1e-16 times the sum of absolute products where it is simple, \
    the m-th root of that where m multipliers meet";

/// Excites every wave of a torus and compares the multipliers that the running equations show with predicted ones.
///
/// `predicted` gives the characteristic polynomial of the wave of these phases, one for each axis. Its roots are compared one by one, and
/// its values on a circle with `det(z − A)` of what a step did: where multipliers meet, the polynomial keeps the digits that each of them
/// loses.
///
/// ```
/// use courant_analysis::scheme::{Step, language::parse};
/// use courant_simulation::stepping::{TorusScheme, ValidationPlan, validate};
/// let text = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])";
/// let leapfrog = TorusScheme::new(&parse(text)?, None, None, &[("C".into(), 0.5)])?;
/// let compiled = Step::from_text(text)?.compile()?;
/// let predicted = |phase: &[f64]| compiled.polynomial(&[0.5], phase);
/// let validation = validate(&leapfrog, predicted, &ValidationPlan::in_dimension(1))?;
/// assert!(validation.passed && validation.max_error < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the step is singular on the torus, or the torus has other axes than the scheme.
pub fn validate(
    scheme: &TorusScheme,
    predicted: impl Fn(&[f64]) -> WavePolynomial,
    plan: &ValidationPlan,
) -> Result<Validation, SteppingError> {
    let torus = scheme.torus(&plan.points)?;
    let rounding = torus.rounding();
    let modes = torus.lattice.modes();
    let propagators: Vec<_> = modes.iter().map(|mode| torus.propagator(mode, &rounding)).collect();
    let runs = Runs::new(&torus, &propagators, plan.steps);
    let mut rows: Vec<Row> = Vec::new();
    let mut last: Vec<Complex64> = Vec::new();
    let mut failure = None;
    for propagator in &propagators {
        if fails(propagator.other_waves, 1.0) {
            failure.get_or_insert(format!(
                "a step makes other waves of wave {}",
                propagator.mode.joined(", ")
            ));
        }
        let polynomial = predicted(&propagator.phase);
        let pairs = pairs(propagator, polynomial.multipliers());
        if !same_polynomial(propagator, &polynomial) {
            let mode = propagator.mode.joined(", ");
            failure.get_or_insert(format!("wave {mode}: the characteristic polynomial is another"));
        }
        let multipliers: Vec<_> = pairs.iter().map(|pair| pair.predicted).collect();
        // The order of the wave before.
        let order = pairing::nearest(&last, &multipliers);
        for (branch, &place) in order.iter().enumerate() {
            rows.extend(row(&runs, propagator, branch, &pairs[place]));
        }
        last = order.iter().map(|&place| multipliers[place]).collect();
    }
    Ok(summary(rows, torus.points().clone(), plan.steps, failure))
}

/// Whether `det(z − A)` is proportional to the predicted polynomial, at points on a circle around all multipliers.
fn same_polynomial(propagator: &Propagator, polynomial: &WavePolynomial) -> bool {
    let multipliers = polynomial.multipliers();
    // One has multipliers that vanish and the other has not.
    let power = multipliers.len() as i32 - propagator.matrix.len() as i32;
    let largest = multipliers.iter().map(|(z, _)| z.norm()).fold(0.0, f64::max);
    let radius = if largest > 0.0 { 1.25 * largest } else { 1.0 };
    let count = 2 * propagator.matrix.len() + 1;
    let points = (0..count).map(|k| Complex64::from_polar(radius, TAU * k as f64 / count as f64));
    // The quotient of the two at each point, and by how much of itself it may be off.
    let quotients: Option<Vec<(Complex64, f64)>> = points
        .map(|z| {
            let (measured, measured_error) = propagator.determinant(z)?;
            let (predicted, error) = polynomial.at(z);
            let quotient = measured * z.powi(power) / predicted;
            Some((quotient, measured_error + error / predicted.norm()))
        })
        .collect();
    // Where that says nothing or gives no number, the multipliers alone are compared.
    let Some([(first, first_error), rest @ ..]) = quotients.as_deref() else { return true };
    rest.iter().all(|(quotient, error)| {
        let away = (quotient / first - 1.0).norm();
        away <= error + first_error || away.is_nan()
    })
}

/// A predicted multiplier and the measured one that belongs to it.
struct Pair {
    predicted: Complex64,
    /// How far it may be off.
    own_error: f64,
    measured: Complex64,
}

/// The nearest to each other, both lists made as long as the longer one by zeros.
fn pairs(propagator: &Propagator, mut predicted: Vec<(Complex64, f64)>) -> Vec<Pair> {
    let mut measured = propagator.multipliers();
    let longer = predicted.len().max(measured.len());
    predicted.resize(longer, (Complex64::default(), 0.0));
    measured.resize(longer, Complex64::default());
    let multipliers: Vec<_> = predicted.iter().map(|(multiplier, _)| *multiplier).collect();
    let order = pairing::nearest(&multipliers, &measured);
    let both = predicted.into_iter().zip(order);
    both.map(|((predicted, own_error), place)| Pair {
        predicted,
        own_error,
        measured: measured[place],
    })
    .collect()
}

/// A row, unless both multipliers vanish.
fn row(runs: &Runs<'_>, propagator: &Propagator, branch: usize, pair: &Pair) -> Option<Row> {
    let error = (pair.measured - pair.predicted).norm();
    let tolerance = propagator.spread(pair.measured) + pair.own_error;
    if pair.predicted.norm() == 0.0 && error <= tolerance {
        return None;
    }
    let multiplier = |z: Complex64| Multiplier { gain: z.norm(), phase: z.arg() };
    Some(Row {
        mode: propagator.mode.clone(),
        phase: propagator.phase.clone(),
        branch,
        predicted: multiplier(pair.predicted),
        measured: multiplier(pair.measured),
        error,
        tolerance,
        run: runs.on_branch(propagator, pair.predicted, pair.own_error),
    })
}

impl Row {
    fn name(&self) -> String {
        format!("wave {}, branch {}", self.mode.joined(", "), self.branch)
    }
}

/// An error that is no number fails.
fn fails(error: f64, tolerance: f64) -> bool {
    error.is_nan() || tolerance.is_nan() || error > tolerance
}

fn summary(
    rows: Vec<Row>,
    cells: PerAxis<usize>,
    steps: usize,
    mut failure: Option<String>,
) -> Validation {
    let max_error = largest(rows.iter().map(|row| row.error));
    let mut tolerance = largest(rows.iter().map(|row| row.tolerance));
    let failing = rows.iter().filter(|row| fails(row.error, row.tolerance));
    let worst = failing.max_by(|a, b| (a.error / a.tolerance).total_cmp(&(b.error / b.tolerance)));
    if let Some(row) = worst {
        tolerance = row.tolerance;
        let message = format!("{}: the multiplier is another", row.name());
        failure.get_or_insert(message);
    }
    for row in &rows {
        if let Some(run) = row.run.filter(|run| fails(run.error, run.tolerance)) {
            let Run { steps, .. } = run;
            let message = format!("{}: the run of {steps} steps differs", row.name());
            failure.get_or_insert(message);
        }
    }
    let passed = failure.is_none();
    Validation {
        rows,
        cells,
        steps,
        max_error,
        tolerance,
        tolerance_meaning: TOLERANCE_MEANING,
        passed,
        failure,
    }
}
