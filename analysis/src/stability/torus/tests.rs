use super::guess::{Critical, Spot};
use super::search::{Objection, Search};
use super::*;
use crate::exact::rational::{Rational, integer, ratio};
use crate::exact::real_roots::power_of_two;
use crate::exact::tensor::{Origin, Tensor};
use crate::interest::Interest;
use crate::scheme::catalogue;
use crate::stability::{Condition, Demands, Evidence, PointVerdict, SearchPlan, Wave};
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
    let decided = |one: TorusInequality, from: Rational, to: Rational, budget| {
        let all = [one];
        let mut search = Search::without_guesses(&all, integer(5), budget);
        let found = search.is_stable(&from, &to);
        assert!(search.work.boxes <= budget.max(1));
        let word = match found {
            Ok(()) => "stable".to_string(),
            Err(Objection::Budget) => "open".to_string(),
            Err(Objection::Wave(_, t)) => format!("not at {t}"),
        };
        (word, search.work.boxes)
    };
    let stable =
        |values: &[i64], from, to, budget| decided(whatever_the_wave(values), from, to, budget).0;
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
    // Bernstein coefficients 8, −1, −1, 8: the second of the negative ones is not looked at; those of the halves are all positive.
    let (sag, zero_to) = (whatever_the_wave(&[8, -27, 27]), |end: i64| (integer(0), integer(end)));
    let (from, to) = zero_to(1);
    assert_eq!(decided(sag, from, to, 100), ("stable".to_string(), 3 + 4 + 4));
    // (3x − 1)² (1 − t) − t: what the first end leaves open the last one refutes.
    let (from, to) = zero_to(1);
    let terms = [([0, 0], 1), ([1, 0], -6), ([2, 0], 9), ([0, 1], -2), ([1, 1], 6), ([2, 1], -9)];
    assert_eq!(decided(demand(&terms), from, to, 100).0, "not at 1");
    // At a single value there is nothing to be cut.
    let (word, boxes) = decided(demand(&terms), integer(0), integer(0), 100_000);
    assert!(word == "open" && boxes <= 40_000, "{boxes}");
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
    // Becoming unstable or stable a hair above does not count.
    let hair = 1i64 << 60;
    assert_eq!([until(&[2 * hair + 1, -2 * hair], 1), until(&[-hair - 1, hair], 1)], [None, None]);
    // 1 − t just above 1, with a spot that is unstable between and not beside.
    assert_eq!(until(&[1, -1], 1), Some(integer(5)));
    let all = [whatever_the_wave(&[2, -3, 1])];
    let mut search = Search::without_guesses(&all, integer(5), 100);
    let spot = ExactSpot { inequality: 0, cell: 0, point: vec![integer(0)] };
    let mut between = |a, b| search.is_unstable_between(&integer(a), &integer(b), &spot);
    assert!(between(1, 2) && !between(0, 1) && !between(1, 3) && !between(2, 3));
}

#[test]
fn edges_are_looked_for_next_to_a_guess() {
    let edge = |values: &[i64], parameter: f64| {
        let all = [whatever_the_wave(values)];
        let spot = Spot { inequality: 0, cell: 0, point: vec![0.0] };
        let guess = Critical { parameter, spot };
        Search::without_guesses(&all, integer(5), 100).edge(&guess).map(|edge| edge.lower)
    };
    assert_eq!(edge(&[1, -1], 1.0 + 5e-9), Some(integer(1)));
    assert_eq!([edge(&[1, -1], 1.0 + 5e-7), edge(&[1, 0, -1], 0.0)], [None, None]);
}

#[test]
fn a_factor_of_the_waves_alone_has_the_sign_that_it_has_for_all_of_them() {
    let power = |axis: usize, power: i16| Laurent::power_of(Variable::axis(axis), power);
    let cosine = |axis: usize| power(axis, 1) + power(axis, -1);
    let four_s = |axis: usize| Laurent::integer(2) - cosine(axis);
    // (3 s_x − 1)² + (3 s_y − 1)², whose zero no halving meets.
    let part = |axis: usize| (four_s(axis).scaled(&3.into()) - Laurent::integer(4)).pow(2);
    let touching = part(0) + part(1);
    let parameter = Variable::name(0);
    let rest = || Laurent::integer(1) - Laurent::variable(parameter);
    let of = |factor: Laurent| {
        let requirement = Requirement {
            condition: Condition::PlusOne,
            on_circle: false,
            polynomial: factor * rest(),
            square: Laurent::integer(1),
        };
        TorusInequality::new(&requirement, 2, Some(parameter), 1, &Interest::default()).unwrap()
    };
    // The sign at parameters 0 and 2, for all waves.
    let signs = |one: &TorusInequality| {
        [0, 2].map(|value| {
            let at_value = |cell: &Cell| cell.with_parameter(&integer(value));
            let cells = one.cells.iter().map(at_value).collect();
            match decide_on_torus(&[TorusInequality { cells, ..one.clone() }], &Interest::default())
            {
                PointVerdict::Stable => '+',
                PointVerdict::Unstable(_) => '-',
                PointVerdict::Undecided => '?',
            }
        })
    };
    for (factor, expected, whatever_the_step) in [
        (four_s(0), ['+', '-'], false),
        (-four_s(0), ['-', '+'], false),
        (four_s(0) + four_s(1), ['+', '-'], false),
        (Laurent::integer(4) + cosine(0) + cosine(1), ['+', '-'], false),
        // Neither: some wave is unstable whatever the parameter.
        (cosine(0), ['-', '-'], true),
        (touching.clone(), ['?', '-'], false),
        (touching.clone() * (four_s(0) + four_s(1)), ['?', '-'], false),
        (-touching, ['-', '?'], false),
    ] {
        let one = of(factor.clone());
        assert_eq!(signs(&one), expected, "{factor:?}");
        assert_eq!(one.binding.whatever_the_step, whatever_the_step, "{factor:?}");
        // What has a sign is taken out.
        let is_constant = |cell: &Cell| cell.polynomial.degrees()[..2] == [0, 0];
        let stays = expected.contains(&'?') || whatever_the_step;
        assert_eq!(one.cells.iter().all(is_constant), !stays, "{factor:?}");
        assert!(!one.thinned);
    }
}

#[test]
fn squares_of_the_parameter_are_taken_out_and_remembered() {
    let parameter = Variable::name(0);
    let rest = || Laurent::integer(1) - Laurent::variable(parameter);
    let of = |polynomial: Laurent, square: Laurent| {
        let (condition, on_circle) = (Condition::PlusOne, false);
        let requirement = Requirement { condition, on_circle, polynomial, square };
        TorusInequality::new(&requirement, 2, Some(parameter), 1, &Interest::default()).unwrap()
    };
    let one = || Laurent::integer(1);
    assert!(!of(rest(), one()).thinned && of(rest(), rest()).thinned);
    let cubed = of(rest().pow(3), one());
    assert!(cubed.thinned && cubed.cells.iter().all(|cell| cell.polynomial.degrees()[2] == 1));
    assert!(of(Laurent::default(), one()).cells.is_empty());
}

#[test]
fn phases_have_all_their_digits_next_to_both_ends() {
    use std::f64::consts::PI;
    let small = power_of_two(-80);
    for turn in 0..4u8 {
        for x in [integer(0), ratio(1, 4), ratio(3, 4), integer(1)] {
            let phase = Turn::Quarter(turn).phase(&x);
            // tan(θ/2) = x beyond the turn.
            let expected =
                f64::from(turn) * 0.5 * PI + 2.0 * crate::exact::rational::to_f64(&x).atan();
            let apart = (phase - expected) / (2.0 * PI);
            assert!(
                (apart - apart.round()).abs() < 1e-15 && phase > -PI && phase <= PI,
                "{turn} {x}"
            );
        }
    }
    let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-15;
    let tiny = 0.5f64.powi(80);
    assert!(near(Turn::Quarter(0).phase(&small), 2.0 * tiny));
    assert!(near(Turn::Quarter(3).phase(&(integer(1) - &small)), -tiny));
    // sin²(φ/2) = x
    assert!(near(Turn::Half.phase(&small), 2.0 * tiny.sqrt()));
    let short = PI - Turn::Half.phase(&(integer(1) - &power_of_two(-20)));
    assert!((short - 2.0 * 0.5f64.powi(10).asin()).abs() < 1e-15);
    assert!((PI - Turn::Half.phase(&(integer(1) - small)) - 2.0 * tiny.sqrt()).abs() < 1e-15);
    // Long waves have the direction in which a chart sees them.
    let cell = |origin: Origin| Cell {
        turns: vec![Turn::Quarter(0), Turn::Quarter(0)].into(),
        origin: Rc::new(origin),
        polynomial: Tensor::new(vec![0, 0, 0], [([0, 0, 0], 1)]),
    };
    let chart = Origin::Chart { of: Rc::new(Origin::Whole), axes: vec![0, 1], leader: 0 };
    let long = cell(chart).wave(&[integer(0), ratio(3, 4)]);
    assert_eq!(long.phases(), [0.0, 0.0]);
    let toward = long.direction();
    assert!((toward[0] - 0.8).abs() < 1e-12 && (toward[1] - 0.6).abs() < 1e-12, "{toward:?}");
    let short = cell(Origin::Whole).wave(&[integer(0), integer(1)]);
    assert_eq!((short.phases(), short.direction()), (&[0.0, 0.5 * PI][..], &[0.0, 1.0][..]));
    assert_eq!(Wave::long(&[3.0, -4.0, 1e-15]).direction(), [0.6, -0.8, 0.0]);
}

#[test]
fn what_is_not_real_or_holds_another_name_has_no_cells() {
    let shift = |power: i16| Laurent::power_of(Variable::axis(0), power);
    let [parameter, other] = [0, 1].map(Variable::name);
    let count = |polynomial: &Laurent| {
        piece::cells(polynomial, 2, Some(parameter), 1, &Interest::default())
            .map(|cells| cells.len())
    };
    let real = shift(1) + shift(-1);
    assert_eq!(count(&Laurent::default()), Some(0));
    assert!(count(&(real.clone() + Laurent::variable(parameter))).is_some_and(|cells| cells > 0));
    assert_eq!([count(&shift(1)), count(&(real + Laurent::variable(other)))], [None, None]);
}
