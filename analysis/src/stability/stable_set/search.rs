//! The walk along the Courant numbers: stable stretch, edge, unstable stretch, edge, …

use super::edge::Edge;
use super::stable_stretch::Stretch;
use super::{DEFAULT_BITS, MAX_BOXES, MAX_PATIENCE, StableInterval, StableSet};
use crate::exact::bernstein::{MarginForm, Sign, Work, is_negative_integer_polynomial};
use crate::exact::rational::{Rational, integer, product, to_f64};
use crate::exact::real_roots::power_of_two;
use crate::golden_section::golden_section;
use crate::interest::Interest;
use crate::stability::critical::{UnstableInterval, resolving_phases, sampled_unstable_set};
use crate::stability::critical_polynomial::CriticalPolynomials;
use crate::stability::margin::{CompiledMargin, Margin};
use crate::stability::{Evidence, Limit, Wave};
use num_bigint::BigInt;
use num_traits::Zero;
use std::cell::OnceCell;

/// Boxes the first decision may look at, and pieces the range of `t` may be cut into, for a margin of
/// higher than first degree in `t`.
const FIRST_BOXES: usize = 250;
const MAX_PIECES: usize = 24;

/// The last relative width of an enclosure that is tried, as a power of one half.
const LAST_WIDTH: u32 = 22;

/// The part of a value below which a difference is rounding.
const ROUNDING: f64 = 1e-13;

/// How many stretches of one kind are followed before the rest is left undecided.
const MAX_STRETCHES: usize = 64;

/// Boxes one search may look at in all: where two conjugate multipliers pass through 1 a margin touches zero at a single point that
/// neither halving nor a fair discriminant decides, and the rest is left undecided.
const MOST_BOXES_IN_ALL: usize = 40_000;

/// A point `(s, t)` where the margin is negative.
pub(super) type Counterexample = Box<(Rational, Rational)>;

pub(super) struct Search<'a> {
    pub(super) margin: &'a Margin,
    pub(super) form: MarginForm,
    pub(super) compiled: CompiledMargin,
    pub(super) guesses: Vec<UnstableInterval>,
    pub(super) end: Rational,
    /// The relative width of the ends that is asked for, as a power of one half.
    pub(super) bits: u32,
    /// Up to this `t` everything is known to be stable.
    known: Rational,
    /// Boxes one decision may look at.
    pub(super) budget: usize,
    /// How many pieces of an unstable stretch may resist.
    pub(super) patience: usize,
    /// Whether the search ends with the first stable stretch.
    first_only: bool,
    pub(super) critical: OnceCell<Option<CriticalPolynomials>>,
    pub(super) touches: usize,
    pub(super) work: Work,
    /// The last wave asked for, with its shift and its integers.
    last_wave: Option<(Rational, i64, Vec<BigInt>)>,
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
            budget: usize::MAX,
            patience: MAX_PATIENCE,
            first_only: false,
            end,
            bits,
            critical: OnceCell::new(),
            touches: 0,
            work: Work::default(),
            last_wave: None,
        }
    }

    /// [`MarginForm::integers_at`]; a wave is often asked for twice.
    pub(super) fn integers_at(&mut self, s: &Rational, shift: i64) -> Vec<BigInt> {
        let shift = if self.margin.is_exact() { 0 } else { shift };
        match &self.last_wave {
            Some((known, at, values)) if known == s && *at == shift => values.clone(),
            _ => {
                let values = self.form.integers_at(s, shift);
                self.last_wave = Some((s.clone(), shift, values.clone()));
                values
            }
        }
    }

    /// With no more boxes for one decision.
    pub(super) fn within(self, budget: usize) -> Self {
        Self { budget, ..self }
    }

    /// Ends with the first stable stretch, or does not.
    pub(super) fn first_only(self, first_only: bool) -> Self {
        Self { first_only, ..self }
    }

    /// Gives up unstable stretches after so many pieces that resist.
    pub(super) fn patient(self, patience: usize) -> Self {
        Self { patience, ..self }
    }

    /// Decides nothing more once nobody wants to know.
    pub(super) fn while_wanted(self, interest: &Interest) -> Self {
        Self { form: self.form.while_wanted(interest), ..self }
    }

    /// Starts from a Courant number up to which stability is known.
    pub(super) fn knowing(self, courant_number: &Rational) -> Self {
        let t = courant_number.pow(self.margin.stride() as i32);
        Self { known: t.min(self.end.clone()), ..self }
    }

    pub(super) fn run(mut self, max_courant: &Rational, evidence: Evidence) -> StableSet {
        let mut intervals = Vec::new();
        let mut undecided = Vec::new();
        let mut immediately_unstable = None;
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
                    // All of the rest is open, or a sliver that is stepped over.
                    let steps_over = upper < self.end && lower > from.upper;
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
                        immediately_unstable =
                            Some(Wave::along_a_line(self.fastest_growing_phase()));
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
            if self.first_only {
                break;
            }
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
            immediately_unstable,
            work: self.work,
            ..StableSet::empty(evidence)
        }
    }

    /// The relative widths to try, as powers of one half.
    pub(super) fn widths(&self) -> impl Iterator<Item = u32> + use<> {
        let last = LAST_WIDTH.min(self.bits);
        std::iter::successors(Some(self.bits), |bits| Some(bits - (bits / 16).max(3)))
            .take_while(move |&bits| bits >= last)
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
        if self.work.boxes
            >= MOST_BOXES_IN_ALL * (self.bits.max(DEFAULT_BITS) / DEFAULT_BITS) as usize
            || !self.form.is_wanted()
        {
            return Err(None);
        }
        let most_boxes = MAX_BOXES.max(8 * self.bits as usize).min(self.budget);
        let (mut pieces, mut boxes) = if self.margin.powers() <= 2 {
            (1, most_boxes)
        } else {
            (MAX_PIECES.min(self.budget.max(1)), FIRST_BOXES.min(self.budget))
        };
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

    /// Whether the wave with this `s` is unstable on some interval `(from, from + δ)`.
    pub(super) fn is_unstable_just_above(&mut self, from: &Rational, s: &Rational) -> bool {
        self.work.evaluations += 1;
        let values = self.integers_at(s, 1);
        let to = if from.is_zero() {
            product(&self.end, &power_of_half(60))
        } else {
            product(from, &(integer(1) + power_of_half(60)))
        };
        is_negative_integer_polynomial(&values, from, &to) == Some(true)
    }

    /// The wave that grows fastest as `C → 0`: the best sample, then its surroundings cut by the golden section.
    fn fastest_growing_phase(&self) -> f64 {
        let mut powers = Vec::new();
        let mut at = |phase: f64| {
            self.compiled.powers_at(phase, &mut powers);
            powers[0] * self.compiled.phase_factor(phase)
        };
        let phases: Vec<f64> = resolving_phases(self.margin.degree()).collect();
        let values: Vec<f64> = phases.iter().map(|&phase| at(phase)).collect();
        let best = (0..phases.len()).min_by(|&a, &b| values[a].total_cmp(&values[b]));
        let Some(best) = best else { return 0.0 };
        let around = [phases[best.saturating_sub(1)], phases[(best + 1).min(phases.len() - 1)]];
        let (negative, refined) = golden_section(|phase| -at(phase), around, 1e-9 * around[1]);
        // What is gained by rounding alone, as about φ = 0, is none.
        let is_better = negative > -values[best] + ROUNDING * values[best].abs();
        if is_better { refined } else { phases[best] }
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

#[cfg(test)]
mod tests;
