//! A stepper with a deliberate error, to see that a check can fail.

use super::stepper::Stepper;

/// One coefficient off: `by` is added to the coefficient of `E^offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fault {
    /// Whose value is taken too often.
    pub offset: i64,
    /// By how much.
    pub by: f64,
}

/// A stepper that makes the same mistake at every step.
pub(super) struct Faulty {
    pub inner: Box<dyn Stepper>,
    pub fault: Fault,
}

impl Stepper for Faulty {
    fn step(&mut self) {
        let before = self.inner.state().to_vec();
        self.inner.step();
        let mut after = self.inner.state().to_vec();
        let count = before.len() as i64;
        for (i, value) in (0i64..).zip(&mut after) {
            *value += self.fault.by * before[(i + self.fault.offset).rem_euclid(count) as usize];
        }
        self.inner.set_state(&after);
    }
    fn state(&self) -> &[f64] {
        self.inner.state()
    }
    fn set_state(&mut self, values: &[f64]) {
        self.inner.set_state(values);
    }
    fn interactions_per_step(&self) -> u64 {
        self.inner.interactions_per_step()
    }
}
