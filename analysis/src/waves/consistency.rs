//! Consistency and order of accuracy of an advection scheme, read off its symbol.

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer};
use crate::scheme::symbol::EnclosedSymbol;
use num_traits::{One, Zero};

/// How far the Taylor expansion of the symbol at `φ = 0` follows that of the exact solution.
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

/// Reads order and consistency off a symbol.
///
/// ```
/// use courant_analysis::{waves::consistency::consistency, kernel::Kernel, exact::rational::ratio};
/// use courant_analysis::scheme::{AdvectionScheme, Discretisation, Scheme};
/// let order = |scheme, l| {
///     let symbol = Discretisation::new(scheme, Kernel::CubicSpline, l).unwrap().symbol();
///     consistency(&symbol).order
/// };
/// assert_eq!(order(AdvectionScheme::GodunovSph, ratio(2, 1)), Some(1));
/// assert_eq!(order(AdvectionScheme::LaxWendroffSph, ratio(2, 1)), Some(2));
/// assert_eq!(order(AdvectionScheme::GodunovSph, ratio(13, 10)), Some(0));
/// assert_eq!(order(AdvectionScheme::LaxWendroffSph, ratio(13, 10)), None);
/// ```
pub fn consistency(symbol: &EnclosedSymbol) -> Consistency {
    let speed_ratio = -symbol.center().moment(1, integer).coefficient(1);
    let defect = |power: u32| {
        if power == 0 && symbol.keeps_constants() {
            return Polynomial::zero();
        }
        let sign = if power.is_multiple_of(2) { Rational::one() } else { -Rational::one() };
        symbol.center().moment(power, integer) - Polynomial::monomial(sign, power as usize)
    };
    let first = (0..=HIGHEST_MOMENT).map(|p| (p, defect(p))).find(|(_, defect)| !defect.is_zero());
    let (order, defect) = match first {
        Some((power, defect)) => (power.checked_sub(1), defect),
        None => (Some(HIGHEST_MOMENT), Polynomial::zero()),
    };
    Consistency { keeps_constants: symbol.keeps_constants(), order, speed_ratio, defect }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{ratio, to_f64};
    use crate::kernel::Kernel;
    use crate::scheme::{AdvectionScheme, Discretisation, Scheme};
    use proptest::prelude::*;

    #[test]
    fn the_cut_gaussian_is_never_quite_consistent() {
        for scheme in AdvectionScheme::ALL {
            let symbol =
                Discretisation::new(scheme, Kernel::Gaussian, integer(2)).unwrap().symbol();
            let found = consistency(&symbol);
            let drifts = scheme == AdvectionScheme::LaxWendroffSph;
            assert_eq!(found.order, if drifts { None } else { Some(0) }, "{scheme}");
            assert!((to_f64(&found.speed_ratio) - 1.0).abs() < 1e-3);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn the_symbol_leaves_the_shift_with_the_first_defect(
            numerator in 5i64..50, courant in 1i64..9, scheme in 0usize..3
        ) {
            // Taylor's theorem: |g − e^{−iCφ}| = |defect| φ^p / p! up to the next moment of |c_k|.
            let l = ratio(numerator, 10);
            let discretisation =
                Discretisation::new(AdvectionScheme::ALL[scheme], Kernel::CubicSpline, l).unwrap();
            let symbol = discretisation.symbol();
            let courant_number = ratio(courant, 10);
            let c = to_f64(&courant_number);
            let found = consistency(&symbol);
            let p = found.order.map_or(0, |order| order as i32 + 1);
            let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
            let next: f64 = symbol
                .center()
                .at_courant_number(&courant_number)
                .terms()
                .map(|(k, value)| to_f64(value).abs() * (k as f64).abs().powi(p + 1))
                .sum::<f64>()
                + c.powi(p + 1);
            for phase in [1e-2, 1e-3] {
                let shift = num_complex::Complex64::from_polar(1.0, -c * phase);
                let error = (symbol.center().compile().amplification(c, phase) - shift).norm();
                let leading =
                    to_f64(&found.defect.evaluate(&courant_number)).abs() * phase.powi(p) / factorial(p);
                let remainder = next * phase.powi(p + 1) / factorial(p + 1);
                prop_assert!((error - leading).abs() <= remainder + 1e-14, "{:?} at {}", found, phase);
            }
        }
    }
}
