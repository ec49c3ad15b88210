use super::*;
use crate::exact::rational::parse;

fn at(text: &str, values: &[(&str, &str)]) -> Multiplicity {
    let step = Step::from_text(text).unwrap();
    let set = values
        .iter()
        .fold(step, |step, (name, value)| step.with(name, &parse(value).unwrap()).unwrap());
    multiplicity_at(&set).unwrap()
}

const STAGGERED: &str = "v[n+1/2,j+1/2] = v[n-1/2,j+1/2] - C*(p[n,j+1] - p[n,j]); \
                         p[n+1,j] = p[n,j] - C*(v[n+1/2,j+1/2] - v[n+1/2,j-1/2])";

#[test]
fn the_drift_of_the_longest_wave_is_not_named() {
    let wave = "u[n+1,j] = 2*u[n,j] - u[n-1,j] + C^2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    assert_eq!(at(wave, &[("C", "1/2")]), Multiplicity::default());
    // At C = 1 the shortest wave has −1 twice.
    let edge = at(wave, &[("C", "1")]).growing.unwrap();
    assert_eq!((edge.multiplicity, edge.eigenvectors, edge.all_waves), (2, 1, true));
    assert_eq!(edge.wave.phases()[0], std::f64::consts::PI);
    assert!((edge.multiplier + 1.0).norm() < 1e-15);
}

/// Found by attack: 1 is the multiplier of both for every wave, and only the longest does not drive the other.
#[test]
fn a_drift_that_the_longest_wave_has_not_is_growth() {
    let driven = "u[n+1,j] = u[n,j]; v[n+1,j] = v[n,j] + C*(u[n,j] - u[n,j-1])";
    let found = at(driven, &[("C", "1/2")]);
    let growing = found.growing.unwrap();
    assert_eq!(
        (growing.wave.phases()[0], growing.multiplicity, found.drift),
        (std::f64::consts::PI, 2, None)
    );
    // Free particles drift as their equation says, the longest wave as well.
    let free = at("x[n+1,j] = x[n,j] + C*v[n,j]; v[n+1,j] = v[n,j]", &[("C", "1/2")]);
    assert!(free.growing.is_none() && free.drift.is_some());
    // For every wave, or only where two waves meet at one value.
    let every = |text: &str| {
        let step = Step::from_text(text).unwrap();
        let set = step.stable_set("C", &Default::default()).unwrap();
        step.multiple_on_every_wave("C", &set).unwrap().map(|found| found.wave.phases()[0])
    };
    let beside = format!("{driven}; w[n+1,j] = w[n,j] - C*(w[n,j] - w[n,j-1])");
    assert_eq!(every(&beside), Some(std::f64::consts::PI));
    assert_eq!(every("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])"), None);
    assert_eq!(every(STAGGERED), None);
}

#[test]
fn equal_multipliers_with_as_many_eigenvectors_do_no_harm() {
    // Two waves that do not know of one another.
    let twice =
        "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]); w[n+1,j] = w[n,j] - C*(w[n,j] - w[n,j-1])";
    assert_eq!(at(twice, &[("C", "1")]), Multiplicity::default());
    // The second one driven by the first: at C = 1 each wave is in resonance.
    let driven = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]); \
                  w[n+1,j] = w[n,j] - C*(w[n,j] - w[n,j-1]) + u[n,j]/10";
    let found = at(driven, &[("C", "1")]);
    let growing = found.growing.unwrap();
    assert_eq!((growing.multiplicity, growing.eigenvectors), (2, 1));
    // Below only the longest wave, whose multiplier is 1.
    assert_eq!(at(driven, &[("C", "1/2")]), Multiplicity::default());
    // At rest both pressure and velocity keep any value; at the limit they do not.
    assert_eq!(at(STAGGERED, &[("C", "1/2")]), Multiplicity::default());
    assert_eq!(
        at(STAGGERED, &[("C", "1")]).growing.unwrap().wave.phases()[0],
        std::f64::consts::PI
    );
}

#[test]
fn a_wave_that_nothing_pulls_back_drifts() {
    // Every second particle does not see its neighbours.
    let pairs = "u[n+1,j] = 2*u[n,j] - u[n-1,j] + C^2*(u[n,j+2] - 2*u[n,j] + u[n,j-2])";
    let found = at(pairs, &[("C", "1/2")]);
    assert_eq!(found.growing, None);
    assert_eq!(found.drift.unwrap().wave.phases()[0], std::f64::consts::PI);
}

#[test]
fn waves_that_meet_at_no_fraction_of_the_circle() {
    // Leapfrog at C sin φ (4 − cos φ)/3 = 1, its largest value: fourth order, C = 1/max.
    let text = "u[n+1,j] = u[n-1,j] - C*(-u[n,j+2] + 8*u[n,j+1] - 8*u[n,j-1] + u[n,j-2])/6";
    // Not the limit itself, which is no fraction: nothing meets below it, and above it two waves do.
    assert_eq!(at(text, &[("C", "0.7287")]).growing, None);
    let above = at(text, &[("C", "0.73")]).growing.unwrap();
    let s = (0.5 * above.wave.phases()[0]).sin().powi(2);
    let cosine = 1.0 - 2.0 * s;
    let value = 0.73 * above.wave.phases()[0].sin() * (4.0 - cosine) / 3.0;
    assert!((value - 1.0).abs() < 1e-12, "{value}");
}

/// Whether the end of the first stable interval is stable itself.
fn includes_its_limit(text: &str) -> bool {
    let limit = Step::from_text(text).unwrap().limit("C").unwrap();
    assert!(limit.is_positive() && limit.upper().is_finite(), "{limit:?}");
    limit.is_included()
}

#[test]
fn limits_are_included_where_eigenvectors_suffice() {
    assert!(includes_its_limit("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])"));
    assert!(!includes_its_limit("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])"));
    // Two levels, one multiplier that leaves through −1: Adams and Bashforth's rule for diffusion.
    assert!(includes_its_limit(
        "u[n+1,j] = u[n,j] + C*(3/2*(u[n,j+1] - 2*u[n,j] + u[n,j-1]) - 1/2*(u[n-1,j+1] - 2*u[n-1,j] + u[n-1,j-1]))"
    ));
    assert!(!includes_its_limit(STAGGERED));
    // Two schemes that do not know of one another have an eigenvector each: both reach the circle at C = 1 and −1.
    let twice =
        "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]); w[n+1,j] = w[n,j] - C*(w[n,j] - w[n,j-1])";
    assert!(includes_its_limit(twice));
    // One drives the other at C = 1 in resonance.
    let driven = format!("{twice} + u[n,j]/10");
    assert!(!includes_its_limit(&driven));
    // At no fraction: fourth order in space and leapfrog, ω Δt = 2.
    let fourth = "u[n+1,j] = 2*u[n,j] - u[n-1,j] \
                  + C^2/12*(-u[n,j+2] + 16*u[n,j+1] - 30*u[n,j] + 16*u[n,j-1] - u[n,j-2])";
    assert!(!includes_its_limit(fourth));
    // The same for two unknowns; and a force that every wave loses at √2, where particles drift, which is no growth.
    let pair = |force: &str, speed: &str| {
        format!("v[n+1,j] = v[n,j] + {force}; u[n+1,j] = u[n,j] + {speed}")
    };
    let force = "C/12*(-u[n,j+2] + 16*u[n,j+1] - 30*u[n,j] + 16*u[n,j-1] - u[n,j-2])";
    assert!(!includes_its_limit(&pair(force, "C*v[n+1,j]")));
    let force = "(2 - C^2)/4*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    let speed = "(v[n+1,j+1] + 2*v[n+1,j] + v[n+1,j-1])/4";
    assert!(includes_its_limit(&pair(force, speed)));
}

#[test]
fn waves_of_four_multipliers_are_all_looked_at_and_of_five_some() {
    // Two leapfrogs that do not know of one another, the faster one at its limit; then upwind beside them.
    let leapfrogs = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1]); \
                     w[n+1,j] = w[n-1,j] - C/2*(w[n,j+1] - w[n,j-1])";
    let found = at(leapfrogs, &[("C", "1")]).growing.unwrap();
    assert_eq!((found.wave.phases()[0], found.all_waves), (std::f64::consts::FRAC_PI_2, true));
    assert_eq!((found.multiplicity, found.eigenvectors), (2, 1));
    let fifth = format!("{leapfrogs}; v[n+1,j] = v[n,j] - C/4*(v[n,j] - v[n,j-1])");
    assert_eq!(at(&fifth, &[("C", "1")]).growing, None);
}

#[test]
fn zeros_of_what_is_not_exact_may_not_be_all() {
    // Every second particle does not see its neighbours; beside it upwind, with a number that is a fraction or not.
    let beside = |number: &str| {
        let text = format!(
            "u[n+1,j] = 2*u[n,j] - u[n-1,j] + C^2*(u[n,j+2] - 2*u[n,j] + u[n,j-2]); \
             w[n+1,j] = w[n,j] - C/{number}*(w[n,j] - w[n,j-1])"
        );
        at(&text, &[("C", "1/2")]).drift.unwrap()
    };
    assert_eq!([beside("3"), beside("pi")].map(|found| found.all_waves), [true, false]);
    assert_eq!(beside("pi").wave.phases()[0], std::f64::consts::PI);
}

#[test]
fn waves_that_meet_beside_or_within_others_are_found() {
    let quarter = std::f64::consts::FRAC_PI_2;
    // Two equal schemes that do no harm, and a leapfrog at its limit.
    let upwind =
        |name: &str| format!("{name}[n+1,j] = {name}[n,j] - C/2*({name}[n,j] - {name}[n,j-1])");
    let leapfrog = "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])";
    let found = at(&format!("{leapfrog}; {}; {}", upwind("v"), upwind("w")), &[("C", "1")]);
    assert_eq!(found.growing.unwrap().wave.phases(), [quarter]);
    // (z² − 2az + 1)(z² − 2bz + 1), a = 1 − C s and b = 1 − C (1 − s): pairs that are one at a quarter, at no real multiplier.
    let square = "(2*u[n-1,j] - u[n-1,j+2] - u[n-1,j-2])/16";
    let pairs = format!(
        "u[n+1,j] = 2*(2 - C)*u[n,j] - (6 - 4*C)*u[n-1,j] - 4*C^2*{square} + 2*(2 - C)*u[n-2,j] - u[n-3,j]"
    );
    let growing = at(&pairs, &[("C", "1/2")]).growing.unwrap();
    assert_eq!((growing.wave.phases(), growing.multiplicity), (&[quarter][..], 2));
    assert!((growing.multiplier.re - 0.75).abs() < 1e-12 && growing.all_waves);
    // A number in what drives a scheme is in no multiplier.
    let driven = format!("{}; {} + pi*v[n,j]", upwind("v"), upwind("w"));
    assert!(at(&driven, &[("C", "2")]).growing.unwrap().all_waves);
    // Five multipliers: the ends are looked at.
    let wave = "u[n+1,j] = 2*u[n,j] - u[n-1,j] + C^2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    let other = |name: &str, by: &str| upwind(name).replace("C/2", &format!("C/{by}"));
    let many = format!("{wave}; {}; {}; {}", upwind("v"), other("w", "3"), other("x", "5"));
    let found = at(&many, &[("C", "1")]).growing.unwrap();
    assert_eq!((found.wave.phases(), found.all_waves), (&[std::f64::consts::PI][..], false));
    // In two dimensions multiples of a quarter in all directions.
    let oblique =
        "u[n+1,i,j] = u[n-1,i,j] - C*(u[n,i+1,j] - u[n,i-1,j]) + C*(u[n,i,j+1] - u[n,i,j-1])";
    let found = at(oblique, &[("C", "1/2")]).growing.unwrap();
    assert!(!found.all_waves && found.wave.phases()[0] == -found.wave.phases()[1]);
}
