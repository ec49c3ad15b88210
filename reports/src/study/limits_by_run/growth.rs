//! Whether a running scheme grows: noise as seed, growth told from transients.

use courant_simulation::advection::{Discretisation, LatticePath, SplitMix64, Stepper};

/// The seed of the noise that runs start from.
const SEED: u64 = 20_080_101;

/// Rates below this, per step, are rounding: a norm over a window is right to about `1e-15`.
const RESOLUTION: f64 = 1e-13;

/// Windows from which the rate can be told to have settled.
const FEWEST_WINDOWS: usize = 5;

/// How a growth measurement is done.
#[derive(Debug, Clone, Copy)]
pub(super) struct GrowthPlan {
    /// How many windows of steps, at most where the run may stop early; at least five.
    pub windows: usize,
    /// Steps in each window.
    pub steps_per_window: u64,
    /// Whether to stop once the rate per window has settled to a hundredth of itself.
    pub stop_when_settled: bool,
}

/// What a scheme does in the long run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GrowthVerdict {
    /// The last window grew: on a lattice it then grows for ever.
    Growing,
    /// The last window neither grew nor decayed by more than rounding.
    Neutral,
    /// The last window decayed.
    Decaying,
}

/// A growth measurement.
#[derive(Debug)]
pub(super) struct Growth {
    pub verdict: GrowthVerdict,
    /// The factor per step over the last window, or of the mean if that is larger. Infinite when the
    /// values overflowed within one window.
    pub gain_per_step: f64,
    /// The factor per step of the mean, which is watched apart: constants are an eigenvector of a step on a lattice, and a
    /// mean that merely stays would hide that all else decays.
    pub mean_gain: f64,
    /// Steps done.
    pub steps: u64,
}

/// Steps noise on a uniform lattice: uniform in `[−1, 1)`, its mean taken off.
pub(super) fn noise_growth(
    case: &Discretisation,
    courant_number: f64,
    particles: usize,
    plan: &GrowthPlan,
) -> Growth {
    let mut stepper = LatticePath::new(case, courant_number, particles);
    let mut random = SplitMix64::new(SEED);
    let mut values: Vec<f64> = (0..particles).map(|_| random.symmetric()).collect();
    remove_mean(&mut values);
    stepper.set_state(&values);
    measure_growth(&mut stepper, plan)
}

/// Steps from the present state and watches the root-mean-square norm window by window.
///
/// On a uniform lattice, for which this is, the modes are orthogonal, so `ln` of the norm is a convex function of the step
/// count: a norm that grows once grows for ever, and the rate of a window never exceeds that of the
/// fastest mode, which it approaches. The state is scaled by powers of two between windows, so that neither overflow nor
/// underflow ends a run.
fn measure_growth(stepper: &mut dyn Stepper, plan: &GrowthPlan) -> Growth {
    assert!(plan.windows >= FEWEST_WINDOWS && plan.steps_per_window > 0, "too short a plan");
    let mut values = stepper.state().to_vec();
    stepper.set_state(&vec![1.0; values.len()]);
    stepper.step();
    let mean_gain = mean(stepper.state()).abs();
    let mut steps = 0;
    let mut rates = Vec::with_capacity(plan.windows);
    for _ in 0..plan.windows {
        remove_mean(&mut values);
        let before = norm(&values);
        if before == 0.0 {
            rates.push(f64::NEG_INFINITY);
            break;
        }
        let scale = (-before.log2().round()).exp2();
        values.iter_mut().for_each(|value| *value *= scale);
        let before = norm(&values);
        stepper.set_state(&values);
        for _ in 0..plan.steps_per_window {
            stepper.step();
        }
        steps += plan.steps_per_window;
        values.copy_from_slice(stepper.state());
        let after = norm(&values);
        let change = if after.is_finite() { (after / before).ln() } else { f64::INFINITY };
        rates.push(change / plan.steps_per_window as f64);
        if change.is_infinite() || (plan.stop_when_settled && is_settled(&rates)) {
            break;
        }
    }
    let fastest = rates.last().copied().unwrap_or(0.0);
    // The mean of a scheme that keeps constants stays but for rounding: it counts only where it grows.
    let mean_rate = Some(mean_gain.ln()).filter(|&rate| rate > RESOLUTION);
    let verdict = if mean_rate.is_some() || fastest > RESOLUTION {
        GrowthVerdict::Growing
    } else if fastest < -RESOLUTION {
        GrowthVerdict::Decaying
    } else {
        GrowthVerdict::Neutral
    };
    let gain_per_step = mean_rate.map_or(fastest, |rate| rate.max(fastest)).exp();
    Growth { verdict, gain_per_step, mean_gain, steps }
}

/// Whether the rates of the windows have come within a hundredth of where they lead.
///
/// With two modes left, the rate approaches that of the faster one with increments that shrink by one
/// factor, and the increments to come add up to a geometric series.
fn is_settled(rates: &[f64]) -> bool {
    let [.., before, middle, last] = *rates else { return false };
    if rates.len() < FEWEST_WINDOWS {
        return false;
    }
    let (first, second) = (middle - before, last - middle);
    let to_come = match second / first {
        shrinking if shrinking > 0.0 && shrinking < 1.0 => second * shrinking / (1.0 - shrinking),
        // Increments that no longer shrink are rounding, or the beginning.
        _ => 100.0 * second,
    };
    to_come.abs() <= (0.01 * last.abs()).max(RESOLUTION)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn remove_mean(values: &mut [f64]) {
    let mean = mean(values);
    values.iter_mut().for_each(|value| *value -= mean);
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `u ← g u`.
    struct Factor(f64, Vec<f64>);

    impl Stepper for Factor {
        fn step(&mut self) {
            self.1.iter_mut().for_each(|value| *value *= self.0);
        }
        fn state(&self) -> &[f64] {
            &self.1
        }
        fn set_state(&mut self, values: &[f64]) {
            self.1 = values.to_vec();
        }
        fn interactions_per_step(&self) -> u64 {
            1
        }
    }

    #[test]
    fn growth_is_told_from_what_stays_and_decays() {
        let plan = GrowthPlan { windows: 100, steps_per_window: 20, stop_when_settled: false };
        for (factor, verdict) in [
            (0.99, GrowthVerdict::Decaying),
            (0.0, GrowthVerdict::Decaying),
            (1.0, GrowthVerdict::Neutral),
            (1.001, GrowthVerdict::Growing),
            (1e300, GrowthVerdict::Growing),
        ] {
            let growth = measure_growth(&mut Factor(factor, vec![0.3, 1.0, -0.2]), &plan);
            assert_eq!(growth.verdict, verdict, "{factor}");
            let gain = if factor > 1e9 { f64::INFINITY } else { factor };
            assert!(growth.gain_per_step == gain || (growth.gain_per_step - gain).abs() < 1e-14);
        }
    }
}
