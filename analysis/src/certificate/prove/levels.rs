//! Which conditions are asked of which part of `χ`.

use super::super::derive::{
    Characteristic, Poly, Power, centring, derivative, proportional, reversed_conjugate, shift_name,
};
use super::super::{Level, Rule, Split, Subject};
use super::CertificationError;
use crate::exact::laurent::{Laurent, VARIABLES, Variable, greatest_common_divisor};
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed};

/// The place of the sought parameter among the exponents.
pub(super) const PARAMETER: usize = 4;

/// One level after the other, from `χ` with its growth.
pub(super) fn levels(
    chi: &Characteristic,
    subject: &Subject,
    growth: &Rational,
) -> Result<Vec<Level>, CertificationError> {
    let mut p = chi.with_growth(growth);
    if growth.is_positive() && chi.dimension > 1 && repetitions(&p) > 1 {
        return Err(CertificationError::NotWritten(
            "multipliers come three times: with a permitted growth the checker's determinants are too long",
        ));
    }
    let mut levels = Vec::new();
    while p.len() > 1 {
        if proportional(&p, &reversed_conjugate(&p)) {
            levels.push(Level { rule: Rule::SchurCohn, split: None });
            p = derivative(&p);
            continue;
        }
        let split = split(&p)?;
        let (inside, circle) = match &split {
            Some((inside, circle)) => (inside.clone(), circle.clone()),
            None => (p, vec![Poly::one()]),
        };
        // A single multiplier asks for one condition, and so do coefficients that are not real.
        let rule =
            if inside.len() <= 2 || !is_real(&inside) { Rule::SchurCohn } else { Rule::Jury };
        levels.push(Level { rule, split: None });
        let here = levels.len() - 1;
        levels[here].split = split.map(|(inside, circle)| Split {
            inside: text(&inside, subject, chi.dimension),
            circle: text(&circle, subject, chi.dimension),
        });
        if inside.len() > 2 && rule == Rule::Jury {
            // Where an inner determinant vanishes identically the minors may not.
            let derived = chi.conditions(subject, growth, &complete(&levels, &circle))?;
            if derived.iter().any(|one| one.level == here && one.polynomial.is_zero()) {
                levels[here].rule = Rule::SchurCohn;
            }
        }
        p = if circle.len() > 1 { derivative(&circle) } else { vec![Poly::one()] };
    }
    Ok(levels)
}

/// With levels for what is still to come, whatever they be.
fn complete(levels: &[Level], circle: &[Poly<BigInt>]) -> Vec<Level> {
    let mut levels = levels.to_vec();
    let mut p = if circle.len() > 1 { derivative(circle) } else { Vec::new() };
    while p.len() > 1 {
        levels.push(Level { rule: Rule::SchurCohn, split: None });
        let whole = proportional(&p, &reversed_conjugate(&p));
        p = if whole { derivative(&p) } else { Vec::new() };
    }
    levels
}

/// How many roots `χ` has beyond its different ones, whatever the wave; those with letters are not looked at.
fn repetitions(p: &[Poly<BigInt>]) -> i16 {
    if p.iter().flat_map(|c| c.0.keys()).any(|power| !power.letters.is_empty()) {
        return 0;
    }
    let whole: Vec<Laurent> = p.iter().map(to_laurent).collect();
    let whole = Laurent::from_coefficients(&whole, Variable::TIME);
    let repeated = greatest_common_divisor(&whole, &whole.derivative(Variable::TIME));
    repeated.degree(Variable::TIME)
}

fn is_real(p: &[Poly<BigInt>]) -> bool {
    let Some(shift) = p.last().and_then(centring) else { return false };
    p.iter().all(|coefficient| {
        let centred = coefficient.moved(0, shift);
        centred == centred.conjugate()
    })
}

/// A polynomial by the powers of `z`.
type Coefficients = Vec<Poly<BigInt>>;

/// The part with its roots inside and the part with its roots on the circle, where there are both, or where a factor without `z` has to go.
fn split(p: &[Poly<BigInt>]) -> Result<Option<(Coefficients, Coefficients)>, CertificationError> {
    let letters = p.iter().flat_map(|c| c.0.keys()).any(|power| !power.letters.is_empty());
    if letters {
        return Ok(None);
    }
    let whole: Vec<Laurent> = p.iter().map(to_laurent).collect();
    let whole = Laurent::from_coefficients(&whole, Variable::TIME);
    let mirrored: Vec<Laurent> = reversed_conjugate(p).iter().map(to_laurent).collect();
    let mirrored = Laurent::from_coefficients(&mirrored, Variable::TIME);
    let content = whole.content(Variable::TIME);
    let axes = || (0..3).map(Variable::axis);
    let depends = axes().any(|axis| content.contains(axis)) && content.as_monomial().is_none();
    let common = greatest_common_divisor(&whole, &mirrored);
    if !depends && !common.contains(Variable::TIME) {
        return Ok(None);
    }
    let wrong = || CertificationError::NotWritten("a divisor does not divide");
    let circle = common.divide_exactly(&common.content(Variable::TIME)).ok_or_else(wrong)?;
    let rest = whole.divide_exactly(&content).and_then(|p| p.divide_exactly(&circle));
    let part = |p: &Laurent| -> Coefficients {
        // Whole powers of E and a positive last term read better.
        let lowest = |axis| p.range(axis).map_or(0, |(low, _)| low);
        let shifted = axes().fold(p.clone(), |p, axis| p.shifted(axis, -lowest(axis)));
        let coefficients = shifted.coefficients(Variable::TIME);
        let leading = coefficients.last().and_then(|c| c.terms().last());
        let negative = leading.is_some_and(|(_, value)| value.is_negative());
        let sign = BigInt::from(if negative { -1 } else { 1 });
        coefficients.iter().map(|c| from_laurent(&c.scaled(&sign))).collect()
    };
    Ok(Some((part(&rest.ok_or_else(wrong)?), part(&circle))))
}

/// Without letters.
pub(super) fn to_laurent(poly: &Poly<BigInt>) -> Laurent {
    let terms = poly.0.iter().map(|(power, value)| {
        let mut exponents = [0; VARIABLES];
        exponents[0] = power.z as i16;
        (1..).zip(power.e).for_each(|(place, e)| exponents[place] = e as i16);
        exponents[PARAMETER] = power.c as i16;
        (exponents, value.clone())
    });
    Laurent::new(terms.collect())
}

pub(super) fn from_laurent(polynomial: &Laurent) -> Poly<BigInt> {
    let terms = polynomial.terms().iter().map(|(exponents, value)| {
        let [z, c] = [0, PARAMETER].map(|place| i32::from(exponents[place]));
        let e = std::array::from_fn(|axis| i32::from(exponents[1 + axis]));
        (Power { z, e, c, letters: Vec::new() }, value.clone())
    });
    Poly(terms.collect())
}

/// In the language of schemes.
pub(super) fn text(p: &[Poly<BigInt>], subject: &Subject, dimension: usize) -> String {
    let mut text = String::new();
    for (z, coefficient) in p.iter().enumerate() {
        for (power, value) in &coefficient.0 {
            text += match (text.is_empty(), value.is_negative()) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            };
            let size = value.abs();
            let mut factors = Vec::new();
            let shifts = (0..dimension).map(|axis| (shift_name(axis, dimension), power.e[axis]));
            let powers = std::iter::once(("z".into(), z as i32)).chain(shifts);
            for (name, exponent) in powers.chain([(subject.parameter.clone(), power.c)]) {
                match exponent {
                    0 => {}
                    1 => factors.push(name),
                    _ => factors.push(format!("{name}^{exponent}")),
                }
            }
            if !size.is_one() || factors.is_empty() {
                factors.insert(0, size.to_string());
            }
            text += &factors.join("*");
        }
    }
    text
}
