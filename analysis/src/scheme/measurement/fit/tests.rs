use super::*;
use crate::exact::rational::ratio;
use crate::scheme::measurement::{Base, Experiment};
use crate::stability::{Evidence, SearchPlan, decide_step_at};
use std::f64::consts::SQRT_2;

type State<'a> = &'a dyn Fn(i64, i64) -> f64;

/// Measures a step of one unknown in one dimension at eighths and fits it; `new(u, j, C)` reads `u(level, j)`.
fn fitted(
    levels: usize,
    new: impl Fn(State, i64, f64) -> f64 + Sync,
) -> Result<MeasuredStep, NoFit> {
    let layout = StateLayout { levels, unknowns: 1, size: vec![24] };
    let experiment = Experiment { layout: layout.clone(), base: Base::Zero, tolerance: 1.5e-14 };
    let measured = (1..=8).map(|eighths| {
        let c = f64::from(eighths) / 8.0;
        let stencil = experiment.measure(|old| {
            let at = |level: i64, j: i64| old[level as usize * 24 + j.rem_euclid(24) as usize];
            Ok::<_, String>((0..24).map(|j| new(&at, j, c)).collect())
        });
        (ratio(i64::from(eighths), 8), stencil.unwrap())
    });
    MeasuredStep::fit(&layout, &["u".into()], Some("C"), &measured.collect::<Vec<_>>())
}

#[test]
fn lax_wendroff_is_recognised_and_has_the_polynomial_of_the_equation() {
    let found = fitted(1, |u, j, c| {
        let (left, here, right) = (u(0, j - 1), u(0, j), u(0, j + 1));
        here - c * (right - left) / 2.0 + c * c * (right - 2.0 * here + left) / 2.0
    });
    let found = found.unwrap();
    let typed =
        "u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + C^2/2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    let typed = Step::from_text(typed).unwrap();
    let read = Step::from_text(&found.equations().join("; ")).unwrap();
    assert_eq!(read.characteristic().unwrap(), typed.characteristic().unwrap());
    assert!(found.recognised && found.growth.is_zero() && found.verifications >= 2);
    assert_eq!(found.step.characteristic().unwrap(), typed.characteristic().unwrap());
    let limit = found.step.limit("C").unwrap();
    assert_eq!((limit.value(), limit.evidence()), (1.0, Evidence::Measured));
    let monotone = found.step.monotone_set("C", &SearchPlan::default()).unwrap().unwrap();
    assert_eq!(monotone.evidence, Evidence::Measured);
}

#[test]
fn two_levels_are_leapfrog() {
    let found = fitted(2, |u, j, c| u(0, j) - c * (u(1, j + 1) - u(1, j - 1))).unwrap();
    let limit = found.step.limit("C").unwrap();
    assert_eq!((limit.value(), limit.is_included()), (1.0, false));
    // The other road: the text it is written as is the same scheme.
    assert_eq!(found.equations(), ["u[n+1,j] = u[n-1,j] + C*u[n,j-1] - C*u[n,j+1]"]);
    let read = Step::from_text(&found.equations().join("; ")).unwrap();
    assert_eq!(read.characteristic().unwrap(), found.step.characteristic().unwrap());
}

#[test]
fn an_irrational_coefficient_stays_a_decimal_and_its_limit_has_a_tolerance() {
    // Upwind with the speed √2/… : limit 1/√2.
    let found = fitted(1, |u, j, c| u(0, j) - SQRT_2 * c * (u(0, j) - u(0, j - 1))).unwrap();
    assert!(!found.recognised && found.growth.is_positive());
    let plan = SearchPlan::default().growing(found.growth.clone());
    let limit = found.step.stable_set("C", &plan).unwrap().limit();
    assert!((limit.value() - SQRT_2 / 2.0).abs() < 1e-8, "{limit:?}");
    assert_eq!(limit.evidence(), Evidence::Measured);
    let at = |c: Rational| decide_step_at(&found.step.with("C", &c).unwrap(), &found.growth);
    assert_eq!(at(ratio(7, 10)).unwrap(), crate::stability::PointVerdict::Stable);
    assert_ne!(at(ratio(71, 100)).unwrap(), crate::stability::PointVerdict::Stable);
}

#[test]
fn what_is_no_polynomial_is_refused_and_what_does_not_vary_has_no_parameter() {
    let refused = fitted(1, |u, j, c| (u(0, j) + c * u(0, j - 1)) / (1.0 + c)).unwrap_err();
    assert!(refused.to_string().contains("no polynomial in C of degree up to 5"), "{refused}");
    let fixed = fitted(1, |u, j, _| 0.5 * (u(0, j) + u(0, j - 1))).unwrap();
    assert!(fixed.parameter.is_none() && fixed.step.free_parameters().is_empty());
}

#[test]
fn basis_polynomials_are_one_at_their_own_node_only() {
    let nodes = [ratio(1, 3), ratio(2, 1), ratio(-5, 7)];
    let basis = lagrange(&nodes.iter().collect::<Vec<_>>());
    for (i, one) in basis.iter().enumerate() {
        for (j, node) in nodes.iter().enumerate() {
            assert_eq!(one.evaluate(node), integer(i64::from(i == j)));
        }
    }
}
