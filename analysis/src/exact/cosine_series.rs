//! Cosine series `Σ_m r_m cos mφ`: even trigonometric polynomials, which are polynomials in `cos φ`.

use crate::exact::polynomial::{Polynomial, Ring};
use num_traits::Zero;

/// `Σ_m r_m cos mφ`, stored as `[r_0, r_1, …]` without trailing zeros.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CosineSeries<T> {
    coefficients: Vec<T>,
}

impl<T: Ring> CosineSeries<T> {
    /// From `[r_0, r_1, …]`.
    pub fn new(mut coefficients: Vec<T>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Self { coefficients }
    }

    /// `[r_0, r_1, …]`, the last one non-zero.
    pub fn coefficients(&self) -> &[T] {
        &self.coefficients
    }

    /// The degree in `cos φ`; 0 also for the zero series.
    pub fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
    }

    /// Whether all coefficients vanish.
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// The value at `φ = 0`.
    pub fn at_zero(&self) -> T {
        self.coefficients.iter().fold(T::zero(), |sum, value| sum + value.clone())
    }

    /// The value at `φ = π`.
    pub fn at_pi(&self) -> T {
        self.coefficients.iter().enumerate().fold(T::zero(), |sum, (m, value)| {
            if m % 2 == 0 { sum + value.clone() } else { sum - value.clone() }
        })
    }

    /// The quotient by `s = (1 − cos φ)/2 = sin²(φ/2)`; `None` when the series does not vanish at 0.
    ///
    /// `Σ r_m cos mφ = Σ r_m (cos mφ − 1) = −2 Σ r_m sin²(mφ/2)`, and `sin²(mφ/2)/sin²(φ/2)` is Fejér's
    /// kernel `m + 2 Σ_{j<m} (m − j) cos jφ`. Two running sums give all coefficients.
    pub fn divide_by_s(&self) -> Option<Self> {
        if !self.at_zero().is_zero() {
            return None;
        }
        let mut quotient = vec![T::zero(); self.coefficients.len().saturating_sub(1)];
        // tail = Σ_{m>j} r_m, weighted = Σ_{m>j} (m − j) r_m.
        let (mut tail, mut weighted) = (T::zero(), T::zero());
        for j in (0..quotient.len()).rev() {
            tail = tail + self.coefficients[j + 1].clone();
            weighted = weighted + tail.clone();
            let doubled = weighted.clone() + weighted.clone();
            quotient[j] = if j == 0 { -doubled } else { -(doubled.clone() + doubled) };
        }
        Some(Self::new(quotient))
    }

    /// The quotient by `1 − s = (1 + cos φ)/2`; `None` when the series does not vanish at π.
    pub fn divide_by_complement(&self) -> Option<Self> {
        // φ → π − φ turns cos mφ into (−1)^m cos mφ and 1 − s into s.
        Some(self.mirror().divide_by_s()?.mirror())
    }

    fn mirror(&self) -> Self {
        let signed = self.coefficients.iter().enumerate();
        Self::new(signed.map(|(m, r)| if m % 2 == 0 { r.clone() } else { -r.clone() }).collect())
    }

    /// The same function as a polynomial in `s = (1 − cos φ)/2`, in powers of `s`.
    ///
    /// Clenshaw's recurrence with `2 cos φ = 2 − 4s`.
    pub fn in_powers_of_s(&self) -> Polynomial<T> {
        let twice = |value: &T| value.clone() + value.clone();
        // `factor · (1 − 2s) first − second + value`, the factor 1 or 2.
        let next = |first: &[T], second: &[T], value: &T, doubled: bool| -> Vec<T> {
            let term = |power: usize| -> T {
                let at = |of: &[T], power: usize| of.get(power).cloned().unwrap_or_else(T::zero);
                let below =
                    power.checked_sub(1).map_or_else(T::zero, |below| twice(&at(first, below)));
                let cosine = at(first, power) - below;
                let cosine = if doubled { twice(&cosine) } else { cosine };
                let sum = cosine - at(second, power);
                if power == 0 { sum + value.clone() } else { sum }
            };
            (0..=first.len()).map(term).collect()
        };
        let Some((constant, rest)) = self.coefficients.split_first() else {
            return Polynomial::zero();
        };
        let (mut first, mut second) = (Vec::new(), Vec::new());
        for value in rest.iter().rev() {
            let sum = next(&first, &second, value, true);
            second = std::mem::replace(&mut first, sum);
        }
        Polynomial::new(next(&first, &second, constant, false))
    }

    /// `4^n Σ_i a_i s^i` for a polynomial of degree at most `n`: the way back from
    /// [`in_powers_of_s`](Self::in_powers_of_s) without fractions.
    ///
    /// Horner's rule with `4s cos mφ = 2 cos mφ − cos (m+1)φ − cos (m−1)φ`.
    pub fn from_powers_of_s(polynomial: &Polynomial<T>, n: usize) -> Self {
        let four = (T::one() + T::one()) * (T::one() + T::one());
        let mut power = T::one();
        let mut series: Vec<T> = vec![T::zero(); n + 2];
        for degree in (0..=n).rev() {
            let mut next = vec![T::zero(); n + 2];
            for (m, value) in series.iter().enumerate().take(n + 1 - degree) {
                next[m] = next[m].clone() + value.clone() + value.clone();
                next[m + 1] = next[m + 1].clone() - value.clone();
                let below = m.abs_diff(1);
                next[below] = next[below].clone() - value.clone();
            }
            next[0] = next[0].clone() + polynomial.coefficient(degree) * power.clone();
            series = next;
            power = power * four.clone();
        }
        Self::new(series)
    }

    /// Every coefficient passed through `change`, which may change the ring.
    pub fn map<U: Ring>(&self, change: impl FnMut(&T) -> U) -> CosineSeries<U> {
        CosineSeries::new(self.coefficients.iter().map(change).collect())
    }
}

impl CosineSeries<f64> {
    /// The value where `cos φ = cosine`, by Clenshaw's recurrence.
    #[inline]
    pub fn at_cosine(&self, cosine: f64) -> f64 {
        clenshaw(self.coefficients.iter().copied(), cosine)
    }
}

/// `Σ_m r_m cos mφ` where `cos φ = cosine`, by Clenshaw's recurrence.
#[inline]
pub(crate) fn clenshaw(mut coefficients: impl DoubleEndedIterator<Item = f64>, cosine: f64) -> f64 {
    let twice = 2.0 * cosine;
    let (mut first, mut second) = (0.0, 0.0);
    let Some(constant) = coefficients.next() else { return 0.0 };
    for value in coefficients.rev() {
        // No `mul_add`: where the target has no such instruction it is a slow library call.
        (first, second) = (twice * first + (value - second), first);
    }
    cosine * first + (constant - second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn series() -> impl Strategy<Value = Vec<i64>> {
        prop::collection::vec(-50i64..50, 0..12)
    }

    fn plain(coefficients: &[i64], phase: f64) -> f64 {
        coefficients.iter().zip(0..).map(|(&r, m)| r as f64 * (f64::from(m) * phase).cos()).sum()
    }

    proptest! {
        #[test]
        fn clenshaw_is_the_sum_of_cosines(coefficients in series(), phase in 0.0f64..3.2) {
            let fast = CosineSeries::new(coefficients.clone()).map(|&r| r as f64).at_cosine(phase.cos());
            // Twelve terms of size 50, error growth at most the degree squared.
            prop_assert!((fast - plain(&coefficients, phase)).abs() < 1e-10);
        }

        #[test]
        fn powers_of_s_are_the_same_function(coefficients in series(), phase in 0.0f64..3.2) {
            let s = (phase / 2.0).sin().powi(2);
            let polynomial = CosineSeries::new(coefficients.clone()).in_powers_of_s();
            let condition: f64 =
                polynomial.coefficients().iter().rev().fold(0.0, |sum, &c| sum * s + (c as f64).abs());
            let value = polynomial.map(|&c| c as f64).evaluate(&s);
            prop_assert!((value - plain(&coefficients, phase)).abs() < 1e-13 * (condition + 100.0));
        }

        #[test]
        fn powers_of_s_lead_back(coefficients in series()) {
            let series = CosineSeries::new(coefficients);
            let n = series.coefficients().len();
            let back = CosineSeries::from_powers_of_s(&series.in_powers_of_s(), n);
            prop_assert_eq!(back, series.map(|&r| r * 4i64.pow(n as u32)));
        }

        #[test]
        fn the_factor_s_comes_out_exactly(coefficients in series()) {
            let quotient = CosineSeries::new(coefficients);
            // Multiply by s = 1/2 − cos φ/2 on the other road: powers of s shifted by one.
            let product: Vec<i64> = {
                let mut values = vec![0; quotient.coefficients().len() + 2];
                for (m, &r) in quotient.coefficients().iter().enumerate() {
                    // 4 s cos mφ = 2 cos mφ − cos (m+1)φ − cos (m−1)φ
                    values[m] += 2 * r;
                    values[m + 1] -= r;
                    values[m.abs_diff(1)] -= r;
                }
                values
            };
            let product_for_mirror = product.clone();
            let divided = CosineSeries::new(product).divide_by_s().unwrap();
            prop_assert_eq!(divided, quotient.map(|&r| 4 * r));
            // The other end is the mirror image: s q(s) = (1 − s') q'(s').
            let mirrored = CosineSeries::new(quotient.coefficients().iter().zip(0i64..)
                .map(|(&r, m)| if m % 2 == 0 { 4 * r } else { -4 * r }).collect());
            let product_mirrored = CosineSeries::new(product_for_mirror)
                .mirror().divide_by_complement().unwrap();
            prop_assert_eq!(product_mirrored, mirrored);
        }

        #[test]
        fn ends_are_evaluations(coefficients in series()) {
            let series = CosineSeries::new(coefficients.clone());
            prop_assert_eq!(series.at_zero() as f64, plain(&coefficients, 0.0));
            let at_pi = plain(&coefficients, std::f64::consts::PI);
            prop_assert!((series.at_pi() as f64 - at_pi).abs() < 1e-9);
            if series.at_zero() != 0 { prop_assert!(series.divide_by_s().is_none()); }
        }
    }
}
