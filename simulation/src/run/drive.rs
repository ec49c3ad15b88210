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
pub(crate) const SMALLEST_STEP: f64 = 1e-13;

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

#[cfg(test)]
mod tests {
    use super::{Evolution, drive};
    use crate::run::Reason;

    /// Steps of a given size that break at a given time.
    struct Clock {
        step: f64,
        now: f64,
        breaks_after: f64,
    }

    impl Evolution for Clock {
        fn time_step(&mut self) -> f64 {
            self.step
        }

        fn advance(&mut self, step: f64) -> Result<(), Reason> {
            self.now += step;
            if self.now > self.breaks_after {
                Err(Reason::NotFinite { particle: 7 })
            } else {
                Ok(())
            }
        }
    }

    fn clock(step: f64) -> Clock {
        Clock { step, now: 0.0, breaks_after: f64::INFINITY }
    }

    #[test]
    fn it_ends_at_the_end() {
        // 0.1 is not a binary fraction: ten of it miss 1 by round-off, and no sliver follows.
        assert_eq!(drive(&mut clock(0.1), 1.0, 100), (10, 1.0, None));
        assert_eq!(drive(&mut clock(0.3), 1.0, 100), (4, 1.0, None));
        assert_eq!(drive(&mut clock(f64::INFINITY), 1.0, 100), (1, 1.0, None));
    }

    #[test]
    fn failures_say_when_and_why() {
        let (steps, time, failure) = drive(&mut clock(0.1), 1.0, 5);
        let failure = failure.expect("5 steps do not suffice");
        assert_eq!(failure.reason, Reason::StepLimit { limit: 5 });
        assert!(steps == 6 && (time - 0.5).abs() < 1e-15);
        for bad in [f64::NAN, 0.0, 1e-20, -1.0] {
            let (_, _, failure) = drive(&mut clock(bad), 1.0, 5);
            assert!(matches!(failure.expect("bad").reason, Reason::TimeStep { .. }));
        }
        let mut breaking = Clock { breaks_after: 0.25, ..clock(0.1) };
        let (steps, time, failure) = drive(&mut breaking, 1.0, 100);
        assert_eq!((steps, failure.expect("it breaks").step), (3, 3));
        assert!((time - 0.3).abs() < 1e-15);
        assert_eq!(
            failure.expect("it breaks").to_string(),
            "not a number at particle 7 in step 3 at time 0.300000"
        );
    }
}
