//! The lattice sums replaced by integrals: what Cha & Whitworth 2003 (47) calls the simple integral
//! approximation.

use crate::exact::rational::to_f64;
use crate::kernel::Kernel;
use crate::kernel::SumValues;
use crate::scheme::{LatticeMethod, SchemeError};

/// Nodes and weights of Gauss–Legendre quadrature with ten points on `[−1, 1]`, the positive half.
const NODES: [(f64, f64); 5] = [
    (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// `S = κŴ`, `T = κ²Ŵ` with the Fourier transform `Ŵ` of the kernel (47), and `D` and `B` as integrals in
/// the same spirit; in units of the spacing, with `ρ0 = M/Δ`.
///
/// It says how the relations behave for long waves and does not know of the lattice: it is smooth at
/// `κΔ = π`, and right only where `h/Δ` is large.
///
/// ```
/// use courant_analysis::{waves::dispersion::integral_sums, kernel::Kernel};
/// // The cubic spline transforms to (sin(κh/2)/(κh/2))⁴.
/// let sums = integral_sums(Kernel::CubicSpline, 1.2, 0.5);
/// let sinc = 0.3f64.sin() / 0.3;
/// assert!((sums.gradient - 0.5 * sinc.powi(4)).abs() < 1e-14);
/// ```
pub fn integral_sums(kernel: Kernel, ratio: f64, phase: f64) -> SumValues {
    let k = phase * ratio;
    // 1 − cos kq without cancellation.
    let versine = |q: f64| 2.0 * (0.5 * k * q).sin().powi(2);
    let transform = 2.0 * integrate(kernel, k, |q| kernel.value(q) * (k * q).cos());
    SumValues {
        gradient: phase * transform,
        curvature: phase * phase * transform,
        slope: -2.0 / ratio * integrate(kernel, k, |q| kernel.slope(q) * versine(q)),
        slope_per_distance: -2.0 / (ratio * ratio)
            * integrate(kernel, k, |q| kernel.slope(q) * versine(q) / q),
    }
}

/// `∫_0^support f dq`, piece by piece of the kernel, in panels on which `cos kq` turns by at most 2 rad:
/// ten points then integrate polynomial times cosine to rounding.
fn integrate(kernel: Kernel, k: f64, f: impl Fn(f64) -> f64) -> f64 {
    let ends: Vec<f64> = match kernel.polynomial() {
        Some(shape) => shape.pieces().iter().map(|piece| to_f64(&piece.end)).collect(),
        None => (1..=6).map(|half| 0.5 * f64::from(half)).collect(),
    };
    let mut start = 0.0;
    let mut total = 0.0;
    for end in ends {
        let panels = (k * (end - start) / 2.0).ceil().max(1.0) as usize;
        let half = 0.5 * (end - start) / panels as f64;
        for index in 0..panels {
            let middle = start + (2 * index + 1) as f64 * half;
            total += half
                * NODES
                    .iter()
                    .map(|(x, w)| w * (f(middle - half * x) + f(middle + half * x)))
                    .sum::<f64>();
        }
        start = end;
    }
    total
}

/// The direct sums and the integrals side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegralComparison {
    /// `ω_SPH²Δ²/c²` by direct summation.
    pub direct: f64,
    /// The same by the integral approximation.
    pub integral: f64,
}

impl IntegralComparison {
    /// The relative error of the approximation of `ω_SPH²`; `None` where the true one is zero.
    pub fn relative_error(&self) -> Option<f64> {
        (self.direct != 0.0).then(|| self.integral / self.direct - 1.0)
    }
}

/// What the integral approximation makes of `ω_SPH²` of a method at the phase `κΔ`.
///
/// # Errors
/// When the method has no waves.
pub fn compare_integral(
    method: &LatticeMethod,
    phase: f64,
) -> Result<IntegralComparison, SchemeError> {
    let sums = integral_sums(method.kernel(), to_f64(method.ratio()), phase);
    let doubled = 2.0 * method.value("P").map_or(1.0, to_f64);
    Ok(IntegralComparison {
        direct: method.waves()?.compile().mode(phase).restoring,
        integral: doubled * sums.curvature + (1.0 - doubled) * sums.gradient.powi(2),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{Rational, integer, ratio};
    use crate::kernel::{Density, LatticeSums};
    use crate::scheme::catalogue;

    #[test]
    fn splines_transform_to_powers_of_the_sine_cardinal() {
        for (kernel, order) in
            [(Kernel::CubicSpline, 4), (Kernel::QuarticSpline, 5), (Kernel::QuinticSpline, 6)]
        {
            for phase in [1e-3f64, 0.4, 1.7, 3.1] {
                for h in [0.8f64, 1.5, 6.0] {
                    let half: f64 = 0.5 * phase * h;
                    let exact = phase * (half.sin() / half).powi(order);
                    let sums = integral_sums(kernel, h, phase);
                    // Rounding of a sum of a few hundred terms below one.
                    assert!((sums.gradient - exact).abs() < 1e-14 * phase.max(1.0));
                    assert!((sums.curvature - exact * phase).abs() < 1e-13);
                }
            }
        }
    }

    #[test]
    fn the_lattice_sums_approach_the_integrals_as_the_lattice_grows_finer() {
        // Fixed κh, growing h/Δ. W'' has corners at the knots, so the trapezoidal rule is wrong by the
        // second power of Δ/h; the factor is the jump of the slope there.
        for kernel in Kernel::ALL {
            for l in [4, 16] {
                let wanted = 1.3 / f64::from(l * l);
                let phase = 2.0 / f64::from(l);
                let sums = LatticeSums::new(kernel, &integer(l.into()), Density::MassPerSpacing);
                let (sums, exact) =
                    (sums.unwrap().compile().at(phase), integral_sums(kernel, f64::from(l), phase));
                assert!((sums.gradient / exact.gradient - 1.0).abs() < wanted, "{kernel} {l}");
                assert!((sums.curvature / exact.curvature - 1.0).abs() < wanted, "{kernel} {l}");
                assert!((sums.slope / exact.slope - 1.0).abs() < wanted, "{kernel} {l}");
            }
        }
    }

    #[test]
    fn the_approximation_holds_for_long_waves_only() {
        let at = |ratio: &Rational, phase: f64| {
            let sph = catalogue::method("sph").unwrap();
            let lattice = LatticeMethod::new(sph, Kernel::CubicSpline, ratio).unwrap();
            compare_integral(&lattice, phase).unwrap()
        };
        let whole = integer(1);
        let long = at(&whole, 1e-3).relative_error().unwrap();
        let short = at(&whole, 3.0).relative_error().unwrap();
        assert!(long.abs() < 1e-6 && short.abs() > 0.1);
        // (50): both tend to c²κ².
        assert!((at(&whole, 1e-3).integral / 1e-6 - 1.0).abs() < 1e-6);
        assert_eq!(at(&ratio(3, 2), std::f64::consts::PI).relative_error(), None);
    }
}
