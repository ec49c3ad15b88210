use super::*;
use crate::exact::rational::ratio;

#[test]
fn square_roots_are_recognised_and_enclosed() {
    assert_eq!(ExactValue::square_root(ratio(9, 4)).to_string(), "3/2");
    assert_eq!(ExactValue::square_root(ratio(8, 3)).to_string(), "sqrt(8/3)");
    let limit = Limit::exactly(ExactValue::square_root(ratio(2, 1)), Evidence::Proved);
    assert!(limit.lower() <= 2f64.sqrt() && 2f64.sqrt() <= limit.upper());
    assert!(limit.upper() <= limit.lower().next_up());
    assert_eq!(Limit::exactly(ExactValue::square_root(ratio(4, 1)), Evidence::Proved).value(), 2.0);
}
#[test]
fn what_is_printed_is_what_the_enclosure_settles() {
    let enclosed = |lower: Rational, width: Rational| {
        Limit::enclosed(lower.clone(), lower + width, Evidence::Enclosed)
    };
    let width = ratio(5, 1_000_000);
    // The logarithm of what is not quite 1 is 0 in floating point, and its first digit one place lower.
    let below_one = enclosed(integer(1) - ratio(1, 10).pow(20), width.clone());
    assert_eq!(below_one.decimal(9).unwrap(), "0.99999");
    assert_eq!(enclosed(integer(1), width).decimal(9).unwrap(), "1.00000");
    // A unit wide is not settled to the unit.
    assert_eq!(enclosed(integer(1), ratio(1, 100_000)).decimal(9).unwrap(), "1.0000");
    // Known to hundreds of digits, an f64, and samples of one.
    let third = |evidence| Limit::exactly(ExactValue::Fraction(ratio(1, 3)), evidence);
    assert_eq!(third(Evidence::Proved).decimal(17).unwrap(), "0.33333333333333333");
    let sampled = third(Evidence::Sampled { phases: 9 });
    assert_eq!(sampled.decimal(17).unwrap(), "0.333333333333333");
}

#[test]
fn no_digits_where_there_is_no_limit_and_none_but_zero_at_zero() {
    let none = Limit::beyond(&integer(10), Evidence::Proved);
    assert_eq!((none.decimal(5), none.proved_decimal(5)), (None, None));
    let zero = Limit::exactly(ExactValue::Fraction(integer(0)), Evidence::Proved);
    assert_eq!(
        (zero.decimal(5).unwrap(), zero.proved_decimal(5).unwrap()),
        ("0".into(), "0".into())
    );
    // What is proved, however far the upper end may be.
    let open = Limit::between(0.75, 2.0, Evidence::Undecided);
    assert_eq!((open.proved_decimal(3).unwrap(), open.value()), ("0.750".into(), 0.75));
}
