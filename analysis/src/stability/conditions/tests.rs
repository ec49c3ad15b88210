use super::*;
use crate::exact::laurent::VARIABLES;
use crate::exact::rational::{integer, ratio};
use crate::scheme::Step;
use crate::stability::{Evidence, PointVerdict, decide_step_at};
use num_bigint::BigInt;
use num_complex::Complex64;
use proptest::prelude::*;

/// Roots by the Durand–Kerner iteration: simple and slow, for tests.
fn roots(coefficients: &[Complex64]) -> Vec<Complex64> {
    let degree = coefficients.len() - 1;
    let monic: Vec<Complex64> = coefficients.iter().map(|c| c / coefficients[degree]).collect();
    let value = |z: Complex64| monic.iter().rev().fold(Complex64::ZERO, |sum, c| sum * z + c);
    let mut z: Vec<Complex64> =
        (0..degree as i32).map(|k| Complex64::new(0.4, 0.9).powi(k)).collect();
    for _ in 0..400 {
        for i in 0..degree {
            let others = (0..degree).filter(|&j| j != i).map(|j| z[i] - z[j]);
            let product: Complex64 = others.product();
            let step = value(z[i]) / product;
            z[i] -= step;
        }
    }
    z
}

fn at(polynomial: &Laurent, e: Complex64) -> Complex64 {
    polynomial.terms().iter().fold(Complex64::ZERO, |sum, (exponents, value)| {
        let value: f64 = value.to_string().parse().unwrap();
        sum + e.powi(i32::from(exponents[1])) * value
    })
}

fn laurent(symmetric: bool) -> impl Strategy<Value = Laurent> {
    prop::collection::vec(-5i64..6, 3).prop_map(move |values| {
        let mut terms = Vec::new();
        for (index, value) in values.into_iter().enumerate() {
            let power = index as i16 - 1;
            let mut exponents = [0; VARIABLES];
            exponents[1] = power;
            terms.push((exponents, BigInt::from(value)));
            if symmetric {
                exponents[1] = -power;
                terms.push((exponents, BigInt::from(value)));
            }
        }
        Laurent::new(terms)
    })
}

fn check(coefficients: Vec<Laurent>, lead: i64) -> Result<(), TestCaseError> {
    let mut coefficients = coefficients;
    // Both outcomes should occur: a heavy leading coefficient pulls roots inside.
    let last = coefficients.len() - 1;
    coefficients[last] = coefficients[last].clone() + Laurent::integer(lead);
    prop_assume!(!coefficients[last].is_zero() && !coefficients[0].is_zero());
    let chi = Laurent::from_coefficients(&coefficients, Variable::TIME).primitive();
    prop_assume!(chi.contains(Variable::TIME));
    let conditions = Conditions::new(&chi, &Rational::from_integer(0.into()), &Names::default());
    for k in 1..12 {
        let e = Complex64::from_polar(1.0, 0.267 * f64::from(k));
        let values: Vec<Complex64> =
            chi.coefficients(Variable::TIME).iter().map(|c| at(c, e)).collect();
        let size: f64 = values.iter().map(|v| v.norm()).sum();
        if values.last().unwrap().norm() < 1e-3 * size {
            continue;
        }
        let largest = roots(&values).iter().map(|z| z.norm()).fold(0.0, f64::max);
        if (largest - 1.0).abs() < 1e-5 {
            continue;
        }
        let holds = !conditions.nowhere
            && conditions.requirements.iter().all(|one| {
                let value = at(&one.polynomial, e);
                assert!(value.im.abs() <= 1e-6 * (1.0 + value.norm()), "a condition is real");
                value.re >= 0.0
            });
        prop_assert_eq!(holds, largest < 1.0, "{} at k = {}: {:?}", chi, k, largest);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn complex_conditions_say_where_the_roots_are(
        coefficients in prop::collection::vec(laurent(false), 2..5), lead in 0i64..25
    ) {
        check(coefficients, lead)?;
    }

    #[test]
    fn real_conditions_say_where_the_roots_are(
        coefficients in prop::collection::vec(laurent(true), 2..7), lead in -25i64..25
    ) {
        check(coefficients, lead)?;
    }

    #[test]
    fn circle_parts_do_not_hide_the_rest(
        a in laurent(false), b in laurent(true), lead in 0i64..12
    ) {
        // (z² + b z + 1)(lead z + a): a self-inversive factor planted beside another.
        let circle = [Laurent::integer(1), b, Laurent::integer(1)];
        let rest = [a, Laurent::integer(lead)];
        let product = Laurent::from_coefficients(&circle, Variable::TIME)
            * Laurent::from_coefficients(&rest, Variable::TIME);
        check(product.coefficients(Variable::TIME), 0)?;
    }
}

#[test]
fn a_product_of_multipliers_on_the_circle_leaves_one_outside() {
    // z⁴ − C (E + 1/E) z³ − 1: the product of the roots is −1 and none has its mirror image, so that one is outside; an inner
    // determinant of Jury's vanishes.
    let conditions = conditions_of("u[n+1,j] = u[n-3,j] + C*(u[n,j+1] + u[n,j-1])");
    assert!(conditions.nowhere && conditions.requirements.is_empty());
}

fn conditions_of(text: &str) -> Conditions {
    let step = Step::from_text(text).unwrap();
    let chi = step.characteristic().unwrap();
    Conditions::new(&chi, &Rational::from_integer(0.into()), step.names())
}

#[test]
fn no_condition_is_asked_twice_or_for_nothing() {
    // Three levels of a real polynomial: χ(±1) and two determinants of two rows.
    let cubic = "u[n+1,j] = C*(u[n,j+1] + u[n,j-1]) - C*u[n-1,j]/4 + u[n-2,j]/8";
    let names: Vec<_> = conditions_of(cubic).requirements.iter().map(|one| one.condition).collect();
    let [inner, plus, minus] = [Condition::Inner(2), Condition::PlusOne, Condition::MinusOne];
    assert_eq!(names, [plus, minus, inner, inner]);
    // Multipliers on the circle throughout ask by their derivative, once, however often they occur.
    let leapfrog = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])";
    let twice = format!("{leapfrog}; w[n+1,j] = w[n-1,j] - C*(w[n,j+1] - w[n,j-1])");
    for text in [leapfrog, &twice] {
        let [only] = &conditions_of(text).requirements[..] else { panic!("{text}") };
        assert!(only.on_circle && only.condition == Condition::Minor(1), "{text}");
    }
    // A neutral scheme of one multiplier asks for nothing.
    let crank_nicolson =
        "u[n+1,j] + C/4*(u[n+1,j+1] - u[n+1,j-1]) = u[n,j] - C/4*(u[n,j+1] - u[n,j-1])";
    assert!(conditions_of(crank_nicolson).requirements.is_empty());
}

#[test]
fn conditions_that_nobody_wants_are_none_and_undecided() {
    let step = Step::from_text("u[n+1,j] = C*u[n,j-1] + u[n-1,j]/2 + u[n-2,j+1]/8").unwrap();
    let chi = step.characteristic().unwrap();
    let conditions = |times: usize| {
        let asked = std::sync::atomic::AtomicUsize::new(0);
        let count = move || asked.fetch_add(1, std::sync::atomic::Ordering::Relaxed) < times;
        Conditions::while_wanted(&chi, &integer(0), step.names(), &Interest::as_long_as(count))
    };
    let all = conditions(usize::MAX).requirements;
    assert!(all.len() == 3 && all.iter().all(|one| !one.on_circle));
    for times in 0..5 {
        let lost = conditions(times);
        assert!(lost.undecided && !lost.nowhere && lost.requirements.is_empty(), "{times}");
    }
}

#[test]
fn squares_are_taken_out_and_kept() {
    // |g| = 1 + (C − 1)² beside a wave that decays: the last minor contains the square of the difference from 1.
    let two = conditions_of(
        "u[n+1,j] = (1 + (C - 1)^2)*u[n,j-1] + w[n,j+1]/2; w[n+1,j] = w[n,j]/2 + C*w[n,j-1]/4 - C*w[n,j]/4",
    );
    for one in &two.requirements {
        assert_eq!(one.polynomial.odd_part(), one.polynomial, "{:?}", one.condition);
    }
    assert!(two.requirements.iter().any(|one| one.square.as_constant().is_none()));
}

#[test]
fn a_multiplier_on_the_circle_is_seen_with_square_roots_and_left_open_with_other_numbers() {
    let beside = "w[n+1,j] = w[n,j] - C*(w[n,j] - w[n,j-1])";
    for (shift, decided) in [
        ("sqrt(2)*sqrt(3)*u[n+1,j] = sqrt(6)*u[n,j-1]", true),
        ("pi*(1/pi)*u[n+1,j] = u[n,j-1]", false),
    ] {
        for dimension in [1, 2] {
            let text = match dimension {
                1 => format!("{shift}; {beside}"),
                _ => format!("{shift}; {beside}").replace(",j", ",i,j"),
            };
            let step = Step::from_text(&text).unwrap();
            let limit = step.limit("C").unwrap();
            let at = step.with("C", &ratio(1, 2)).unwrap();
            let there = decide_step_at(&at, &integer(0)).unwrap();
            if decided {
                assert_eq!((limit.value(), limit.evidence()), (1.0, Evidence::Proved), "{text}");
                assert_eq!(there, PointVerdict::Stable, "{text}");
            } else {
                assert_eq!((limit.lower(), limit.evidence()), (0.0, Evidence::Undecided), "{text}");
                assert_eq!(there, PointVerdict::Undecided, "{text}");
            }
        }
    }
}

#[test]
fn of_real_coefficients_it_is_jurys_conditions_but_for_one_root_over_what_varies() {
    let asked = |text: &str| {
        let step = Step::from_text(text).unwrap();
        let (chi, none) = (step.characteristic().unwrap(), Rational::from_integer(0.into()));
        let all = Conditions::new(&chi, &none, step.names()).requirements;
        all.iter().map(|one| one.condition).collect::<Vec<_>>()
    };
    let [plus, minus, inner] = [Condition::PlusOne, Condition::MinusOne, Condition::Inner(1)];
    assert_eq!(asked("(1 + C)*u[n+1,j] = u[n,j] + u[n-1,j]/2"), [plus, minus, inner]);
    assert_eq!(asked("(1 + C)*u[n+1,j] = u[n,j]"), [Condition::Minor(1)]);
    assert_eq!(asked("u[n+1,j] = (1 - C)*u[n,j]"), [plus, minus]);
}

#[test]
fn multipliers_that_come_several_times_are_asked_once() {
    let other = Step::from_text("u[n+1,j] = u[n,j]/2 + C*u[n,j-1]/3").unwrap();
    let other = other.characteristic().unwrap();
    for text in [
        "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])",
        "u[n+1,j] = 2*u[n,j] - u[n-1,j] + C*(u[n,j+1] - 2*u[n,j] + u[n,j-1])",
    ] {
        let step = Step::from_text(text).unwrap();
        let once = step.characteristic().unwrap();
        for growth in [integer(0), ratio(1, 10)] {
            let of = |chi: &Laurent| Conditions::new(chi, &growth, step.names()).requirements;
            assert_eq!(of(&(&once * &once)), of(&once), "{text}");
            assert_eq!(of(&(&(&once * &once) * &other)), of(&(&once * &other)), "{text}");
        }
    }
}
