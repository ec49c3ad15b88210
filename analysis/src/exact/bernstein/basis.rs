//! From cosines and powers to the Bernstein basis, in integers.

use crate::exact::cosine_series::CosineSeries;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, common_denominator, numerator_over};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::sync::OnceLock;

/// `[e_0, …, e_n]` of `m` copies of `a` and `k` copies of `b`.
fn elementary_symmetric(a: &BigInt, m: usize, b: &BigInt, k: usize) -> Vec<BigInt> {
    let mut sums = vec![BigInt::one()];
    for value in std::iter::repeat_n(a, m).chain(std::iter::repeat_n(b, k)) {
        sums.push(BigInt::zero());
        for index in (1..sums.len()).rev() {
            let product = &sums[index - 1] * value;
            sums[index] += product;
        }
    }
    sums
}

/// `[C(n, 0), …, C(n, n)]`.
pub(crate) fn binomials(degree: usize) -> Vec<BigInt> {
    let mut row = vec![BigInt::one()];
    for index in 0..degree {
        let next = &row[index] * (degree - index) / (index + 1);
        row.push(next);
    }
    row
}

/// Up to this degree the cosines have coefficients whose products with half of an `i128` can be added up in one.
const SMALL_DEGREE: usize = 28;

/// The cosines up to a degree in scaled Bernstein form: `[order][index]`.
static COSINES: [OnceLock<Vec<i64>>; SMALL_DEGREE + 1] = [const { OnceLock::new() }; _];

/// The `β_i` with `Σ_m r_m cos mφ = Σ_i β_i s^i (1 − s)^{n−i}`.
pub(super) fn scaled_bernstein(series: &CosineSeries<BigInt>, degree: usize) -> Vec<BigInt> {
    if degree > SMALL_DEGREE {
        return homogeneous(&series.in_powers_of_s(), degree);
    }
    let cosines = COSINES[degree].get_or_init(|| {
        let orders = (0..=degree).flat_map(|order| {
            let mut cosine = vec![BigInt::zero(); order];
            cosine.push(BigInt::one());
            homogeneous(&CosineSeries::new(cosine).in_powers_of_s(), degree)
        });
        orders.map(|value| value.to_i64().expect("below 4^28")).collect()
    });
    // The digits of all coefficients, to the base 2^64, by rank.
    let mut sums: Vec<Vec<i128>> = Vec::new();
    for (value, cosine) in series.coefficients().iter().zip(cosines.chunks_exact(degree + 1)) {
        let sign = if value.is_negative() { -1 } else { 1 };
        for (rank, digit) in value.iter_u64_digits().enumerate() {
            if rank == sums.len() {
                sums.push(vec![0; degree + 1]);
            }
            let digit = sign * i128::from(digit);
            for (sum, part) in sums[rank].iter_mut().zip(cosine) {
                *sum += digit * i128::from(*part);
            }
        }
    }
    (0..=degree)
        .map(|index| {
            let digits = sums.iter().rev();
            digits.fold(BigInt::zero(), |number, digits| (number << 64) + digits[index])
        })
        .collect()
}

/// `Σ a_i s^i` as `Σ β_i s^i (1 − s)^{n−i}`.
fn homogeneous(powers: &Polynomial<BigInt>, degree: usize) -> Vec<BigInt> {
    // Σ a_i s^i (s + (1 − s))^{n−i}: Horner in the homogeneous form.
    let mut scaled: Vec<BigInt> = Vec::with_capacity(degree + 1);
    for index in 0..=degree {
        // Multiply by (s + (1 − s)), then add a_i s^i.
        scaled.push(BigInt::zero());
        for j in (1..scaled.len()).rev() {
            let (head, tail) = scaled.split_at_mut(j);
            tail[0] += &head[j - 1];
        }
        scaled[index] += powers.coefficient(index);
    }
    scaled
}

/// How Bernstein coefficients in `t` on `[from, to]` follow from coefficients of powers of `t`, up to a
/// common positive factor: row `k` holds the weights of `1, t, …, t^degree` in coefficient `k`.
///
/// Polar form: `t^j` becomes the `j`-th elementary symmetric mean of `k` copies of `to` and
/// `degree − k` copies of `from`.
pub(crate) fn polar_weights(degree: usize, from: &Rational, to: &Rational) -> Vec<Vec<BigInt>> {
    let common = common_denominator([from, to]);
    let (from, to) = (numerator_over(from, &common), numerator_over(to, &common));
    let choices = binomials(degree);
    let factor = choices.iter().fold(BigInt::one(), |all, value| all.lcm(value));
    (0..=degree)
        .map(|k| {
            let symmetric = elementary_symmetric(&from, degree - k, &to, k);
            (0..=degree)
                .map(|j| &symmetric[j] * (&factor / &choices[j]) * common.pow((degree - j) as u32))
                .collect()
        })
        .collect()
}

/// The Bernstein coefficients of `Σ_j c_j t^j` on `[from, to]`, each times a positive number of its own: what signs need.
///
/// With `t = (a + b x)/(d (1 + x))` the interval becomes the positive half line, and `d^n (1 + x)^n p(t)` a polynomial in `x` whose coefficients
/// are the Bernstein coefficients times `d^n C(n, k)`: Horner's scheme in its homogeneous form, of `n²` steps.
pub(super) fn stretched(coefficients: &[BigInt], from: &Rational, to: &Rational) -> Vec<BigInt> {
    let common = common_denominator([from, to]);
    let (from, to) = (numerator_over(from, &common), numerator_over(to, &common));
    let mut sums: Vec<BigInt> = Vec::with_capacity(coefficients.len());
    // `d^m` and `(1 + x)^m`.
    let (mut power, mut row) = (BigInt::one(), vec![BigInt::one()]);
    for coefficient in coefficients.iter().rev() {
        if !sums.is_empty() {
            // Times `a + b x`.
            sums.push(BigInt::zero());
            for index in (0..sums.len()).rev() {
                sums[index] *= &from;
                if let Some(before) = index.checked_sub(1) {
                    let (head, tail) = sums.split_at_mut(index);
                    tail[0] += &head[before] * &to;
                }
            }
            power *= &common;
            row.push(BigInt::zero());
            for index in (1..row.len()).rev() {
                let (head, tail) = row.split_at_mut(index);
                tail[0] += &head[index - 1];
            }
        } else {
            sums.push(BigInt::zero());
        }
        let scaled = coefficient * &power;
        sums.iter_mut().zip(&row).for_each(|(sum, choices)| *sum += &scaled * choices);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        /// By polar forms, which is the other road.
        #[test]
        fn stretched_coefficients_are_those_of_the_polar_form(
            coefficients in prop::collection::vec(-50i64..50, 1..9),
            from in -9i64..9, length in 1i64..9, denominator in 1i64..7,
        ) {
            let coefficients: Vec<BigInt> = coefficients.into_iter().map(BigInt::from).collect();
            let (from, to) = (ratio(from, denominator), ratio(from + length, denominator + 1));
            let degree = coefficients.len() - 1;
            let choices = binomials(degree);
            let factor = choices.iter().fold(BigInt::one(), |all, value| all.lcm(value));
            let polar = polar_weights(degree, &from, &to);
            for ((weights, value), choices) in
                polar.iter().zip(stretched(&coefficients, &from, &to)).zip(&choices)
            {
                let polar: BigInt = weights.iter().zip(&coefficients).map(|(w, c)| w * c).sum();
                prop_assert_eq!(value * &factor, polar * choices);
            }
        }
    }
}
