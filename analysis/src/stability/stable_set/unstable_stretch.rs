//! Unstable stretches: covered by waves that grow throughout.

use super::edge::Edge;
use super::phase_parameter;
use super::search::Search;
use crate::exact::bernstein::is_negative_integer_polynomial;
use crate::exact::rational::{Rational, integer, to_f64};
use crate::stability::critical::resolving_phases;

/// How often an unstable stretch may be halved in search of witnesses.
const MAX_HALVINGS: u32 = 48;

impl Search<'_> {
    /// Proves the stretch from `from` to the next stable one unstable. Returns where it ends (`None`:
    /// not within the range) and what of it stays undecided, as Courant numbers.
    pub(super) fn unstable_stretch(
        &mut self,
        from: &Rational,
        witness: Rational,
    ) -> (Option<Edge>, Vec<(f64, f64)>) {
        let start = to_f64(from);
        let covering =
            self.guesses.iter().find(|unstable| unstable.to.parameter > start * (1.0 + 1e-12));
        let guess = covering
            .map(|unstable| unstable.to)
            .filter(|to| to.parameter < to_f64(&self.end) * (1.0 - 1e-12));
        let edge = guess
            .and_then(|guess| self.upper_edge(guess).or_else(|| self.upper_edge_of_cells(from)));
        let to = edge.as_ref().map_or_else(|| self.end.clone(), |edge| edge.lower.clone());
        let mut witnesses = vec![witness];
        witnesses.extend(edge.as_ref().map(|edge| edge.s.clone()));
        let mut gaps = self.not_covered(from, to, &witnesses);
        gaps.retain(|(lower, upper)| !self.is_unstable_but_for_points(lower, upper));
        let gaps = gaps.iter().map(|(lower, upper)| self.courant_numbers(lower, upper)).collect();
        (edge, gaps)
    }

    /// Whether some wave grows at every value between two Courant numbers: proved, or not known.
    pub(super) fn is_unstable_throughout(&mut self, lower: &Rational, upper: &Rational) -> bool {
        let power = self.margin.stride() as i32;
        self.not_covered(&lower.pow(power), upper.pow(power), &[]).is_empty()
    }

    /// The parts of a stretch that neither these waves nor those which floating point sees grow are proved to make unstable.
    pub(super) fn not_covered(
        &mut self,
        from: &Rational,
        to: Rational,
        witnesses: &[Rational],
    ) -> Vec<(Rational, Rational)> {
        let mut gaps: Vec<(Rational, Rational)> = Vec::new();
        let mut failures = 0;
        let mut pending = vec![(from.clone(), to, MAX_HALVINGS)];
        while let Some((lower, upper, halvings)) = pending.pop() {
            if lower >= upper {
                continue;
            }
            if !self.form.is_wanted() {
                gaps.push((lower, upper));
                break;
            }
            let middle = (&lower + &upper) / integer(2);
            let sampled = self.most_unstable(to_f64(&middle));
            let candidates = witnesses.iter().chain(&sampled);
            let mut unstable = false;
            for s in candidates {
                self.work.evaluations += 1;
                let values = self.form.integers_at(s, 1);
                if is_negative_integer_polynomial(&values, &lower, &upper) == Some(true) {
                    unstable = true;
                    break;
                }
            }
            if unstable {
                continue;
            }
            failures += 1;
            if halvings == 0 || failures > self.patience {
                match gaps.last_mut() {
                    Some(last) if last.1 == lower => last.1 = upper,
                    _ => gaps.push((lower, upper)),
                }
                continue;
            }
            pending.push((middle.clone(), upper, halvings - 1));
            pending.push((lower, middle, halvings - 1));
        }
        gaps
    }

    /// The `s` of the resolving phase whose margin is lowest at `t`, if it is negative at all.
    pub(super) fn most_unstable(&self, t: f64) -> Option<Rational> {
        let mut powers = Vec::new();
        resolving_phases(self.margin.degree())
            .map(|phase| {
                self.compiled.powers_at(phase, &mut powers);
                (phase, powers.iter().rev().fold(0.0, |sum, p| sum * t + p))
            })
            .filter(|(_, value)| *value < 0.0)
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(phase, _)| phase_parameter(phase))
    }
}
