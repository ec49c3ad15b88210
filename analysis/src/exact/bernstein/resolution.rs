//! The counters that guard the speed, and the resolution that guards narrow margins, guarded themselves.

use super::{MarginForm, Sign, Work};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, ratio};
use crate::exact::real_roots::power_of_two;
use crate::stability::margin::Margin;

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
