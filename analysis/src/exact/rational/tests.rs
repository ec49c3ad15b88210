use super::*;
use num_bigint::BigUint;
use proptest::prelude::*;

#[test]
fn signs_and_denominators_count() {
    assert_eq!(quotient_to_f64(&1.into(), &BigInt::from(-2)), -0.5);
    assert!(equal(&ratio(2, 4), &ratio(1, 2)) && !equal(&ratio(1, 2), &ratio(1, 3)));
}

#[test]
fn reads_what_people_type() {
    for (text, expected) in [
        ("2", ratio(2, 1)),
        ("1.30", ratio(13, 10)),
        (".5", ratio(1, 2)),
        ("5.", ratio(5, 1)),
        ("-3/2", ratio(-3, 2)),
        ("0.1/0.3", ratio(1, 3)),
        ("1e-6", ratio(1, 1_000_000)),
        ("+2.5E1", ratio(25, 1)),
    ] {
        assert_eq!(parse(text), Ok(expected), "{text}");
    }
}

proptest! {
    #[test]
    fn divisors_and_multiples_are_those_of_the_library(
        a in any::<i128>(), b in any::<i128>(), shared in any::<i64>(), short in any::<i32>(),
    ) {
        let (a, b, shared) = (BigInt::from(a), BigInt::from(b), BigInt::from(shared));
        let short = BigInt::from(short);
        for (left, right) in [
            (&a * &shared * &shared, &b * &shared),
            (&a * &b, &shared * &short),
            (short.clone(), &short * &shared),
            (BigInt::zero(), a.clone()),
            (b.clone(), BigInt::one()),
        ] {
            prop_assert_eq!(greatest_divisor(&left, &right), left.gcd(&right));
            prop_assert_eq!(greatest_divisor(&right, &left), left.gcd(&right));
            if !right.is_zero() {
                let fraction = Rational::new(left.clone(), right.clone());
                prop_assert_eq!(reduced(left.clone(), right.clone()), fraction);
            }
            let (left, right) = (left.abs() + 1, right.abs() + 1);
            prop_assert_eq!(least_multiple(&left, &right), left.lcm(&right));
        }
    }

    #[test]
    fn powers_of_two_are_divided_out_by_shifts(
        a in any::<i64>(), b in any::<i64>(), twos in 0i64..90, more in 0i64..90, odd in 1i64..9,
    ) {
        let (left, right) = (dyadic(a.into(), -twos), dyadic(b.into(), -more));
        prop_assert_eq!(&left, &Rational::new(a.into(), BigInt::one() << twos));
        for right in [right, ratio(b, odd)] {
            prop_assert_eq!(product(&left, &right), &left * &right);
            prop_assert_eq!(compare(&left, &right), left.cmp(&right));
        }
    }
}

#[test]
fn refuses_what_is_no_number() {
    for text in ["", ".", "NaN", "inf", "1:2", "0x10", "1.2.3", "1/", "--1", "1e", "e5", "1_000"] {
        assert!(matches!(parse(text), Err(ParseRationalError::Malformed(_))), "{text}");
    }
    assert!(matches!(parse("1/0"), Err(ParseRationalError::ZeroDenominator(_))));
    assert!(matches!(parse("1e999999"), Err(ParseRationalError::OutOfRange(_))));
    assert!(matches!(parse(&"9".repeat(121)), Err(ParseRationalError::OutOfRange(_))));
}

#[test]
fn tiny_and_huge_quotients_round_without_overflow() {
    let huge = Rational::new(BigInt::from(10).pow(400), BigInt::from(10).pow(399));
    assert_eq!(to_f64(&huge), 10.0);
    assert_eq!(to_f64(&parse("1e-300").unwrap()), 1e-300);
    assert_eq!(to_f64(&parse("1e308").unwrap()), 1e308);
    let beyond = parse("1e309").unwrap();
    assert_eq!((to_f64_below(&beyond), to_f64_above(&beyond)), (f64::MAX, f64::INFINITY));
    let below = -beyond;
    assert_eq!((to_f64_below(&below), to_f64_above(&below)), (f64::NEG_INFINITY, f64::MIN));
    assert_eq!(to_f64_above(&parse("-1e-400").unwrap()).to_bits(), 0);
}

#[test]
fn numbers_are_read_up_to_their_longest() {
    assert!(parse(&"9".repeat(120)).is_ok() && parse("1e400").is_ok() && parse("1e-400").is_ok());
    for text in ["1e401", "1e-401"] {
        assert!(matches!(parse(text), Err(ParseRationalError::OutOfRange(_))), "{text}");
    }
    // On both sides of where powers of ten begin.
    for (text, digits, printed) in [
        ("0.0001", 2, "0.00010"),
        ("0.00009", 2, "9.0e-5"),
        ("0.00009", 1, "9e-5"),
        ("12345", 2, "12000"),
        ("123456", 2, "1.2e5"),
        ("1234", 2, "1200"),
        ("12", 2, "12"),
        ("12.34", 3, "12.3"),
        ("1e5", 3, "100000"),
        ("1e6", 3, "1.00e6"),
    ] {
        let found = decimal_below(&parse(text).unwrap(), digits);
        assert!(found == printed, "{text}: {found}");
    }
}

proptest! {
    #[test]
    fn printed_digits_are_not_above(numerator in 1u64.., denominator in 1u64.., digits in 1usize..25) {
        let value = Rational::new(numerator.into(), denominator.into());
        let text = decimal_below(&value, digits);
        let printed = parse(&text).unwrap();
        prop_assert!(printed <= value, "{}", text);
        let mantissa = text.split('e').next().unwrap().replace('.', "");
        let significant = mantissa.trim_start_matches('0').len();
        prop_assert!(significant >= digits);
        prop_assert!(value < &printed * (integer(1) + integer(10).pow(1 - digits as i32)));
    }

    #[test]
    fn f64_round_trips(value in prop::num::f64::NORMAL) {
        prop_assert_eq!(to_f64(&from_f64(value).unwrap()), value);
    }

    #[test]
    fn directed_rounding_encloses(numerator in any::<i64>(), denominator in 1i64..i64::MAX) {
        let exact = ratio(numerator, denominator);
        let (below, above) = (to_f64_below(&exact), to_f64_above(&exact));
        prop_assert!(from_f64(below).unwrap() <= exact && exact <= from_f64(above).unwrap());
        prop_assert!(above <= below.next_up());
        let nearest = to_f64(&exact);
        prop_assert!(nearest == below || nearest == above);
    }

    #[test]
    fn decimals_agree_with_the_standard_library(value in -1e15f64..1e15) {
        prop_assert_eq!(to_f64(&parse(&format!("{value}")).unwrap()), value);
    }

    #[test]
    fn the_simplest_fraction_lies_inside(a in -1000i64..1000, b in 1i64..1000, c in -1000i64..1000, d in 1i64..1000) {
        let (mut lower, mut upper) = (ratio(a, b), ratio(c, d));
        if lower > upper { std::mem::swap(&mut lower, &mut upper); }
        let simplest = simplest_between(&lower, &upper);
        prop_assert!(lower <= simplest && simplest <= upper);
        prop_assert!(simplest.denom() <= lower.denom() && simplest.denom() <= upper.denom());
        for denominator in (1..60).take_while(|n| BigInt::from(*n) < *simplest.denom()) {
            let n = integer(denominator);
            prop_assert!((&upper * &n).floor() < (&lower * &n).ceil());
        }
        let magnitude = simplest.abs();
        prop_assert!(magnitude < integer(1) || &magnitude - integer(1) < lower.abs().min(upper.abs()) || simplest.is_zero());
    }

    #[test]
    fn square_roots_lie_between(a in 0i64..1000, b in 1i64..1000, more in 0i64..3, bits in 1u32..80) {
        let (low, high) = (ratio(a, b), ratio(a, b) + integer(more));
        let (lower, upper) = square_root_enclosure(&low, &high, bits);
        prop_assert!(&lower * &lower <= low && high <= &upper * &upper && !lower.is_negative());
        let unit = ratio(1, 2).pow(bits as i32);
        let (next, before) = (&lower + &unit, &upper - &unit);
        prop_assert!(low < &next * &next && (before.is_negative() || &before * &before <= high));
    }
}

#[test]
fn the_root_of_zero_is_zero() {
    let zero = integer(0);
    assert_eq!(square_root_enclosure(&zero, &zero, 20), (zero.clone(), zero.clone()));
}

#[test]
fn fractions_are_set_with_their_sign_in_front() {
    let set = |above: i64, below: i64| to_latex(&ratio(above, below));
    assert_eq!([set(3, 4), set(-3, 4)], ["\\frac{3}{4}", "-\\frac{3}{4}"]);
    assert_eq!([set(5, 1), set(-5, 1), set(0, 1)], ["5", "-5", "0"]);
}

#[test]
fn leading_bits_are_those_of_the_number() {
    for bits in [1_u64, 62, 63, 64, 65, 126, 127, 128, 129, 191, 192, 193, 300] {
        let value: BigInt = (BigInt::from(1) << bits) / 3 + 1;
        let (leading, exponent) = leading_bits(&value, 126);
        let whole = BigInt::from(leading);
        // Cut, by the definition.
        let cut = if exponent >= 0 { &value >> exponent } else { &value << -exponent };
        assert_eq!((whole, leading.ilog2()), (cut, 125), "{bits}");
    }
}

proptest! {
    #[test]
    fn leading_bits_round_as_the_division_does(
        numerator in prop::collection::vec(any::<u32>(), 1..12),
        denominator in prop::collection::vec(any::<u32>(), 1..12),
        mantissa in 1_u64 << 53..1 << 54,
        shift in 0_u64..200,
    ) {
        let [numerator, denominator] = [numerator, denominator].map(|digits| BigInt::from(BigUint::new(digits)) + 1);
        let same = |numerator: &BigInt, denominator: &BigInt| {
            let (value, exponent) = nearest_by_division(numerator, denominator);
            nearest_by_leading_bits(numerator, denominator)
                .is_none_or(|(other, scale)| scale_by_power_of_two(other, scale) == scale_by_power_of_two(value, exponent))
        };
        prop_assert!(same(&numerator, &denominator));
        // Odd: half-way between two numbers of 53 bits, and next to it; the leading bits may not tell, or must be right.
        let tie: BigInt = (BigInt::from(mantissa | 1) * &denominator) << shift;
        for near in [tie.clone() - 1, tie.clone(), tie.clone() + 1] {
            prop_assert!(same(&near, &(&denominator << 7)));
        }
        prop_assert!(nearest_by_leading_bits(&tie, &denominator).is_none(), "a tie is for the division");
        let even = BigInt::from(mantissa & !1) * &denominator;
        prop_assert!(nearest_by_leading_bits(&even, &denominator).is_some(), "what has 53 bits is found");
    }
}
