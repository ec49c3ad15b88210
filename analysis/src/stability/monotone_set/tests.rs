use super::*;
use crate::exact::rational::{ratio, square_root_enclosure, to_f64};
use crate::kernel::Kernel;
use crate::kernel::lattice::LatticeWeights;
use crate::scheme::{KernelLattice, catalogue};
use proptest::prelude::*;

fn sph(scheme: &str, kernel: Kernel, l: Rational) -> StableSet {
    let lattice = KernelLattice::new(kernel, &l).unwrap();
    let step = catalogue::scheme(scheme).unwrap().step(Some(&lattice), None, &[], Some("C"));
    step.unwrap().monotone_set("C", &SearchPlan::default()).unwrap().unwrap()
}

fn set(text: &str) -> StableSet {
    let step = Step::from_text(text).unwrap();
    step.monotone_set("C", &SearchPlan::default().up_to(integer(10))).unwrap().unwrap()
}

#[test]
fn lax_wendroff_and_euler_are_not_monotone_from_zero() {
    for scheme in ["lax-wendroff-sph", "euler-sph"] {
        for kernel in Kernel::ALL {
            let set = sph(scheme, kernel, ratio(3, 2));
            assert_eq!(set.limit().value(), 0.0, "{scheme} {kernel}");
            assert_eq!(set.limit().binding_offset(), Some(&[1][..]));
        }
    }
}

#[test]
fn lax_wendroff_is_monotone_in_a_window() {
    // One neighbour: c_{±1} = ∓wC + vC²/2 and c_0 = 1 + v_0 C²/2, so from 2w/v to √(−2/v_0).
    let l = ratio(3, 5);
    let weights = LatticeWeights::new(Kernel::WendlandC4, &l).unwrap();
    let set = sph("lax-wendroff-sph", Kernel::WendlandC4, l);
    let [only] = set.intervals.as_slice() else { panic!("{set:?}") };
    let from = &weights.gradient[0] * integer(2) / &weights.curvature[1];
    assert_eq!(only.from.exact(), Some(&ExactValue::Fraction(from)));
    let square = integer(-2) / &weights.curvature[0];
    assert_eq!(only.to.exact(), Some(&ExactValue::square_root(square)));
    assert_eq!(
        (only.from.binding_offset(), only.to.binding_offset()),
        (Some(&[1][..]), Some(&[0][..]))
    );
    assert!((only.from.value() - 0.110).abs() < 1e-3 && (only.to.value() - 0.406).abs() < 1e-3);
    assert!(set.contains(&ratio(1, 4)) && !set.contains(&ratio(1, 10)));
    assert_eq!((set.limit().value(), set.limit().binding_offset()), (0.0, Some(&[1][..])));
}

#[test]
fn an_irrational_limit_is_a_root_of_its_coefficient() {
    // c_0 = 1 − C − C² beside c_{−1} = C + C²: the golden section.
    let limit = set("u[n+1,j] = u[n,j] - (C + C^2)*(u[n,j] - u[n,j-1])").limit();
    assert_eq!(limit.equation().unwrap().equation("C"), "-C^2 - C + 1 = 0");
    assert_eq!(limit.decimal(20).unwrap(), "0.61803398874989484820");
    // A pure square is a square root.
    let limit = sph("lax-wendroff-sph", Kernel::CubicSpline, ratio(1, 2)).limit();
    assert_eq!(limit.exact().unwrap().to_string(), "sqrt(1/8)");
}

#[test]
fn touching_zero_binds_nothing_and_isolated_points_are_no_interval() {
    // c_1 = C (C − 1)², c_0 = 2 − C: the touch at 1 passes, the crossing at 2 binds.
    let limit = set("u[n+1,j] = (2 - C)*u[n,j] + C*(C - 1)^2*u[n,j+1]").limit();
    assert_eq!((limit.value(), limit.binding_offset()), (2.0, Some(&[0][..])));
    // Of several ends the first, in whichever order they come.
    for (first, second) in [("(1 - C)", "(2 - C)"), ("(2 - C)", "(1 - C)")] {
        let limit = set(&format!("u[n+1,j] = {first}*u[n,j] + C*{second}*u[n,j-1]")).limit();
        assert_eq!(limit.value(), 1.0);
    }
    // C² − 2 and 2 − C² agree at √2 alone, however their roots are enclosed.
    let none = set("u[n+1,j] = (C^2 - 2)*u[n,j] + (2 - C^2)*(3 + C)*u[n,j+1]");
    assert!(none.intervals.is_empty() && none.undecided.is_empty());
    // (C − 1)(C − 2)(C − 3) and 1 + C: two intervals.
    let two = set("u[n+1,j] = (C - 1)*(C - 2)*(C - 3)*u[n,j] + (1 + C)*u[n,j-1]");
    let ends: Vec<_> = two.intervals.iter().map(|i| (i.from.value(), i.to.value())).collect();
    assert_eq!(ends, [(1.0, 2.0), (3.0, f64::INFINITY)]);
    assert!(!two.intervals[1].to.is_unbounded());
}

#[test]
fn what_is_positive_for_ever_and_what_is_not_asked() {
    let always = set("u[n+1,j] = u[n,j] + C*u[n,j-1]");
    assert!(always.intervals[0].to.is_unbounded() && always.at_zero);
    // Where nothing moves every value is the old one, whatever any step would do; not where the equation stays.
    let none = set("u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1])");
    assert!(none.intervals.is_empty() && none.contains(&integer(0)) && none.limit().is_included());
    assert!(!set("u[n+1,j] = (1 + C)*u[n,j] - (1 - C)*u[n,j-1]").contains(&integer(0)));
    let implicit = Step::from_text("u[n+1,j] + C*(u[n+1,j] - u[n+1,j-1]) = u[n,j]").unwrap();
    assert!(implicit.monotone_set("C", &SearchPlan::default()).unwrap().is_none());
    assert!(implicit.monotone_set("D", &SearchPlan::default()).is_err());
}

#[test]
fn what_only_the_data_leave_open_is_undecided() {
    let weights = |gradient: Rational, radius: Rational| LatticeWeights {
        gradient: vec![ratio(1, 2), gradient],
        curvature: vec![integer(-2), integer(1), integer(0)],
        radius,
    };
    let scheme = catalogue::scheme("godunov-sph").unwrap();
    let set = |gradient, radius| {
        let lattice = KernelLattice::from_weights(integer(1), weights(gradient, radius));
        let step = scheme.step(Some(&lattice), None, &[], Some("C")).unwrap();
        step.monotone_set("C", &SearchPlan::default()).unwrap().unwrap()
    };
    // A weight that may have either sign.
    let open = set(ratio(0, 1), ratio(1, 1000));
    assert!(open.intervals.is_empty() && open.undecided[0].0 == 0.0, "{open:?}");
    assert_eq!(open.limit().evidence(), Evidence::Undecided);
    // A range that ends where that is open.
    let lattice = KernelLattice::from_weights(integer(1), weights(ratio(1, 4), ratio(1, 1000)));
    let step = scheme.step(Some(&lattice), None, &[], Some("C")).unwrap();
    let plan = SearchPlan::default().up_to(ratio(2, 3));
    let open = step.monotone_set("C", &plan).unwrap().unwrap();
    assert!(open.intervals.len() == 1 && open.intervals[0].to.evidence() == Evidence::Undecided);
    assert_eq!(
        open.undecided,
        [(open.limit().lower(), 2.0f64 / 3.0)].map(|(a, b)| (a, b.next_up()))
    );
    assert!((open.limit().lower() - 1.0 / 1.504).abs() < 1e-12);
    // One that has not: 1 − 2C (1/2 + 1/4 ± 2/1000).
    let limit = set(ratio(1, 4), ratio(1, 1000)).limit();
    assert_eq!(limit.evidence(), Evidence::Enclosed);
    assert!(
        (limit.lower() - 1.0 / 1.504).abs() < 1e-12 && (limit.upper() - 1.0 / 1.496).abs() < 1e-12
    );
}

#[test]
fn what_lies_between_certain_parts_is_undecided() {
    // (C − √2)² is nowhere negative, which the enclosure of √2 leaves open; beside it other ends.
    let root = 2f64.sqrt();
    let near = |limit: &Limit, value: f64| {
        limit.lower() <= value && value <= limit.upper() && limit.upper() - limit.lower() < 1e-12
    };
    for (factors, from, to) in [
        ("1", 0.0, f64::INFINITY),
        ("(2 - C)", 0.0, 2.0),
        ("(C - 1)", 1.0, f64::INFINITY),
        ("(C - 1)*(2 - C)", 1.0, 2.0),
    ] {
        let found = set(&format!("u[n+1,j] = {factors}*(C - sqrt(2))^2*u[n,j] + C*u[n,j-1]"));
        let [before, after] = &found.intervals[..] else { panic!("{factors}: {found:?}") };
        assert!(near(&before.from, from) && near(&before.to, root), "{factors}: {before:?}");
        assert!(near(&after.from, root) && (to.is_infinite() || near(&after.to, to)), "{after:?}");
        assert_eq!(after.to.upper().is_infinite(), to.is_infinite());
        assert!(!after.to.is_unbounded());
        let evidence = [&before.from, &before.to, &after.from, &after.to].map(Limit::evidence);
        let (enclosed, open) = (Evidence::Enclosed, Evidence::Undecided);
        assert_eq!(evidence, [enclosed, open, open, enclosed], "{factors}");
        let [(lower, upper)] = found.undecided[..] else { panic!("{factors}: {found:?}") };
        assert!(lower <= root && root <= upper && upper - lower < 1e-12);
        assert_eq!(found.immediate_offset.is_some(), from > 0.0);
    }
    // Zero, as far as the data tell, from which it grows.
    let open = set("u[n+1,j] = (pi*(1/pi) - 1 + C)*u[n,j] + C*u[n,j-1]");
    assert!(open.limit().evidence() == Evidence::Undecided && open.intervals.len() == 1);
    assert!(open.undecided.len() == 1 && open.undecided[0].0 == 0.0 && !open.at_zero);
}

#[test]
fn roots_at_the_end_of_the_range_and_beyond_end_nothing() {
    for coefficient in ["(1 - C/20)", "(1 - C/10)", "(10 - C)*(1 + C)"] {
        let limit = set(&format!("u[n+1,j] = {coefficient}*u[n,j] + C*u[n,j-1]")).limit();
        assert!(limit.upper().is_infinite() && limit.lower() == 10.0, "{coefficient}");
        assert!(!limit.is_unbounded(), "{coefficient}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn godunov_is_the_inverse_of_twice_the_sum(numerator in 6i64..120) {
        let l = ratio(numerator, 10);
        for kernel in Kernel::ALL {
            let limit = sph("godunov-sph", kernel, l.clone()).limit();
            let sum: f64 = (1..400)
                .map(|k| {
                    let q = f64::from(k) * 10.0 / numerator as f64;
                    let inside = integer(k.into()) <= kernel.exact_support() * &l;
                    if inside { -kernel.slope(q.min(kernel.support())) } else { 0.0 }
                })
                .sum::<f64>() / to_f64(&l).powi(2);
            prop_assert!((limit.value() * 2.0 * sum - 1.0).abs() < 1e-13, "{} {}", kernel, l);
            prop_assert!(limit.upper() - limit.lower() <= 1e-15 * limit.value());
        }
    }

    #[test]
    fn a_value_is_monotone_where_all_coefficients_are_non_negative(
        values in prop::collection::vec(prop::collection::vec(-6i64..7, 1..5), 1..4), n in 1i64..60
    ) {
        let terms: Vec<String> = values.iter().enumerate().map(|(offset, coefficients)| {
            let powers = coefficients.iter().enumerate().map(|(p, c)| format!("{c}*C^{p}"));
            format!("({})*u[n,j+{offset}]", powers.collect::<Vec<_>>().join("+"))
        }).collect();
        let text = format!("u[n+1,j] = {}", terms.join(" + "));
        // All terms may vanish.
        let Ok(step) = Step::from_text(&text) else { return Ok(()) };
        let Ok(Some(set)) = step.monotone_set("C", &SearchPlan::default().up_to(integer(10))) else { return Ok(()) };
        let point = ratio(n, 7);
        prop_assume!(point < integer(10));
        let at = |c: &Vec<i64>| c.iter().rev().fold(Rational::zero(), |sum, v| sum * &point + integer(*v));
        let negative = values.iter().any(|c| at(c).is_negative());
        let positive = values.iter().all(|c| at(c).is_positive() || c.iter().all(|v| *v == 0));
        if negative { prop_assert!(!set.contains(&point), "{}", text); }
        if positive { prop_assert!(set.contains(&point), "{}", text); }
    }
}

#[test]
fn roots_of_two_coefficients_are_told_apart_however_near() {
    // √2 and √(2 + 2^−230).
    let of = |values: [BigInt; 4]| Coefficient::new(vec![0], Polynomial::new(values.into()));
    let plan = SearchPlan::default().up_to(integer(10));
    let unit: BigInt = BigInt::from(1) << 230;
    let [first, second] = [-2 * &unit, -2 * &unit - 1]
        .map(|constant| of([constant, 0.into(), unit.clone(), 0.into()]));
    let again = of([-6, -2, 3, 1].map(BigInt::from));
    let end = |of| Coefficient::roots(of, &plan).pop().map(|root| End { root, of }).unwrap();
    assert_eq!(end(&first).order(&end(&second)), Ordering::Less);
    assert_eq!(end(&second).order(&end(&first)), Ordering::Greater);
    assert_eq!(end(&first).order(&end(&again)), Ordering::Equal);
    let root = end(&first).root;
    assert!(root.upper - root.lower < power_of_two(-190));
}

#[test]
fn roots_that_their_first_enclosures_do_not_tell_apart_are_ordered() {
    // (x − 1)² − 2^−k, k odd: roots 2^(−k/2) to both sides of 1, which 200 bits do not tell from it.
    let near = |k: i64| {
        let square = BigInt::from(1) << k;
        let polynomial = vec![&square - 1, -2 * &square, square];
        Coefficient::new(vec![0], Polynomial::new(polynomial))
    };
    let (nearer, farther) = (near(441), near(439));
    let plan = SearchPlan::default().up_to(integer(10));
    let end = |of| Coefficient::roots(of, &plan).pop().map(|root| End { root, of }).unwrap();
    assert_eq!(end(&nearer).order(&end(&farther)), Ordering::Less);
    assert_eq!(end(&farther).order(&end(&nearer)), Ordering::Greater);
    let whole = nearer.polynomial.map(Rational::to_integer);
    let once_more = whole * Polynomial::new(vec![3.into(), 1.into()]);
    let once_more = Coefficient::new(vec![0], once_more);
    assert_eq!(end(&nearer).order(&end(&once_more)), Ordering::Equal);
    // Roots of 2x² − 3 and x² − 3, by enclosures that overlap.
    let [low, high] = [[-3, 0, 2], [-3, 0, 1]]
        .map(|values| Coefficient::new(vec![0], Polynomial::new(values.map(BigInt::from).into())));
    let wide = |of, lower, upper| End { root: RealRoot { lower, upper }, of };
    let (a, b) = (wide(&low, integer(1), ratio(3, 2)), wide(&high, ratio(5, 4), integer(2)));
    assert_eq!((a.order(&b), b.order(&a)), (Ordering::Less, Ordering::Greater));
    // Told apart from the end of the range.
    let max = square_root_enclosure(&integer(3), &integer(3), 230).1;
    let [root] = &high.roots(&SearchPlan::default().up_to(max.clone()))[..] else { panic!() };
    assert!(root.upper < max);
    // Negative in between, for however short a stretch, and however soon the range ends behind it.
    for max in [integer(10), integer(1) + power_of_two(-219)] {
        let plan = SearchPlan::default().up_to(max);
        let [lower, upper] = &farther.roots(&plan)[..] else { panic!() };
        assert!(lower.upper < upper.lower && upper.upper < plan.max);
        assert_eq!(farther.non_negative(&plan).len(), 2);
    }
}
