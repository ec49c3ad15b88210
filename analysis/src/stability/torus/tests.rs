use super::search::{Objection, Search};
use super::*;
use crate::exact::rational::{Rational, integer, ratio};
use crate::exact::real_roots::power_of_two;
use crate::exact::tensor::{Origin, Tensor};
use crate::interest::Interest;
use crate::scheme::catalogue;
use crate::stability::{Condition, Demands, Evidence, PointVerdict, SearchPlan};
use std::rc::Rc;

#[test]
fn both_roads_agree_in_one_dimension() {
    let mut compared = 0;
    for entry in catalogue::schemes() {
        let Some(parameter) = entry.parameter.as_deref() else { continue };
        let Ok(step) = entry.step(None, None, &[], Some(parameter)) else { continue };
        if step.dimension() != 1 {
            continue;
        }
        // As if its line were a torus.
        let variable = step.names().parameter(parameter);
        let (chi, always) = (step.characteristic().unwrap(), Interest::default());
        let demands = step.demands_on_torus(&chi, variable, &integer(0), &always);
        let Demands::OnTorus(demands) = demands else { continue };
        let plan = SearchPlan::default().up_to(integer(20));
        let known = step.stable_set(parameter, &plan).unwrap();
        let found = stable_set_on_torus(&demands, &plan);
        let name = &entry.name;
        if !found.undecided.is_empty() {
            eprintln!("{name}: {:?} {:?}", found.undecided, found.work);
            continue;
        }
        assert_eq!(found.intervals.len(), known.intervals.len(), "{name}");
        for (found, known) in found.intervals.iter().zip(&known.intervals) {
            assert_ne!(found.to.evidence(), Evidence::Undecided, "{name}");
            for (found, known) in [(&found.from, &known.from), (&found.to, &known.to)] {
                assert_eq!(found.is_unbounded(), known.is_unbounded(), "{name}");
                // Each encloses the limit to 2^−52 of itself, widened where touching waves resist.
                let same = found.lower() <= known.upper() * (1.0 + 1e-13)
                    && known.lower() <= found.upper() * (1.0 + 1e-13);
                assert!(same, "{name}: {found:?} {known:?}");
            }
        }
        compared += 1;
    }
    assert!(compared > 50, "{compared}");
}

/// The sum of terms `c x^k t^m`, given as `([k, m], c)`, on one cell of one axis.
fn demand(terms: &[([usize; 2], i64)]) -> TorusInequality {
    let binding =
        Binding { condition: Condition::PlusOne, on_circle: false, whatever_the_step: false };
    let cell = Cell {
        turns: vec![Turn::Half].into(),
        origin: Rc::new(Origin::Whole),
        polynomial: Tensor::new(vec![2, 3], terms.iter().copied()),
    };
    TorusInequality { binding, cells: vec![cell], thinned: false }
}

/// `Σ c_m t^m`, whatever the wave.
fn whatever_the_wave(values: &[i64]) -> TorusInequality {
    demand(&values.iter().enumerate().map(|(m, c)| ([0, m], *c)).collect::<Vec<_>>())
}

#[test]
fn one_wave_that_grows_is_enough_and_one_open_cell_too() {
    let stable = || demand(&[([0, 0], 1), ([1, 0], -1)]);
    // (3x − 1)², at no corner of any box.
    let open = || demand(&[([0, 0], 1), ([1, 0], -6), ([2, 0], 9)]);
    let unstable = || demand(&[([0, 0], 1), ([1, 0], -2)]);
    let all = [stable, open, unstable];
    for (i, first) in all.iter().enumerate() {
        for (j, second) in all.iter().enumerate() {
            let expected = match decide_on_torus(&[first(), second()], &Interest::default()) {
                PointVerdict::Stable => 0,
                PointVerdict::Undecided => 1,
                PointVerdict::Unstable(wave) => {
                    assert_eq!(wave.phases(), [std::f64::consts::PI]);
                    2
                }
            };
            assert_eq!(expected, i.max(j));
        }
    }
}

#[test]
fn conditions_at_a_value_and_about_it() {
    // 4 − C²
    let demands = |thinned| TorusDemands {
        inequalities: vec![TorusInequality { thinned, ..whatever_the_wave(&[4, -1]) }],
        stride: 2,
    };
    let at = |value: Rational| {
        demands(false).at(&value).map(|all| decide_on_torus(&all, &Interest::default()))
    };
    assert_eq!(at(ratio(3, 2)), Some(PointVerdict::Stable));
    assert!(matches!(at(ratio(5, 2)), Some(PointVerdict::Unstable(_))));
    assert_eq!([at(integer(2)), at(integer(0))], [None, None]);
    assert!(demands(true).at(&ratio(3, 2)).is_none());
    let little = |budget| SearchPlan { budget, ..SearchPlan::default() };
    let about = |value: Rational, budget| demands(false).are_met_about(&value, &little(budget));
    let below = |bits: i64| integer(2) * (integer(1) - power_of_two(-bits));
    assert!(about(integer(1), 9) && about(below(29), 9));
    assert!(!about(integer(1), 0) && !about(below(31), 9) && !about(integer(2), 9));
    let above_one = TorusDemands { inequalities: vec![whatever_the_wave(&[-1, 1])], stride: 1 };
    let above = |bits: i64| integer(1) + power_of_two(-bits);
    assert!(above_one.are_met_about(&above(29), &little(9)));
    assert!(!above_one.are_met_about(&above(31), &little(9)));
}

#[test]
fn stretches_are_proved_or_refuted_within_the_work_that_is_allowed() {
    let stable = |values: &[i64], from: Rational, to: Rational, budget| {
        let all = [whatever_the_wave(values)];
        let mut search = Search::without_guesses(&all, integer(5), budget);
        let found = search.is_stable(&from, &to);
        assert!(search.work.boxes <= budget.max(1));
        match found {
            Ok(()) => "stable".to_string(),
            Err(Objection::Budget) => "open".to_string(),
            Err(Objection::Wave(_, t)) => format!("not at {t}"),
        }
    };
    // t − 1; 2t² − 2t + 1, whose middle Bernstein coefficient is negative until the stretch is halved.
    assert_eq!(stable(&[-1, 1], integer(1), integer(2), 9), "stable");
    assert_eq!(stable(&[-1, 1], integer(0), integer(2), 9), "not at 0");
    assert_eq!(stable(&[1, -1], integer(0), integer(2), 9), "not at 2");
    assert_eq!(stable(&[1, -1], integer(1), integer(1), 9), "stable");
    assert_eq!(stable(&[-1, 1], ratio(1, 2), ratio(1, 2), 9), "not at 1/2");
    assert_eq!(stable(&[-1, 1], integer(1), integer(2), 1), "open");
    let dip: &[i64] = &[3, -12, 13];
    assert_eq!(stable(dip, integer(0), integer(1), 100), "stable");
    assert_eq!(stable(dip, integer(0), integer(1), 3), "open");
    // (3t − 1)² is open however often it is halved, until pieces or boxes are used up.
    assert_eq!(stable(&[1, -6, 9], integer(0), integer(1), 10_000), "open");
    let beyond = |values: &[i64], end: Rational| {
        let all = [whatever_the_wave(values)];
        let mut search = Search::without_guesses(&all, end, 100);
        let found = search.is_stable_beyond();
        assert!(search.work.boxes > 0 || search.end == integer(0));
        found
    };
    assert!(beyond(&[-1, 1], integer(1)) && !beyond(&[-1, 1], ratio(1, 2)));
    assert!(!beyond(&[3, -1], integer(1)) && !beyond(&[1, 1], integer(0)));
}

#[test]
fn how_far_a_wave_is_unstable() {
    let until = |values: &[i64], from: i64| {
        let all = [whatever_the_wave(values)];
        let mut search = Search::without_guesses(&all, integer(5), 100);
        let spot = ExactSpot { inequality: 0, cell: 0, point: vec![integer(0)] };
        let found = search.unstable_until(&integer(from), &spot);
        assert_eq!(search.work.evaluations, 1);
        found
    };
    let close = |found: Option<Rational>, end: &Rational| {
        let found = found.unwrap();
        found < *end && end * (integer(1) - power_of_two(-30)) < found
    };
    assert_eq!(until(&[-1], 0), Some(integer(5)));
    assert_eq!([until(&[1], 0), until(&[-1, 1], 1), until(&[-1, 1], 2)], [None, None, None]);
    // t − 3; −(t − 2)² (3 − t), which touches zero at 2.
    assert!(close(until(&[-3, 1], 0), &integer(3)));
    for from in 0..=2 {
        assert!(close(until(&[-12, 16, -7, 1], from), &integer(3)), "{from}");
    }
    // t² − 2: below the root, to the width of its enclosure.
    let root = until(&[-2, 0, 1], 0).unwrap();
    assert!(&root * &root < integer(2) && &root * &root > integer(2) - power_of_two(-30));
    // 1 − t just above 1, with a spot that is unstable between and not beside.
    assert_eq!(until(&[1, -1], 1), Some(integer(5)));
    let all = [whatever_the_wave(&[2, -3, 1])];
    let mut search = Search::without_guesses(&all, integer(5), 100);
    let spot = ExactSpot { inequality: 0, cell: 0, point: vec![integer(0)] };
    let mut between = |a, b| search.is_unstable_between(&integer(a), &integer(b), &spot);
    assert!(between(1, 2) && !between(0, 1) && !between(1, 3) && !between(2, 3));
}
