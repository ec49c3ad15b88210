//! `χ` at long waves: each coefficient as a power series in `x = iφ`, with `E = e^x`.

use super::Field;
use crate::exact::laurent::{Exponents, Laurent, Variable};
use crate::exact::rational::Rational;
use crate::exact::rational_function::RationalFunction;
use crate::scheme::{Letter, LetterKind, Step};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// `[a_0, a_1, …]`.
pub(super) type Series = Vec<RationalFunction>;

/// `Σ_n A_n(x) z^n`.
pub(super) struct Levels {
    pub(super) levels: Vec<Series>,
    /// The largest radius of a kernel sum in it.
    pub(super) radius: Rational,
}

impl Letter {
    /// Whether its expansion takes its place; irrational numbers stay letters.
    fn is_expanded(&self) -> bool {
        match self.kind {
            LetterKind::Versines | LetterKind::Sines => true,
            LetterKind::Constant | LetterKind::Quotient => {
                self.of.is_some() || self.value.is_exact()
            }
            LetterKind::SquareRoot(_) => false,
        }
    }
}

impl Levels {
    /// Up to the power `order` of `x`. In more than one dimension the wave runs along a direction whose components take the
    /// places of the shifts: `E_a = e^{n_a x}`.
    pub(super) fn new(step: &Step, chi: &Laurent, field: &Field, order: usize) -> Self {
        let expanded: Vec<(Variable, &Letter)> = step
            .names()
            .letters()
            .filter(|(variable, letter)| letter.is_expanded() && chi.contains(*variable))
            .collect();
        let letters: Vec<Series> =
            expanded.iter().map(|(_, letter)| cosines(step, letter, order)).collect();
        let radii = expanded.iter().map(|(_, letter)| letter.value.radius().clone());
        let radius = radii.max().unwrap_or_default();
        let levels = chi.coefficients(Variable::TIME);
        let expand = |level: &Laurent| -> Series {
            let mut groups: BTreeMap<Vec<i16>, Vec<(Exponents, BigInt)>> = BTreeMap::new();
            for (exponents, value) in level.terms() {
                let mut rest = *exponents;
                let powers = expanded.iter().map(|(v, _)| std::mem::take(&mut rest[v.0]));
                let powers: Vec<i16> = powers.collect();
                groups.entry(powers).or_default().push((rest, value.clone()));
            }
            let mut sum = vec![RationalFunction::zero(); order + 1];
            for (powers, terms) in groups {
                let mut product = exponentials(step, &terms, order);
                for (letter, power) in letters.iter().zip(powers) {
                    for _ in 0..power {
                        product = field.product(&product, letter);
                    }
                }
                sum = sum.into_iter().zip(product).map(|(a, b)| a + b).collect();
            }
            sum
        };
        Self { levels: levels.iter().map(expand).collect(), radius }
    }
}

/// The exponent of `E_1^{k_1} …` over `x`.
fn slope(step: &Step, exponents: &Exponents) -> Laurent {
    if step.dimension() == 1 {
        return Laurent::integer(exponents[1].into());
    }
    (0..3).fold(Laurent::default(), |sum, axis| {
        let variable = Variable::axis(axis);
        sum + Laurent::variable(variable).scaled(&exponents[variable.0].into())
    })
}

/// `Σ c p^a e^{k x}`.
fn exponentials(step: &Step, terms: &[(Exponents, BigInt)], order: usize) -> Series {
    let slopes: Vec<Laurent> = terms.iter().map(|(exponents, _)| slope(step, exponents)).collect();
    let mut powers: Vec<Laurent> = terms
        .iter()
        .map(|(exponents, value)| {
            let mut names = *exponents;
            names[1..4].fill(0);
            Laurent::monomial(names, value.clone())
        })
        .collect();
    let mut factorial = BigInt::one();
    let mut series = Vec::with_capacity(order + 1);
    for power in 0..=order {
        let all = powers.iter().flat_map(|term| term.terms().iter().cloned());
        let scale = RationalFunction::from(Rational::new(BigInt::one(), factorial.clone()));
        series.push(RationalFunction::from(Laurent::new(all.collect())) * scale);
        powers.iter_mut().zip(&slopes).for_each(|(term, slope)| *term = &*term * slope);
        factorial *= power + 1;
    }
    series
}

/// `Σ_m r_m cos mφ = Σ_m r_m (e^{mx} + e^{−mx})/2`.
fn cosines(step: &Step, letter: &Letter, order: usize) -> Series {
    let terms = (0i16..).zip(letter.value.numerators()).flat_map(|(m, value)| {
        [m, -m].map(|shift| {
            let mut exponents = Exponents::default();
            exponents[Variable::axis(0).0] = shift;
            (exponents, value.clone())
        })
    });
    let half = Rational::new(BigInt::one(), letter.value.denominator() * 2);
    let series = exponentials(step, &terms.collect::<Vec<_>>(), order);
    series.into_iter().map(|value| value * RationalFunction::from(half.clone())).collect()
}
