use super::square_free::square_free_factors;
use super::*;
use proptest::prelude::*;

pub(super) fn laurent() -> impl Strategy<Value = Laurent> {
    let term = (-2i16..3, -2i16..3, 0i16..3, -9i64..9).prop_map(|(z, e, name, value)| {
        let mut exponents = [0; VARIABLES];
        (exponents[0], exponents[1], exponents[4]) = (z, e, name);
        (exponents, BigInt::from(value))
    });
    prop::collection::vec(term, 0..5).prop_map(Laurent::new)
}

/// The value at `z = 2, E = 3, name = 5`, times `6^12` to stay whole.
fn value(polynomial: &Laurent) -> BigInt {
    let scale = Rational::from(BigInt::from(6).pow(24));
    let at = |base: i64, power: i16| Rational::from(BigInt::from(base)).pow(i32::from(power));
    let sum: Rational = polynomial
        .terms()
        .iter()
        .map(|(e, c)| at(2, e[0]) * at(3, e[1]) * at(5, e[4]) * Rational::from(c.clone()))
        .sum();
    (sum * scale).to_integer()
}

proptest! {
    #[test]
    fn arithmetic_is_that_of_values(a in laurent(), b in laurent(), big in any::<i64>()) {
        let scale = BigInt::from(6).pow(24);
        let b = b.scaled(&(BigInt::from(big) * big));
        prop_assert_eq!(value(&(a.clone() + b.clone())), value(&a) + value(&b));
        prop_assert_eq!(value(&(a.clone() - b.clone())), value(&a) - value(&b));
        prop_assert_eq!(value(&-a.clone()), -value(&a));
        prop_assert_eq!(value(&(&a * &b)) * &scale, value(&a) * value(&b));
        prop_assert_eq!((&a * &b).conjugate(), a.conjugate() * b.conjugate());
    }

    #[test]
    fn products_are_the_same_in_a_box_and_out_of_it(a in laurent(), b in laurent(), apart in 1i16..60, big in any::<i64>()) {
        // Exponents far apart leave most of a box empty.
        let spread = |p: &Laurent, factor: i64| {
            let terms = p.terms().iter().map(|(e, c)| (e.map(|power| power * apart), c * factor));
            Laurent::new(terms.collect())
        };
        for factor in [1, big] {
            let (a, b) = (spread(&a, factor), spread(&b, factor));
            let pairs = a.terms().iter().flat_map(|(e, x)| b.terms().iter().map(move |(f, y)| {
                (std::array::from_fn(|v| e[v] + f[v]), x * y)
            }));
            prop_assert_eq!(&a * &b, Laurent::new(pairs.collect()));
        }
    }

    #[test]
    fn divisors_divide_and_planted_ones_are_found(a in laurent(), b in laurent(), planted in laurent()) {
        prop_assume!(!a.is_zero() && !b.is_zero() && !planted.is_zero());
        let (left, right) = (&a * &planted, &b * &planted);
        let common = greatest_common_divisor(&left, &right);
        prop_assert!(left.divide_exactly(&common).is_some() && right.divide_exactly(&common).is_some());
        let planted = planted.primitive();
        prop_assert!(common.divide_exactly(&planted).is_some(), "{} misses {}", common, planted);
        let (p, q) = (left.divide_exactly(&common).unwrap(), right.divide_exactly(&common).unwrap());
        prop_assert_eq!(greatest_common_divisor(&p, &q), Laurent::integer(1));
    }

    #[test]
    fn square_free_factors_multiply_up(a in laurent(), b in laurent()) {
        prop_assume!(!a.is_zero() && !b.is_zero());
        let whole = &(&a * &b.pow(2)).primitive() * &Laurent::integer(-3);
        let factors = square_free_factors(&whole);
        let product = (1..).zip(&factors).fold(Laurent::integer(1), |p, (m, f)| &p * &f.pow(m));
        let quotient = whole.divide_exactly(&product).expect("factors divide");
        prop_assert!(quotient.as_monomial().is_some(), "{} of {}", quotient, whole);
        for factor in &factors {
            prop_assert!(square_free_factors(factor).len() <= 1);
        }
    }

    #[test]
    fn the_odd_part_of_a_real_function_is_real_and_has_its_sign(a in laurent(), b in laurent(), d in laurent()) {
        // |a|² (b + b̄) (d − d̄)²: planted squares of functions that are even, odd and neither.
        let at_wave = |p: &Laurent, phase: f64| -> num_complex::Complex64 {
            p.terms().iter().map(|(e, c)| {
                let value: f64 = c.to_string().parse().unwrap();
                num_complex::Complex64::from_polar(value * 1.5f64.powi(e[4].into()), phase * f64::from(e[1]))
            }).sum()
        };
        let alone = |p: Laurent| {
            // Neither z nor a negative power of a name.
            let terms = p.terms().iter().map(|(e, c)| {
                let mut e = *e;
                e[0] = 0;
                (e, c.clone())
            });
            Laurent::new(terms.collect())
        };
        let (a, b, d) = (alone(a), alone(b), alone(d));
        let (real, odd) = (b.clone() + b.conjugate(), d.clone() - d.conjugate());
        prop_assume!(!a.is_zero() && !real.is_zero() && !odd.is_zero());
        let whole = &(&(&a * &a.conjugate()) * &real) * &(&odd * &odd);
        let reduced = whole.odd_part();
        prop_assert!(reduced.is_real(), "{} of {}", reduced, whole);
        for k in 1..9 {
            let phase = 0.371 * f64::from(k);
            let (x, y) = (at_wave(&whole, phase).re, at_wave(&reduced, phase).re);
            prop_assert!(x.abs() < 1e-6 || y.abs() < 1e-6 || (x > 0.0) == (y > 0.0), "{} of {}", reduced, whole);
        }
    }
}

#[test]
fn what_is_no_unit_has_no_inverse_and_what_is_not_real_keeps_its_squares() {
    let (z, e) = (Laurent::variable(Variable::TIME), Laurent::power_of(Variable::axis(0), -2));
    let unit = -(&z * &e);
    assert_eq!(&unit * &unit.inverse_monomial().unwrap(), Laurent::integer(1));
    assert_eq!([unit.scaled(&2.into()), z.clone() + e].map(|p| p.inverse_monomial()), [None, None]);
    let squared = (z.clone() + Laurent::variable(Variable::axis(0)).scaled(&2.into())).pow(2);
    assert_eq!(squared.odd_part(), squared);
    let zero = z.scaled(&0.into());
    assert!(zero == Laurent::default() && Zero::is_zero(&zero) && !Zero::is_zero(&z));
}

#[test]
fn fractions_and_substitutions() {
    let (x, y) = (Laurent::variable(Variable::name(0)), Laurent::variable(Variable::axis(0)));
    let p = x.clone() * x.clone() + x.clone() * y.clone() - Laurent::integer(3);
    // At x = 2/3, times 9: 4 + 6y − 27.
    let at = p.at_fraction(Variable::name(0), &Rational::new(2.into(), 3.into()));
    assert_eq!(at, y.scaled(&6.into()) - Laurent::integer(23));
    let inserted = p.substitute(Variable::name(0), &y, &Laurent::integer(2));
    assert_eq!(inserted, y.clone() * y.clone() * Laurent::integer(3) - Laurent::integer(12));
    assert_eq!(p.coefficients(Variable::name(0))[1], y);
    assert_eq!(p.derivative(Variable::name(0)), x.scaled(&2.into()) + y.clone());
    let inverse = Laurent::power_of(Variable::axis(0), -2);
    let slope = Laurent::power_of(Variable::axis(0), -3).scaled(&(-2).into());
    assert_eq!(
        (inverse.derivative(Variable::axis(0)), inverse.content(Variable::axis(0))),
        (slope, Laurent::integer(1))
    );
    // A square of a prime beyond those that are tried.
    let square = (x.clone() * x.clone()).scaled(&(1009 * 1009).into());
    assert_eq!(square.square_part(), (x.scaled(&1009.into()), Laurent::integer(1)));
}
