//! Exact division and greatest common divisors.
//!
//! Most pairs have no common divisor, and one image modulo a prime at random values of all variables but one proves it; only
//! the others go through pseudo-remainders (Collins' primitive sequence).

use super::{Laurent, VARIABLES, Variable};
use crate::exact::modular::PrimeField;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

impl Laurent {
    /// The quotient, if nothing is left over.
    pub fn divide_exactly(&self, divisor: &Self) -> Option<Self> {
        if self.is_zero() {
            return Some(Self::default());
        }
        if let Some((exponents, value)) = divisor.as_monomial() {
            let terms = self.terms().iter().map(|(own, coefficient)| {
                let (quotient, rest) = coefficient.div_rem(value);
                let mut lowered = *own;
                lowered.iter_mut().zip(exponents).for_each(|(power, by)| *power -= by);
                rest.is_zero().then_some((lowered, quotient))
            });
            return terms.collect::<Option<Vec<_>>>().map(Self::from_sorted);
        }
        // Long division by the term of highest order; the order is that of the exponents, lexicographic.
        let (leading, leading_value) = divisor.terms().last()?;
        let (own, own_powers) = (self.lowest_powers(), divisor.lowest_powers());
        let mut rest = self.clone();
        let mut quotient = Vec::new();
        while let Some((exponents, value)) = rest.terms().last() {
            let (factor, left_over) = value.div_rem(leading_value);
            let mut powers = *exponents;
            powers.iter_mut().zip(leading).for_each(|(power, by)| *power -= by);
            // A quotient has no lower powers than the difference of the lowest ones.
            let too_low = (0..VARIABLES).any(|v| powers[v] < own[v] - own_powers[v]);
            if !left_over.is_zero() || too_low {
                return None;
            }
            let term = Self::monomial(powers, factor.clone());
            rest = rest - &term * divisor;
            quotient.push((powers, factor));
        }
        quotient.reverse();
        Some(Self::from_sorted(quotient))
    }

    /// The factor that its coefficients with respect to a variable have in common.
    pub fn content(&self, variable: Variable) -> Self {
        let lowest = self.range(variable).map_or(0, |(lowest, _)| lowest);
        let coefficients = self.shifted(variable, -lowest).coefficients(variable);
        common_divisor(coefficients)
    }

    /// Modulo a prime, at one value of every variable but `kept`: the coefficients of its powers.
    fn image(&self, kept: Variable, values: &[u64; VARIABLES], field: &PrimeField) -> Vec<u64> {
        let mut image = vec![0; self.degree(kept) as usize + 1];
        for (exponents, value) in self.terms() {
            let mut product = field.embed(value);
            for variable in (0..VARIABLES).filter(|&v| v != kept.0 && exponents[v] != 0) {
                let power = field.power(values[variable], exponents[variable] as u64);
                product = field.multiply(product, power);
            }
            let place = &mut image[exponents[kept.0] as usize];
            *place = field.add(*place, product);
        }
        image
    }
}

/// The divisor of all, primitive, without monomial factors; zero when all are.
pub(crate) fn common_divisor(mut polynomials: Vec<Laurent>) -> Laurent {
    // Short ones first: the divisor is soon known, or known to be one.
    polynomials.retain(|polynomial| !polynomial.is_zero());
    polynomials.sort_by_key(|polynomial| polynomial.terms().len());
    let mut common = Laurent::default();
    for polynomial in &polynomials {
        common = greatest_common_divisor(&common, polynomial);
        if common.as_constant().is_some() {
            break;
        }
    }
    common
}

/// The greatest common divisor, primitive over the integers and without monomial factors, with a positive leading
/// coefficient; the other polynomial's when one is zero.
///
/// ```
/// use courant_analysis::exact::laurent::{Laurent, Variable, greatest_common_divisor};
/// let (x, y) = (Laurent::variable(Variable::TIME), Laurent::variable(Variable::axis(0)));
/// let common = x.clone() * y.clone() - Laurent::integer(2);
/// let left = common.clone() * (x.clone() + y.clone());
/// let right = common.clone() * (x - y) * Laurent::integer(6);
/// assert_eq!(greatest_common_divisor(&left, &right), common);
/// ```
pub fn greatest_common_divisor(left: &Laurent, right: &Laurent) -> Laurent {
    let (left, right) = (left.primitive(), right.primitive());
    if left.is_zero() || right.is_zero() {
        return normal(if left.is_zero() { right } else { left });
    }
    let occurring = |polynomial: &Laurent| -> Vec<bool> {
        (0..VARIABLES).map(|v| polynomial.contains(Variable(v))).collect()
    };
    let (in_left, in_right) = (occurring(&left), occurring(&right));
    if let Some(only) = (0..VARIABLES).find(|&v| in_left[v] != in_right[v]) {
        // A divisor of both is free of what only one contains.
        let variable = Variable(only);
        let (with, without) = if in_left[only] { (left, right) } else { (right, left) };
        return greatest_common_divisor(&with.content(variable), &without);
    }
    let shared: Vec<Variable> = (0..VARIABLES).filter(|&v| in_left[v]).map(Variable).collect();
    let degree = |v: &Variable| left.degree(*v).min(right.degree(*v));
    let Some(main) = shared.iter().copied().min_by_key(degree) else {
        return Laurent::integer(1);
    };
    if left == right {
        return normal(left);
    }
    if shared.iter().all(|&variable| surely_coprime(&left, &right, variable)) {
        return Laurent::integer(1);
    }
    if shared.len() > 1 && surely_coprime(&left, &right, main) {
        // Free of the main variable, at least.
        return greatest_common_divisor(&left.content(main), &right.content(main));
    }
    normal(heuristic_divisor(&left, &right).unwrap_or_else(|| by_remainders(&left, &right, main)))
}

/// Collins' primitive sequence of pseudo-remainders: always right, and slow where there is much to divide.
fn by_remainders(left: &Laurent, right: &Laurent, main: Variable) -> Laurent {
    let (left_content, right_content) = (left.content(main), right.content(main));
    let content = greatest_common_divisor(&left_content, &right_content);
    let whole = |polynomial: &Laurent, content: &Laurent| {
        polynomial.divide_exactly(content).expect("a content divides").primitive()
    };
    let (mut a, mut b) = (whole(left, &left_content), whole(right, &right_content));
    if a.degree(main) < b.degree(main) {
        (a, b) = (b, a);
    }
    while b.contains(main) {
        let rest = pseudo_remainder(&a, &b, main);
        (a, b) = (b, if rest.is_zero() { rest } else { whole(&rest, &rest.content(main)) });
    }
    let divisor = if b.is_zero() { a } else { Laurent::integer(1) };
    (divisor * content).primitive()
}

/// The divisor by way of whole numbers (Char, Geddes & Gonnet 1989): at a large value of one variable the divisors of the values
/// show the divisor in their digits. `None` when no value tried does.
fn heuristic_divisor(left: &Laurent, right: &Laurent) -> Option<Laurent> {
    let occurring = |v: &usize| left.contains(Variable(*v)) || right.contains(Variable(*v));
    let Some(variable) = (0..VARIABLES).find(occurring).map(Variable) else {
        let (a, b) = (left.as_constant()?, right.as_constant()?);
        return Some(Laurent::constant(a.gcd(&b)));
    };
    let height = |polynomial: &Laurent| {
        polynomial.terms().iter().map(|(_, value)| value.abs()).max().unwrap_or_default()
    };
    let mut point: BigInt = height(left).min(height(right)) * 2 + 29;
    let bits = point.bits() * left.degree(variable).max(right.degree(variable)).max(1) as u64;
    for _ in 0..4 {
        if bits > MOST_BITS {
            return None;
        }
        let at = |polynomial: &Laurent| polynomial.at_fraction(variable, &point.clone().into());
        let (a, b) = (at(left), at(right));
        if let Some(image) = heuristic_divisor(&a, &b) {
            let candidate = digits(image, &point, variable);
            let content = candidate.integer_content();
            let candidate = candidate.divide_exactly(&Laurent::constant(content))?;
            if left.divide_exactly(&candidate).is_some()
                && right.divide_exactly(&candidate).is_some()
            {
                let common = left.integer_content().gcd(&right.integer_content());
                return Some(candidate.scaled(&common));
            }
        }
        point = &point * 73_794 / 27_011;
    }
    None
}

/// Values longer than this are no shorter way.
const MOST_BITS: u64 = 200_000;

/// The polynomial in `variable` whose value at `point` is `value`, with coefficients of the smallest size.
fn digits(mut value: Laurent, point: &BigInt, variable: Variable) -> Laurent {
    let half: BigInt = point / 2;
    let mut coefficients = Vec::new();
    while !value.is_zero() {
        let remainders = value.terms().iter().map(|(exponents, coefficient)| {
            let rest = coefficient.mod_floor(point);
            (*exponents, if rest > half { rest - point } else { rest })
        });
        let digit = Laurent::new(remainders.collect());
        let rest = value - digit.clone();
        value =
            rest.divide_exactly(&Laurent::constant(point.clone())).expect("digits are taken off");
        coefficients.push(digit);
    }
    Laurent::from_coefficients(&coefficients, variable)
}

/// With a positive leading coefficient.
pub(super) fn normal(polynomial: Laurent) -> Laurent {
    let negative = polynomial.terms().last().is_some_and(|(_, value)| value.is_negative());
    if negative { -polynomial } else { polynomial }
}

/// Whether an image proves that a common divisor does not contain `variable`.
fn surely_coprime(left: &Laurent, right: &Laurent, variable: Variable) -> bool {
    // Any values prove it; these are as good as random and always the same.
    PrimeField::descending().take(2).any(|field| {
        let mut seed = BigInt::from(0x9e37_79b9_7f4a_7c15_u64);
        let values = std::array::from_fn(|_| {
            seed = (&seed * 6_364_136_223_846_793_005_u64 + 1u8) % field.prime();
            field.embed(&seed)
        });
        let (mut a, mut b) =
            (left.image(variable, &values, &field), right.image(variable, &values, &field));
        let whole = |image: &[u64]| image.last().is_some_and(|&leading| leading != 0);
        if !whole(&a) || !whole(&b) {
            return false;
        }
        while !b.is_empty() {
            (a, b) = (b.clone(), field.remainder(a, &b));
        }
        a.len() == 1
    })
}

/// The remainder of `leading(b)^k a` by `b`.
fn pseudo_remainder(a: &Laurent, b: &Laurent, variable: Variable) -> Laurent {
    let divisor = b.coefficients(variable);
    let degree = divisor.len() - 1;
    let leading = &divisor[degree];
    let mut rest = a.coefficients(variable);
    while rest.len() > degree {
        let Some(top) = rest.pop() else { break };
        if top.is_zero() {
            continue;
        }
        let shift = rest.len() - degree;
        for value in &mut rest {
            *value = &*value * leading;
        }
        for (index, value) in divisor[..degree].iter().enumerate() {
            rest[shift + index] = std::mem::take(&mut rest[shift + index]) - &top * value;
        }
    }
    Laurent::from_coefficients(&rest, variable)
}

#[cfg(test)]
mod tests {
    use super::super::tests::laurent;
    use super::*;
    use num_traits::One;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]
        #[test]
        fn three_roads_to_a_divisor_agree(a in laurent(), b in laurent(), planted in laurent()) {
            let [left, right] = [&a * &planted, &b * &planted].map(|product| product.primitive());
            let in_both = |&v: &Variable| left.contains(v) && right.contains(v);
            prop_assume!(!left.is_zero() && !right.is_zero());
            let common = greatest_common_divisor(&left, &right);
            let plain = |found: Laurent| normal(found.primitive());
            if let Some(found) = heuristic_divisor(&left, &right) {
                prop_assert_eq!(plain(found), common.clone());
            }
            for main in (0..VARIABLES).map(Variable).filter(in_both) {
                prop_assert_eq!(plain(by_remainders(&left, &right, main)), common.clone(), "{} and {}", left, right);
                // Never said of a divisor that does contain it.
                prop_assert!(!(surely_coprime(&left, &right, main) && common.contains(main)));
            }
        }
    }

    #[test]
    fn a_quotient_of_whole_coefficients_or_none() {
        let (x, y) = (Laurent::variable(Variable::TIME), Laurent::variable(Variable::axis(0)));
        let sum = x.clone() + y.clone();
        let divided = |p: &Laurent, q: &Laurent| p.divide_exactly(q);
        assert_eq!(
            divided(&sum.scaled(&6.into()), &Laurent::integer(-3)),
            Some(sum.scaled(&(-2).into()))
        );
        assert_eq!(divided(&sum.scaled(&6.into()), &Laurent::integer(4)), None);
        assert_eq!(divided(&sum.scaled(&6.into()), &sum.scaled(&4.into())), None);
        assert_eq!(divided(&(&sum * &sum), &(x.clone() - y)), None);
        assert_eq!(
            (divided(&Laurent::default(), &sum), divided(&sum, &Laurent::default())),
            (Some(Laurent::default()), None)
        );
        // A divisor of all, with signs and monomials left out, and long numbers that no digits show.
        let all = vec![Laurent::default(), -sum.clone() * x.clone(), &sum * &sum];
        assert_eq!(common_divisor(all), sum);
        let long = Laurent::constant(BigInt::one() << 120_000) + x.clone();
        let product = |other: i64| &long * &(x.clone() - Laurent::integer(other));
        assert_eq!(heuristic_divisor(&product(1), &product(2)), None);
        assert_eq!(greatest_common_divisor(&product(1), &product(2)), long);
        // At the point that the shorter one suggests, 31, the other may vanish.
        let line = |root: i64| x.clone() - Laurent::integer(root);
        let divided = |p: &Laurent, q: &Laurent| heuristic_divisor(p, q).unwrap();
        assert_eq!(divided(&line(31), &line(-1)), Laurent::integer(1));
        assert_eq!(divided(&(line(-1) * line(31)), &line(-1)), line(-1));
    }

    #[test]
    fn primes_that_divide_a_leading_coefficient_tell_of_no_divisor() {
        let x = || Laurent::variable(Variable::TIME);
        let mut primes = PrimeField::descending().map(|field| BigInt::from(field.prime()));
        let (first, second) = (primes.next().unwrap(), primes.next().unwrap());
        let steep = |leading: &BigInt| x().scaled(leading) + Laurent::integer(1);
        let coprime = |p: &Laurent, q: &Laurent| surely_coprime(p, q, Variable::TIME);
        let line = |root: i64| x() - Laurent::integer(root);
        // Another prime tells, or none does.
        assert!(coprime(&steep(&first), &line(2)) && coprime(&line(2), &steep(&first)));
        let hidden = steep(&(&first * &second));
        assert!(!coprime(&hidden, &line(2)) && !coprime(&line(2), &hidden));
        assert!(!coprime(&(&hidden * &line(1)), &(&hidden * &line(2))));
    }
}
