//! The four lattice sums that make every dispersion relation of Cha & Whitworth 2003, section 4.

use super::density::{Density, Enclosure, relative_density};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::rational::{Rational, integer, ratio as fraction};
use crate::kernel::Kernel;
use crate::kernel::lattice::{LatticeWeights, RatioOutOfRange};
use num_traits::{One, Signed, Zero};

/// The lattice sums of a kernel, each without the factor that makes it vanish for long waves.
///
/// With `x_ba = kΔ` over all neighbours `k ≠ 0`, `φ = κΔ` and `s = (1 − cos φ)/2`:
///
/// - `S = (M/ρ0) Σ sin(kφ) ∂W/∂x_a   = sin φ · gradient / Δ`
/// - `T = (M/ρ0) Σ (1 − cos kφ) W''   = s · curvature / Δ²`
/// - `D = (M/ρ0) Σ (1 − cos kφ) |W'|  = s · slope / Δ`
/// - `B = (M/ρ0) Σ (1 − cos kφ) |W'|/|x_ba| = s · slope_per_distance / Δ²`
///
/// The four series on the right have rational coefficients for a polynomial kernel and a rational
/// ratio. For long waves `S → κ`, `T → κ²` as far as the lattice is consistent.
#[derive(Debug, Clone)]
pub struct LatticeSums {
    kernel: Kernel,
    ratio: Rational,
    density: Density,
    relative_density: Enclosure,
    gradient: EnclosedSeries,
    curvature: EnclosedSeries,
    slope: EnclosedSeries,
    slope_per_distance: EnclosedSeries,
}

impl LatticeSums {
    /// The sums of `kernel` at `ratio = h/Δ`, with `ρ0` as stated by `density`.
    ///
    /// ```
    /// use courant_analysis::kernel::{Density, LatticeSums};
    /// use courant_analysis::{kernel::Kernel, exact::rational::ratio};
    /// let sums = LatticeSums::new(Kernel::CubicSpline, &ratio(1, 1), Density::Summation).unwrap();
    /// // Only the nearest neighbours count: S = sin φ, T = 2(1 − cos φ), D = 1 − cos φ.
    /// let at = sums.compile().at(1.0);
    /// assert_eq!(at.gradient, 1f64.sin());
    /// assert!((at.curvature - 2.0 * (1.0 - 1f64.cos())).abs() < 1e-15);
    /// assert!((at.slope - (1.0 - 1f64.cos())).abs() < 1e-15);
    /// ```
    ///
    /// # Errors
    /// When the ratio is not in `[1/100, 50]`.
    pub fn new(
        kernel: Kernel,
        ratio: &Rational,
        density: Density,
    ) -> Result<Self, RatioOutOfRange> {
        let weights = LatticeWeights::new(kernel, ratio)?;
        let relative_density = relative_density(kernel, ratio, density)?;
        let factor = inverse(&relative_density);
        let finish = |half_sum: EnclosedSeries| half_sum.scaled(&integer(2)).times(&factor);
        let per_distance: Vec<Rational> =
            (1..).zip(&weights.gradient).map(|(k, w)| w * fraction(1, k)).collect();
        Ok(Self {
            kernel,
            ratio: ratio.clone(),
            density,
            gradient: finish(sine_quotients(&weights.gradient, &weights.radius)),
            curvature: finish(versine_quotients(&weights.curvature[1..], &weights.radius)),
            slope: finish(versine_quotients(&weights.gradient, &weights.radius)),
            slope_per_distance: finish(versine_quotients(&per_distance, &weights.radius)),
            relative_density,
        })
    }

    /// The kernel.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// `h/Δ`.
    pub fn ratio(&self) -> &Rational {
        &self.ratio
    }

    /// Which `ρ0` is used.
    pub fn density(&self) -> Density {
        self.density
    }

    /// `ρ0 Δ/M`.
    pub fn relative_density(&self) -> &Enclosure {
        &self.relative_density
    }

    /// `S Δ / sin φ`.
    pub fn gradient(&self) -> &EnclosedSeries {
        &self.gradient
    }

    /// `T Δ² / s`.
    pub fn curvature(&self) -> &EnclosedSeries {
        &self.curvature
    }

    /// `D Δ / s`.
    pub fn slope(&self) -> &EnclosedSeries {
        &self.slope
    }

    /// `B Δ² / s`.
    pub fn slope_per_distance(&self) -> &EnclosedSeries {
        &self.slope_per_distance
    }

    /// `S²Δ²/s = 4 (1 − s) (SΔ/sin φ)²`, because `sin²φ = 4 s (1 − s)`.
    pub fn squared_gradient(&self) -> EnclosedSeries {
        let minus_s = EnclosedSeries::half_versine().scaled(&integer(-1));
        let complement = EnclosedSeries::constant(integer(4)).plus(&minus_s.scaled(&integer(4)));
        complement.times(&self.gradient.times(&self.gradient))
    }

    /// The numeric form, each coefficient correctly rounded.
    pub fn compile(&self) -> CompiledSums {
        CompiledSums {
            gradient: self.gradient.compile(),
            curvature: self.curvature.compile(),
            slope: self.slope.compile(),
            slope_per_distance: self.slope_per_distance.compile(),
        }
    }
}

/// [`LatticeSums`] in `f64`: four Clenshaw sums per phase, accurate relative to each sum for long waves.
#[derive(Debug, Clone)]
pub struct CompiledSums {
    gradient: CosineSeries<f64>,
    curvature: CosineSeries<f64>,
    slope: CosineSeries<f64>,
    slope_per_distance: CosineSeries<f64>,
}

/// The sums at one phase, in units of the spacing: `SΔ`, `TΔ²`, `DΔ`, `BΔ²`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SumValues {
    /// `SΔ`.
    pub gradient: f64,
    /// `TΔ²`.
    pub curvature: f64,
    /// `DΔ`.
    pub slope: f64,
    /// `BΔ²`.
    pub slope_per_distance: f64,
}

impl CompiledSums {
    /// The sums at the phase `φ = κΔ`, in radians.
    pub fn at(&self, phase: f64) -> SumValues {
        let (sine, cosine) = phase.sin_cos();
        let s = (0.5 * phase).sin().powi(2);
        SumValues {
            gradient: sine * self.gradient.at_cosine(cosine),
            curvature: s * self.curvature.at_cosine(cosine),
            slope: s * self.slope.at_cosine(cosine),
            slope_per_distance: s * self.slope_per_distance.at_cosine(cosine),
        }
    }
}

/// `1/ρ` of an enclosure. The reciprocal of a long fraction is rounded: sums over it would carry ever
/// longer fractions.
fn inverse(density: &Enclosure) -> EnclosedSeries {
    if density.radius.is_zero() {
        return EnclosedSeries::constant(density.center.recip());
    }
    let unit = crate::exact::fixed_point::radius();
    let center = (density.center.recip() / &unit).floor() * &unit;
    // |1/ρ − 1/ρ₀| ≤ r/(ρ₀(ρ₀ − r)), and one rounding.
    let lowest = &density.center - &density.radius;
    let radius = &density.radius / (&density.center * lowest) + unit;
    EnclosedSeries::new(&[center], radius)
}

/// `Σ_k c_k (1 − cos kφ)/s` for `c = [c_1, c_2, …]`, each within `radius`.
fn versine_quotients(values: &[Rational], radius: &Rational) -> EnclosedSeries {
    let constant: Rational = values.iter().sum();
    let coefficients = [constant].into_iter().chain(values.iter().map(|value| -value)).collect();
    let quotient = CosineSeries::new(coefficients).divide_by_s();
    let quotient = quotient.expect("1 − cos kφ vanishes at zero, and so do their sums");
    // (1 − cos kφ)/s = 2 sin²(kφ/2)/sin²(φ/2) has coefficients that sum to 2k².
    let squares: Rational = (1..=values.len() as i64).map(|k| integer(2 * k * k)).sum();
    EnclosedSeries::new(quotient.coefficients(), radius * squares)
}

/// `Σ_k c_k sin kφ / sin φ` for `c = [c_1, c_2, …]`, each within `radius`.
fn sine_quotients(values: &[Rational], radius: &Rational) -> EnclosedSeries {
    // sin kφ/sin φ = 2 cos (k−1)φ + 2 cos (k−3)φ + …, ending with 1 when k is odd.
    let mut coefficients = vec![Rational::zero(); values.len()];
    for (index, value) in values.iter().enumerate() {
        for m in (0..=index).rev().step_by(2) {
            let weight = if m == 0 { Rational::one() } else { integer(2) };
            coefficients[m] += value * weight;
        }
    }
    let sum: Rational = (1..=values.len() as i64).map(integer).sum();
    EnclosedSeries::new(&coefficients, radius.abs() * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::to_f64;
    use proptest::prelude::*;

    /// The sums term by term as the paper writes them, over left and right neighbours.
    pub(super) fn direct(kernel: Kernel, h: f64, density: Density, phase: f64) -> SumValues {
        let reach = (kernel.support() * h).floor() as i32 + 1;
        let value = |k: i32| kernel.value(f64::from(k.abs()) / h) / h;
        let rho = match density {
            Density::Summation => (-reach..=reach).map(value).sum(),
            Density::MassPerSpacing => 1.0,
        };
        let mut sums =
            SumValues { gradient: 0.0, curvature: 0.0, slope: 0.0, slope_per_distance: 0.0 };
        for k in (-reach..=reach).filter(|&k| k != 0) {
            let distance = f64::from(k.abs());
            let x = f64::from(k) * phase;
            let slope = kernel.slope(distance / h) / (h * h);
            // W(x_a − x_b): its derivative by x_a points away from b.
            sums.gradient += x.sin() * -slope * f64::from(k.signum()) / rho;
            sums.curvature += (1.0 - x.cos()) * kernel.curvature(distance / h) / h.powi(3) / rho;
            sums.slope += (1.0 - x.cos()) * -slope / rho;
            sums.slope_per_distance += (1.0 - x.cos()) * -slope / distance / rho;
        }
        sums
    }

    proptest! {
        #[test]
        fn the_series_are_the_direct_sums(numerator in 60i64..400, phase in 0.0f64..3.2, summed: bool) {
            let ratio = fraction(numerator, 100);
            let density = if summed { Density::Summation } else { Density::MassPerSpacing };
            for kernel in Kernel::ALL {
                let sums = LatticeSums::new(kernel, &ratio, density).unwrap();
                let (series, plain) =
                    (sums.compile().at(phase), direct(kernel, to_f64(&ratio), density, phase));
                // At most 24 terms of size 10.
                prop_assert!((series.gradient - plain.gradient).abs() < 1e-12);
                prop_assert!((series.curvature - plain.curvature).abs() < 1e-12);
                prop_assert!((series.slope - plain.slope).abs() < 1e-12);
                prop_assert!((series.slope_per_distance - plain.slope_per_distance).abs() < 1e-12);
                let exact = kernel.polynomial().is_some();
                prop_assert_eq!(sums.curvature().is_exact() && sums.gradient().is_exact(), exact);
                prop_assert!(to_f64(sums.curvature().radius()) < 1e-45);
            }
        }
    }

    #[test]
    fn integer_ratios_of_splines_are_consistent_for_long_waves() {
        // S → κ and T → κ² exactly: gradient(0) = 1 and curvature(0) = 4 (s → κ²/4).
        for l in 1..=3 {
            let sums =
                LatticeSums::new(Kernel::CubicSpline, &integer(l), Density::Summation).unwrap();
            assert_eq!(sums.gradient().center().at_zero(), integer(1));
            assert_eq!(sums.curvature().center().at_zero(), integer(4));
        }
    }

    #[test]
    fn long_waves_lose_no_digits() {
        let sums = LatticeSums::new(Kernel::CubicSpline, &integer(1), Density::Summation).unwrap();
        let at = sums.compile().at(1e-8);
        assert!((at.curvature / 1e-16 - 1.0).abs() < 4.0 * f64::EPSILON);
    }
}
