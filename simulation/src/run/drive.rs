//! The time loop that all methods share.

use super::{Failure, Reason};

/// A state that advances in time.
pub(crate) trait Evolution {
    /// The largest step the method takes from here. It may prepare what the step needs.
    fn time_step(&mut self) -> f64;
    /// Advances by `step`.
    fn advance(&mut self, step: f64) -> Result<(), Reason>;
}

/// A step below this part of the end time is lost in the rounding of the time.
const SMALLEST_STEP: f64 = 1e-13;

/// Advances to `end_time` exactly: the number of steps, the time reached, and the failure if any.
pub(crate) fn drive(
    evolution: &mut impl Evolution,
    end_time: f64,
    limit: usize,
) -> (usize, f64, Option<Failure>) {
    let (mut time, mut step) = (0.0, 0);
    while time < end_time {
        step += 1;
        let wanted = evolution.time_step();
        let broken = |reason, time| (step, time, Some(Failure { reason, time, step }));
        if wanted.is_nan() || wanted < SMALLEST_STEP * end_time {
            return broken(Reason::TimeStep { value: wanted }, time);
        }
        if step > limit {
            return broken(Reason::StepLimit { limit }, time);
        }
        // A last step that is a sliver would be all rounding: end exactly instead.
        let last = time + wanted * (1.0 + 1e-9) >= end_time;
        let size = if last { end_time - time } else { wanted };
        let result = evolution.advance(size);
        time = if last { end_time } else { time + size };
        if let Err(reason) = result {
            return broken(reason, time);
        }
    }
    (step, time, None)
}
