use super::super::{Cell, TorusInequality, Turn};
use super::*;
use crate::exact::rational::{parse, ratio};
use crate::exact::tensor::{Origin, Tensor};
use crate::stability::{Binding, Condition};
use std::f64::consts::PI;
use std::rc::Rc;

/// `Σ c x^k t^m` from `([k, m], c)`, with `x = sin²(φ/2)`.
fn demand(terms: &[([usize; 2], i64)]) -> TorusInequality {
    let degree = |axis: usize| terms.iter().map(|(powers, _)| powers[axis]).max().unwrap_or(0);
    let cell = Cell {
        turns: vec![Turn::Half].into(),
        origin: Rc::new(Origin::Whole),
        polynomial: Tensor::new(vec![degree(0), degree(1)], terms.iter().copied()),
    };
    let binding =
        Binding { condition: Condition::PlusOne, on_circle: false, whatever_the_step: false };
    TorusInequality { binding, cells: vec![cell], thinned: false }
}

/// `Σ c_m t^m` for every wave.
fn alike(values: &[i64]) -> TorusInequality {
    demand(&values.iter().enumerate().map(|(m, c)| ([0, m], *c)).collect::<Vec<_>>())
}

/// `a (64x − 33)² + Σ c_m t^m`: what is between `x = 32/64` and 34/64, where no sample is.
fn between_samples(a: i64, values: &[i64]) -> TorusInequality {
    let square = [([0, 0], 33 * 33 * a), ([1, 0], -2 * 33 * 64 * a), ([2, 0], 64 * 64 * a)];
    let rest = values.iter().enumerate().map(|(m, c)| ([0, m], *c));
    demand(&square.into_iter().chain(rest).collect::<Vec<_>>())
}

fn to_five() -> SearchPlan {
    SearchPlan::default().up_to(integer(5))
}

fn found(inequalities: Vec<TorusInequality>, stride: usize, plan: &SearchPlan) -> StableSet {
    stable_set_on_torus(&TorusDemands { inequalities, stride }, plan)
}

/// The stable intervals where all is decided and every end is a fraction or the end of the range.
fn intervals(inequalities: Vec<TorusInequality>, plan: &SearchPlan) -> Vec<(f64, f64)> {
    let set = found(inequalities, 1, plan);
    assert_eq!(set.undecided, [], "{set:?}");
    let ends = set.intervals.iter().flat_map(|one| [&one.from, &one.to]);
    for end in ends {
        assert_eq!(end.evidence(), Evidence::Proved);
        assert!(end.exact().is_some() || end.upper().is_infinite(), "{end:?}");
    }
    set.intervals.iter().map(|one| (one.from.value(), one.to.value())).collect()
}

const EVER: f64 = f64::INFINITY;

#[test]
fn stretches_are_those_where_the_product_is_not_negative() {
    let of = |values: &[i64]| intervals(vec![alike(values)], &to_five());
    assert_eq!(of(&[1]), [(0.0, EVER)]);
    assert_eq!(of(&[3, -1]), [(0.0, 3.0)]);
    // Which takes one box for each of the two coefficients.
    assert_eq!(found(vec![alike(&[3, -1])], 1, &to_five()).work.boxes, 2);
    assert_eq!(of(&[-1]), []);
    assert_eq!(of(&[-1, 1]), [(1.0, EVER)]);
    // (t − 1)(t − 2)(4 − t), and its negative.
    assert_eq!(of(&[8, -14, 7, -1]), [(0.0, 1.0), (2.0, 4.0)]);
    assert_eq!(of(&[-8, 14, -7, 1]), [(1.0, 2.0), (4.0, EVER)]);
    // (3 − t)(t − 1)² (t − 2), which touches where it is negative.
    assert_eq!(of(&[-6, 17, -17, 7, -1]), [(2.0, 3.0)]);
    // Two conditions: t ≤ 3, and t ≤ 1 or t ≥ 2.
    let both = vec![alike(&[3, -1]), alike(&[2, -3, 1])];
    assert_eq!(intervals(both, &to_five()), [(0.0, 1.0), (2.0, 3.0)]);
    assert_eq!(
        intervals(vec![alike(&[8, -14, 7, -1])], &SearchPlan { first_only: true, ..to_five() }),
        [(0.0, 1.0)]
    );
}

#[test]
fn what_is_beyond_the_range_is_asked_for() {
    let last = |values: &[i64]| {
        let demands = TorusDemands { inequalities: vec![alike(values)], stride: 1 };
        let set = stable_set_on_torus(&demands, &to_five());
        let stretches = stretches_on_torus(&demands, &to_five());
        assert!(stretches.decided && stretches.all.len() == set.intervals.len());
        let kind = match &stretches.all.last().unwrap().to {
            StretchEnd::Edge(..) => "edge",
            StretchEnd::Range => "range",
            StretchEnd::Unbounded => "unbounded",
        };
        let to = &set.intervals.last().unwrap().to;
        assert_eq!((to.is_unbounded(), to.evidence()), (kind == "unbounded", Evidence::Proved));
        assert_eq!(to.lower(), if kind == "edge" { 3.0 } else { 5.0 });
        kind
    };
    assert_eq!([last(&[8, 1]), last(&[8, -1]), last(&[3, -1])], ["unbounded", "range", "edge"]);
}

#[test]
fn what_is_known_needs_no_proof() {
    let from = |known: Rational, values: &[i64]| {
        let plan = SearchPlan { known, ..to_five() };
        let set = found(vec![alike(values)], 1, &plan);
        assert!(set.immediately_unstable.is_none() && set.undecided.is_empty());
        assert!(set.limit().critical_wave().is_some() && set.limit().binding().is_some());
        set.limit().value()
    };
    assert_eq!([from(ratio(1, 2), &[1, -1]), from(integer(1), &[1, -1])], [1.0; 2]);
    // Up to the lower end of what is known of √2, which is as far as the same conditions hold.
    let root = found(vec![alike(&[2, 0, -1])], 1, &to_five()).limit();
    let again = found(vec![alike(&[2, 0, -1])], 1, &to_five().knowing(&root)).limit();
    assert_eq!((again.lower(), again.evidence()), (root.lower(), Evidence::Proved));
    let near = parse("1.41421356237309504880").unwrap();
    let plan = SearchPlan { known: near.clone(), ..to_five() };
    let nearer = found(vec![alike(&[2, 0, -1])], 1, &plan).limit();
    assert_eq!((nearer.certain_lower(), nearer.evidence()), (near, Evidence::Proved));
    // Unstable at once, with the wave and the condition.
    let set = found(vec![alike(&[1]), demand(&[([1, 0], -1)])], 1, &to_five());
    assert!(set.immediately_unstable.unwrap().phases()[0] > 0.0);
    assert_eq!(set.immediate_binding.unwrap().condition, Condition::PlusOne);
    // t (1 − x) − 1: of all waves that grow at once one that does so to the end of the range.
    let demands = || TorusDemands {
        inequalities: vec![demand(&[([0, 0], -1), ([0, 1], 1), ([1, 1], -1)])],
        stride: 1,
    };
    let phase =
        stable_set_on_torus(&demands(), &to_five()).immediately_unstable.unwrap().phases()[0];
    assert!((0.5 * phase).sin().powi(2) >= 0.8, "{phase}");
    assert!(stretches_on_torus(&demands(), &to_five()).unstable_at_once.is_some());
    // That a sample seems to grow is not believed.
    let line = TorusDemands { inequalities: vec![alike(&[1, -1])], stride: 1 };
    let plan = to_five();
    let mut walk = Walk::new(&line, &plan);
    let sample = Spot { inequality: 0, cell: 0, point: vec![0.0] };
    // An edge below what is known to be stable is none.
    let edge = || Edge { lower: integer(1), upper: ratio(1_000_001, 1_000_000), spot: None };
    let closed = walk.closed(&integer(1), edge()).ok();
    assert_eq!(closed.map(|edge| edge.lower), Some(integer(1)));
    assert!(walk.closed(&integer(2), edge()).is_err());
    // Nor one above a wave that is unstable already.
    let above = |bits: i64| integer(1) + power_of_two(-30) + power_of_two(-bits);
    let late = Edge { lower: above(60), upper: above(59), spot: None };
    assert!(matches!(walk.closed(&integer(1), late), Err(Objection::Wave(..))));
    let grows = [0, 1].map(|from| walk.unstable_near(&integer(from), &sample).is_some());
    assert_eq!(grows, [false, true]);
    // Conditions that say nothing leave everything neutral.
    let nothing = || TorusInequality { cells: Vec::new(), ..alike(&[1]) };
    let neutral = |inequalities| found(inequalities, 1, &to_five()).neutral;
    assert!(neutral(vec![nothing()]) && !neutral(vec![nothing(), alike(&[1])]));
}

#[test]
fn instability_goes_from_wave_to_wave() {
    // (t − 1 − x)(t − 2 − x): every wave is unstable for a length of 1, all of them from 1 to 3.
    let moving =
        demand(&[([0, 0], 2), ([1, 0], 3), ([2, 0], 1), ([0, 1], -3), ([1, 1], -2), ([0, 2], 1)]);
    let set = found(vec![moving], 1, &to_five());
    let [first, second] = &set.intervals[..] else { panic!("{set:?}") };
    let phase = |limit: &Limit| limit.critical_wave().unwrap().phases()[0];
    assert_eq!((first.to.value(), phase(&first.to)), (1.0, 0.0));
    assert_eq!((second.from.value(), phase(&second.from)), (3.0, PI));
    // Up to 2 and from 2 on: the single stable value between two unstable stretches is no interval.
    let set = found(vec![alike(&[2, -3, 1]), alike(&[6, -5, 1])], 1, &to_five());
    assert_eq!(set.intervals[0].to.value(), 1.0);
    let contains = |t| set.contains(&t);
    assert!(contains(integer(1)) && !contains(ratio(3, 2)) && !contains(ratio(5, 2)));
    let known = set.intervals.get(1).is_some_and(|next| next.from.lower() == 3.0);
    assert!(known || !set.undecided.is_empty(), "{set:?}");
    // Up to 1 in a band that samples do not see, and from 3 to 4: what is between is not lost.
    let set = found(vec![between_samples(40, &[-1, 1]), alike(&[12, -7, 1])], 1, &to_five());
    let spans = |one: &StableInterval| one.from.lower() < 2.0 && one.from.upper() > 3.0;
    assert!(!set.intervals.iter().any(spans), "{set:?}");
    let open = set.undecided.iter().any(|open| open.0 < 2.0 && open.1 > 2.0);
    assert!(open || set.contains(&integer(2)), "{set:?}");
}

#[test]
fn irrational_ends_are_enclosed_and_roots_of_fractions_known() {
    let encloses_root_of_two = |limit: &Limit| {
        let (lower, upper) = limit.enclosure(0).unwrap();
        assert!(&upper - &lower < ratio(1, 1 << 50), "{limit:?}");
        &lower * &lower < integer(2) && integer(2) < &upper * &upper
    };
    let set = found(vec![alike(&[2, 0, -1])], 1, &to_five());
    assert!(set.undecided.is_empty() && encloses_root_of_two(&set.limit()));
    let set = found(vec![alike(&[-2, 0, 1])], 1, &to_five());
    assert!(set.undecided.is_empty() && encloses_root_of_two(&set.intervals[0].from));
    assert!(set.intervals[0].to.is_unbounded() && set.intervals.len() == 1);
    // t = C²
    let limit = found(vec![alike(&[2, -1])], 2, &to_five()).limit();
    assert_eq!(limit.exact().unwrap().to_string(), "sqrt(2)");
}

#[test]
fn a_touch_that_rounding_takes_for_an_end_is_none() {
    // (5t − 11)² (t + 12), alone and beside 3 − t.
    let touching = || alike(&[1452, -1199, 190, 25]);
    assert_eq!(intervals(vec![touching()], &to_five()), [(0.0, EVER)]);
    assert_eq!(intervals(vec![touching(), alike(&[3, -1])], &to_five()), [(0.0, 3.0)]);
    // (5t² − 31)²: what is beyond √(31/5) is not proved; beside 31 − 5t² it is known to be unstable.
    let touching = || alike(&[961, 0, -310, 0, 25]);
    let close = |set: &StableSet| (set.limit().lower().powi(2) - 6.2).abs() < 1e-12;
    let set = found(vec![touching()], 1, &to_five());
    assert!(close(&set) && set.limit().evidence() == Evidence::Undecided, "{set:?}");
    assert_eq!(set.undecided, [(set.limit().lower(), 5.0)]);
    let set = found(vec![touching(), alike(&[31, 0, -5])], 1, &to_five());
    assert!(close(&set) && set.limit().evidence() == Evidence::Proved, "{set:?}");
    assert!(set.undecided.is_empty() && set.intervals.len() == 1, "{set:?}");
}

#[test]
fn stability_returns_above_a_wave_at_no_corner() {
    // (3x − 1)² + t − 1
    let set = found(vec![demand(&[([1, 0], -6), ([2, 0], 9), ([0, 1], 1)])], 1, &to_five());
    let [only] = &set.intervals[..] else { panic!("{set:?}") };
    assert!(only.to.is_unbounded() && set.undecided.is_empty(), "{set:?}");
    assert!(only.from.lower() == 1.0 && only.from.upper() < 1.0 + 1e-9, "{set:?}");
}

#[test]
fn so_many_stretches_are_followed_and_the_rest_is_left_open() {
    // (4t − 4k − 1)(4t − 4k − 2), unstable for a quarter, 70 times.
    let bands = (0..70).map(|k| alike(&[(4 * k + 1) * (4 * k + 2), -4 * (8 * k + 3), 16]));
    let set = found(bands.collect(), 1, &SearchPlan::default());
    assert_eq!((set.intervals.len(), &set.undecided[..]), (64, &[(63.5, 100.0)][..]));
}

#[test]
fn waves_between_the_samples_are_seen_by_proofs() {
    // Unstable from t = 1 on, in a narrow band.
    let set = found(vec![between_samples(40, &[1, -1])], 1, &to_five());
    let limit = set.limit();
    assert!(limit.evidence() == Evidence::Proved && (limit.value() - 1.0).abs() < 1e-9, "{set:?}");
    let s = (0.5 * limit.critical_wave().unwrap().phases()[0]).sin().powi(2);
    assert!((s - 33.0 / 64.0).abs() < 1e-4, "{limit:?}");
    // At once and for ever, in a band that reaches samples later or never.
    for a in [4, 40] {
        let set = found(vec![between_samples(a, &[-1, -1])], 1, &to_five());
        assert!(set.intervals.is_empty() && set.undecided.is_empty(), "{set:?}");
        assert!(set.immediately_unstable.is_some());
        assert_eq!((set.limit().value(), set.limit().evidence()), (0.0, Evidence::Proved));
    }
    // At once, and up to 1 in the middle of the band.
    let set = found(vec![between_samples(40, &[-1, 1])], 1, &to_five());
    assert!(set.intervals.is_empty() && set.immediately_unstable.is_some(), "{set:?}");
    assert!(!set.contains(&integer(0)) && !set.contains(&ratio(1, 2)));
}

#[test]
fn what_cannot_be_proved_is_left_open_from_the_last_value_that_can() {
    let open = |values: &[i64], plan: &SearchPlan| {
        let set = found(vec![alike(values)], 1, plan);
        assert!(set.limit().evidence() == Evidence::Undecided && !set.undecided.is_empty());
        // Without length there is no interval.
        assert_eq!(set.intervals.is_empty(), set.limit().lower() == 0.0);
        let demands = TorusDemands { inequalities: vec![alike(values)], stride: 1 };
        assert!(!stretches_on_torus(&demands, plan).decided);
        (set.limit().lower(), set.undecided)
    };
    // (5t − 16)² touches zero at no end of a half: half the range is proved, three quarters cannot be; of the way to 4 three quarters.
    assert_eq!(open(&[256, -160, 25], &to_five()), (2.5, vec![(2.5, 5.0)]));
    assert_eq!(open(&[1024, -896, 260, -25], &to_five()), (3.0, vec![(3.0, 5.0)]));
    // Without boxes nothing is.
    let idle = SearchPlan { budget: 0, ..to_five() };
    assert_eq!(open(&[3, -1], &idle), (0.0, vec![(0.0, 5.0)]));
}
