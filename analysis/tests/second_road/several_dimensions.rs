//! Limits in two and three dimensions, with their waves and the work they take.

use courant_analysis::exact::rational::{from_f64, integer, ratio};
use courant_analysis::scheme::{Step, catalogue};
use courant_analysis::stability::{Cause, Evidence, SearchPlan, StableSet};
use std::f64::consts::PI;

fn set_of(name: &str, settings: &[(&str, &str)]) -> StableSet {
    let file = catalogue::scheme(name).unwrap();
    let parameter = file.parameter.as_deref().unwrap();
    let settings: Vec<_> = settings
        .iter()
        .map(|(name, value)| {
            (name.to_string(), courant_analysis::exact::rational::parse(value).unwrap())
        })
        .collect();
    let step = file.step(None, None, &settings, Some(parameter)).unwrap();
    step.stable_set(parameter, &SearchPlan::default()).unwrap()
}

#[test]
fn the_wave_that_binds_is_named() {
    let wave = |name: &str| set_of(name, &[]).limit().critical_wave().unwrap().clone();
    // Unsplit Lax–Wendroff: long waves along the diagonal.
    let long = wave("lax-wendroff-2d");
    assert_eq!(long.phases(), [0.0, 0.0]);
    assert!(long.direction().iter().all(|x| (x - 0.5f64.sqrt()).abs() < 1e-6));
    // The wave equation: the checkerboard.
    assert_eq!(wave("wave-2-2d").phases(), [PI, PI]);
    assert_eq!(set_of("wave-2-2d", &[]).limit().cause(), Some(Cause::ShortestWave));
    // Leapfrog: four cells along each axis.
    let leapfrog = wave("leapfrog-2d");
    assert!(leapfrog.phases().iter().all(|phase| (phase - 0.5 * PI).abs() < 1e-9));
    // The 19-point stencil in space: two cells along two axes, constant along the third.
    let mut plane = wave("heat-19-point-3d").phases().to_vec();
    plane.sort_by(f64::total_cmp);
    assert_eq!(plane, [0.0, PI, PI]);
}

#[test]
fn unequal_courant_numbers_of_unsplit_lax_wendroff() {
    // C_x^{2/3} + C_y^{2/3} <= 1 (Lax & Wendroff 1964 have it for equal ones; by Hoelder's inequality on long waves).
    for (a, exact) in [("8", 1.0 / 125f64.sqrt()), ("1/8", (4f64 / 5.0).powf(1.5)), ("3", f64::NAN)]
    {
        let limit = set_of("lax-wendroff-2d", &[("a", a)]).limit();
        let ratio = courant_analysis::exact::rational::to_f64(
            &courant_analysis::exact::rational::parse(a).unwrap(),
        );
        let expected = (1.0 + ratio.powf(2.0 / 3.0)).powf(-1.5);
        assert!(exact.is_nan() || (exact - expected).abs() < 1e-15);
        assert_eq!(limit.evidence(), Evidence::Proved);
        // The enclosure is 2^-52 wide; the expected value is rounded.
        assert!(
            limit.lower() <= expected * (1.0 + 1e-14) && expected * (1.0 - 1e-14) <= limit.upper()
        );
        assert!(limit.upper() - limit.lower() < 1e-12 * expected, "{a}: {limit:?}");
    }
}

#[test]
fn limits_cost_few_boxes() {
    // Counted, with room for rounding of the guesses: a slow search fails here.
    for (name, boxes) in [
        ("lax-wendroff-2d", 32),
        ("donor-cell-3d", 150),
        ("yee-3d", 16),
        ("heat-27-point-3d", 8),
        ("fromm-corner-2d", 150),
        ("corner-transport-upwind-3d", 150),
    ] {
        let work = set_of(name, &[]).work;
        assert!(work.boxes <= boxes, "{name}: {work:?}");
    }
}

#[test]
fn a_limit_that_floating_point_sees_in_the_fourth_digit_only() {
    // |g| - 1 is 1e-13 here for waves of a thousand cells: sampling calls it stable.
    let lax_wendroff = catalogue::scheme("lax-wendroff-2d").unwrap();
    let step = lax_wendroff.step(None, None, &[], Some("C")).unwrap();
    let at = |value| step.with("C", &value).unwrap();
    let decide =
        |value| courant_analysis::stability::decide_step_at(&at(value), &ratio(0, 1)).unwrap();
    use courant_analysis::stability::PointVerdict::{Stable, Unstable};
    assert_eq!(decide(ratio(353_553_390_593, 1_000_000_000_000)), Stable);
    assert!(matches!(decide(ratio(353_553_390_594, 1_000_000_000_000)), Unstable(_)));
}

/// `g(π, 0) = 1 − 4C`: `|g| ≤ 1 + ε` up to `C = 1/2 + ε/4`.
#[test]
fn a_small_budget_for_growth_has_its_exact_limit_and_wave() {
    let step = Step::from_text(
        "u[n+1,i,j] = u[n,i,j] - C*(u[n,i,j] - u[n,i-1,j]) - C*(u[n,i,j] - u[n,i-1,j-1])",
    )
    .unwrap();
    for power in [3, 8, 9] {
        let growth = ratio(1, 10_i64.pow(power));
        let plan = SearchPlan::default().growing(growth.clone());
        let limit = step.stable_set("C", &plan).unwrap().limit();
        let exact = ratio(1, 2) + growth / ratio(4, 1);
        assert_eq!(limit.exact().and_then(|value| value.as_fraction().cloned()), Some(exact));
        assert_eq!(limit.critical_wave().unwrap().phases(), [PI, 0.0]);
    }
}

/// Fields that travel twice have double multipliers, which are asked about once. `z² − 2 b z + 1` with `b = 1 − 6 C²` at `(π, π, π)`: at
/// `z = −r` with `r = 1 + ε` it is `6 C² = 1 + (r + 1/r)/2`.
#[test]
fn maxwell_s_equations_in_three_dimensions_have_their_budget_for_growth() {
    let file = catalogue::scheme("yee-3d").unwrap();
    let parameter = file.parameter.as_deref().unwrap();
    let step = file.step(None, None, &[], Some(parameter)).unwrap();
    for power in [3, 6] {
        let growth = ratio(1, 10_i64.pow(power));
        let limit = step.limit_by(parameter, &SearchPlan::default().growing(growth.clone()));
        let limit = limit.unwrap();
        let radius = integer(1) + growth;
        let square = (integer(1) + (&radius + radius.recip()) / integer(2)) / integer(6);
        let ends = [limit.lower(), limit.upper()];
        let [low, high] = ends.map(|end| from_f64(end).unwrap());
        assert!(&low * &low <= square && square <= &high * &high);
        assert!(ends[1] - ends[0] < 1e-15, "{ends:?}");
    }
}

#[test]
fn budgets_for_growth_and_windows() {
    let donor = "u[n+1,i,j] = u[n,i,j] - C*(u[n,i,j] - u[n,i-1,j]) - C*(u[n,i,j] - u[n,i,j-1])";
    let step = Step::from_text(donor).unwrap();
    // g(pi, pi) = 1 - 4C: |g| <= 1 + e up to C = 1/2 + e/4.
    for (power, exact) in [(1, "21/40"), (5, "200001/400000"), (6, "2000001/4000000")] {
        let plan = SearchPlan::default().growing(ratio(1, 10_i64.pow(power)));
        let limit = step.stable_set("C", &plan).unwrap().limit();
        assert_eq!(limit.exact().unwrap().to_string(), exact);
    }
    // Downwind in space, implicit in time, one axis after the other: the window [1, oo).
    let downwind = "(1 - C)^2*u[n+1,i,j] + C*(1 - C)*(u[n+1,i+1,j] + u[n+1,i,j+1]) + C^2*u[n+1,i+1,j+1] = u[n,i,j]";
    let set = Step::from_text(downwind).unwrap().stable_set("C", &SearchPlan::default()).unwrap();
    assert_eq!(set.intervals.len(), 1, "{set:?}");
    assert_eq!(set.intervals[0].from.value(), 1.0);
    assert!(set.intervals[0].to.is_unbounded());
}

/// Two Beam–Warming steps, one after the other, with Courant numbers `a C` and `b C`.
fn beam_warming_product(a: &str, b: &str) -> Step {
    let weights = |c: &str| {
        [
            format!("(1 - ({c}))*(2 - ({c}))/2"),
            format!("({c})*(2 - ({c}))"),
            format!("({c})*(({c}) - 1)/2"),
        ]
    };
    let (x, y) = (weights(&format!("{a}*C")), weights(&format!("{b}*C")));
    let mut text = "u[n+1,i,j] = 0*u[n,i,j]".to_string();
    for (i, x) in x.iter().enumerate() {
        for (j, y) in y.iter().enumerate() {
            text += &format!(" + {x}*{y}*u[n,i-{i},j-{j}]");
        }
    }
    Step::from_text(&text).unwrap()
}

#[test]
fn a_wave_that_touches_ends_nothing() {
    // Each factor touches |g| = 1 for all its waves at Courant number 1 and is stable to 2.
    let plan = SearchPlan::default().up_to(ratio(8, 1));
    let set = beam_warming_product("13/17", "10/17").stable_set("C", &plan).unwrap();
    let limit = set.limit();
    let touching = 17.0 / 13.0;
    // Either the limit is found, or it says that it is not: never the touching value, proved.
    let found = limit.evidence() == Evidence::Proved;
    assert!(!found || (limit.value() - 34.0 / 13.0).abs() < 1e-9, "{set:?}");
    assert!(found || limit.lower() >= 0.9 * touching, "{set:?}");
    assert!(found || !set.undecided.is_empty());
}

#[test]
fn directions_that_no_halving_meets() {
    // Long waves along (1 : 3) bind at a fraction: enclosed, though no cube has them at a corner.
    for a in ["27", "1/27", "125"] {
        let limit = set_of("lax-wendroff-2d", &[("a", a)]).limit();
        let a = courant_analysis::exact::rational::to_f64(
            &courant_analysis::exact::rational::parse(a).unwrap(),
        );
        let expected = (1.0 + a.powf(2.0 / 3.0)).powf(-1.5);
        assert_eq!(limit.evidence(), Evidence::Proved, "{a}: {limit:?}");
        assert!((limit.value() / expected - 1.0).abs() < 1e-9, "{a}: {limit:?}");
        assert!(limit.upper() / limit.lower() - 1.0 < 1e-9, "{a}: {limit:?}");
    }
}

#[test]
fn zeros_on_edges_that_meet_are_taken_apart() {
    // u_t = δ_y² u − δ_x² δ_z² u: the condition has the factor s_y + 4 s_x s_z, which vanishes on two edges of the cube.
    let d = |f: &str| {
        let [i, j, k] = if f == "x" { ["i+1", "i", "i-1"] } else { ["k+1", "k", "k-1"] };
        [i, j, k]
    };
    let (x, z) = (d("x"), d("z"));
    let mut mixed = String::new();
    for (p, i) in [1, -2, 1].iter().zip(x) {
        for (q, k) in [1, -2, 1].iter().zip(z) {
            mixed += &format!(" + ({})*u[n,{i},j,{k}]", p * q);
        }
    }
    let text = format!(
        "u[n+1,i,j,k] = u[n,i,j,k] + C*(u[n,i,j+1,k] - 2*u[n,i,j,k] + u[n,i,j-1,k] - (0{mixed}))"
    );
    let set = Step::from_text(&text).unwrap().stable_set("C", &SearchPlan::default()).unwrap();
    // 1 − 4C (s_y + 4 s_x s_z) ≥ −1: C ≤ 1/10.
    assert_eq!(set.limit().exact().unwrap().to_string(), "1/10", "{set:?}");
}
