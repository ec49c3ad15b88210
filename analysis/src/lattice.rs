//! Kernel weights on the uniform lattice `x_j = j Δξ`, with the smoothing ratio `l/Δξ` exact.

use crate::fixed_point;
use crate::kernel::{GAUSSIAN_CUT, Kernel};
use crate::rational::{Rational, integer};
use num_traits::{Signed, ToPrimitive, Zero};
use thiserror::Error;

/// The largest smoothing ratio that is accepted.
pub const MAX_RATIO: i64 = 50;

/// A smoothing ratio outside `(0, 50]`.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the smoothing ratio {0} is out of range: it must be above 0 and at most {MAX_RATIO}")]
pub struct RatioOutOfRange(pub String);

/// The dimensionless weights of a kernel on the lattice, for `k = 1, 2, …, K`:
///
/// `w_k = Δξ² |W'(kΔξ)|` and `v_k = Δξ³ W''(kΔξ)` with `v_0` the limit from the right.
///
/// Each is exact for a polynomial kernel, and within [`radius`](Self::radius) of the true number for
/// the Gaussian.
#[derive(Debug, Clone, PartialEq)]
pub struct LatticeWeights {
    /// `[w_1, …, w_K]`.
    pub gradient: Vec<Rational>,
    /// `[v_0, v_1, …, v_K]`.
    pub curvature: Vec<Rational>,
    /// How far a weight may be from the true number: zero when the weights are exact.
    pub radius: Rational,
}

impl LatticeWeights {
    /// The weights of `kernel` at `ratio = l/Δξ`.
    ///
    /// ```
    /// use courant_analysis::{kernel::Kernel, lattice::LatticeWeights, rational::ratio};
    /// let weights = LatticeWeights::new(Kernel::CubicSpline, &ratio(2, 1)).unwrap();
    /// assert_eq!(weights.gradient, [ratio(5, 32), ratio(1, 8), ratio(1, 32)]);
    /// ```
    ///
    /// # Errors
    /// When the ratio is not in `(0, 50]`.
    pub fn new(kernel: Kernel, ratio: &Rational) -> Result<Self, RatioOutOfRange> {
        if !ratio.is_positive() || *ratio > integer(MAX_RATIO) {
            return Err(RatioOutOfRange(crate::rational::to_text(ratio)));
        }
        // A lattice point exactly on the edge of the support belongs to it.
        let reach = (kernel.exact_support() * ratio).floor().to_integer().to_i64();
        let reach = reach.expect("a ratio of at most 50 gives a small integer");
        let distances = (0..=reach).map(|k| integer(k) / ratio);
        let (square, cube) = (ratio * ratio, ratio * ratio * ratio);
        let mut weights = match kernel.polynomial() {
            Some(shape) => {
                let curvature = distances.clone().map(|q| shape.exact(&q, 2) / &cube).collect();
                let gradient = distances.skip(1).map(|q| -shape.exact(&q, 1) / &square).collect();
                Self { gradient, curvature, radius: Rational::zero() }
            }
            None => gaussian(reach, ratio),
        };
        while weights.gradient.last().is_some_and(Zero::is_zero)
            && weights.curvature.last().is_some_and(Zero::is_zero)
        {
            weights.gradient.pop();
            weights.curvature.pop();
        }
        Ok(weights)
    }

    /// The largest neighbour offset `K` with a weight.
    pub fn reach(&self) -> usize {
        self.gradient.len()
    }
}

/// `w = 2q e^{−q²}/√π · Δξ²/l²` and `v = (4q² − 2) e^{−q²}/√π · Δξ³/l³`, in integers of fixed point.
fn gaussian(reach: i64, ratio: &Rational) -> LatticeWeights {
    let norm = fixed_point::inverse_sqrt_of_pi();
    let (n, d) = (ratio.numer(), ratio.denom());
    let (d_square, n_square) = (d * d, n * n);
    let (d_cube, n_cube) = (&d_square * d, &n_square * n);
    let (mut gradient, mut curvature) = (Vec::new(), Vec::new());
    for k in 0..=reach {
        let q = integer(k) / ratio;
        let shape = (fixed_point::exp_of_minus(&(&q * &q)) * &norm) >> fixed_point::PRECISION;
        // q = kd/n: 2q/(l/Δξ)² = 2kd³/n³ and (4q² − 2)/(l/Δξ)³ = (4k²d² − 2n²)d³/n⁵.
        if k > 0 {
            gradient.push(fixed_point::dyadic((&shape * (2 * k) * &d_cube) / &n_cube));
        }
        let factor = &d_square * (4 * k * k) - &n_square * 2;
        curvature.push(fixed_point::dyadic((shape * factor * &d_cube) / (&n_cube * &n_square)));
    }
    // The shape is wrong by less than 3 units (two factors below 1, one rounding); q ≤ 3 multiplies
    // that by at most 6 and 34, a ratio below 1 by its inverse powers; one more rounding.
    let largest = integer(4 * GAUSSIAN_CUT * GAUSSIAN_CUT) * integer(3);
    let stretch = if *ratio < integer(1) { (ratio * ratio * ratio).recip() } else { integer(1) };
    let radius = fixed_point::radius() * (largest * stretch + integer(1));
    LatticeWeights { gradient, curvature, radius }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::{ratio as fraction, to_f64};
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    #[test]
    fn cubic_spline_at_ratio_one_is_the_central_difference() {
        let weights = LatticeWeights::new(Kernel::CubicSpline, &integer(1)).unwrap();
        assert_eq!(weights.gradient, [fraction(1, 2)]);
        assert_eq!(weights.curvature, [integer(-2), integer(1)]);
    }

    #[test]
    fn the_point_on_the_gaussian_cut_counts() {
        for (ratio, reach) in [(fraction(1, 1), 3), (fraction(2, 3), 2), (fraction(299, 100), 8)] {
            let weights = LatticeWeights::new(Kernel::Gaussian, &ratio).unwrap();
            assert_eq!(weights.reach(), reach, "{ratio}");
        }
        // 0.1 + 0.2 as a person types it is 3/10: support 9/10, no neighbour; 1/3 has one.
        let none = LatticeWeights::new(Kernel::Gaussian, &fraction(3, 10)).unwrap();
        assert_eq!(none.reach(), 0);
        let one = LatticeWeights::new(Kernel::Gaussian, &fraction(1, 3)).unwrap();
        assert_eq!(one.reach(), 1);
    }

    #[test]
    fn ratios_outside_the_range_are_refused() {
        for ratio in [integer(0), integer(-1), fraction(501, 10)] {
            assert!(LatticeWeights::new(Kernel::CubicSpline, &ratio).is_err(), "{ratio}");
        }
    }

    proptest! {
        #[test]
        fn weights_agree_with_the_fast_kernel(numerator in 1i64..500) {
            let ratio = fraction(numerator, 50);
            let float = to_f64(&ratio);
            for kernel in Kernel::ALL {
                let weights = LatticeWeights::new(kernel, &ratio).unwrap();
                for (k, weight) in (1..).zip(&weights.gradient) {
                    // The end of the support is decided exactly there and rounded here.
                    let q = (f64::from(k) / float).min(kernel.support());
                    assert_relative_eq!(
                        to_f64(weight), -kernel.slope(q) / (float * float),
                        epsilon = 1e-13 / (float * float), max_relative = 1e-13
                    );
                }
                for (k, weight) in (0..).zip(&weights.curvature) {
                    let q = (f64::from(k) / float).min(kernel.support());
                    assert_relative_eq!(
                        to_f64(weight), kernel.curvature(q) / float.powi(3),
                        epsilon = 1e-12 / float.powi(3), max_relative = 1e-12
                    );
                }
            }
        }
    }
}
