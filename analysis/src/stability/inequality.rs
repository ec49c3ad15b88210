//! A condition as a polynomial in the wave and one parameter: letters get their values, factors that vanish trivially come out.

use crate::exact::bernstein::{MarginForm, Sign};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::laurent::{Laurent, VARIABLES, Variable};
use crate::exact::rational::{Rational, integer};
use crate::scheme::Names;
use crate::stability::MAX_BOXES;
use crate::stability::conditions::{Condition, Requirement};
use crate::stability::margin::Margin;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// Bits kept of letters in long products: far more than a limit is reported with, and few enough for high powers.
const KEPT_BITS: u32 = 160;

/// Products of more letters than this are made of cut ones.
const SHORT_PRODUCT: i16 = 2;

/// One condition, ready to be decided: `P(s, C) ≥ 0` for all waves.
#[derive(Debug, Clone)]
pub struct Inequality {
    /// What it says.
    pub condition: Condition,
    /// Whether two multipliers on the circle meet where it vanishes.
    pub on_circle: bool,
    /// The polynomial.
    pub margin: Margin,
    /// Whether a factor that does not depend on the parameter is negative for some wave: the lattice is unstable whatever the step.
    pub whatever_the_step: bool,
    /// Whether it was divided by a square that may vanish for all waves at some values of the parameter: there it says nothing.
    pub thinned: bool,
}

impl Inequality {
    /// That of the only multiplier, with its margin.
    pub(crate) fn of_gain(margin: Margin) -> Self {
        let condition = Condition::Minor(1);
        Self { condition, on_circle: false, margin, whatever_the_step: false, thinned: false }
    }

    /// From a condition; all parameters but `parameter` must have their values. With `None` all must.
    pub fn new(requirement: &Requirement, names: &Names, parameter: Option<Variable>) -> Self {
        let mut polynomial = requirement.polynomial.clone();
        let mut whatever_the_step = false;
        if let Some(variable) = parameter
            && let Some(common) = symmetric(polynomial.content(variable))
            && let Some(rest) = polynomial.divide_exactly(&common)
        {
            let margin = |factor: &Laurent| margin_of(factor, names, None, &Rational::one());
            let factor = margin(&common);
            // What vanishes for these values of the letters stays: it says nothing.
            if !factor.is_neutral() {
                let plus = is_nowhere_negative(&factor);
                if plus == Some(true) {
                    polynomial = rest;
                } else {
                    match is_nowhere_negative(&margin(&-common)) {
                        Some(true) => polynomial = -rest,
                        minus => {
                            whatever_the_step = plus == Some(false) && minus == Some(false);
                        }
                    }
                }
            }
        }
        Self {
            condition: requirement.condition,
            on_circle: requirement.on_circle,
            margin: margin_of(&polynomial, names, parameter, &Rational::one()),
            whatever_the_step,
            thinned: parameter.is_some_and(|p| requirement.square.primitive().contains(p)),
        }
    }
}

/// Whether a condition without a parameter holds for every wave; `None` where that is not known.
fn is_nowhere_negative(margin: &Margin) -> Option<bool> {
    let form = MarginForm::new(margin);
    match form.sign(&integer(0), &integer(1), MAX_BOXES).0 {
        Sign::NowhereNegative => Some(true),
        // For some data within the radius, or for all.
        Sign::SomewhereNegative { phase_parameter, .. } => {
            let highest = form.integers_at(&phase_parameter, 1);
            highest.iter().any(Signed::is_negative).then_some(false)
        }
        Sign::Undecided => None,
    }
}

/// Shifted so that it is a real function of the wave, if it is one or i times one.
pub(crate) fn symmetric(polynomial: Laurent) -> Option<Laurent> {
    let mut centred = polynomial;
    for axis in 0..3 {
        // Odd when added, no shift makes it real.
        let (low, high) = centred.range(Variable::axis(axis))?;
        centred = centred.shifted(Variable::axis(axis), -(low + high) / 2);
    }
    centred.is_real().then_some(centred)
}

/// A real polynomial in the waves and letters as `s^a (1 − s)^b` times a cosine series, and `a` and `b`; `None` if it is not real or has
/// parameters.
pub(crate) fn even_series(
    polynomial: &Laurent,
    names: &Names,
) -> Option<(EnclosedSeries, usize, usize)> {
    let parameters = names.parameters().any(|(_, variable)| polynomial.contains(variable));
    if parameters || !polynomial.is_real() {
        return None;
    }
    let (groups, phase_power, complement_power) = grouped(polynomial, None);
    let mut powers = BTreeMap::new();
    let mut sum = EnclosedSeries::constant(Rational::zero());
    for ((_, letters), series) in groups {
        let rational = series.map(|value| Rational::from(value.clone()));
        let mut term = EnclosedSeries::new(rational.coefficients(), Rational::zero());
        for (place, power) in letters {
            term = term.times(&power_of_letter(&mut powers, names, place, power, true));
        }
        sum = sum.plus(&term);
    }
    Some((sum, phase_power, complement_power))
}

/// `s^a (1 − s)^b Σ_j C^j p_j`.
#[derive(Debug, Clone)]
pub(crate) struct FactoredSeries {
    powers: Vec<EnclosedSeries>,
    phase_power: usize,
    complement_power: usize,
}

impl FactoredSeries {
    fn margin(&self) -> Margin {
        Margin::of_polynomial(&self.powers).with_factors(self.phase_power, self.complement_power)
    }

    /// As the margin `1 − |g|²`: that of a permitted growth, `(1 + ε)² − |g|²`.
    pub(crate) fn growing(&self, growth: &Rational) -> Margin {
        if growth.is_zero() {
            return self.margin();
        }
        let s = EnclosedSeries::half_versine();
        let complement = EnclosedSeries::constant(Rational::one()).plus(&s.scaled(&integer(-1)));
        let factors = std::iter::repeat_n(&s, self.phase_power)
            .chain(std::iter::repeat_n(&complement, self.complement_power));
        let factor = factors.fold(EnclosedSeries::constant(Rational::one()), |f, g| f.times(g));
        let mut powers: Vec<_> = self.powers.iter().map(|power| power.times(&factor)).collect();
        let budget = EnclosedSeries::constant(growth * (growth + integer(2)));
        match powers.first_mut() {
            Some(first) => *first = first.plus(&budget),
            None => powers.push(budget),
        }
        Margin::of_polynomial(&powers).with_growth(growth)
    }
}

/// The margin of a real polynomial in the waves, one parameter and letters, times `scale`.
pub(crate) fn margin_of(
    polynomial: &Laurent,
    names: &Names,
    parameter: Option<Variable>,
    scale: &Rational,
) -> Margin {
    series_of(polynomial, names, parameter, scale).margin()
}

/// A real polynomial in the waves, one parameter and letters, times `scale`, as series by powers of the parameter.
pub(crate) fn series_of(
    polynomial: &Laurent,
    names: &Names,
    parameter: Option<Variable>,
    scale: &Rational,
) -> FactoredSeries {
    let (groups, phase_power, complement_power) = grouped(polynomial, parameter);
    let most =
        groups.keys().map(|(_, letters)| letters.iter().map(|(_, power)| power).sum::<i16>());
    let short = most.max().unwrap_or(0) <= SHORT_PRODUCT;
    let mut powers_of_letters: BTreeMap<(usize, i16), EnclosedSeries> = BTreeMap::new();
    let mut sums: Vec<EnclosedSeries> = Vec::new();
    for ((degree, letters), series) in groups {
        let rational = series.map(|value| Rational::from(value.clone()) * scale);
        let mut term = EnclosedSeries::new(rational.coefficients(), Rational::zero());
        for (place, power) in letters {
            let value = power_of_letter(&mut powers_of_letters, names, place, power, short);
            term = term.times(&value);
        }
        while sums.len() <= degree {
            sums.push(EnclosedSeries::constant(Rational::zero()));
        }
        sums[degree] = sums[degree].plus(&term);
    }
    let powers: Vec<EnclosedSeries> =
        if short { sums } else { sums.into_iter().map(|s| s.shortened(KEPT_BITS)).collect() };
    FactoredSeries { powers, phase_power, complement_power }
}

fn power_of_letter(
    known: &mut BTreeMap<(usize, i16), EnclosedSeries>,
    names: &Names,
    place: usize,
    power: i16,
    short: bool,
) -> EnclosedSeries {
    if let Some(value) = known.get(&(place, power)) {
        return value.clone();
    }
    let value = if power == 1 {
        let letter = names.letters().find(|(variable, _)| variable.0 == place);
        let value = letter.expect("only letters and the parameter are left").1.value.clone();
        if short { value } else { value.shortened(KEPT_BITS) }
    } else {
        let lower = power_of_letter(known, names, place, power - 1, short);
        let product = match power {
            2 => lower.squared(),
            _ => lower.times(&power_of_letter(known, names, place, 1, short)),
        };
        if short { product } else { product.shortened(KEPT_BITS) }
    };
    known.insert((place, power), value.clone());
    value
}

/// A power of the parameter and powers of letters.
type Group = (usize, Vec<(usize, i16)>);

/// Cosine series by power of the parameter and letters, without the powers of `s` and `1 − s` that all share.
fn grouped(
    polynomial: &Laurent,
    parameter: Option<Variable>,
) -> (BTreeMap<Group, CosineSeries<BigInt>>, usize, usize) {
    let mut coefficients: BTreeMap<Group, Vec<BigInt>> = BTreeMap::new();
    for (exponents, value) in polynomial.terms() {
        // Symmetric in E: the negative powers repeat the positive ones, and 2 cos kφ is their sum.
        let Ok(order) = usize::try_from(exponents[Variable::axis(0).0]) else { continue };
        let degree = parameter.map_or(0, |variable| exponents[variable.0] as usize);
        let letters = (4..VARIABLES)
            .filter(|&v| exponents[v] != 0 && parameter != Some(Variable(v)))
            .map(|v| (v, exponents[v]))
            .collect();
        let series = coefficients.entry((degree, letters)).or_default();
        // Terms are sorted: orders ascend.
        series.resize(order, BigInt::zero());
        series.push(if order == 0 { value.clone() } else { value * 2 });
    }
    let mut groups: BTreeMap<Group, CosineSeries<BigInt>> = coefficients
        .into_iter()
        .map(|(group, values)| (group, CosineSeries::new(values)))
        .collect();
    let (mut phase_power, mut complement_power) = (0, 0);
    if groups.values().all(CosineSeries::is_zero) {
        return (groups, 0, 0);
    }
    while let Some(divided) = divided(&groups, CosineSeries::divide_by_s) {
        groups = divided;
        phase_power += 1;
    }
    while let Some(divided) = divided(&groups, CosineSeries::divide_by_complement) {
        groups = divided;
        complement_power += 1;
    }
    (groups, phase_power, complement_power)
}

fn divided(
    groups: &BTreeMap<Group, CosineSeries<BigInt>>,
    divide: impl Fn(&CosineSeries<BigInt>) -> Option<CosineSeries<BigInt>>,
) -> Option<BTreeMap<Group, CosineSeries<BigInt>>> {
    groups.iter().map(|(group, series)| Some((group.clone(), divide(series)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use crate::exact::real_roots::power_of_two;
    use crate::scheme::LetterKind;
    use crate::stability::{PointVerdict, decide_at};

    #[test]
    fn a_factor_without_the_parameter_has_the_sign_that_is_proved() {
        // Letters: 2, 1.01 within 1/100, 0, and −s.
        let mut names = Names::default();
        let parameter = names.insert_parameter("C").unwrap();
        let minus_s = EnclosedSeries::half_versine().scaled(&integer(-1));
        let values = [
            EnclosedSeries::constant(integer(2)),
            EnclosedSeries::new(&[ratio(101, 100)], ratio(1, 100)),
            EnclosedSeries::constant(integer(0)),
            minus_s,
        ];
        let letters = values.map(|value| {
            let name = |number: usize| format!("x{number}");
            names.insert_letter(LetterKind::Constant, value, None, name).unwrap()
        });
        let [two, about_one, zero, minus_s] = letters.map(Laurent::variable);
        let one = || Laurent::integer(1);
        let cosine =
            Laurent::power_of(Variable::axis(0), 1) + Laurent::power_of(Variable::axis(0), -1);
        let open = about_one.scaled(&100.into()) - Laurent::integer(101);
        let rising =
            (Laurent::integer(2) - cosine.clone()).scaled(&2.into()) + open.clone() - one();
        let falling =
            (Laurent::integer(2) + cosine.clone()).scaled(&2.into()) + open.clone() - one();
        // What a factor leaves of 1 − C at 1/2 and 2, and whether no step helps.
        for (factor, expected, whatever_the_step) in [
            (two.clone(), "+-", false),
            (one() - two, "-+", false),
            (minus_s, "-+", false),
            (about_one.clone(), "+-", false),
            // Its sign is not known: no more is said.
            (open.clone(), "??", false),
            (zero, "++", false),
            (cosine.clone(), "--", true),
            // Certain somewhere, and open elsewhere: 4 s and what may have either sign.
            (one() + Laurent::integer(1) - cosine.clone() + open.clone(), "?-", false),
            (cosine.clone() - Laurent::integer(2) - open, "-?", false),
            // At most 0 for the longest wave and perhaps 0 there, positive for the shortest; and its negative.
            (rising.clone(), "?-", false),
            (-rising, "-?", false),
            (falling.clone(), "?-", false),
            (-falling, "-?", false),
            (cosine.clone() + Laurent::integer(3), "+-", false),
            (cosine.clone() - Laurent::integer(3), "-+", false),
        ] {
            let requirement = Requirement {
                condition: Condition::PlusOne,
                on_circle: false,
                polynomial: &factor * &(one() - Laurent::variable(parameter)),
                square: one(),
            };
            let found = Inequality::new(&requirement, &names, Some(parameter));
            let signs =
                [ratio(1, 2), integer(2)].map(|value| match decide_at(&found.margin, &value) {
                    PointVerdict::Stable => '+',
                    PointVerdict::Unstable(_) => '-',
                    PointVerdict::Undecided => '?',
                });
            assert_eq!(String::from_iter(signs), expected, "{factor:?}");
            assert_eq!(found.whatever_the_step, whatever_the_step, "{factor:?}");
            // What has a sign is taken out.
            let stays = expected.contains('?') || whatever_the_step;
            assert_eq!(
                found.margin.degree(),
                usize::from(stays && factor.contains(Variable::axis(0)))
            );
            assert!(!found.thinned);
            let square = Laurent::variable(parameter) - one();
            assert!(
                Inequality::new(&Requirement { square, ..requirement }, &names, Some(parameter))
                    .thinned
            );
        }
    }

    #[test]
    fn long_products_of_letters_are_cut_and_short_ones_are_not() {
        let mut names = Names::default();
        let value = Rational::new(BigInt::from(1) << 310, BigInt::from(3).pow(195));
        let long = EnclosedSeries::new(std::slice::from_ref(&value), power_of_two(-300));
        let name = |number: usize| format!("x{number}");
        let letter = names.insert_letter(LetterKind::Constant, long, None, name).unwrap();
        let power = |exponent| Laurent::power_of(letter, exponent);
        let (fine, coarse) = (power_of_two(-250), power_of_two(-150));
        for exponent in 1..5 {
            let margin = margin_of(&power(exponent), &names, None, &Rational::one());
            let radius =
                Rational::new(margin.integer_radius()[0].clone(), margin.denominator().clone());
            assert_eq!(radius < fine, exponent <= SHORT_PRODUCT, "{exponent}");
            let found = margin.coefficient(0).at_zero();
            assert!(radius < coarse && (found - value.pow(i32::from(exponent))).abs() < coarse);
            assert!(*even_series(&power(exponent), &names).unwrap().0.radius() < fine);
        }
        // However many letters there are: the numbers stay as long as one.
        let again = EnclosedSeries::new(&[value], power_of_two(-290));
        let again = names.insert_letter(LetterKind::Constant, again, None, name).unwrap();
        let product = power(3) * Laurent::power_of(again, 3);
        let margin = margin_of(&product, &names, None, &Rational::one());
        assert!(margin.denominator().bits() < 200);
        // 4 s, as it is and with something permitted more.
        let cosine =
            Laurent::power_of(Variable::axis(0), 1) + Laurent::power_of(Variable::axis(0), -1);
        let four_s = Laurent::integer(2) - cosine;
        for polynomial in [four_s.clone(), four_s * Laurent::variable(letter)] {
            let series = series_of(&polynomial, &names, None, &Rational::one());
            let powers =
                [integer(0), integer(1)].map(|growth| series.growing(&growth).phase_power());
            assert_eq!(powers, [1, 0]);
        }
    }

    #[test]
    fn what_is_not_real_or_has_parameters_is_no_series() {
        let mut names = Names::default();
        let parameter = names.insert_parameter("C").unwrap();
        let shift = |power| Laurent::power_of(Variable::axis(0), power);
        assert!(even_series(&Laurent::variable(parameter), &names).is_none());
        assert!(even_series(&shift(1), &names).is_none());
        // s² (1 − s), times 64: (2 − E − 1/E)² (2 + E + 1/E).
        let cosine = shift(1) + shift(-1);
        let [four_s, rest] = [-cosine.clone(), cosine].map(|c| Laurent::integer(2) + c);
        let (series, s, complement) = even_series(&(four_s.pow(2) * rest), &names).unwrap();
        assert_eq!((series.center().at_zero(), s, complement), (integer(64), 2, 1));
        // Shifted to the middle where it has one: 1 − E is i times a real function at half a shift.
        assert_eq!(symmetric(shift(3) + shift(1)), Some(shift(1) + shift(-1)));
        assert_eq!(
            [symmetric(shift(1) - Laurent::integer(1)), symmetric(shift(2) - Laurent::integer(1))],
            [None, None]
        );
    }
}
