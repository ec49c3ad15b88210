//! Two deciders and plain evaluation against each other, and the hard cases.

use super::*;
use crate::exact::bernstein::{MarginForm, Sign};
use crate::exact::rational::{parse, ratio};
use crate::exact::stencil::Stencil;
use crate::kernel::Kernel;
use crate::scheme::symbol::{EnclosedSymbol, Symbol};
use crate::scheme::{AdvectionScheme, Discretisation, Scheme};
use crate::stability::{Evidence, StableSet, stable_set};
use proptest::prelude::*;

/// `1 − |g|²` from the coefficients alone, exact: `Σ_{k,l} c_k c_l T_{|k−l|}(1 − 2s)`.
fn plain_margin(symbol: &EnclosedSymbol, courant_number: &Rational, s: &Rational) -> Rational {
    let stencil = symbol.center().at_courant_number(courant_number);
    let cosine = integer(1) - s * integer(2);
    let mut chebyshev = vec![integer(1), cosine.clone()];
    for _ in 0..symbol.span() {
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

fn by_boxes(margin: &Margin, courant_number: &Rational) -> Option<bool> {
    let t = courant_number.pow(margin.stride() as i32);
    match MarginForm::new(margin).sign(&t, &t, 2000).0 {
        Sign::NowhereNegative => Some(true),
        Sign::SomewhereNegative { .. } => Some(false),
        Sign::Undecided => None,
    }
}

/// Sturm, Bernstein, the stable set and 33 exactly evaluated waves: none may contradict another.
fn cross_check(symbol: &EnclosedSymbol, set: &StableSet, courant_number: &Rational) {
    let margin = Margin::new(symbol, &integer(0));
    let verdict = decide_at(&margin, courant_number);
    let stable = match &verdict {
        PointVerdict::Stable => true,
        PointVerdict::Unstable(s) => {
            // Where a factor was taken out the margin itself may vanish; nearby it does not.
            let near = |s: &Rational| {
                let step = ratio(1, 1 << 40);
                [s.clone(), s + &step, s - &step]
            };
            let negative = |s: &Rational| plain_margin(symbol, courant_number, s).is_negative();
            assert!(
                near(s).iter().any(|s| *s >= integer(0) && *s <= integer(1) && negative(s)),
                "{symbol:?} at {courant_number}: {s} does not grow"
            );
            false
        }
        PointVerdict::Undecided => panic!("exact coefficients decide everything"),
    };
    for index in 0..=32 {
        let value = plain_margin(symbol, courant_number, &ratio(index, 32));
        assert!(!(stable && value.is_negative()), "{symbol:?} at {courant_number}, wave {index}");
    }
    if let Some(boxes) = by_boxes(&margin, courant_number) {
        assert_eq!(boxes, stable, "{symbol:?} at {courant_number}");
    }
    let float = crate::exact::rational::to_f64(courant_number);
    let open = set.undecided.iter().any(|(from, to)| *from <= float && float <= *to);
    // The ends of the set are enclosed to the last digits of a float.
    let close = set
        .intervals
        .iter()
        .flat_map(|interval| [&interval.from, &interval.to])
        .any(|end| end.exact().is_none() && (end.value() - float).abs() <= 1e-12 * float);
    if !open && !close {
        assert_eq!(set.contains(courant_number), stable, "{symbol:?} at {courant_number}: {set:?}");
    }
}

/// `1 + Σ_j C^j (difference stencils)`: keeps constants, powers of C up to 4, so `|g|²` up to 8.
fn random_symbol() -> impl Strategy<Value = EnclosedSymbol> {
    let power = prop::collection::vec(-6i64..=6, 1..4);
    (prop::collection::vec(power, 1..5), prop::bool::ANY, 1i64..12).prop_map(
        |(powers, keeps_constants, scale)| {
            let difference = Stencil::new(-1, vec![integer(-1), integer(1)]);
            let symbol =
                powers.into_iter().enumerate().fold(Symbol::identity(), |sum, (power, values)| {
                    let values: Vec<_> = values.into_iter().map(|v| ratio(v, 3 * scale)).collect();
                    let stencil = Stencil::new(-1, values);
                    let stencil =
                        if keeps_constants { stencil * difference.clone() } else { stencil };
                    sum - Symbol::courant_power(power + 1, stencil)
                });
            EnclosedSymbol::exact(symbol)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn random_symbols_are_decided_alike(symbol in random_symbol(), at in prop::collection::vec(1i64..400, 6)) {
        let set = stable_set(&symbol, &integer(0), &integer(4));
        for numerator in at {
            cross_check(&symbol, &set, &ratio(numerator, 100));
        }
        for interval in &set.intervals {
            // Either side of every end.
            for end in [&interval.from, &interval.to] {
                let Some(value) = crate::exact::rational::from_f64(end.value()) else { continue };
                for side in [ratio(999_999, 1_000_000), ratio(1_000_001, 1_000_000)] {
                    let point = &value * side;
                    if point < integer(4) { cross_check(&symbol, &set, &point); }
                }
            }
        }
    }
}

/// A real symmetric scheme `g = 1 − q(s, C)` from `q` in powers of `C` and `s`.
fn real_symbol(q: &[&[Rational]]) -> EnclosedSymbol {
    // s = (2 − E − E⁻¹)/4.
    let s = Stencil::new(-1, vec![ratio(-1, 4), ratio(1, 2), ratio(-1, 4)]);
    let symbol = q.iter().enumerate().fold(Symbol::identity(), |sum, (power, row)| {
        let stencil = row.iter().rev().fold(Stencil::new(0, Vec::new()), |sum, value| {
            sum * s.clone() + Stencil::term(0, value.clone())
        });
        sum - Symbol::courant_power(power, stencil)
    });
    EnclosedSymbol::exact(symbol)
}

#[test]
fn a_root_that_touches_at_one_courant_number_is_passed() {
    // q = C ((s − 1/2)² + (C − 1)²)/4: the wave s = 1/2 is neutral at C = 1 and damped on both sides.
    let zero = integer(0);
    let q: [&[Rational]; 4] =
        [&[zero], &[ratio(5, 16), ratio(-1, 4), ratio(1, 4)], &[ratio(-1, 2)], &[ratio(1, 4)]];
    let symbol = real_symbol(&q);
    let margin = Margin::new(&symbol, &integer(0));
    for side in ["999999999/1000000000", "1", "1000000001/1000000000"] {
        assert_eq!(decide_at(&margin, &parse(side).unwrap()), PointVerdict::Stable, "{side}");
    }
    let set = stable_set(&symbol, &integer(0), &ratio(3, 2));
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
    let symbol = real_symbol(&[&[integer(0)], &[ratio(1, 9), ratio(-2, 3), integer(1)]]);
    let set = stable_set(&symbol, &integer(0), &integer(30));
    // The largest (s − 1/3)² is 4/9 at s = 1.
    assert_eq!(set.limit().exact().unwrap().to_string(), "9/2");
    for point in [ratio(1, 7), ratio(9, 2), ratio(46, 10)] {
        cross_check(&symbol, &set, &point);
    }
}

#[test]
fn coefficients_of_very_different_size() {
    // Upwind with a diffusion of 10^-30 and an antidiffusion of 10^-12 in C³.
    for (small, power) in [("1e-30", 1), ("-1e-12", 3), ("1e-12", 3), ("1e25", 4)] {
        let backward = Stencil::new(-1, vec![integer(-1), integer(1)]);
        let second = Stencil::new(-1, vec![integer(1), integer(-2), integer(1)]);
        let symbol = Symbol::identity() - Symbol::courant_power(1, backward)
            + Symbol::courant_power(power, second * Stencil::term(0, parse(small).unwrap()));
        let symbol = EnclosedSymbol::exact(symbol);
        let set = stable_set(&symbol, &integer(0), &integer(10));
        for point in ["1e-9", "1e-6", "1/2", "999/1000", "1", "1001/1000", "3"] {
            cross_check(&symbol, &set, &parse(point).unwrap());
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
                let of = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, l);
                let symbol = of.unwrap().symbol();
                let set = stable_set(&symbol, &integer(0), &integer(30));
                assert!(set.undecided.is_empty());
                cross_check(&symbol, &set, &ratio(3, 2));
                set.limit().value()
            })
            .collect();
        // The limit grows about as fast as the ratio.
        assert!((limits[0] - limits[1]).abs() < 3e-6 && (limits[2] - limits[1]).abs() < 3e-6);
    }
    // The cut Gaussian loses a point of finite weight just below ratio k/3.
    let gaussian = |l: Rational| {
        let of = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::Gaussian, l).unwrap();
        stable_set(&of.symbol(), &integer(0), &integer(30)).limit().value()
    };
    let (below, at, above) =
        (gaussian(ratio(4, 3) - &small), gaussian(ratio(4, 3)), gaussian(ratio(4, 3) + &small));
    assert!((at - above).abs() < 3e-6 && (at - below).abs() > 1e-5, "{below} {at} {above}");
}

#[test]
fn ratio_fifty_is_decided() {
    let of = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(50));
    let set = stable_set(&of.unwrap().symbol(), &integer(0), &integer(100));
    assert!(set.undecided.is_empty() && set.limit().exact().is_some());
    assert!(set.work.boxes <= 40, "{:?}", set.work);
}

#[test]
fn an_exactly_neutral_scheme_is_stable_at_its_limit_and_not_above() {
    let of = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(1));
    let margin = Margin::new(&of.unwrap().symbol(), &integer(0));
    assert_eq!(decide_at(&margin, &integer(1)), PointVerdict::Stable);
    let above = integer(1) + parse("1e-60").unwrap();
    assert!(matches!(decide_at(&margin, &above), PointVerdict::Unstable(_)));
}

#[test]
fn enclosed_coefficients_may_leave_it_open_and_never_guess() {
    use crate::exact::interval::Interval;
    use crate::kernel::lattice::LatticeWeights;
    let wide = |value: f64| Interval::new(value - 1e-9, value + 1e-9);
    let weights = LatticeWeights::from_intervals(&[wide(0.5)], &[wide(-2.0), wide(1.0)]).unwrap();
    let symbol = AdvectionScheme::GodunovSph.with_weights(&weights);
    let margin = Margin::new(&symbol, &integer(0));
    assert_eq!(decide_at(&margin, &ratio(99, 100)), PointVerdict::Stable);
    assert_eq!(decide_at(&margin, &integer(1)), PointVerdict::Undecided);
    assert!(matches!(decide_at(&margin, &ratio(101, 100)), PointVerdict::Unstable(_)));
    let limit = stable_set(&symbol, &integer(0), &integer(9)).limit();
    assert_eq!(limit.evidence(), Evidence::Enclosed);
    assert!(limit.lower() < 1.0 && limit.upper() > 1.0 && limit.upper() - limit.lower() < 1e-7);
    // Lax–Wendroff's mean drifts by an unknown sign: open from the start.
    let symbol = AdvectionScheme::LaxWendroffSph.with_weights(&weights);
    let set = stable_set(&symbol, &integer(0), &integer(9));
    assert!(set.intervals.is_empty() && !set.undecided.is_empty(), "{set:?}");
}
