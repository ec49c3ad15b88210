//! Which time steps are stable: `c Δt/h` for a method, a kernel, a smoothing ratio and an integrator.

use super::growth::worst_growth;
use super::step_conditions::{CompiledCondition, StepCondition, scaled_series};
use super::wave_scheme::{CompiledWaves, WaveScheme};
use crate::exact::bernstein::{MarginForm, Sign, Work};
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::rational::{Rational, from_f64, integer, simplest_between, to_f64};
use crate::scheme::integrator::Integrator;
use crate::stability::critical::{negative_intervals, resolving_phases};
use crate::stability::margin::Margin;
use crate::stability::{Evidence, ExactValue, Limit, MAX_BOXES, phase_of, stable_set_of};
use num_traits::{One, Zero};
use thiserror::Error;

/// What ends stability.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binding {
    /// The lattice itself is unstable, `ω0² < 0` for some wave: no time step helps.
    Lattice,
    /// A real multiplier passes +1: the step turns a restoring force into a driving one.
    PlusOne,
    /// A real multiplier passes −1: the step overshoots, the sign alternates.
    MinusOne,
    /// A complex pair leaves the unit circle: an oscillation grows.
    Oscillation,
}

impl Binding {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lattice => "lattice",
            Self::PlusOne => "plus-one",
            Self::MinusOne => "minus-one",
            Self::Oscillation => "oscillation",
        }
    }
}

/// Whether the limit itself is a stable step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepEnd {
    /// At the limit no amplitude grows.
    Included,
    /// At the limit −1 is a double multiplier with one eigenvector: the amplitude grows linearly with
    /// the number of steps. Only smaller steps are stable.
    DoubleMultiplier,
}

/// The published relation has an imaginary velocity coefficient: it belongs to no scheme that runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "the published relation of Godunov particle hydrodynamics describes no scheme that runs: it has no stable step; use the resolved form"
)]
pub struct NoSchemeRuns;

/// The stable steps of a scheme and an integrator, in units of `h/c`.
///
/// Stable means `|z| ≤ 1` for both multipliers of every wave. A wave without restoring force, `κ = 0`
/// first of all, has the double multiplier 1: it drifts, as its equations say, and does not count as
/// unstable. A double multiplier elsewhere on the circle is reported by [`end`](Self::end).
#[derive(Debug, Clone)]
pub struct StableStep {
    limit: Limit,
    binding: Option<Binding>,
    end: StepEnd,
    undecided: Vec<(f64, f64)>,
    work: Work,
    ratio: Rational,
    standard_deviation: f64,
}

impl StableStep {
    /// The largest stable `c Δt/h`, from 0 on.
    pub fn limit(&self) -> &Limit {
        &self.limit
    }

    /// What ends stability there; `None` when no limit was met.
    pub fn binding(&self) -> Option<Binding> {
        self.binding
    }

    /// Whether the limit itself is stable.
    pub fn end(&self) -> StepEnd {
        self.end
    }

    /// Intervals of `c Δt/h` that could not be decided.
    pub fn undecided(&self) -> &[(f64, f64)] {
        &self.undecided
    }

    /// How much work the proofs took.
    pub fn work(&self) -> Work {
        self.work
    }

    /// The limit as `c Δt/Δ`, per particle spacing.
    pub fn per_spacing(&self) -> f64 {
        self.limit.value() * to_f64(&self.ratio)
    }

    /// The limit as `c Δt/σ`, per standard deviation of the kernel: comparable between kernels.
    pub fn per_standard_deviation(&self) -> f64 {
        self.limit.value() / self.standard_deviation
    }
}

/// The largest `c Δt/h` of `scheme` stepped by `integrator` up to which every step is stable, within
/// `[0, max_step]`.
///
/// Proved where the kernel is a polynomial, enclosed for the Gaussian.
///
/// ```
/// use courant_analysis::waves::dispersion::{WaveMethod, WaveScheme, stable_step};
/// use courant_analysis::{scheme::integrator::Integrator, kernel::Kernel, exact::rational::integer};
/// // At h = Δ the cubic spline has ω0² = 4(1 − cos φ) − sin²φ ≤ 8: the leapfrog needs ω0Δt ≤ 2.
/// let scheme = WaveScheme::new(WaveMethod::Sph, Kernel::CubicSpline, &integer(1)).unwrap();
/// let step = stable_step(&scheme, Integrator::LeapfrogKdk, &integer(4)).unwrap();
/// assert_eq!(step.limit().exact().unwrap().to_string(), "sqrt(1/2)");
/// ```
///
/// # Errors
/// For the published form of Godunov particle hydrodynamics.
pub fn stable_step(
    scheme: &WaveScheme,
    integrator: Integrator,
    max_step: &Rational,
) -> Result<StableStep, NoSchemeRuns> {
    stable_step_within(scheme, integrator, &Rational::zero(), max_step)
}

/// The same with a permitted growth per step: `|z| ≤ 1 + growth`.
///
/// This is the question to ask where the strict answer is zero and the growth too small to matter, as
/// for second-order Runge–Kutta methods without viscosity.
///
/// # Errors
/// For the published form of Godunov particle hydrodynamics.
pub fn stable_step_within(
    scheme: &WaveScheme,
    integrator: Integrator,
    growth: &Rational,
    max_step: &Rational,
) -> Result<StableStep, NoSchemeRuns> {
    let (p, q) = scaled_series(scheme).ok_or(NoSchemeRuns)?;
    let evidence = if p.is_exact() && q.is_exact() { Evidence::Proved } else { Evidence::Enclosed };
    let finish = |limit, binding, end, undecided, work| StableStep {
        limit,
        binding,
        end,
        undecided,
        work,
        ratio: scheme.sums().ratio().clone(),
        standard_deviation: scheme.sums().kernel().standard_deviation(),
    };
    let zero = || Limit::exactly(ExactValue::Fraction(Rational::zero()), evidence);
    if growth.is_zero() {
        match lattice_sign(&p) {
            Sign::NowhereNegative => {}
            Sign::SomewhereNegative { phase_parameter, .. } => {
                let phase = phase_of(&phase_parameter);
                let limit = zero().at_phase(most_unstable_phase(&scheme.compile(), phase));
                let end = StepEnd::Included;
                return Ok(finish(limit, Some(Binding::Lattice), end, Vec::new(), Work::default()));
            }
            Sign::Undecided => {
                let undecided = vec![(0.0, to_f64(max_step))];
                let limit = Limit::between(0.0, f64::INFINITY, evidence);
                return Ok(finish(limit, None, StepEnd::Included, undecided, Work::default()));
            }
        }
    }
    let conditions = StepCondition::all(integrator, !q.is_zero(), growth);
    let bindings = [Binding::PlusOne, Binding::MinusOne, Binding::Oscillation];
    let sampled = SampledStep { conditions: conditions.each_ref().map(StepCondition::compile) };
    let seen = sampled.search(&scheme.compile(), to_f64(max_step), growth.is_zero());
    let margins = conditions.map(|condition| condition.margin(&p, &q));
    // The condition that sampling sees fail first, a little beyond; the others no further than its limit:
    // beyond it they may touch zero, which no subdivision decides.
    let first = seen.condition.unwrap_or(0);
    let range = match seen.condition {
        Some(_) => slightly_above(seen.step, 1.0 / 16.0, max_step),
        None => max_step.clone(),
    };
    let set = stable_set_of(&margins[first], &range);
    let (mut limit, mut binding) = (set.limit(), bindings[first]);
    let (mut undecided, mut work) = (set.undecided, set.work);
    if limit.is_positive() {
        let rest = slightly_above(limit.upper(), f64::EPSILON.sqrt(), max_step);
        for index in (0..3).filter(|&index| index != first) {
            let set = stable_set_of(&margins[index], &rest);
            work += set.work;
            undecided.extend(set.undecided.iter().filter(|(from, _)| *from < limit.upper()));
            let other = set.limit();
            if other.value() < limit.value() {
                (limit, binding) = (other, bindings[index]);
            }
        }
    }
    if !limit.is_positive() {
        // The set knows that no step is stable, not which wave grows fastest.
        let small = 1e-2 / (1.0 + to_f64(scheme.sums().ratio()));
        let worst = worst_growth(&scheme.compile(), integrator, small);
        limit = limit.at_phase(worst.phase);
    }
    let binding = limit.upper().is_finite().then_some(binding);
    // Area-preserving steps keep both multipliers on the circle until they meet at −1.
    let end = match binding {
        Some(Binding::MinusOne) if margins[2].is_neutral() => StepEnd::DoubleMultiplier,
        _ => StepEnd::Included,
    };
    Ok(finish(limit, binding, end, undecided, work))
}

/// Whether `ω0²/s` is nowhere negative.
fn lattice_sign(p: &EnclosedSeries) -> Sign {
    let margin = Margin::of_polynomial(std::slice::from_ref(p));
    if margin.is_neutral() {
        return Sign::NowhereNegative;
    }
    MarginForm::new(&margin).sign(&Rational::zero(), &Rational::one(), MAX_BOXES).0
}

/// The phase of the largest growth rate, or the one given when sampling sees none.
fn most_unstable_phase(waves: &CompiledWaves, otherwise: f64) -> f64 {
    resolving_phases(waves.terms())
        .map(|phase| (phase, waves.mode(phase).frequencies().growth_rate()))
        .filter(|(_, rate)| *rate > 0.0)
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(otherwise, |(phase, _)| phase)
}

/// A short fraction above `value` by about the given share, and not above `max_step`: its powers enter
/// every coefficient.
fn slightly_above(value: f64, share: f64, max_step: &Rational) -> Rational {
    match (from_f64(value * (1.0 + share)), from_f64(value * (1.0 + 2.0 * share))) {
        (Some(lower), Some(upper)) if lower < *max_step && value > 0.0 => {
            simplest_between(&lower, &upper.min(max_step.clone()))
        }
        _ => max_step.clone(),
    }
}

/// The stability of one scheme and integrator looked at on a finite set of phases, for maps: fast, and
/// never below the true limit.
#[derive(Debug, Clone)]
pub struct SampledStep {
    conditions: [CompiledCondition; 3],
}

impl SampledStep {
    /// For an integrator, and a method with or without damping.
    pub fn new(integrator: Integrator, damped: bool) -> Self {
        let conditions = StepCondition::all(integrator, damped, &integer(0));
        Self { conditions: conditions.map(|condition| condition.compile()) }
    }

    /// The largest `c Δt/h ≤ max_step` that no sampled phase finds unstable.
    pub fn limit(&self, waves: &CompiledWaves, max_step: f64) -> Limit {
        let seen = self.search(waves, max_step, true);
        let evidence = Evidence::Sampled { phases: seen.phases };
        match seen.phase {
            None => Limit::between(max_step, f64::INFINITY, evidence),
            Some(phase) => Limit::between(seen.step, seen.step, evidence).at_phase(phase),
        }
    }

    /// With `lattice_matters`, a negative restoring force ends the search at zero.
    fn search(&self, waves: &CompiledWaves, max_step: f64, lattice_matters: bool) -> SeenLimit {
        let ratio = waves.ratio();
        let mut seen = SeenLimit { step: max_step, phase: None, condition: None, phases: 0 };
        let mut powers = Vec::new();
        for phase in resolving_phases(waves.terms()).skip(1) {
            seen.phases += 1;
            let mode = waves.mode(phase);
            let s = (0.5 * phase).sin().powi(2);
            let (p, q) = (mode.restoring * ratio * ratio / s, mode.damping * ratio / s);
            if p < 0.0 && lattice_matters {
                return SeenLimit { step: 0.0, phase: Some(phase), condition: None, ..seen };
            }
            for (index, condition) in self.conditions.iter().enumerate() {
                condition.powers_at(s, p, q, &mut powers);
                if nowhere_negative(&powers, seen.step) {
                    continue;
                }
                if let Some(&(from, _)) = negative_intervals(&powers, seen.step).first() {
                    (seen.step, seen.phase, seen.condition) = (from, Some(phase), Some(index));
                }
            }
        }
        seen
    }
}

/// What sampling sees: the first step that fails, at which phase and by which condition.
struct SeenLimit {
    step: f64,
    phase: Option<f64>,
    condition: Option<usize>,
    phases: usize,
}

/// Whether a polynomial is certainly nowhere negative on `[0, end]`: its negative coefficients do not
/// outweigh the constant one. Most phases are passed over by this.
fn nowhere_negative(powers: &[f64], end: f64) -> bool {
    let Some((constant, rest)) = powers.split_first() else { return true };
    let lowest = rest.iter().rev().fold(0.0, |sum, &a| (sum + a.min(0.0)) * end);
    constant + lowest >= 0.0
}

#[cfg(test)]
mod tests;
