//! Two deciders and plain evaluation against each other, and the hard cases.

use super::*;
use crate::exact::bernstein::{MarginForm, Sign};
use crate::exact::rational::{parse, ratio};
use crate::exact::real_roots::power_of_two;
use crate::exact::stencil::Stencil;
use crate::kernel::Kernel;
use crate::scheme::testing::{sph, step_of};
use crate::scheme::{KernelLattice, OneStep, Step, catalogue};
use crate::stability::testing::margin;
use crate::stability::{Evidence, SearchPlan, StableSet};
use proptest::prelude::*;

/// `1 − |g|²` from the coefficients alone, exact: `Σ_{k,l} c_k c_l T_{|k−l|}(1 − 2s)`.
fn plain_margin(one_step: &OneStep, courant_number: &Rational, s: &Rational) -> Rational {
    let stencil = one_step.stencil_at(courant_number);
    let span = stencil.reach().map_or(0, |(low, high)| high - low);
    let cosine = integer(1) - s * integer(2);
    let mut chebyshev = vec![integer(1), cosine.clone()];
    for _ in 0..span {
        let [.., before, last] = chebyshev.as_slice() else { unreachable!("starts with two") };
        let next = &cosine * last * integer(2) - before;
        chebyshev.push(next);
    }
    let mut sum = integer(1);
    for (k, a) in stencil.terms() {
        for (l, b) in stencil.terms() {
            sum -= a * b * &chebyshev[k.abs_diff(l) as usize];
        }
    }
    sum
}

fn margin_of(step: &Step) -> Margin {
    step.gain_margin("C", &integer(0)).unwrap().unwrap()
}

fn set_of(step: &Step, max: Rational) -> StableSet {
    step.stable_set("C", &SearchPlan::default().up_to(max)).unwrap()
}

fn by_boxes(margin: &Margin, courant_number: &Rational) -> Option<bool> {
    let t = courant_number.pow(margin.stride() as i32);
    match MarginForm::new(margin).sign(&t, &t, 2000).0 {
        Sign::NowhereNegative => Some(true),
        Sign::SomewhereNegative { .. } => Some(false),
        Sign::Undecided => None,
    }
}

#[test]
fn several_waves_may_touch() {
    // (4s − 1)² (4s − 3)² + t − 1
    let touching = margin(&[&[8, -96, 352, -512, 256], &[1]], &integer(0));
    let below = integer(1) - power_of_two(-60);
    assert_eq!(decide_at_parameter(&touching, &integer(1)), PointVerdict::Stable);
    assert!(matches!(decide_at_parameter(&touching, &below), PointVerdict::Unstable(_)));
}

/// Sturm, Bernstein, the stable set and 33 exactly evaluated waves: none may contradict another.
fn cross_check(step: &Step, set: &StableSet, courant_number: &Rational) {
    let (margin, one_step) = (margin_of(step), step.one_step("C").unwrap());
    let verdict = decide_at(&margin, courant_number);
    let stable = match &verdict {
        PointVerdict::Stable => true,
        PointVerdict::Unstable(s) => {
            // Where a factor was taken out the margin itself may vanish; nearby it does not.
            let near = |s: &Rational| {
                let step = ratio(1, 1 << 40);
                [s.clone(), s + &step, s - &step]
            };
            let negative = |s: &Rational| plain_margin(&one_step, courant_number, s).is_negative();
            assert!(
                near(s).iter().any(|s| *s >= integer(0) && *s <= integer(1) && negative(s)),
                "{one_step:?} at {courant_number}: {s} does not grow"
            );
            false
        }
        PointVerdict::Undecided => panic!("exact coefficients decide everything"),
    };
    for index in 0..=32 {
        let value = plain_margin(&one_step, courant_number, &ratio(index, 32));
        assert!(!(stable && value.is_negative()), "{one_step:?} at {courant_number}, wave {index}");
    }
    if let Some(boxes) = by_boxes(&margin, courant_number) {
        assert_eq!(boxes, stable, "{one_step:?} at {courant_number}");
    }
    let float = crate::exact::rational::to_f64(courant_number);
    let open = set.undecided.iter().any(|(from, to)| *from <= float && float <= *to);
    // The ends of the set are enclosed to the last digits of a float.
    let close = set
        .intervals
        .iter()
        .flat_map(|interval| [&interval.from, &interval.to])
        .any(|end| end.exact().is_none() && (end.value() - float).abs() <= 1e-12 * float);
    // A single stable value between unstable ones is left out of a set of intervals.
    let grows = |side: i64| {
        let beside = courant_number * (integer(1) + ratio(side, 1 << 40));
        matches!(decide_at(&margin, &beside), PointVerdict::Unstable(_))
    };
    let is_single = stable && grows(1) && grows(-1);
    if !open && !close && !is_single {
        assert_eq!(
            set.contains(courant_number),
            stable,
            "{one_step:?} at {courant_number}: {set:?}"
        );
    }
}

/// `1 + Σ_j C^j (difference stencils)`: keeps constants, powers of C up to 4, so `|g|²` up to 8.
fn random_step() -> impl Strategy<Value = Step> {
    let power = prop::collection::vec(-6i64..=6, 1..4);
    (prop::collection::vec(power, 1..5), prop::bool::ANY, 1i64..12).prop_map(
        |(powers, keeps_constants, scale)| {
            let difference = Stencil::new(-1, vec![integer(-1), integer(1)]);
            let stencils = powers.into_iter().map(|values| {
                let values: Vec<_> = values.into_iter().map(|v| ratio(-v, 3 * scale)).collect();
                let stencil = Stencil::new(-1, values);
                if keeps_constants { stencil * difference.clone() } else { stencil }
            });
            step_of(&[Stencil::shift(0)].into_iter().chain(stencils).collect::<Vec<_>>())
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn random_schemes_are_decided_alike(step in random_step(), at in prop::collection::vec(1i64..400, 6)) {
        prop_assume!(!step.free_parameters().is_empty());
        let set = set_of(&step, integer(4));
        for numerator in at {
            cross_check(&step, &set, &ratio(numerator, 100));
        }
        for interval in &set.intervals {
            // Either side of every end.
            for end in [&interval.from, &interval.to] {
                let Some(value) = crate::exact::rational::from_f64(end.value()) else { continue };
                for side in [ratio(999_999, 1_000_000), ratio(1_000_001, 1_000_000)] {
                    let point = &value * side;
                    if point < integer(4) { cross_check(&step, &set, &point); }
                }
            }
        }
    }
}

/// A real symmetric scheme `g = 1 − q(s, C)` from `q` in powers of `C` and `s`.
fn real_step(q: &[&[Rational]]) -> Step {
    // s = (2 − E − E⁻¹)/4.
    let s = Stencil::new(-1, vec![ratio(-1, 4), ratio(1, 2), ratio(-1, 4)]);
    let mut stencils: Vec<Stencil<Rational>> = q
        .iter()
        .map(|row| {
            row.iter().rev().fold(Stencil::new(0, Vec::new()), |sum, value| {
                sum * s.clone() - Stencil::term(0, value.clone())
            })
        })
        .collect();
    stencils[0] = stencils[0].clone() + Stencil::shift(0);
    step_of(&stencils)
}

#[test]
fn a_root_that_touches_at_one_courant_number_is_passed() {
    // q = C ((s − 1/2)² + (C − 1)²)/4: the wave s = 1/2 is neutral at C = 1 and damped on both sides.
    let zero = integer(0);
    let q: [&[Rational]; 4] =
        [&[zero], &[ratio(5, 16), ratio(-1, 4), ratio(1, 4)], &[ratio(-1, 2)], &[ratio(1, 4)]];
    let step = real_step(&q);
    let margin = margin_of(&step);
    for side in ["999999999/1000000000", "1", "1000000001/1000000000"] {
        assert_eq!(decide_at(&margin, &parse(side).unwrap()), PointVerdict::Stable, "{side}");
    }
    let set = set_of(&step, ratio(3, 2));
    // One interval, or two with a sliver between them that is said to be open: never unstable.
    assert!(set.intervals.iter().all(|interval| interval.to.evidence() == Evidence::Proved));
    for point in [ratio(1, 2), ratio(99, 100), ratio(101, 100), ratio(7, 5)] {
        let float = crate::exact::rational::to_f64(&point);
        let open = set.undecided.iter().any(|(from, to)| *from <= float && float <= *to);
        assert!(set.contains(&point) && !open, "{point}: {set:?}");
    }
}

#[test]
fn a_wave_that_is_neutral_for_every_courant_number_is_no_obstacle() {
    // q = C (s − 1/3)²: touching at an irrational phase, whatever C; stable while q ≤ 2.
    let step = real_step(&[&[integer(0)], &[ratio(1, 9), ratio(-2, 3), integer(1)]]);
    let set = set_of(&step, integer(30));
    // The largest (s − 1/3)² is 4/9 at s = 1.
    assert_eq!(set.limit().exact().unwrap().to_string(), "9/2");
    for point in [ratio(1, 7), ratio(9, 2), ratio(46, 10)] {
        cross_check(&step, &set, &point);
    }
}

#[test]
fn coefficients_of_very_different_size() {
    // Upwind with a diffusion of 10^-30 and an antidiffusion of 10^-12 in C³.
    for (small, power) in [("1e-30", 1), ("-1e-12", 3), ("1e-12", 3), ("1e25", 4)] {
        let backward = Stencil::new(-1, vec![integer(-1), integer(1)]);
        let second = Stencil::new(-1, vec![integer(1), integer(-2), integer(1)]);
        let mut stencils = vec![Stencil::new(0, Vec::new()); 5];
        (stencils[0], stencils[1]) = (Stencil::shift(0), -backward);
        stencils[power] =
            stencils[power].clone() + second * Stencil::term(0, parse(small).unwrap());
        let step = step_of(&stencils);
        let set = set_of(&step, integer(10));
        for point in ["1e-9", "1e-6", "1/2", "999/1000", "1", "1001/1000", "3"] {
            cross_check(&step, &set, &parse(point).unwrap());
        }
    }
}

#[test]
fn limits_are_continuous_where_a_lattice_point_crosses_a_knot() {
    // The cubic spline has continuous curvature: approached from both sides the limits of both schemes
    // meet; q = 1 at ratio k, q = 2 at ratio k/2.
    let small = ratio(1, 1_000_000);
    for at in [ratio(3, 2), integer(2), ratio(5, 2), integer(3)] {
        let limits: Vec<f64> = [&at - &small, at.clone(), &at + &small]
            .into_iter()
            .map(|l| {
                let step = sph("godunov-sph", Kernel::CubicSpline, &l);
                let set = set_of(&step, integer(30));
                assert!(set.undecided.is_empty());
                cross_check(&step, &set, &ratio(3, 2));
                set.limit().value()
            })
            .collect();
        // The limit grows about as fast as the ratio.
        assert!((limits[0] - limits[1]).abs() < 3e-6 && (limits[2] - limits[1]).abs() < 3e-6);
    }
    // The cut Gaussian loses a point of finite weight just below ratio k/3.
    let gaussian = |l: Rational| {
        set_of(&sph("godunov-sph", Kernel::Gaussian, &l), integer(30)).limit().value()
    };
    let (below, at, above) =
        (gaussian(ratio(4, 3) - &small), gaussian(ratio(4, 3)), gaussian(ratio(4, 3) + &small));
    assert!((at - above).abs() < 3e-6 && (at - below).abs() > 1e-5, "{below} {at} {above}");
}

#[test]
fn ratio_fifty_is_decided() {
    let set = set_of(&sph("godunov-sph", Kernel::CubicSpline, &integer(50)), integer(100));
    assert!(set.undecided.is_empty() && set.limit().exact().is_some());
    assert!(set.work.boxes <= 40, "{:?}", set.work);
}

#[test]
fn an_exactly_neutral_scheme_is_stable_at_its_limit_and_not_above() {
    let margin = margin_of(&sph("godunov-sph", Kernel::CubicSpline, &integer(1)));
    assert_eq!(decide_at(&margin, &integer(1)), PointVerdict::Stable);
    let above = integer(1) + parse("1e-60").unwrap();
    assert!(matches!(decide_at(&margin, &above), PointVerdict::Unstable(_)));
}

#[test]
fn a_single_stable_value_is_no_interval() {
    // g = 1 − C³ + C⁴ + (5C + 2C² − 6C³ − C⁴)/3 e^{−iφ}: 1 for every wave at C = 1, unstable on both sides.
    let text = "u[n+1,j] = (1 - C^3 + C^4)*u[n,j] + (5*C + 2*C^2 - 6*C^3 - C^4)/3*u[n,j-1]";
    let step = Step::from_text(text).unwrap();
    let set = set_of(&step, integer(10));
    assert!(!set.contains(&integer(1)), "{set:?}");
    assert_eq!(decide_at(&margin_of(&step), &integer(1)), PointVerdict::Stable);
    cross_check(&step, &set, &integer(1));
}

#[test]
fn enclosed_coefficients_may_leave_it_open_and_never_guess() {
    use crate::exact::interval::Interval;
    use crate::kernel::lattice::LatticeWeights;
    let wide = |value: f64| Interval::new(value - 1e-9, value + 1e-9);
    let weights = LatticeWeights::from_intervals(&[wide(0.5)], &[wide(-2.0), wide(1.0)]).unwrap();
    let lattice = KernelLattice::from_weights(integer(1), weights);
    let of = |scheme: &str| {
        catalogue::scheme(scheme).unwrap().step(Some(&lattice), None, &[], Some("C")).unwrap()
    };
    let step = of("godunov-sph");
    let margin = margin_of(&step);
    assert_eq!(decide_at(&margin, &ratio(99, 100)), PointVerdict::Stable);
    assert_eq!(decide_at(&margin, &integer(1)), PointVerdict::Undecided);
    assert!(matches!(decide_at(&margin, &ratio(101, 100)), PointVerdict::Unstable(_)));
    let limit = set_of(&step, integer(9)).limit();
    assert_eq!(limit.evidence(), Evidence::Enclosed);
    assert!(limit.lower() < 1.0 && limit.upper() > 1.0 && limit.upper() - limit.lower() < 1e-7);
    // Lax–Wendroff's mean drifts by an unknown sign: open from the start.
    let set = set_of(&of("lax-wendroff-sph"), integer(9));
    assert!(set.intervals.is_empty() && !set.undecided.is_empty(), "{set:?}");
}

#[test]
fn at_zero_powers_of_the_parameter_that_came_out_count() {
    let at_zero = |powers: &[&[i64]]| {
        let margin = crate::stability::testing::margin(powers, &integer(0));
        decide_at(&margin, &integer(0)) == PointVerdict::Stable
    };
    // −t and 0 vanish there, t − 1 does not.
    assert!(at_zero(&[&[0], &[-1]]) && at_zero(&[&[0]]) && at_zero(&[&[1], &[-1]]));
    assert!(!at_zero(&[&[-1], &[1]]));
}

#[test]
fn a_polynomial_is_negative_between_roots_however_near_they_are() {
    let polynomial = |values: &[i64]| Polynomial::new(values.iter().map(|&v| integer(v)).collect());
    let line = |root: Rational| Polynomial::new(vec![-root, integer(1)]);
    for bits in [4i64, 20, 300] {
        let gap = power_of_two(-bits);
        // Between 0, 1/2, 3/8 or 1/3 and a little above; −p is negative elsewhere.
        for root in [integer(0), ratio(1, 2), ratio(3, 8), ratio(1, 3)] {
            let (lower, upper) = (root.clone(), root + &gap);
            let valley = line(lower.clone()) * line(upper.clone());
            let found = negative_point(&valley).unwrap();
            assert!(lower < found && found < upper, "{found}");
            let found = negative_point(&-valley).unwrap();
            assert!(found < lower || upper < found, "{found}");
        }
        // Irrational: (s² − 1/2)² is touched twice in no wave, moved down a little it is crossed twice.
        let square = polynomial(&[-1, 0, 2]).pow(2);
        assert_eq!(negative_point(&square), None);
        assert!(negative_point(&(square - Polynomial::constant(gap))).is_some());
    }
}
