//! `(1 + ε)² − |g|²` multiplied out, compared with the stated factors.

use super::super::{CertifiedStencil, CertifiedSymbol, Exact, FactoredMargin};
use super::arithmetic::product;
use super::{CertificateError, coefficient, ensure, is_exact, values};
use crate::exact::rational::{Rational, integer};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// What is left of `(1 + ε)² − |g|²`: `[power of t][power of s]` times the denominator.
pub(super) struct Decider {
    pub(super) rows: Vec<Vec<BigInt>>,
    radius: Vec<BigInt>,
}

impl Decider {
    /// The rows with the constant coefficients moved by the radii.
    pub(super) fn shifted(&self, direction: i64) -> Vec<Vec<BigInt>> {
        let mut rows = self.rows.clone();
        for (row, radius) in rows.iter_mut().zip(&self.radius) {
            row[0] += radius * direction;
        }
        rows
    }

    /// The polynomial in `t` at one `s`, raised by the radii, up to a positive factor.
    pub(super) fn raised_at(&self, s: &Rational) -> Vec<BigInt> {
        let raised = self.shifted(1);
        let (a, d, length) = (s.numer(), s.denom(), raised[0].len() as u32);
        let terms = |row: &[BigInt]| {
            (0u32..).zip(row).map(|(i, value)| value * a.pow(i) * d.pow(length - i)).sum()
        };
        raised.iter().map(|row| terms(row)).collect()
    }
}

/// Multiplies `(1 + ε)² − |g|²` out and compares it with the product of the stated factors.
pub(super) fn check_margin(
    symbol: &CertifiedSymbol,
    growth: &Rational,
    margin: &FactoredMargin,
) -> Result<Decider, CertificateError> {
    let columns = margin.coefficients.first().map_or(0, Vec::len);
    ensure(
        (1..=1000).contains(&columns)
            && margin.coefficients.iter().all(|row| row.len() == columns)
            && margin.radius.len() == margin.coefficients.len()
            && margin.courant_power <= 200
            && margin.phase_power + margin.complement_power <= 1000,
        "the polynomial is not a rectangle of coefficients",
    )?;
    let numbers = margin.coefficients.iter().flatten().chain(&margin.radius);
    ensure(
        numbers.chain([&margin.denominator]).all(|value| value.0.is_integer())
            && margin.denominator.0.is_positive(),
        "the polynomial is not written in whole numbers",
    )?;

    let zero_polynomial = margin.coefficients.iter().flatten().all(|value| value.0.is_zero());
    let one = margin.denominator.0.is_one() && values(&margin.neutral_waves) == [Rational::one()];
    let powers = margin.phase_power + margin.complement_power + margin.courant_power;
    ensure(!zero_polynomial || one && powers == 0, "a polynomial that is zero has no factors")?;

    // The product: s^a (1 − s)^b H² first.
    let mut factor = vec![Rational::zero(); margin.phase_power];
    factor.push(Rational::one());
    for _ in 0..margin.complement_power {
        factor = product(&factor, &[Rational::one(), -Rational::one()]);
    }
    let neutral = values(&margin.neutral_waves);
    // H and −H have the same square; one spelling is enough.
    ensure(
        neutral.last().is_some_and(Signed::is_positive),
        "H is zero or its leading coefficient is not positive",
    )?;
    factor = product(&product(&factor, &neutral), &neutral);
    let mut stated = vec![Vec::new(); margin.courant_power];
    for (j, row) in margin.coefficients.iter().enumerate() {
        stated.resize(margin.courant_power + margin.stride * j, Vec::new());
        let row: Vec<_> = values(row).iter().map(|value| value / &margin.denominator.0).collect();
        stated.push(product(&factor, &row));
    }
    let expanded = expand(symbol, growth);
    let zero = Rational::zero();
    for power in 0..stated.len().max(expanded.len()) {
        let (left, right) = (stated.get(power), expanded.get(power));
        let length = left.map_or(0, Vec::len).max(right.map_or(0, Vec::len));
        for i in 0..length {
            let left = left.and_then(|row| row.get(i)).unwrap_or(&zero);
            let right = right.and_then(|row| row.get(i)).unwrap_or(&zero);
            ensure(left == right, "the factors do not multiply to (1 + growth)² − |g|²")?;
        }
    }

    let radius = error_bounds(symbol);
    if !is_exact(symbol) {
        // Only what vanishes for the true coefficients too may be taken out.
        ensure(
            margin.complement_power == 0
                && neutral.len() == 1
                && (margin.phase_power == 0
                    || margin.phase_power == 1 && symbol.keeps_constants && growth.is_zero()),
            "a factor was taken out that the true coefficients need not have",
        )?;
    }
    let reach = |end: fn(&CertifiedStencil) -> i64| symbol.stencils.iter().map(end);
    let low = reach(|stencil| stencil.lowest).min().unwrap_or(0);
    let high = reach(|stencil| stencil.lowest + stencil.radius.len() as i64 - 1).max().unwrap_or(0);
    // |cos mφ − 1| ≤ 2m² s.
    let stretch = if margin.phase_power == 0 { 1 } else { 2 * (high - low) * (high - low) };
    for (power, bound) in radius.iter().enumerate() {
        let steps = power.checked_sub(margin.courant_power);
        let index = steps.filter(|steps| steps % margin.stride == 0).map(|s| s / margin.stride);
        let declared = index.and_then(|index| margin.radius.get(index));
        let needed = (bound * &margin.denominator.0).ceil() * integer(stretch);
        ensure(
            declared.map_or_else(|| bound.is_zero(), |declared| declared.0 == needed),
            "the radii of the polynomial do not follow from those of the coefficients",
        )?;
    }
    let radius: Vec<BigInt> = margin.radius.iter().map(|value| value.0.to_integer()).collect();
    let beyond_bounds =
        margin.courant_power + margin.stride * (radius.len() - 1) >= 2 * symbol.stencils.len() - 1;
    ensure(!beyond_bounds, "the polynomial has more powers of C than |g|² can have")?;
    let rows = margin.coefficients.iter();
    let rows = rows.map(|row| row.iter().map(|value| value.0.to_integer()).collect()).collect();
    Ok(Decider { rows, radius })
}

/// `(1 + ε)² − |g|²` as `[power of C][power of s]`, from
/// `|g|² = Σ_{k,l} c_k c_l cos (k − l)φ` and `cos mφ = T_m(1 − 2s)`.
fn expand(symbol: &CertifiedSymbol, growth: &Rational) -> Vec<Vec<Rational>> {
    let all = symbol.stencils.iter().flat_map(|stencil| &stencil.coefficients);
    let common = all.fold(BigInt::one(), |all, value| all.lcm(value.0.denom()));
    let whole = |value: &Exact| value.0.numer() * (&common / value.0.denom());
    let terms: Vec<(usize, i64, BigInt)> = symbol
        .stencils
        .iter()
        .enumerate()
        .flat_map(|(power, stencil)| {
            let offsets = stencil.lowest..;
            offsets.zip(&stencil.coefficients).map(move |(k, value)| (power, k, whole(value)))
        })
        .collect();
    let low = terms.iter().map(|(_, k, _)| *k).min().unwrap_or(0);
    let high = terms.iter().map(|(_, k, _)| *k).max().unwrap_or(0);
    let degree = (high - low) as usize;
    let powers = 2 * symbol.stencils.len() - 1;
    let mut cosines = vec![vec![BigInt::zero(); degree + 1]; powers];
    for (i, k, a) in &terms {
        for (j, l, b) in &terms {
            cosines[i + j][k.abs_diff(*l) as usize] += a * b;
        }
    }
    let mut rows = vec![vec![BigInt::zero(); degree + 1]; powers];
    let (mut before, mut current) = (vec![BigInt::one(), BigInt::from(-2)], vec![BigInt::one()]);
    for m in 0..=degree {
        for (row, series) in rows.iter_mut().zip(&cosines) {
            for (target, value) in row.iter_mut().zip(&current) {
                *target -= &series[m] * value;
            }
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
    let square = Rational::from(&common * &common);
    let mut rows: Vec<Vec<Rational>> = rows
        .into_iter()
        .map(|row| row.into_iter().map(|value| Rational::from(value) / &square).collect())
        .collect();
    rows[0][0] += (growth + integer(1)) * (growth + integer(1));
    rows
}

/// How far `|g|²` may be off, by power of `C`: `|g|²` is the square of a cosine series plus the square of
/// a sine series, and `|ab − a₀b₀| ≤ |a₀| r_b + |b₀| r_a + r_a r_b`.
fn error_bounds(symbol: &CertifiedSymbol) -> Vec<Rational> {
    let powers = symbol.stencils.len();
    let mut bounds = vec![Rational::zero(); 2 * powers - 1];
    for (mirror, radius) in [(1, &symbol.even_radius), (-1, &symbol.odd_radius)] {
        let norms: Vec<Rational> = symbol
            .stencils
            .iter()
            .map(|stencil| {
                let at = |k| coefficient(&stencil.coefficients, stencil.lowest, k);
                let high = stencil.lowest + stencil.radius.len() as i64;
                let reach = stencil.lowest.abs().max(high.abs());
                (-reach..=reach)
                    .map(|k| (at(k) + at(-k) * integer(mirror)).abs() / integer(2))
                    .sum()
            })
            .collect();
        for i in 0..powers {
            for j in 0..powers {
                let (r, q) = (&radius[i].0, &radius[j].0);
                bounds[i + j] += &norms[i] * q + &norms[j] * r + r * q;
            }
        }
    }
    bounds
}
