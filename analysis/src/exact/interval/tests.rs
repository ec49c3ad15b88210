//! Every operation against exact fractions: the true result must lie inside, and no farther from the
//! ends than one float.

use super::*;
use crate::exact::rational::ratio;
use num_traits::{One, Signed, Zero};

/// A small generator of its own, so that the cases are the same everywhere (splitmix64).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Floats of every kind: special ones, any bit pattern, neighbours of round numbers.
    fn float(&mut self) -> f64 {
        const SPECIAL: [f64; 14] = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            0.5,
            3.0,
            0.1,
            f64::MAX,
            f64::MIN,
            f64::MIN_POSITIVE,
            5e-324,
            -5e-324,
            f64::EPSILON,
            1e-300,
        ];
        let bits = self.bits();
        match bits % 8 {
            0 => SPECIAL[(bits >> 8) as usize % SPECIAL.len()],
            1 => loop {
                let value = f64::from_bits(self.bits());
                if value.is_finite() {
                    return value;
                }
            },
            2 => ((bits >> 8) % 1000) as f64 - 500.0,
            3 => (((bits >> 8) % 1000) as f64 / 8.0).next_up(),
            _ => {
                let size = 2f64.powi((bits >> 8) as i32 % 60 - 30);
                (self.bits() as f64 / u64::MAX as f64 - 0.5) * size
            }
        }
    }
}

fn exact(value: f64) -> Rational {
    from_f64(value).unwrap()
}

/// The truth lies inside, and between the floats around it the interval has at most `slack` more.
fn check(found: Interval, truth: &Rational, slack: u32, what: &str) {
    let (mut below, mut above) = (to_f64_below(truth), to_f64_above(truth));
    assert!(
        found.lower <= below || from_f64(found.lower).is_some_and(|lower| lower <= *truth),
        "{what}: {found:?}"
    );
    assert!(
        found.upper >= above || from_f64(found.upper).is_some_and(|upper| upper >= *truth),
        "{what}: {found:?}"
    );
    for _ in 0..slack {
        (below, above) = (below.next_down(), above.next_up());
    }
    let tiny = truth.abs() < exact(1e-280);
    assert!(tiny || (found.lower >= below && found.upper <= above), "{what} is wide: {found:?}");
}

#[test]
fn the_four_operations_and_the_square_are_as_tight_as_can_be() {
    let mut random = Random(1);
    for _ in 0..60_000 {
        let (a, b) = (random.float(), random.float());
        let (x, y) = (Interval::point(a), Interval::point(b));
        let (p, q) = (exact(a), exact(b));
        check(x + y, &(&p + &q), 0, &format!("{a:e} + {b:e}"));
        check(x - y, &(&p - &q), 0, &format!("{a:e} - {b:e}"));
        check(x * y, &(&p * &q), 0, &format!("{a:e} * {b:e}"));
        check(x.sqr(), &(&p * &p), 0, &format!("{a:e} squared"));
        if b != 0.0 {
            check(
                x / y,
                &(&p / &q),
                if a.abs() < SMALL { 1 } else { 0 },
                &format!("{a:e} / {b:e}"),
            );
        } else {
            assert_eq!(x / y, Interval::WHOLE);
            assert_eq!(x.divided_by(y), None);
        }
    }
}

#[test]
fn square_roots_square_to_the_number() {
    let mut random = Random(2);
    for _ in 0..60_000 {
        let value = random.float();
        let root = Interval::point(value).sqrt();
        if value < 0.0 {
            assert_eq!(root, None);
            continue;
        }
        let root = root.unwrap();
        let (below, above) = (exact(root.lower), exact(root.upper));
        let truth = exact(value);
        assert!(&below * &below <= truth && truth <= &above * &above, "{value:e}: {root:?}");
        assert!(value < SMALL || root.upper <= root.lower.next_up());
    }
    assert_eq!(Interval::new(-1.0, 4.0).sqrt(), Some(Interval::new(0.0, 2.0)));
}

#[test]
fn powers_contain_the_power() {
    let mut random = Random(3);
    for _ in 0..20_000 {
        let value = (random.bits() as f64 / u64::MAX as f64 - 0.5) * 8.0;
        let exponent = (random.bits() % 13) as i32 - 4;
        let found = Interval::point(value).pow(exponent).unwrap();
        // At most four squarings and four products, each a float wide.
        check(found, &exact(value).pow(exponent), 40, &format!("{value:e} to {exponent}"));
    }
    assert_eq!(Interval::new(-2.0, 1.0).pow(2), Some(Interval::new(0.0, 4.0)));
    assert_eq!(Interval::new(-2.0, 1.0).pow(3), Some(Interval::new(-8.0, 1.0)));
    assert_eq!(Interval::new(-2.0, 1.0).pow(-1), None);
    assert_eq!(Interval::new(-2.0, 1.0).pow(0), Some(Interval::point(1.0)));
}

/// `e^x` between two fractions: `(e^{x/2^k})^{2^k}` with the series and its remainder.
fn exponential(x: &Rational) -> (Rational, Rational) {
    // Rounded outwards to 160 bits, or the fractions would never end.
    let unit = Rational::from(num_bigint::BigInt::one() << 160);
    let down = |value: Rational| (value * &unit).floor() / &unit;
    let up = |value: Rational| (value * &unit).ceil() / &unit;
    let small = x / integer_power(10);
    let (mut lower, mut upper) = (Rational::zero(), Rational::zero());
    let (mut term, mut order) = (Rational::one(), 0);
    while term.abs() > ratio(1, 1 << 62) * ratio(1, 1 << 62) {
        lower += down(term.clone());
        upper += up(term.clone());
        order += 1;
        let next = &term * &small / Rational::from_integer(order.into());
        term = if next.is_negative() { down(next) } else { up(next) };
    }
    // |x|/2^10 < 1: the rest is below twice the first term left out; each rounding is below 2^−160.
    let rest = term.abs() * ratio(2, 1) + ratio(1, 1 << 60) * ratio(1, 1 << 60);
    (lower, upper) = (lower - &rest, upper + &rest);
    for _ in 0..10 {
        (lower, upper) = (down(&lower * &lower), up(&upper * &upper));
    }
    (lower, upper)
}

fn integer_power(bits: u32) -> Rational {
    Rational::from(num_bigint::BigInt::one() << bits)
}

#[test]
fn exponentials_contain_the_exponential() {
    let mut random = Random(4);
    for round in 0..2000 {
        let size = if round % 2 == 0 { 40.0 } else { 2.0 };
        let value = (random.bits() as f64 / u64::MAX as f64 - 0.5) * size;
        let found = Interval::point(value).exp();
        let (lower, upper) = exponential(&exact(value));
        assert!(exact(found.lower) <= lower, "{value:e}: {found:?}");
        assert!(upper <= exact(found.upper), "{value:e}: {found:?}");
        // A few floats for the series, two for each factor of √e.
        let width = (found.upper - found.lower) / found.lower;
        assert!(width < (12.0 + 4.0 * value.abs()) * f64::EPSILON, "{value:e}: {width:e}");
    }
    // The constant √e, squared.
    let (lower, upper) = exponential(&ratio(1, 1));
    let root = [exact(1.648_721_270_700_128), exact(1.648_721_270_700_128_2)];
    assert!(&root[0] * &root[0] < lower && upper < &root[1] * &root[1]);
    assert_eq!(Interval::point(0.0).exp(), Interval::point(1.0));
    assert!(Interval::point(-800.0).exp().lower == 0.0);
    assert_eq!(Interval::point(800.0).exp().upper, f64::INFINITY);
}

#[test]
fn wide_intervals_contain_what_their_members_give() {
    let mut random = Random(5);
    for _ in 0..50_000 {
        let mut ends = [random.float(), random.float(), random.float(), random.float()];
        ends[..2].sort_by(f64::total_cmp);
        ends[2..].sort_by(f64::total_cmp);
        let (x, y) = (Interval::new(ends[0], ends[1]), Interval::new(ends[2], ends[3]));
        let inside = |interval: Interval, bits: u64| {
            let share = bits as f64 / u64::MAX as f64;
            let value = interval.lower * (1.0 - share) + interval.upper * share;
            value.clamp(interval.lower, interval.upper)
        };
        let (a, b) = (inside(x, random.bits()), inside(y, random.bits()));
        let contains = |outer: Interval, inner: Interval| {
            outer.lower <= inner.lower && inner.upper <= outer.upper
        };
        let (p, q) = (Interval::point(a), Interval::point(b));
        assert!(contains(x + y, p + q) && contains(x - y, p - q) && contains(x * y, p * q));
        assert!(contains(x.sqr(), p.sqr()));
        if let (Some(outer), Some(inner)) = (x.divided_by(y), p.divided_by(q)) {
            assert!(contains(outer, inner), "{x:?} / {y:?}");
        }
    }
}

#[test]
fn what_members_give_lies_in_what_intervals_give() {
    // Ends of every kind, infinite ones too; members are the finite ends and what lies between.
    let mut random = Random(5);
    for _ in 0..1500 {
        let [x, y] = [(); 2].map(|()| {
            let (a, b) = (random.float(), random.float());
            match random.bits() % 6 {
                0 => Interval { lower: f64::NEG_INFINITY, upper: a },
                1 => Interval { lower: a, upper: f64::INFINITY },
                _ => Interval::new(a.min(b), a.max(b)),
            }
        });
        let members = |x: Interval| {
            [x.lower.max(f64::MIN), x.upper.min(f64::MAX), x.lower.max(-1.0).min(x.upper)]
        };
        let inside = |found: Interval, truth: &Rational| {
            let above = found.lower == f64::NEG_INFINITY || exact(found.lower) <= *truth;
            above && (found.upper == f64::INFINITY || *truth <= exact(found.upper))
        };
        assert_eq!(x.divided_by(y).is_none(), y.contains(0.0));
        for (p, q) in members(x).into_iter().flat_map(|a| members(y).map(|b| (exact(a), exact(b))))
        {
            assert!(inside(x + y, &(&p + &q)) && inside(x - y, &(&p - &q)), "{x:?} ± {y:?}");
            assert!(inside(x * y, &(&p * &q)), "{x:?} times {y:?}");
            assert!(y.contains(0.0) || inside(x / y, &(&p / &q)), "{x:?} by {y:?}");
            for n in 0..4 {
                assert!(inside(x.pow(n).unwrap(), &p.pow(n)), "{x:?} to {n}");
            }
            assert!(inside(x.sqr(), &(&p * &p)) && !x.sqr().lower.is_sign_negative());
        }
    }
    // The error of this sum of finite floats overflows on the way.
    let (a, b) = (f64::from_bits(0x7fc0_0000_0000_07ce), f64::MIN);
    let (sum, truth) = (Interval::point(a) + Interval::point(b), exact(a) + exact(b));
    assert!(exact(sum.lower) < truth && truth < exact(sum.upper));
    let ends = [f64::INFINITY, f64::NEG_INFINITY].map(|end| Interval::new(end, end));
    assert_eq!(ends[0] + ends[1], Interval::WHOLE);
    let unbounded = Interval::new(4.0, f64::INFINITY);
    assert_eq!(unbounded.sqrt(), Some(Interval::new(2.0, f64::INFINITY)));
    let tiny = f64::from_bits(1);
    assert_eq!(Interval::new(1.0, 2.0) / unbounded, Interval::new(-tiny, 0.5));
    assert_eq!(unbounded / unbounded, Interval::new(-tiny, f64::INFINITY));
    assert_eq!(
        Interval::new(-f64::INFINITY, -8.0) / unbounded,
        Interval::new(-f64::INFINITY, tiny)
    );
    assert_eq!(unbounded * Interval::new(-1.0, 2.0), Interval::WHOLE);
    assert_eq!(unbounded * -unbounded, Interval::new(-f64::INFINITY, -16.0));
    assert_eq!(
        Interval::point(f64::MAX) * Interval::point(2.0),
        Interval::new(f64::MAX, f64::INFINITY)
    );
    assert_eq!(
        Interval::point(f64::MIN) / Interval::point(0.5),
        Interval::new(-f64::INFINITY, f64::MIN)
    );
    assert_eq!(
        [0.0, 4.0].map(|value| Interval::point(value).sqrt()),
        [0.0, 2.0].map(|root| Some(Interval::point(root)))
    );
    let least = f64::from_bits(1);
    assert_eq!(Interval::new(-1000.0, 1000.0).exp(), Interval { lower: 0.0, upper: f64::INFINITY });
    assert_eq!(Interval::point(-746.5).exp(), Interval { lower: 0.0, upper: least });
    assert_eq!(
        (Interval::point(0.0).exp(), Interval::point(711.0).exp().lower),
        (Interval::point(1.0), f64::MAX)
    );
    assert!(!Interval::new(1.0, 2.0).contains(0.5) && !Interval::new(1.0, 2.0).contains(2.5));
    assert_eq!(Interval::WHOLE.center_and_radius(), None);
}
