//! A derived polynomial held against the one stated.

use super::super::derive::{BITS, Letter, Letters, Poly, Series};
use super::super::{Exact, StatedInequality};
use super::arithmetic::product;
use super::{CertificateError, ensure};
use crate::exact::rational::{Rational, integer};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// Whether the derived polynomial is `Q² W` times the margin, within the radii; `true` when both are known exactly.
pub(super) fn compare(
    derived: &Poly<BigInt>,
    letters: &Letters,
    stated: &StatedInequality,
) -> Result<bool, CertificateError> {
    if derived.0.keys().all(|power| power.letters.is_empty()) {
        return exactly(exact_rows(derived)?, stated).map(|()| true);
    }
    let margin = &stated.margin;
    let one = [Exact(Rational::one())];
    ensure(
        stated.square == [one.to_vec()] && stated.weight == one && margin.neutral_waves == one,
        "a factor was taken out that the true scheme need not have",
    )?;
    let (s, complement) = (margin.phase_power, margin.complement_power);
    let sums = enclosed_rows(derived, letters, s, complement)?;
    let mut stated_rows: BTreeMap<usize, (Vec<Rational>, Rational)> = BTreeMap::new();
    for (j, (row, radius)) in margin.coefficients.iter().zip(&margin.radius).enumerate() {
        let over = |value: &Exact| -&value.0 / &margin.denominator.0;
        let row: Vec<Rational> = row.iter().map(over).collect();
        let radius = &radius.0 / &margin.denominator.0;
        stated_rows
            .insert(margin.courant_power + margin.stride * j, (in_powers_of_e(&row), radius));
    }
    let unit = Rational::new(BigInt::one(), BigInt::one() << BITS);
    let powers: std::collections::BTreeSet<usize> =
        sums.keys().chain(stated_rows.keys()).copied().collect();
    for power in powers {
        let nothing = || vec![Rational::zero()];
        let (values, error) = match sums.get(&power) {
            Some(sum) => {
                let values = sum.values.iter().map(|value| Rational::from(value.clone()) * &unit);
                (values.collect(), Rational::from(sum.error.clone()) * &unit)
            }
            None => (nothing(), Rational::zero()),
        };
        let (row, radius) =
            stated_rows.get(&power).cloned().unwrap_or_else(|| (nothing(), Rational::zero()));
        let distance: Rational = added(&values, &row).iter().map(Signed::abs).sum();
        let within = distance + error <= radius;
        ensure(within, "a polynomial is not that of the scheme within its radius")?;
    }
    Ok(false)
}

/// A power of the parameter and powers of letters.
type Group = (i32, Vec<(Letter, u32)>);

/// Symmetric series in `E`.
fn groups(derived: &Poly<BigInt>) -> Result<BTreeMap<Group, Vec<BigInt>>, CertificateError> {
    let one_phase = derived.0.keys().all(|power| power.e[1..] == [0, 0]);
    ensure(one_phase, "a function of several phases")?;
    let reach = derived.0.keys().map(|power| power.e[0].unsigned_abs() as usize).max().unwrap_or(0);
    let mut groups: BTreeMap<Group, Vec<BigInt>> = BTreeMap::new();
    for (power, value) in &derived.0 {
        let group = groups.entry((power.c, power.letters.clone()));
        let series = group.or_insert_with(|| vec![BigInt::zero(); 2 * reach + 1]);
        series[(reach as i32 + power.e[0]) as usize] += value;
    }
    let symmetric = |series: &Vec<BigInt>| series.iter().eq(series.iter().rev());
    ensure(groups.values().all(symmetric), "not a real function of the wave")?;
    Ok(groups)
}

/// A polynomial without letters by power of the parameter, in powers of `s`.
pub(in super::super) fn exact_rows(
    derived: &Poly<BigInt>,
) -> Result<BTreeMap<usize, Vec<BigInt>>, CertificateError> {
    let rows = groups(derived)?.into_iter();
    Ok(rows.map(|((c, _), series)| (c as usize, in_powers_of_s(&series))).collect())
}

/// A polynomial with letters by power of the parameter, over `s^a (1 − s)^b`, which must divide what stands at each letter.
pub(in super::super) fn enclosed_rows(
    derived: &Poly<BigInt>,
    letters: &Letters,
    s: usize,
    complement: usize,
) -> Result<BTreeMap<usize, Series>, CertificateError> {
    let mut sums: BTreeMap<usize, Series> = BTreeMap::new();
    for ((c, powers), mut series) in groups(derived)? {
        for (root, times) in [(1, s), (-1, complement)] {
            for _ in 0..times {
                series = over(series, root)?;
            }
        }
        let values = series.into_iter().map(|value| value << BITS).collect();
        let mut term = Series { values, error: BigInt::zero() };
        for (letter, times) in &powers {
            for _ in 0..*times {
                term = term.times(&letters.value(letter));
            }
        }
        let sum = sums
            .entry(c as usize)
            .or_insert_with(|| Series { values: vec![BigInt::zero()], error: BigInt::zero() });
        *sum = Series { values: added(&sum.values, &term.values), error: &sum.error + term.error };
    }
    Ok(sums)
}

/// Both multiplied out are the same.
fn exactly(
    derived: BTreeMap<usize, Vec<BigInt>>,
    stated: &StatedInequality,
) -> Result<(), CertificateError> {
    let margin = &stated.margin;
    let exact = margin.radius.iter().all(|radius| radius.0.is_zero());
    ensure(exact, "what is exact needs no radius")?;
    let values = |list: &[Exact]| list.iter().map(|v| v.0.clone()).collect::<Vec<Rational>>();
    let neutral = values(&margin.neutral_waves);
    let mut factor = product(&product(&values(&stated.weight), &neutral), &neutral);
    for _ in 0..margin.complement_power {
        factor = product(&factor, &[Rational::one(), -Rational::one()]);
    }
    factor.splice(0..0, vec![Rational::zero(); margin.phase_power]);
    factor.iter_mut().for_each(|value| *value /= &margin.denominator.0);
    let mut rows: BTreeMap<usize, Vec<Rational>> = BTreeMap::new();
    for (j, row) in margin.coefficients.iter().enumerate() {
        add(&mut rows, margin.courant_power + margin.stride * j, &product(&factor, &values(row)));
    }
    let squared: Vec<Vec<Rational>> = stated.square.iter().map(|row| values(row)).collect();
    if squared != [vec![Rational::one()]] {
        for _ in 0..2 {
            let mut next = BTreeMap::new();
            for (power, row) in &rows {
                for (i, values) in squared.iter().enumerate() {
                    add(&mut next, power + i, &product(row, values));
                }
            }
            rows = next;
        }
    }
    let powers = rows.keys().chain(derived.keys());
    for power in powers {
        let row: &[Rational] = rows.get(power).map_or(&[], Vec::as_slice);
        let own: &[BigInt] = derived.get(power).map_or(&[], Vec::as_slice);
        for i in 0..row.len().max(own.len()) {
            let left = row.get(i).cloned().unwrap_or_default();
            let right = own.get(i).cloned().unwrap_or_default();
            ensure(left == Rational::from(right), "a polynomial is not that of the scheme")?;
        }
    }
    Ok(())
}

fn add(rows: &mut BTreeMap<usize, Vec<Rational>>, power: usize, more: &[Rational]) {
    let row = rows.entry(power).or_default();
    row.resize(row.len().max(more.len()), Rational::zero());
    row.iter_mut().zip(more).for_each(|(value, more)| *value += more);
}

/// The sum of two series about the same middle.
fn added<T: Clone + Zero>(a: &[T], b: &[T]) -> Vec<T>
where
    for<'a> &'a T: std::ops::Add<&'a T, Output = T>,
{
    let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
    let gap = (long.len() - short.len()) / 2;
    let mut sum = long.to_vec();
    for (value, more) in sum[gap..].iter_mut().zip(short) {
        *value = &*value + more;
    }
    sum
}

/// A symmetric series in `E` divided by `s = −(E − 1)²/(4E)` for the root 1, by `1 − s = (E + 1)²/(4E)` for −1.
fn over(mut series: Vec<BigInt>, root: i32) -> Result<Vec<BigInt>, CertificateError> {
    for _ in 0..2 {
        let mut carry = BigInt::zero();
        for value in &mut series {
            carry = &*value + carry * root;
            *value = carry.clone();
        }
        ensure(series.pop().is_some_and(|rest| rest.is_zero()), "a factor does not divide")?;
    }
    let factor = BigInt::from(-4 * root);
    Ok(series.into_iter().map(|value| value * &factor).collect())
}

/// `[…, x_{−1}, x_0, x_1, …]` with `cos mφ = T_m(1 − 2s)`.
fn in_powers_of_s(series: &[BigInt]) -> Vec<BigInt> {
    let middle = series.len() / 2;
    let mut result = vec![BigInt::zero(); middle + 1];
    let (mut before, mut current) = (vec![BigInt::one(), BigInt::from(-2)], vec![BigInt::one()]);
    for m in 0..=middle {
        let twice = if m == 0 { 1 } else { 2 };
        for (target, value) in result.iter_mut().zip(&current) {
            *target += &series[middle + m] * value * twice;
        }
        // T_{m+1} = 2 (1 − 2s) T_m − T_{m−1}, and T_{−1} = T_1.
        let mut next = vec![BigInt::zero(); m + 2];
        for (i, value) in current.iter().enumerate() {
            next[i] += value * 2;
            next[i + 1] -= value * 4;
        }
        for (target, value) in next.iter_mut().zip(&before) {
            *target -= value;
        }
        before = std::mem::replace(&mut current, next);
    }
    result
}

/// A polynomial in `s = (2 − E − 1/E)/4` as a symmetric series.
fn in_powers_of_e(row: &[Rational]) -> Vec<Rational> {
    let mut series = vec![Rational::zero()];
    for value in row.iter().rev() {
        let at = |i: i64| usize::try_from(i).ok().and_then(|i| series.get(i));
        let mut next: Vec<Rational> = (-1..=series.len() as i64)
            .map(|i| {
                let take = |i| at(i).cloned().unwrap_or_default();
                (take(i) * integer(2) - take(i - 1) - take(i + 1)) / integer(4)
            })
            .collect();
        let middle = next.len() / 2;
        next[middle] += value;
        series = next;
    }
    series
}
