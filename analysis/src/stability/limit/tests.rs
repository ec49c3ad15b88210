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
fn limits_are_included_unless_multipliers_meet_there() {
    let limit = Limit::exactly(ExactValue::Fraction(integer(1)), Evidence::Proved);
    assert!(limit.is_included() && limit.binding().is_none() && limit.critical_wave().is_none());
    for on_circle in [false, true] {
        let (condition, whatever_the_step) = (Condition::PlusOne, false);
        let binding = Binding { condition, on_circle, whatever_the_step };
        let bound = limit.clone().bound_by(binding).at_phase(1.0);
        assert_eq!((bound.is_included(), bound.binding()), (!on_circle, Some(binding)));
        assert_eq!(bound.critical_wave().unwrap().phases(), [1.0]);
    }
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

#[test]
fn samples_have_the_digits_that_their_ends_share() {
    // Known as two floating-point numbers only, 2^−20 apart: less than a unit of the sixth digit.
    let sampled = Limit::between(0.25, 0.25 + 0.5f64.powi(20), Evidence::Sampled { phases: 9 });
    assert_eq!(sampled.enclosure(60), None);
    assert_eq!(sampled.decimal(9).unwrap(), "0.250000");
}

#[test]
fn evidence_is_as_weak_as_its_weakest_part() {
    // From the strongest to the weakest.
    let all = [
        Evidence::Proved,
        Evidence::Enclosed,
        Evidence::Measured,
        Evidence::Sampled { phases: 9 },
        Evidence::Undecided,
    ];
    for (i, first) in all.into_iter().enumerate() {
        for (j, second) in all.into_iter().enumerate() {
            assert_eq!(first.weaker(second), all[i.max(j)]);
        }
        let measured = Limit::between(1.0, 2.0, first).measured().evidence();
        let expected = if i == 4 { Evidence::Undecided } else { Evidence::Measured };
        assert_eq!(measured, expected);
    }
    // Of two sampled ones the first.
    let [few, many] = [8, 9].map(|phases| Evidence::Sampled { phases });
    assert_eq!(few.weaker(many), few);
}

#[test]
fn waves_are_long_short_or_between() {
    let cause = |phases: &[f64]| Cause::of_wave(&Wave::new(phases.to_vec()));
    for long in [&[0.0][..], &[0.0, 0.0]] {
        assert_eq!(cause(long), Cause::LongWave);
    }
    for short in [&[PI][..], &[PI, PI], &[0.0, PI], &[-PI, 0.0, PI]] {
        assert_eq!(cause(short), Cause::ShortestWave);
    }
    for between in [&[1.0][..], &[PI.next_down()], &[0.0, 1.0], &[PI, 1.0], &[1.0, 2.0]] {
        assert_eq!(cause(between), Cause::Interior);
    }
}

#[test]
fn closed_forms_are_written_as_people_do() {
    let exactly = |value| Limit::exactly(value, Evidence::Proved).closed_form();
    assert_eq!(exactly(ExactValue::Fraction(ratio(15, 8))).unwrap(), "15/8");
    assert_eq!(exactly(ExactValue::square_root(ratio(8, 3))).unwrap(), "sqrt(8/3)");
    let root = |values: &[i64]| {
        let polynomial = values.iter().map(|&value| value.into()).collect();
        let polynomial = crate::exact::polynomial::Polynomial::new(polynomial);
        let number = AlgebraicNumber::between(polynomial, ratio(1, 2), integer(2)).unwrap();
        Limit::root_of(number, Evidence::Proved).closed_form()
    };
    // x² − 3, x³ − 2, 3x³ − 2; x³ − x − 1 has no root of a fraction.
    assert_eq!(root(&[-3, 0, 1]).unwrap(), "sqrt(3)");
    assert_eq!(root(&[-2, 0, 0, 1]).unwrap(), "2^(1/3)");
    assert_eq!(root(&[-2, 0, 0, 3]).unwrap(), "(2/3)^(1/3)");
    assert_eq!(root(&[-1, -1, 0, 1]), None);
    assert_eq!(Limit::between(1.0, 2.0, Evidence::Proved).closed_form(), None);
}

#[test]
fn a_lattice_that_no_step_helps_is_called_so() {
    let name = |whatever_the_step| {
        let condition = Condition::PlusOne;
        Binding { condition, on_circle: false, whatever_the_step }.name()
    };
    assert_eq!((name(true), name(false)), ("lattice".into(), Condition::PlusOne.name()));
}
