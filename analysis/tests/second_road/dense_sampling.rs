//! Proved answers against dense sampling in arithmetic of fifty digits: a road that shares nothing with the proofs.
//!
//! `|g(φ)|²` is summed in fixed point over the phases `πj/N`. Sampling sees growth when a sample exceeds one; it sees stability
//! when no sample comes near enough to one for a maximum to hide between two samples. It must never contradict the
//! proof.

use courant_analysis::exact::rational::{Rational, from_f64, integer, ratio, to_f64};
use courant_analysis::exact::stencil::Stencil;
use courant_analysis::scheme::Step;
use courant_analysis::stability::SearchPlan;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use proptest::prelude::*;
use std::sync::LazyLock;

/// Half the circle is cut into so many cells.
const CELLS: usize = 512;

/// Bits after the point: fifty digits and a guard for the recurrence below, whose error grows as the square of `CELLS`.
const BITS: u64 = 200;

/// Errors stay below 10^−50 in units of the fixed point.
static NOISE: LazyLock<BigInt> =
    LazyLock::new(|| (BigInt::one() << BITS) / BigInt::from(10).pow(50));

/// `arctan(1/m)`.
fn arctangent(m: i64) -> BigInt {
    let (mut term, mut sum, mut k) = ((BigInt::one() << BITS) / m, BigInt::zero(), 0i64);
    while !term.is_zero() {
        let part = &term / (2 * k + 1);
        sum += if k % 2 == 0 { part } else { -part };
        term /= m * m;
        k += 1;
    }
    sum
}

/// `cos(πj/CELLS)` for a whole turn: Machin's π, Taylor's series, and `cos((j + 1)x) = 2 cos x cos jx − cos((j − 1)x)`.
static COSINES: LazyLock<Vec<BigInt>> = LazyLock::new(|| {
    let pi: BigInt = 4 * (4 * arctangent(5) - arctangent(239));
    let step = pi / CELLS;
    let one = BigInt::one() << BITS;
    let (mut first, mut term, mut k) = (BigInt::zero(), one.clone(), 0);
    while !term.is_zero() {
        first += &term;
        let square: BigInt = (&step * &step) >> BITS;
        term = -((term * square) >> BITS) / ((k + 1) * (k + 2));
        k += 2;
    }
    let mut cosines = vec![one, first.clone()];
    for j in 1..2 * CELLS {
        let next = ((&cosines[j] * &first) >> (BITS - 1)) - &cosines[j - 1];
        cosines.push(next);
    }
    cosines
});

/// The largest `|g|² − 1` over the samples.
fn largest_excess(stencil: &Stencil<Rational>) -> BigInt {
    let fixed = |value: &Rational| (value.numer() << BITS) / value.denom();
    let terms: Vec<(i64, BigInt)> = stencil.terms().map(|(k, value)| (k, fixed(value))).collect();
    let turn = 2 * CELLS as i64;
    let cosine = |index: i64| &COSINES[index.rem_euclid(turn) as usize];
    (0..=CELLS as i64)
        .map(|j| {
            let sum = |shift: i64| -> BigInt {
                let parts = terms.iter().map(|(k, value)| value * cosine(k * j - shift));
                parts.sum::<BigInt>() >> BITS
            };
            // sin x = cos(x − π/2)
            let (re, im) = (sum(0), sum(CELLS as i64 / 2));
            ((&re * &re + &im * &im) >> BITS) - (BigInt::one() << BITS)
        })
        .max()
        .expect("there are samples")
}

/// By how much a maximum of `|g|²` may exceed the nearest sample: half the second derivative, at most
/// `Σ_kl |c_k c_l| (k − l)²`, times the square of half a cell.
fn hidden(stencil: &Stencil<Rational>) -> Rational {
    let mut curvature = integer(0);
    for (k, a) in stencil.terms() {
        for (l, b) in stencil.terms() {
            curvature += (a * b).abs() * integer((k - l) * (k - l));
        }
    }
    // (π/2)² < 5/2
    curvature * ratio(5, 4) / integer((CELLS * CELLS) as i64)
}

#[test]
fn the_cosines_are_right() {
    let near = |found: &BigInt, expected: Rational| {
        let expected = (expected.numer() << BITS) / expected.denom();
        (found - expected).abs() < *NOISE
    };
    assert!(near(&COSINES[CELLS], integer(-1)) && near(&COSINES[CELLS / 2], integer(0)));
    let quarter = &COSINES[CELLS / 4];
    assert!(near(&((quarter * quarter) >> BITS), ratio(1, 2)));
    assert!((&COSINES[2 * CELLS] - (BigInt::one() << BITS)).abs() < *NOISE);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn proofs_and_samples_agree(
        powers in prop::collection::vec(prop::collection::vec(-6i64..=6, 2..6), 1..5),
        keeps_constants in prop::bool::ANY, scale in 3i64..40,
        at in prop::collection::vec(1i64..3000, 12)
    ) {
        let difference = Stencil::new(-1, vec![integer(-1), integer(1)]);
        let stencils: Vec<Stencil<Rational>> = powers.into_iter().map(|values| {
            let stencil = Stencil::new(-2, values.into_iter().map(|v| ratio(v, scale)).collect());
            if keeps_constants { stencil * difference.clone() } else { stencil }
        }).collect();
        let terms = (1..).zip(&stencils).flat_map(|(power, stencil)| stencil.terms().map(move |(k, value)| {
            format!(" - ({value})*C^{power}*u[n,j{k:+}]")
        }));
        let text = format!("u[n+1,j] = u[n,j]{}", terms.collect::<String>());
        let end = integer(3);
        let step = Step::from_text(&text).unwrap();
        prop_assume!(!step.free_parameters().is_empty());
        let set = step.stable_set("C", &SearchPlan::default().up_to(end.clone())).unwrap();
        // Random points, and a little to either side of every end that was proved.
        let mut points: Vec<Rational> = at.into_iter().map(|n| ratio(n, 1000)).collect();
        for interval in &set.intervals {
            for limit in [&interval.from, &interval.to] {
                points.extend([999, 1001].map(|side| from_f64(limit.lower()).unwrap() * ratio(side, 1000)));
            }
        }
        for point in points.into_iter().filter(|point| point.is_positive() && *point < end) {
            let float = to_f64(&point);
            if set.undecided.iter().any(|(from, to)| *from <= float && float <= *to) {
                continue;
            }
            let stencil = (1..).zip(&stencils).fold(Stencil::shift(0), |sum, (power, stencil)| {
                sum - stencil.clone() * Stencil::term(0, point.pow(power))
            });
            let excess = largest_excess(&stencil);
            let unseen = hidden(&stencil);
            let unseen = (unseen.numer() << BITS) / unseen.denom();
            let size: BigInt = stencil.terms().map(|(_, v)| v.abs().ceil().to_integer()).sum();
            let noise = &*NOISE * (&size + 1) * (&size + 1);
            if set.contains(&point) {
                prop_assert!(excess <= noise, "{} is proved stable and sampling sees growth", point);
            } else {
                prop_assert!(
                    excess + unseen + noise > BigInt::zero(),
                    "{} is proved unstable and every sample is far below one", point
                );
            }
        }
    }
}
