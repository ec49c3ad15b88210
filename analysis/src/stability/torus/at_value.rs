//! Stable or not at one value of the parameter, in two and three dimensions.

use super::{TorusDemands, TorusInequality};
use crate::exact::rational::Rational;
use crate::exact::tensor::{CubeSign, sign_on_cube};
use crate::stability::{PointVerdict, Wave};
use num_traits::Zero;

/// Boxes that one condition may take on one cell.
const MOST_BOXES: usize = 20_000;

/// Decides conditions without a parameter.
pub(crate) fn decide_on_torus(inequalities: &[TorusInequality]) -> PointVerdict<Wave> {
    let mut verdict = PointVerdict::Stable;
    for cell in inequalities.iter().flat_map(|one| &one.cells) {
        match sign_on_cube(&cell.at_parameter(&Zero::zero()), MOST_BOXES).0 {
            CubeSign::NowhereNegative => {}
            CubeSign::NegativeAt(point) => return PointVerdict::Unstable(cell.wave(&point)),
            CubeSign::Undecided => verdict = PointVerdict::Undecided,
        }
    }
    verdict
}

impl TorusDemands {
    /// The conditions at a value of the parameter; `None` where they say less about it than about its neighbours: one vanishes for every wave,
    /// or may have been divided by a square that does.
    pub(crate) fn at(&self, value: &Rational) -> Option<Vec<TorusInequality>> {
        let t = value.pow(self.stride as i32);
        let at = |one: &TorusInequality| TorusInequality {
            cells: one.cells.iter().map(|cell| cell.with_parameter(&t)).collect(),
            ..one.clone()
        };
        let all: Vec<TorusInequality> = self.inequalities.iter().map(at).collect();
        let vanishes = |one: &TorusInequality| one.cells.iter().any(|cell| cell.is_zero());
        let says_less = value.is_zero() || all.iter().any(|one| one.thinned || vanishes(one));
        (!says_less).then_some(all)
    }
}
