//! The characteristic polynomial prepared for evaluation on one wave after another, exact.

use crate::exact::laurent::{Laurent, VARIABLES, Variable};
use crate::exact::torus_series::{Orders, TorusSeries};
use crate::scheme::{SchemeError, Step};
use num_bigint::BigInt;
use num_traits::Zero;
use std::collections::BTreeMap;

/// `Π_a (i sin φ_a)^{0 or 1} s_a^{p_a} (1 − s_a)^{q_a} · Σ_m r_m Π_a cos m_a φ_a` with `s_a = sin²(φ_a/2)`, one of each for every axis:
/// what vanishes with the phases stands outside of the series, so that no digits are lost on long waves.
#[derive(Debug, Clone)]
pub(crate) struct WavePart {
    pub(crate) odd: [bool; 3],
    pub(crate) s_powers: [i32; 3],
    pub(crate) complement_powers: [i32; 3],
    pub(crate) series: TorusSeries,
}

/// A sum of parts times powers of names.
#[derive(Debug, Clone)]
pub(crate) struct WaveTerm {
    /// Variable and power.
    pub(crate) names: Vec<(Variable, i32)>,
    pub(crate) parts: Vec<WavePart>,
}

/// `χ(z)` without the factor that all its coefficients share.
pub(crate) fn primitive_characteristic(step: &Step) -> Result<Laurent, SchemeError> {
    let characteristic = step.characteristic()?;
    let content = characteristic.content(Variable::TIME);
    Ok(characteristic.divide_exactly(&content).expect("a content divides"))
}

/// `[b_0, b_1, …]` of `χ(1 + y) = Σ_j b_j y^j`, times powers of the shifts that make them as real as it goes. Differences `y = z − 1`
/// keep the digits of long waves.
pub(crate) fn difference_terms(chi: &Laurent) -> Vec<Vec<WaveTerm>> {
    let mut centred = chi.coefficients(Variable::TIME);
    for axis in (0..3).map(Variable::axis) {
        let leading = centred.last().and_then(|last| last.range(axis));
        let middle = leading.map_or(0, |(low, high)| (low + high).div_euclid(2));
        centred.iter_mut().for_each(|power| *power = power.shifted(axis, -middle));
    }
    (0..centred.len())
        .map(|j| {
            let mut binomial = BigInt::from(1);
            let mut sum = Laurent::default();
            for (m, coefficient) in centred.iter().enumerate().skip(j) {
                sum = sum + coefficient.scaled(&binomial);
                // C(m + 1, j) from C(m, j).
                binomial = binomial * (m + 1) / (m + 1 - j);
            }
            split(&sum)
        })
        .collect()
}

/// Series by whether they stand with the sine of each phase.
type ByParity = BTreeMap<[bool; 3], TorusSeries>;

/// Sorted by names, even and odd in each phase.
fn split(polynomial: &Laurent) -> Vec<WaveTerm> {
    let mut groups: BTreeMap<Vec<(Variable, i32)>, ByParity> = BTreeMap::new();
    for (exponents, value) in polynomial.terms() {
        let names: Vec<(Variable, i32)> = (4..VARIABLES)
            .filter(|&place| exponents[place] != 0)
            .map(|place| (Variable(place), i32::from(exponents[place])))
            .collect();
        let group = groups.entry(names).or_default();
        let mut product = vec![([false; 3], Orders::default(), value.clone())];
        for axis in 0..3 {
            let power = exponents[Variable::axis(axis).0];
            let factors = even_and_odd(power);
            let times = |(odd, orders, value): &([bool; 3], Orders, BigInt)| {
                let times = |&(is_odd, order, factor): &(bool, usize, i32)| {
                    let (mut odd, mut orders) = (*odd, *orders);
                    (odd[axis], orders[axis]) = (is_odd, order);
                    (odd, orders, value * factor)
                };
                factors.iter().map(times).collect::<Vec<_>>()
            };
            product = product.iter().flat_map(times).collect();
        }
        for (odd, orders, value) in product {
            group.entry(odd).or_default().add(orders, value);
        }
    }
    let parts = |group: ByParity| -> Vec<WavePart> {
        group.into_iter().flat_map(|(odd, series)| factored(odd, series)).collect()
    };
    groups.into_iter().map(|(names, group)| WaveTerm { names, parts: parts(group) }).collect()
}

/// `e^{ikφ} = cos kφ + i sin φ (sin kφ/sin φ)` in cosines: whether with `i sin φ`, the order, the coefficient.
fn even_and_odd(power: i16) -> Vec<(bool, usize, i32)> {
    let order = usize::from(power.unsigned_abs());
    let sign = i32::from(power.signum());
    // sin kφ/sin φ = 2 cos (k−1)φ + 2 cos (k−3)φ + …, the last term 1 where it is constant.
    let odd = (0..order).rev().step_by(2);
    let odd = odd.map(|below| (true, below, if below == 0 { sign } else { 2 * sign }));
    std::iter::once((false, order, 1)).chain(odd).collect()
}

/// With the factors `s_a` and `1 − s_a` taken out; what is left and still vanishes with all phases at once is a sum of several such parts,
/// `f = f(φ_a = 0) + s_a (…)`.
fn factored(odd: [bool; 3], mut series: TorusSeries) -> Vec<WavePart> {
    if series.is_zero() {
        return Vec::new();
    }
    let (mut s_powers, mut complement_powers) = ([0; 3], [0; 3]);
    for axis in 0..3 {
        while let Some(quotient) = series.divide_by_s(axis) {
            (series, s_powers[axis]) = (quotient, s_powers[axis] + 1);
        }
        while let Some(quotient) = series.divide_by_complement(axis) {
            (series, complement_powers[axis]) = (quotient, complement_powers[axis] + 1);
        }
    }
    let depends = (0..3).find(|&axis| series.degree(axis) > 0);
    let Some(axis) = depends.filter(|_| series.at_zero().is_zero()) else {
        return vec![WavePart { odd, s_powers, complement_powers, series }];
    };
    let without = series.without(axis);
    let with = series.minus(&without).divide_by_s(axis).expect("it vanishes with the phase");
    let mut parts = factored(odd, without);
    parts.extend(factored(odd, with).into_iter().map(|mut part| {
        part.s_powers[axis] += 1;
        part
    }));
    for part in &mut parts {
        for axis in 0..3 {
            part.s_powers[axis] += s_powers[axis];
            part.complement_powers[axis] += complement_powers[axis];
        }
    }
    parts
}
