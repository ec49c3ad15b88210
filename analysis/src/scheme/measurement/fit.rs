//! Measured coefficients as polynomials in the parameter, as fractions where they are fractions.

use super::experiment::MeasuredStencil;
use super::from_stencil::{Place, StencilTerm};
use super::layout::StateLayout;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, from_f64, integer, simplest_between, to_f64};
use crate::scheme::{SchemeError, Step};
use num_traits::{Signed, Zero};
use std::collections::BTreeMap;
use thiserror::Error;

/// The largest degree that is tried.
pub const MOST_DEGREE: usize = 8;

/// Values left over to verify a fit: fewer would be no test.
const VERIFICATIONS: usize = 2;

/// A fraction `p/q` counts as recognised where chance would find one with so small a `q` this rarely.
const CHANCE: f64 = 1e-4;

/// Growth per step up to this many tolerances is not told from none where coefficients are decimals.
const OF_GROWTH: f64 = 1e4;

/// A step that was measured, as a scheme.
#[derive(Debug, Clone)]
pub struct MeasuredStep {
    /// The scheme; what is said of it is measured, not proved.
    pub step: Step,
    /// The parameter, where a coefficient depends on it.
    pub parameter: Option<String>,
    /// Time levels it starts from.
    pub levels: usize,
    /// Its coefficients.
    pub terms: Vec<StencilTerm>,
    /// Whether all coefficients were recognised as fractions; else they are decimals within the tolerance.
    pub recognised: bool,
    /// Growth per step that is not told from none: 0 where coefficients are fractions.
    pub growth: Rational,
    /// Values of the parameter that a fit did not use and that confirm it; of the coefficient with the fewest.
    pub verifications: usize,
}

/// Why there is no scheme.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoFit {
    /// A coefficient that no polynomial gives.
    #[error(
        "the coefficient of old {column} in new {row} at offset {offset:?} is no polynomial in {parameter} of degree up to {degree}, and a limit needs polynomials; with a value written out in place of {parameter} that step is judged"
    )]
    NotPolynomial {
        /// The unknown that is computed.
        row: String,
        /// The unknown that is read.
        column: String,
        /// Cells from one to the other.
        offset: Vec<i64>,
        /// The parameter.
        parameter: String,
        /// The largest degree tried.
        degree: usize,
    },
    /// The scheme that comes out is none.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
}

impl MeasuredStep {
    /// From stencils measured at several values of a parameter, or from a single one. At least one more than [`MOST_DEGREE`] and two to
    /// verify are needed for what has that degree; of fewer values lower degrees are tried.
    ///
    /// # Errors
    /// When a coefficient is no polynomial in the parameter.
    ///
    /// # Panics
    /// When there is no stencil.
    pub fn fit(
        layout: &StateLayout,
        unknowns: &[String],
        parameter: Option<&str>,
        measured: &[(Rational, MeasuredStencil)],
    ) -> Result<Self, NoFit> {
        assert!(!measured.is_empty(), "something was measured");
        let tolerance = measured.iter().map(|(_, one)| one.tolerance).fold(0.0, f64::max);
        let nodes: Vec<Rational> = measured.iter().map(|(value, _)| value.clone()).collect();
        let mut values: BTreeMap<&Place, Vec<f64>> = BTreeMap::new();
        for (number, (_, stencil)) in measured.iter().enumerate() {
            for (place, value) in &stencil.coefficients {
                values.entry(place).or_insert_with(|| vec![0.0; measured.len()])[number] = *value;
            }
        }
        let (mut terms, mut recognised, mut verifications) = (Vec::new(), true, nodes.len() - 1);
        for (place, values) in values {
            let fit = Fit::new(&nodes, &values, tolerance).ok_or_else(|| NoFit::NotPolynomial {
                row: unknowns[place.row].clone(),
                column: unknowns[place.column].clone(),
                offset: place.offset.clone(),
                parameter: parameter.unwrap_or_default().into(),
                degree: most_degree(nodes.len()),
            })?;
            recognised &= fit.recognised;
            verifications = verifications.min(nodes.len() - 1 - fit.degree);
            terms.push(StencilTerm { place: place.clone(), coefficient: fit.polynomial });
        }
        let varies =
            |term: &StencilTerm| term.coefficient.degree().is_some_and(|degree| degree > 0);
        let parameter = parameter.filter(|_| terms.iter().any(varies));
        let dimension = layout.size.len();
        let step = Step::from_stencil(unknowns, dimension, layout.levels, parameter, &terms)?;
        let growth = if recognised { 0.0 } else { OF_GROWTH * tolerance };
        Ok(Self {
            step: Step { measured: true, ..step },
            parameter: parameter.map(String::from),
            levels: layout.levels,
            terms,
            recognised,
            growth: from_f64(growth).expect("a tolerance is finite"),
            verifications,
        })
    }
}

/// The largest degree that so many values settle.
fn most_degree(values: usize) -> usize {
    values.saturating_sub(1 + VERIFICATIONS).min(MOST_DEGREE)
}

/// A polynomial through some measured values that the others confirm.
struct Fit {
    polynomial: Polynomial<Rational>,
    degree: usize,
    recognised: bool,
}

impl Fit {
    /// The polynomial of the lowest degree within the tolerance.
    fn new(nodes: &[Rational], values: &[f64], tolerance: f64) -> Option<Self> {
        (0..=most_degree(nodes.len()))
            .find_map(|degree| Self::of_degree(degree, nodes, values, tolerance))
    }

    fn of_degree(
        degree: usize,
        nodes: &[Rational],
        values: &[f64],
        tolerance: f64,
    ) -> Option<Self> {
        // Spread over the range: predictions are then between measured values.
        let last = nodes.len() - 1;
        let used = (0..=degree).map(|i| (i * last).checked_div(degree).unwrap_or(last / 2));
        let used: Vec<usize> = used.collect();
        let basis = lagrange(&used.iter().map(|&i| &nodes[i]).collect::<Vec<_>>());
        let exact = |value: f64| from_f64(value).expect("measured numbers are finite");
        let through = used
            .iter()
            .zip(&basis)
            .fold(Polynomial::zero(), |sum, (&i, one)| sum + one.scale(&exact(values[i])));
        let agrees = |polynomial: &Polynomial<Rational>, slack: f64| {
            nodes.iter().zip(values).all(|(node, &value)| {
                let amplified: f64 =
                    basis.iter().map(|one| to_f64(&one.evaluate(node)).abs()).sum();
                (to_f64(&polynomial.evaluate(node)) - value).abs() <= slack * (1.0 + amplified)
            })
        };
        if !agrees(&through, tolerance) {
            return None;
        }
        // Each coefficient within what the measured values may be wrong by.
        let mut recognised = true;
        let short = (0..=degree).map(|power| {
            let amplified: f64 =
                basis.iter().map(|one| to_f64(&one.coefficient(power)).abs()).sum();
            let radius = exact(tolerance * amplified);
            let value = through.coefficient(power);
            let fraction = simplest_between(&(&value - &radius), &(&value + &radius));
            let q = to_f64(&Rational::from(fraction.denom().clone()));
            recognised &= 2.0 * tolerance * amplified * q * q < CHANCE;
            fraction
        });
        let short = Polynomial::new(short.collect());
        Some(if agrees(&short, tolerance) {
            Self { polynomial: short, degree, recognised }
        } else {
            Self { polynomial: through, degree, recognised: false }
        })
    }
}

/// The polynomials that are 1 at one node and 0 at the others.
fn lagrange(nodes: &[&Rational]) -> Vec<Polynomial<Rational>> {
    let one = |i: usize| {
        let others = nodes.iter().enumerate().filter(|(j, _)| *j != i);
        others.fold(Polynomial::constant(integer(1)), |product, (_, node)| {
            let width = nodes[i] - *node;
            debug_assert!(!width.abs().is_zero(), "nodes are distinct");
            product * Polynomial::new(vec![-*node / &width, width.recip()])
        })
    };
    (0..nodes.len()).map(one).collect()
}

#[cfg(test)]
mod tests;
