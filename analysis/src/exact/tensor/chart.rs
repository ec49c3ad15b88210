//! Blowing up: coordinates in which a zero at a corner, an edge or a face of a cube comes out as a factor.

use super::{Bernstein, Tensor};
use crate::exact::rational::{Rational, integer};
use num_traits::Zero;
use std::rc::Rc;

/// How a cube came from another one: each maps points of its own cube to the other's.
#[derive(Debug, Clone)]
pub(crate) enum Origin {
    /// The cube that the question is asked on.
    Whole,
    /// One half along an axis.
    Half { of: Rc<Origin>, axis: usize, upper: bool },
    /// With `1 − x` for a variable.
    Flipped { of: Rc<Origin>, axis: usize },
    /// `x_b = x_leader m_b` for the other axes `b` of a set: the part of the cube where the leader is the largest of them.
    Chart { of: Rc<Origin>, axes: Vec<usize>, leader: usize },
}

impl Origin {
    /// Where a point of this cube lies in the whole one.
    pub(crate) fn in_whole(&self, mut point: Vec<Rational>) -> Vec<Rational> {
        let mut origin = self;
        loop {
            origin = match origin {
                Self::Whole => return point,
                Self::Half { of, axis, upper } => {
                    point[*axis] = (&point[*axis] + integer(i64::from(*upper))) / integer(2);
                    of
                }
                Self::Flipped { of, axis } => {
                    point[*axis] = integer(1) - &point[*axis];
                    of
                }
                Self::Chart { of, axes, leader } => {
                    let scale = point[*leader].clone();
                    axes.iter().filter(|axis| *axis != leader).for_each(|&a| point[a] *= &scale);
                    of
                }
            }
        }
    }

    /// The nesting of charts.
    pub(crate) fn charts(&self) -> usize {
        match self {
            Self::Whole => 0,
            Self::Half { of, .. } | Self::Flipped { of, .. } => of.charts(),
            Self::Chart { of, axes, .. } => usize::from(axes.len() > 1) + of.charts(),
        }
    }
}

/// The smallest sets of axes (in the order of their size) on whose common zero `x_a = 0` something vanishes, given for each set.
pub(crate) fn vanishing_axes(
    dimension: usize,
    vanishes: impl Fn(&[usize]) -> bool,
) -> Option<Vec<usize>> {
    let mut sets: Vec<Vec<usize>> = (1..1usize << dimension)
        .map(|mask| (0..dimension).filter(|axis| mask >> axis & 1 == 1).collect())
        .collect();
    sets.sort_by_key(Vec::len);
    sets.into_iter().find(|axes| vanishes(axes))
}

/// An axis of a blow-up about the origin along which the cube must be halved first: another corner where the polynomial vanishes lies across it, and is
/// not joined to this one by a face on which it vanishes throughout. Corners are given by the axes, as bits, in which they differ.
pub(crate) fn separating_axis(
    dimension: usize,
    axes: &[usize],
    mut others: impl Iterator<Item = usize>,
    vanishes: impl Fn(&[usize]) -> bool,
) -> Option<usize> {
    if axes.len() == 1 {
        return None;
    }
    let is_across = |corner: &usize| axes.iter().any(|axis| corner >> axis & 1 == 1);
    let is_joined = |corner: usize| {
        let fixed: Vec<usize> = (0..dimension).filter(|axis| corner >> axis & 1 == 0).collect();
        !fixed.is_empty() && vanishes(&fixed)
    };
    let other = others.find(|corner| is_across(corner) && !is_joined(*corner))?;
    axes.iter().copied().find(|axis| other >> axis & 1 == 1)
}

impl Tensor {
    /// Whether it vanishes where all these variables are 0. True of powers and of Bernstein coefficients.
    pub(crate) fn vanishes_on(&self, axes: &[usize]) -> bool {
        let on = |at: usize| axes.iter().all(|&axis| self.power(at, axis) == 0);
        self.values.iter().enumerate().all(|(at, value)| value.is_zero() || !on(at))
    }

    /// The least sum of the powers of some variables; `None` for zero.
    pub(crate) fn order(&self, axes: &[usize]) -> Option<usize> {
        let sum = |at: usize| axes.iter().map(|&axis| self.power(at, axis)).sum();
        let occupied = self.values.iter().enumerate().filter(|(_, value)| !value.is_zero());
        occupied.map(|(at, _)| sum(at)).min()
    }

    /// With `x_b = x_leader m_b` for the other axes `b` of a set, divided by `x_leader` to the power of `order`.
    pub(crate) fn in_chart(&self, axes: &[usize], leader: usize, order: usize) -> Self {
        let total = axes.iter().map(|&axis| self.degrees[axis]).sum::<usize>();
        let mut degrees = self.degrees.clone();
        degrees[leader] = total.saturating_sub(order);
        let occupied = self.values.iter().enumerate().filter(|(_, value)| !value.is_zero());
        let moved = occupied.map(|(at, value)| {
            let mut powers = self.powers(at);
            powers[leader] = axes.iter().map(|&axis| powers[axis]).sum::<usize>() - order;
            (powers, value.clone())
        });
        Self::new(degrees, moved)
    }
}

impl Bernstein {
    pub(super) fn tensor(&self) -> &Tensor {
        &self.0
    }

    /// The index of the coefficient that is the value at a corner, given by a bit for each axis.
    pub(super) fn corner(&self, corner: usize) -> usize {
        let end = |axis: usize| if corner >> axis & 1 == 1 { self.0.degrees[axis] } else { 0 };
        self.0.place(&(0..self.0.dimension()).map(end).collect::<Vec<_>>())
    }
}
