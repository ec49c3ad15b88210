//! Stable stretches: proved up to the edge that floating point guesses, or to the one that bisection finds.

use super::edge::Edge;
use super::phase_parameter;
use super::search::{Counterexample, Search, power_of_half};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, compare, integer, product, simplest_between, to_f64};
use crate::exact::real_roots::real_roots;
use crate::stability::critical::refine;
use num_traits::Zero;

/// Bisection towards 0 stops at this power of one half of the range.
const FLOOR_BITS: u32 = 120;

/// How many touching waves are passed in one search.
const MAX_TOUCHES: usize = 16;

/// How a stable stretch ends.
pub(super) enum Stretch {
    /// At this edge.
    Ends(Edge),
    /// Not within the range.
    Continues,
    /// It has no length: instability begins at once, seen by the wave with this `s`.
    Empty(Rational),
    /// Not decided between the two values of `t`.
    Undecided(Rational, Rational),
}

impl Search<'_> {
    /// Proves `[from, end of the stretch]` stable.
    pub(super) fn stable_stretch(&mut self, from: &Rational) -> Stretch {
        let start = to_f64(from);
        let guess = self
            .guesses
            .iter()
            .find(|unstable| unstable.to.parameter > start * (1.0 + 1e-12))
            .map(|unstable| unstable.from);
        let Some(guess) = guess else {
            let end = self.end.clone();
            return match self.is_stable(from, &end) {
                Ok(()) => Stretch::Continues,
                Err(counterexample) => self.bisect(from, counterexample),
            };
        };
        if guess.parameter <= start * (1.0 + 1e-12) {
            // The wave that began it, or, where that was long before, the one that grows most here.
            let here = self.most_unstable(start * (1.0 + 1e-9));
            for s in std::iter::once(phase_parameter(guess.phase)).chain(here) {
                if self.is_unstable_just_above(from, &s) {
                    return Stretch::Empty(s);
                }
            }
        }
        let refined = refine(&self.compiled, guess, true, to_f64(&self.end));
        for s in [integer(0), integer(1)] {
            // An end of the phase range binds: its critical value is a root of a polynomial in t.
            let Some(root) = self.root_near(&s, refined.parameter, 1e-9) else { continue };
            let mut lowers = vec![root.lower.clone()];
            if !self.margin.is_exact() {
                // The lowered margin vanishes at this very end, which boxes need not see, and the data may not
                // justify what is asked for.
                lowers.extend(
                    self.widths()
                        .map(|bits| product(&root.lower, &(integer(1) - power_of_half(bits - 2)))),
                );
            }
            for lower in lowers {
                if compare(&lower, from).is_gt()
                    && self.is_unstable_just_above(&root.upper, &s)
                    && self.is_stable(from, &lower).is_ok()
                {
                    return Stretch::Ends(Edge { lower, upper: root.upper, s });
                }
            }
        }
        let mut counterexample = None;
        // A wave may only touch at the edge, and the guess be rounding: then the critical polynomials decide.
        let interior = self.interior_edge(refined);
        if interior.as_ref().is_some_and(|edge| {
            let (upper, s) = (edge.upper.clone(), edge.s.clone());
            self.margin.is_exact() && !self.is_unstable_just_above(&upper, &s)
        }) {
            counterexample = Some(None);
        } else if let Some(edge) = interior {
            for bits in self.widths() {
                let lower = product(&edge.upper, &(integer(1) - power_of_half(bits)));
                if compare(&lower, from).is_le() {
                    break;
                }
                match self.is_stable(from, &lower) {
                    Ok(()) => return Stretch::Ends(Edge { lower, ..edge }),
                    // Neither proved nor refuted, a wave may touch: the critical polynomials know.
                    Err(None) if self.critical_polynomials().is_some() => {
                        counterexample = Some(None);
                        break;
                    }
                    Err(found) => counterexample = Some(found),
                }
            }
        }
        match counterexample {
            Some(found) => self.bisect(from, found),
            None => {
                let end = self.end.clone();
                match self.is_stable(from, &end) {
                    Ok(()) => Stretch::Continues,
                    Err(found) => self.bisect(from, found),
                }
            }
        }
    }

    /// Finds the end of a stable stretch by bisection alone, from a counterexample `(s, t)` above it or
    /// from nothing but the failure to prove the rest of the range stable.
    fn bisect(&mut self, from: &Rational, counterexample: Option<Counterexample>) -> Stretch {
        if counterexample.is_none()
            && let Some(stretch) = self.stretch_of_cells(from)
        {
            return stretch;
        }
        let (mut witness, mut upper) = match counterexample.map(|found| *found) {
            Some((s, t)) => (Some(s), t),
            None => (None, self.end.clone()),
        };
        let mut lower = from.clone();
        let floor = &self.end * power_of_half(FLOOR_BITS);
        while self.form.is_wanted() && &upper - &lower > &upper * power_of_half(self.bits) {
            if lower.is_zero() {
                if let Some(s) = witness.take_if(|s| self.is_unstable_just_above(&lower, s)) {
                    return Stretch::Empty(s);
                }
                if upper < floor {
                    break;
                }
            }
            let middle = (&lower + &upper) / integer(2);
            match self.is_stable(&lower, &middle) {
                Ok(()) => lower = middle,
                Err(Some(found)) => {
                    upper = found.1;
                    witness = Some(found.0);
                }
                Err(None) => {
                    witness = None;
                    upper = middle;
                }
            }
        }
        match witness {
            // Of enclosed data a counterexample may only be one of the data.
            Some(s)
                if upper <= *from
                    && (self.margin.is_exact() || self.is_unstable_just_above(from, &s)) =>
            {
                Stretch::Empty(s)
            }
            Some(s) if self.is_unstable_just_above(&upper, &s) => {
                Stretch::Ends(Edge { lower, upper, s })
            }
            Some(s) => match self.certainly_unstable_from(&upper, &s) {
                Some(upper) => Stretch::Ends(Edge { lower, upper, s }),
                None => Stretch::Undecided(lower, self.end.clone()),
            },
            None => self.pass_touching_wave(lower, upper),
        }
    }

    /// Goes on beyond a value of `t` where the margin vanishes without being negative: boxes with their
    /// corner there decide what boxes across it cannot.
    fn pass_touching_wave(&mut self, lower: Rational, upper: Rational) -> Stretch {
        if lower >= upper || self.touches == MAX_TOUCHES {
            return Stretch::Undecided(lower, upper);
        }
        self.touches += 1;
        let touch = simplest_between(&lower, &upper);
        let beyond = (&touch * (integer(1) + power_of_half(10))).min(self.end.clone());
        if touch.is_zero()
            || self.is_stable(&lower, &touch).is_err()
            || self.is_stable(&touch, &beyond).is_err()
        {
            return Stretch::Undecided(lower, upper);
        }
        match self.stable_stretch(&beyond) {
            Stretch::Empty(s) => Stretch::Ends(Edge { lower: beyond.clone(), upper: beyond, s }),
            other => other,
        }
    }

    /// Where above `from` the wave with this `s` begins to be unstable for all data within the radii.
    fn certainly_unstable_from(&mut self, from: &Rational, s: &Rational) -> Option<Rational> {
        self.work.evaluations += 1;
        let raised = self.form.integers_at(s, 1).into_iter().map(Rational::from).collect();
        let roots = real_roots(&Polynomial::new(raised), from, &self.end, self.root_bits());
        let mut ends = roots.into_iter().map(|root| root.upper);
        ends.find(|end| self.is_unstable_just_above(end, s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::ratio;
    use crate::scheme::Step;
    use crate::stability::DEFAULT_BITS;
    use crate::stability::testing::margin;

    /// What is said beyond a touch between two values, after so many others, where upwind with `1 − (1 − C)(2 − C)/4` in place of `C` is
    /// stable: on `[0, 1]` and from 2 to 3.5.
    fn beyond(
        range: Rational,
        touches: usize,
        lower: Rational,
        upper: Rational,
    ) -> (Stretch, usize) {
        let text = "u[n+1,j] = u[n,j] - (1 - (1 - C)*(2 - C)/4)*(u[n,j] - u[n,j-1])";
        let margin = Step::from_text(text).unwrap().gain_margin("C", &integer(0));
        let margin = margin.unwrap().unwrap();
        assert_eq!(margin.stride(), 1);
        let mut search = Search::new(&margin, &range, DEFAULT_BITS);
        search.touches = touches;
        let found = search.pass_touching_wave(lower, upper);
        (found, search.touches)
    }

    #[test]
    fn a_touch_is_passed_only_where_both_sides_are_proved() {
        let open = |lower: Rational, upper: Rational, touches| {
            let found = beyond(integer(3), touches, lower.clone(), upper.clone());
            matches!(found.0, Stretch::Undecided(a, b) if (&a, &b) == (&lower, &upper))
        };
        // Unstable below 2, unstable above 1, nothing to tell from 0, no length, one too many.
        assert!(open(ratio(3, 2), ratio(5, 2), 0) && open(ratio(1, 2), ratio(3, 2), 0));
        assert!(open(integer(0), ratio(1, 2), 0) && open(ratio(1, 2), ratio(1, 2), 0));
        assert!(open(ratio(1, 4), ratio(3, 4), MAX_TOUCHES));
        // Stable on both sides of 1/2: the stretch ends at 1, or beyond the range.
        for touches in [0, MAX_TOUCHES - 1] {
            let (found, passed) = beyond(integer(3), touches, ratio(1, 4), ratio(3, 4));
            assert_eq!(passed, touches + 1);
            assert!(
                matches!(found, Stretch::Ends(edge) if edge.lower <= integer(1) && edge.upper >= integer(1))
            );
        }
        let (found, _) = beyond(ratio(1, 2), 0, ratio(1, 4), ratio(3, 4));
        assert!(matches!(found, Stretch::Continues));
    }

    #[test]
    fn a_stretch_is_empty_only_where_that_is_proved() {
        // 1 − t: next to 1, where samples do not tell whether instability has begun.
        let line = margin(&[&[1], &[-1]], &integer(0));
        let search = || Search::new(&line, &integer(4), DEFAULT_BITS);
        let below = integer(1) - ratio(1, 10_000_000_000_000);
        let Stretch::Ends(edge) = search().stable_stretch(&below) else { panic!() };
        assert!(edge.lower > below && edge.upper >= integer(1));
        assert!(matches!(search().stable_stretch(&integer(1)), Stretch::Empty(_)));
        // From where a wave is unstable there is no stretch at all.
        let at = |t: i64| Some(Box::new((integer(0), integer(t))));
        assert!(matches!(search().bisect(&integer(2), at(2)), Stretch::Empty(_)));
        let mut asked = search();
        let Stretch::Ends(edge) = asked.bisect(&integer(0), at(3)) else { panic!() };
        assert_eq!(asked.work.cells, 0);
        assert!(edge.lower <= integer(1) && edge.upper >= integer(1));
        assert!(&edge.upper - &edge.lower < ratio(1, 1 << 50));
        // Also where halving meets the end.
        let Stretch::Ends(edge) = search().bisect(&integer(0), at(2)) else { panic!() };
        assert_eq!(edge.lower, integer(1));
        // s − t
        let at_once = margin(&[&[0, 1], &[-1]], &integer(0));
        let found = Search::new(&at_once, &integer(4), DEFAULT_BITS).bisect(&integer(0), at(2));
        assert!(matches!(found, Stretch::Empty(_)));
        // Within 2^−20 of 3 − t: up to where some data may be unstable, from where all are.
        let width = ratio(1, 1 << 20);
        let blurred = margin(&[&[3 << 20], &[-(1 << 20)]], &integer(1));
        let mut search = Search::new(&blurred, &integer(4), DEFAULT_BITS);
        let Stretch::Ends(edge) = search.bisect(&integer(0), at(4)) else { panic!() };
        assert!(edge.lower <= integer(3) - &width && edge.upper >= integer(3) + &width);
        // Nothing ends before where it begins.
        let width = ratio(1, 1 << 40);
        let blurred = margin(&[&[3 << 40], &[-(1 << 40)]], &integer(1));
        let from = integer(3) - &width;
        let found = Search::new(&blurred, &integer(4), DEFAULT_BITS).stable_stretch(&from);
        let Stretch::Ends(edge) = found else { panic!() };
        assert!(edge.lower >= from && edge.upper >= integer(3) + &width);
    }

    #[test]
    fn a_touch_that_rounding_takes_for_an_end_is_none() {
        // (5t − 11)² (t + 7), with 1000 times s, 1 − s, or (2s − 1)² beside it.
        for first in [&[847, 1000][..], &[1847, -1000], &[1847, -4000, 4000]] {
            let touching = margin(&[first, &[-649], &[65], &[25]], &integer(0));
            let mut search = Search::new(&touching, &integer(4), DEFAULT_BITS);
            assert!(!search.guesses.is_empty());
            assert!(matches!(search.stable_stretch(&integer(0)), Stretch::Continues));
            // At an end of the range of phases by cells alone.
            assert_eq!(search.work.boxes == 0, first.len() == 2);
        }
    }

    #[test]
    fn a_wave_is_certainly_unstable_where_all_data_say_so() {
        // Within 1 of (t − 1)² (3 − t) − 1, which is at most 0 from 3 on, and only touches it at 1.
        let margin = margin(&[&[2], &[-7], &[5], &[-1]], &integer(1));
        let from = |from: i64, end: i64| {
            let mut search = Search::new(&margin, &integer(end), DEFAULT_BITS);
            let found = search.certainly_unstable_from(&integer(from), &integer(0));
            // Once for the roots, and for each what is just above it.
            (found, search.work.evaluations)
        };
        assert_eq!([from(0, 4), from(1, 4)], [3, 2].map(|asked| (Some(integer(3)), asked)));
        assert_eq!([from(0, 2), from(3, 4)], [(None, 2), (None, 1)]);
    }
}
