//! The density that goes with unit mass per lattice spacing.

use crate::exact::fixed_point;
use crate::exact::rational::{Rational, integer};
use crate::kernel::Kernel;
use crate::kernel::lattice::RatioOutOfRange;
use num_traits::{ToPrimitive, Zero};

/// Which density `ρ0` of the undisturbed lattice the equations use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub enum Density {
    /// What the particles see: `ρ0 = M Σ_b W(x_a − x_b)`, the particle itself included.
    #[default]
    Summation,
    /// The mass per spacing, `ρ0 = M/Δ`: equal to the former only where the kernel sums to one on the
    /// lattice. Cha & Whitworth 2003 draw their figures with `M = Δ = 1`.
    MassPerSpacing,
}

impl Density {
    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Summation => "summation",
            Self::MassPerSpacing => "mass-per-spacing",
        }
    }

    /// The formula, for captions.
    pub fn formula(self) -> &'static str {
        match self {
            Self::Summation => "ρ0 = M Σ W",
            Self::MassPerSpacing => "ρ0 = M/Δ",
        }
    }
}

impl std::str::FromStr for Density {
    type Err = UnknownDensity;
    fn from_str(text: &str) -> Result<Self, UnknownDensity> {
        match text.trim().to_ascii_lowercase().as_str() {
            "summation" => Ok(Self::Summation),
            "continuity" | "mass" | "mass-per-spacing" => Ok(Self::MassPerSpacing),
            _ => Err(UnknownDensity(text.into())),
        }
    }
}

/// A name that is no density's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no density `{0}`; accepted: summation, continuity")]
pub struct UnknownDensity(pub String);

/// A positive number and how far it may be from the true one.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosure {
    /// The number in the middle.
    pub center: Rational,
    /// How far the true number may be; zero when it is exact.
    pub radius: Rational,
}

/// `ρ0 Δ/M`: exact for polynomial kernels.
///
/// ```
/// use courant_analysis::kernel::{Density, relative_density};
/// use courant_analysis::{kernel::Kernel, exact::rational::ratio};
/// // At h = Δ the cubic spline sums to 2/3 + 2·1/6 = 1; at h = 3Δ/2 it misses one by 1/243.
/// let sum = |l| relative_density(Kernel::CubicSpline, &l, Density::Summation).unwrap().center;
/// assert_eq!(sum(ratio(1, 1)), ratio(1, 1));
/// assert_eq!(sum(ratio(3, 2)), ratio(244, 243));
/// ```
///
/// # Errors
/// When the ratio is not in `[1/100, 50]`.
pub fn relative_density(
    kernel: Kernel,
    ratio: &Rational,
    density: Density,
) -> Result<Enclosure, RatioOutOfRange> {
    RatioOutOfRange::check(ratio)?;
    if density == Density::MassPerSpacing {
        return Ok(Enclosure { center: integer(1), radius: Rational::zero() });
    }
    // A lattice point exactly on the edge of the support belongs to it.
    let reach = (kernel.exact_support() * ratio).floor().to_integer().to_i64();
    let reach = reach.expect("a ratio of at most 50 gives a small integer");
    let norm = fixed_point::dyadic(fixed_point::inverse_sqrt_of_pi());
    let shape = |k: i64| {
        let q = integer(k) / ratio;
        match kernel.polynomial() {
            Some(shape) => shape.exact(&q, 0),
            None => fixed_point::dyadic(fixed_point::exp_of_minus(&(&q * &q))) * &norm,
        }
    };
    let sum = shape(0) + (1..=reach).map(|k| integer(2) * shape(k)).sum::<Rational>();
    // Two factors, both below one, each wrong by at most a radius.
    let radius = match kernel.polynomial() {
        Some(_) => Rational::zero(),
        None => fixed_point::radius() * integer(3 * (2 * reach + 1)) / ratio,
    };
    Ok(Enclosure { center: sum / ratio, radius })
}

/// `W_k = Δ W(kΔ)` on the lattice: exact for polynomial kernels.
pub(crate) fn relative_value(kernel: Kernel, ratio: &Rational, k: i64) -> Enclosure {
    let q = integer(k) / ratio;
    match kernel.polynomial() {
        Some(shape) => Enclosure { center: shape.exact(&q, 0) / ratio, radius: Rational::zero() },
        None => {
            let norm = fixed_point::dyadic(fixed_point::inverse_sqrt_of_pi());
            let value = fixed_point::dyadic(fixed_point::exp_of_minus(&(&q * &q))) * norm;
            // Two factors, both below one, each wrong by at most a radius.
            Enclosure { center: value / ratio, radius: fixed_point::radius() * integer(3) / ratio }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{ratio as fraction, to_f64};

    #[test]
    fn splines_of_whole_ratios_sum_to_one() {
        // A B-spline of order n on the lattice of its own knots is a partition of unity.
        for kernel in [Kernel::CubicSpline, Kernel::QuarticSpline, Kernel::QuinticSpline] {
            for l in 1..=4 {
                let sum = relative_density(kernel, &integer(l), Density::Summation).unwrap();
                assert_eq!(sum, Enclosure { center: integer(1), radius: integer(0) }, "{kernel}");
            }
        }
    }

    #[test]
    fn the_exact_sum_is_the_sum_of_the_fast_kernel() {
        for kernel in Kernel::ALL {
            for l in [fraction(3, 4), fraction(6, 5), fraction(7, 3)] {
                let float = to_f64(&l);
                let direct: f64 =
                    (-20i32..=20).map(|k| kernel.value(f64::from(k.abs()) / float) / float).sum();
                let sum = relative_density(kernel, &l, Density::Summation).unwrap();
                assert!((to_f64(&sum.center) - direct).abs() < 1e-14, "{kernel} {l}");
                assert!(to_f64(&sum.radius) < 1e-50);
            }
        }
        assert!(relative_density(Kernel::CubicSpline, &integer(0), Density::Summation).is_err());
    }
}
