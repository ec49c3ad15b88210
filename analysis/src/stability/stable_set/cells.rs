//! What the critical polynomials decide where boxes do not: cells between critical values.

use super::edge::Edge;
use super::search::{Search, power_of_half};
use super::stable_stretch::Stretch;
use crate::exact::bernstein::is_negative_integer_polynomial;
use crate::exact::rational::{Rational, integer};
use crate::stability::critical_polynomial::CriticalPolynomials;
use crate::stability::cylinder::Cell;
use crate::stability::pointwise::{PointVerdict, decide_at_parameter};

/// From so many bits on, edges are recognised as roots of polynomials: who asks for less wants it quickly.
const RECOGNISING_BITS: u32 = 52;

/// With fewer boxes per decision than this, cells are not looked at either.
const LEAST_BUDGET: usize = 100;

/// Products of residues that a discriminant may cost when nobody asked for it: some milliseconds.
const AFFORDABLE_PRODUCTS: usize = 600_000;

/// How many times more it may cost when more digits than an `f64` has were asked for.
const PATIENCE: usize = 50;

impl Search<'_> {
    /// The polynomials whose roots are the critical values, if the data are exact and the cost is fair.
    pub(super) fn critical_polynomials(&self) -> Option<&CriticalPolynomials> {
        // A budget for boxes is one for work: cells cost more than many boxes.
        let wanted =
            self.margin.is_exact() && self.bits >= RECOGNISING_BITS && self.budget >= LEAST_BUDGET;
        let patience = if self.bits > RECOGNISING_BITS { PATIENCE } else { 1 };
        let compute = || CriticalPolynomials::new(self.margin, patience * AFFORDABLE_PRODUCTS);
        self.critical.get_or_init(|| wanted.then(compute).flatten()).as_ref()
    }

    /// The end of a stable stretch from the critical polynomials.
    pub(super) fn stretch_of_cells(&mut self, from: &Rational) -> Option<Stretch> {
        let cells = self.cells(from, &self.end.clone())?;
        let Some(first) = cells.iter().position(|cell| cell.unstable_wave.is_some()) else {
            return Some(Stretch::Continues);
        };
        let cell = &cells[first];
        if first == 0 {
            let s = cell.unstable_wave.clone().filter(|s| self.is_unstable_just_above(from, s))?;
            return Some(Stretch::Empty(s));
        }
        let (lower, upper) = cell.from.clone();
        let s = self.wave_unstable_above(&upper)?;
        Some(Stretch::Ends(Edge { lower, upper, s }))
    }

    /// Where an unstable stretch ends, from the critical polynomials.
    pub(super) fn upper_edge_of_cells(&mut self, from: &Rational) -> Option<Edge> {
        let cells = self.cells(from, &self.end.clone())?;
        let stable = cells.iter().skip(1).position(|cell| cell.unstable_wave.is_none())? + 1;
        let (lower, upper) = cells[stable].from.clone();
        let s = cells[stable - 1].unstable_wave.clone()?;
        Some(Edge { lower, upper, s })
    }

    /// Whether single values of `t` are all that may be stable between the two, which is no interval.
    pub(super) fn is_unstable_but_for_points(
        &mut self,
        lower: &Rational,
        upper: &Rational,
    ) -> bool {
        self.cells(lower, upper)
            .is_some_and(|cells| cells.iter().all(|cell| cell.unstable_wave.is_some()))
    }

    /// The cells of a range of `t`, if there are critical polynomials.
    fn cells(&mut self, from: &Rational, to: &Rational) -> Option<Vec<Cell>> {
        let bits = self.root_bits();
        let cells = self.critical_polynomials()?.cells(self.margin, from, to, bits)?;
        self.work.cells += cells.len();
        Some(cells)
    }

    /// A wave that is unstable from `t` on, which only just is.
    fn wave_unstable_above(&self, t: &Rational) -> Option<Rational> {
        self.widths().find_map(|bits| {
            let above = t * (integer(1) + power_of_half(bits));
            match decide_at_parameter(self.margin, &above) {
                PointVerdict::Unstable(s) => {
                    let values = self.form.integers_at(&s, 1);
                    let negative = is_negative_integer_polynomial(&values, t, &above);
                    (negative == Some(true)).then_some(s)
                }
                _ => None,
            }
        })
    }
}
