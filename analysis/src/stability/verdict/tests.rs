use super::*;
use crate::exact::rational::{parse, ratio};
use crate::kernel::Kernel;
use crate::scheme::{Integrator, KernelLattice, catalogue};

/// A particle method or a scheme of the catalogue, all set but `C`.
fn subject(name: &str, integrator: &str, kernel: Kernel, h: Rational) -> Step {
    let lattice = KernelLattice::new(kernel, &h).unwrap();
    let (file, integrator) = match catalogue::method(name) {
        Some(method) => (method, Integrator::for_particles(integrator)),
        None => (catalogue::scheme(name).unwrap(), None),
    };
    file.step(Some(&lattice), integrator, &[], Some("C")).unwrap()
}

fn judge(step: &Step, value: &str) -> Check {
    check(step, "C", &parse(value).unwrap(), &SearchPlan::default().up_to(integer(10))).unwrap()
}

fn text(equations: &str, value: &str) -> Check {
    judge(&Step::from_text(equations).unwrap(), value)
}

const UPWIND: &str = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])";
const DOWNWIND: &str = "u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]";
const CRANK_NICOLSON: &str =
    "u[n+1,j] + C/4*(u[n+1,j+1] - u[n+1,j-1]) = u[n,j] - C/4*(u[n,j+1] - u[n,j-1])";

#[test]
fn the_limit_itself_is_marginal_and_a_hair_above_is_unstable() {
    let shift = text(UPWIND, "1");
    assert_eq!((shift.verdict, shift.monotone), (Verdict::Marginal, Some(true)));
    assert_eq!((shift.growth.per_step, shift.steps_to_double), (0.0, None));
    // With 1 − (1 − C)²/4 in place of C an exact shift too, and no limit.
    let inside = "u[n+1,j] = u[n,j] - (1 - (1 - C)^2/4)*(u[n,j] - u[n,j-1])";
    assert_eq!(text(inside, "1").verdict, Verdict::Stable);
    let godunov = subject("godunov-sph", "", Kernel::CubicSpline, integer(2));
    assert_eq!(judge(&godunov, "15/8").verdict, Verdict::Marginal);
    assert_eq!(judge(&godunov, "1.8").verdict, Verdict::Stable);
    for above in ["1.875001", "1.875000000000000000000000000001"] {
        let found = judge(&godunov, above);
        assert_eq!(found.verdict, Verdict::WeaklyUnstable);
        assert!(found.growth.per_step > 0.0 && found.steps_to_double.unwrap().is_finite());
    }
}

#[test]
fn monotone_exactly_up_to_the_limit() {
    let godunov = subject("godunov-sph", "", Kernel::CubicSpline, integer(2));
    assert_eq!(judge(&godunov, "8/5").monotone, Some(true));
    assert_eq!(judge(&godunov, "1.600000000000000000001").monotone, Some(false));
    // All monotone values, not only those from 0.
    let lax_wendroff = subject("lax-wendroff-sph", "", Kernel::WendlandC4, ratio(3, 5));
    let found = judge(&lax_wendroff, "0.2");
    assert_eq!((found.monotone, judge(&lax_wendroff, "0.1").monotone), (Some(true), Some(false)));
    assert_eq!(found.monotone_set.unwrap().intervals.len(), 1);
    assert_eq!(text(CRANK_NICOLSON, "1").monotone, None);
}

#[test]
fn steps_to_double_double() {
    let found = judge(&subject("godunov-sph", "", Kernel::Gaussian, integer(1)), "1.2");
    assert_eq!((found.verdict, found.monotone), (Verdict::Unstable, Some(false)));
    let steps = found.steps_to_double.unwrap();
    assert!(((1.0 + found.growth.per_step).powf(steps) - 2.0).abs() < 1e-12);
    let cut = judge(&subject("lax-wendroff-sph", "", Kernel::Gaussian, integer(3)), "2");
    assert_eq!(cut.verdict, Verdict::WeaklyUnstable);
    assert!(cut.growth.per_step > 0.0 && cut.growth.per_step < 1e-4);
}

#[test]
fn narrow_bands_of_growing_waves_are_not_marginal() {
    let found = judge(&subject("sph", "leapfrog-kdk", Kernel::CubicSpline, ratio(3, 2)), "1.1866");
    assert_eq!((found.verdict, found.steps_to_double.unwrap().round()), (Verdict::Unstable, 54.0));
    let wide = judge(&subject("sph", "leapfrog-kdk", Kernel::WendlandC2, integer(4)), "1.1637");
    assert_eq!(wide.verdict, Verdict::Unstable);
}

#[test]
fn particles_that_do_not_touch_are_stable() {
    for integrator in ["forward-euler", "centred-euler", "rk2-midpoint", "rk2-heun"] {
        for method in ["gph", "sph", "sph-av"] {
            let found = judge(&subject(method, integrator, Kernel::CubicSpline, ratio(1, 3)), "2");
            assert_eq!(found.verdict, Verdict::Stable, "{method} {integrator}");
            assert!(found.stable_set.limit().is_unbounded());
            // Nothing pulls them back, and nothing more is to be said.
            assert!(found.drift.is_some() && found.double_multiplier.is_none());
        }
    }
}

#[test]
fn implicit_schemes_have_stable_sets_of_their_own() {
    for (value, verdict) in [
        ("1/3", Verdict::Unstable),
        ("1", Verdict::Marginal),
        ("3/2", Verdict::Stable),
        ("90", Verdict::Stable),
    ] {
        assert_eq!(text(DOWNWIND, value).verdict, verdict, "{value}");
    }
    let singular = text(DOWNWIND, "1/2");
    assert_eq!(singular.verdict, Verdict::Unstable);
    assert!(singular.growth.per_step.is_infinite());
    // Every wave on the circle whatever the step.
    let neutral = text(CRANK_NICOLSON, "40");
    assert_eq!((neutral.verdict, neutral.growth.per_step), (Verdict::Stable, 0.0));
    assert!(neutral.stable_set.limit().is_unbounded());
}

#[test]
fn zero_is_judged_like_any_value() {
    assert_eq!(text(UPWIND, "0").verdict, Verdict::Stable);
    // Alone in its neighbourhood.
    for alone in [DOWNWIND, "u[n+1,j] = u[n,j] - C*(u[n,j+1] - u[n,j-1])"] {
        assert_eq!(text(alone, "0").verdict, Verdict::Marginal);
    }
    // Nothing is left of the step but what grows.
    assert_eq!(text("u[n+1,j] = 2*u[n,j] - C*u[n,j-1]", "0").verdict, Verdict::Unstable);
}

#[test]
fn a_step_that_no_wave_can_take_is_refused() {
    for (singular, value) in [("C*u[n+1,j] = u[n,j]", "0"), ("(2*C-1)*u[n+1,j] = u[n,j]", "1/2")] {
        let step = Step::from_text(singular).unwrap();
        let error = check(&step, "C", &parse(value).unwrap(), &SearchPlan::default()).unwrap_err();
        assert!(error.to_string().contains(&format!("C = {value}: the step cannot be solved")));
    }
}

#[test]
fn single_stable_points_are_marginal() {
    // |g| = 1 + (C − 1)²
    let point = "u[n+1,j] = (1 + (C - 1)^2)*u[n,j-1]";
    assert_eq!(text(point, "1").verdict, Verdict::Marginal);
    assert_eq!(text(point, "1.001").verdict, Verdict::WeaklyUnstable);
    // The same beside a wave that decays: the conditions are divided by (C − 1)².
    let two = "u[n+1,j] = (1 + (C - 1)^2)*u[n,j-1] + w[n,j+1]/2; w[n+1,j] = w[n,j]/2 + C*w[n,j-1]/4 - C*w[n,j]/4";
    assert_eq!(text(two, "1").verdict, Verdict::Marginal);
    assert_eq!(text(two, "1.001").verdict, Verdict::WeaklyUnstable);
    assert_eq!(text(two, "0.9").verdict, Verdict::Unstable);
}

#[test]
fn resonance_is_marginal_with_its_wave() {
    let leapfrog = text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])", "1");
    assert_eq!(leapfrog.verdict, Verdict::Marginal);
    assert_eq!(leapfrog.double_multiplier.unwrap().phase(), Some(std::f64::consts::FRAC_PI_2));
    // Driven at its own frequency, at every C: −1 is the multiplier of both for the shortest wave.
    let driven = "u[n+1,j] = -u[n,j] + C*(u[n,j] + u[n,j-1])/4; w[n+1,j] = -w[n,j] + u[n,j]";
    let found = text(driven, "1/2");
    assert_eq!((found.verdict, found.growth.per_step), (Verdict::Marginal, 0.0));
    assert_eq!(found.double_multiplier.unwrap().phase(), Some(std::f64::consts::PI));
}

/// With one box for each decision nobody may be told that anything is stable, but where the whole set is found without boxes.
#[test]
fn without_work_nothing_is_decided() {
    let plan = SearchPlan { budget: 1, ..SearchPlan::default().up_to(integer(10)) };
    let integrators = ["leapfrog-kdk", "rk4", "forward-euler", "predictor-corrector", "rk2-heun"];
    let particles = ["sph", "sph-av", "gph"]
        .into_iter()
        .flat_map(|method| integrators.map(|integrator| (method, integrator)));
    let all = ["godunov-sph", "lax-wendroff-sph", "euler-sph"].map(|scheme| (scheme, ""));
    for (name, integrator) in particles.chain(all) {
        // Exact data and enclosed ones.
        for kernel in [Kernel::CubicSpline, Kernel::Gaussian] {
            let step = subject(name, integrator, kernel, ratio(6, 5));
            for value in ["9/10", "2"] {
                let found = check(&step, "C", &parse(value).unwrap(), &plan).unwrap();
                let open = !found.stable_set.undecided.is_empty();
                let undecided = found.verdict == Verdict::Undecided;
                assert_eq!(undecided, open, "{name} {integrator} {value}");
                assert!(!open || found.steps_to_double.is_none());
            }
        }
    }
    for scheme in catalogue::schemes().iter().filter(|scheme| !scheme.needs_kernel()) {
        let parameter = scheme.parameter.as_deref().unwrap();
        let step = scheme.step(None, None, &[], Some(parameter)).unwrap();
        let found = check(&step, parameter, &ratio(1, 5), &plan).unwrap();
        let open = !found.stable_set.undecided.is_empty();
        assert_eq!(found.verdict == Verdict::Undecided, open, "{}", scheme.name);
    }
}

/// Half of a limit, the limit's neighbours and twice the limit, for every scheme of the catalogue with a limit.
#[test]
fn verdicts_on_both_sides_of_the_limits_of_the_catalogue() {
    for scheme in catalogue::schemes().iter().filter(|scheme| !scheme.needs_kernel()) {
        let parameter = scheme.parameter.as_deref().unwrap();
        let step = scheme.step(None, None, &[], Some(parameter)).unwrap();
        let plan = SearchPlan::default();
        let set = step.stable_set(parameter, &plan).unwrap();
        let limit = set.limit();
        let at = |value: &Rational| check(&step, parameter, value, &plan).unwrap();
        if !limit.is_positive() {
            assert!(!at(&ratio(1, 1_000_000)).verdict.is_stable(), "{}", scheme.name);
            continue;
        }
        if limit.upper().is_infinite() {
            assert_eq!(at(&integer(7)).verdict, Verdict::Stable, "{}", scheme.name);
            continue;
        }
        let (below, above) = (limit.certain_lower(), limit.certain_upper().unwrap());
        assert_eq!(at(&(&below / integer(2))).verdict, Verdict::Stable, "{}", scheme.name);
        let beyond = &above * (integer(1) + ratio(1, 10).pow(12));
        let found = at(&beyond);
        assert!(
            !found.verdict.is_stable() && found.growth.per_step > 0.0,
            "{}: {found:?}",
            scheme.name
        );
        if below == above {
            let there = at(&below);
            assert_eq!(there.verdict, Verdict::Marginal, "{}", scheme.name);
            assert_eq!(there.double_multiplier.is_none(), limit.is_included(), "{}", scheme.name);
        }
    }
}

#[test]
fn an_end_that_is_no_fraction_is_met_within_its_last_digits() {
    // C + C² ≤ 1: the golden section.
    let golden = "u[n+1,j] = u[n,j] - (C + C^2)*(u[n,j] - u[n,j-1])";
    let step = Step::from_text(golden).unwrap();
    let limit = step.limit("C").unwrap();
    assert!(limit.lower() < limit.upper());
    let at =
        |value: f64| check(&step, "C", &from_f64(value).unwrap(), &SearchPlan::default()).unwrap();
    let (below, there) = (at(limit.lower().next_down()), at(limit.lower()));
    assert_eq!((below.verdict, there.verdict), (Verdict::Stable, Verdict::Marginal));
    // The wave that binds, and above the one that grows.
    assert_eq!(there.critical_wave().as_ref(), limit.critical_wave());
    let above = at(limit.upper());
    assert_eq!(above.verdict, Verdict::WeaklyUnstable);
    assert_eq!(above.critical_wave(), Some(above.growth.wave.clone()));
    // The end itself may be anywhere between; where only the proof ends there is no end to be met.
    let met = |evidence| {
        let end = Limit::between(0.5, 1.0, evidence);
        ["0.4", "1/2", "3/4", "1", "1.1"].map(|value| is_at(&end, &parse(value).unwrap()))
    };
    assert_eq!(met(Evidence::Enclosed), [false, true, true, true, false]);
    assert_eq!(met(Evidence::Undecided), [false; 5]);
    let zero = Limit::exactly(crate::stability::ExactValue::Fraction(integer(0)), Evidence::Proved);
    assert!(!is_at(&zero, &integer(0)));
}

#[test]
fn a_limit_that_is_proved_within_the_budget_comes_with_a_verdict() {
    let step = Step::from_text(UPWIND).unwrap();
    let verdict = |budget| {
        let plan = SearchPlan { budget, ..SearchPlan::default() };
        check(&step, "C", &ratio(1, 2), &plan).unwrap().verdict
    };
    assert_eq!([1, 99, 100].map(verdict), [Verdict::Stable; 3]);
}

#[test]
fn monotone_as_far_as_the_data_tell() {
    // 1 − 2C (1/2 + 1/4 ± 2/1000) ends between 1/1.504 and 1/1.496.
    let weights = crate::kernel::lattice::LatticeWeights {
        gradient: vec![ratio(1, 2), ratio(1, 4)],
        curvature: vec![integer(-2), integer(1), integer(0)],
        radius: ratio(1, 1000),
    };
    let lattice = KernelLattice::from_weights(integer(1), weights);
    let godunov = catalogue::scheme("godunov-sph").unwrap();
    let step = godunov.step(Some(&lattice), None, &[], Some("C")).unwrap();
    let monotone = ["0.66", "2/3", "0.67"].map(|value| judge(&step, value).monotone);
    assert_eq!(monotone, [Some(true), None, Some(false)]);
}

#[test]
fn the_growth_of_an_instability_that_is_called_weak() {
    // |g| = 1 + C for every wave.
    let text = |value: &str| text("u[n+1,j] = (1 + C)*u[n,j-1]", value).verdict;
    let (weak, strong) = (Verdict::WeaklyUnstable, Verdict::Unstable);
    assert_eq!(["0.000099", "0.0001", "0.000101"].map(text), [weak, weak, strong]);
}

#[test]
fn strict_demands_hold_nearby_whatever_the_search_leaves_open() {
    // g = 1 − C ((s − 1/2)² + (C − 1)²)/4: neutral for one wave at C = 1, damped on both sides; with few bits the search stops there.
    let touching = "u[n+1,j] = u[n,j] - C/4*((6*u[n,j] - 4*u[n,j+1] - 4*u[n,j-1] + u[n,j+2] + u[n,j-2])/16 \
                    - (2*u[n,j] - u[n,j+1] - u[n,j-1])/4 + (1/4 + (C - 1)^2)*u[n,j])";
    let step = Step::from_text(touching).unwrap();
    let plan = SearchPlan::default().up_to(ratio(3, 2)).to_bits(40);
    let verdict = |value: &str| check(&step, "C", &parse(value).unwrap(), &plan).unwrap().verdict;
    let (stable, marginal) = (Verdict::Stable, Verdict::Marginal);
    assert_eq!(["0.9", "1", "1.2"].map(verdict), [stable, marginal, stable]);
    assert!(stable.is_stable() && marginal.is_stable() && !Verdict::Undecided.is_stable());
    // With little work no more is said of a value than of the set: 3 is unstable.
    let little = |budget: usize, value: i64| {
        let plan = SearchPlan { budget, ..plan.clone() };
        check(&step, "C", &ratio(value, 10), &plan).unwrap()
    };
    let verdicts = [99, 100].map(|budget| [9, 30].map(|value| little(budget, value).verdict));
    assert_eq!(verdicts, [[Verdict::Undecided; 2], [stable, Verdict::Unstable]]);
    let open = little(99, 30);
    assert!(open.growth.per_step > 0.0 && open.steps_to_double.is_none());
}

#[test]
fn the_wave_named_is_the_one_that_grows_or_else_the_one_that_binds() {
    let diffusion = "u[n+1,j] = u[n,j] + C*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    for value in ["1/4", "3/4"] {
        let wave = text(diffusion, value).critical_wave().unwrap();
        assert!((wave.phases()[0] - std::f64::consts::PI).abs() < 1e-9, "{value}");
    }
    // Outside whatever C is, but for 0.
    let nowhere = "u[n+1,j] = u[n-3,j] + C*(u[n,j+1] + u[n,j-1])";
    assert_eq!(
        ["0", "1/2"].map(|value| text(nowhere, value).verdict),
        [Verdict::Marginal, Verdict::Unstable]
    );
}
