//! The largest Courant number up to which every coefficient of the scheme is non-negative, so that new
//! values are averages of old ones: Ferrari et al. 2008 (2.24).

use super::{Evidence, ExactValue, Limit};
use crate::exact::algebraic_number::AlgebraicNumber;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, common_denominator, integer, numerator_over, to_f64_below};
use crate::exact::real_roots::{RealRoot, real_roots};
use crate::exact::stencil::Stencil;
use crate::scheme::symbol::EnclosedSymbol;
use num_traits::{Signed, Zero};

/// Roots are enclosed to this many bits of their size: more than the enclosures of the Gaussian settle.
const ROOT_BITS: u32 = 200;

/// The monotonicity limit within `[0, max_courant]`; value 0 when a coefficient is negative for every
/// small positive Courant number. [`Limit::binding_offset`] names the coefficient that binds.
///
/// ```
/// use courant_analysis::{kernel::Kernel, stability::monotonicity_limit, exact::rational::integer};
/// use courant_analysis::scheme::{AdvectionScheme, Discretisation, Scheme};
/// let scheme = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(2));
/// let limit = monotonicity_limit(&scheme.unwrap().symbol(), &integer(10));
/// assert_eq!(limit.exact().unwrap().to_string(), "8/5");
/// assert_eq!(limit.binding_offset(), Some(0));
/// ```
pub fn monotonicity_limit(symbol: &EnclosedSymbol, max_courant: &Rational) -> Limit {
    let evidence = if symbol.is_exact() { Evidence::Proved } else { Evidence::Enclosed };
    let mut binding: Option<(i64, RealRoot, Polynomial<Rational>)> = None;
    // Coefficients that are negative at once come first: they end the search.
    let mut coefficients = enclosed_coefficients(symbol);
    coefficients.sort_by_key(|(_, center, _)| !starts_negative(center));
    for (offset, coefficient, radius) in coefficients {
        let end = binding.as_ref().map_or(max_courant, |(_, root, _)| &root.upper);
        if end.is_zero() {
            break;
        }
        let Some(root) = first_negative(&coefficient, &radius, end) else { continue };
        if binding.as_ref().is_none_or(|(_, best, _)| root.lower < best.lower) {
            binding = Some((offset, root, coefficient));
        }
    }
    let Some((offset, root, coefficient)) = binding else {
        return Limit::beyond(max_courant, evidence);
    };
    let limit = match root.exact() {
        Some(value) if symbol.is_exact() || value.is_zero() => {
            Limit::exactly(ExactValue::Fraction(value.clone()), evidence)
        }
        _ if root.upper == *max_courant => {
            Limit::between(to_f64_below(&root.lower), f64::INFINITY, Evidence::Undecided)
        }
        _ => match symbol.is_exact().then(|| algebraic(&coefficient, &root)).flatten() {
            Some(number) => match square_root(&coefficient) {
                Some(exact) => Limit::exactly(exact, evidence),
                None => Limit::root_of(number, evidence),
            },
            None => Limit::enclosed(root.lower, root.upper, evidence),
        },
    };
    limit.at_offset(offset)
}

/// The positive root of `a + b C²`.
fn square_root(coefficient: &Polynomial<Rational>) -> Option<ExactValue> {
    match coefficient.coefficients() {
        [a, none, b] if none.is_zero() => Some(ExactValue::square_root(-a / b)),
        _ => None,
    }
}

/// A root of the coefficient where it changes its sign.
fn algebraic(coefficient: &Polynomial<Rational>, root: &RealRoot) -> Option<AlgebraicNumber> {
    let common = common_denominator(coefficient.coefficients());
    let integers = coefficient.map(|value| numerator_over(value, &common));
    AlgebraicNumber::between(integers, root.lower.clone(), root.upper.clone())
}

/// Every coefficient of the scheme that is not identically zero: its offset, its center as a polynomial
/// in `C`, and a radius for each power of `C`.
pub(crate) fn enclosed_coefficients(
    symbol: &EnclosedSymbol,
) -> Vec<(i64, Polynomial<Rational>, Polynomial<Rational>)> {
    let radii = symbol.coefficient_radius();
    let reaches = radii.iter().filter_map(Stencil::reach).chain(symbol.center().reach());
    let Some((low, high)) = reaches.reduce(|(a, b), (c, d)| (a.min(c), b.max(d))) else {
        return Vec::new();
    };
    let coefficients = (low..=high).map(|offset| {
        let radius = radii.iter().map(|radius| radius.coefficient(offset)).collect();
        (offset, symbol.center().coefficient(offset), Polynomial::new(radius))
    });
    coefficients.filter(|(_, center, radius)| !center.is_zero() || !radius.is_zero()).collect()
}

/// Whether the polynomial is negative for every small positive `C`.
fn starts_negative(polynomial: &Polynomial<Rational>) -> bool {
    polynomial.coefficients().iter().find(|value| !value.is_zero()).is_some_and(Signed::is_negative)
}

/// Encloses the smallest `C ∈ [0, end)` above which the polynomial is negative, if there is one.
fn first_negative(
    coefficient: &Polynomial<Rational>,
    radius: &Polynomial<Rational>,
    end: &Rational,
) -> Option<RealRoot> {
    let lower = first_sign_change(&(coefficient.clone() - radius.clone()), end);
    let upper = first_sign_change(&(coefficient.clone() + radius.clone()), end);
    match (lower, upper) {
        (None, _) => None,
        (Some(lower), Some(upper)) => Some(RealRoot { lower: lower.lower, upper: upper.upper }),
        // Perhaps lost within the range, by the uncertainty of the data alone.
        (Some(lower), None) => Some(RealRoot { lower: lower.lower, upper: end.clone() }),
    }
}

/// The first point of `[0, end)` from which the polynomial goes negative.
fn first_sign_change(polynomial: &Polynomial<Rational>, end: &Rational) -> Option<RealRoot> {
    if starts_negative(polynomial) {
        return Some(RealRoot { lower: Rational::zero(), upper: Rational::zero() });
    }
    if polynomial.coefficients().iter().all(|value| !value.is_negative()) {
        return None;
    }
    if polynomial.degree() == Some(1) {
        // Not negative at 0, so it falls through zero if it has a root in the range at all.
        let root = -polynomial.coefficient(0) / polynomial.coefficient(1);
        let inside = root.is_positive() && root < *end;
        return inside.then(|| RealRoot { lower: root.clone(), upper: root });
    }
    let roots = real_roots(polynomial, &Rational::zero(), end, ROOT_BITS);
    for (index, root) in roots.iter().enumerate() {
        let next = roots.get(index + 1).map_or(end, |next| &next.lower);
        let beyond = (&root.upper + next) / integer(2);
        if beyond > root.upper && polynomial.evaluate(&beyond).is_negative() {
            return Some(root.clone());
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{ratio, to_f64};
    use crate::kernel::Kernel;
    use crate::scheme::symbol::Symbol;
    use crate::scheme::{AdvectionScheme, Discretisation, Scheme};
    use proptest::prelude::*;

    fn limit(scheme: AdvectionScheme, kernel: Kernel, l: Rational) -> Limit {
        monotonicity_limit(&Discretisation::new(scheme, kernel, l).unwrap().symbol(), &integer(100))
    }

    #[test]
    fn lax_wendroff_and_euler_are_never_monotone() {
        for scheme in [AdvectionScheme::LaxWendroffSph, AdvectionScheme::EulerSph] {
            for kernel in Kernel::ALL {
                let limit = limit(scheme, kernel, ratio(3, 2));
                assert_eq!(limit.value(), 0.0, "{scheme} {kernel}");
                assert!(!limit.is_positive());
            }
        }
    }

    #[test]
    fn an_irrational_limit_is_a_root_of_its_coefficient() {
        // c_0 = 1 − C − C² beside c_{−1} = C + C²: the golden section.
        let backward = Stencil::new(-1, vec![integer(-1), integer(1)]);
        let symbol = Symbol::identity()
            - Symbol::courant_power(1, backward.clone())
            - Symbol::courant_power(2, backward);
        let limit = monotonicity_limit(&EnclosedSymbol::exact(symbol), &integer(10));
        assert_eq!(limit.equation().unwrap().equation("C"), "-C^2 - C + 1 = 0");
        assert_eq!(limit.decimal(20).unwrap(), "0.61803398874989484820");
    }

    #[test]
    fn a_pure_square_gives_a_square_root() {
        let limit = limit(AdvectionScheme::LaxWendroffSph, Kernel::CubicSpline, ratio(1, 2));
        assert_eq!(limit.exact().unwrap().to_string(), "sqrt(1/8)");
    }

    #[test]
    fn the_exact_shift_is_monotone_to_one() {
        let limit = limit(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(1));
        assert_eq!(limit.exact().unwrap().to_string(), "1");
        assert_eq!(limit.evidence(), Evidence::Proved);
    }

    #[test]
    fn a_coefficient_that_touches_zero_does_not_bind() {
        // c_1 = C (C − 1)², c_0 = 2 − C: the touch at 1 passes, the crossing at 2 binds.
        let touching = [integer(1), integer(-2), integer(1)];
        let symbol = touching.into_iter().enumerate().fold(
            Symbol::courant_power(0, Stencil::term(0, integer(2)))
                - Symbol::courant_power(1, Stencil::term(0, integer(1))),
            |sum, (power, value)| sum + Symbol::courant_power(power + 1, Stencil::term(1, value)),
        );
        let limit = monotonicity_limit(&EnclosedSymbol::exact(symbol), &integer(10));
        assert_eq!((limit.value(), limit.binding_offset()), (2.0, Some(0)));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn godunov_is_the_inverse_of_twice_the_sum(numerator in 6i64..120) {
            let l = ratio(numerator, 10);
            for kernel in Kernel::ALL {
                let limit = limit(AdvectionScheme::GodunovSph, kernel, l.clone());
                let sum: f64 = (1..400)
                    .map(|k| {
                        let q = f64::from(k) * 10.0 / numerator as f64;
                        let inside = integer(k.into()) <= kernel.exact_support() * &l;
                        if inside { -kernel.slope(q.min(kernel.support())) } else { 0.0 }
                    })
                    .sum::<f64>() / to_f64(&l).powi(2);
                prop_assert!((limit.value() * 2.0 * sum - 1.0).abs() < 1e-13, "{} {}", kernel, l);
                prop_assert!(limit.upper() - limit.lower() <= 1e-15 * limit.value());
            }
        }
    }
}
