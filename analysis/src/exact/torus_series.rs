//! Cosine series in as many phases as there are axes: `Σ_m r_m Π_a cos m_a φ_a`.

use super::cosine_series::{CosineSeries, clenshaw};
use num_bigint::BigInt;
use num_traits::Zero;
use std::collections::BTreeMap;

/// Multiples of the phases, one for each of the three axes there may be; 0 along those that are not.
pub(crate) type Orders = [usize; 3];

/// `Σ_m r_m Π_a cos m_a φ_a` with integers; only coefficients that do not vanish are stored.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct TorusSeries(BTreeMap<Orders, BigInt>);

impl TorusSeries {
    /// Adds `value Π_a cos m_a φ_a`.
    pub(crate) fn add(&mut self, orders: Orders, value: BigInt) {
        let sum = self.0.entry(orders).or_default();
        *sum += value;
        if sum.is_zero() {
            self.0.remove(&orders);
        }
    }

    /// The coefficients and where they stand.
    pub(crate) fn terms(&self) -> impl Iterator<Item = (&Orders, &BigInt)> {
        self.0.iter()
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The largest multiple of the phase of an axis.
    pub(crate) fn degree(&self, axis: usize) -> usize {
        self.0.keys().map(|orders| orders[axis]).max().unwrap_or(0)
    }

    /// The value where all phases vanish.
    pub(crate) fn at_zero(&self) -> BigInt {
        self.0.values().sum()
    }

    /// What it is where the phase of one axis vanishes.
    pub(crate) fn without(&self, axis: usize) -> Self {
        let mut rest = Self::default();
        for (orders, value) in &self.0 {
            let mut orders = *orders;
            orders[axis] = 0;
            rest.add(orders, value.clone());
        }
        rest
    }

    /// The difference.
    pub(crate) fn minus(&self, other: &Self) -> Self {
        let mut difference = self.clone();
        other.0.iter().for_each(|(orders, value)| difference.add(*orders, -value));
        difference
    }

    /// The quotient by `s = sin²(φ_a/2)`; `None` where there is a remainder.
    pub(crate) fn divide_by_s(&self, axis: usize) -> Option<Self> {
        self.by_lines(axis, CosineSeries::divide_by_s)
    }

    /// The quotient by `1 − s = cos²(φ_a/2)`; `None` where there is a remainder.
    pub(crate) fn divide_by_complement(&self, axis: usize) -> Option<Self> {
        self.by_lines(axis, CosineSeries::divide_by_complement)
    }

    /// Divides the series in the phase of one axis that belongs to each product of cosines of the others.
    fn by_lines(
        &self,
        axis: usize,
        divide: impl Fn(&CosineSeries<BigInt>) -> Option<CosineSeries<BigInt>>,
    ) -> Option<Self> {
        let mut lines: BTreeMap<Orders, Vec<BigInt>> = BTreeMap::new();
        for (orders, value) in &self.0 {
            let mut others = *orders;
            others[axis] = 0;
            let line = lines.entry(others).or_default();
            line.resize(line.len().max(orders[axis] + 1), BigInt::zero());
            line[orders[axis]] = value.clone();
        }
        let mut quotient = Self::default();
        for (others, line) in lines {
            for (order, value) in
                divide(&CosineSeries::new(line))?.coefficients().iter().enumerate()
            {
                let mut orders = others;
                orders[axis] = order;
                quotient.add(orders, value.clone());
            }
        }
        Some(quotient)
    }
}

/// The same with numbers of another kind, all of them in one array: the orders of the last axis next to each other.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DenseSeries<T> {
    /// How many orders along each axis.
    pub(crate) lengths: Vec<usize>,
    pub(crate) values: Vec<T>,
}

impl<T> DenseSeries<T> {
    /// In so many dimensions, every coefficient passed through `change`.
    pub(crate) fn new(
        series: &TorusSeries,
        dimension: usize,
        change: impl Fn(&BigInt) -> T,
    ) -> Self {
        let lengths: Vec<usize> = (0..dimension).map(|axis| series.degree(axis) + 1).collect();
        let zero = BigInt::zero();
        let values = (0..lengths.iter().product()).map(|place| {
            let mut orders = Orders::default();
            let mut rest = place;
            for (order, length) in orders.iter_mut().zip(&lengths).rev() {
                (*order, rest) = (rest % length, rest / length);
            }
            change(series.0.get(&orders).unwrap_or(&zero))
        });
        Self { values: values.collect(), lengths }
    }
}

impl DenseSeries<f64> {
    /// The value where the phases have these cosines, by Clenshaw's recurrence along one axis inside another.
    #[inline]
    pub(crate) fn at_cosines(&self, cosine: &impl Fn(usize) -> f64) -> f64 {
        nested(&self.values, &self.lengths, 0, cosine)
    }
}

impl DenseSeries<f64> {
    /// `Σ_a d_a ∂/∂φ_a` of the series at these phases, term by term.
    pub(crate) fn slope(&self, phases: &[f64], direction: &[f64]) -> f64 {
        let term = |(place, value): (usize, &f64)| -> f64 {
            let mut rest = place;
            let mut orders = vec![0.0; self.lengths.len()];
            for (order, length) in orders.iter_mut().zip(&self.lengths).rev() {
                (*order, rest) = ((rest % length) as f64, rest / length);
            }
            let along = |axis: usize| {
                let factor = |b: usize| match (orders[b] * phases[b]).sin_cos() {
                    (sine, _) if b == axis => -orders[b] * sine,
                    (_, cosine) => cosine,
                };
                direction[axis] * (0..orders.len()).map(factor).product::<f64>()
            };
            value * (0..orders.len()).map(along).sum::<f64>()
        };
        self.values.iter().enumerate().filter(|(_, value)| **value != 0.0).map(term).sum()
    }
}

fn nested(values: &[f64], lengths: &[usize], axis: usize, cosine: &impl Fn(usize) -> f64) -> f64 {
    let Some((_, inner @ [_, ..])) = lengths.split_first() else {
        return clenshaw(values.iter().copied(), cosine(axis));
    };
    let lines = values.chunks_exact(inner.iter().product());
    clenshaw(lines.map(|line| nested(line, inner, axis + 1, cosine)), cosine(axis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn series() -> impl Strategy<Value = TorusSeries> {
        let term = ([0usize..4, 0usize..3, 0usize..3], -50i64..50);
        prop::collection::vec(term, 1..12).prop_map(|terms| {
            let mut series = TorusSeries::default();
            terms.into_iter().for_each(|(orders, value)| series.add(orders, value.into()));
            series
        })
    }

    fn plain(series: &TorusSeries, phases: [f64; 3]) -> f64 {
        let number = |value: &BigInt| f64::from(i32::try_from(value).unwrap());
        let cosines = |orders: &Orders| -> f64 {
            orders.iter().zip(phases).map(|(&m, phase)| (m as f64 * phase).cos()).product()
        };
        series.terms().map(|(orders, value)| number(value) * cosines(orders)).sum()
    }

    proptest! {
        #[test]
        fn values_are_the_sum_of_cosines(series in series(), phases: [f64; 3]) {
            let phases = phases.map(|phase| phase.rem_euclid(6.0) - 3.0);
            prop_assume!(phases.iter().all(|phase| phase.is_finite()));
            let dense = DenseSeries::new(&series, 3, |value| f64::from(i32::try_from(value).unwrap()));
            let value = dense.at_cosines(&|axis| phases[axis].cos());
            prop_assert!((value - plain(&series, phases)).abs() < 1e-10);
        }

        /// `f − f(φ_a = 0)` has the factor `sin²(φ_a/2)` and its quotient the value that it must have.
        #[test]
        fn what_vanishes_with_a_phase_has_the_factor_s(series in series(), axis in 0usize..3) {
            let rest = series.minus(&series.without(axis));
            let quotient = rest.divide_by_s(axis).unwrap();
            let phases = [0.7, -1.9, 2.6_f64];
            let s = (0.5 * phases[axis]).sin().powi(2);
            prop_assert!((s * plain(&quotient, phases) - plain(&rest, phases)).abs() < 1e-10);
            let without = series.without(axis);
            prop_assert!(without.is_zero() || without.divide_by_s(axis).is_none());
        }
    }
}
