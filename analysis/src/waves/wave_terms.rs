//! The characteristic polynomial prepared for evaluation on one wave after another, exact.

use crate::exact::cosine_series::CosineSeries;
use crate::exact::laurent::{Laurent, VARIABLES, Variable};
use crate::scheme::{SchemeError, Step};
use num_bigint::BigInt;
use num_traits::Zero;
use std::collections::BTreeMap;

/// `s^a (1 − s)^b Σ_m r_m cos mφ` with `s = (1 − cos φ)/2`: what vanishes trivially stands outside, so that no digits are lost there.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Factored<T> {
    pub(crate) s_power: i32,
    pub(crate) complement_power: i32,
    pub(crate) series: CosineSeries<T>,
}

/// `(even + i sin φ odd)` times powers of names.
#[derive(Debug, Clone)]
pub(crate) struct WaveTerm {
    /// Variable and power.
    pub(crate) names: Vec<(Variable, i32)>,
    pub(crate) even: Factored<BigInt>,
    pub(crate) odd: Factored<BigInt>,
}

/// `χ(z)` without the factor that all its coefficients share.
pub(crate) fn primitive_characteristic(step: &Step) -> Result<Laurent, SchemeError> {
    if step.dimension() != 1 {
        return Err(SchemeError::Dimension(step.dimension()));
    }
    let characteristic = step.characteristic()?;
    let content = characteristic.content(Variable::TIME);
    Ok(characteristic.divide_exactly(&content).expect("a content divides"))
}

/// `[b_0, b_1, …]` of `χ(1 + y) = Σ_j b_j y^j`, times a power of `E` that makes them as real as it goes. Differences `y = z − 1` keep
/// the digits of long waves.
pub(crate) fn difference_terms(chi: &Laurent) -> Vec<Vec<WaveTerm>> {
    let powers = chi.coefficients(Variable::TIME);
    let leading = powers.last().and_then(|last| last.range(Variable::axis(0)));
    let middle = leading.map_or(0, |(low, high)| (low + high).div_euclid(2));
    let centred: Vec<Laurent> =
        powers.iter().map(|power| power.shifted(Variable::axis(0), -middle)).collect();
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

/// Sorted by names, even and odd in the phase.
fn split(polynomial: &Laurent) -> Vec<WaveTerm> {
    let mut groups: BTreeMap<Vec<(Variable, i32)>, [Vec<BigInt>; 2]> = BTreeMap::new();
    for (exponents, value) in polynomial.terms() {
        let names: Vec<(Variable, i32)> = (4..VARIABLES)
            .filter(|&place| exponents[place] != 0)
            .map(|place| (Variable(place), i32::from(exponents[place])))
            .collect();
        let [even, odd] = groups.entry(names).or_default();
        let power = exponents[Variable::axis(0).0];
        let order = usize::from(power.unsigned_abs());
        add(even, order, value.clone());
        // sin kφ/sin φ = 2 cos (k−1)φ + 2 cos (k−3)φ + …, the last term 1 where it is constant.
        for below in (0..order).rev().step_by(2) {
            let value = if below == 0 { value.clone() } else { value * 2 };
            add(odd, below, if power > 0 { value } else { -value });
        }
    }
    groups
        .into_iter()
        .map(|(names, [even, odd])| WaveTerm { names, even: factored(even), odd: factored(odd) })
        .collect()
}

fn add(series: &mut Vec<BigInt>, order: usize, value: BigInt) {
    if series.len() <= order {
        series.resize(order + 1, BigInt::zero());
    }
    series[order] += value;
}

fn factored(values: Vec<BigInt>) -> Factored<BigInt> {
    let mut series = CosineSeries::new(values);
    let (mut s_power, mut complement_power) = (0, 0);
    while let Some(quotient) = (!series.is_zero()).then(|| series.divide_by_s()).flatten() {
        (series, s_power) = (quotient, s_power + 1);
    }
    while let Some(quotient) = (!series.is_zero()).then(|| series.divide_by_complement()).flatten()
    {
        (series, complement_power) = (quotient, complement_power + 1);
    }
    Factored { s_power, complement_power, series }
}
