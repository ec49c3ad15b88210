//! `|g|²` of a symbol as exact cosine series, and how far it may be off.

use crate::exact::cosine_series::CosineSeries;
use crate::exact::rational::{Rational, common_denominator, numerator_over};
use crate::exact::stencil::Stencil;
use crate::scheme::symbol::EnclosedSymbol;
use num_bigint::BigInt;
use num_traits::{Signed, Zero};

/// `|g|²` by power of `C` as integer cosine series over the returned denominator:
/// `|Σ_k c_k e^{ikφ}|² = Σ_m (Σ_k c_k c_{k+m}) e^{−imφ}`.
pub(super) fn squared_gain(symbol: &EnclosedSymbol) -> (Vec<CosineSeries<BigInt>>, BigInt) {
    let stencils = symbol.center().stencils();
    let values = stencils.iter().flat_map(|stencil| stencil.terms().map(|(_, value)| value));
    let common = common_denominator(values);
    let scaled: Vec<Vec<(i64, BigInt)>> = stencils
        .iter()
        .map(|stencil| {
            let terms = stencil.terms().filter(|(_, value)| !value.is_zero());
            terms.map(|(k, value)| (k, numerator_over(value, &common))).collect()
        })
        .collect();
    let mut powers: Vec<Vec<BigInt>> = vec![Vec::new(); (2 * scaled.len()).saturating_sub(1)];
    for (i, left) in scaled.iter().enumerate() {
        for (j, right) in scaled.iter().enumerate().skip(i) {
            let sums = &mut powers[i + j];
            for (k, a) in left {
                for (l, b) in right {
                    let order = (k - l).unsigned_abs() as usize;
                    if sums.len() <= order {
                        sums.resize(order + 1, BigInt::zero());
                    }
                    // The mixed powers occur twice, once for each order of the factors.
                    sums[order] += if i == j { a * b } else { (a * b) << 1 };
                }
            }
        }
    }
    (powers.into_iter().map(CosineSeries::new).collect(), &common * &common)
}

/// Bounds on the error of `|g|²` by power of `C`, in the l1 norm of cosine coefficients, from
/// `|ab − a₀b₀| ≤ |a₀| r_b + |b₀| r_a + r_a r_b` for the even and the odd parts.
pub(super) fn squared_gain_radius(symbol: &EnclosedSymbol) -> Vec<Rational> {
    if symbol.is_exact() {
        return Vec::new();
    }
    // A center may by accident have fewer powers of C than the symbols around it.
    let mut stencils = symbol.center().stencils().to_vec();
    stencils.resize(symbol.even_radius().len(), Stencil::zero());
    // Sums of integers over one denominator: the coefficients are long numbers.
    let norms = |sign: i64| -> Vec<Rational> {
        let half_sums = stencils.iter().map(|stencil| {
            let common = common_denominator(stencil.terms().map(|(_, value)| value));
            let scaled = stencil.map(|value| numerator_over(value, &common));
            let reach = stencil.reach().map_or(0, |(low, high)| low.abs().max(high.abs()));
            let sum: BigInt = (-reach..=reach)
                .map(|k| (scaled.coefficient(k) + scaled.coefficient(-k) * sign).abs())
                .sum();
            Rational::new(sum, common * 2)
        });
        half_sums.collect()
    };
    let mut total = vec![Rational::zero(); 2 * stencils.len() - 1];
    for (norm, radius) in [(norms(1), symbol.even_radius()), (norms(-1), symbol.odd_radius())] {
        for i in 0..stencils.len() {
            for j in 0..stencils.len() {
                total[i + j] +=
                    &norm[i] * &radius[j] + &norm[j] * &radius[i] + &radius[i] * &radius[j];
            }
        }
    }
    total
}
