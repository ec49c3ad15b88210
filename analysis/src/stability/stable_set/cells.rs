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
        let wanted = self.margin.is_exact()
            && self.bits >= RECOGNISING_BITS
            && self.budget >= LEAST_BUDGET
            && self.form.is_wanted();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use crate::stability::DEFAULT_BITS;
    use crate::stability::margin::Margin;
    use crate::stability::testing::margin;

    fn exact(powers: &[&[i64]]) -> Margin {
        margin(powers, &integer(0))
    }

    fn search(margin: &Margin) -> Search<'_> {
        Search::new(margin, &integer(4), DEFAULT_BITS)
    }

    #[test]
    fn cells_are_looked_at_where_data_and_work_allow_it() {
        let (sharp, blurred) =
            (exact(&[&[2, -4, 4], &[-1]]), margin(&[&[2, -4, 4], &[-1]], &ratio(1, 9)));
        let there = |margin: &Margin, bits, budget| {
            Search::new(margin, &integer(4), bits).within(budget).critical_polynomials().is_some()
        };
        assert!(there(&sharp, 52, 100) && there(&sharp, 53, usize::MAX));
        // More is affordable for more digits than an f64 has.
        let of_degree = |degree: usize| {
            let mut first: Vec<i64> = (0..degree as i64).map(|k| 3 - k * k % 7).collect();
            first.push(1);
            exact(&[&first, &[-1, 2, 5], &[2, 1]])
        };
        let costly = (4..).map(of_degree).find(|one| !there(one, 52, usize::MAX)).unwrap();
        assert!(there(&costly, 53, usize::MAX));
        assert!(!there(&sharp, 51, 100) && !there(&sharp, 52, 99) && !there(&blurred, 52, 100));
    }

    #[test]
    fn stretches_end_where_cells_say() {
        let ends = |powers: &[&[i64]]| {
            let margin = exact(powers);
            let mut search = search(&margin);
            let found = search.stretch_of_cells(&integer(0));
            assert!(search.work.cells > 0);
            match found {
                None => "not known".into(),
                Some(Stretch::Continues) => "continues".into(),
                Some(Stretch::Empty(s)) => format!("empty at {s}"),
                Some(Stretch::Ends(edge)) => format!("{} at {}", edge.upper, edge.s),
                Some(Stretch::Undecided(..)) => "undecided".to_string(),
            }
        };
        // (2s − 1)² + a + b t
        assert_eq!(ends(&[&[1, -4, 4], &[1]]), "continues");
        assert_eq!(ends(&[&[1, -4, 4], &[-1]]), "empty at 1/2");
        assert_eq!(ends(&[&[3, -4, 4], &[-1]]), "2 at 1/2");
        // (4s − 1 − t)² − t/100: no wave is unstable from 0 on, another one a little above is.
        assert_eq!(ends(&[&[100, -800, 1600], &[199, -800], &[100]]), "not known");
        // (4s − t)² − (t − 1)³: the same beyond 1.
        assert_eq!(ends(&[&[1, 0, 16], &[-3, -8], &[4], &[-1]]), "not known");
    }

    #[test]
    fn instability_ends_with_the_first_stable_cell() {
        // (2s − 1)² + 2t − 2: from 1/2 on the longest wave is stable, from 1 on all are.
        let two = exact(&[&[-1, -4, 4], &[2]]);
        let edge = search(&two).upper_edge_of_cells(&integer(0)).unwrap();
        assert_eq!((edge.lower, edge.upper), (integer(1), integer(1)));
        let never = exact(&[&[-1, -4, 4], &[0, 0, -1]]);
        assert!(search(&never).upper_edge_of_cells(&integer(0)).is_none());
        // −(t − 1)² (2 − s), and 1 − t + s.
        let (point, stretch) = (exact(&[&[-2, 1], &[4, -2], &[-2, 1]]), exact(&[&[1, 1], &[-1]]));
        let but_for_points = |margin: &Margin, lower, upper| {
            search(margin).is_unstable_but_for_points(&integer(lower), &integer(upper))
        };
        assert!(but_for_points(&point, 0, 2) && but_for_points(&stretch, 2, 3));
        assert!(!but_for_points(&stretch, 0, 2) && !but_for_points(&stretch, 0, 1));
    }

    #[test]
    fn what_no_wave_covers_is_left_as_few_stretches() {
        // −(t − 1)(t − 2)(t − 3)(t − 4), with s beside it.
        let margin = exact(&[&[-24, 1], &[50], &[-35], &[10], &[-1]]);
        let mut search = Search::new(&margin, &integer(5), DEFAULT_BITS).patient(40);
        let gaps = search.not_covered(&integer(0), integer(5), &[]);
        let holds = |t: i64| gaps.iter().any(|(a, b)| *a <= integer(t) && integer(t + 1) <= *b);
        assert!(holds(1) && holds(3) && gaps.len() == 1, "{gaps:?}");
        assert!(gaps[0].0 > ratio(9, 10) && gaps.windows(2).all(|pair| pair[0].1 < pair[1].0));
        assert_eq!(search.not_covered(&integer(2), integer(2), &[]), []);
        // (t − 1)(t − 2): apart are those that a covered one parts. Where no sample grows no wave is tried.
        let parted = exact(&[&[2, 1], &[-3], &[1]]);
        let mut search = Search::new(&parted, &integer(4), DEFAULT_BITS).patient(2);
        let gaps = search.not_covered(&integer(0), integer(4), &[]);
        assert_eq!(gaps, [(0, 1), (2, 4)].map(|(a, b)| (integer(a), integer(b))));
        let stable = exact(&[&[1, 1], &[1]]);
        let mut search = Search::new(&stable, &integer(5), DEFAULT_BITS);
        assert_eq!(search.not_covered(&integer(0), integer(5), &[]).len(), 1);
        assert_eq!(search.work.evaluations, 0);
        let mut search = Search::new(&margin, &integer(5), DEFAULT_BITS);
        let mut throughout = |a: Rational, b: Rational| search.is_unstable_throughout(&a, &b);
        assert!(throughout(ratio(21, 10), ratio(29, 10)) && !throughout(ratio(3, 2), ratio(5, 2)));
    }
}
