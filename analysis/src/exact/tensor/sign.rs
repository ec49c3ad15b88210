//! The sign of a polynomial on the unit cube.

use super::chart::{Origin, separating_axis, vanishing_axes};
use super::{Bernstein, Tensor};
use crate::exact::rational::{Rational, integer, ratio};
use crate::interest::Interest;
use num_traits::{Signed, Zero};
use std::collections::VecDeque;
use std::rc::Rc;

/// The answer to "is the polynomial nowhere negative on the unit cube?".
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CubeSign {
    /// It is: proved.
    NowhereNegative,
    /// It is negative at this point.
    NegativeAt(Vec<Rational>),
    /// Not decided within the permitted number of boxes.
    Undecided,
}

/// What was done about one cube.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Cut {
    /// No coefficient is negative.
    Leaf,
    /// Halved along an axis.
    Half(usize),
    /// The charts about the common zero of some axes, after `1 − x` for some variables.
    Charts { flipped: Vec<usize>, axes: Vec<usize> },
}

/// Charts within charts at most.
const MOST_CHARTS: usize = 12;

/// A negative value seen in the limit of a chart is looked for at points this near, as a power of one half.
const NEAREST: i32 = 400;

/// Decides whether a polynomial is nowhere negative on `[0, 1]^d`, looking at no more than so many boxes; and how many it took.
///
/// Cubes are halved; where a coefficient is negative and the value at a corner is zero, halving alone would never end: the face on
/// which the polynomial vanishes is blown up, `x_b = x_a m_b`, and the power of `x_a` that comes out is divided out.
pub fn sign_on_cube(polynomial: &Tensor, budget: usize) -> (CubeSign, usize) {
    let (sign, cuts) = cuts_of_cube(polynomial, budget, &Interest::default());
    (sign, cuts.len())
}

/// [`sign_on_cube`] with what was done about each cube, in the order in which the cubes came up: those that take the place of one wait
/// behind all that are waiting. Undecided as soon as nobody wants to know.
pub(crate) fn cuts_of_cube(
    polynomial: &Tensor,
    budget: usize,
    interest: &Interest,
) -> (CubeSign, Vec<Cut>) {
    let trimmed = polynomial.trimmed();
    let mut pending = VecDeque::from([(Bernstein::of(&trimmed), Rc::new(Origin::Whole))]);
    let (mut cuts, mut undecided) = (Vec::new(), false);
    while let Some((cube, origin)) = pending.pop_front() {
        cuts.push(Cut::Leaf);
        if cube.tensor().values().iter().all(|value| !value.is_negative()) {
            continue;
        }
        let corners = 0..1usize << trimmed.dimension();
        let value = |corner: usize| &cube.tensor().values()[cube.corner(corner)];
        if let Some(corner) = corners.clone().find(|&corner| value(corner).is_negative())
            && let Some(point) = negative_point(&trimmed, &origin, corner)
        {
            return (CubeSign::NegativeAt(point), cuts);
        }
        let zeros: Vec<usize> = corners.filter(|&corner| value(corner).is_zero()).collect();
        let resolution = match zeros.as_slice() {
            [] => Resolution::Halve(widest(&cube)),
            [corner, rest @ ..] => blow_up(&cube, &origin, *corner, rest),
        };
        if cuts.len() + pending.len() + resolution.parts() > budget || interest.is_lost() {
            return (CubeSign::Undecided, cuts);
        }
        let cut = cuts.last_mut().expect("one was just pushed");
        match resolution {
            Resolution::Charts(flipped, axes, parts) => {
                *cut = Cut::Charts { flipped, axes };
                pending.extend(parts);
            }
            Resolution::Halve(axis) => {
                *cut = Cut::Half(axis);
                halve(&cube, &origin, axis, &mut pending);
            }
            Resolution::TooDeep => undecided = true,
        }
    }
    let sign = if undecided { CubeSign::Undecided } else { CubeSign::NowhereNegative };
    (sign, cuts)
}

type Pending = VecDeque<(Bernstein, Rc<Origin>)>;

fn halve(cube: &Bernstein, origin: &Rc<Origin>, axis: usize, pending: &mut Pending) {
    let (lower, upper) = cube.halves(axis);
    let half = |upper| Rc::new(Origin::Half { of: Rc::clone(origin), axis, upper });
    pending.extend([(lower, half(false)), (upper, half(true))]);
}

/// The axis along which neighbouring coefficients differ most.
fn widest(cube: &Bernstein) -> usize {
    let tensor = cube.tensor();
    let spread = |axis: usize| {
        let stride = tensor.stride(axis);
        let inner = (0..tensor.values.len()).filter(|&at| tensor.power(at, axis) > 0);
        inner.map(|at| (&tensor.values[at] - &tensor.values[at - stride]).abs()).max()
    };
    (0..tensor.dimension()).max_by_key(|&axis| spread(axis)).unwrap_or(0)
}

/// What to do about a zero at a corner.
enum Resolution {
    /// Look at it closely: with some variables turned round, the charts of these axes take its place.
    Charts(Vec<usize>, Vec<usize>, Vec<(Bernstein, Rc<Origin>)>),
    /// First apart from other corners that vanish too, or smaller, along this axis.
    Halve(usize),
    /// Charts within charts without end.
    TooDeep,
}

impl Resolution {
    /// How many cubes take the place of one.
    fn parts(&self) -> usize {
        match self {
            Self::Charts(_, _, parts) => parts.len(),
            Self::Halve(_) => 2,
            Self::TooDeep => 0,
        }
    }
}

/// The charts about the face through a zero corner on which the polynomial vanishes; for a single axis that is a factor.
fn blow_up(cube: &Bernstein, origin: &Rc<Origin>, corner: usize, others: &[usize]) -> Resolution {
    let (mut cube, mut origin) = (cube.clone(), Rc::clone(origin));
    let dimension = cube.tensor().dimension();
    let flipped: Vec<usize> = (0..dimension).filter(|axis| corner >> axis & 1 == 1).collect();
    for &axis in &flipped {
        cube = cube.flipped(axis);
        origin = Rc::new(Origin::Flipped { of: origin, axis });
    }
    let axes = vanishing_axes(dimension, |axes| cube.tensor().vanishes_on(axes));
    let axes = axes.expect("it vanishes at the corner");
    let others = others.iter().map(|other| other ^ corner);
    let vanishes = |axes: &[usize]| cube.tensor().vanishes_on(axes);
    if let Some(axis) = separating_axis(dimension, &axes, others, vanishes) {
        return Resolution::Halve(axis);
    }
    if axes.len() > 1 && origin.charts() >= MOST_CHARTS {
        return Resolution::TooDeep;
    }
    let powers = cube.powers();
    let order = powers.order(&axes).unwrap_or(0);
    let chart = |&leader: &usize| {
        let polynomial = powers.in_chart(&axes, leader, order).trimmed();
        let chart = Origin::Chart { of: Rc::clone(&origin), axes: axes.clone(), leader };
        (Bernstein::of(&polynomial), Rc::new(chart))
    };
    let parts = axes.iter().map(chart).collect();
    Resolution::Charts(flipped, axes, parts)
}

/// A point of the whole cube where the polynomial is negative, at a corner where a factor of it is or near it.
fn negative_point(whole: &Tensor, origin: &Origin, corner: usize) -> Option<Vec<Rational>> {
    (0..NEAREST).find_map(|bits| {
        let inset = if bits == 0 { integer(0) } else { ratio(1, 2).pow(bits) };
        let coordinate = |axis: usize| {
            if corner >> axis & 1 == 1 { integer(1) - &inset } else { inset.clone() }
        };
        let point = origin.in_whole((0..whole.dimension()).map(coordinate).collect());
        whole.integer_at(&point).0.is_negative().then_some(point)
    })
}
