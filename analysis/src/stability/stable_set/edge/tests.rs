use super::*;
use crate::exact::rational::ratio;
use crate::interest::Interest;
use crate::stability::DEFAULT_BITS;
use crate::stability::testing::margin;

fn exact(powers: &[&[i64]]) -> Margin {
    margin(powers, &integer(0))
}

fn search(margin: &Margin, end: i64) -> Search<'_> {
    Search::new(margin, &integer(end), DEFAULT_BITS)
}

#[test]
fn stability_returns_where_it_is_proved_to() {
    // (2s − 1)² + t − 1 inside the range of phases, s + t − 1 at its end.
    for powers in [[&[0, -4, 4][..], &[1]], [&[-1, 1], &[1]]] {
        let margin = exact(&powers);
        let edge = |interest: Interest| {
            let mut search = search(&margin, 4).while_wanted(&interest);
            let guess = search.guesses[0].to;
            search.upper_edge(guess)
        };
        let found = edge(Interest::default()).unwrap();
        assert!(found.upper >= integer(1) && found.upper < ratio(1_000_001, 1_000_000));
        assert!(edge(Interest::as_long_as(|| false)).is_none());
    }
}

#[test]
fn roots_are_looked_for_near_the_guess_and_within_the_range() {
    let near = |margin: &Margin, s: Rational, end: i64, guess: f64| {
        search(margin, end).root_near(&s, guess, 1e-3)
    };
    let line = exact(&[&[1], &[-1]]);
    for s in [ratio(1, 2), integer(0)] {
        let root = near(&line, s.clone(), 4, 1.0005).unwrap();
        assert!(root.lower <= integer(1) && integer(1) <= root.upper);
        assert!(near(&line, s.clone(), 4, 1.002).is_none());
        assert!(near(&line, s, 4, 0.998).is_none());
    }
    // A little beyond the end of the range.
    let long = exact(&[&[4_000_000_001], &[-1_000_000_000]]);
    for s in [ratio(1, 2), integer(0)] {
        assert!(near(&long, s.clone(), 4, 4.0).is_none() && near(&long, s, 5, 4.0).is_some());
    }
    // As wide as the data leave it.
    let blurred = margin(&[&[3 << 20], &[-(1 << 20)]], &integer(1));
    for s in [ratio(1, 2), integer(0)] {
        let root = near(&blurred, s, 4, 3.0).unwrap();
        assert!(
            root.lower < integer(3) - ratio(1, 1 << 21)
                && integer(3) + ratio(1, 1 << 21) < root.upper
        );
    }
}

#[test]
fn a_root_of_a_line_is_exact_however_long_and_of_a_constant_there_is_none() {
    // (3^50 − 2^79 t)(1 + t): as long as an enclosure that is no narrower than asked for would not tell.
    let (a, b) = (BigInt::from(3).pow(50), BigInt::from(2).pow(79));
    let value = Rational::new(a.clone(), b.clone());
    let coefficients = vec![a.clone(), &a - &b, -b];
    let root = fraction_or_root(coefficients, to_f64(&value), &integer(0), &integer(2), 60);
    assert_eq!(root.unwrap().exact(), Some(&value));
    let (above, below) = (BigInt::from(3).pow(150), BigInt::from(2).pow(238));
    let value = Rational::new(above.clone(), below.clone());
    let of =
        |coefficients| fraction_or_root(coefficients, to_f64(&value), &integer(0), &integer(2), 60);
    let root = of(vec![-above, below]).unwrap();
    assert!(root.lower == value && root.upper == value);
    assert!(of(vec![1.into(), 0.into()]).is_none());
}

#[test]
fn an_end_is_named_as_a_root_where_it_is_the_only_one() {
    // (t − 1)(t − 2)(t − 3) and s beside it.
    let powers: &[&[i64]] = &[&[-6, 1], &[11], &[-6], &[1]];
    let named = |margin: &Margin, upper: i64, s: Rational| {
        let edge = Edge { lower: ratio(1, 2), upper: ratio(upper, 2), s };
        search(margin, 4).root_of_an_end(&edge).is_some()
    };
    let sharp = exact(powers);
    assert_eq!([named(&sharp, 3, integer(0)), named(&sharp, 7, integer(0))], [true, false]);
    // Nor where a wave is known to some digits, or the data are.
    assert!(!named(&sharp, 3, ratio(1, 1024)));
    assert!(!named(&margin(powers, &ratio(1, 1 << 40)), 3, integer(0)));
}

#[test]
fn zero_is_a_limit_without_a_wave() {
    let margin = exact(&[&[1], &[-1]]);
    let zero = search(&margin, 4).limit(&Edge::zero(), Evidence::Proved);
    assert!(zero.exact().is_some() && zero.critical_wave().is_none());
}

#[test]
fn a_wave_touches_within_the_range_of_phases_and_near_the_guess() {
    let touches = |powers: &[&[i64]], phase: f64, parameter: f64| {
        touching_point(&exact(powers), Critical { phase, parameter }, 60)
    };
    // (2s − 1)² + 1 − t at 1, and the same for s = −1/4 and 5/4.
    let inside: &[&[i64]] = &[&[2, -4, 4], &[-1]];
    let s = touches(inside, 1.57, 1.0005).unwrap();
    assert!((to_f64(&s) - 0.5).abs() < 1e-15);
    assert!(touches(inside, 1.57, 1.01).is_none() && touches(inside, 1.57, 0.99).is_none());
    assert!(touches(&[&[2, 8, 16], &[-1]], 0.1, 1.0).is_none());
    assert!(touches(&[&[26, -40, 16], &[-1]], 3.0, 1.0).is_none());
}
