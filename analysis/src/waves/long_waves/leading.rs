//! How `λ = log z` begins at long waves: Newton's polygon of `χ(e^λ, e^x)`.

use super::exact_step::{ExactStep, ROOT};
use super::levels::Series;
use super::{Field, NoSeries};
use crate::exact::laurent::Laurent;
use crate::exact::rational::{Rational, integer};
use crate::exact::rational_function::RationalFunction;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// `λ = ν x^power + …`, and the terms of `χ` that decide it.
pub(super) struct Leading {
    pub(super) power: usize,
    pub(super) value: RationalFunction,
    /// The power of `x` that those terms share.
    pub(super) weight: usize,
    /// The derivative of their sum `H(ν)`: not zero.
    pub(super) derivative: RationalFunction,
}

/// The terms of `Σ f_jk λ^j x^k` on one edge of the polygon.
struct Edge {
    power: usize,
    weight: usize,
    /// `H(ν)` by powers of `ν`.
    form: Vec<RationalFunction>,
}

/// Finds the beginning of the branch that the exact step follows, or else of the only one there is.
pub(super) fn leading(
    levels: &[Series],
    field: &mut Field,
    exact: Option<&ExactStep>,
) -> Result<Leading, NoSeries> {
    let edges = edges(levels)?;
    let stated = exact.and_then(ExactStep::leading);
    let (edge, value) = match stated {
        Some((power, value)) => {
            let here = edges.iter().find(|edge| edge.power == power);
            match here {
                Some(edge) if field.polynomial(&edge.form, value).is_zero() => {
                    (edge, value.clone())
                }
                Some(edge) => (edge, solve(edge, field, Some(value))?),
                None => {
                    let edge = only(&edges)?;
                    (edge, solve(edge, field, None)?)
                }
            }
        }
        None => {
            let edge = only(&edges)?;
            (edge, solve(edge, field, None)?)
        }
    };
    let derivative: Vec<RationalFunction> = (1..)
        .zip(&edge.form[1..])
        .map(|(j, value)| value.clone() * RationalFunction::from(integer(j)))
        .collect();
    let derivative = field.polynomial(&derivative, &value);
    if derivative.is_zero() {
        return Err(NoSeries::Double);
    }
    Ok(Leading { power: edge.power, value, weight: edge.weight, derivative })
}

fn only(edges: &[Edge]) -> Result<&Edge, NoSeries> {
    match edges {
        [edge] => Ok(edge),
        [] => Err(NoSeries::NoPower),
        _ => Err(NoSeries::Several),
    }
}

/// All edges of whole slope.
fn edges(levels: &[Series]) -> Result<Vec<Edge>, NoSeries> {
    let order = levels[0].len() - 1;
    // f_jk = Σ_n n^j/j! A_nk, as far as the first j that is there without x.
    let mut rows: Vec<Series> = Vec::new();
    let mut factorial = BigInt::one();
    for j in 0..=levels.len() {
        let row = (0..=order).map(|k| {
            let terms = (0..).zip(levels).map(|(n, level)| {
                let factor = Rational::new(BigInt::from(n).pow(j as u32), factorial.clone());
                level[k].clone() * RationalFunction::from(factor)
            });
            terms.fold(RationalFunction::zero(), |sum, term| sum + term)
        });
        rows.push(row.collect());
        factorial *= j + 1;
        if !rows[j][0].is_zero() {
            break;
        }
    }
    if !rows[0][0].is_zero() {
        return Err(NoSeries::Drift);
    }
    let lowest = |row: &Series| row.iter().position(|value| !value.is_zero());
    let mut edges = Vec::new();
    for power in 1..=order {
        let weights = rows.iter().enumerate().filter_map(|(j, row)| Some(power * j + lowest(row)?));
        let Some(weight) = weights.min() else { continue };
        let on_edge = |(j, row): (usize, &Series)| {
            let k = weight.checked_sub(power * j);
            k.and_then(|k| row.get(k).cloned()).unwrap_or_else(RationalFunction::zero)
        };
        let form: Vec<RationalFunction> = rows.iter().enumerate().map(on_edge).collect();
        if form.iter().filter(|value| !value.is_zero()).count() > 1 {
            edges.push(Edge { power, weight, form });
        }
    }
    Ok(edges)
}

/// A root of `H(ν)` that is not zero: linear, or quadratic with its square root as a letter. Of two the one with the sign of
/// `near`, or else the wave to the right.
fn solve(
    edge: &Edge,
    field: &mut Field,
    near: Option<&RationalFunction>,
) -> Result<RationalFunction, NoSeries> {
    let lowest = edge.form.iter().position(|value| !value.is_zero()).unwrap_or(0);
    let highest = edge.form.iter().rposition(|value| !value.is_zero()).unwrap_or(0);
    let over = |a: RationalFunction, b: &RationalFunction| a.over(b).ok_or(NoSeries::NoPower);
    match &edge.form[lowest..=highest] {
        [constant, slope] => over(-constant.clone(), slope),
        [constant, slope, square] => {
            let number = |value| RationalFunction::from(integer(value));
            let discriminant =
                slope.clone() * slope.clone() - number(4) * square.clone() * constant.clone();
            let (factor, rest) = discriminant.square_root();
            let root =
                if rest == Laurent::one() { Laurent::one() } else { Laurent::variable(ROOT) };
            if root != Laurent::one() && !field.adjoin(rest) {
                return Err(NoSeries::Algebraic);
            }
            let twice = number(2) * square.clone();
            let half = over(factor * RationalFunction::from(root), &twice)?;
            let middle = over(-slope.clone(), &twice)?;
            let pair = [middle.clone() - half.clone(), middle + half];
            let is_near = |value: &&RationalFunction| {
                let quotient = near.and_then(|near| value.over(near)?.as_number());
                quotient.is_some_and(|number| number.is_positive())
            };
            let rightward = |value: &&RationalFunction| {
                value.numerator().terms().last().is_some_and(|(_, value)| value.is_negative())
            };
            let chosen = pair.iter().find(is_near).or_else(|| pair.iter().find(rightward));
            Ok(chosen.unwrap_or(&pair[0]).clone())
        }
        _ => Err(NoSeries::Algebraic),
    }
}
