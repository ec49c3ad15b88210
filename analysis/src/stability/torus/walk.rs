//! The walk along the parameter: stable stretch, edge, unstable stretch, edge, …

use super::TorusDemands;
use super::guess::{Critical, Spot};
use super::search::{Edge, ExactSpot, Objection, Search};
use crate::exact::rational::{
    Rational, integer, square_root_enclosure, to_f64, to_f64_above, to_f64_below,
};
use crate::exact::real_roots::power_of_two;
use crate::stability::stable_set::{StableInterval, StableSet};
use crate::stability::{Evidence, ExactValue, Limit, SearchPlan, Wave};
use num_traits::Zero;

/// How many stretches of one kind are followed before the rest is left undecided.
const MOST_STRETCHES: usize = 64;

/// How often a guess that a counterexample disproves is replaced.
const MOST_GUESSES: usize = 12;

/// Waves that one unstable stretch may need.
const MOST_WAVES: usize = 400;

/// Samples that are tried exactly, the most promising first.
const MOST_TRIED: usize = 8;

/// The relative width of an enclosure that is tried at last, as a power of one half.
const LAST_WIDTH: u32 = 20;

/// Ends nearer than this are one.
const SAME: f64 = 1e-8;

/// Where all conditions hold, by the values of a parameter `C` with `t = C^stride`.
pub(crate) fn stable_set_on_torus(demands: &TorusDemands, plan: &SearchPlan) -> StableSet {
    Walk::new(demands, plan).run()
}

/// The stable stretches of `t` with the waves at their ends, as far as everything is decided; and a wave that is unstable at once.
pub(crate) struct Stretches {
    pub(crate) all: Vec<StableStretch>,
    pub(crate) unstable_at_once: Option<ExactSpot>,
    pub(crate) decided: bool,
}

/// A stable stretch of `t`.
pub(crate) struct StableStretch {
    pub(crate) from: Edge,
    pub(crate) to: StretchEnd,
}

/// Where a stable stretch ends.
pub(crate) enum StretchEnd {
    /// Lost here, and a wave that is unstable just above.
    Edge(Box<Edge>, ExactSpot),
    /// At the end of the range.
    Range,
    /// Nowhere.
    Unbounded,
}

/// What [`stable_set_on_torus`] finds, exactly.
pub(crate) fn stretches_on_torus(demands: &TorusDemands, plan: &SearchPlan) -> Stretches {
    let mut walk = Walk::new(demands, plan);
    let decided = walk.run().undecided.is_empty();
    let Walk { stretches: all, unstable_at_once, .. } = walk;
    Stretches { all, unstable_at_once, decided }
}

struct Walk<'a> {
    search: Search<'a>,
    stride: usize,
    plan: &'a SearchPlan,
    stretches: Vec<StableStretch>,
    unstable_at_once: Option<ExactSpot>,
}

enum Stretch {
    /// Stable to the end of the range.
    Continues,
    /// Stable up to here.
    Ends(Edge),
    /// Unstable at once.
    Empty(ExactSpot),
    /// Not decided between these.
    Undecided(Rational, Rational),
}

impl<'a> Walk<'a> {
    fn new(demands: &'a TorusDemands, plan: &'a SearchPlan) -> Self {
        let TorusDemands { inequalities, stride } = demands;
        let end = plan.max.pow(*stride as i32);
        let search = Search::new(inequalities, end, plan.bits, plan.budget);
        let search = search.while_wanted(&plan.interest);
        let (stretches, unstable_at_once) = (Vec::new(), None);
        Self { search, stride: *stride, plan, stretches, unstable_at_once }
    }

    fn run(&mut self) -> StableSet {
        let neutral = self.search.inequalities.iter().all(|one| one.cells.is_empty());
        let mut set = StableSet { neutral, ..StableSet::empty(Evidence::Proved) };
        let zero = Edge { lower: Rational::zero(), upper: Rational::zero(), spot: None };
        let mut from = zero.clone();
        let mut reached = self.plan.known.pow(self.stride as i32).min(self.search.end.clone());
        for stretches in 0.. {
            if stretches == MOST_STRETCHES {
                let open = self.values(&reached, &self.search.end.clone());
                set.undecided.push(open);
                break;
            }
            let (edge, spot) = match self.stable_stretch(&reached) {
                Stretch::Continues => {
                    let (to, end) = if self.search.is_stable_beyond() {
                        (Limit::unbounded(&self.plan.max, Evidence::Proved), StretchEnd::Unbounded)
                    } else {
                        (Limit::beyond(&self.plan.max, Evidence::Proved), StretchEnd::Range)
                    };
                    set.intervals.push(StableInterval { from: self.limit(&from), to });
                    self.stretches.push(StableStretch { from, to: end });
                    break;
                }
                Stretch::Undecided(lower, upper) => {
                    let open = self.values(&lower, &upper);
                    if lower > from.upper {
                        let to = Limit::between(open.0, open.1, Evidence::Undecided);
                        set.intervals.push(StableInterval { from: self.limit(&from), to });
                    }
                    set.undecided.push(open);
                    break;
                }
                Stretch::Empty(spot) => {
                    let edge = Edge {
                        lower: reached.clone(),
                        upper: reached.clone(),
                        spot: Some(spot.clone()),
                    };
                    if reached.is_zero() {
                        set.immediately_unstable = Some(self.wave(&spot));
                        let binding = self.search.inequalities[spot.inequality].binding;
                        set.immediate_binding = Some(binding);
                        self.unstable_at_once = Some(spot.clone());
                    }
                    (edge, spot)
                }
                Stretch::Ends(edge) => {
                    let spot = edge.spot.clone().expect("stability ends by a wave");
                    (edge, spot)
                }
            };
            // An edge is where a wave becomes unstable, not where one touches.
            let Some((wave, until)) = self.unstable_just_above(&edge.upper, spot) else {
                if edge.lower == edge.upper {
                    reached = edge.upper;
                    continue;
                }
                let open = self.values(&edge.lower, &self.search.end.clone());
                let to = Limit::between(open.0, open.1, Evidence::Undecided);
                set.intervals.push(StableInterval { from: self.limit(&from), to });
                set.undecided.push(open);
                break;
            };
            if edge.upper > from.upper {
                set.intervals.push(self.ended(from, &edge, wave));
            }
            if self.plan.first_only {
                break;
            }
            match self.unstable_stretch(until) {
                Ok(None) => break,
                Ok(Some(edge)) => {
                    reached = edge.upper.clone();
                    from = edge;
                }
                Err(gap) => {
                    let open = self.values(&gap, &self.search.end.clone());
                    set.undecided.push(open);
                    break;
                }
            }
        }
        set.work = self.search.work;
        set
    }

    /// A stable stretch up to an edge.
    fn ended(&mut self, from: Edge, edge: &Edge, wave: ExactSpot) -> StableInterval {
        let interval = StableInterval { from: self.limit(&from), to: self.limit(edge) };
        let to = StretchEnd::Edge(Box::new(edge.clone()), wave);
        self.stretches.push(StableStretch { from, to });
        interval
    }

    /// From a value on that is stable, or the start.
    fn stable_stretch(&mut self, reached: &Rational) -> Stretch {
        let at = to_f64(reached);
        let mut guess = loop {
            match self.search.guesses.next_unstable(at * (1.0 + SAME)) {
                None => break None,
                Some((from, _)) if from.parameter <= at * (1.0 + SAME) => {
                    if let Some(spot) = self.unstable_at_once(reached) {
                        return Stretch::Empty(spot);
                    }
                    // A rounding: no such wave is unstable.
                    self.search.guesses.discard(at * (1.0 + SAME));
                }
                Some((from, _)) => break Some(self.search.guesses.refined(&from, true)),
            }
        };
        let mut may_end = None;
        for _ in 0..MOST_GUESSES {
            let objection = if let Some(critical) = &guess {
                let Some(edge) = self.search.edge(critical) else {
                    if let Some(spot) = self.unstable_near(reached, &critical.spot) {
                        return Stretch::Empty(spot);
                    }
                    // A rounding: that wave has no edge there.
                    self.search.guesses.discard(critical.parameter);
                    let next = self.search.guesses.next_unstable(at * (1.0 + SAME));
                    guess = next.map(|(from, _)| self.search.guesses.refined(&from, true));
                    continue;
                };
                may_end = Some(edge.lower.clone());
                match self.closed(reached, edge) {
                    Ok(edge) => return Stretch::Ends(edge),
                    Err(objection) => objection,
                }
            } else {
                let end = self.search.end.clone();
                match self.search.is_stable(reached, &end) {
                    Ok(()) => return Stretch::Continues,
                    Err(objection) => objection,
                }
            };
            match objection {
                Objection::Budget => break,
                Objection::Wave(spot, t) => guess = self.of_counterexample(&spot, &t),
            }
        }
        // What can be proved of it: ever less of the way to where it may end.
        let to = may_end.unwrap_or_else(|| self.search.end.clone());
        for bits in [14, 8, 4, 2, 1, 0] {
            self.search.allow_more();
            let part = match bits {
                0 => integer(1) / integer(4),
                bits => integer(1) - power_of_two(-bits),
            };
            let to = reached + (&to - reached) * part;
            if self.search.is_stable(reached, &to).is_ok() {
                return Stretch::Undecided(to, self.search.end.clone());
            }
        }
        Stretch::Undecided(reached.clone(), self.search.end.clone())
    }

    /// A wave that is unstable just above a value: proved.
    fn unstable_at_once(&mut self, reached: &Rational) -> Option<ExactSpot> {
        let samples: Vec<Spot> = self.search.guesses.unstable_above(to_f64(reached));
        samples.iter().take(MOST_TRIED).find_map(|sample| self.unstable_near(reached, sample))
    }

    /// The same next to a sample.
    fn unstable_near(&mut self, reached: &Rational, sample: &Spot) -> Option<ExactSpot> {
        let mut spots = self.search.exact_spots(sample).into_iter();
        spots.find(|spot| self.search.unstable_until(reached, spot).is_some())
    }

    /// An edge up to which everything is proved stable: the exact one, else one a little lower.
    fn closed(&mut self, reached: &Rational, edge: Edge) -> Result<Edge, Objection> {
        if edge.lower == edge.upper && self.search.is_easily_stable(reached, &edge.lower) {
            return Ok(edge);
        }
        let (bits, mut last) = (self.search.bits, Objection::Budget);
        let widths = std::iter::successors(Some(bits), |bits| Some(bits - (bits / 6).max(3)));
        for width in widths.take_while(|&bits| bits >= LAST_WIDTH) {
            let lower = &edge.lower * (integer(1) - power_of_two(-i64::from(width)));
            if lower <= *reached {
                // Stable up to here already; but a wave that was found below the edge leads to the true one.
                let beyond = edge.lower >= *reached && matches!(last, Objection::Budget);
                return if beyond {
                    Ok(Edge { lower: reached.clone(), ..edge })
                } else {
                    Err(last)
                };
            }
            match self.search.is_stable(reached, &lower) {
                Ok(()) => return Ok(Edge { lower, ..edge }),
                Err(objection) => last = objection,
            }
        }
        Err(last)
    }

    /// The guess that a counterexample suggests.
    fn of_counterexample(&mut self, spot: &ExactSpot, t: &Rational) -> Option<Critical> {
        let point = spot.point.iter().map(to_f64).collect();
        let spot = Spot { inequality: spot.inequality, cell: spot.cell, point };
        let guess = Critical { parameter: to_f64(t), spot };
        Some(self.search.guesses.refined(&guess, true))
    }

    /// A wave that is unstable just above an edge, that of the edge or another, and up to where.
    fn unstable_just_above(
        &mut self,
        edge: &Rational,
        first: ExactSpot,
    ) -> Option<(ExactSpot, Rational)> {
        if let Some(until) = self.search.unstable_until(edge, &first) {
            return Some((first, until));
        }
        let other = self.unstable_at_once(edge)?;
        let until = self.search.unstable_until(edge, &other)?;
        Some((other, until))
    }

    /// Waves that are unstable one after the other, from a value on up to which that is known: up to the edge where stability returns, `None` to the end of the range. The error is
    /// the value from which on nothing is known.
    fn unstable_stretch(&mut self, mut reached: Rational) -> Result<Option<Edge>, Rational> {
        for _ in 0..MOST_WAVES {
            if reached >= self.search.end {
                return Ok(None);
            }
            let at = to_f64(&reached);
            let candidates = self.search.guesses.unstable_above(at);
            let further = candidates.iter().take(MOST_TRIED).find_map(|spot| {
                let [.., plain] = &self.search.exact_spots(spot)[..] else { return None };
                self.search.unstable_until(&reached, plain)
            });
            match further {
                Some(until) => reached = until,
                None => return self.end_of_instability(&reached).map(Some),
            }
        }
        Err(reached)
    }

    /// The edge beyond which no sample is unstable.
    fn end_of_instability(&mut self, reached: &Rational) -> Result<Edge, Rational> {
        let at = to_f64(reached);
        let unstable = self.search.guesses.next_unstable(at * (1.0 - SAME));
        let (_, to) = unstable.ok_or_else(|| reached.clone())?;
        if to.parameter > at * (1.0 + SAME) {
            return Err(reached.clone());
        }
        let refined = self.search.guesses.refined(&to, false);
        let edge = self.search.edge(&refined).ok_or_else(|| reached.clone())?;
        // Unstable as far as the wave of the edge is; stable from a little above it on.
        let spot = edge.spot.clone().ok_or_else(|| reached.clone())?;
        let nearer = self.search.is_unstable_between(reached, &edge.lower, &spot);
        let lower = if nearer { edge.lower } else { reached.clone() };
        let bits = i64::from(self.search.bits);
        let beyond = |upper: &Rational, width| upper * (integer(1) + power_of_two(6 - width));
        let mut upper = edge.upper.clone();
        if !self.search.is_easily_stable(&upper, &beyond(&upper, bits - 12)) {
            let wider = [bits, bits - 12, bits - 20]
                .map(|width| (&edge.upper * (integer(1) + power_of_two(-width)), width));
            let found = wider.into_iter().find(|(upper, width)| {
                self.search.is_stable(upper, &beyond(upper, *width)).is_ok()
            });
            let Some((wide, _)) = found else { return Err(lower) };
            upper = wide;
        }
        Ok(Edge { lower, upper, spot: Some(spot) })
    }

    fn wave(&self, spot: &ExactSpot) -> Wave {
        self.search.inequalities[spot.inequality].cells[spot.cell].wave(&spot.point)
    }

    /// An edge in `t` as a limit on the parameter.
    fn limit(&self, edge: &Edge) -> Limit {
        let evidence = Evidence::Proved;
        let limit = match (edge.lower == edge.upper, self.stride) {
            (true, 2) => Limit::exactly(ExactValue::square_root(edge.lower.clone()), evidence),
            (true, _) => Limit::exactly(ExactValue::Fraction(edge.lower.clone()), evidence),
            (false, _) => {
                let (lower, upper) = self.enclosure(&edge.lower, &edge.upper);
                Limit::enclosed(lower, upper, evidence)
            }
        };
        match &edge.spot {
            Some(spot) => limit
                .at_wave(self.wave(spot))
                .bound_by(self.search.inequalities[spot.inequality].binding),
            None => limit,
        }
    }

    fn enclosure(&self, lower: &Rational, upper: &Rational) -> (Rational, Rational) {
        match self.stride {
            2 => square_root_enclosure(lower, upper, self.search.bits + 20),
            _ => (lower.clone(), upper.clone()),
        }
    }

    fn values(&self, lower: &Rational, upper: &Rational) -> (f64, f64) {
        let (lower, upper) = self.enclosure(lower, upper);
        (to_f64_below(&lower), to_f64_above(&upper))
    }
}

#[cfg(test)]
mod tests;
