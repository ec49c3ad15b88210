//! The two transcendental numbers the Gaussian kernel needs, enclosed in rationals: `e^{−x}` for a
//! rational `x` and `1/√π`, in integer fixed-point arithmetic with a counted error.

use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Bits after the binary point of the results.
pub const PRECISION: u32 = 192;

/// Extra bits carried while computing: more than `log2` of every error count below.
const GUARD: u32 = 64;

const WORKING: u32 = PRECISION + GUARD;

/// One unit, half the width of every enclosure of this module: `2^−PRECISION`.
pub fn radius() -> Rational {
    Rational::new(BigInt::one(), BigInt::one() << PRECISION)
}

/// The number `mantissa · 2^−PRECISION`, reduced by shifting: a general gcd takes a step for every bit.
pub fn dyadic(mantissa: BigInt) -> Rational {
    let twos = mantissa.trailing_zeros().unwrap_or(u64::MAX).min(u64::from(PRECISION));
    Rational::new_raw(mantissa >> twos, BigInt::one() << (u64::from(PRECISION) - twos))
}

/// `e^{−x}` for `0 ≤ x ≤ 64` in units of `2^−PRECISION`, within one unit of the truth.
///
/// `e^{−x} = (e^{−x/1024})^1024` with the Taylor series for the inner factor. In units of the last
/// working bit the series has at most 60 terms, each wrong by at most 2; ten squarings of numbers
/// below 1 at most double the error and add 1 each. That is below `2^20 ≪ 2^GUARD`.
///
/// # Panics
/// When `x` is outside `[0, 64]`.
pub fn exp_of_minus(x: &Rational) -> BigInt {
    assert!(!x.is_negative() && *x <= Rational::from(BigInt::from(64)), "0 ≤ x ≤ 64");
    let one = BigInt::one() << WORKING;
    let reduced: BigInt = (x.numer() << WORKING) / (x.denom() << 10);
    let (mut sum, mut term) = (one.clone(), one);
    for order in 1u32.. {
        term = -((term * &reduced) >> WORKING) / order;
        if term.is_zero() || (term == -BigInt::one()) {
            break;
        }
        sum += &term;
    }
    for _ in 0..10 {
        sum = (&sum * &sum) >> WORKING;
    }
    sum >> GUARD
}

/// `1/√π` in units of `2^−PRECISION`, within one unit of the truth.
///
/// Machin's `π = 16 arctan(1/5) − 4 arctan(1/239)` and an integer square root; the series have fewer
/// than 120 terms wrong by at most 2 units each.
pub fn inverse_sqrt_of_pi() -> BigInt {
    let arctan_of_inverse = |n: u32| {
        let mut power = (BigInt::one() << WORKING) / n;
        let mut sum = power.clone();
        for order in 1u32.. {
            power /= n * n;
            let term = &power / (2 * order + 1);
            if term.is_zero() {
                break;
            }
            if order % 2 == 1 { sum -= term } else { sum += term }
        }
        sum
    };
    let pi = arctan_of_inverse(5) * 16 - arctan_of_inverse(239) * 4;
    // √(2^{2W} · 2^W / π_fixed) = 2^W / √π.
    let square: BigInt = (BigInt::one() << (3 * WORKING)) / pi;
    square.sqrt() >> GUARD
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::{parse, ratio, to_f64};
    use proptest::prelude::*;

    #[test]
    fn fifty_published_digits() {
        let tolerance = parse("1e-49").unwrap();
        // OEIS A068985 (1/e) and A087197 (1/√π).
        let inverse_e = parse("0.36787944117144232159552377016146086744581113103177").unwrap();
        assert!((dyadic(exp_of_minus(&ratio(1, 1))) - inverse_e).abs() < tolerance);
        let published = parse("0.56418958354775628694807945156077258584405062932900").unwrap();
        assert!((dyadic(inverse_sqrt_of_pi()) - published).abs() < tolerance);
    }

    #[test]
    fn the_square_root_squares_to_an_enclosure_of_one_over_pi() {
        let root = dyadic(inverse_sqrt_of_pi());
        // π to 50 digits, OEIS A000796.
        let pi = parse("3.1415926535897932384626433832795028841971693993751").unwrap();
        let product = &root * &root * pi - Rational::one();
        assert!(product.abs() < parse("1e-48").unwrap());
    }

    proptest! {
        #[test]
        fn the_exponential_turns_sums_into_products(a in 0i64..4500, b in 0i64..4500) {
            let (a, b) = (ratio(a, 500), ratio(b, 500));
            let exp = |x: &Rational| dyadic(exp_of_minus(x));
            let error = exp(&(&a + &b)) - exp(&a) * exp(&b);
            // Three enclosures, factors at most one.
            prop_assert!(error.abs() <= radius() * ratio(3, 1));
        }

        #[test]
        fn the_exponential_agrees_with_the_standard_library(a in 0i64..9000) {
            let exact = to_f64(&dyadic(exp_of_minus(&ratio(a, 1000))));
            let library = (-(a as f64) / 1000.0).exp();
            // The library's argument is rounded: a relative error of x ε in the result, and two roundings.
            let tolerance = (a as f64 / 1000.0 + 2.0) * f64::EPSILON;
            prop_assert!((exact - library).abs() <= tolerance * library);
        }
    }
}
