use super::*;
use crate::exact::rational::ratio;
use crate::stability::testing::margin;

/// `(3s − 1)² + (t − 1)²` touches zero at a wave at which no box has a corner.
fn touching() -> Margin {
    margin(&[&[2, -6, 9], &[-2], &[1]], &integer(0))
}

#[test]
fn widths_grow_by_a_sixteenth_and_are_not_wider_than_the_last() {
    let margin = touching();
    let widths = |bits| Search::new(&margin, &integer(4), bits).widths().collect::<Vec<u32>>();
    assert_eq!(widths(52), [52, 49, 46, 43, 40, 37, 34, 31, 28, 25, 22]);
    assert_eq!((widths(8), &widths(100)[..5]), (vec![8], &[100, 94, 89, 84, 79][..]));
}

#[test]
fn what_is_left_open_is_a_sliver_or_all_of_the_rest() {
    let max = integer(4);
    let run = |margin: &Margin, end: Rational, bits| {
        Search::new(margin, &end, bits).within(60).run(&end, Evidence::Proved)
    };
    // (3s − 1)² + (5t − 4)², as wide as the ends that are asked for.
    let set = run(&margin(&[&[17, -6, 9], &[-40], &[25]], &integer(0)), max.clone(), 8);
    let [(lower, upper)] = set.undecided[..] else { panic!("{set:?}") };
    let [before, after] = &set.intervals[..] else { panic!("{set:?}") };
    assert!((0.79..0.8).contains(&lower) && (0.8..0.81).contains(&upper), "{set:?}");
    assert!(before.to.lower() == lower && after.from.upper() == upper, "{set:?}");
    // The same times 205 + 2560 s − 256 t: where the sliver ends a wave becomes unstable, but not at once from 0 on.
    let powers: [&[i64]; 4] = [
        &[3485, 42_290, -13_515, 23_040],
        &[-12_552, -100_864, -2304],
        &[15_365, 64_000],
        &[-6400],
    ];
    let set = run(&margin(&powers, &integer(0)), max, 8);
    assert!(set.intervals.len() == 1 && set.immediately_unstable.is_none(), "{set:?}");
    assert!(0.79 < set.limit().lower() && set.limit().lower() < 0.8, "{set:?}");
    // 3 − t within 1 is certainly unstable nowhere up to 7/2: all from 2 on is open, once.
    let set = run(&margin(&[&[3], &[-1]], &integer(1)), ratio(7, 2), DEFAULT_BITS);
    let [(lower, upper)] = set.undecided[..] else { panic!("{set:?}") };
    assert!(2.0 - 1e-12 < lower && lower <= 2.0 && upper == 3.5, "{set:?}");
    assert_eq!(set.intervals.len(), 1, "{set:?}");
    // 2 (t − 3)² − 1 within 2: certainly stable again at the end of the range, and nobody knows since when.
    let set = run(&margin(&[&[17], &[-12], &[2]], &integer(2)), integer(5), DEFAULT_BITS);
    let open = set.undecided.iter().map(|open| open.1).collect::<Vec<_>>();
    assert_eq!((set.intervals.len(), &open[..]), (1, &[5.0][..]), "{set:?}");
}

#[test]
fn what_stays_open_at_a_touch_is_stepped_over() {
    let margin = touching();
    let (max, bits) = (integer(4), 40);
    let set = Search::new(&margin, &max, bits).run(&max, Evidence::Proved);
    let [before] = &set.intervals[..] else { panic!("{set:?}") };
    // Looked at beyond as well, until so many boxes are more than a search may take.
    let [touch, rest] = set.undecided[..] else { panic!("{set:?}") };
    assert!(touch.0 < 1.0 && touch.1 >= 1.0 && touch.1 - touch.0 < 1e-11, "{set:?}");
    assert!(touch.1 <= rest.0 && rest.1 == 4.0 && set.work.boxes > MOST_BOXES_IN_ALL, "{set:?}");
    assert_eq!((before.from.value(), before.to.evidence()), (0.0, Evidence::Undecided));
    // Nothing open is left where cells may be asked, and without work nothing is known.
    let all = Search::new(&margin, &max, DEFAULT_BITS).run(&max, Evidence::Proved);
    assert!(all.undecided.is_empty() && all.intervals.len() == 1, "{all:?}");
    let none = Search::new(&margin, &max, bits).within(0).run(&max, Evidence::Proved);
    assert!(none.intervals.is_empty() && none.undecided == [(0.0, 4.0)], "{none:?}");
    // Up to the touch as far as it is known.
    let known = Search::new(&margin, &max, bits).within(0).knowing(&ratio(1, 2));
    let known = known.run(&max, Evidence::Proved);
    assert_eq!(known.limit().lower(), 0.5);
    let open = &known.undecided;
    assert!(open[0].0 == 0.5 && open.last().unwrap().1 == 4.0, "{open:?}");
    assert!(open.windows(2).all(|pair| pair[0].1 == pair[1].0), "{open:?}");
}
