//! The polynomials in `t` at whose roots alone stability can begin or end.
//!
//! Where a margin `P(s, t)` that is nowhere negative on `0 ≤ s ≤ 1` becomes negative somewhere, it vanishes: at `s = 0`, at
//! `s = 1`, or with a double root in between. So `t` is a root of `P(0, t)`, of `P(1, t)` or of the discriminant of `P` in
//! `s`. Between two such roots the number of zeros in `s` cannot change, and neither can the answer.

use crate::exact::algebraic_number::AlgebraicNumber;
use crate::exact::common_factor::{greatest_common_divisor, is_square_free, square_free_factors};
use crate::exact::descartes::sign_changes;
use crate::exact::discriminant::{Bivariate, primitive};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, common_denominator, integer, numerator_over};
use crate::exact::real_roots::power_of_two;
use crate::stability::margin::Margin;
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// The critical polynomials of an exact margin.
#[derive(Debug, Clone)]
pub(super) struct CriticalPolynomials {
    /// Square-free polynomials without common roots; their roots are the critical values.
    factors: Vec<Polynomial<BigInt>>,
    /// Square-free, with the roots of all of them.
    product: Polynomial<BigInt>,
}

impl CriticalPolynomials {
    /// Of a margin with exact coefficients; `None` when the discriminant would take more products of residues than
    /// permitted, or when every `t` is critical.
    pub(super) fn new(margin: &Margin, most_products: usize) -> Option<Self> {
        let powers: Vec<Polynomial<BigInt>> =
            margin.integer_series().iter().map(|series| series.in_powers_of_s()).collect();
        let at_end = |value: &dyn Fn(&Polynomial<BigInt>) -> BigInt| {
            Polynomial::new(powers.iter().map(value).collect())
        };
        let ends = [
            at_end(&|power| power.coefficient(0)),
            at_end(&|power| power.evaluate(&BigInt::one())),
        ];
        let margin = Bivariate::new(powers);
        if margin.cost().total() > most_products {
            return None;
        }
        let [at_zero, at_one] = ends;
        let mut factors: Vec<Polynomial<BigInt>> = Vec::new();
        // The short ones first: what they share with the discriminant is taken out of it.
        for polynomial in [primitive(&at_zero), primitive(&at_one), margin.discriminant()] {
            if polynomial.is_zero() {
                return None;
            }
            for mut factor in square_free(&polynomial)? {
                for known in &factors {
                    let common = primitive_common_divisor(&factor, known)?;
                    factor = factor.divide_exactly(&common)?;
                }
                factors.push(factor);
            }
        }
        let product = factors.iter().cloned().fold(Polynomial::one(), std::ops::Mul::mul);
        Some(Self { factors, product })
    }

    /// The only critical value in a narrow interval of positive `t`; `None` if that is not certain.
    pub(super) fn root_between(
        &self,
        lower: &Rational,
        upper: &Rational,
    ) -> Option<AlgebraicNumber> {
        // Wide enough for signs to be cheap, narrow enough for there to be one.
        let widen = [20, 40].into_iter().map(|bits| {
            let step = power_of_two(-bits);
            (lower * (integer(1) - &step), upper * (integer(1) + step))
        });
        let alone = widen
            .chain([(lower.clone(), upper.clone())])
            .find(|(lower, upper)| sign_changes(&self.product, lower, upper) == 1)?;
        let (from, to) = alone;
        let simplest = self
            .factors
            .iter()
            .filter(|factor| sign_changes(factor, &from, &to) == 1)
            .min_by_key(|factor| factor.degree())?;
        let number = AlgebraicNumber::between(simplest.clone(), from, to)?;
        let (below, above) = number.enclosure(128);
        (below <= *upper && *lower <= above).then_some(number)
    }

    /// The square-free polynomial whose roots are all critical values.
    pub(super) fn product(&self) -> &Polynomial<BigInt> {
        &self.product
    }
}

/// Factors of a primitive polynomial without multiple roots and without the root 0, primitive too.
fn square_free(polynomial: &Polynomial<BigInt>) -> Option<Vec<Polynomial<BigInt>>> {
    let zeros = polynomial.coefficients().iter().take_while(|value| value.is_zero()).count();
    let rest = Polynomial::new(polynomial.coefficients()[zeros..].to_vec());
    if is_square_free(&rest) {
        return Some(vec![rest]);
    }
    let factors = square_free_factors(rest.map(|value| Rational::from(value.clone())))?;
    Some(factors.iter().map(whole).collect())
}

/// The greatest common divisor of primitive polynomials, primitive.
fn primitive_common_divisor(
    left: &Polynomial<BigInt>,
    right: &Polynomial<BigInt>,
) -> Option<Polynomial<BigInt>> {
    let fractions =
        |polynomial: &Polynomial<BigInt>| polynomial.map(|value| Rational::from(value.clone()));
    greatest_common_divisor(&fractions(left), &fractions(right)).map(|common| whole(&common))
}

/// The primitive integer multiple.
fn whole(polynomial: &Polynomial<Rational>) -> Polynomial<BigInt> {
    let common = common_denominator(polynomial.coefficients());
    primitive(&polynomial.map(|value| numerator_over(value, &common)))
}
