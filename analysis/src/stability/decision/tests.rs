use super::*;
use crate::exact::rational::{ratio, to_f64};
use crate::stability::multiplicity_at;

fn to_nine() -> SearchPlan {
    SearchPlan::default().up_to(integer(9))
}

#[test]
fn parameters_without_a_value_are_named() {
    let step = Step::from_text("u[n+1,j] = u[n,j] - a*C*(u[n,j] - u[n,j-1])").unwrap();
    let missing =
        |names: &[&str]| SchemeError::NotSet(names.iter().map(|name| name.to_string()).collect());
    assert_eq!(step.limit("C").unwrap_err(), missing(&["a"]));
    assert_eq!(step.monotone_set("C", &to_nine()).unwrap_err(), missing(&["a"]));
    assert_eq!(decide_step_at(&step, &integer(0)).unwrap_err(), missing(&["a", "C"]));
    assert_eq!(multiplicity_at(&step).unwrap_err(), missing(&["a", "C"]));
}

#[test]
fn limits_for_several_growths_are_those_for_each() {
    // One multiplier, and two.
    let upwind = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])";
    let leapfrog = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])";
    for (text, expected) in [
        // |1 − 2C| ≤ 1 + ε; the greater root of z² + 2iCz − 1 at a quarter of the circle is C + √(C² − 1).
        (upwind, [ratio(1, 1), ratio(21, 20), ratio(5, 4)]),
        (leapfrog, [ratio(1, 1), ratio(221, 220), ratio(13, 12)]),
    ] {
        let step = Step::from_text(text).unwrap();
        let growths = [integer(0), ratio(1, 10), ratio(1, 2)];
        let all = step.limits_by("C", &to_nine(), &growths).unwrap();
        for ((growth, limit), expected) in growths.iter().zip(&all).zip(expected) {
            let alone = step.limit_by("C", &to_nine().growing(growth.clone())).unwrap();
            let expected = to_f64(&expected);
            for found in [limit, &alone] {
                assert!(
                    (found.value() / expected - 1.0).abs() < 1e-12,
                    "{text} {growth} {found:?}"
                );
            }
        }
    }
}
