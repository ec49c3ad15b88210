//! The time loop of every run.

use crate::run::{Failure, InvalidOptions, Reason};
use std::ops::ControlFlow;

/// A state that advances in time.
pub trait Evolution {
    /// The largest step the method takes from here. It may prepare what the step needs.
    ///
    /// # Errors
    /// What is wrong with the present state.
    fn time_step(&mut self) -> Result<f64, Reason>;

    /// Advances by a step no longer than [`time_step`](Self::time_step) said.
    ///
    /// # Errors
    /// What broke. The state is then the one before the step, unless [`divisible`](Self::divisible)
    /// is false.
    fn advance(&mut self, step: f64) -> Result<(), Reason>;

    /// Whether a step that broke may be repeated with half of it: not where the length is fixed.
    fn divisible(&self) -> bool {
        true
    }
}

/// Steps after which a run is given up, rejected ones included: nobody waits for more.
pub const MOST_STEPS: usize = 1_000_000;

/// Refuses a run that would need more steps of the size of the first than [`MOST_STEPS`].
///
/// # Errors
/// [`InvalidOptions::TooMuch`] with the number needed. A first step that is no step is told by the [`march`], as a failure.
pub fn refuse_too_many<E: Evolution + ?Sized>(
    evolution: &mut E,
    end_time: f64,
) -> Result<(), InvalidOptions> {
    let needed = evolution.time_step().map_or(0.0, |step| end_time / step);
    if needed.is_finite() && needed > MOST_STEPS as f64 {
        let what = "steps of the size of the first";
        return Err(InvalidOptions::TooMuch { what, needed, most: MOST_STEPS });
    }
    Ok(())
}

/// How far a march came.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct March {
    /// The time reached: the end time exactly, unless the march broke or was cancelled.
    pub time: f64,
    /// How many steps were taken.
    pub steps: usize,
    /// How many were rejected and repeated with half their length.
    pub rejected: usize,
    /// Why, when and where it broke.
    pub failure: Option<Failure>,
    /// Whether the observer ended it.
    pub cancelled: bool,
}

/// A step below this part of the end time is lost in the rounding of the time.
const SMALLEST_STEP: f64 = 1e-13;

/// A step is halved so often at most: a billionth of what the method wanted will not help either.
const MOST_HALVINGS: u32 = 30;

/// Advances to `end_time`; after every step `observe(state, time)` may end the march.
///
/// The last two steps are equal, so that none is a sliver, all rounding. A step that breaks is repeated with half of it.
/// Steps are summed with compensation: a thousand steps of a thousandth are the whole.
///
/// ```
/// use courant_simulation::march::{Evolution, march};
/// use courant_simulation::run::Reason;
/// use std::ops::ControlFlow;
/// struct Decay(f64);
/// impl Evolution for Decay {
///     fn time_step(&mut self) -> Result<f64, Reason> {
///         Ok(0.1)
///     }
///     fn advance(&mut self, step: f64) -> Result<(), Reason> {
///         self.0 *= 1.0 - step;
///         Ok(())
///     }
/// }
/// let mut state = Decay(1.0);
/// let end = march(&mut state, 1.0, 100, |_, _| ControlFlow::Continue(()));
/// assert_eq!((end.time, end.steps, end.failure), (1.0, 10, None));
/// assert!((state.0 - 0.9_f64.powi(10)).abs() < 1e-15);
/// ```
pub fn march<E: Evolution + ?Sized>(
    evolution: &mut E,
    end_time: f64,
    most_steps: usize,
    mut observe: impl FnMut(&E, f64) -> ControlFlow<()>,
) -> March {
    let mut march = March { time: 0.0, steps: 0, rejected: 0, failure: None, cancelled: false };
    // What the sum of the steps has too much because of its rounding.
    let mut excess = 0.0;
    while march.time < end_time {
        let left = (end_time - march.time) + excess;
        let taken = evolution
            .time_step()
            .and_then(|wanted| next_step(left, wanted, end_time))
            .and_then(|step| take(evolution, step, most_steps, &mut march));
        match taken {
            Ok(step) if step == left => march.time = end_time,
            Ok(step) => {
                let part = step - excess;
                let time = march.time + part;
                excess = (time - march.time) - part;
                march.time = time;
            }
            Err(reason) => {
                let (time, step) = (march.time, march.steps + 1);
                march.failure = Some(Failure { reason, time, step });
                break;
            }
        }
        march.steps += 1;
        if observe(evolution, march.time).is_break() && march.time < end_time {
            march.cancelled = true;
            break;
        }
    }
    march
}

/// The step to take where the method wants `wanted` and `left` is left.
fn next_step(left: f64, wanted: f64, end_time: f64) -> Result<f64, Reason> {
    if wanted.is_nan() || wanted < SMALLEST_STEP * end_time {
        return Err(Reason::TimeStep { value: wanted });
    }
    // Equal steps miss the end by round-off.
    let most = wanted * (1.0 + 1e-9) + 4.0 * f64::EPSILON * end_time;
    Ok(if left <= most {
        left
    } else if left <= 2.0 * wanted {
        0.5 * left
    } else {
        wanted
    })
}

/// Takes a step, or half of it, or half of that; the one taken.
fn take<E: Evolution + ?Sized>(
    evolution: &mut E,
    mut step: f64,
    most_steps: usize,
    march: &mut March,
) -> Result<f64, Reason> {
    let mut halvings = 0;
    loop {
        if march.steps + march.rejected >= most_steps {
            return Err(Reason::StepLimit { limit: most_steps });
        }
        match evolution.advance(step) {
            Ok(()) => return Ok(step),
            Err(reason) if halvings == MOST_HALVINGS || !evolution.divisible() => {
                return Err(reason);
            }
            Err(_) => {
                halvings += 1;
                march.rejected += 1;
                step *= 0.5;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of a given size that break beyond a time, or where they are longer than a size.
    struct Clock {
        step: f64,
        now: f64,
        breaks_after: f64,
        longest: f64,
        divisible: bool,
    }

    impl Evolution for Clock {
        fn time_step(&mut self) -> Result<f64, Reason> {
            Ok(self.step)
        }

        fn advance(&mut self, step: f64) -> Result<(), Reason> {
            if self.now + step > self.breaks_after || step > self.longest {
                return Err(Reason::NotFinite { particle: 7 });
            }
            self.now += step;
            Ok(())
        }

        fn divisible(&self) -> bool {
            self.divisible
        }
    }

    fn clock(step: f64) -> Clock {
        let (breaks_after, longest) = (f64::INFINITY, f64::INFINITY);
        Clock { step, now: 0.0, breaks_after, longest, divisible: true }
    }

    fn run(clock: &mut Clock, steps: usize) -> March {
        march(clock, 1.0, steps, |_, _| ControlFlow::Continue(()))
    }

    #[test]
    fn it_ends_at_the_end_without_a_sliver() {
        // 0.1 is not a binary fraction: ten of it miss 1 by round-off.
        for (step, steps) in [(0.1, 10), (0.3, 4), (f64::INFINITY, 1), (1e-5, 100_000)] {
            let end = run(&mut clock(step), 1_000_000);
            assert_eq!((end.steps, end.time, end.failure), (steps, 1.0, None));
        }
        let mut lengths = Vec::new();
        march(&mut clock(0.3), 1.0, 9, |state, _| {
            lengths.push(state.now);
            ControlFlow::Continue(())
        });
        assert!((lengths[3] - lengths[2] - 0.2).abs() < 1e-15, "{lengths:?}");
    }

    #[test]
    fn failures_say_when_and_why() {
        let end = run(&mut clock(0.1), 5);
        let failure = end.failure.expect("5 steps do not suffice");
        assert_eq!(failure.reason, Reason::StepLimit { limit: 5 });
        assert!(end.steps == 5 && (end.time - 0.5).abs() < 1e-15);
        for bad in [f64::NAN, 0.0, 1e-20, -1.0] {
            let failure = run(&mut clock(bad), 5).failure.expect("a bad step");
            assert!(matches!(failure.reason, Reason::TimeStep { .. }));
        }
        let mut breaking = Clock { breaks_after: 0.25, divisible: false, ..clock(0.1) };
        let end = run(&mut breaking, 100);
        assert_eq!((end.steps, end.rejected), (2, 0));
        assert_eq!(
            end.failure.expect("it breaks").to_string(),
            "not a number at particle 7 in step 3 at time 0.200000"
        );
    }

    #[test]
    fn a_step_that_breaks_is_repeated_with_half() {
        let end = run(&mut Clock { longest: 0.03, ..clock(0.1) }, 1000);
        // 0.1 and 0.05 break, 0.025 is taken; 37 times. The last 0.075 are taken in quarters.
        assert_eq!((end.failure, end.time, end.steps), (None, 1.0, 41));
        assert!(end.rejected > 70 && end.rejected < 80, "{}", end.rejected);
        let end = run(&mut Clock { breaks_after: 0.25, ..clock(0.1) }, 1_000_000);
        assert!(end.failure.is_some() && end.time <= 0.25 && end.time > 0.2499, "{end:?}");
    }

    #[test]
    fn an_observer_may_end_it() {
        let stop = |_: &Clock, time: f64| {
            if time > 0.45 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let end = march(&mut clock(0.1), 1.0, 100, stop);
        assert!(end.cancelled && end.steps == 5 && end.failure.is_none());
    }
}
