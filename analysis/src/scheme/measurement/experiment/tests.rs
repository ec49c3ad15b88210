use super::*;

const SIZE: usize = 16;

fn experiment(base: Base, tolerance: f64) -> Experiment {
    let layout = StateLayout { levels: 1, unknowns: 1, size: vec![SIZE] };
    Experiment { layout, base, tolerance }
}

fn measured(
    experiment: &Experiment,
    new: impl Fn(&dyn Fn(i64) -> f64, i64) -> f64 + Sync,
) -> Result<MeasuredStencil, Objection<String>> {
    experiment.measure(|old| {
        let at = |j: i64| old[j.rem_euclid(old.len() as i64) as usize];
        Ok((0..old.len() as i64).map(|j| new(&at, j)).collect())
    })
}

fn coefficients(stencil: &MeasuredStencil) -> Vec<(i64, f64)> {
    stencil.coefficients.iter().map(|(place, g)| (place.offset[0], *g)).collect()
}

fn minmod(a: f64, b: f64) -> f64 {
    if a * b <= 0.0 { 0.0 } else { a.signum() * a.abs().min(b.abs()) }
}

#[test]
fn a_source_is_told_from_the_linear_part() {
    let found =
        measured(&experiment(Base::Zero, 1e-14), |u, j| 0.25 * u(j + 1) + 0.75 * u(j - 2) + 3.0);
    let found = found.unwrap();
    assert_eq!((coefficients(&found), found.source), (vec![(-2, 0.75), (1, 0.25)], 3.0));
}

#[test]
fn each_way_not_to_be_a_scheme_has_its_own_answer() {
    let linear = experiment(Base::Zero, 1e-14);
    let burgers =
        |u: &dyn Fn(i64) -> f64, j: i64| u(j) - 0.25 * (u(j) * u(j) - u(j - 1) * u(j - 1));
    assert!(matches!(measured(&linear, burgers), Err(Objection::NotProportional { .. })));
    // A limiter of degree 1: proportional, but no sum of impulses.
    let limited =
        |u: &dyn Fn(i64) -> f64, j: i64| u(j) - 0.5 * minmod(u(j + 1) - u(j), u(j) - u(j - 1));
    assert!(matches!(measured(&linear, limited), Err(Objection::NotAdditive { .. })));
    let varies = |u: &dyn Fn(i64) -> f64, j: i64| if j % 2 == 0 { u(j) } else { 0.5 * u(j) };
    assert!(matches!(measured(&linear, varies), Err(Objection::NotInvariant { .. })));
    // A wall far from the impulse.
    let wall = |u: &dyn Fn(i64) -> f64, j: i64| if j == 0 { 0.0 } else { u(j - 1) };
    assert!(matches!(measured(&linear, wall), Err(Objection::NotInvariant { .. })));
    let wide = |u: &dyn Fn(i64) -> f64, j: i64| u(j) + u(j + 7);
    let objection = measured(&linear, wide).unwrap_err();
    assert_eq!(objection, Objection::TooWide { axis: 0, size: SIZE, reach: 7 });
    let failed = linear.measure(|_| Err("no"));
    assert_eq!(failed, Err(Objection::Step("no")));
}

#[test]
fn about_a_state_burgers_is_advection_with_its_speed() {
    // Upwind differences of u²/2 about u = 0.5: 1 − C u at 0, C u at −1, C = 0.4.
    let burgers = |u: &dyn Fn(i64) -> f64, j: i64| u(j) - 0.2 * (u(j) * u(j) - u(j - 1) * u(j - 1));
    let found = measured(&experiment(Base::About(vec![0.5; SIZE]), 1e-9), burgers).unwrap();
    let found = coefficients(&found);
    // Quadratic: central differences have no error but rounding.
    assert_eq!(found.iter().map(|(k, _)| *k).collect::<Vec<_>>(), [-1, 0]);
    assert!((found[0].1 - 0.2).abs() < 1e-10 && (found[1].1 - 0.8).abs() < 1e-10, "{found:?}");
    let kink = |u: &dyn Fn(i64) -> f64, j: i64| (u(j) - 0.5).max(0.0);
    let kink = measured(&experiment(Base::About(vec![0.5; SIZE]), 1e-9), kink);
    assert!(matches!(kink, Err(Objection::NotSmooth { .. })), "{kink:?}");
}

#[test]
fn rounding_to_single_precision_is_named_and_accepted_with_its_tolerance() {
    let single = |u: &dyn Fn(i64) -> f64, j: i64| f64::from((u(j) * 0.3 + u(j - 1) * 0.7) as f32);
    let refused = measured(&experiment(Base::Zero, 1e-14), single).unwrap_err().to_string();
    assert!(refused.contains("single precision"), "{refused}");
    assert!(measured(&experiment(Base::Zero, 1e-7), single).is_ok());
}
