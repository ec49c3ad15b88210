//! Stable or not at one value of the parameter, in two and three dimensions.

use super::search::Search;
use super::{TorusDemands, TorusInequality};
use crate::exact::rational::{Rational, integer};
use crate::exact::real_roots::power_of_two;
use crate::exact::tensor::{CubeSign, cuts_of_cube};
use crate::interest::Interest;
use crate::stability::{PointVerdict, SearchPlan, Wave};
use num_traits::{One, Zero};

/// Boxes that one condition may take on one cell.
const MOST_BOXES: usize = 20_000;

/// Decides conditions without a parameter.
pub(crate) fn decide_on_torus(
    inequalities: &[TorusInequality],
    interest: &Interest,
) -> PointVerdict<Wave> {
    let mut verdict = PointVerdict::Stable;
    for cell in inequalities.iter().flat_map(|one| &one.cells) {
        match cuts_of_cube(&cell.at_parameter(&Zero::zero()), MOST_BOXES, interest).0 {
            CubeSign::NowhereNegative => {}
            CubeSign::NegativeAt(point) => return PointVerdict::Unstable(cell.wave(&point)),
            CubeSign::Undecided => verdict = PointVerdict::Undecided,
        }
    }
    verdict
}

/// How near is "about" a value: this power of one half of it.
const ABOUT: i64 = 30;

impl TorusDemands {
    /// Whether all waves meet the conditions at a positive value and a little to both sides of it: proved.
    pub(crate) fn are_met_about(&self, value: &Rational, plan: &SearchPlan) -> bool {
        let at = |side: i64| {
            let share = Rational::one() + power_of_two(-ABOUT) * integer(side);
            (value * share).pow(self.stride as i32)
        };
        let (below, above) = (at(-1), at(1));
        let search = Search::without_guesses(&self.inequalities, above.clone(), plan.budget);
        let mut search = search.while_wanted(&plan.interest);
        search.is_stable(&below, &above).is_ok()
    }

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
