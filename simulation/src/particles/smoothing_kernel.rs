//! A kernel of the analysis, normalised in `D` dimensions.

use courant_analysis::exact::polynomial::Polynomial;
use courant_analysis::exact::rational::{Rational, integer, to_f64};
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
    pieces: [Piece; MOST_PIECES],
}

/// The quintic spline has three pieces, and the C6 kernel ten powers.
const MOST_PIECES: usize = 3;
const MOST_COEFFICIENTS: usize = 11;

/// A polynomial in `q − origin` up to `end`. Coefficients of the shape and of its slope lie in the kernel itself:
/// pair loops read nothing else.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    end: f64,
    origin: f64,
    /// How many coefficients the shape has.
    count: usize,
    value: [f64; MOST_COEFFICIENTS],
    slope: [f64; MOST_COEFFICIENTS],
}

impl Piece {
    const NONE: Self = Self {
        end: f64::NEG_INFINITY,
        origin: 0.0,
        count: 0,
        value: [0.0; MOST_COEFFICIENTS],
        slope: [0.0; MOST_COEFFICIENTS],
    };

    /// About the centre for the innermost piece and about its end for the others, so that nothing cancels there.
    fn new(innermost: bool, end: &Rational, shape: &Polynomial<Rational>) -> Self {
        let origin = if innermost { integer(0) } else { end.clone() };
        let about = Polynomial::new(vec![origin.clone(), integer(1)]);
        let coefficients = |polynomial: &Polynomial<Rational>| {
            let mut row = [0.0; MOST_COEFFICIENTS];
            for (place, exact) in row.iter_mut().zip(polynomial.compose(&about).coefficients()) {
                *place = to_f64(exact);
            }
            row
        };
        let count = shape.coefficients().len();
        assert!(count <= MOST_COEFFICIENTS, "no kernel has a higher power");
        let (value, slope) = (coefficients(shape), coefficients(&shape.derivative()));
        Self { end: to_f64(end), origin: to_f64(&origin), count, value, slope }
    }
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
        let mut pieces = [Piece::NONE; MOST_PIECES];
        for (index, exact) in
            kernel.polynomial().iter().flat_map(|shape| shape.pieces()).enumerate()
        {
            pieces[index] = Piece::new(index == 0, &exact.end, &exact.shape);
        }
        Self { kernel, norm, pieces }
    }

    /// `σ/h^D`.
    #[inline]
    pub(super) fn norm(&self, h: f64) -> f64 {
        self.norm / h.powi(D as i32)
    }

    /// `w(q)` and `w'(q)`.
    #[inline]
    pub(super) fn shape(&self, q: f64) -> [f64; 2] {
        for piece in &self.pieces {
            if q <= piece.end {
                let offset = q - piece.origin;
                let (mut value, mut slope) = (0.0, 0.0);
                for place in (0..piece.count).rev() {
                    value = value * offset + piece.value[place];
                    slope = slope * offset + piece.slope[place];
                }
                return [value, slope];
            }
        }
        if self.pieces[0].count > 0 {
            [0.0; 2]
        } else {
            [self.kernel.value(q), self.kernel.slope(q)]
        }
    }

    /// `W(r, h)`, units 1/length^D.
    #[inline]
    pub fn value(&self, r: f64, h: f64) -> f64 {
        self.norm(h) * self.shape(r / h)[0]
    }
}

impl<const D: usize> RadialKernel for SmoothingKernel<D> {
    #[inline]
    fn slope(&self, r: f64, h: f64) -> f64 {
        self.norm(h) * self.shape(r / h)[1] / h
    }

    #[inline]
    fn support(&self) -> f64 {
        self.kernel.support()
    }
}
