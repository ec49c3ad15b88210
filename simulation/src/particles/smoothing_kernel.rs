//! A kernel of the analysis, normalised in `D` dimensions.

use courant_analysis::exact::rational::to_f64;
use courant_analysis::kernel::Kernel;
use std::f64::consts::PI;

/// What a pair force may ask of a kernel: it sees distances, never the dimension.
pub trait RadialKernel: Sync {
    /// `∂W/∂r` at distance `r` for smoothing length `h`: never positive, units 1/length^(D+1).
    fn slope(&self, r: f64, h: f64) -> f64;
    /// `r/h` at which the kernel ends.
    fn support(&self) -> f64;
}

/// `W(r, h) = σ w(r/h)/h^D` for the shape `w` of a one-dimensional [`Kernel`].
///
/// `σ = 1` in one dimension, so the cut Gaussian stays un-normalised as its authors use it. In more
/// dimensions `σ` makes the integral of `W` one; for the Gaussian, that of the uncut one.
///
/// ```
/// use courant_analysis::kernel::Kernel;
/// use courant_simulation::particles::SmoothingKernel;
/// let line = SmoothingKernel::<1>::new(Kernel::CubicSpline);
/// let plane = SmoothingKernel::<2>::new(Kernel::CubicSpline);
/// assert_eq!(line.value(0.0, 0.5), 2.0 / 3.0 / 0.5);
/// // The cubic spline's factors are 2/3 and 10/(7π).
/// assert!((plane.value(0.0, 1.0) - 10.0 / (7.0 * std::f64::consts::PI)).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothingKernel<const D: usize> {
    kernel: Kernel,
    norm: f64,
}

impl<const D: usize> SmoothingKernel<D> {
    /// The kernel with its factor for `D` dimensions (1, 2 or 3).
    pub fn new(kernel: Kernel) -> Self {
        const { assert!(D >= 1 && D <= 3, "space has one, two or three dimensions") };
        let sphere = [2.0, 2.0 * PI, 4.0 * PI][D - 1];
        let norm = match (D, kernel.polynomial()) {
            (1, _) => 1.0,
            (_, Some(shape)) => 1.0 / (sphere * to_f64(&shape.half_moment(D - 1))),
            (_, None) => PI.powf(-0.5 * (D as f64 - 1.0)),
        };
        Self { kernel, norm }
    }

    /// The shape it is made of.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// `W(r, h)`, units 1/length^D.
    #[inline]
    pub fn value(&self, r: f64, h: f64) -> f64 {
        self.norm * self.kernel.value(r / h) / h.powi(D as i32)
    }
}

impl<const D: usize> RadialKernel for SmoothingKernel<D> {
    #[inline]
    fn slope(&self, r: f64, h: f64) -> f64 {
        self.norm * self.kernel.slope(r / h) / h.powi(D as i32 + 1)
    }

    #[inline]
    fn support(&self) -> f64 {
        self.kernel.support()
    }
}
