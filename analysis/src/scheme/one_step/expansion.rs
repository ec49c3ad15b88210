//! Kernel sums multiplied out in shifts.
//!
//! A sum over the lattice is written in two letters, `s V = F − (R + L)/2` and `(E − 1/E) S = R − L` with `F = Σ f_k`,
//! `R = Σ f_k E^k` and `L = Σ f_k E^{−k}`. Written in `F, R, L` before the values are put in, what cancels cancels whatever the
//! values, and a weight that no coefficient has leaves no uncertainty in it.

use crate::exact::laurent::{Laurent, VARIABLES, Variable};
use crate::exact::rational::{Rational, least_multiple, numerator_over};
use crate::scheme::kernel_function::KernelFunction;
use crate::scheme::names::{Letter, LetterKind};
use crate::scheme::one_step::{Expansion, OffsetCoefficient};
use crate::scheme::step::{Step, laurent_of};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// By offset, coefficients and their radii over one denominator.
struct Shifts {
    terms: BTreeMap<i64, (BigInt, BigInt)>,
    denominator: BigInt,
}

/// The coefficients of an explicit scheme by offset, and whether it keeps constants.
pub(super) fn coefficients(step: &Step, parameter: Variable) -> Option<(Expansion, bool)> {
    let characteristic = step.characteristic().ok()?;
    let levels = characteristic.coefficients(Variable::TIME);
    let [old, new] = levels.as_slice() else { return None };
    let (exponents, unit) = new.as_monomial()?;
    if exponents[4..].iter().any(|&power| power != 0) {
        return None;
    }
    let space = Variable::axis(0);
    let mut gain = -old.shifted(space, -exponents[space.0]);
    let mut scale = unit.clone();
    // Sums over 1 − E^k vanish with s and E − 1/E.
    let keeps_constants = at_rest(&gain) == Laurent::constant(unit.clone());

    let mut values: BTreeMap<usize, Shifts> = BTreeMap::new();
    for (variable, letter) in step.names.letters() {
        values.insert(variable.0, number(&letter.value.center_at_zero(), letter.value.radius()));
    }
    // In one dimension the places of the other axes are free, and so are those without a name.
    let mut free = (4 + step.names.all().len()..VARIABLES).chain([2, 3, 0]).map(Variable);
    let sums: Vec<(Variable, &Letter)> =
        step.names.letters().filter(|(_, letter)| letter.kind != LetterKind::Constant).collect();
    for (variable, letter) in sums.iter().filter(|(_, letter)| letter.value.is_exact()) {
        let (numerator, denominator) = laurent_of(&letter.value);
        let degree = gain.degree(*variable) as usize;
        gain = gain.substitute(*variable, &numerator, &denominator);
        scale *= denominator.pow(degree).as_constant()?;
    }
    for (_, letter) in sums.iter().filter(|(_, letter)| !letter.value.is_exact()) {
        let Some(function) = &letter.of else { continue };
        let [versines, sines, total] = letters_of(step, function);
        let right = [versines, sines].into_iter().flatten().next()?;
        if letter.kind == LetterKind::Sines && versines.is_some() {
            // Done with the other one.
            continue;
        }
        let left = sines.filter(|&sines| sines != right).or_else(|| free.next())?;
        let all = match total {
            Some(total) => total,
            None => free.next()?,
        };
        gain = in_shifts(&gain, versines, sines, [right, left, all])?;
        let (sum, radius) = function.sum();
        values.insert(right.0, shifts(function, 1));
        values.insert(left.0, shifts(function, -1));
        values.insert(all.0, number(&sum, &radius));
    }

    let known = [parameter.0, space.0];
    let letters_of = |exponents: &[i16; VARIABLES]| -> Vec<(usize, i16)> {
        let letters = (0..VARIABLES).filter(|v| !known.contains(v) && exponents[*v] != 0);
        letters.map(|v| (v, exponents[v])).collect()
    };
    let mut products: BTreeMap<Vec<(usize, i16)>, Shifts> = BTreeMap::new();
    for (exponents, _) in gain.terms() {
        let letters = letters_of(exponents);
        products.entry(letters).or_insert_with_key(|letters| product(letters, &values));
    }
    let common =
        products.values().fold(BigInt::one(), |all, p| least_multiple(&all, &p.denominator));
    let mut sums: BTreeMap<i64, Vec<(BigInt, BigInt)>> = BTreeMap::new();
    for (exponents, value) in gain.terms() {
        let power = usize::try_from(exponents[parameter.0]).ok()?;
        let origin = i64::from(exponents[space.0]);
        let product = &products[&letters_of(exponents)];
        let factor = value * (&common / &product.denominator);
        for (offset, (center, radius)) in &product.terms {
            let powers = sums.entry(origin + offset).or_default();
            if powers.len() <= power {
                powers.resize(power + 1, (BigInt::zero(), BigInt::zero()));
            }
            powers[power].0 += center * &factor;
            powers[power].1 += radius * factor.abs();
        }
    }
    let coefficients = sums.into_iter().map(|(offset, powers)| {
        let (centers, radii) = powers.into_iter().unzip();
        OffsetCoefficient { offset: vec![offset], centers, radii }
    });
    Some((Expansion::new(coefficients.collect(), common * scale), keeps_constants))
}

/// The same in several dimensions, where all names but the parameter have values.
pub(super) fn coefficients_on_torus(step: &Step, parameter: Variable) -> Option<Expansion> {
    let characteristic = step.characteristic().ok()?;
    let levels = characteristic.coefficients(Variable::TIME);
    let [old, new] = levels.as_slice() else { return None };
    let (origin, unit) = new.as_monomial()?;
    if origin[4..].iter().any(|&power| power != 0) {
        return None;
    }
    let mut values: BTreeMap<Vec<i64>, Vec<BigInt>> = BTreeMap::new();
    for (exponents, value) in old.terms() {
        let place = |axis: usize| Variable::axis(axis).0;
        let offset = |axis: usize| i64::from(exponents[place(axis)] - origin[place(axis)]);
        let powers = values.entry((0..step.dimension).map(offset).collect()).or_default();
        let power = usize::try_from(exponents[parameter.0]).ok()?;
        if powers.len() <= power {
            powers.resize(power + 1, BigInt::zero());
        }
        powers[power] -= value;
    }
    let coefficients = values.into_iter().map(|(offset, centers)| {
        let radii = vec![BigInt::zero(); centers.len()];
        OffsetCoefficient { offset, centers, radii }
    });
    Some(Expansion::new(coefficients.collect(), unit.clone()))
}

/// At `E = 1`.
fn at_rest(polynomial: &Laurent) -> Laurent {
    let terms = polynomial.terms().iter().map(|(exponents, value)| {
        let mut rest = *exponents;
        rest[Variable::axis(0).0] = 0;
        (rest, value.clone())
    });
    Laurent::new(terms.collect())
}

/// The variables of `V`, `S` and `F` of one function: letters that cancel are not there.
fn letters_of(step: &Step, function: &KernelFunction) -> [Option<Variable>; 3] {
    [LetterKind::Versines, LetterKind::Sines, LetterKind::Constant].map(|kind| {
        let is_it = |letter: &Letter| letter.kind == kind && letter.of.as_ref() == Some(function);
        step.names.letters().find(|(_, letter)| is_it(letter)).map(|(variable, _)| variable)
    })
}

/// Written in `R`, `L` and `F`, of which `R` and `L` may take the variables of `V` and `S`.
fn in_shifts(
    gain: &Laurent,
    versines: Option<Variable>,
    sines: Option<Variable>,
    [right, left, total]: [Variable; 3],
) -> Option<Laurent> {
    let shift = |by: i16| Laurent::power_of(Variable::axis(0), by);
    let of = |factor: i64, variable| Laurent::integer(factor) * Laurent::variable(variable);
    // 4 s V = 4 F − 2 R − 2 L and (E − 1/E) S = R − L.
    let bend = Laurent::integer(2) - shift(1) - shift(-1);
    let slope = shift(1) - shift(-1);
    let even = of(4, total) - of(2, right) - of(2, left);
    let odd = of(1, right) - of(1, left);
    let powers = |polynomial: Laurent, variable: Option<Variable>| match variable {
        Some(variable) => polynomial.coefficients(variable),
        None => vec![polynomial],
    };
    let mut sum = Laurent::default();
    for (a, in_versines) in powers(gain.clone(), versines).into_iter().enumerate() {
        for (b, part) in powers(in_versines, sines).into_iter().enumerate() {
            let rest = part.divide_exactly(&(bend.pow(a) * slope.pow(b)))?;
            sum = sum + rest * even.pow(a) * odd.pow(b);
        }
    }
    Some(sum)
}

/// `Σ_k f(k) E^{±k}`.
fn shifts(function: &KernelFunction, sign: i64) -> Shifts {
    let denominator = least_multiple(&function.denominator, function.radius.denom());
    let factor = &denominator / &function.denominator;
    let radius = numerator_over(&function.radius, &denominator);
    let terms = (1..).zip(&function.numerators);
    let terms = terms.map(|(k, value)| (sign * k, (value * &factor, radius.clone()))).collect();
    Shifts { terms, denominator }
}

fn number(value: &Rational, radius: &Rational) -> Shifts {
    let denominator = least_multiple(value.denom(), radius.denom());
    let pair = (numerator_over(value, &denominator), numerator_over(radius, &denominator));
    Shifts { terms: [(0, pair)].into_iter().collect(), denominator }
}

fn product(letters: &[(usize, i16)], values: &BTreeMap<usize, Shifts>) -> Shifts {
    letters.iter().fold(number(&Rational::one(), &Rational::zero()), |product, (place, power)| {
        (0..*power).fold(product, |product, _| times(&product, &values[place]))
    })
}

fn times(left: &Shifts, right: &Shifts) -> Shifts {
    let mut terms: BTreeMap<i64, (BigInt, BigInt)> = BTreeMap::new();
    for (i, (a, a_radius)) in &left.terms {
        for (j, (b, b_radius)) in &right.terms {
            let sum = terms.entry(i + j).or_default();
            sum.0 += a * b;
            // |ab − a₀b₀| ≤ |a₀| r_b + |b₀| r_a + r_a r_b.
            sum.1 += a.abs() * b_radius + b.abs() * a_radius + a_radius * b_radius;
        }
    }
    Shifts { terms, denominator: &left.denominator * &right.denominator }
}
