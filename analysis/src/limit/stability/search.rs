//! The walk along the Courant numbers: stable stretch, edge, unstable stretch, edge, …

use super::edge::Edge;
use super::{DEFAULT_BITS, MAX_BOXES, StableInterval, StableSet, phase_parameter};
use crate::bernstein::{MarginForm, Sign, Work, is_negative_integer_polynomial};
use crate::limit::critical::{UnstableInterval, refine, resolving_phases, sampled_unstable_set};
use crate::limit::critical_polynomial::CriticalPolynomials;
use crate::limit::cylinder::Cell;
use crate::limit::pointwise::{PointVerdict, decide_at_parameter};
use crate::limit::{Evidence, Limit};
use crate::margin::{CompiledMargin, Margin};
use crate::polynomial::Polynomial;
use crate::rational::{Rational, integer, simplest_between, to_f64};
use crate::real_roots::{power_of_two, real_roots};
use num_bigint::BigInt;
use num_traits::Zero;
use std::cell::OnceCell;

/// Boxes the first decision may look at, and pieces the range of `t` may be cut into, for a margin of
/// higher than first degree in `t`.
const FIRST_BOXES: usize = 250;
const MAX_PIECES: usize = 24;

/// The last relative width of an enclosure that is tried, as a power of one half.
const LAST_WIDTH: u32 = 22;

/// From so many bits on, edges are recognised as roots of polynomials: who asks for less wants it quickly.
const RECOGNISING_BITS: u32 = 52;

/// Bisection towards 0 stops at this power of one half of the range.
const FLOOR_BITS: u32 = 120;

/// How many touching waves are passed in one search.
const MAX_TOUCHES: usize = 16;

/// How often an unstable stretch may be halved in search of witnesses.
const MAX_HALVINGS: u32 = 48;

/// How many pieces of an unstable stretch may resist before it is no longer halved.
const MAX_FAILURES: usize = 2000;

/// How many stretches of one kind are followed before the rest is left undecided.
const MAX_STRETCHES: usize = 64;

/// Products of residues that a discriminant may cost when nobody asked for it: some milliseconds.
const AFFORDABLE_PRODUCTS: usize = 600_000;

/// How many times more it may cost when more digits than an `f64` has were asked for.
const PATIENCE: usize = 50;

/// A point `(s, t)` where the margin is negative.
type Counterexample = Box<(Rational, Rational)>;

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

pub(super) struct Search<'a> {
    pub(super) margin: &'a Margin,
    pub(super) form: MarginForm,
    pub(super) compiled: CompiledMargin,
    guesses: Vec<UnstableInterval>,
    pub(super) end: Rational,
    /// The relative width of the ends that is asked for, as a power of one half.
    pub(super) bits: u32,
    /// Up to this `t` everything is known to be stable.
    known: Rational,
    critical: OnceCell<Option<CriticalPolynomials>>,
    touches: usize,
    pub(super) work: Work,
}

impl<'a> Search<'a> {
    pub(super) fn new(margin: &'a Margin, max_courant: &Rational, bits: u32) -> Self {
        let compiled = margin.compile();
        let end = max_courant.pow(margin.stride() as i32);
        let guesses =
            sampled_unstable_set(&compiled, resolving_phases(margin.degree()), to_f64(&end));
        let bits = bits.max(4).min(justified_bits(margin).max(DEFAULT_BITS));
        Self {
            margin,
            form: MarginForm::new(margin).resolving(bits),
            compiled,
            guesses,
            known: Rational::zero(),
            end,
            bits,
            critical: OnceCell::new(),
            touches: 0,
            work: Work::default(),
        }
    }

    /// Starts from a Courant number up to which stability is known.
    pub(super) fn knowing(self, courant_number: &Rational) -> Self {
        let t = courant_number.pow(self.margin.stride() as i32);
        Self { known: t.min(self.end.clone()), ..self }
    }

    /// The polynomials whose roots are the critical values, if the data are exact and the cost is fair.
    pub(super) fn critical_polynomials(&self) -> Option<&CriticalPolynomials> {
        let wanted = self.margin.is_exact() && self.bits >= RECOGNISING_BITS;
        let patience = if self.bits > RECOGNISING_BITS { PATIENCE } else { 1 };
        let compute = || CriticalPolynomials::new(self.margin, patience * AFFORDABLE_PRODUCTS);
        self.critical.get_or_init(|| wanted.then(compute).flatten()).as_ref()
    }

    pub(super) fn run(mut self, max_courant: &Rational, evidence: Evidence) -> StableSet {
        let mut intervals = Vec::new();
        let mut undecided = Vec::new();
        let mut immediately_unstable_phase = None;
        let mut from = Edge::zero();
        let mut reached = self.known.clone();
        for _ in 0..MAX_STRETCHES {
            let witness = match self.stable_stretch(&reached) {
                Stretch::Continues => {
                    let to = Limit::beyond(max_courant, evidence);
                    let from = self.limit(&from, evidence);
                    intervals.push(StableInterval { from, to });
                    break;
                }
                Stretch::Undecided(lower, upper) => {
                    // A sliver is stepped over; otherwise all of the rest is open.
                    let widest = LAST_WIDTH.min(self.bits);
                    let sliver = &upper - &lower <= &upper * power_of_half(widest);
                    let steps_over = sliver && lower > from.upper;
                    let open =
                        self.courant_numbers(&lower, if steps_over { &upper } else { &self.end });
                    if lower > from.upper {
                        // Nothing is known to grow above: an end of what is proved, not of what is stable.
                        let to = Limit::between(open.0, open.1, Evidence::Undecided);
                        let from = self.limit(&from, evidence);
                        intervals.push(StableInterval { from, to });
                    }
                    undecided.push(open);
                    if !steps_over {
                        break;
                    }
                    reached = upper.clone();
                    from = Edge { lower, upper, s: from.s };
                    continue;
                }
                Stretch::Empty(s) if reached > from.upper => {
                    // Stable up to here, as was known, and not above.
                    let edge =
                        Edge { lower: reached.clone(), upper: reached.clone(), s: s.clone() };
                    let (from_limit, to) =
                        (self.limit(&from, evidence), self.limit(&edge, evidence));
                    intervals.push(StableInterval { from: from_limit, to });
                    from = edge;
                    s
                }
                Stretch::Empty(s) => {
                    if from.upper.is_zero() {
                        immediately_unstable_phase = Some(self.fastest_growing_phase());
                    }
                    s
                }
                Stretch::Ends(edge) => {
                    let s = edge.s.clone();
                    let (from_limit, to) =
                        (self.limit(&from, evidence), self.limit(&edge, evidence));
                    intervals.push(StableInterval { from: from_limit, to });
                    from = edge;
                    s
                }
            };
            match self.unstable_stretch(&from.upper, witness) {
                (None, gaps) => {
                    undecided.extend(gaps);
                    break;
                }
                (Some(edge), gaps) => {
                    undecided.extend(gaps);
                    reached = edge.upper.clone();
                    from = edge;
                }
            }
        }
        StableSet {
            intervals,
            undecided,
            immediately_unstable_phase,
            neutral: false,
            evidence,
            work: self.work,
        }
    }

    /// The relative widths to try, as powers of one half.
    pub(super) fn widths(&self) -> impl Iterator<Item = u32> + use<> {
        let last = LAST_WIDTH.min(self.bits);
        std::iter::successors(Some(self.bits), |bits| Some(bits - (bits / 16).max(3)))
            .take_while(move |&bits| bits >= last)
    }

    /// Proves `[from, end of the stretch]` stable.
    fn stable_stretch(&mut self, from: &Rational) -> Stretch {
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
            let s = phase_parameter(guess.phase);
            if self.is_unstable_just_above(from, &s) {
                return Stretch::Empty(s);
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
                    self.widths().map(|bits| &root.lower * (integer(1) - power_of_half(bits - 2))),
                );
            }
            for lower in lowers {
                if lower > *from
                    && self.is_unstable_just_above(&root.upper, &s)
                    && self.is_stable(from, &lower).is_ok()
                {
                    return Stretch::Ends(Edge { lower, upper: root.upper, s });
                }
            }
        }
        let mut counterexample = None;
        if let Some(edge) = self.interior_edge(refined) {
            for bits in self.widths() {
                let lower = &edge.upper * (integer(1) - power_of_half(bits));
                if lower <= *from {
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
        while &upper - &lower > &upper * power_of_half(self.bits) {
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
                    upper = found.1.min(middle);
                    witness = Some(found.0);
                }
                Err(None) => {
                    witness = None;
                    upper = middle;
                }
            }
            if upper <= *from {
                break;
            }
        }
        match witness {
            Some(s) if upper <= *from => Stretch::Empty(s),
            Some(s) if self.is_unstable_just_above(&upper, &s) => {
                Stretch::Ends(Edge { lower, upper, s })
            }
            Some(s) if !self.margin.is_exact() => match self.certainly_unstable_from(&upper, &s) {
                Some(upper) => Stretch::Ends(Edge { lower, upper, s }),
                None => Stretch::Undecided(lower, self.end.clone()),
            },
            _ => self.pass_touching_wave(lower, upper),
        }
    }

    /// The end of a stable stretch from the critical polynomials.
    fn stretch_of_cells(&mut self, from: &Rational) -> Option<Stretch> {
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
    fn upper_edge_of_cells(&mut self, from: &Rational) -> Option<Edge> {
        let cells = self.cells(from, &self.end.clone())?;
        let stable = cells.iter().skip(1).position(|cell| cell.unstable_wave.is_none())? + 1;
        let (lower, upper) = cells[stable].from.clone();
        let s = cells[stable - 1].unstable_wave.clone()?;
        Some(Edge { lower, upper, s })
    }

    /// Whether single values of `t` are all that may be stable between the two, which is no interval.
    fn is_unstable_but_for_points(&mut self, lower: &Rational, upper: &Rational) -> bool {
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
        if beyond == self.end {
            return Stretch::Continues;
        }
        match self.stable_stretch(&beyond) {
            Stretch::Empty(s) => Stretch::Ends(Edge { lower: beyond.clone(), upper: beyond, s }),
            other => other,
        }
    }

    /// Proves the stretch from `from` to the next stable one unstable. Returns where it ends (`None`:
    /// not within the range) and what of it stays undecided, as Courant numbers.
    fn unstable_stretch(
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
        let mut gaps: Vec<(Rational, Rational)> = Vec::new();
        let mut failures = 0;
        let mut pending = vec![(from.clone(), to, MAX_HALVINGS)];
        while let Some((lower, upper, halvings)) = pending.pop() {
            if lower >= upper {
                continue;
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
            if halvings == 0 || gaps.len() > 8 || failures > MAX_FAILURES {
                match gaps.last_mut() {
                    Some(last) if last.1 == lower => last.1 = upper,
                    _ => gaps.push((lower, upper)),
                }
                continue;
            }
            pending.push((middle.clone(), upper, halvings - 1));
            pending.push((lower, middle, halvings - 1));
        }
        gaps.retain(|(lower, upper)| !self.is_unstable_but_for_points(lower, upper));
        let gaps = gaps.iter().map(|(lower, upper)| self.courant_numbers(lower, upper)).collect();
        (edge, gaps)
    }

    /// `Ok` when `[from, to]` is proved stable, else a counterexample `(s, t)` if one was met.
    pub(super) fn is_stable(
        &mut self,
        from: &Rational,
        to: &Rational,
    ) -> Result<(), Option<Counterexample>> {
        // Boxes are halved in `s` only, which suffices where the margin is at most linear in `t`. Of a
        // higher degree its Bernstein coefficients in `t` may stay negative; then `t` is halved too.
        // A touching point is halved down to as many bits as the ends have.
        let most_boxes = MAX_BOXES.max(8 * self.bits as usize);
        let (mut pieces, mut boxes) =
            if self.margin.powers() <= 2 { (1, most_boxes) } else { (MAX_PIECES, FIRST_BOXES) };
        let mut pending = vec![(from.clone(), to.clone())];
        while let Some((lower, upper)) = pending.pop() {
            let (sign, work) = self.form.sign(&lower, &upper, boxes);
            self.work += work;
            pieces -= 1;
            match sign {
                Sign::NowhereNegative => {}
                Sign::SomewhereNegative { phase_parameter, courant_parameter } => {
                    return Err(Some(Box::new((phase_parameter, courant_parameter))));
                }
                Sign::Undecided if pieces <= pending.len() + 1 => return Err(None),
                Sign::Undecided => {
                    let middle = (&lower + &upper) / integer(2);
                    pending.push((middle.clone(), upper));
                    pending.push((lower, middle));
                    boxes = (boxes * 2).min(most_boxes);
                }
            }
        }
        Ok(())
    }

    /// Where above `from` the wave with this `s` begins to be unstable for all data within the radii.
    fn certainly_unstable_from(&mut self, from: &Rational, s: &Rational) -> Option<Rational> {
        self.work.evaluations += 1;
        let raised = self.form.integers_at(s, 1).into_iter().map(Rational::from).collect();
        let roots = real_roots(&Polynomial::new(raised), from, &self.end, self.root_bits());
        let mut ends = roots.into_iter().map(|root| root.upper);
        ends.find(|end| self.is_unstable_just_above(end, s))
    }

    /// Whether the wave with this `s` is unstable on some interval `(from, from + δ)`.
    fn is_unstable_just_above(&mut self, from: &Rational, s: &Rational) -> bool {
        self.work.evaluations += 1;
        let values = self.form.integers_at(s, 1);
        let step =
            if from.is_zero() { &self.end * power_of_half(60) } else { from * power_of_half(60) };
        is_negative_integer_polynomial(&values, from, &(from + step)) == Some(true)
    }

    /// The `s` of the resolving phase whose margin is lowest at `t`, if it is negative at all.
    fn most_unstable(&self, t: f64) -> Option<Rational> {
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

    /// The wave that grows fastest as `C → 0`.
    fn fastest_growing_phase(&self) -> f64 {
        let mut powers = Vec::new();
        resolving_phases(self.margin.degree())
            .map(|phase| {
                self.compiled.powers_at(phase, &mut powers);
                (phase, powers[0] * self.compiled.phase_factor(phase))
            })
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(0.0, |(phase, _)| phase)
    }
}

/// How many bits the data settle: their size over their uncertainty.
fn justified_bits(margin: &Margin) -> u32 {
    let largest = |values: &mut dyn Iterator<Item = &BigInt>| values.map(BigInt::bits).max();
    let radius = largest(&mut margin.integer_radius().iter()).unwrap_or(0);
    let size = margin.integer_series().iter().flat_map(|series| series.coefficients());
    match (radius, largest(&mut size.into_iter())) {
        (0, _) | (_, None) => u32::MAX,
        (radius, Some(size)) => u32::try_from(size.saturating_sub(radius)).unwrap_or(u32::MAX),
    }
}

pub(super) fn power_of_half(bits: u32) -> Rational {
    power_of_two(-i64::from(bits))
}
