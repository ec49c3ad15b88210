//! What the two paths have in common.

/// Something that advances one number per particle, step by step.
pub trait Stepper {
    /// One time step.
    fn step(&mut self);

    /// The present values, one per particle in the order of their positions.
    fn state(&self) -> &[f64];

    /// Replaces the values.
    ///
    /// # Panics
    /// When there are not as many values as particles.
    fn set_state(&mut self, values: &[f64]);

    /// Terms with another particle's value that one step adds up: the work, whatever the machine.
    fn interactions_per_step(&self) -> u64;
}
