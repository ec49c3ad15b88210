//! The counters that guard the speed, the resolution that guards narrow margins, and the edges of decisions, guarded themselves.

use super::{
    FIXED_POINT_BITS, MarginForm, Sign, SignedBox, Work, binomials, exact_cover,
    is_negative_between,
};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, ratio};
use crate::exact::real_roots::power_of_two;
use crate::interest::Interest;
use crate::stability::margin::Margin;
use num_bigint::BigInt;
use num_traits::Zero;

#[test]
fn work_adds_up_count_by_count() {
    let mut work = Work { boxes: 1, evaluations: 20, cells: 300 };
    work += Work { boxes: 4, evaluations: 50, cells: 600 };
    assert_eq!(work, Work { boxes: 5, evaluations: 70, cells: 900 });
}

/// `(3s − 1)² + 2^−bits`: nowhere negative by that little.
fn narrow(bits: i64) -> MarginForm {
    let square = Polynomial::new(vec![integer(1) + power_of_two(-bits), integer(-6), integer(9)]);
    let series: CosineSeries<Rational> =
        CosineSeries::from_powers_of_s(&square, 2).map(|value| value * ratio(1, 16));
    MarginForm::new(&Margin::of_polynomial(&[EnclosedSeries::new(
        series.coefficients(),
        integer(0),
    )]))
}

#[test]
fn a_narrow_margin_is_told_when_asked_for() {
    let decide = |form: &MarginForm| form.sign(&integer(0), &integer(1), 2000).0;
    // 2^−400 is below the unit of the plain form, and above that of one made to resolve it.
    assert_eq!(decide(&narrow(100)), Sign::NowhereNegative);
    assert_eq!(decide(&narrow(400)), Sign::Undecided);
    assert_eq!(decide(&narrow(400).resolving(420)), Sign::NowhereNegative);
}

#[test]
fn the_work_of_a_decision_is_what_it_was() {
    // A touching zero of width 2^−100 in s² is pursued to width 2^−50 in s: one box on either side at each depth.
    let (_, work) = narrow(100).sign(&integer(0), &integer(1), 2000);
    assert!((90..=220).contains(&work.boxes), "{}", work.boxes);
}

#[test]
fn only_what_is_negative_is_called_so() {
    let negative = |coefficients: [i64; 2]| {
        is_negative_between(&coefficients.map(integer), &integer(0), &integer(1))
    };
    // −1 + t touches zero at an end only.
    assert_eq!([[-1, 1], [-1, 0]].map(negative), [Some(true); 2]);
    assert_eq!([[0, 0], [0, 1], [1, 0]].map(negative), [Some(false); 3]);
    assert_eq!(negative([-1, 2]), None);
}

#[test]
fn a_touching_zero_takes_three_boxes_and_two_make_a_cover() {
    // Σ β_i s^i (1 − s)^{2−i}: (1 − 2s)² has Bernstein coefficients 1, −1, 1, on its halves 1, 0, 0 and 0, 0, 1.
    let form = |values: [i64; 3]| MarginForm {
        powers: vec![values.map(BigInt::from).to_vec()],
        radius: vec![BigInt::zero()],
        binomials: binomials(2),
        fixed_point_bits: FIXED_POINT_BITS,
        interest: Interest::default(),
    };
    let touching = form([1, -2, 1]);
    let sign = |boxes| touching.sign(&integer(0), &integer(1), boxes);
    assert_eq!((sign(2).0, sign(2).1.boxes), (Sign::Undecided, 1));
    assert_eq!((sign(3).0, sign(3).1.boxes), (Sign::NowhereNegative, 3));
    let cover = |form: &MarginForm, boxes| exact_cover(form, &integer(0), &integer(1), boxes);
    assert_eq!(cover(&touching, 1), None);
    let half = |from: i64, signs: &str| SignedBox {
        from: ratio(from, 2),
        to: ratio(from + 1, 2),
        signs: vec![signs.into()],
    };
    assert_eq!(cover(&touching, 2), Some(vec![half(0, "+00"), half(1, "00+")]));
    let lost = form([1, -2, 1]).while_wanted(&Interest::as_long_as(|| false));
    assert_eq!(cover(&lost, 2), None);
    // Negative at either end: no number of boxes would do.
    assert_eq!([[-1, 2, 1], [1, 2, -1]].map(|one| cover(&form(one), usize::MAX)), [None, None]);
}
