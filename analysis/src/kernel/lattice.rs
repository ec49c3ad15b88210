//! Kernel weights on the uniform lattice `x_j = j Δξ`, with the smoothing ratio `l/Δξ` exact.

use crate::exact::fixed_point;
use crate::exact::interval::Interval;
use crate::exact::rational::{Rational, integer};
use crate::kernel::{GAUSSIAN_CUT, Kernel};
use num_traits::{Signed, ToPrimitive, Zero};
use thiserror::Error;

/// The largest smoothing ratio that is accepted.
pub const MAX_RATIO: i64 = 50;

/// The smallest one is one over this: far below the first neighbour, where nothing depends on it any more.
pub const MAX_INVERSE_RATIO: i64 = 100;

/// A smoothing ratio outside `[1/100, 50]`.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "the smoothing ratio {0} is out of range: it must be at least 1/{MAX_INVERSE_RATIO} and at most {MAX_RATIO}"
)]
pub struct RatioOutOfRange(pub String);

impl RatioOutOfRange {
    /// Judges a ratio.
    ///
    /// # Errors
    /// When it is out of range.
    pub fn check(ratio: &Rational) -> Result<(), Self> {
        let (numerator, denominator) = (ratio.numer(), ratio.denom());
        let accepted =
            *numerator <= denominator * MAX_RATIO && numerator * MAX_INVERSE_RATIO >= *denominator;
        accepted.then_some(()).ok_or_else(|| Self(crate::exact::rational::to_text(ratio)))
    }
}

/// A weight of which nothing is known: an end of its interval is infinite.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the weight at offset {offset} is not bounded: its enclosure must have finite ends")]
pub struct UnboundedWeight {
    /// The neighbour offset `k`.
    pub offset: usize,
}

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
    /// use courant_analysis::{kernel::Kernel, kernel::lattice::LatticeWeights, exact::rational::ratio};
    /// let weights = LatticeWeights::new(Kernel::CubicSpline, &ratio(2, 1)).unwrap();
    /// assert_eq!(weights.gradient, [ratio(5, 32), ratio(1, 8), ratio(1, 32)]);
    /// ```
    ///
    /// # Errors
    /// When the ratio is not in `[1/100, 50]`.
    pub fn new(kernel: Kernel, ratio: &Rational) -> Result<Self, RatioOutOfRange> {
        RatioOutOfRange::check(ratio)?;
        // A lattice point exactly on the edge of the support belongs to it.
        let reach = (kernel.exact_support() * ratio).floor().to_integer().to_i64();
        let reach = reach.expect("a ratio of at most 50 gives a small integer");
        let inverse = ratio.recip();
        let (square, cube) = (inverse.pow(2), inverse.pow(3));
        let mut weights = match kernel.polynomial() {
            Some(shape) => {
                let at = |k: i64, order, factor| shape.exact_at(k, &inverse, order, factor);
                let curvature = (0..=reach).map(|k| at(k, 2, &cube)).collect();
                let gradient = (1..=reach).map(|k| -at(k, 1, &square)).collect();
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

    /// The weights of any kernel whose derivatives can be enclosed: `slope` and `curvature` are `w'(q)`
    /// and `w''(q)` of the shape (`W = w/l`), evaluated on intervals that contain `q = k Δξ/l`.
    ///
    /// Limits of such a kernel are as sharp as its enclosures: with `f64` ends about 13 digits. Where
    /// that does not suffice, the stable set says what it leaves undecided.
    ///
    /// ```
    /// use courant_analysis::exact::interval::Interval;
    /// use courant_analysis::{kernel::lattice::LatticeWeights, exact::rational::{integer, ratio}};
    /// // The quadratic w = 3 (1 − q²)/4 on q ≤ 1.
    /// let weights = LatticeWeights::enclosed(
    ///     &integer(1), &ratio(7, 2),
    ///     |q| -(Interval::point(1.5) * q),
    ///     |_| Interval::point(-1.5),
    /// ).unwrap().unwrap();
    /// assert_eq!(weights.reach(), 3);
    /// ```
    ///
    /// # Errors
    /// The outer one when the ratio is not in `[1/100, 50]`, the inner one when an enclosure is infinite.
    pub fn enclosed(
        support: &Rational,
        ratio: &Rational,
        slope: impl Fn(Interval) -> Interval,
        curvature: impl Fn(Interval) -> Interval,
    ) -> Result<Result<Self, UnboundedWeight>, RatioOutOfRange> {
        RatioOutOfRange::check(ratio)?;
        let reach = (support * ratio).floor().to_integer().to_i64();
        let reach = reach.filter(|reach| (0..=1000).contains(reach));
        let reach = reach.ok_or_else(|| RatioOutOfRange(crate::exact::rational::to_text(ratio)))?;
        let l = Interval::around(ratio);
        let at = |k: i64| Interval::around(&(integer(k) / ratio));
        let gradient: Vec<_> = (1..=reach).map(|k| -slope(at(k)) / l.sqr()).collect();
        let curvature: Vec<_> = (0..=reach).map(|k| curvature(at(k)) / (l.sqr() * l)).collect();
        Ok(Self::from_intervals(&gradient, &curvature))
    }

    /// The weights `[w_1, …, w_K]` and `[v_0, …, v_K]` from enclosures of each.
    ///
    /// # Errors
    /// When an enclosure has an infinite end.
    pub fn from_intervals(
        gradient: &[Interval],
        curvature: &[Interval],
    ) -> Result<Self, UnboundedWeight> {
        let mut radius = Rational::zero();
        let mut center = |offset: usize, weight: &Interval| {
            let (mut center, mut half) =
                weight.center_and_radius().ok_or(UnboundedWeight { offset })?;
            // A weight that is exactly zero has no neighbour; one that only may be zero has.
            if center.is_zero() && half.is_positive() {
                (center, half) = (half.clone(), half * integer(2));
            }
            radius = radius.clone().max(half);
            Ok(center)
        };
        let gradient: Result<_, _> =
            gradient.iter().enumerate().map(|(k, weight)| center(k + 1, weight)).collect();
        let curvature: Result<_, _> =
            curvature.iter().enumerate().map(|(k, weight)| center(k, weight)).collect();
        Ok(Self { gradient: gradient?, curvature: curvature?, radius })
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
    use crate::exact::rational::{ratio as fraction, to_f64};
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

    #[test]
    fn a_kernel_given_on_intervals_encloses_the_exact_one() {
        for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
            let ratio = fraction(23, 10);
            let piecewise = |q: Interval, order: usize| -> Interval {
                let shape = kernel.polynomial().unwrap();
                let at =
                    |end: f64| shape.exact(&crate::exact::rational::from_f64(end).unwrap(), order);
                // Monotone between the two ends of an interval one float wide, knots apart.
                let (a, b) = (at(q.lower()), at(q.upper()));
                Interval::around(&a.clone().min(b.clone()))
                    + Interval::new(0.0, to_f64(&(&a - &b).abs()).next_up())
            };
            let root = Interval::around(&fixed_point::dyadic(fixed_point::inverse_sqrt_of_pi()));
            let shape = |q: Interval| (-q.sqr()).exp() * root;
            let (two, four) = (Interval::point(2.0), Interval::point(4.0));
            let enclosed = if kernel == Kernel::Gaussian {
                LatticeWeights::enclosed(
                    &integer(3),
                    &ratio,
                    |q| -(two * q * shape(q)),
                    |q| (four * q.sqr() - two) * shape(q),
                )
            } else {
                LatticeWeights::enclosed(
                    &integer(2),
                    &ratio,
                    |q| piecewise(q, 1),
                    |q| piecewise(q, 2),
                )
            };
            let enclosed = enclosed.unwrap().unwrap();
            let exact = LatticeWeights::new(kernel, &ratio).unwrap();
            let pairs = exact.gradient.iter().zip(&enclosed.gradient);
            for (exact, center) in pairs.chain(exact.curvature.iter().zip(&enclosed.curvature)) {
                assert!((exact - center).abs() <= enclosed.radius, "{kernel}");
            }
            assert!(to_f64(&enclosed.radius) < 1e-14, "{kernel}");
        }
    }

    #[test]
    fn unbounded_and_possibly_vanishing_weights() {
        let wide = Interval::new(-1.0, 1.0);
        let weights = LatticeWeights::from_intervals(&[wide], &[wide, wide]).unwrap();
        assert!(!weights.gradient[0].is_zero() && weights.radius == integer(2));
        let unbounded = LatticeWeights::from_intervals(&[Interval::WHOLE], &[wide]);
        assert_eq!(unbounded, Err(UnboundedWeight { offset: 1 }));
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
