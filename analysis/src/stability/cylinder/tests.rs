//! The two roads to the stable set, boxes and cells, against each other; and waves that touch.

use super::*;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::rational::{integer, ratio, to_f64};
use crate::exact::stencil::Stencil;
use crate::kernel::Kernel;
use crate::scheme::testing::{SPH, sph, step_of};
use crate::stability::{Limit, stable_set_of};
use num_traits::{Signed, Zero};
use proptest::prelude::*;

fn cells_of(margin: &Margin, end: &Rational) -> Option<Vec<Cell>> {
    let critical = CriticalPolynomials::new(margin, usize::MAX)?;
    critical.cells(margin, &Rational::zero(), end, 80)
}

/// The stable intervals of `t` that the cells make up: neighbours join, for a closed set has no gap of one point.
fn stable_intervals(cells: &[Cell]) -> Vec<(f64, f64)> {
    let mut intervals: Vec<(f64, f64)> = Vec::new();
    for cell in cells.iter().filter(|cell| cell.unstable_wave.is_none()) {
        let (from, to) = (to_f64(&cell.from.0), to_f64(&cell.to.1));
        match intervals.last_mut() {
            Some(last) if last.1 == from => last.1 = to,
            _ => intervals.push((from, to)),
        }
    }
    intervals
}

/// Boxes and cells give the same intervals of `C`, to a few roundings.
fn compare(margin: &Margin, end: &Rational) -> bool {
    let Some(cells) = cells_of(margin, &end.pow(margin.stride() as i32)) else { return false };
    let set = stable_set_of(margin, end);
    assert!(set.undecided.is_empty(), "{set:?}");
    let expected = stable_intervals(&cells);
    assert_eq!(set.intervals.len(), expected.len(), "{set:?} against {expected:?}");
    let close = |limit: &Limit, t: f64| {
        let value = if limit.value().is_finite() { limit.value() } else { limit.lower() };
        (value.powi(margin.stride() as i32) - t).abs() <= 1e-13 * t
    };
    for (interval, (from, to)) in set.intervals.iter().zip(expected) {
        assert!(
            close(&interval.from, from) && close(&interval.to, to),
            "{interval:?}: {from} {to}"
        );
    }
    true
}

#[test]
fn critical_values_that_are_not_told_apart_or_not_known_have_no_cells() {
    // (t² + t − 3)(100t² + 100t − 301), with s beside it: two roots 0.003 apart.
    let margin = |powers: &[&[i64]]| crate::stability::testing::margin(powers, &integer(0));
    let close = margin(&[&[903, 1], &[-601], &[-501], &[200], &[100]]);
    let critical = CriticalPolynomials::new(&close, usize::MAX).unwrap();
    let cells = |bits| critical.cells(&close, &integer(0), &integer(4), bits).map(|all| all.len());
    assert_eq!([cells(4), cells(80)], [None, Some(3)]);
    // (s − t)²: every t is critical.
    let always = margin(&[&[0, 0, 1], &[0, -2], &[1]]);
    assert!(CriticalPolynomials::new(&always, usize::MAX).is_none());
}

#[test]
fn cells_find_the_limits_of_the_schemes() {
    let mut compared = 0;
    for l in ["1", "11/10", "13/10", "3/2", "2", "5/2", "3"] {
        for scheme in SPH {
            for kernel in [Kernel::CubicSpline, Kernel::WendlandC4] {
                let l = crate::exact::rational::parse(l).unwrap();
                let margin = sph(scheme, kernel, &l).gain_margin("C", &integer(0));
                let margin = margin.unwrap().unwrap();
                compared += usize::from(compare(&margin, &integer(20)));
            }
        }
    }
    // Where every t is critical there are no cells: not met here.
    assert_eq!(compared, 42);
}

/// The margin of `1 − Σ_p C^p S_p`.
fn margin(powers: Vec<Vec<i64>>, scale: i64, growth: i64) -> Margin {
    let stencil = |values: Vec<i64>| {
        Stencil::new(-1, values.into_iter().map(|value| ratio(-value, scale)).collect())
    };
    let stencils: Vec<_> =
        [Stencil::shift(0)].into_iter().chain(powers.into_iter().map(stencil)).collect();
    step_of(&stencils).gain_margin("C", &ratio(growth, 100)).unwrap().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]
    #[test]
    fn boxes_and_cells_agree(
        powers in prop::collection::vec(prop::collection::vec(-6i64..=6, 1..5), 1..5),
        scale in 3i64..30, growth in 0i64..3
    ) {
        prop_assume!(powers.iter().flatten().any(|value| *value != 0));
        let margin = margin(powers, scale, growth);
        prop_assume!(!margin.is_neutral());
        compare(&margin, &integer(4));
    }
}

#[test]
fn an_edge_where_three_waves_meet_is_found() {
    assert!(compare(&margin(vec![vec![0, -3], vec![1, 2, -1]], 16, 1), &integer(4)));
}

/// `P = Σ_j t^j p_j(s)` from coefficients of powers of `s`.
fn margin_of(rows: &[&[i64]]) -> Margin {
    let series: Vec<EnclosedSeries> = rows
        .iter()
        .map(|row| {
            row.iter().rev().fold(EnclosedSeries::constant(integer(0)), |sum, &value| {
                sum.times(&EnclosedSeries::half_versine())
                    .plus(&EnclosedSeries::constant(integer(value)))
            })
        })
        .collect();
    Margin::of_polynomial(&series)
}

#[test]
fn a_wave_that_touches_at_an_irrational_phase_is_passed() {
    // (t² − 2)² + (2s² − 1)²: zero at t = √2, s = √(1/2) alone.
    let touching = margin_of(&[&[5, 0, -4, 0, 4], &[], &[-4], &[], &[1]]);
    let set = stable_set_of(&touching, &integer(10));
    assert_eq!((set.intervals.len(), set.undecided.len()), (1, 0), "{set:?}");
    assert!(set.limit().value().is_infinite() && set.limit().lower() == 10.0);
    // Times (5 − t): the same, and a limit at 5.
    let limited = margin_of(&[&[25, 0, -20, 0, 20], &[-5, 0, 4, 0, -4], &[-20], &[4], &[5], &[-1]]);
    let set = stable_set_of(&limited, &integer(10));
    assert_eq!((set.intervals.len(), set.undecided.len()), (1, 0), "{set:?}");
    assert_eq!(set.limit().exact().unwrap().to_string(), "5");
}

#[test]
fn a_limit_at_an_interior_wave_may_be_a_fraction() {
    // (2s² − 1)² + 3 − 2t: the wave s = √(1/2) is lost at t = 3/2.
    let margin = margin_of(&[&[4, 0, -4, 0, 4], &[-2]]);
    let limit = stable_set_of(&margin, &integer(10)).limit();
    assert_eq!(limit.exact().unwrap().to_string(), "3/2");
    assert!((limit.critical_phase().unwrap() - 2.0 * 0.5f64.powf(0.25).asin()).abs() < 1e-9);
}

#[test]
fn limits_are_roots_of_the_discriminant() {
    // The discriminants of Lax–Wendroff SPH with the cubic spline, from a computer algebra system.
    let equation = |numerator, denominator| {
        let ratio = ratio(numerator, denominator);
        let limit = sph("lax-wendroff-sph", Kernel::CubicSpline, &ratio).limit("C").unwrap();
        let root = limit.equation().expect("the limit is algebraic").clone();
        let (lower, upper) = root.enclosure(200);
        assert!(to_f64(&lower) <= limit.upper() && limit.lower() <= to_f64(&upper));
        assert!((&upper - &lower).is_positive());
        (root.equation("C"), limit)
    };
    let (text, limit) = equation(3, 2);
    assert_eq!(
        text,
        "6553600 C^8 + 1092516864 C^6 - 5630335836 C^4 + 10567062263 C^2 - 7547288967 = 0"
    );
    assert!(limit.upper() <= limit.lower().next_up());
    assert_eq!(
        equation(6, 5).0,
        "424545592537841796875 C^8 - 662884143125384765625 C^6 - 52798685759727909375 C^4 \
         + 380931716564031838525 C^2 - 146034500662094068224 = 0"
    );
    assert_eq!(equation(8, 5).1.equation().unwrap().degree(), 14);
}

#[test]
fn a_critical_value_is_named_only_where_it_lies() {
    let margin = sph("godunov-sph", Kernel::CubicSpline, &integer(2)).gain_margin("C", &integer(0));
    let margin = margin.unwrap().unwrap();
    let critical = CriticalPolynomials::new(&margin, usize::MAX).unwrap();
    let at = ratio(15, 8).pow(margin.stride() as i32);
    let between = |from: Rational, to: Rational| {
        let root =
            critical.root_between(&(&at * (integer(1) + from)), &(&at * (integer(1) + to)))?;
        root.power_as_fraction()
    };
    let small = |bits: i32| ratio(1, 2).pow(bits);
    assert_eq!(between(-small(60), small(60)), Some(at.clone()));
    // It is the only one nearby, but not between these.
    assert_eq!(between(small(50), small(45)), None);
    assert_eq!(between(-small(45), -small(50)), None);
}

#[test]
fn critical_values_that_lie_side_by_side_are_told_apart() {
    // t − 1 at s = 0 and t − 1 − 2^−30 at s = 1.
    let long = 1i64 << 30;
    let margin = crate::stability::testing::margin(&[&[-1, -long], &[1, long - 1]], &integer(0));
    let critical = CriticalPolynomials::new(&margin, usize::MAX).unwrap();
    let width = ratio(1, 1 << 45);
    for value in [integer(1), integer(1) + ratio(1, long)] {
        let number = critical.root_between(&(&value - &width), &(&value + &width)).unwrap();
        assert_eq!(number.power_as_fraction(), Some(value));
    }
    assert!(
        critical.root_between(&(integer(1) - &width), &(integer(1) + ratio(2, long))).is_none()
    );
}
