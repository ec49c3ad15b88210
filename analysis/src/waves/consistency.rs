//! Consistency and order of accuracy of an advection scheme, read off its coefficients.

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::Rational;
use crate::scheme::Step;
use num_traits::{One, Zero};

/// How far the Taylor expansion of the amplification factor at `φ = 0` follows that of the exact solution.
///
/// The exact shift `e^{−iCφ}` has the moments `(−C)^p`; a scheme has `Σ_k c_k k^p`. They must agree for
/// `p = 0` (constants are kept), `p = 1` (waves travel at the right speed) and so on up to the order.
#[derive(Debug, Clone, PartialEq)]
pub struct Consistency {
    /// Whether a constant is mapped to itself at every Courant number.
    pub keeps_constants: bool,
    /// The highest `p` up to which all moments agree at every Courant number; `None` when not even
    /// constants are kept. Order 0 means that long waves travel at a wrong speed.
    pub order: Option<u32>,
    /// The speed of long waves over the true speed; it is 1 from order 1 on.
    pub speed_ratio: Rational,
    /// The first moment that disagrees minus its true value, a polynomial in `C`.
    pub defect: Polynomial<Rational>,
}

/// Moments are compared up to this one; no scheme here comes near.
const HIGHEST_MOMENT: u32 = 24;

/// Order and consistency of an explicit scheme for `u_t + a u_x = 0` whose parameter is the Courant number; `None` for other schemes.
///
/// ```
/// use courant_analysis::{exact::rational::ratio, kernel::Kernel, scheme::catalogue};
/// use courant_analysis::waves::consistency::consistency;
/// let order = |scheme, l| {
///     let step = catalogue::scheme(scheme).unwrap().with_kernel(Kernel::CubicSpline, &l).unwrap();
///     consistency(&step, "C").unwrap().order
/// };
/// assert_eq!(order("godunov-sph", ratio(2, 1)), Some(1));
/// assert_eq!(order("lax-wendroff-sph", ratio(2, 1)), Some(2));
/// assert_eq!(order("godunov-sph", ratio(13, 10)), Some(0));
/// assert_eq!(order("lax-wendroff-sph", ratio(13, 10)), None);
/// ```
pub fn consistency(step: &Step, parameter: &str) -> Option<Consistency> {
    let one_step = step.one_step(parameter)?;
    let speed_ratio = -one_step.moment(1).coefficient(1);
    let defect = |power: u32| {
        if power == 0 && one_step.keeps_constants {
            return Polynomial::zero();
        }
        let sign = if power.is_multiple_of(2) { Rational::one() } else { -Rational::one() };
        one_step.moment(power) - Polynomial::monomial(sign, power as usize)
    };
    let first = (0..=HIGHEST_MOMENT).map(|p| (p, defect(p))).find(|(_, defect)| !defect.is_zero());
    let (order, defect) = match first {
        Some((power, defect)) => (power.checked_sub(1), defect),
        None => (Some(HIGHEST_MOMENT), Polynomial::zero()),
    };
    Some(Consistency { keeps_constants: one_step.keeps_constants, order, speed_ratio, defect })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{integer, ratio, to_f64};
    use crate::kernel::Kernel;
    use crate::scheme::testing::{SPH, sph};
    use proptest::prelude::*;

    #[test]
    fn the_cut_gaussian_is_never_quite_consistent() {
        for scheme in SPH {
            let found = consistency(&sph(scheme, Kernel::Gaussian, &integer(2)), "C").unwrap();
            let drifts = scheme == "lax-wendroff-sph";
            assert_eq!(found.order, if drifts { None } else { Some(0) }, "{scheme}");
            assert!((to_f64(&found.speed_ratio) - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn orders_of_the_literature() {
        for (text, order) in [
            (
                "u[n+1,j] = u[n,j] - C*(u[n,j+1] - u[n,j-1])/2 + C^2/2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])",
                Some(2),
            ),
            ("u[n+1,j] = (u[n,j+1] + u[n,j-1])/2 - C*(u[n,j+1] - u[n,j-1])/2", Some(1)),
            ("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])", None),
        ] {
            let found = consistency(&Step::from_text(text).unwrap(), "C");
            assert_eq!(found.and_then(|found| found.order), order, "{text}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn the_gain_leaves_the_shift_with_the_first_defect(
            numerator in 5i64..50, courant in 1i64..9, scheme in 0usize..3
        ) {
            // Taylor's theorem: |g − e^{−iCφ}| = |defect| φ^p / p! up to the next moment of |c_k|.
            let step = sph(SPH[scheme], Kernel::CubicSpline, &ratio(numerator, 10));
            let courant_number = ratio(courant, 10);
            let c = to_f64(&courant_number);
            let found = consistency(&step, "C").unwrap();
            let stencil = step.one_step("C").unwrap().stencil_at(&courant_number).map(to_f64);
            let p = found.order.map_or(0, |order| order as i32 + 1);
            let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
            let next: f64 = stencil
                .terms()
                .map(|(k, value)| value.abs() * (k as f64).abs().powi(p + 1))
                .sum::<f64>()
                + c.powi(p + 1);
            for phase in [1e-2, 1e-3] {
                let shift = num_complex::Complex64::from_polar(1.0, -c * phase);
                let error = (stencil.at_phase(phase) - shift).norm();
                let leading =
                    to_f64(&found.defect.evaluate(&courant_number)).abs() * phase.powi(p) / factorial(p);
                let remainder = next * phase.powi(p + 1) / factorial(p + 1);
                prop_assert!((error - leading).abs() <= remainder + 1e-14, "{:?} at {}", found, phase);
            }
        }
    }
}
