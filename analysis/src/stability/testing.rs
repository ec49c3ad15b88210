//! Conditions made by hand, for tests.

use super::margin::Margin;
use super::{Condition, Inequality};
use crate::exact::cosine_series::CosineSeries;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, ratio};
use num_traits::Zero;

/// `Σ_j t^j p_j(s)` from the coefficients of the powers of `s`, within a radius.
pub(crate) fn margin(powers: &[&[i64]], radius: &Rational) -> Margin {
    let degree = powers.iter().map(|series| series.len()).max().unwrap_or(1) - 1;
    let scale = ratio(1, 4).pow(degree as i32);
    let series = powers.iter().enumerate().map(|(power, values)| {
        let polynomial = Polynomial::new(values.iter().map(|&value| integer(value)).collect());
        let cosines = CosineSeries::from_powers_of_s(&polynomial, degree);
        let radius = if power == 0 { radius.clone() } else { Rational::zero() };
        EnclosedSeries::new(cosines.map(|value| value * &scale).coefficients(), radius)
    });
    Margin::of_polynomial(&series.collect::<Vec<_>>())
}

/// A margin as a condition.
pub(crate) fn inequality(condition: Condition, margin: Margin) -> Inequality {
    Inequality { condition, on_circle: false, margin, whatever_the_step: false, thinned: false }
}
