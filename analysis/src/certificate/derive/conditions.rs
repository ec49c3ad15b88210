//! When all roots of `χ(z)` lie in the closed unit disc: Schur, Cohn and Jury, once more.

use super::super::verify::{CertificateError, ensure};
use super::super::{Level, Rule, Subject};
use super::fraction::whole_row;
use super::matrix::{Whole, determinant};
use super::parser::value;
use super::polynomial::{Poly, Shifts};
use super::reader::Reader;
use super::{Derived, of_the_parameter, shift_name};
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Zero};

type Read<T> = Result<T, CertificateError>;

/// `a_n b_m = b_n a_m` for all `m`.
pub fn proportional(p: &[Whole], q: &[Whole]) -> bool {
    let (Some(a), Some(b)) = (p.last(), q.last()) else { return false };
    p.len() == q.len() && p.iter().zip(q).all(|(x, y)| a.times(y) == b.times(x))
}

pub fn reversed_conjugate(p: &[Whole]) -> Vec<Whole> {
    p.iter().rev().map(Poly::conjugate).collect()
}

fn product(p: &[Whole], q: &[Whole]) -> Vec<Whole> {
    let mut result = vec![Poly::default(); p.len() + q.len() - 1];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            result[i + j] = std::mem::take(&mut result[i + j]).plus(&a.times(b));
        }
    }
    result
}

/// The shift that centres a polynomial between its least and largest powers along each axis; `None` where none does.
pub fn centring(poly: &Whole) -> Option<Shifts> {
    let mut shift = [0; 3];
    for (axis, by) in shift.iter_mut().enumerate() {
        let powers = || poly.0.keys().map(|power| power.e[axis]);
        let sum = powers().min()? + powers().max()?;
        if sum % 2 != 0 {
            return None;
        }
        *by = -sum / 2;
    }
    Some(shift)
}

/// A polynomial in `z`, the shifts and the sought parameter as text.
pub fn polynomial_in_z(text: &str, subject: &Subject, dimension: usize) -> Read<Vec<Whole>> {
    let mut names = of_the_parameter(subject);
    names.insert("z".into(), Poly::monomial(1, [0; 3], 0));
    for axis in 0..dimension {
        let shift = std::array::from_fn(|other| i32::from(other == axis));
        names.insert(shift_name(axis, dimension), Poly::monomial(0, shift, 0));
    }
    let mut reader = Reader::new(names, None, true);
    let fraction = reader.fraction(&value(text)?)?;
    // A quotient by a power of E is a shift.
    let shift = match fraction.under.0.first_key_value() {
        Some((power, _)) if fraction.under.is_unit() && power.z == 0 => power.e,
        _ => return Err(CertificateError("a factor is no polynomial".into())),
    };
    let whole = whole_row(&[fraction.over.moved(0, shift.map(|by| -by))]);
    let sound = !whole[0].is_zero() && whole[0].0.keys().all(|power| power.z >= 0);
    ensure(sound, "a factor is no polynomial")?;
    Ok(whole[0].by_z())
}

/// `z` becomes `(1 + ε) z`, times the denominator of `1 + ε` to the degree.
pub fn with_growth(p: &[Whole], growth: &Rational) -> Vec<Whole> {
    let radius = growth + Rational::one();
    let degree = p.len() - 1;
    let factor = |m: usize| radius.numer().pow(m as u32) * radius.denom().pow((degree - m) as u32);
    p.iter().enumerate().map(|(m, value)| value.scaled(&factor(m))).collect()
}

/// `d/dz`.
pub fn derivative(p: &[Whole]) -> Vec<Whole> {
    (1..).zip(&p[1..]).map(|(m, value)| value.scaled(&BigInt::from(m))).collect()
}

/// Where they are not negative, and none vanishes identically, all roots lie in the closed disc.
pub fn conditions(
    p: Vec<Whole>,
    subject: &Subject,
    dimension: usize,
    levels: &[Level],
) -> Read<Vec<Derived>> {
    let mut p = p;
    let mut derived = Vec::new();
    for (number, level) in levels.iter().enumerate() {
        ensure(p.len() > 1, "there are fewer levels")?;
        let whole = vec![Poly::one()];
        let (inside, circle) = match &level.split {
            Some(split) => {
                let inside = polynomial_in_z(&split.inside, subject, dimension)?;
                let circle = polynomial_in_z(&split.circle, subject, dimension)?;
                let product = product(&inside, &circle);
                ensure(proportional(&p, &product), "the factors do not multiply to χ")?;
                let mirrored = reversed_conjugate(&circle);
                ensure(proportional(&circle, &mirrored), "a factor is not self-inversive")?;
                (inside, circle)
            }
            None if proportional(&p, &reversed_conjugate(&p)) => (whole, p),
            None => (p, whole),
        };
        if inside.len() > 1 {
            let all = match level.rule {
                Rule::Jury => jury(&inside)?,
                Rule::SchurCohn => schur_cohn(&inside)?,
            };
            let of_level =
                |(condition, polynomial)| Derived { level: number, condition, polynomial };
            derived.extend(all.into_iter().map(of_level));
        }
        // Cohn: the roots of a self-inversive polynomial lie on the circle where those of its derivative lie in the disc.
        p = derivative(&circle);
        p.resize(p.len().max(1), Poly::one());
    }
    ensure(p.len() <= 1, "a level is missing")?;
    Ok(derived)
}

/// `det (Σ_k a_{n−i+k} ā_{n−j+k} − ā_{i−k} a_{j−k})` of each size.
fn schur_cohn(a: &[Whole]) -> Read<Vec<(String, Whole)>> {
    let degree = a.len() - 1;
    let bar: Vec<Whole> = a.iter().map(Poly::conjugate).collect();
    let entry = |i: usize, j: usize| {
        (0..=i.min(j)).fold(Poly::default(), |sum, k| {
            let outer = a[degree - i + k].times(&bar[degree - j + k]);
            sum.plus(&outer).minus(&bar[i - k].times(&a[j - k]))
        })
    };
    (1..=degree)
        .map(|size| {
            let rows = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
            Ok((format!("minor-{size}"), determinant(&rows)?))
        })
        .collect()
}

/// `a_n χ(1)`, `(−1)^n a_n χ(−1)` and the inner determinants of `X ± Y`, times `a_n` where their size is odd.
fn jury(a: &[Whole]) -> Read<Vec<(String, Whole)>> {
    let not_real = || CertificateError("the coefficients are not real".into());
    let degree = a.len() - 1;
    let shift = centring(&a[degree]).ok_or_else(not_real)?;
    let a: Vec<Whole> = a.iter().map(|coefficient| coefficient.moved(0, shift)).collect();
    ensure(a.iter().all(|coefficient| *coefficient == coefficient.conjugate()), &not_real().0)?;
    let leading = &a[degree];
    let mut all = Vec::new();
    for (name, sign) in [("plus-one", 1), ("minus-one", -1)] {
        let sign = BigInt::from(sign);
        let total = (0u32..).zip(&a).fold(Poly::default(), |total, (m, coefficient)| {
            total.plus(&coefficient.scaled(&sign.pow(m)))
        });
        all.push((name.to_string(), total.times(leading).scaled(&sign.pow(degree as u32))));
    }
    let size = degree - 1;
    for (name, sign) in [('+', 1), ('-', -1)] {
        let sign = BigInt::from(sign);
        for margin in 0..size.div_ceil(2) {
            if size == 1 && name == '+' {
                continue; // half the sum of the first two
            }
            let inner = margin..size - margin;
            let entry = |i: usize, j: usize| {
                let upper = if j >= i { a[degree - (j - i)].clone() } else { Poly::default() };
                let lower = (i + j + 1).checked_sub(size).map(|m| a[m].scaled(&sign));
                lower.map_or_else(|| upper.clone(), |lower| upper.clone().plus(&lower))
            };
            let rows = inner.clone().map(|i| inner.clone().map(|j| entry(i, j)).collect());
            let value = determinant(&rows.collect())?;
            let value = if inner.len() % 2 == 1 { value.times(leading) } else { value };
            all.push((format!("inner-{}{name}", inner.len()), value));
        }
    }
    Ok(all)
}

/// The coefficients of an explicit step for one unknown between two levels, by offset; times the same positive number.
pub fn coefficients(p: &[Whole], dimension: usize) -> Read<Vec<Derived>> {
    let refused = || CertificateError("not explicit, or not of one level".into());
    let [old, new] = p else { return Err(refused()) };
    let unit = new.0.first_key_value().filter(|_| new.is_unit());
    let (power, unit) = unit.ok_or_else(refused)?;
    let sign = if *unit > BigInt::zero() { -BigInt::one() } else { BigInt::one() };
    let mut by_offset: std::collections::BTreeMap<Shifts, Whole> = Default::default();
    for (own, value) in &old.0 {
        let rest = super::polynomial::Power { e: [0; 3], ..own.clone() };
        let offset = std::array::from_fn(|axis| own.e[axis] - power.e[axis]);
        by_offset.entry(offset).or_default().0.insert(rest, value * &sign);
    }
    let derived = by_offset.into_iter().map(|(offset, polynomial)| Derived {
        level: 0,
        condition: format!(
            "coefficient {}",
            offset[..dimension].iter().map(i32::to_string).collect::<Vec<_>>().join(",")
        ),
        polynomial,
    });
    Ok(derived.collect())
}
