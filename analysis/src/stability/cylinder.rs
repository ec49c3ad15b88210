//! The stable set cell by cell: the range of `t` is cut at the critical values, and one point decides each cell.
//!
//! This is cylindrical decomposition in two variables. It needs no boxes, passes touching waves wherever they are, and checks
//! the search by boxes in the tests; its cost grows with the fourth power of the degree.

use super::critical_polynomial::CriticalPolynomials;
use super::pointwise::{PointVerdict, decide_at_parameter};
use crate::exact::algebraic_number::AlgebraicNumber;
use crate::exact::descartes::isolate;
use crate::exact::rational::{Rational, simplest_between};
use crate::stability::margin::Margin;

/// Critical values this much closer together than the range are not told apart, as a power of one half.
const MAX_HALVINGS: u32 = 200;

/// An open interval of `t` between neighbouring critical values, or ends of the range.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cell {
    /// The value where it begins, enclosed.
    pub(super) from: (Rational, Rational),
    /// The value where it ends, enclosed.
    pub(super) to: (Rational, Rational),
    /// The `s` of a wave that is unstable somewhere in the cell, and then another one everywhere; `None` when it is stable.
    pub(super) unstable_wave: Option<Rational>,
}

impl CriticalPolynomials {
    /// The cells of `(from, to)`, ascending, with critical values enclosed to about `2^−bits` of their size. `None` when two
    /// of them are too close to be told apart.
    pub(super) fn cells(
        &self,
        margin: &Margin,
        from: &Rational,
        to: &Rational,
        bits: u32,
    ) -> Option<Vec<Cell>> {
        let roots =
            isolate(self.product(), from, to, MAX_HALVINGS)?.into_iter().map(|(lower, upper)| {
                if lower == upper {
                    return Some((lower, upper));
                }
                let root = AlgebraicNumber::between(self.product().clone(), lower, upper)?;
                match root.power_as_fraction() {
                    Some(exact) => Some((exact.clone(), exact)),
                    None => Some(root.enclosure(bits)),
                }
            });
        let mut ends = vec![(from.clone(), from.clone())];
        for root in roots {
            ends.push(root?);
        }
        ends.push((to.clone(), to.clone()));
        let mut cells = Vec::with_capacity(ends.len() - 1);
        for pair in ends.windows(2) {
            let (below, above) = (&pair[0].1, &pair[1].0);
            if below >= above {
                return None;
            }
            let third = (above - below) / crate::exact::rational::integer(3);
            let inside = simplest_between(&(below + &third), &(above - third));
            let unstable_wave = match decide_at_parameter(margin, &inside) {
                PointVerdict::Stable => None,
                PointVerdict::Unstable(s) => Some(s),
                PointVerdict::Undecided => return None,
            };
            cells.push(Cell { from: pair[0].clone(), to: pair[1].clone(), unstable_wave });
        }
        Some(cells)
    }
}

#[cfg(test)]
mod tests;
