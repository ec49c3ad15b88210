//! The same in two and three dimensions, on tori of which no two axes are alike.

use super::noise::grows;
use super::subject::{Subject, agrees, sees_every_change};
use super::{known_limit, scheme_at};
use courant_analysis::exact::rational::{Rational, ratio};
use courant_analysis::scheme::{Integrator, catalogue};
use courant_simulation::stepping::{SteppingError, ValidationPlan, validate};
use proptest::prelude::*;

/// The corner fluxes as a code has them: a half step across, then the difference of fluxes.
const CORNER_TRANSPORT_BY_FLUXES: &str = "p[n,i,j] = u[n,i,j] - B/2*(u[n,i,j] - u[n,i,j-1])
    q[n,i,j] = u[n,i,j] - A/2*(u[n,i,j] - u[n,i-1,j])
    u[n+1,i,j] = u[n,i,j] - A*(p[n,i,j] - p[n,i-1,j]) - B*(q[n,i,j] - q[n,i,j-1])";

/// Third-order upwind along one axis, centred along the other: to be completed by an integrator.
const LINES: &str =
    "u[i,j]' = -A/6*(2*u[i+1,j] + 3*u[i,j] - 6*u[i-1,j] + u[i-2,j]) - B/2*(u[i,j+1] - u[i,j-1])";

/// A scheme of the catalogue with another number along each axis, so that an exchange of axes is seen.
fn unequal(name: &str, along: [Rational; 3]) -> Subject {
    let [x, y, z] = along;
    let mut subject = Subject::new(catalogue::scheme(name).unwrap(), x.clone());
    for (parameter, value) in &mut subject.values {
        match parameter.as_str() {
            "a" => *value = &y / &x,
            "b" => *value = &z / &x,
            _ => {}
        }
    }
    subject
}

fn scheme(name: &str) -> Subject {
    unequal(name, [ratio(2, 7), ratio(3, 7), ratio(1, 5)])
}

fn subjects() -> Vec<Subject> {
    let schemes = [
        "lax-wendroff-2d",
        "corner-transport-upwind-2d",
        "wave-2-2d",
        "yee-te-2d",
        "yee-3d",
        "heat-peaceman-rachford-2d",
        "heat-crank-nicolson-2d",
        "heat-ftcs-3d",
    ];
    let text =
        |name, text| Subject::from_text(name, text, &[("A", ratio(2, 7)), ("B", ratio(3, 7))]);
    let lines = ["rk3-ssp", "ab3", "gauss-2"]
        .map(|name| text("lines", LINES).with_integrator(Integrator::named(name).unwrap()));
    let fluxes = text("corner-transport-by-fluxes", CORNER_TRANSPORT_BY_FLUXES);
    schemes.map(scheme).into_iter().chain([fluxes]).chain(lines).collect()
}

fn dimension(subject: &Subject) -> usize {
    subject.running().unwrap().dimension()
}

#[test]
fn schemes_on_a_torus_run_as_predicted() {
    for subject in subjects() {
        agrees(&subject, &ValidationPlan::in_dimension(dimension(&subject)));
    }
}

#[test]
fn every_wave_and_branch_of_a_torus_is_compared() {
    let validation = scheme("yee-3d").validate(&ValidationPlan::in_dimension(3));
    // Of 120 waves those that are their own conjugates, (0 or 3, 0, 0 or 2), once, of the others one of two; six branches each.
    assert_eq!(validation.rows.len(), 6 * (120 + 4) / 2);
    let json = serde_json::to_value(&validation).unwrap();
    assert_eq!(json["cells"], serde_json::json!([6, 5, 4]));
    assert_eq!(json["rows"][6]["mode"], serde_json::json!([0, 0, 1]));
    assert_eq!(json["rows"][6]["phase"][2], std::f64::consts::FRAC_PI_2);
}

#[test]
fn a_billionth_of_any_coefficient_is_seen_on_a_torus() {
    let changes: usize = subjects().iter().map(sees_every_change).sum();
    assert!(changes > 200, "{changes}");
}

#[test]
fn exchanged_axes_are_seen() {
    for name in ["wave-2-2d", "yee-te-2d", "heat-crank-nicolson-2d"] {
        let exchanged = unequal(name, [ratio(3, 7), ratio(2, 7), ratio(1, 5)]);
        let (predicted, running) =
            (exchanged.predicted().unwrap(), scheme(name).running().unwrap());
        let validation = validate(&running, predicted, &ValidationPlan::in_dimension(2));
        assert!(!validation.unwrap().passed, "{name}");
    }
}

#[test]
fn runs_from_noise_confirm_the_limits_of_the_literature() {
    // With the same number along all axes. Lax–Wendroff's long waves grow slowly above its limit.
    for (name, most_steps) in [
        ("lax-wendroff-2d", 60_000),
        ("corner-transport-upwind-2d", 4000),
        ("wave-2-2d", 4000),
        ("yee-te-2d", 4000),
        ("yee-3d", 4000),
        ("heat-ftcs-3d", 4000),
    ] {
        let file = catalogue::scheme(name).unwrap();
        let limit = known_limit(file).unwrap();
        let grew = |part: f64| {
            let scheme = scheme_at(file, part * limit).unwrap();
            grows(&scheme, [&[16, 16][..], &[8, 8, 8]][scheme.dimension() - 2], most_steps)
        };
        assert_eq!([0.9, 1.1].map(grew), [false, true], "{name}");
    }
}

#[test]
fn a_torus_has_as_many_axes_as_the_equations() {
    let running = scheme("wave-2-2d").running().unwrap();
    let wrong = SteppingError::Dimension { dimension: 2, axes: 1 };
    assert_eq!(wrong.to_string(), "1 number of cells for 2 space dimensions: one for each");
    assert_eq!(running.torus(&[8]).err(), Some(wrong));
    assert_eq!(running.torus(&[8, 0]).err(), Some(SteppingError::NoCells));
    // The shortest wave along both axes has no next value.
    let text = "u[n+1,i,j] + A*(u[n+1,i+1,j] + u[n+1,i,j+1]) = u[n,i,j]";
    let singular = Subject::from_text("singular", text, &[("A", ratio(1, 2))]).running().unwrap();
    let error = singular.torus(&[4, 6]).unwrap_err();
    assert!(error.to_string().contains("torus of 4 × 6 cells"));
    assert!(singular.torus(&[5, 3]).is_ok());
}

/// Coefficients in sevenths at offsets up to 2 along two axes.
fn stencil() -> impl Strategy<Value = Vec<([i32; 2], i64)>> {
    prop::collection::vec(([-2i32..3, -2i32..3], -9i64..10), 1..6)
}

fn text_of(stencil: &[([i32; 2], i64)], unknown: &str, level: &str) -> String {
    let term = |([i, j], value): &([i32; 2], i64)| {
        format!(" + ({value})/7*{unknown}[{level},i{i:+},j{j:+}]")
    };
    stencil.iter().map(term).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Two unknowns, two or three levels, explicit or implicit.
    #[test]
    fn random_schemes_run_as_predicted(
        own in stencil(), across in stencil(), old in stencil(), implicit: bool,
    ) {
        let ahead = if implicit { "+ v[n+1,i+1,j]/5 - u[n+1,i,j-1]/9" } else { "" };
        let text = format!(
            "u[n+1,i,j] {ahead} = u[n,i,j]/2{}{}\nv[n+1,i,j] = v[n,i,j]{}{}",
            text_of(&own, "u", "n"), text_of(&across, "v", "n"), text_of(&old, "u", "n-1"), text_of(&across, "u", "n"),
        );
        let subject = Subject::from_text(&text, &text, &[]);
        let validation = subject.validate(&ValidationPlan { points: vec![5, 4], steps: 10 });
        prop_assert!(validation.passed, "{text}: {:?}", validation.failure);
    }
}
