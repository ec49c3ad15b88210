//! What is stepped: scheme, kernel, smoothing ratio and Courant number.

use super::scheme::{AdvectionScheme, Discretisation};
use courant_analysis::exact::rational::to_f64;
use courant_analysis::kernel::Kernel;
use courant_analysis::kernel::lattice::MAX_RATIO;

/// A scheme with all its numbers, `Δξ` being the (mean) spacing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Method {
    /// The update rule.
    pub scheme: AdvectionScheme,
    /// The kernel.
    pub kernel: Kernel,
    /// The smoothing ratio `l/Δξ`.
    pub ratio: f64,
    /// The Courant number `a Δt/Δξ`.
    pub courant_number: f64,
}

/// Numbers no scheme runs with.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MethodError {
    /// The smoothing ratio is out of range.
    #[error("the smoothing ratio {0} is out of range: it must be above 0 and at most {MAX_RATIO}")]
    Ratio(f64),
    /// The Courant number is out of range.
    #[error("the Courant number {0} is out of range: it must be positive and finite")]
    CourantNumber(f64),
}

impl Method {
    /// The discretisation at a Courant number. Only names and numbers are taken over, not the weights.
    pub fn of(discretisation: &Discretisation, courant_number: f64) -> Self {
        Self {
            scheme: discretisation.scheme(),
            kernel: discretisation.kernel(),
            ratio: to_f64(discretisation.ratio()),
            courant_number,
        }
    }

    /// Whether the numbers are in range.
    ///
    /// # Errors
    /// When the ratio is not in `[1/100, 50]` or the Courant number not positive and finite.
    pub fn check(&self) -> Result<(), MethodError> {
        if !(self.ratio > 0.0 && self.ratio <= MAX_RATIO as f64) {
            return Err(MethodError::Ratio(self.ratio));
        }
        if !(self.courant_number > 0.0 && self.courant_number.is_finite()) {
            return Err(MethodError::CourantNumber(self.courant_number));
        }
        Ok(())
    }
}
