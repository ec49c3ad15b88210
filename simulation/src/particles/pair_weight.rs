//! The geometrical factor of the pair forces: `(1/ρ² ∇W)` in its four symmetric forms.
//!
//! All are the `A` of `force = P A` (per product of masses) on the left particle, hence never
//! positive: `∇_left W = −W' e` with `e` pointing right, and the equations carry a minus.

use super::pair_force::PairEnd;
use super::smoothing_kernel::RadialKernel;
use std::f64::consts::SQRT_2;

/// A factor `A` with `force = P A`.
pub trait PairWeight: std::fmt::Debug + Send + Sync + 'static {
    /// See [`PairForce::reach`](super::pair_force::PairForce::reach).
    fn reach(&self) -> f64 {
        1.0
    }

    /// See [`PairForce::needs_volume_slope`](super::pair_force::PairForce::needs_volume_slope).
    fn needs_volume_slope(&self) -> bool {
        false
    }

    /// `A ≤ 0`; zero where the pair does not interact.
    fn weight<K: RadialKernel>(
        &self,
        left: &PairEnd,
        right: &PairEnd,
        distance: f64,
        kernel: &K,
    ) -> f64;
}

/// `(1/ρ_i² + 1/ρ_j²) ∇W(r; h_ij)`, `h_ij = (h_i + h_j)/2`: Cha & Whitworth 2003 (9), (10).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SumOfSquares;

/// `2/(ρ_i ρ_j) ∇W(r; h_ij)`: Cha & Whitworth 2003 (11), (12).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Product;

/// `∇W(r, h_i)/ρ_i² + ∇W(r, h_j)/ρ_j²`: Cha & Whitworth 2003 (13), (14).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct OwnKernels;

/// `∫ ρ⁻²(s) (∂_i − ∂_j) W(s − r_i, h) W(s − r_j, h) ds`: Cha & Whitworth 2003 (15), (16).
///
/// For the Gaussian `W ∝ exp(−r²/h²)` the product of two kernels is a Gaussian in the distance, of
/// smoothing length `√2 h`, times one about the midpoint with variance `h²/4`, so
/// `A = V²(h_i) ∇W(r, √2 h_i) + V²(h_j) ∇W(r, √2 h_j)` with the mean of `V²` over the latter
/// (Inutsuka 2002). `V(s) = D + C s + B s² + A s³` has the values and slopes of both ends; where the slopes differ in sign it is a
/// straight line, since the cubic would make an extremum that the particles do not have. Then
/// `V²(h) = D² + (h²/4)(C² + 2BD) + (3h⁴/16)(B² + 2AC) + (15h⁶/64) A²`.
/// It holds for the Gaussian only; the kernel here is cut like any Gaussian of length `√2 h`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Convolution;

impl PairWeight for SumOfSquares {
    #[inline]
    fn weight<K: RadialKernel>(&self, l: &PairEnd, r: &PairEnd, distance: f64, kernel: &K) -> f64 {
        let slope = kernel.slope(distance, 0.5 * (l.smoothing + r.smoothing));
        (1.0 / (l.density * l.density) + 1.0 / (r.density * r.density)) * slope
    }
}

impl PairWeight for Product {
    #[inline]
    fn weight<K: RadialKernel>(&self, l: &PairEnd, r: &PairEnd, distance: f64, kernel: &K) -> f64 {
        2.0 / (l.density * r.density) * kernel.slope(distance, 0.5 * (l.smoothing + r.smoothing))
    }
}

impl PairWeight for OwnKernels {
    #[inline]
    fn weight<K: RadialKernel>(&self, l: &PairEnd, r: &PairEnd, distance: f64, kernel: &K) -> f64 {
        kernel.slope(distance, l.smoothing) / (l.density * l.density)
            + kernel.slope(distance, r.smoothing) / (r.density * r.density)
    }
}

impl Convolution {
    /// The mean of `V²` over the Gaussian about the midpoint for the smoothing length `h`.
    pub fn mean_square_volume(self, l: &PairEnd, r: &PairEnd, distance: f64, h: f64) -> f64 {
        let (left, right) = (1.0 / l.density, 1.0 / r.density);
        let rise = (right - left) / distance;
        let middle = 0.5 * (left + right);
        let h2 = h * h;
        let (vl, vr) = (l.volume_slope, r.volume_slope);
        if vl * vr < 0.0 {
            return middle * middle + 0.25 * h2 * rise * rise;
        }
        let a = (vl + vr - 2.0 * rise) / (distance * distance);
        let b = 0.5 * (vr - vl) / distance;
        let c = 1.5 * rise - 0.25 * (vl + vr);
        let d = middle - 0.125 * (vr - vl) * distance;
        d * d
            + 0.25 * h2 * (c * c + 2.0 * b * d)
            + 3.0 / 16.0 * h2 * h2 * (b * b + 2.0 * a * c)
            + 15.0 / 64.0 * h2 * h2 * h2 * a * a
    }
}

impl PairWeight for Convolution {
    fn reach(&self) -> f64 {
        SQRT_2
    }

    fn needs_volume_slope(&self) -> bool {
        true
    }

    #[inline]
    fn weight<K: RadialKernel>(&self, l: &PairEnd, r: &PairEnd, distance: f64, kernel: &K) -> f64 {
        let term = |h: f64| {
            let slope = kernel.slope(distance, SQRT_2 * h);
            // Beyond the kernel, or where its ends coincide, there is no line to interpolate on.
            if slope == 0.0 { 0.0 } else { self.mean_square_volume(l, r, distance, h) * slope }
        };
        if l.smoothing == r.smoothing {
            2.0 * term(l.smoothing)
        } else {
            term(l.smoothing) + term(r.smoothing)
        }
    }
}
