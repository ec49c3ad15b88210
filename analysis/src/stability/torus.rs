//! Stable sets in two and three dimensions: the same conditions on waves `(φ_1, …, φ_d)`, decided on unit cubes.
//!
//! Each phase is a half turn by its `s = sin²(φ/2)`, where the scheme does not tell left from right along that axis, or one of four
//! quarter turns by `t = tan(θ/2)`, which makes `e^{iθ}` rational. The condition is then an integer polynomial on a cube, of the
//! [sign](crate::exact::tensor::sign_on_cube) of which integers decide.

mod at_value;
mod cell;
mod guess;
mod piece;
mod search;
mod walk;

pub(crate) use at_value::decide_on_torus;
pub(crate) use piece::{Turn, whole_cells};
pub(crate) use search::{Edge, ExactSpot};
pub(crate) use walk::{StableStretch, StretchEnd, stable_set_on_torus, stretches_on_torus};

use super::Binding;
use super::conditions::Requirement;
use crate::exact::laurent::Laurent;
use crate::exact::laurent::Variable;
use crate::exact::tensor::{CubeSign, cuts_of_cube};
use crate::interest::Interest;
pub(crate) use cell::Cell;

/// Boxes that the sign of a factor without the parameter may take.
const FACTOR_BOXES: usize = 4000;

/// All conditions of a scheme.
#[derive(Debug, Clone)]
pub struct TorusDemands {
    pub(crate) inequalities: Vec<TorusInequality>,
    /// `t = C^stride`: 2 where only even powers of the parameter occur.
    pub(crate) stride: usize,
}

impl TorusDemands {
    /// `None` where names other than the parameter are left, whose values are not fractions.
    pub(crate) fn new(
        requirements: &[Requirement],
        dimension: usize,
        parameter: Option<Variable>,
        interest: &Interest,
    ) -> Option<Self> {
        let polynomials = requirements.iter().map(|one| &one.polynomial);
        let stride = parameter.map_or(1, |parameter| piece::stride_of(polynomials, parameter));
        let inequality =
            |one: &Requirement| TorusInequality::new(one, dimension, parameter, stride, interest);
        let inequalities = requirements.iter().map(inequality).collect::<Option<_>>()?;
        Some(Self { inequalities, stride })
    }
}

/// One condition on all waves: `P(x; t) ≥ 0` on cells, `t = C^stride`.
#[derive(Debug, Clone)]
pub(crate) struct TorusInequality {
    pub(crate) binding: Binding,
    pub(crate) cells: Vec<Cell>,
    /// Whether it was divided by a square that may vanish for all waves at some values of the parameter: there it says nothing.
    pub(crate) thinned: bool,
}

impl TorusInequality {
    /// From a condition in which nothing but waves and one parameter is left; `None` without a sign that could be decided: other names.
    pub(crate) fn new(
        requirement: &Requirement,
        dimension: usize,
        parameter: Option<Variable>,
        stride: usize,
        interest: &Interest,
    ) -> Option<Self> {
        // Squares out of the way: boxes do not decide where they touch zero.
        let (mut polynomial, mut square) = (requirement.polynomial.clone(), Laurent::integer(1));
        if !polynomial.is_zero() {
            polynomial = polynomial.odd_part();
            square = requirement.polynomial.divide_exactly(&polynomial)?;
        }
        let mut whatever_the_step = false;
        if let Some(variable) = parameter
            && let Some(common) = super::symmetric(polynomial.content(variable))
            && let Some(rest) = polynomial.divide_exactly(&common)
        {
            let plus = is_nowhere_negative(&common, dimension, interest)?;
            if plus == Some(true) {
                polynomial = rest;
            } else {
                match is_nowhere_negative(&-common, dimension, interest)? {
                    Some(true) => polynomial = -rest,
                    minus => whatever_the_step = plus == Some(false) && minus == Some(false),
                }
            }
        }
        let cells = piece::cells(&polynomial, dimension, parameter, stride, interest)?;
        let binding = Binding {
            condition: requirement.condition,
            on_circle: requirement.on_circle,
            whatever_the_step,
        };
        let vanishes_with = |square: &Laurent, p| square.primitive().contains(p);
        let squares = [&square, &requirement.square];
        let thinned = parameter.is_some_and(|p| squares.iter().any(|s| vanishes_with(s, p)));
        Some(Self { binding, cells, thinned })
    }
}

/// Whether a real function of the waves is nowhere negative; the inner `None` where that is not known.
fn is_nowhere_negative(
    polynomial: &Laurent,
    dimension: usize,
    interest: &Interest,
) -> Option<Option<bool>> {
    let cells = piece::cells(polynomial, dimension, None, 1, interest)?;
    let mut all = Some(true);
    for cell in cells {
        let whole = cell.at_parameter(&num_traits::Zero::zero());
        match cuts_of_cube(&whole, FACTOR_BOXES, interest).0 {
            CubeSign::NowhereNegative => {}
            CubeSign::NegativeAt(_) => return Some(Some(false)),
            CubeSign::Undecided => all = None,
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests;
