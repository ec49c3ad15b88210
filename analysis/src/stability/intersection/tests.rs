use super::*;
use crate::exact::rational::{integer, ratio};
use crate::stability::Condition::{MinusOne, PlusOne};
use crate::stability::testing::{inequality, margin};

fn plan(bits: u32) -> SearchPlan {
    SearchPlan { bits, ..SearchPlan::default().up_to(integer(4)) }
}

/// `1 − t` for the longest wave and `1 + k/2^m − t` for the wave `s` with `s³ = 1/3³` or `1/2³`.
fn conditions(k: i64, m: u32, inverse_s: i64) -> [Inequality; 2] {
    let unit = 1i64 << m;
    // 64 (s/s_0 − 1)² beside it: samples do not see the wave 1/3, and take the other condition for the first to fail.
    let steep = 64 * unit;
    let shape = [steep + unit + k, -2 * inverse_s * steep, inverse_s * inverse_s * steep];
    let first = inequality(PlusOne, margin(&[&[1, 1], &[-1]], &integer(0)));
    let second = inequality(MinusOne, margin(&[&shape, &[-unit]], &integer(0)));
    [second, first]
}

#[test]
fn ends_whose_enclosures_overlap_are_told_apart_by_what_each_proves() {
    for inverse_s in [2, 3] {
        for (k, m) in [(-1, 10), (-1, 30), (1, 30), (1, 10)] {
            let all = conditions(k, m, inverse_s);
            let set = intersection(&all, &plan(20));
            let [interval] = &set.intervals[..] else { panic!("{set:?}") };
            let (to, first) = (&interval.to, if k < 0 { MinusOne } else { PlusOne });
            assert_eq!(to.binding().unwrap().condition, first, "{k}/2^{m} {to:?}");
            let value = ratio(k.min(0), 1 << m) + integer(1);
            assert!(to.certain_lower() <= value && value <= to.certain_upper().unwrap());
            assert_eq!(to.exact().is_some(), k > 0);
            assert!(set.undecided.is_empty() && !set.neutral && interval.from.upper() == 0.0);
            // The work of each search: of what fails later up to a little above 1 and, where it may end before, up to 1.
            if inverse_s == 3 {
                let work = |one: &Inequality, end: &Rational| {
                    search_within(&one.margin, end, &integer(0), &plan(20)).work
                };
                let one = Limit::exactly(ExactValue::Fraction(integer(1)), Evidence::Proved);
                let mut expected = work(&all[1], &integer(4));
                expected += work(&all[0], &window_end(&one, &integer(4)));
                if (k, m) != (1, 10) {
                    expected += work(&all[0], &integer(1));
                }
                assert_eq!(set.work, expected, "{k}/2^{m}");
            }
        }
    }
}

#[test]
fn the_first_of_two_ends() {
    let exact = |value: i64| Limit::exactly(ExactValue::Fraction(integer(value)), Evidence::Proved);
    let between = |lower, upper, evidence| Limit::between(lower, upper, evidence);
    let infinite = f64::INFINITY;
    let word = |known: &Limit, other: &Limit| match order(known, other) {
        Order::Known => "known".to_string(),
        Order::Other => "other".to_string(),
        Order::Unclear(at) => at.to_string(),
    };
    let met_nothing = between(2.0, infinite, Evidence::Proved);
    assert_eq!(word(&exact(3), &met_nothing), "known");
    assert_eq!(word(&met_nothing, &exact(3)), "other");
    assert_eq!(word(&met_nothing, &met_nothing), "known");
    // What is not decided is no end that lies beyond.
    assert_eq!(word(&exact(3), &between(2.0, infinite, Evidence::Undecided)), "3");
    assert_eq!(
        [exact(2), exact(3), exact(4)].map(|other| word(&exact(3), &other)),
        ["3", "known", "known"]
    );
    assert_eq!(word(&exact(3), &between(2.5, 3.5, Evidence::Enclosed)), "3");
}

#[test]
fn what_another_condition_leaves_open_beyond_the_end_is_not_asked() {
    // 1 − t, and (1 + 3/2 ε) − t within ε, which is open from 1 + ε/2 to 1 + 5/2 ε; and the other way round.
    let unit = 200_000_000;
    let first = inequality(PlusOne, margin(&[&[1, 1], &[-1]], &integer(0)));
    for (offset, open) in [(3, false), (-1, true)] {
        let open_at = margin(&[&[unit + offset, unit], &[-unit]], &integer(2));
        let second = inequality(MinusOne, open_at);
        // Stable at first, whatever is open later.
        let alone = search_within(&second.margin, &integer(1), &integer(0), &plan(52));
        assert!(alone.immediately_unstable.is_none() && !alone.intervals.is_empty());
        let set = intersection(&[first.clone(), second], &plan(52));
        let to = &set.intervals[0].to;
        assert_eq!(set.evidence, Evidence::Enclosed);
        assert!(set.immediately_unstable.is_none() && set.immediate_binding.is_none());
        assert!(to.lower() <= 1.0 && (to.upper() - 1.0).abs() < 2e-8, "{set:?}");
        assert_eq!(to.exact().is_none(), open, "{set:?}");
        assert!(set.undecided.is_empty() || open, "{set:?}");
    }
}

#[test]
fn ranges_and_beginnings_are_those_of_all_conditions() {
    let forever = || inequality(PlusOne, margin(&[&[1, 1], &[1]], &integer(0)));
    let neutral = || inequality(PlusOne, margin(&[&[0]], &integer(0)));
    let till = |end: i64| inequality(MinusOne, margin(&[&[end, 1], &[-1]], &integer(0)));
    let from = |start: i64| inequality(MinusOne, margin(&[&[-start, start], &[1]], &integer(0)));
    let ends = |all: &[Inequality], plan: &SearchPlan| -> Vec<_> {
        let set = intersection(all, plan);
        assert!(set.undecided.is_empty(), "{set:?}");
        assert_eq!(set.neutral, all.iter().all(|one| one.margin.is_neutral()));
        let all = set.intervals.iter();
        all.map(|one| (one.from.value(), one.to.upper(), one.to.is_unbounded())).collect()
    };
    let infinite = f64::INFINITY;
    let wide = plan(52);
    assert_eq!(ends(&[neutral()], &wide), [(0.0, infinite, true)]);
    assert_eq!(ends(&[neutral(), forever()], &wide), [(0.0, infinite, true)]);
    let set = intersection(&[forever()], &wide);
    assert!(set.evidence == Evidence::Proved && set.intervals[0].from.binding().is_none());
    // What is known is not asked for.
    assert_eq!(
        ends(&[from(1)], &SearchPlan { known: integer(1), ..plan(52) }),
        [(0.0, infinite, true)]
    );
    // (1 − t)(2 − t)(3 − t): what was excluded before is not searched again.
    let twice = inequality(PlusOne, margin(&[&[6, 1], &[-11], &[6], &[-1]], &integer(0)));
    let later = inequality(MinusOne, margin(&[&[-3, 3], &[2]], &integer(0)));
    assert_eq!(ends(&[twice, later], &wide), [(2.0, 3.0, false)]);
    // 8 + t (1 − 2s)²: one box up to the end, and three from there to infinity.
    let touching = inequality(PlusOne, margin(&[&[8], &[1, -4, 4]], &integer(0)));
    for (budget, unbounded) in [(2, false), (3, true)] {
        let few = SearchPlan { budget, ..plan(52) };
        assert_eq!(ends(std::slice::from_ref(&touching), &few), [(0.0, infinite, unbounded)]);
    }
    // Ends beyond the range are none within it, and no promise.
    assert_eq!(ends(&[forever(), till(5)], &wide), [(0.0, infinite, false)]);
    assert_eq!(ends(&[from(1), till(5)], &wide), [(1.0, infinite, false)]);
    assert_eq!(ends(&[from(1)], &wide), [(1.0, infinite, true)]);
    assert_eq!(ends(&[from(1), till(3)], &wide), [(1.0, 3.0, false)]);
    assert_eq!(ends(&[till(3), from(2), till(2)], &wide), []);
    assert_eq!(ends(&[from(3), till(2)], &wide), []);
    let set = intersection(&[from(3), till(2)], &wide);
    assert_eq!(set.immediate_binding.unwrap().condition, MinusOne);
    assert!(set.immediately_unstable.is_some() && set.work != Work::default());
    // Of two that fail at once the first is named, though the other one does as well.
    let from_two = inequality(PlusOne, margin(&[&[-2, 2], &[1]], &integer(0)));
    let binding = intersection(&[from(1), from_two], &wide).immediate_binding;
    assert_eq!(binding.unwrap().condition, PlusOne);
    assert_eq!(nowhere(2).limit().value(), 0.0);
    assert!(!nowhere(2).neutral && unknown(&wide).limit().evidence() == Evidence::Undecided);
}

#[test]
fn what_a_condition_leaves_open_is_open_unless_another_fails_there() {
    // (3s − 1)² + (5t − 4)² touches at a wave at which no box has a corner: a sliver, as wide as the ends that are asked for.
    let touching = inequality(PlusOne, margin(&[&[17, -6, 9], &[-40], &[25]], &integer(0)));
    let till_two = inequality(MinusOne, margin(&[&[2, 1], &[-1]], &integer(0)));
    let few = |budget| SearchPlan { budget, ..plan(8) };
    let set = intersection(&[till_two, touching], &few(60));
    let [before, after] = &set.intervals[..] else { panic!("{set:?}") };
    let [(lower, upper)] = set.undecided[..] else { panic!("{set:?}") };
    assert!((0.79..0.8).contains(&lower) && (0.8..0.81).contains(&upper), "{set:?}");
    assert_eq!((before.to.lower(), before.to.evidence()), (lower, Evidence::Undecided));
    assert_eq!((after.from.upper(), after.to.value()), (upper, 2.0));
    // The same times (4t − 1)(2t − 1), beside 2/5 − t, which is not asked for with fewer boxes than one attempt takes.
    let touching = inequality(
        PlusOne,
        margin(&[&[17, -6, 9], &[-142, 36, -54], &[401, -48, 72], &[-470], &[200]], &integer(0)),
    );
    let till_then = inequality(MinusOne, margin(&[&[4, 1], &[-10]], &integer(0)));
    for (budget, open) in [(FIRST_PATIENCE - 1, true), (FIRST_PATIENCE, false)] {
        let set = intersection(&[touching.clone(), till_then.clone()], &few(budget));
        assert_eq!((set.intervals.len(), set.intervals[0].to.value()), (1, 0.25), "{set:?}");
        assert_eq!(!set.undecided.is_empty(), open, "{set:?}");
    }
}

#[test]
fn an_end_and_a_beginning_that_nothing_tells_apart_are_no_interval() {
    // C² ≥ 2 and C² ≤ 2.
    let above = inequality(PlusOne, margin(&[&[-2, 1], &[0], &[1]], &integer(0)));
    let below = inequality(MinusOne, margin(&[&[2, 1], &[0], &[-1]], &integer(0)));
    let set = intersection(&[above, below], &plan(52));
    assert!(set.intervals.is_empty(), "{set:?}");
    assert!(set.undecided.iter().all(|open| (open.0 - 2f64.sqrt()).abs() < 1e-9), "{set:?}");
}

#[test]
fn windows_end_a_little_above_a_limit_and_within_the_range() {
    let exact = |value: i64| Limit::exactly(ExactValue::Fraction(integer(value)), Evidence::Proved);
    let end = window_end(&exact(3), &integer(4));
    assert!(ratio(3, 1) < end && end < ratio(3_000_001, 1_000_000));
    for limit in [exact(4), exact(5), exact(0), Limit::beyond(&integer(4), Evidence::Proved)] {
        assert_eq!(window_end(&limit, &integer(4)), integer(4), "{limit:?}");
    }
}
