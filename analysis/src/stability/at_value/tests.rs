use super::*;
use crate::exact::laurent::{VARIABLES, Variable};
use crate::exact::rational::{ratio, to_f64};
use crate::stability::testing::{inequality, margin};
use crate::stability::{Condition, decide_at};

/// What `q(s) + c` within a radius says at `t = 1`, written so that no factor comes out whatever `t`.
fn demand(q: &[i64], c: i64, radius: i64) -> Demands {
    let mut first = q.to_vec();
    first[0] += c - 1;
    let margin = margin(&[&first, &[1]], &integer(radius));
    Demands::All(vec![inequality(Condition::PlusOne, margin)])
}

fn rank<W>(verdict: &PointVerdict<W>) -> usize {
    match verdict {
        PointVerdict::Stable => 0,
        PointVerdict::Undecided => 1,
        PointVerdict::Unstable(_) => 2,
    }
}

fn together(demands: &[Demands]) -> Demands {
    let all = demands.iter().flat_map(|one| match one {
        Demands::All(all) => all.clone(),
        _ => panic!("one dimension"),
    });
    Demands::All(all.collect())
}

/// (2s − 1)², s and 1 − s have the least value 0, inside and at either end; so has 0.
const SHAPES: [&[i64]; 4] = [&[1, -4, 4], &[0, 1], &[1, -1], &[0]];

#[test]
fn what_the_radius_leaves_open_is_not_decided() {
    for shape in SHAPES {
        for c in -2..=2 {
            for radius in 0..=1 {
                let demands = demand(shape, c, radius);
                // Sturm's theorem is another road.
                let Demands::All(all) = &demands else { unreachable!() };
                let other = decide_at(&all[0].margin, &integer(1));
                let Some(at) = DemandsAt::of_parameter(&demands, &integer(1)) else {
                    assert!(shape == [0] && (c, radius) == (0, 0) && rank(&other) == 0);
                    continue;
                };
                let decided = at.decide();
                let case = format!("{shape:?} + {c} within {radius}: {decided:?}");
                match &decided {
                    PointVerdict::Stable => assert!(c - radius >= 0, "{case}"),
                    PointVerdict::Undecided => assert!(c - radius < 0 && c + radius >= 0, "{case}"),
                    PointVerdict::Unstable(wave) => {
                        let s = (0.5 * wave.phases()[0]).sin().powi(2);
                        let value = shape.iter().rev().fold(0.0, |sum, a| sum * s + *a as f64);
                        assert!(c + radius < 0 && value + ((c + radius) as f64) < 0.0, "{case}");
                    }
                }
                assert_eq!(at.are_strict(), c - radius > 0, "{case}");
                assert_eq!(rank(&other), rank(&decided), "{case}");
            }
        }
    }
}

#[test]
fn one_demand_that_is_violated_or_open_is_enough() {
    // Kept with something to spare, kept, open, violated.
    let four = [(2, 0), (0, 0), (0, 1), (-1, 0)].map(|(c, radius)| demand(SHAPES[1], c, radius));
    let place = |demands: &Demands| {
        let at = DemandsAt::of_parameter(demands, &integer(1)).unwrap();
        let place = rank(&at.decide()) + usize::from(!at.are_strict());
        assert_eq!(at.are_strict(), place == 0);
        place
    };
    for (i, first) in four.iter().enumerate() {
        for (j, second) in four.iter().enumerate() {
            assert_eq!(place(&together(&[first.clone(), second.clone()])), i.max(j), "{i} {j}");
        }
    }
    let [nowhere, unknown] = [Demands::Nowhere(2), Demands::Unknown].map(|demands| {
        let at = DemandsAt::of_parameter(&demands, &integer(1)).unwrap();
        (at.decide(), at.are_strict())
    });
    assert_eq!(nowhere, (PointVerdict::Unstable(Wave::new(vec![FRAC_PI_2; 2])), false));
    assert_eq!(unknown, (PointVerdict::Undecided, false));
}

#[test]
fn a_value_at_which_a_condition_says_nothing_is_left_to_the_scheme() {
    // 4 − C² beside what never fails.
    let least = inequality(Condition::PlusOne, margin(&[&[4], &[0], &[-1]], &integer(0)));
    let neutral = inequality(Condition::MinusOne, margin(&[&[0]], &integer(0)));
    let thinned = Inequality { thinned: true, ..least.clone() };
    let found = |all: &[&Inequality], value: Rational| {
        let demands = Demands::All(all.iter().map(|one| (*one).clone()).collect());
        DemandsAt::of_parameter(&demands, &value).map(|at| at.decide())
    };
    let plain: &[&Inequality] = &[&least, &neutral];
    assert_eq!(found(plain, ratio(3, 2)), Some(PointVerdict::Stable));
    assert!(matches!(found(plain, ratio(5, 2)), Some(PointVerdict::Unstable(_))));
    // It vanishes for every wave at 2, and was divided by powers of C.
    assert_eq!([integer(2), integer(0)].map(|value| found(plain, value)), [None, None]);
    // What keeps it was not divided out; what violates it may have been.
    let thin: &[&Inequality] = &[&thinned, &neutral];
    assert_eq!(found(thin, ratio(3, 2)), Some(PointVerdict::Stable));
    assert_eq!(found(thin, ratio(5, 2)), None);
    assert_eq!(found(&[&neutral, &neutral], integer(1)), Some(PointVerdict::Stable));
}

#[test]
fn zeros_are_those_of_the_centre_and_of_the_factors_at_the_ends() {
    // s (1 − s) (4s − 1) in E: 4s = 2 − E − 1/E.
    let wave = |power: i16| {
        let mut exponents = [0; VARIABLES];
        exponents[Variable::axis(0).0] = power;
        exponents
    };
    let terms = [(-1, -1), (0, 2), (1, -1)].map(|(power, value)| (wave(power), value.into()));
    let four_s = || Laurent::new(terms.to_vec());
    let names = Names::default();
    let product = four_s() * (Laurent::integer(4) - four_s()) * (four_s() - Laurent::integer(1));
    let found: Vec<f64> = zeros_of(&product, &names, 60).iter().map(to_f64).collect();
    assert_eq!(found, [0.25, 0.0, 1.0]);
    assert!(zeros_of(&Laurent::default(), &names, 60).is_empty());
    assert!(zeros_of(&Laurent::integer(4), &names, 60).is_empty());
}
