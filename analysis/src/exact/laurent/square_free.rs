//! Factors without squares, and the squares left out.

use super::divisor::{greatest_common_divisor, normal};
use super::{Laurent, VARIABLES, Variable};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// `[f_1, f_2, …]` with `p = c f_1 f_2² f_3³ …`, each without multiple factors; monomial factors are dropped.
pub(crate) fn square_free_factors(polynomial: &Laurent) -> Vec<Laurent> {
    let polynomial = normal(polynomial.primitive());
    // The variable of the least degree: few and short coefficients have their content found soonest.
    let occurring = (0..VARIABLES).map(Variable).filter(|&v| polynomial.contains(v));
    let Some(main) = occurring.min_by_key(|&v| polynomial.degree(v)) else {
        return Vec::new();
    };
    let content = polynomial.content(main);
    let whole = polynomial.divide_exactly(&content).expect("a content divides");
    let mut factors = square_free_factors(&content);
    // Yun's algorithm in the main variable.
    let derivative = whole.derivative(main);
    let repeated = greatest_common_divisor(&whole, &derivative);
    let exactly = |a: &Laurent, b: &Laurent| a.divide_exactly(b).expect("a divisor divides");
    let mut simple = exactly(&whole, &repeated);
    let mut rest = exactly(&derivative, &repeated) - simple.derivative(main);
    let mut multiplicity = 0;
    while simple.contains(main) {
        let factor =
            if rest.is_zero() { simple.clone() } else { greatest_common_divisor(&simple, &rest) };
        simple = exactly(&simple, &factor);
        rest = exactly(&rest, &factor) - simple.derivative(main);
        if factors.len() <= multiplicity {
            factors.resize(multiplicity + 1, Laurent::integer(1));
        }
        factors[multiplicity] = &factors[multiplicity] * &factor;
        multiplicity += 1;
    }
    factors
}

impl Laurent {
    /// Without the squares in it: of a real function of the wave, a real one of the same sign wherever no factor vanishes. Factors that are
    /// powers of names are dropped too and must be positive.
    pub fn odd_part(&self) -> Self {
        let factors = square_free_factors(self);
        let mut odd = Self::integer(1);
        let mut even = Self::integer(1);
        let mut shift = [0; VARIABLES];
        let mut negative = false;
        for (multiplicity, factor) in (1..).zip(&factors) {
            if multiplicity % 2 == 1 {
                odd = &odd * factor;
            }
            let squares = multiplicity / 2;
            if squares == 0 {
                continue;
            }
            // On a wave f² is ±|f|² times a shift, as f is even or odd under E → 1/E.
            let mut mirrored = factor.conjugate();
            for axis in 0..3 {
                let degree = factor.degree(Variable::axis(axis));
                mirrored = mirrored.shifted(Variable::axis(axis), degree);
                shift[1 + axis] += degree * squares as i16;
            }
            let antisymmetric = mirrored == -factor.clone();
            if !antisymmetric && mirrored != *factor {
                return self.clone();
            }
            negative ^= antisymmetric && squares % 2 == 1;
            even = &even * &factor.pow(2 * squares);
        }
        // What the square-free factors leave over is a monomial: its sign and its shift.
        let rest = self.divide_exactly(&(&odd * &even)).expect("factors divide");
        let (exponents, value) = rest.as_monomial().expect("only a monomial is left");
        for axis in 1..4 {
            shift[axis] += exponents[axis];
        }
        let sign = if negative { -value.signum() } else { value.signum() };
        odd * Self::monomial(shift, sign)
    }

    /// `(root, rest)` with `p = root² rest`, `rest` without squares of polynomials or of small numbers; `(0, 1)` for zero.
    pub fn square_part(&self) -> (Self, Self) {
        let mut root = Self::integer(1);
        for (multiplicity, factor) in (1..).zip(&square_free_factors(self)) {
            root = &root * &factor.pow(multiplicity / 2);
        }
        let Some(rest) = self.divide_exactly(&(&root * &root)).filter(|rest| !rest.is_zero())
        else {
            return (Self::default(), Self::integer(1));
        };
        let monomial = rest.lowest_powers().map(|power| power.div_euclid(2));
        let mut content = rest.integer_content();
        let mut factor = BigInt::one();
        for whole in 2i64..1000 {
            while (&content % (whole * whole)).is_zero() {
                content /= whole * whole;
                factor *= whole;
            }
        }
        let left = content.sqrt();
        if &left * &left == content {
            factor *= left;
        }
        let (shift, square) = (Self::monomial(monomial, factor.clone()), factor.pow(2));
        let rest = rest.divide_exactly(&Self::monomial(monomial.map(|power| 2 * power), square));
        (root * shift, rest.expect("the square divides"))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::laurent;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]
        #[test]
        fn a_square_and_a_rest_without_squares(a in laurent(), b in laurent(), factor in 1i64..40, by in -3i16..4) {
            let whole = (&(&a * &a) * &b).scaled(&factor.into()).shifted(Variable::name(0), by);
            let (root, rest) = whole.square_part();
            prop_assert_eq!(&(&root * &root) * &rest, whole.clone());
            if whole.is_zero() {
                prop_assert_eq!((root, rest), (Laurent::default(), Laurent::integer(1)));
                return Ok(());
            }
            prop_assert!(square_free_factors(&rest).len() <= 1, "{}", rest);
            prop_assert!(root.primitive().divide_exactly(&a.primitive()).is_some(), "{} of {}", root, whole);
            prop_assert!(rest.lowest_powers().iter().all(|power| (0..2).contains(power)));
            let content = rest.integer_content();
            prop_assert!((2i64..9).all(|n| (&content % (n * n)) != BigInt::zero()), "{}", content);
        }
    }
}
