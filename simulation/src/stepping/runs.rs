//! Runs of many steps on one branch of one wave.

use super::propagator::{Propagator, WaveState};
use super::torus_scheme::Torus;
use num_complex::Complex64;
use serde::Serialize;

/// By how much runs may be off before they say nothing: no more steps are compared.
const LOOSEST_RUN: f64 = 1e-9;

/// A run of many steps, started on the branch of a predicted multiplier.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Run {
    /// Steps: fewer than wanted where round-off of faster branches covers the slower one.
    pub steps: usize,
    /// `|predicted multiplier|^steps`.
    pub predicted: f64,
    /// What the amplitude grew by.
    pub measured: f64,
    /// The distance of the amplitudes from the predicted ones, relative to them, phases included.
    pub error: f64,
    /// How large the error may be for round-off.
    pub tolerance: f64,
}

/// Runs on one torus.
pub(super) struct Runs<'a> {
    torus: &'a Torus<'a>,
    steps: usize,
    /// The largest norm of the first, second, … power of the step over all waves: how fast round-off grows anywhere.
    fastest: Vec<f64>,
}

impl<'a> Runs<'a> {
    pub fn new(torus: &'a Torus<'a>, waves: &[Propagator], steps: usize) -> Self {
        let mut fastest = vec![0.0_f64; steps];
        for wave in waves {
            for (most, norm) in fastest.iter_mut().zip(wave.norms_of_powers(steps)) {
                *most = most.max(norm);
            }
        }
        Self { torus, steps, fastest }
    }

    /// Starts on the branch of a multiplier and steps; `None` for a multiplier of zero.
    pub fn on_branch(
        &self,
        propagator: &Propagator,
        multiplier: Complex64,
        own_error: f64,
    ) -> Option<Run> {
        let start = propagator.branch(multiplier)?;
        let tolerances = self.tolerances(propagator, multiplier.norm(), own_error);
        let steps = tolerances.iter().take_while(|&&tolerance| tolerance <= LOOSEST_RUN).count();
        let tolerance = *tolerances.get(steps.checked_sub(1)?)?;
        let mut wave = WaveState::new(self.torus, &propagator.mode, &start);
        for _ in 0..steps {
            wave.step(self.torus);
        }
        let factor = multiplier.powu(steps as u32);
        let size = |of: &[Complex64]| of.iter().map(|a| a.norm_sqr()).sum::<f64>().sqrt();
        let end = wave.amplitudes(self.torus, &propagator.mode);
        let end: Vec<_> = end.into_iter().map(|(a, _)| a).collect();
        let away: Vec<_> =
            end.iter().zip(&start).map(|(end, start)| end - factor * start).collect();
        let measured = size(&end) / size(&start);
        let error = size(&away) / size(&start) / factor.norm();
        Some(Run { steps, predicted: factor.norm(), measured, error, tolerance })
    }

    /// What round-off may have made after `1, 2, …` steps, relative to a wave that every step multiplies by `gain`.
    ///
    /// Each step adds its error, proportional to what is there, and later steps carry it on: `Σ_t ‖A^{k−t}‖ ε u_{t−1}`, where `u` is the
    /// wave and what round-off has made of all others meanwhile.
    fn tolerances(&self, propagator: &Propagator, gain: f64, own_error: f64) -> Vec<f64> {
        // One error from the step, one from the multiplier that the start belongs to.
        let errors = propagator.errors.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
        let each = 4.0 * errors * (self.torus.cells() as f64).sqrt() + own_error;
        let own = propagator.norms_of_powers(self.steps);
        let mut there = vec![1.0];
        let mut tolerances = Vec::with_capacity(self.steps);
        for step in 1..=self.steps {
            let carried = |norms: &[f64]| -> f64 {
                there.iter().enumerate().map(|(t, there)| norms[step - 1 - t] * each * there).sum()
            };
            let wave = gain.powi(step as i32);
            tolerances.push(carried(&own) / wave);
            there.push(wave + carried(&self.fastest));
        }
        tolerances
    }
}
