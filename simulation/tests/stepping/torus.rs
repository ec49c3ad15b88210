//! The same in two and three dimensions, on tori of which no two axes are alike.

use super::noise::grows;
use super::subject::{Subject, agrees, sees_every_change};
use courant_analysis::exact::rational::ratio;
use courant_analysis::scheme::Integrator;
use courant_simulation::stepping::{SteppingError, TorusScheme, ValidationPlan};
use proptest::prelude::*;

/// With a Courant number along each axis, so that an exchange of axes is seen. Lax & Wendroff 1964.
const LAX_WENDROFF: &str =
    "u[n+1,i,j] = u[n,i,j] - A/2*(u[n,i+1,j] - u[n,i-1,j]) - B/2*(u[n,i,j+1] - u[n,i,j-1]) +
    A^2/2*(u[n,i+1,j] - 2*u[n,i,j] + u[n,i-1,j]) + B^2/2*(u[n,i,j+1] - 2*u[n,i,j] + u[n,i,j-1]) +
    A*B/4*(u[n,i+1,j+1] - u[n,i+1,j-1] - u[n,i-1,j+1] + u[n,i-1,j-1])";

/// Colella 1990.
const CORNER_TRANSPORT: &str = "u[n+1,i,j] = (1 - A)*(1 - B)*u[n,i,j] + A*(1 - B)*u[n,i-1,j] + (1 - A)*B*u[n,i,j-1] + A*B*u[n,i-1,j-1]";

/// The corner fluxes as a code has them: a half step across, then the difference of fluxes.
const CORNER_TRANSPORT_BY_FLUXES: &str = "p[n,i,j] = u[n,i,j] - B/2*(u[n,i,j] - u[n,i,j-1])
    q[n,i,j] = u[n,i,j] - A/2*(u[n,i,j] - u[n,i-1,j])
    u[n+1,i,j] = u[n,i,j] - A*(p[n,i,j] - p[n,i-1,j]) - B*(q[n,i,j] - q[n,i,j-1])";

const WAVE: &str = "u[n+1,i,j] = 2*u[n,i,j] - u[n-1,i,j] + A^2*(u[n,i+1,j] - 2*u[n,i,j] + u[n,i-1,j]) + B^2*(u[n,i,j+1] - 2*u[n,i,j] + u[n,i,j-1])";

/// Yee 1966, transverse electric: `H_z` at the middles of the cells.
const YEE_2D: &str = "h[n+1/2,i+1/2,j+1/2] = h[n-1/2,i+1/2,j+1/2] + B*(p[n,i+1/2,j+1] - p[n,i+1/2,j]) - A*(q[n,i+1,j+1/2] - q[n,i,j+1/2])
    p[n+1,i+1/2,j] = p[n,i+1/2,j] + B*(h[n+1/2,i+1/2,j+1/2] - h[n+1/2,i+1/2,j-1/2])
    q[n+1,i,j+1/2] = q[n,i,j+1/2] - A*(h[n+1/2,i+1/2,j+1/2] - h[n+1/2,i-1/2,j+1/2])";

/// Yee 1966: `E` on the edges, `H` on the faces.
const YEE_3D: &str = "X[n+1/2,i,j+1/2,k+1/2] = X[n-1/2,i,j+1/2,k+1/2] + C*(V[n,i,j+1/2,k+1] - V[n,i,j+1/2,k]) - B*(W[n,i,j+1,k+1/2] - W[n,i,j,k+1/2])
    Y[n+1/2,i+1/2,j,k+1/2] = Y[n-1/2,i+1/2,j,k+1/2] + A*(W[n,i+1,j,k+1/2] - W[n,i,j,k+1/2]) - C*(U[n,i+1/2,j,k+1] - U[n,i+1/2,j,k])
    Z[n+1/2,i+1/2,j+1/2,k] = Z[n-1/2,i+1/2,j+1/2,k] + B*(U[n,i+1/2,j+1,k] - U[n,i+1/2,j,k]) - A*(V[n,i+1,j+1/2,k] - V[n,i,j+1/2,k])
    U[n+1,i+1/2,j,k] = U[n,i+1/2,j,k] + B*(Z[n+1/2,i+1/2,j+1/2,k] - Z[n+1/2,i+1/2,j-1/2,k]) - C*(Y[n+1/2,i+1/2,j,k+1/2] - Y[n+1/2,i+1/2,j,k-1/2])
    V[n+1,i,j+1/2,k] = V[n,i,j+1/2,k] + C*(X[n+1/2,i,j+1/2,k+1/2] - X[n+1/2,i,j+1/2,k-1/2]) - A*(Z[n+1/2,i+1/2,j+1/2,k] - Z[n+1/2,i-1/2,j+1/2,k])
    W[n+1,i,j,k+1/2] = W[n,i,j,k+1/2] + A*(Y[n+1/2,i+1/2,j,k+1/2] - Y[n+1/2,i-1/2,j,k+1/2]) - B*(X[n+1/2,i,j+1/2,k+1/2] - X[n+1/2,i,j-1/2,k+1/2])";

/// Peaceman & Rachford 1955: implicit along one axis, then along the other.
const PEACEMAN_RACHFORD: &str = "v[n+1/2,i,j] - A/2*(v[n+1/2,i+1,j] - 2*v[n+1/2,i,j] + v[n+1/2,i-1,j]) = u[n,i,j] + B/2*(u[n,i,j+1] - 2*u[n,i,j] + u[n,i,j-1])
    u[n+1,i,j] - B/2*(u[n+1,i,j+1] - 2*u[n+1,i,j] + u[n+1,i,j-1]) = v[n+1/2,i,j] + A/2*(v[n+1/2,i+1,j] - 2*v[n+1/2,i,j] + v[n+1/2,i-1,j])";

const CRANK_NICOLSON: &str = "u[n+1,i,j] - A/2*(u[n+1,i+1,j] - 2*u[n+1,i,j] + u[n+1,i-1,j]) - B/2*(u[n+1,i,j+1] - 2*u[n+1,i,j] + u[n+1,i,j-1]) =
    u[n,i,j] + A/2*(u[n,i+1,j] - 2*u[n,i,j] + u[n,i-1,j]) + B/2*(u[n,i,j+1] - 2*u[n,i,j] + u[n,i,j-1])";

const HEAT_3D: &str = "u[n+1,i,j,k] = u[n,i,j,k] + A*(u[n,i+1,j,k] - 2*u[n,i,j,k] + u[n,i-1,j,k]) + B*(u[n,i,j+1,k] - 2*u[n,i,j,k] + u[n,i,j-1,k]) +
    C*(u[n,i,j,k+1] - 2*u[n,i,j,k] + u[n,i,j,k-1])";

/// Third-order upwind along one axis, centred along the other: to be completed by an integrator.
const LINES: &str =
    "u[i,j]' = -A/6*(2*u[i+1,j] + 3*u[i,j] - 6*u[i-1,j] + u[i-2,j]) - B/2*(u[i,j+1] - u[i,j-1])";

fn subject(name: &str, text: &str) -> Subject {
    let all = [("A", ratio(2, 7)), ("B", ratio(3, 7)), ("C", ratio(1, 5))];
    let used: Vec<_> = all.into_iter().filter(|(name, _)| text.contains(*name)).collect();
    Subject::from_text(name, text, &used)
}

fn subjects() -> Vec<Subject> {
    let all = [
        ("lax-wendroff", LAX_WENDROFF),
        ("corner-transport", CORNER_TRANSPORT),
        ("corner-transport-by-fluxes", CORNER_TRANSPORT_BY_FLUXES),
        ("wave", WAVE),
        ("yee-2d", YEE_2D),
        ("yee-3d", YEE_3D),
        ("peaceman-rachford", PEACEMAN_RACHFORD),
        ("crank-nicolson", CRANK_NICOLSON),
        ("heat-3d", HEAT_3D),
    ];
    let lines = ["rk3-ssp", "ab3", "gauss-2"].map(|integrator| {
        subject("lines", LINES).with_integrator(Integrator::named(integrator).unwrap())
    });
    all.into_iter().map(|(name, text)| subject(name, text)).chain(lines).collect()
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
    let validation = subject("yee-3d", YEE_3D).validate(&ValidationPlan::in_dimension(3));
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
    for (name, text) in [("wave", WAVE), ("yee-2d", YEE_2D), ("crank-nicolson", CRANK_NICOLSON)] {
        let right = subject(name, text);
        let exchanged = text.replace('A', "a").replace('B', "A").replace('a', "B");
        let plan = ValidationPlan::in_dimension(2);
        let predicted = subject(name, &exchanged).predicted().unwrap();
        let running = right.running().unwrap();
        let validation = courant_simulation::stepping::validate(&running, predicted, &plan);
        assert!(!validation.unwrap().passed, "{name}");
    }
}

#[test]
fn runs_from_noise_confirm_the_limits_of_the_literature() {
    // With the same number along all axes: Strang 1968 for the corner terms; the Courant conditions of the others.
    let all = [
        (LAX_WENDROFF, f64::sqrt(1.0 / 8.0), 2),
        (CORNER_TRANSPORT, 1.0, 2),
        (WAVE, f64::sqrt(0.5), 2),
        (YEE_2D, f64::sqrt(0.5), 2),
        (YEE_3D, f64::sqrt(1.0 / 3.0), 3),
        (HEAT_3D, 1.0 / 6.0, 3),
    ];
    for (text, limit, dimension) in all {
        let equations = courant_analysis::scheme::language::parse(text).unwrap();
        // Lax–Wendroff's long waves grow slowly above its limit.
        let most_steps = if text == LAX_WENDROFF { 60_000 } else { 4000 };
        let points = [&[16, 16][..], &[8, 8, 8]][dimension - 2];
        let grew = |part: f64| {
            let values: Vec<_> =
                ["A", "B", "C"].iter().map(|name| (name.to_string(), part * limit)).collect();
            let scheme = TorusScheme::new(&equations, None, None, &values).unwrap();
            grows(&scheme, points, most_steps)
        };
        assert_eq!([0.9, 1.1].map(grew), [false, true], "{text}");
    }
}

#[test]
fn a_torus_has_as_many_axes_as_the_equations() {
    let running = subject("wave", WAVE).running().unwrap();
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
