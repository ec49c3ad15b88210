//! Proved limits of particle methods against values known from elsewhere.

use courant_analysis::exact::rational::{Rational, integer, ratio};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{Integrator, KernelLattice, Step, catalogue};
use courant_analysis::stability::{Evidence, Limit, SearchPlan, StableSet};

fn step(method: &str, integrator: &str, h: &Rational, values: &[(&str, Rational)]) -> Step {
    let lattice = KernelLattice::new(Kernel::CubicSpline, h).unwrap();
    let values: Vec<_> = values.iter().map(|(name, v)| (name.to_string(), v.clone())).collect();
    let integrator = Integrator::for_particles(integrator).expect("it is in the list");
    let method = catalogue::method(method).expect("it is in the list");
    method.step(Some(&lattice), Some(integrator), &values, Some("C")).unwrap()
}

fn set(method: &str, integrator: &str, h: &Rational, values: &[(&str, Rational)]) -> StableSet {
    let plan = SearchPlan::default().up_to(integer(4));
    step(method, integrator, h, values).stable_set("C", &plan).unwrap()
}

fn limit(method: &str, integrator: &str, h: &Rational, values: &[(&str, Rational)]) -> Limit {
    set(method, integrator, h, values).limit()
}

fn bound_by(limit: &Limit) -> String {
    limit.binding().expect("a limit was met").name()
}

#[test]
fn the_leapfrog_needs_the_fastest_wave_to_turn_by_less_than_two() {
    // h = Δ: only nearest neighbours, ω0² = 4(1 − cos φ) − sin²φ ≤ 8.
    let nearest = limit("sph", "leapfrog", &integer(1), &[]);
    assert_eq!(nearest.exact().unwrap().to_string(), "sqrt(1/2)");
    assert_eq!((bound_by(&nearest).as_str(), nearest.is_included()), ("minus-one", false));
    // h = 1.2 Δ, P over ρc²: isothermal, γ = 1.4, and a liquid at P = 0.
    for (pressure, known) in [(integer(1), 1.0632), (ratio(5, 7), 1.2207), (integer(0), 1.8946)] {
        let found = limit("sph", "kdk", &ratio(6, 5), &[("P", pressure)]);
        assert!((found.value() - known).abs() < 1e-4, "{} {known}", found.value());
        assert_eq!(found.evidence(), Evidence::Proved);
    }
}

#[test]
fn particles_that_do_not_touch_have_no_limit() {
    for method in ["sph", "sph-av", "gph"] {
        for integrator in ["forward-euler", "centred-euler", "rk2-midpoint", "rk2-heun", "rk4"] {
            let free = limit(method, integrator, &ratio(1, 3), &[]);
            assert!(free.is_unbounded() && free.evidence() == Evidence::Proved, "{integrator}");
        }
    }
}

#[test]
fn predictor_and_corrector_are_three_methods() {
    let h = ratio(6, 5);
    for (integrator, positive) in
        [("rk2-midpoint", false), ("predictor-corrector-pec", false), ("predictor-corrector", true)]
    {
        assert_eq!(limit("sph", integrator, &h, &[]).is_positive(), positive, "{integrator}");
    }
    // The roots of z² − (1 + 3λ/2) z + λ/2 over 20001 waves, bisected in NumPy.
    let viscous = limit("sph-av", "pec", &h, &[]);
    assert!((viscous.value() - 0.491_313_997).abs() < 1e-8, "{}", viscous.value());
}

#[test]
fn a_lattice_under_tension_is_unstable_whatever_the_step() {
    let tension = [("P", ratio(-1, 10))];
    for integrator in ["leapfrog-kdk", "rk3-ssp"] {
        let torn = limit("sph", integrator, &integer(1), &tension);
        assert_eq!((torn.value(), bound_by(&torn).as_str()), (0.0, "lattice"));
    }
    // The quartic spline at h = 3 Δ: pairing. Where one condition alone decides nothing another excludes the step.
    let lattice = KernelLattice::new(Kernel::QuarticSpline, &integer(3)).unwrap();
    let method = catalogue::method("sph-av").unwrap();
    let heun = Integrator::named("heun");
    let paired = method.step(Some(&lattice), heun, &[], Some("C")).unwrap();
    let set = paired.stable_set("C", &SearchPlan::default().up_to(integer(4))).unwrap();
    assert!(set.undecided.is_empty() && bound_by(&set.limit()) == "lattice");
}

#[test]
fn of_conditions_that_fail_together_a_real_multiplier_is_named() {
    // At κΔ = π and h = 2 Δ nothing restores: one multiplier is 1, the other 1 + g + g²/2, back at 1 where C = 3/4.
    let found = limit("sph-av", "heun", &integer(2), &[]);
    assert_eq!(found.exact().unwrap().to_string(), "3/4");
    assert_eq!(bound_by(&found), "plus-one");
}

#[test]
fn known_integrators_of_gph() {
    for (integrator, h, known, condition) in [
        ("rk4", integer(1), 0.976_061_495_648_422_9, "oscillation"),
        ("rk3-ssp", ratio(6, 5), 1.341_391_069_717_344_3, "oscillation"),
    ] {
        let found = limit("gph", integrator, &h, &[]);
        assert!((found.value() / known - 1.0).abs() < 1e-12);
        assert_eq!(bound_by(&found), condition);
    }
}

/// Where one condition begins to hold another is long broken: there is no window, not even of a point.
#[test]
fn conditions_that_hold_in_turn_leave_no_window() {
    let set = set("sph-av", "rk4", &ratio(6, 5), &[("alpha", integer(2))]);
    assert_eq!(set.intervals.len(), 1);
    assert!(set.undecided.is_empty() && (set.limit().value() - 0.663_400_774_3).abs() < 1e-9);
    // At c Δt/h = 6.67 two conjugate multipliers pass through 1: one condition touches zero at a single point, which halving does not
    // decide. It may not cost without end, since another condition has long excluded it.
    assert!(set.work.boxes < 60_000, "{:?}", set.work);
}
