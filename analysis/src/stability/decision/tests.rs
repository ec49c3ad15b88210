use super::*;
use crate::exact::rational::{ratio, to_f64};
use crate::kernel::lattice::LatticeWeights;
use crate::scheme::KernelLattice;
use crate::scheme::catalogue::SchemeFile;
use crate::stability::{Evidence, multiplicity_at};

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

/// Whether somebody asked, and how often: the work that is done.
fn asked<T>(question: impl Fn(&SearchPlan) -> T) -> usize {
    use std::sync::atomic::{AtomicUsize, Ordering};
    let count = std::sync::Arc::new(AtomicUsize::new(0));
    let counter = count.clone();
    let interest = Interest::as_long_as(move || {
        counter.fetch_add(1, Ordering::Relaxed);
        true
    });
    question(&to_nine().while_wanted(interest));
    count.load(Ordering::Relaxed)
}

#[test]
fn a_limit_asks_for_the_first_stretch_alone() {
    // Upwind with 1 − (1 − C)(2 − C)/4 in place of C: stable up to 1 and from 2 to 3.5.
    let text = "u[n+1,j] = u[n,j] - (1 - (1 - C)*(2 - C)/4)*(u[n,j] - u[n,j-1])";
    let step = Step::from_text(text).unwrap();
    let whole = asked(|plan| step.stable_set("C", plan).unwrap());
    let first = asked(|plan| step.limit_by("C", plan).unwrap());
    let several = asked(|plan| step.limits_by("C", plan, &[integer(0)]).unwrap());
    assert!(first < whole && several == first, "{first} {several} {whole}");
}

#[test]
fn demands_that_nobody_wants_are_not_half_made() {
    let lost = to_nine().while_wanted(Interest::as_long_as(|| false));
    for text in [
        "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])",
        "u[n+1,i,j] = u[n-1,i,j] - C*(u[n,i,j+1] - u[n,i,j-1])",
    ] {
        let demands = Step::from_text(text).unwrap().inequalities_while("C", &lost);
        assert_eq!(demands.unwrap_err(), SchemeError::Cancelled);
    }
}

#[test]
fn what_is_stable_nowhere_is_so_in_any_dimension() {
    let line = "u[n+1,j] = u[n-3,j] + C*(u[n,j+1] + u[n,j-1])";
    for text in [line.to_string(), line.replace(",j", ",i,j")] {
        let set = Step::from_text(&text).unwrap().stable_set("C", &to_nine()).unwrap();
        assert!(set.intervals.is_empty() && set.undecided.is_empty(), "{set:?}");
        assert_eq!((set.limit().value(), set.limit().evidence()), (0.0, Evidence::Proved));
    }
}

#[test]
fn the_wave_that_grows_at_once_is_the_fastest() {
    let phase = |text: &str| {
        let set = Step::from_text(text).unwrap().stable_set("C", &to_nine()).unwrap();
        set.immediately_unstable.unwrap().phases()[0]
    };
    // sin² φ, and s with a factor of C that is small only as C is: one multiplier as C → 0, two where all is measured.
    let sine = "(2*u[n,j] - u[n,j+2] - u[n,j-2])/4";
    let haversine = "(2*u[n,j] - u[n,j+1] - u[n,j-1])/4";
    let one = format!("u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + 4096*C^3*{haversine}");
    let two = format!("u[n+1,j] = 2*u[n,j] - u[n-1,j] + C^2*({sine} + 4096*C*{haversine})");
    let (quarter, half) = (std::f64::consts::FRAC_PI_2, std::f64::consts::PI);
    assert!((phase(&one) - quarter).abs() < 1e-6 && (phase(&two) - half).abs() < 1e-6);
    // Between the samples: 8 sin φ − sin 2φ is largest where cos φ = 1 − √(3/2).
    let fourth = "u[n+1,j] = u[n,j] - C/12*(8*u[n,j+1] - 8*u[n,j-1] - u[n,j+2] + u[n,j-2])";
    assert!((phase(fourth) - (1.0 - 1.5f64.sqrt()).acos()).abs() < 1e-6);
    // At a sample, to the last digit.
    assert_eq!(phase("u[n+1,j] = u[n,j] - C*(u[n,j+1] - 2*u[n,j] + u[n,j-1])"), half);
}

#[test]
fn of_one_multiplier_its_square_is_the_condition_unless_there_are_roots() {
    let margin = |number: &str| {
        let text = format!("u[n+1,j] = u[n,j] - {number}*C*(u[n,j] - u[n,j-1])");
        Step::from_text(&text).unwrap().gain_margin("C", &integer(0)).unwrap()
    };
    assert!(margin("pi").is_some() && margin("sqrt(2)").is_none());
    let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])").unwrap();
    let Demands::All(all) = upwind.inequalities("C", &integer(0)).unwrap() else { panic!() };
    assert!(all.iter().all(|one| !one.on_circle && !one.whatever_the_step && !one.thinned));
}

#[test]
fn what_vanishes_for_the_weights_at_hand_is_looked_at_again() {
    // χ = z² − C(1 + E) z + E, whose multipliers lie on the circle up to C = 1: with weights for which D vanishes. For others one leaves the disc.
    let weights = LatticeWeights {
        gradient: vec![ratio(1, 2)],
        curvature: vec![integer(-2), integer(1)],
        radius: integer(0),
    };
    let lattice = KernelLattice::from_weights(integer(1), weights);
    let zero = |at: &str| {
        let pair = format!("u[{at},j+1] - u[{at},j-1]");
        format!("(({pair})/2 - sum(k, w[k]*(u[{at},j+k] - u[{at},j-k])))")
    };
    let (now, before) = (zero("n"), zero("n-1"));
    // The same with a name that is never multiplied out beside it.
    for factor in ["C", "pi*C"] {
        let text = format!(
            "name = \"two\"\ntitle = \"Two\"\nparameter = \"C\"\nsource = \"-\"\n\
             equations = \"u[n+1,j] = {factor}*(u[n,j] + u[n,j+1]) + 4*{now} - u[n-1,j+1] + {before}\""
        );
        let step = SchemeFile::from_toml(&text).unwrap().step(Some(&lattice), None, &[], Some("C"));
        let step = step.unwrap();
        assert!(step.names().letters().next().is_some());
        let (limit, scale) =
            (step.limit("C").unwrap(), if factor == "C" { 1.0 } else { std::f64::consts::PI });
        assert!((limit.value() * scale - 1.0).abs() < 1e-12, "{limit:?}");
    }
}

#[test]
fn numbers_cancel_exactly_or_make_no_scheme_unstable() {
    // Leapfrog and a term that drives it out of the circle, unless its coefficient is 0.
    let limit = |number: &str| {
        let text = format!("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1]) + ({number})*u[n,j]");
        Step::from_text(&text).unwrap().limit("C").unwrap()
    };
    for zero in [
        "sqrt(8) - 2*sqrt(2)",
        "sqrt(2)*sqrt(3) - sqrt(6)",
        "sqrt(6) - sqrt(2)*sqrt(3)",
        "sqrt(2/3) - sqrt(6)/3",
        "1/sqrt(2) - sqrt(2)/2",
        "1/(sqrt(3) - sqrt(2)) - sqrt(3) - sqrt(2)",
        "sqrt(2)^4 - 4",
    ] {
        let exact = limit(zero).exact().and_then(|exact| exact.as_fraction().cloned());
        assert_eq!(exact, Some(integer(1)), "{zero}");
    }
    let open = limit("pi*(1/pi) - 1");
    assert_eq!((open.lower(), open.evidence()), (0.0, Evidence::Undecided));
    for other in ["sqrt(8) - 2", "sqrt(2)*sqrt(3) - sqrt(5)", "1/sqrt(2) - sqrt(3)/2", "pi - 3"] {
        let never = limit(other);
        assert_eq!((never.upper(), never.evidence()), (0.0, Evidence::Proved), "{other}");
    }
}

#[test]
fn a_budget_for_growth_has_room_for_powers_of_the_number_of_steps() {
    // A shift drives a shift, whatever C is; beside them upwind, with |1 − 2C| = 1 + ε.
    let text = "r[n+1,j] = r[n,j-1]; q[n+1,j] = q[n,j-1] + r[n,j]; \
                u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])";
    let step = Step::from_text(text).unwrap();
    for (growth, value) in [(integer(0), 1.0), (ratio(1, 10), 1.05)] {
        let limit = step.limit_by("C", &to_nine().growing(growth.clone())).unwrap();
        assert_eq!((limit.value(), limit.is_included()), (value, growth.is_positive()));
    }
}
