//! A derived polynomial as a margin: factors that do not change its sign are taken out and written down.

use super::super::derive::{BITS, Derived, Letters};
use super::super::verify::compare::{enclosed_rows, exact_rows};
use super::super::{Exact, FactoredMargin, StatedInequality, Subject};
use super::CertificationError;
use super::levels::{PARAMETER, to_laurent};
use crate::exact::bernstein::MarginForm;
use crate::exact::common_factor::common_square_root;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::Rational;
use crate::interest::Interest;
use crate::scheme::Names;
use crate::stability::margin::Margin;
use crate::stability::{Condition as Kind, Inequality, Requirement};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// Bits kept of enclosed coefficients.
const KEPT_BITS: u32 = 192;

type Row = Polynomial<Rational>;

/// A condition with its margin, ready to be covered.
pub(super) struct Condition {
    pub(super) stated: StatedInequality,
    pub(super) margin: Margin,
    pub(super) form: MarginForm,
}

impl Condition {
    pub(super) fn new(
        derived: &Derived,
        letters: &Letters,
        subject: &Subject,
    ) -> Result<Self, CertificationError> {
        let one = vec![Exact(Rational::one())];
        let exact = derived.polynomial.0.keys().all(|power| power.letters.is_empty());
        let (margin, square, weight, power) = if exact {
            let margin = exact_margin(derived, subject)?;
            let (square, weight, power) = cofactor(derived, &margin)?;
            (margin, square, weight, power)
        } else {
            (enclosed_margin(derived, letters)?, vec![one.clone()], one, 0)
        };
        let stated = StatedInequality {
            level: derived.level,
            condition: derived.condition.clone(),
            square,
            weight,
            margin: factored(&margin, power),
        };
        let form = MarginForm::new(&margin);
        Ok(Self { stated, margin, form })
    }

    /// Covered only as long as somebody wants the proof.
    pub(super) fn while_wanted(self, interest: &Interest) -> Self {
        Self { form: self.form.while_wanted(interest), ..self }
    }
}

fn exact_margin(derived: &Derived, subject: &Subject) -> Result<Margin, CertificationError> {
    let mut names = Names::default();
    let variable = names.insert_parameter(&subject.parameter).ok();
    let variable = variable.filter(|variable| *variable == Variable(PARAMETER));
    let variable = variable.ok_or(CertificationError::NotWritten("there are too many names"))?;
    let polynomial = to_laurent(&derived.polynomial);
    let polynomial = if polynomial.is_zero() { polynomial } else { polynomial.odd_part() };
    let square = Laurent::integer(1);
    let requirement =
        Requirement { condition: Kind::Minor(1), on_circle: false, polynomial, square };
    Ok(Inequality::new(&requirement, &names, Some(variable)).margin)
}

fn enclosed_margin(derived: &Derived, letters: &Letters) -> Result<Margin, CertificationError> {
    // As many factors s and 1 − s as all groups share.
    let divisible = |s: usize, complement: usize| {
        enclosed_rows(&derived.polynomial, letters, s, complement).is_ok()
    };
    let most =
        2 * derived.polynomial.0.keys().map(|power| power.e[0].unsigned_abs()).max().unwrap_or(0);
    let s = (0..most as usize).find(|&s| !divisible(s + 1, 0)).unwrap_or(0);
    let complement = (0..most as usize).find(|&c| !divisible(s, c + 1)).unwrap_or(0);
    let rows = enclosed_rows(&derived.polynomial, letters, s, complement)?;
    let unit = Rational::new(BigInt::one(), BigInt::one() << BITS);
    let highest = rows.keys().last().copied().unwrap_or(0);
    let powers: Vec<EnclosedSeries> = (0..=highest)
        .map(|power| match rows.get(&power) {
            None => EnclosedSeries::constant(Rational::zero()),
            Some(series) => {
                let middle = series.values.len() / 2;
                let cosines = series.values[middle..].iter().enumerate().map(|(m, value)| {
                    let twice = if m == 0 { 1 } else { 2 };
                    Rational::from(value * twice) * &unit
                });
                // Twice the error, so that another enclosure of the truth has room in it.
                let radius = Rational::from(&series.error * 2) * &unit;
                EnclosedSeries::new(&cosines.collect::<Vec<_>>(), radius).shortened(KEPT_BITS)
            }
        })
        .collect();
    Ok(Margin::of_polynomial(&powers).with_factors(s, complement))
}

/// `Q`, `W` and a power of `C` with which the derived polynomial is `Q² W C^k` times the margin.
type Cofactor = (Vec<Vec<Exact>>, Vec<Exact>, usize);

fn cofactor(derived: &Derived, margin: &Margin) -> Result<Cofactor, CertificationError> {
    let wrong = || CertificationError::NotWritten("a condition is no square times what decides");
    let whole = |row: &Vec<BigInt>| Row::new(row.iter().cloned().map(Rational::from).collect());
    let rows: BTreeMap<usize, Row> =
        exact_rows(&derived.polynomial)?.iter().map(|(c, row)| (*c, whole(row))).collect();
    let one = Row::one();
    if rows.values().all(Zero::is_zero) {
        return Ok((vec![exact(&one)], exact(&one), 0));
    }
    // The margin by power of C, all factors in.
    let s = Row::monomial(Rational::one(), 1);
    let factor = s.pow(margin.phase_power())
        * (one.clone() - s).pow(margin.complement_power())
        * margin.neutral_waves().pow(2);
    let parts: Vec<(usize, Row)> = (0..margin.powers())
        .map(|j| {
            let row = margin.coefficient(j).in_powers_of_s() * factor.clone();
            (margin.courant_power() + margin.stride() * j, row)
        })
        .filter(|(_, row)| !row.is_zero())
        .collect();
    let (first, lowest) = parts.first().ok_or_else(wrong)?.clone();
    // Long division from the lowest power of C on.
    let mut rest = rows;
    let mut quotient: BTreeMap<usize, Row> = BTreeMap::new();
    while let Some((&power, row)) = rest.iter().find(|(_, row)| !row.is_zero()) {
        let step = power.checked_sub(first).ok_or_else(wrong)?;
        let value = quotient_of(row, &lowest).ok_or_else(wrong)?;
        if quotient.len() > 1000 || step > 1000 {
            return Err(wrong());
        }
        for (own, part) in &parts {
            let target = rest.entry(own + step).or_insert_with(Row::zero);
            *target = target.clone() - part.clone() * value.clone();
        }
        rest.retain(|_, row| !row.is_zero());
        quotient.insert(step, value);
    }
    let power = quotient.keys().next().copied().unwrap_or(0);
    let common = quotient
        .values()
        .skip(1)
        .fold(quotient[&power].clone(), |all, row| greatest_common_divisor_of(&all, row));
    let highest = quotient.keys().last().copied().unwrap_or(0);
    let q: Vec<Row> = (power..=highest)
        .map(|c| quotient.get(&c).map_or_else(Row::zero, |row| row.divide(&common).0))
        .collect();
    let (mut square, constant) = square_root(&q).ok_or_else(wrong)?;
    let root = common_square_root(std::slice::from_ref(&common));
    let weight = common.divide(&root.pow(2)).0.scale(&constant);
    square.iter_mut().for_each(|row| *row = row.clone() * root.clone());
    Ok((square.iter().map(exact).collect(), exact(&weight), power))
}

fn exact(row: &Row) -> Vec<Exact> {
    match row.coefficients() {
        [] => vec![Exact(Rational::zero())],
        values => values.iter().cloned().map(Exact).collect(),
    }
}

fn quotient_of(row: &Row, divisor: &Row) -> Option<Row> {
    let (quotient, rest) = row.divide(divisor);
    rest.is_zero().then_some(quotient)
}

fn greatest_common_divisor_of(left: &Row, right: &Row) -> Row {
    let (mut a, mut b) = (left.clone(), right.clone());
    while !b.is_zero() {
        let rest = a.divide(&b).1;
        a = std::mem::replace(&mut b, rest);
    }
    match a.coefficients().last() {
        Some(leading) => a.scale(&leading.recip()),
        None => a,
    }
}

/// `Σ_i C^i q_i` as a constant times a square.
fn square_root(q: &[Row]) -> Option<(Vec<Row>, Rational)> {
    let constant = q.first()?.coefficients().last()?.clone();
    let normal: Vec<Row> = q.iter().map(|row| row.scale(&constant.recip())).collect();
    let first = common_square_root(&normal[..1]);
    let leading = first.coefficients().last()?.recip();
    let first = first.scale(&leading);
    let mut roots = vec![first.clone()];
    let twice = first.scale(&Rational::from_integer(2.into()));
    for i in 1..=(q.len() - 1) / 2 {
        let known =
            (1..i).fold(Row::zero(), |sum, j| sum + roots[j].clone() * roots[i - j].clone());
        roots.push(quotient_of(&(normal[i].clone() - known), &twice)?);
    }
    let product = |i: usize| {
        let pairs = (0..=i).filter(|j| *j < roots.len() && i - j < roots.len());
        pairs.fold(Row::zero(), |sum, j| sum + roots[j].clone() * roots[i - j].clone())
    };
    (0..q.len().max(2 * roots.len() - 1))
        .all(|i| normal.get(i).cloned().unwrap_or_else(Row::zero) == product(i))
        .then_some((roots, constant))
}

fn factored(margin: &Margin, power: usize) -> FactoredMargin {
    let mut coefficients: Vec<Vec<Exact>> = Vec::new();
    for series in margin.integer_series() {
        let powers = series.in_powers_of_s();
        coefficients.push((0..=margin.degree()).map(|i| powers.coefficient(i).into()).collect());
    }
    let mut radius: Vec<Exact> = margin.integer_radius().iter().cloned().map(Exact::from).collect();
    if coefficients.is_empty() {
        coefficients.push(vec![BigInt::zero().into()]);
        radius.push(BigInt::zero().into());
    }
    let neutral = margin.neutral_waves().coefficients();
    FactoredMargin {
        phase_power: margin.phase_power(),
        complement_power: margin.complement_power(),
        neutral_waves: neutral.iter().cloned().map(Exact).collect(),
        courant_power: margin.courant_power() + power,
        stride: margin.stride(),
        denominator: margin.denominator().clone().into(),
        coefficients,
        radius,
    }
}
