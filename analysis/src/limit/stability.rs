//! The stable set of Courant numbers, decided in exact arithmetic.
//!
//! Floating point only guesses where stability ends. Every interval that is reported is then proved
//! stable (no Bernstein coefficient of the margin is negative) or unstable (one phase whose margin is
//! negative throughout), and a guess that does not stand is replaced by exact bisection.

use super::critical::{Critical, UnstableInterval, refine, resolving_phases, sampled_unstable_set};
use super::{Evidence, ExactValue, Limit, square_root_enclosure};
use crate::bernstein::{MarginForm, Sign, Work, is_negative_integer_polynomial};
use crate::margin::{CompiledMargin, Margin};
use crate::polynomial::Polynomial;
use crate::rational::{
    Rational, from_f64, integer, simplest_between, to_f64, to_f64_above, to_f64_below,
};
use crate::real_roots::{RealRoot, real_roots};
use crate::symbol::EnclosedSymbol;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Boxes one decision may look at.
pub(crate) const MAX_BOXES: usize = 2000;

/// Boxes the first decision may look at, and pieces the range of `t` may be cut into, for a margin of
/// higher than first degree in `t`.
const FIRST_BOXES: usize = 250;
const MAX_PIECES: usize = 24;

/// The relative width of an enclosure, first tried and last: powers of one half.
const FIRST_WIDTH: i32 = 52;
const LAST_WIDTH: i32 = 22;

/// Roots in `t` are enclosed to this many bits, far below the width of an edge.
const ROOT_BITS: u32 = 72;

/// Roots that may be fractions are enclosed to this many: two fractions that close together have
/// denominators above 2^100.
const FRACTION_BITS: u32 = 200;

/// Newton's method doubles the digits: from ten or so bits to more than asked for.
const NEWTON_STEPS: usize = 7;

/// How often an unstable stretch may be halved in search of witnesses.
const MAX_HALVINGS: u32 = 48;

/// How many stretches of one kind are followed before the rest is left undecided.
const MAX_STRETCHES: usize = 64;

/// A maximal interval of stable Courant numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct StableInterval {
    /// Where it begins; exactly 0 for the first one.
    pub from: Limit,
    /// Where it ends.
    pub to: Limit,
}

/// All stable Courant numbers within `[0, max_courant]`.
#[derive(Debug, Clone, PartialEq)]
pub struct StableSet {
    /// The stable intervals of positive length, ascending.
    pub intervals: Vec<StableInterval>,
    /// Intervals of Courant numbers that could not be decided.
    pub undecided: Vec<(f64, f64)>,
    /// The wave that grows fastest as `C → 0` when no small Courant number is stable, in radians.
    pub immediately_unstable_phase: Option<f64>,
    /// `|g| = 1` for every wave and every Courant number.
    pub neutral: bool,
    /// What stands behind the answer.
    pub evidence: Evidence,
    /// How much work it took.
    pub work: Work,
}

impl StableSet {
    /// The end of the stable interval that begins at 0; exactly 0 when there is none.
    pub fn limit(&self) -> Limit {
        match self.intervals.first() {
            Some(first) if first.from.upper() == 0.0 => first.to.clone(),
            _ => {
                let zero = Limit::exactly(ExactValue::Fraction(Rational::zero()), self.evidence);
                match self.immediately_unstable_phase {
                    Some(phase) => zero.at_phase(phase),
                    None => zero,
                }
            }
        }
    }

    /// Whether a Courant number lies in a stable interval; at an end that is enclosed and not exact,
    /// only the inner side counts.
    pub fn contains(&self, courant_number: &Rational) -> bool {
        courant_number.is_zero()
            || self.intervals.iter().any(|interval| {
                let above = match interval.from.exact().and_then(ExactValue::as_fraction) {
                    Some(from) => courant_number >= from,
                    None => {
                        from_f64(interval.from.upper()).is_some_and(|from| *courant_number >= from)
                    }
                };
                let below = match interval.to.exact().and_then(ExactValue::as_fraction) {
                    Some(to) => courant_number <= to,
                    None => from_f64(interval.to.lower()).is_some_and(|to| *courant_number <= to),
                };
                above && below
            })
    }
}

/// The stability limit `|g| ≤ 1` within `[0, max_courant]`.
///
/// ```
/// use courant_analysis::{kernel::Kernel, limit::{Cause, Evidence, stability_limit}};
/// use courant_analysis::rational::{integer, ratio};
/// use courant_analysis::scheme::{AdvectionScheme, Discretisation, Scheme};
/// let scheme = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, ratio(2, 1));
/// let limit = stability_limit(&scheme.unwrap().symbol(), &integer(10));
/// assert_eq!(limit.exact().unwrap().to_string(), "15/8");
/// assert_eq!((limit.evidence(), limit.cause()), (Evidence::Proved, Some(Cause::LongWave)));
/// ```
pub fn stability_limit(symbol: &EnclosedSymbol, max_courant: &Rational) -> Limit {
    stable_set(symbol, &Rational::zero(), max_courant).limit()
}

/// The largest Courant number within `[0, max_courant]` up to which `|g| ≤ 1 + growth`.
pub fn growth_limit(symbol: &EnclosedSymbol, growth: &Rational, max_courant: &Rational) -> Limit {
    stable_set(symbol, growth, max_courant).limit()
}

/// Every Courant number in `[0, max_courant]` with `|g| ≤ 1 + growth` for all waves.
pub fn stable_set(symbol: &EnclosedSymbol, growth: &Rational, max_courant: &Rational) -> StableSet {
    stable_set_of(&Margin::new(symbol, growth), max_courant)
}

/// Every `C` in `[0, max_courant]` where a margin is nowhere negative.
pub(crate) fn stable_set_of(margin: &Margin, max_courant: &Rational) -> StableSet {
    let evidence = if margin.is_exact() { Evidence::Proved } else { Evidence::Enclosed };
    if margin.is_neutral() {
        return StableSet {
            intervals: vec![StableInterval {
                from: Limit::exactly(ExactValue::Fraction(Rational::zero()), evidence),
                to: Limit::beyond(max_courant, evidence),
            }],
            undecided: Vec::new(),
            immediately_unstable_phase: None,
            neutral: true,
            evidence,
            work: Work::default(),
        };
    }
    Search::new(margin, max_courant).run(max_courant, evidence)
}

/// An end of a stretch in `t`: nothing is claimed strictly between `lower` and `upper`.
#[derive(Debug, Clone)]
struct Edge {
    lower: Rational,
    upper: Rational,
    phase: f64,
}

impl Edge {
    fn zero() -> Self {
        Self { lower: Rational::zero(), upper: Rational::zero(), phase: 0.0 }
    }
}

/// A point `(s, t)` where the margin is negative.
type Counterexample = Box<(Rational, Rational)>;

/// How a stable stretch ends.
enum Stretch {
    /// At this edge.
    Ends(Edge),
    /// Not within the range.
    Continues,
    /// It has no length: instability begins at once, seen by the wave with this `s`.
    Empty(Rational),
    /// Not decided between the two values of `t`.
    Undecided(Rational, Rational),
}

struct Search<'a> {
    margin: &'a Margin,
    form: MarginForm,
    compiled: CompiledMargin,
    guesses: Vec<UnstableInterval>,
    end: Rational,
    work: Work,
}

impl<'a> Search<'a> {
    fn new(margin: &'a Margin, max_courant: &Rational) -> Self {
        let compiled = margin.compile();
        let end = (0..margin.stride()).fold(integer(1), |power, _| power * max_courant);
        let guesses =
            sampled_unstable_set(&compiled, resolving_phases(margin.degree()), to_f64(&end));
        Self {
            margin,
            form: MarginForm::new(margin),
            compiled,
            guesses,
            end,
            work: Work::default(),
        }
    }

    fn run(mut self, max_courant: &Rational, evidence: Evidence) -> StableSet {
        let mut intervals = Vec::new();
        let mut undecided = Vec::new();
        let mut immediately_unstable_phase = None;
        let mut from = Edge::zero();
        for _ in 0..MAX_STRETCHES {
            let witness = match self.stable_stretch(&from.upper) {
                Stretch::Continues => {
                    let to = Limit::beyond(max_courant, evidence);
                    intervals.push(StableInterval { from: self.limit(&from, evidence), to });
                    break;
                }
                Stretch::Undecided(lower, upper) => {
                    if lower > from.upper {
                        let edge =
                            Edge { lower: lower.clone(), upper: lower.clone(), phase: from.phase };
                        let to =
                            self.limit(&edge, Evidence::Sampled { phases: self.sampled_phases() });
                        intervals.push(StableInterval { from: self.limit(&from, evidence), to });
                    }
                    undecided.push(self.courant_numbers(&lower, &upper));
                    break;
                }
                Stretch::Empty(s) => {
                    if from.upper.is_zero() {
                        immediately_unstable_phase = Some(self.fastest_growing_phase());
                    }
                    s
                }
                Stretch::Ends(edge) => {
                    let s = phase_parameter(edge.phase);
                    intervals.push(StableInterval {
                        from: self.limit(&from, evidence),
                        to: self.limit(&edge, evidence),
                    });
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

    fn sampled_phases(&self) -> usize {
        resolving_phases(self.margin.degree()).count()
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
            if root.lower > *from && self.is_stable(from, &root.lower).is_ok() {
                let phase = if s.is_zero() { 0.0 } else { std::f64::consts::PI };
                return Stretch::Ends(Edge { lower: root.lower, upper: root.upper, phase });
            }
        }
        let mut counterexample = None;
        if let Some(edge) = self.interior_edge(refined) {
            for bits in (LAST_WIDTH..=FIRST_WIDTH).rev().step_by(3) {
                let lower = &edge.upper * (integer(1) - power_of_half(bits));
                if lower <= *from {
                    break;
                }
                match self.is_stable(from, &lower) {
                    Ok(()) => return Stretch::Ends(Edge { lower, ..edge }),
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

    /// Finds the end of a stable stretch by bisection alone, from a counterexample `(s, t)` above it.
    fn bisect(&mut self, from: &Rational, counterexample: Option<Counterexample>) -> Stretch {
        let Some(counterexample) = counterexample else {
            return Stretch::Undecided(from.clone(), self.end.clone());
        };
        let (mut s, mut upper) = *counterexample;
        let mut lower = from.clone();
        while &upper - &lower > &upper * power_of_half(FIRST_WIDTH) {
            if lower.is_zero() && self.is_unstable_just_above(&lower, &s) {
                return Stretch::Empty(s);
            }
            let middle = (&lower + &upper) / integer(2);
            match self.is_stable(from, &middle) {
                Ok(()) => lower = middle,
                Err(Some(found)) => {
                    s = found.0;
                    upper = found.1.min(middle);
                }
                Err(None) => return Stretch::Undecided(lower, upper),
            }
            if upper <= *from {
                return Stretch::Empty(s);
            }
        }
        let phase = phase_of(&s);
        Stretch::Ends(Edge { lower, upper, phase })
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
        let edge = guess.and_then(|guess| self.upper_edge(guess));
        let to = edge.as_ref().map_or_else(|| self.end.clone(), |edge| edge.lower.clone());
        let mut witnesses = vec![witness];
        witnesses.extend(edge.as_ref().map(|edge| phase_parameter(edge.phase)));
        let mut gaps: Vec<(Rational, Rational)> = Vec::new();
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
            if halvings == 0 || gaps.len() > 8 {
                match gaps.last_mut() {
                    Some(last) if last.1 == lower => last.1 = upper,
                    _ => gaps.push((lower, upper)),
                }
                continue;
            }
            pending.push((middle.clone(), upper, halvings - 1));
            pending.push((lower, middle, halvings - 1));
        }
        let gaps = gaps.iter().map(|(lower, upper)| self.courant_numbers(lower, upper)).collect();
        (edge, gaps)
    }

    /// The edge where instability ends and stability returns.
    fn upper_edge(&mut self, guess: Critical) -> Option<Edge> {
        let refined = refine(&self.compiled, guess, false, to_f64(&self.end));
        for s in [integer(0), integer(1)] {
            let Some(root) = self.root_near(&s, refined.parameter, 1e-9) else { continue };
            let beyond = &root.upper * (integer(1) + power_of_half(30));
            if self.is_stable(&root.upper, &beyond).is_ok() {
                let phase = if s.is_zero() { 0.0 } else { std::f64::consts::PI };
                return Some(Edge { lower: root.lower, upper: root.upper, phase });
            }
        }
        let edge = self.interior_edge(refined)?;
        for bits in (LAST_WIDTH..=FIRST_WIDTH).rev().step_by(3) {
            let upper = &edge.lower * (integer(1) + power_of_half(bits));
            let beyond = &upper * (integer(1) + power_of_half(bits - 6));
            if self.is_stable(&upper, &beyond).is_ok() {
                return Some(Edge { upper, ..edge });
            }
        }
        None
    }

    /// The critical `t` at the refined phase, exactly: stability certainly fails on one side of it.
    fn interior_edge(&mut self, refined: Critical) -> Option<Edge> {
        let mut best = self.root_near(&phase_parameter(refined.phase), refined.parameter, 1e-3)?;
        let mut phase = refined.phase;
        // One step of parabolic interpolation on exact values: the guess sits on a flat extremum, which
        // floating point finds only to half its digits.
        let step = 1e-5 / self.margin.degree().max(1) as f64;
        let (left, right) = (refined.phase - step, refined.phase + step);
        if left > 0.0 && right < std::f64::consts::PI {
            let before = self.root_near(&phase_parameter(left), refined.parameter, 1e-3);
            let after = self.root_near(&phase_parameter(right), refined.parameter, 1e-3);
            if let (Some(before), Some(after)) = (before, after) {
                let slope = to_f64(&(&before.lower - &after.lower));
                let bend = to_f64(&(&before.lower + &after.lower - integer(2) * &best.lower));
                let vertex = refined.phase + 0.5 * step * slope / bend;
                if (vertex - refined.phase).abs() <= step {
                    let root = self.root_near(&phase_parameter(vertex), refined.parameter, 1e-3);
                    if let Some(root) = root {
                        (best, phase) = (root, vertex);
                    }
                }
            }
        }
        Some(Edge { lower: best.lower, upper: best.upper, phase })
    }

    /// The root in `t` of the margin at a fixed `s` nearest to a guess; enclosed, and widened by the
    /// uncertainty of the data.
    fn root_near(&mut self, s: &Rational, guess: f64, tolerance: f64) -> Option<RealRoot> {
        let mut enclosure: Option<RealRoot> = None;
        let shifts: &[i64] = if self.margin.is_exact() { &[0] } else { &[-1, 1] };
        let center = from_f64(guess)?;
        let from = &center * from_f64(1.0 - tolerance)?;
        let to = (&center * from_f64(1.0 + tolerance)?).min(self.end.clone());
        for &shift in shifts {
            self.work.evaluations += 1;
            let coefficients = self.form.integers_at(s, shift);
            let nearest = if s.is_integer() && self.margin.is_exact() {
                fraction_or_root(coefficients, guess, &from, &to)
            } else {
                newton_root(&coefficients, guess, ROOT_BITS)
            };
            let nearest = nearest.filter(|root| root.lower > from && root.upper <= to)?;
            enclosure = Some(match enclosure {
                None => nearest,
                Some(first) => RealRoot {
                    lower: first.lower.min(nearest.lower),
                    upper: first.upper.max(nearest.upper),
                },
            });
        }
        enclosure
    }

    /// `Ok` when `[from, to]` is proved stable, else a counterexample `(s, t)` if one was met.
    fn is_stable(&mut self, from: &Rational, to: &Rational) -> Result<(), Option<Counterexample>> {
        // Boxes are halved in `s` only, which suffices where the margin is at most linear in `t`. Of a
        // higher degree its Bernstein coefficients in `t` may stay negative; then `t` is halved too.
        let (mut pieces, mut boxes) =
            if self.margin.powers() <= 2 { (1, MAX_BOXES) } else { (MAX_PIECES, FIRST_BOXES) };
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
                    boxes = (boxes * 2).min(MAX_BOXES);
                }
            }
        }
        Ok(())
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

    /// An edge in `t` as a limit on `C`.
    fn limit(&self, edge: &Edge, evidence: Evidence) -> Limit {
        let limit = if edge.lower == edge.upper && (self.margin.is_exact() || edge.lower.is_zero())
        {
            let value = match self.margin.stride() {
                2 => ExactValue::square_root(edge.lower.clone()),
                _ => ExactValue::Fraction(edge.lower.clone()),
            };
            Limit::exactly(value, evidence)
        } else {
            let (lower, upper) = self.courant_numbers(&edge.lower, &edge.upper);
            Limit::between(lower, upper, evidence)
        };
        if edge.upper.is_zero() { limit } else { limit.at_phase(edge.phase) }
    }

    fn courant_numbers(&self, lower: &Rational, upper: &Rational) -> (f64, f64) {
        match self.margin.stride() {
            2 => square_root_enclosure(lower, upper),
            _ => (to_f64_below(lower), to_f64_above(upper)),
        }
    }
}

/// The root at an end of the phase range, where it may be a fraction: the simplest fraction within a
/// narrow enclosure is tried. A multiple root, which Newton's method does not enclose, goes to Sturm.
fn fraction_or_root(
    coefficients: Vec<BigInt>,
    guess: f64,
    from: &Rational,
    to: &Rational,
) -> Option<RealRoot> {
    let narrow = newton_root(&coefficients, guess, FRACTION_BITS);
    let exact = Polynomial::new(coefficients.into_iter().map(Rational::from).collect());
    if exact.degree() == Some(1) {
        let value = -exact.coefficient(0) / exact.coefficient(1);
        return Some(RealRoot { lower: value.clone(), upper: value });
    }
    match narrow {
        Some(root) => {
            let simplest = simplest_between(&root.lower, &root.upper);
            let is_root = exact.evaluate(&simplest).is_zero();
            Some(if is_root { RealRoot { lower: simplest.clone(), upper: simplest } } else { root })
        }
        None => real_roots(&exact, from, to, ROOT_BITS).into_iter().min_by(|a, b| {
            let distance = |root: &RealRoot| (to_f64(&root.lower) - guess).abs();
            distance(a).total_cmp(&distance(b))
        }),
    }
}

/// A simple root near a positive guess by Newton's method in integer fixed point, enclosed to
/// [`ROOT_BITS`] and verified by the signs of the exact polynomial at both ends. (The coefficients have
/// thousands of digits; fractions and Sturm's chain on them cost a thousand times as much.)
fn newton_root(coefficients: &[BigInt], guess: f64, bits: u32) -> Option<RealRoot> {
    // Unit of t: about 2^−3·ROOT_BITS of its size. Coefficients keep as many bits below the largest.
    let digits = 3 * i64::from(bits);
    let shift = digits - guess.log2().ceil() as i64;
    let largest = coefficients.iter().map(|value| value.bits() as i64).max()?;
    let cut = (largest - 2 * digits).max(0) as u64;
    let rounded: Vec<BigInt> = coefficients.iter().map(|value| value >> cut).collect();
    let unit =
        |value: BigInt| if shift >= 0 { value >> shift as u64 } else { value << (-shift) as u64 };
    let mut root = (from_f64(guess)? * power_of_two(shift)).to_integer();
    for _ in 0..NEWTON_STEPS {
        let (mut value, mut slope) = (BigInt::zero(), BigInt::zero());
        for coefficient in rounded.iter().rev() {
            slope = unit(slope * &root) + &value;
            value = unit(value * &root) + coefficient;
        }
        if slope.is_zero() {
            return None;
        }
        let step = if shift >= 0 { value << shift as u64 } else { value >> (-shift) as u64 };
        root -= step / slope;
    }
    let margin: BigInt = root.abs() >> u64::from(bits);
    // Ends with few digits keep the exact evaluations cheap.
    let coarse = (i64::from(bits) - 8).max(0) as u64;
    let (lower, upper) = ((&root - &margin) >> coarse, ((&root + &margin) >> coarse) + 1);
    let scale = shift - coarse as i64;
    let sign = |end: &BigInt| {
        let (power, exponent) = if scale >= 0 { (scale as u64, 0) } else { (0, (-scale) as u64) };
        let end = end << exponent;
        // Homogeneous in (end, 2^power): only the sign counts.
        let mut weight = 0;
        let value = coefficients.iter().rev().fold(BigInt::zero(), |sum, coefficient| {
            let next = sum * &end + (coefficient << weight);
            weight += power;
            next
        });
        value.sign()
    };
    (sign(&lower) != sign(&upper)).then(|| RealRoot {
        lower: Rational::from(lower) * power_of_two(-scale),
        upper: Rational::from(upper) * power_of_two(-scale),
    })
}

fn power_of_two(exponent: i64) -> Rational {
    let magnitude = Rational::from(BigInt::one() << exponent.unsigned_abs());
    if exponent < 0 { magnitude.recip() } else { magnitude }
}

/// `s = sin²(φ/2)`, the exact value of a nearby float.
fn phase_parameter(phase: f64) -> Rational {
    if phase <= 0.0 {
        return Rational::zero();
    }
    if phase >= std::f64::consts::PI {
        return Rational::one();
    }
    from_f64((0.5 * phase).sin().powi(2)).expect("a square of a sine is finite")
}

/// `φ = 2 arcsin √s`.
pub(crate) fn phase_of(s: &Rational) -> f64 {
    2.0 * to_f64(s).sqrt().min(1.0).asin()
}

fn power_of_half(bits: i32) -> Rational {
    Rational::new(BigInt::one(), BigInt::one() << bits)
}

#[cfg(test)]
mod tests;
