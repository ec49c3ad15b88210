use super::*;
use crate::exact::rational::{integer, ratio};
use crate::kernel::Kernel;
use crate::scheme::Step;
use crate::scheme::testing::{SPH, sph};
use crate::stability::{Cause, SearchPlan};
use proptest::prelude::*;

fn plan(max: i64) -> SearchPlan {
    SearchPlan::default().up_to(integer(max))
}

fn set_of(step: &Step, plan: &SearchPlan) -> StableSet {
    step.stable_set("C", plan).unwrap()
}

fn set(scheme: &str, kernel: Kernel, l: Rational) -> StableSet {
    set_of(&sph(scheme, kernel, &l), &plan(100))
}

/// The long-wave limit of Godunov SPH, `2Σk²w_k / (2Σk w_k)²`, straight from the weights.
fn long_wave_limit(kernel: Kernel, l: &Rational) -> Rational {
    let weights = crate::kernel::lattice::LatticeWeights::new(kernel, l).unwrap();
    let moment = |power: i32| -> Rational {
        (1..).zip(&weights.gradient).map(|(k, w)| integer(k).pow(power) * w).sum()
    };
    moment(2) / (integer(2) * moment(1) * moment(1))
}

#[test]
fn godunov_limits_of_table_1_are_the_long_wave_fractions() {
    for (l, exact) in [(1, "1"), (2, "15/8"), (3, "227/81"), (5, "2917/625"), (10, "46667/5000")] {
        let set = set("godunov-sph", Kernel::CubicSpline, integer(l));
        let limit = set.limit();
        assert_eq!(limit.evidence(), Evidence::Proved);
        assert_eq!(
            limit.exact().unwrap().as_fraction(),
            Some(&long_wave_limit(Kernel::CubicSpline, &integer(l)))
        );
        if l <= 2 {
            assert_eq!(limit.exact().unwrap().to_string(), exact);
        }
        assert_eq!(limit.cause(), Some(Cause::LongWave));
        assert!(set.undecided.is_empty() && set.intervals.len() == 1);
    }
}

#[test]
fn godunov_gaussian_limits_enclose_the_long_wave_value() {
    for l in 1..=10 {
        let limit = set("godunov-sph", Kernel::Gaussian, integer(l)).limit();
        assert_eq!(limit.evidence(), Evidence::Enclosed);
        assert!(limit.upper() - limit.lower() <= 2e-15 * limit.value(), "{limit:?}");
        let exact = to_f64(&long_wave_limit(Kernel::Gaussian, &integer(l)));
        assert!(limit.lower() <= exact && exact <= limit.upper());
    }
}

#[test]
fn euler_is_unstable_at_once() {
    for kernel in Kernel::ALL {
        let set = set("euler-sph", kernel, ratio(3, 2));
        assert!(set.intervals.is_empty() && set.undecided.is_empty());
        assert_eq!(set.limit().value(), 0.0);
        assert!(set.limit().critical_phase().is_some());
    }
}

#[test]
fn the_exact_shift_is_stable_and_not_beyond() {
    let set = set("godunov-sph", Kernel::CubicSpline, integer(1));
    assert_eq!(set.limit().exact().unwrap().to_string(), "1");
    assert!(set.contains(&integer(1)) && !set.contains(&ratio(1_000_001, 1_000_000)));
}

#[test]
fn a_scheme_without_neighbours_is_neutral() {
    let set = set("godunov-sph", Kernel::CubicSpline, ratio(1, 4));
    assert!(set.neutral);
    assert!(set.limit().value().is_infinite());
}

#[test]
fn lax_wendroff_is_the_classical_scheme_at_ratio_one() {
    let set = set("lax-wendroff-sph", Kernel::CubicSpline, integer(1));
    assert_eq!(set.limit().exact().unwrap().to_string(), "1");
}

#[test]
fn lax_wendroff_with_the_cut_gaussian_has_no_strict_limit_but_budgets() {
    let step = sph("lax-wendroff-sph", Kernel::Gaussian, &integer(3));
    let mut last = set_of(&step, &plan(30)).limit().value();
    for growth in ["1e-9", "1e-6", "1e-3", "1e-2"] {
        let growth = crate::exact::rational::parse(growth).unwrap();
        let limit = set_of(&step, &plan(30).growing(growth.clone())).limit();
        assert!(limit.value() >= last, "{growth}: {limit:?}");
        assert!(limit.upper() - limit.lower() <= 4e-15 * limit.value());
        last = limit.value();
    }
    assert!(last > 3.0);
}

/// A disconnected stable set: `1 − |g|²` proportional to `(1 − C)(2 − C)(3 − C)`, by choosing
/// `g = 1 − a(C)(1 − E^{−1})` with `a = C(1 + …)`: upwind with a distorted Courant number is stable
/// where `0 ≤ a(C) ≤ 1`.
#[test]
fn a_disconnected_stable_set_is_found_whole() {
    // a(C) = C (C² − 6C + 9.5)/3 rises above 1, falls below it and rises again.
    let text = "u[n+1,j] = u[n,j] - C*(C^2 - 6*C + 9.5)/3*(u[n,j] - u[n,j-1])";
    let set = set_of(&Step::from_text(text).unwrap(), &plan(10));
    assert!(set.undecided.is_empty(), "{set:?}");
    let a = |c: f64| c * (c * c - 6.0 * c + 9.5) / 3.0;
    assert_eq!(set.intervals.len(), 2, "{set:?}");
    for (interval, inside) in set.intervals.iter().zip([0.2, 2.8]) {
        assert!(interval.from.lower() < inside && inside < interval.to.upper());
        // The ends are roots of a(C) = 1 (or 0); the slope of a is below 20 here.
        assert!((a(interval.to.value()) - 1.0).abs() < 1e-13);
    }
    assert!((a(set.intervals[1].from.value()) - 1.0).abs() < 1e-13);
}

#[test]
fn printed_digits_are_those_of_the_limit() {
    // The Gaussian's weights are enclosed to 2^−185: fifty digits, not more, whatever is asked for.
    let step = sph("godunov-sph", Kernel::Gaussian, &integer(3));
    let set = set_of(&step, &plan(10).to_bits(400));
    let expected = long_wave_limit(Kernel::Gaussian, &integer(3));
    let digits = set.limit().decimal(100).unwrap();
    assert!((45..60).contains(&digits.len()), "{digits}");
    let printed = crate::exact::rational::parse(&digits).unwrap();
    assert!(
        printed <= expected && &expected - &printed < ratio(1, 10).pow(digits.len() as i32 - 4)
    );
    // An interior limit of an exact scheme: beyond the affordable discriminant by the narrower search.
    let step = sph("lax-wendroff-sph", Kernel::CubicSpline, &ratio(81, 10));
    let wide = set_of(&step, &plan(20)).limit();
    let narrow = set_of(&step, &plan(20).to_bits(140)).limit();
    assert!(wide.equation().is_none());
    assert!(wide.lower() <= narrow.lower() && narrow.upper() <= wide.upper());
    assert_eq!(narrow.decimal(40).unwrap().len(), 41);
}

#[test]
fn a_growth_budget_never_lowers_a_limit() {
    for (scheme, l) in [
        ("lax-wendroff-sph", integer(5)),
        ("godunov-sph", ratio(3, 2)),
        ("godunov-sph", integer(7)),
    ] {
        let step = sph(scheme, Kernel::CubicSpline, &l);
        let strict = set_of(&step, &plan(30)).limit();
        let mut last = strict.lower();
        for growth in ["1e-120", "1e-90", "1e-30", "1e-20", "1e-16", "1e-12"] {
            let growth = crate::exact::rational::parse(growth).unwrap();
            let set = set_of(&step, &plan(30).growing(growth.clone()));
            let limit = set.limit();
            assert!(set.undecided.is_empty(), "{scheme} {l} {growth}: {set:?}");
            assert!(last <= limit.lower() && limit.evidence() == Evidence::Proved, "{limit:?}");
            assert!(limit.upper() - limit.lower() <= 1e-6 * limit.lower(), "{limit:?}");
            assert!(set.work.boxes < 20_000, "{scheme} {l} {growth}: {:?}", set.work);
            last = limit.lower();
        }
    }
}

#[test]
fn what_is_printed_may_be_used() {
    for (kernel, l) in [(Kernel::Gaussian, 1), (Kernel::Gaussian, 2), (Kernel::WendlandC2, 1)] {
        let set = set_of(&sph("godunov-sph", kernel, &integer(l)), &plan(10));
        for text in [set.limit().decimal(11).unwrap(), set.limit().value().to_string()] {
            assert!(
                set.contains(&crate::exact::rational::parse(&text).unwrap()),
                "{kernel} {l}: {text}"
            );
        }
    }
}

#[test]
fn the_work_stays_small() {
    for (scheme, kernel, l, boxes) in [
        ("godunov-sph", Kernel::CubicSpline, 10, 20),
        ("godunov-sph", Kernel::Gaussian, 10, 60),
        ("lax-wendroff-sph", Kernel::CubicSpline, 5, 400),
    ] {
        let set = set(scheme, kernel, integer(l));
        assert!(set.undecided.is_empty());
        assert!(set.work.boxes <= boxes, "{scheme} {kernel} {l}: {:?}", set.work);
        // Cells are for waves that touch.
        assert_eq!(set.work.cells, 0, "{scheme} {kernel} {l}: {:?}", set.work);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn limits_agree_with_dense_sampling(numerator in 6i64..50, scheme in 0usize..3, kernel in 0usize..7) {
        let (scheme, kernel) = (SPH[scheme], Kernel::ALL[kernel]);
        let step = sph(scheme, kernel, &ratio(numerator, 10));
        let set = set_of(&step, &plan(30));
        prop_assert!(set.undecided.is_empty(), "{} {} {}: {:?}", scheme, kernel, numerator, set);
        let one_step = step.one_step("C").unwrap();
        let largest = |courant_number: f64| {
            let stencil = one_step.stencil_at(&from_f64(courant_number).unwrap()).map(to_f64);
            (1..=3000)
                .map(|i| stencil.at_phase(f64::from(i) * std::f64::consts::PI / 3000.0).norm_sqr())
                .fold(0.0, f64::max)
        };
        let limit = set.limit();
        if limit.is_positive() && limit.value().is_finite() {
            // Rounding of |g|² itself: sums of at most (1 + C)² in size.
            let rounding = 1e-13 * (1.0 + limit.value()).powi(2);
            prop_assert!(largest(limit.lower() * 0.999) <= 1.0 + rounding, "{} {} {}", scheme, kernel, numerator);
            prop_assert!(largest(limit.upper() * 1.02) > 1.0, "{} {} {}", scheme, kernel, numerator);
        }
    }
}

fn particles(method: &str, integrator: &str, kernel: Kernel) -> Step {
    let lattice = crate::scheme::KernelLattice::new(kernel, &ratio(3, 2)).unwrap();
    let integrator = crate::scheme::Integrator::for_particles(integrator);
    let method = crate::scheme::catalogue::method(method).unwrap();
    method.step(Some(&lattice), integrator, &[], Some("C")).unwrap()
}

/// `g = 1 − C ((s − 1/2)² + (square)²)/scale`: neutral for one wave where the square vanishes, damped on both sides.
fn touching(square: &str, scale: i64) -> Step {
    let s = "(2*u[n,j] - u[n,j+1] - u[n,j-1])/4";
    let squared = "(6*u[n,j] - 4*u[n,j+1] - 4*u[n,j-1] + u[n,j+2] + u[n,j-2])/16";
    let rest = format!("(1/4 + ({square})^2)*u[n,j]");
    Step::from_text(&format!("u[n+1,j] = u[n,j] - C/{scale}*({squared} - {s} + {rest})")).unwrap()
}

/// Boxes, evaluations and cells on every road to an answer: a decision that is taken otherwise costs otherwise, though another road
/// may lead to the same answer.
#[test]
fn every_road_costs_what_it_did() {
    let text = |text: &str| Step::from_text(text).unwrap();
    let cubic = |scheme, l| sph(scheme, Kernel::CubicSpline, &integer(l));
    let gaussian = |scheme| sph(scheme, Kernel::Gaussian, &integer(3));
    let growing = |growth| plan(30).growing(crate::exact::rational::parse(growth).unwrap());
    let beam_warming = crate::scheme::catalogue::scheme("beam-warming").unwrap();
    let mut different = Vec::new();
    for (step, plan, work) in [
        (text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])"), plan(100), [1, 3, 0]),
        (text("u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1])"), plan(100), [0, 2, 0]),
        (text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])"), plan(100), [3, 3, 0]),
        (text("u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]"), plan(100), [2, 3, 0]),
        (
            text("u[n+1,j] = u[n,j] - C*(C^2 - 6*C + 9.5)/3*(u[n,j] - u[n,j-1])"),
            plan(10),
            [3, 7, 0],
        ),
        (text("u[n+1,j] = u[n,j] - (C + C^2)*(u[n,j] - u[n,j-1])"), plan(10), [1, 3, 0]),
        (beam_warming.step(None, None, &[], Some("C")).unwrap(), plan(10), [127, 3, 0]),
        (
            text(
                "u[n+1,j] = (1-C)*(2-C)*(3-C)/6*u[n,j] + C*(2-C)*(3-C)/2*u[n,j-1] \
                 - C*(1-C)*(3-C)/2*u[n,j-2] + C*(1-C)*(2-C)/6*u[n,j-3]",
            ),
            plan(10),
            [2, 18, 0],
        ),
        (
            text(
                "u[n+1,j] = (1 + (C - 1)^2)*u[n,j-1] + w[n,j+1]/2; \
                 w[n+1,j] = w[n,j]/2 + C*w[n,j-1]/4 - C*w[n,j]/4",
            ),
            plan(100),
            [0, 18, 0],
        ),
        (touching("C^2 - 2", 1000), plan(4), [10_034, 0, 2]),
        (cubic("godunov-sph", 2), plan(100), [1, 3, 0]),
        (cubic("lax-wendroff-sph", 5), plan(100), [3, 3, 0]),
        (cubic("lax-wendroff-sph", 5), growing("1e-16"), [117, 4, 0]),
        (gaussian("godunov-sph"), plan(100), [1, 4, 0]),
        (gaussian("lax-wendroff-sph"), plan(30), [0, 2, 0]),
        (gaussian("lax-wendroff-sph"), growing("1e-6"), [63, 3, 0]),
        (particles("sph", "leapfrog-kdk", Kernel::CubicSpline), plan(10), [54, 3, 0]),
        (particles("sph-av", "rk4", Kernel::CubicSpline), plan(10), [3, 6, 0]),
        (particles("gph", "rk2-heun", Kernel::Gaussian), plan(10), [51, 3, 0]),
    ] {
        let [boxes, evaluations, cells] = work;
        let set = set_of(&step, &plan);
        if set.work != (Work { boxes, evaluations, cells }) {
            different.push(format!("{:?} for {work:?}: {step:?}", set.work));
        }
    }
    assert!(different.is_empty(), "{}", different.join("\n"));
}

#[test]
fn a_touch_that_is_not_decided_is_open_from_there_on_and_does_not_cost_without_end() {
    // With fewer bits than an edge is recognised by, cells are not asked.
    let set = set_of(&touching("C - 1", 4), &plan(1).up_to(ratio(3, 2)).to_bits(40));
    assert!((40_000..44_000).contains(&set.work.boxes) && set.work.cells == 0, "{:?}", set.work);
    let limit = set.limit();
    assert_eq!(limit.evidence(), Evidence::Undecided);
    assert!(limit.lower() > 0.9 && limit.lower() < 1.0, "{limit:?}");
    // No value from there on is called unstable.
    assert!(set.undecided.windows(2).all(|pair| pair[0].1 >= pair[1].0), "{set:?}");
    assert_eq!((set.undecided[0].0, set.undecided.last().unwrap().1), (limit.lower(), 1.5));
}

#[test]
fn with_one_box_what_is_not_proved_is_open() {
    let little = SearchPlan { budget: 1, ..plan(10) };
    for (method, integrator, kernel) in
        [("sph", "leapfrog-kdk", Kernel::CubicSpline), ("gph", "rk2-heun", Kernel::Gaussian)]
    {
        let step = particles(method, integrator, kernel);
        let (all, some) = (set_of(&step, &plan(10)), set_of(&step, &little));
        assert!(all.undecided.is_empty() && some.work.boxes <= 200);
        // Less is proved stable, nothing more is proved unstable.
        assert!(some.limit().lower() < all.limit().lower());
        assert_eq!(some.limit().evidence(), Evidence::Undecided);
        assert_eq!(some.undecided.first().unwrap().0, some.limit().lower());
        assert!(some.undecided.last().unwrap().1 >= 10.0);
        assert!(some.undecided.windows(2).all(|pair| pair[0].1 >= pair[1].0), "{some:?}");
    }
}

#[test]
fn zero_belongs_where_the_scheme_is_stable_at_zero() {
    let zero = |text: &str| {
        let set = set_of(&Step::from_text(text).unwrap(), &plan(10));
        (set.contains(&integer(0)), set.limit().is_positive())
    };
    assert_eq!(zero("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])"), (true, true));
    // Unstable for every C but 0; for every C; without a step at all at 0.
    assert_eq!(zero("u[n+1,j] = u[n,j] - C*(u[n,j+1] - u[n,j-1])"), (true, false));
    assert_eq!(zero("u[n+1,j] = 2*u[n,j] - C*u[n,j]"), (false, false));
    assert_eq!(zero("C*u[n+1,j] = u[n,j]"), (false, false));
}

#[test]
fn numbers_that_are_no_fractions_are_enclosed() {
    let limit = |text: &str| set_of(&Step::from_text(text).unwrap(), &plan(10)).limit();
    for (number, value) in [("sqrt(2)", 0.5f64.sqrt()), ("sqrt(1/2)", 2f64.sqrt())] {
        let upwind = limit(&format!("u[n+1,j] = u[n,j] - {number}*C*(u[n,j] - u[n,j-1])"));
        assert_eq!(upwind.evidence(), Evidence::Enclosed);
        assert!(upwind.lower() <= value && value <= upwind.upper(), "{number}: {upwind:?}");
    }
    // |g| = 1 whatever the square root is.
    let neutral = "u[n+1,j] + sqrt(2)*C*(u[n+1,j+1] - u[n+1,j-1]) \
                   = u[n,j] - sqrt(2)*C*(u[n,j+1] - u[n,j-1])";
    assert!(limit(neutral).is_unbounded() && limit(neutral).evidence() == Evidence::Proved);
    // Damped whatever π is.
    let damped = limit("u[n+1,j] - pi*C*(u[n+1,j+1] - 2*u[n+1,j] + u[n+1,j-1]) = u[n,j]");
    assert!(damped.upper().is_infinite() && damped.evidence() == Evidence::Enclosed);
}

#[test]
fn the_condition_that_fails_is_named() {
    let set = |text: &str| set_of(&Step::from_text(text).unwrap(), &plan(10));
    let upwind = set("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])").limit();
    let binding = upwind.binding().unwrap();
    assert_eq!(binding.name(), "schur-cohn-minor-1");
    assert!(!binding.on_circle && !binding.whatever_the_step && upwind.is_included());
    let leapfrog = set("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])").limit();
    assert!(leapfrog.binding().unwrap().on_circle && !leapfrog.is_included());
    // The product of four multipliers is −1, whatever the wave: one is outside.
    let nowhere = set("u[n+1,j] = u[n-3,j] + C*(u[n,j+1] + u[n,j-1])");
    assert!(nowhere.intervals.is_empty() && nowhere.undecided.is_empty() && !nowhere.neutral);
    assert_eq!((nowhere.limit().value(), nowhere.evidence), (0.0, Evidence::Proved));
    assert!(nowhere.immediately_unstable.is_some() && nowhere.limit().binding().is_none());
}

#[test]
fn the_limit_of_a_set_that_does_not_begin_at_zero_is_zero() {
    let exactly =
        |value: i64| Limit::exactly(ExactValue::Fraction(integer(value)), Evidence::Proved);
    let window = StableInterval { from: exactly(1), to: exactly(2) };
    let set = |intervals, undecided| StableSet {
        intervals,
        undecided,
        ..StableSet::empty(Evidence::Proved)
    };
    // Whatever is open further on.
    let limit = set(vec![window.clone()], vec![(2.0, 3.0)]).limit();
    assert_eq!((limit.upper(), limit.evidence()), (0.0, Evidence::Proved));
    let limit = set(vec![window.clone()], vec![(0.0, 1.0)]).limit();
    assert_eq!((limit.lower(), limit.evidence()), (0.0, Evidence::Undecided));
    let contains = |value| set(vec![window.clone()], Vec::new()).contains(&value);
    assert!(contains(integer(1)) && contains(ratio(3, 2)) && contains(integer(2)));
    assert!(!contains(integer(0)) && !contains(ratio(1, 2)) && !contains(ratio(5, 2)));
}
