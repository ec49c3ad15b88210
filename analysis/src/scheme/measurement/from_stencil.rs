//! A scheme from the coefficients of its stencil.

use crate::exact::laurent::{Laurent, VARIABLES, Variable};
use crate::exact::matrix::Matrix;
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, common_denominator, numerator_over};
use crate::scheme::{Names, SchemeError, Step};
use num_bigint::BigInt;

/// Which old value a new one takes: `new_row(j) = … + g · old_column(j + offset)` at a level.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// The unknown that is computed.
    pub row: usize,
    /// The unknown that is read.
    pub column: usize,
    /// The level that is read, from 0 for the oldest.
    pub level: usize,
    /// Cells along each axis from the one computed to the one read.
    pub offset: Vec<i64>,
}

/// A coefficient as a polynomial in the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct StencilTerm {
    /// Where it stands.
    pub place: Place,
    /// Its value.
    pub coefficient: Polynomial<Rational>,
}

impl Step {
    /// The explicit step `U(n + levels, j) = Σ g_{l,k} U(n + l, j + k)`: the matrix `z^levels I − Σ z^l G_l(E)`.
    ///
    /// ```
    /// use courant_analysis::exact::{polynomial::Polynomial, rational::integer};
    /// use courant_analysis::scheme::{Step, measurement::{Place, StencilTerm}};
    /// let term = |level, offset, coefficients: &[i64]| StencilTerm {
    ///     place: Place { row: 0, column: 0, level, offset: vec![offset] },
    ///     coefficient: Polynomial::new(coefficients.iter().map(|&c| integer(c)).collect()),
    /// };
    /// // Leapfrog: u[n+2] = u[n] − C (u[n+1,j+1] − u[n+1,j−1]).
    /// let terms = [term(0, 0, &[1]), term(1, 1, &[0, -1]), term(1, -1, &[0, 1])];
    /// let leapfrog = Step::from_stencil(&["u".into()], 1, 2, Some("C"), &terms)?;
    /// let typed = Step::from_text("u[n+2,j] = u[n,j] - C*(u[n+1,j+1] - u[n+1,j-1])")?;
    /// assert_eq!(leapfrog.characteristic()?, typed.characteristic()?);
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Errors
    /// When the parameter finds no room among the names.
    ///
    /// # Panics
    /// When an offset does not fit an exponent, or a term depends on a parameter that is not given.
    pub fn from_stencil(
        unknowns: &[String],
        dimension: usize,
        levels: usize,
        parameter: Option<&str>,
        terms: &[StencilTerm],
    ) -> Result<Self, SchemeError> {
        let mut names = Names::default();
        let variable = parameter.map(|name| names.insert_parameter(name)).transpose()?;
        let exponent = |value: i64| i16::try_from(value).expect("stencils are shorter than 2^15");
        let mut matrix = Matrix::zero(unknowns.len(), unknowns.len());
        for row in 0..unknowns.len() {
            let own = || terms.iter().filter(|term| term.place.row == row);
            let common = common_denominator(own().flat_map(|term| term.coefficient.coefficients()));
            let newest = Laurent::power_of(Variable::TIME, exponent(levels as i64));
            *matrix.entry(row, row) = newest.scaled(&common);
            for StencilTerm { place, coefficient } in own() {
                let monomial = |(power, value): (usize, &Rational)| {
                    let mut exponents = [0; VARIABLES];
                    exponents[Variable::TIME.0] = exponent(place.level as i64);
                    for (axis, offset) in place.offset.iter().enumerate() {
                        exponents[Variable::axis(axis).0] = exponent(*offset);
                    }
                    if power > 0 {
                        let variable = variable.expect("a coefficient that varies has a parameter");
                        exponents[variable.0] = exponent(power as i64);
                    }
                    let value: BigInt = -numerator_over(value, &common);
                    (exponents, value)
                };
                let read = coefficient.coefficients().iter().enumerate().map(monomial).collect();
                let entry = matrix.entry(row, place.column);
                *entry = std::mem::take(entry) + Laurent::new(read);
            }
        }
        Ok(Self {
            matrix,
            unknowns: unknowns.to_vec(),
            dimension,
            names,
            denominators: Vec::new(),
            set: Vec::new(),
            measured: false,
        })
    }
}
