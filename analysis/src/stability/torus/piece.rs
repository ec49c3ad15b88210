//! The pieces of wave space, and a condition on each of them.

use super::cell::Cell;
use crate::exact::laurent::{Exponents, Laurent, VARIABLES, Variable};
use crate::exact::tensor::{Origin, Tensor, separating_axis, vanishing_axes};
use crate::interest::Interest;
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::BTreeSet;
use std::rc::Rc;
use std::sync::Arc;

/// How a coordinate `x` in `[0, 1]` runs through the phases of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Turn {
    /// `x = sin²(φ/2)`, for what is even in this phase alone.
    Half,
    /// `φ = turn π/2 + θ`, `x = tan(θ/2)`.
    Quarter(u8),
}

/// Zeros that all values of the parameter share are blown up this often.
const MOST_BLOW_UPS: usize = 6;

/// Cells at most: beyond, zeros stay where they are.
const MOST_CELLS: usize = 2000;

/// Coefficients of one condition on one piece at most: more are not decided.
const MOST_COEFFICIENTS: usize = 100_000;

/// A real function of waves and one parameter on the cells that cover all waves up to its symmetries; `None` where another name occurs,
/// where it is not real, where it is too long, or where nobody wants them any longer.
pub(crate) fn cells(
    polynomial: &Laurent,
    dimension: usize,
    parameter: Option<Variable>,
    stride: usize,
    interest: &Interest,
) -> Option<Vec<Cell>> {
    let others = (4..VARIABLES).map(Variable).filter(|name| Some(*name) != parameter);
    if !polynomial.is_real() || others.into_iter().any(|name| polynomial.contains(name)) {
        return None;
    }
    if polynomial.is_zero() {
        return Some(Vec::new());
    }
    let (lowest, highest) = parameter.and_then(|p| polynomial.range(p)).unwrap_or((0, 0));
    let orders = (0..dimension).filter_map(|axis| polynomial.range(Variable::axis(axis)));
    let size: usize =
        orders.map(|(low, high)| usize::from((high - low).unsigned_abs()) + 1).product();
    if size.saturating_mul((highest - lowest) as usize / stride + 1) > MOST_COEFFICIENTS {
        return None;
    }
    let mut cells = Vec::new();
    for whole in whole_cells(polynomial, dimension, parameter, stride) {
        if interest.is_lost() {
            return None;
        }
        resolve(whole, &mut cells);
    }
    Some(cells)
}

/// A real function on whole pieces that cover all waves up to its symmetries.
pub(crate) fn whole_cells(
    polynomial: &Laurent,
    dimension: usize,
    parameter: Option<Variable>,
    stride: usize,
) -> impl Iterator<Item = Cell> {
    let lowest = parameter.and_then(|p| polynomial.range(p)).map_or(0, |(low, _)| low);
    pieces(polynomial, dimension).into_iter().map(move |turns| {
        let tensor = on_piece(polynomial, &turns, parameter, lowest, stride);
        Cell { turns: turns.into(), origin: Rc::new(Origin::Whole), polynomial: tensor }
    })
}

/// Powers of the parameter as they occur: the least, and 2 where all others are even steps above it.
pub(crate) fn stride_of<'a>(
    polynomials: impl Iterator<Item = &'a Laurent>,
    parameter: Variable,
) -> usize {
    let mut even = true;
    for polynomial in polynomials {
        let powers: BTreeSet<i16> =
            polynomial.terms().iter().map(|(exponents, _)| exponents[parameter.0]).collect();
        let lowest = powers.first().copied().unwrap_or(0);
        even &= powers.iter().all(|power| (power - lowest) % 2 == 0);
    }
    if even { 2 } else { 1 }
}

/// One piece of each set that symmetries of the function map on one another.
fn pieces(polynomial: &Laurent, dimension: usize) -> Vec<Vec<Turn>> {
    let symmetries = symmetries(polynomial, dimension);
    let even = |axis: usize| {
        let alone: Vec<bool> = (0..dimension).map(|other| other == axis).collect();
        let identity: Vec<usize> = (0..dimension).collect();
        symmetries.contains(&(identity, alone))
    };
    let choices: Vec<Vec<Turn>> = (0..dimension)
        .map(|axis| match even(axis) {
            true => vec![Turn::Half],
            false => (0..4).map(Turn::Quarter).collect(),
        })
        .collect();
    let mut all: Vec<Vec<Turn>> = vec![Vec::new()];
    for choice in &choices {
        all = all
            .into_iter()
            .flat_map(|piece| choice.iter().map(move |turn| [piece.as_slice(), &[*turn]].concat()))
            .collect();
    }
    let image = |piece: &[Turn], (order, mirrored): &Symmetry| -> Vec<Turn> {
        order
            .iter()
            .zip(mirrored)
            .map(|(&axis, &mirrored)| match piece[axis] {
                Turn::Quarter(turn) if mirrored => Turn::Quarter(3 - turn),
                turn => turn,
            })
            .collect()
    };
    all.retain(|piece| symmetries.iter().all(|symmetry| image(piece, symmetry) >= *piece));
    all
}

/// An order of the axes, and which of them are mirrored.
type Symmetry = (Vec<usize>, Vec<bool>);

/// The exchanges and reflections of axes that leave a function as it is.
fn symmetries(polynomial: &Laurent, dimension: usize) -> Vec<Symmetry> {
    let orders: &[&[usize]] = match dimension {
        1 => &[&[0]],
        2 => &[&[0, 1], &[1, 0]],
        _ => &[&[0, 1, 2], &[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]],
    };
    let mut found = Vec::new();
    for order in orders {
        for signs in 0..1usize << dimension {
            let mirrored: Vec<bool> = (0..dimension).map(|axis| signs >> axis & 1 == 1).collect();
            let moved = |exponents: &Exponents| {
                let mut image = *exponents;
                for (axis, (&from, &mirrored)) in order.iter().zip(&mirrored).enumerate() {
                    let power = exponents[Variable::axis(from).0];
                    image[Variable::axis(axis).0] = if mirrored { -power } else { power };
                }
                image
            };
            let terms = polynomial.terms().iter().map(|(e, value)| (moved(e), value.clone()));
            if Laurent::new(terms.collect()) == *polynomial {
                found.push((order.to_vec(), mirrored));
            }
        }
    }
    found
}

/// The function on a piece as a polynomial in its coordinates and the parameter, times a positive function of the wave.
fn on_piece(
    polynomial: &Laurent,
    turns: &[Turn],
    parameter: Option<Variable>,
    lowest: i16,
    stride: usize,
) -> Tensor {
    let dimension = turns.len();
    let most = |axis: usize| {
        // Real: as far to the other side.
        let (_, high) = polynomial.range(Variable::axis(axis)).unwrap_or((0, 0));
        usize::from(high.unsigned_abs())
    };
    let orders: Vec<usize> = (0..dimension).map(most).collect();
    let power = |exponents: &Exponents| {
        parameter.map_or(0, |p| (exponents[p.0] - lowest) as usize / stride)
    };
    let highest = polynomial.terms().iter().map(|(e, _)| power(e)).max().unwrap_or(0);
    let mut degrees: Vec<usize> = orders.iter().map(|order| 2 * order).collect();
    degrees.push(highest);
    let terms = polynomial.terms().iter().map(|(exponents, value)| {
        let shifted = |axis: usize| {
            (i32::from(exponents[Variable::axis(axis).0]) + orders[axis] as i32) as usize
        };
        let mut place: Vec<usize> = (0..dimension).map(shifted).collect();
        place.push(power(exponents));
        (place, value.clone())
    });
    let mut parts = [Tensor::new(degrees.clone(), terms), Tensor::zero(degrees)];
    for (axis, turn) in turns.iter().enumerate() {
        parts = match turn {
            Turn::Half => parts.map(|part| part.contracted(axis, &cosines(orders[axis]))),
            Turn::Quarter(quarter) => {
                let (real, imaginary) = quarter_turns(orders[axis], *quarter);
                let [a, b] = &parts;
                let product = |part: &Tensor, rows: &[Vec<BigInt>]| part.contracted(axis, rows);
                [
                    product(a, &real).minus(&product(b, &imaginary)),
                    product(a, &imaginary).plus(&product(b, &real)),
                ]
            }
        };
    }
    let [real, _] = parts;
    real.trimmed()
}

/// `cos kφ` in powers of `s` for `k = −n, …, n`: what is even in the phase keeps the cosines of its shifts.
fn cosines(order: usize) -> Vec<Vec<BigInt>> {
    // T_{k+1} = 2 (1 − 2s) T_k − T_{k−1}
    let mut rows: Vec<Vec<BigInt>> = vec![vec![BigInt::one()]];
    for k in 0..order {
        let mut next = vec![BigInt::zero(); k + 2];
        let factor = BigInt::from(if k == 0 { 1 } else { 2 });
        for (power, value) in rows[k].iter().enumerate() {
            next[power] += value * &factor;
            next[power + 1] -= value * &factor * 2;
        }
        if k > 0 {
            rows[k - 1].iter().enumerate().for_each(|(power, value)| next[power] -= value);
        }
        rows.push(next);
    }
    let width = order + 1;
    rows.iter_mut().for_each(|row| row.resize(width, BigInt::zero()));
    (0..=2 * order).map(|at| rows[at.abs_diff(order)].clone()).collect()
}

/// `e^{ikφ} (1 + t²)^n = i^{qk} (1 + it)^{n+k} (1 − it)^{n−k}` for `k = −n, …, n`: real and imaginary parts in powers of `t`.
fn quarter_turns(order: usize, quarter: u8) -> (Vec<Vec<BigInt>>, Vec<Vec<BigInt>>) {
    let times = |(re, im): (Vec<BigInt>, Vec<BigInt>), sign: i32| {
        // (1 ± it)(a + ib) = a ∓ t b + i (b ± t a)
        let (mut real, mut imaginary) = (re.clone(), im.clone());
        real.push(BigInt::zero());
        imaginary.push(BigInt::zero());
        for (power, value) in im.iter().enumerate() {
            real[power + 1] -= value * sign;
        }
        for (power, value) in re.iter().enumerate() {
            imaginary[power + 1] += value * sign;
        }
        (real, imaginary)
    };
    let rows = (0..=2 * order).map(|at| {
        let mut product = (vec![BigInt::one()], vec![BigInt::zero()]);
        for _ in 0..at {
            product = times(product, 1);
        }
        for _ in at..2 * order {
            product = times(product, -1);
        }
        let k = at as i64 - order as i64;
        for _ in 0..(i64::from(quarter) * k).rem_euclid(4) {
            let (re, im) = product;
            product = (im.into_iter().map(|value| -value).collect(), re);
        }
        product
    });
    rows.unzip()
}

/// Takes out what vanishes on faces, edges and corners of the cube for every value of the parameter.
fn resolve(cell: Cell, done: &mut Vec<Cell>) {
    let dimension = cell.dimension();
    let mut pending = vec![cell];
    while let Some(cell) = pending.pop() {
        let zero_corner = (0..1usize << dimension).find_map(|corner| {
            let at_corner = flipped(&cell, corner);
            let axes = vanishing_axes(dimension, |axes| at_corner.polynomial.vanishes_on(axes))?;
            Some((at_corner, axes))
        });
        match zero_corner {
            Some((at_corner, axes))
                if (axes.len() == 1 || at_corner.origin.charts() < MOST_BLOW_UPS)
                    && done.len() + pending.len() < MOST_CELLS =>
            {
                let parts = match second_zero(&at_corner, &axes) {
                    Some(axis) => halves(&at_corner, axis),
                    None => charts(&at_corner, &axes),
                };
                pending.extend(parts);
            }
            _ => done.push(cell),
        }
    }
}

fn flipped(cell: &Cell, corner: usize) -> Cell {
    let mut cell = cell.clone();
    for axis in (0..cell.dimension()).filter(|axis| corner >> axis & 1 == 1) {
        cell.polynomial = cell.polynomial.flipped(axis);
        cell.origin = Rc::new(Origin::Flipped { of: cell.origin, axis });
    }
    cell
}

/// An axis of a blow-up along which the cube must be halved first.
fn second_zero(cell: &Cell, axes: &[usize]) -> Option<usize> {
    let all: Vec<usize> = (0..cell.dimension()).collect();
    let zeros = (1..1usize << cell.dimension())
        .filter(|&corner| flipped(cell, corner).polynomial.vanishes_on(&all));
    separating_axis(cell.dimension(), axes, zeros, |axes| cell.polynomial.vanishes_on(axes))
}

fn halves(cell: &Cell, axis: usize) -> Vec<Cell> {
    [false, true]
        .map(|upper| Cell {
            turns: Arc::clone(&cell.turns),
            origin: Rc::new(Origin::Half { of: Rc::clone(&cell.origin), axis, upper }),
            polynomial: cell.polynomial.half(axis, upper),
        })
        .into()
}

fn charts(cell: &Cell, axes: &[usize]) -> Vec<Cell> {
    let order = cell.polynomial.order(axes).unwrap_or(0);
    let of = &cell.origin;
    axes.iter()
        .map(|&leader| Cell {
            turns: Arc::clone(&cell.turns),
            origin: match axes.len() {
                1 => Rc::clone(of),
                _ => Rc::new(Origin::Chart { of: Rc::clone(of), axes: axes.to_vec(), leader }),
            },
            polynomial: cell.polynomial.in_chart(axes, leader, order).trimmed(),
        })
        .collect()
}
