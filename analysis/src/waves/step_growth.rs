//! How fast the fastest wave grows in one step, to nine digits however little that is.

use super::bands::{Cell, cells};
use super::multipliers::CompiledStep;
use super::precise::{Place, PreciseStep};
use super::torus_growth::growth_on_torus;
use super::wave_terms::{difference_terms, primitive_characteristic};
use crate::exact::float::{ComplexFloat, Float};
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::rational::{Rational, integer, to_f64};
use crate::golden_section::golden_section;
use crate::interest::Interest;
use crate::scheme::{SchemeError, Step};
use crate::stability::at_value::{DemandAt, DemandsAt, zeros_of};
use crate::stability::{PointVerdict, Wave, phase_of, symmetric};
use num_complex::Complex64;
use num_traits::{One, Zero};
use std::f64::consts::{LN_2, PI};

/// Bits of the arithmetic at first: 77 digits.
const BITS: u32 = 256;

/// The most that is tried: growth below `2^−4000` is not told from none.
pub(super) const MOST_BITS: u32 = 1 << 13;

/// Two precisions agree on the growth to this.
const AGREEMENT: f64 = 1e-13;

/// Samples between the ends of half a band, in equal steps; more where the coefficients oscillate faster.
const SAMPLES: usize = 24;

/// Samples towards an end, each nearer by this factor.
const NEARER: f64 = 0.4;

/// How near: a peak at a smaller share of the band is not looked for.
const NEAREST: f64 = 1e-13;

/// Sampled maxima that are refined, the largest first.
const CANDIDATES: usize = 6;

/// Sampled maxima below this share of the largest are not refined: samples are dense enough that none is twice as high.
const WORTH_REFINING: f64 = 0.3;

/// Bits of zeros that are no ends of bands.
const ZERO_BITS: u32 = 96;

/// Discriminants of higher degree are left out: they only say where samples are to be denser.
const MOST_DEGREE: i16 = 40;

/// Refinement stops at this share of the distance of two samples: the value is then wrong by the square of it.
const FINE: f64 = 1e-8;

/// The relative error of a value in `f64` with which a maximum is still placed well.
const SUFFICIENT: f64 = 1e-7;

/// The wave that grows fastest; where none grows, the one that is damped least.
#[derive(Debug, Clone, PartialEq)]
pub struct Growth {
    /// `|z| − 1`. Infinite where it does not fit, or where the step cannot be solved for the wave.
    pub per_step: f64,
    /// `log |z|`, which fits where `|z|` does not. Infinite only where the step cannot be solved.
    pub logarithm: f64,
    /// The wave.
    pub wave: Wave,
    /// The multiplier `z`.
    pub multiplier: Complex64,
    /// Whether waves were only sampled, and the best samples refined: in two and three dimensions.
    pub sampled: bool,
}

impl Growth {
    /// How many steps double the amplitude; `None` when nothing grows.
    pub fn steps_to_double(&self) -> Option<f64> {
        (self.logarithm > 0.0).then(|| LN_2 / self.logarithm)
    }

    /// A wave that neither grows nor decays.
    pub(super) fn neutral(wave: Wave, multiplier: Complex64) -> Self {
        Self { per_step: 0.0, logarithm: 0.0, wave, multiplier, sampled: false }
    }

    /// A wave for which the step cannot be solved.
    pub(super) fn singular(wave: Wave) -> Self {
        let multiplier = Complex64::new(f64::INFINITY, 0.0);
        let infinite = f64::INFINITY;
        Self { per_step: infinite, logarithm: infinite, wave, multiplier, sampled: false }
    }
}

/// The largest `|z|` over all waves of a step whose parameters all have values: relative error of `|z| − 1` below `1e-9`. Between
/// neighbouring zeros of the stability conditions, which are isolated exactly, `|z|` is sampled and refined; no band of growing
/// waves is missed, however narrow. Where enclosures enter, their middle is meant. In two and three dimensions waves are sampled on a grid and
/// refined, from a wave that was proved to grow as well: there the growth is measured, that there is some is proved.
///
/// ```
/// use courant_analysis::{exact::rational::parse, scheme::Step, waves::growth_at};
/// let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
/// // 2C − 1 at φ = π.
/// let growth = growth_at(&upwind.with("C", &parse("1.00000000000000000001").unwrap())?)?;
/// assert!((growth.per_step / 2e-20 - 1.0).abs() < 1e-12);
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
///
/// # Errors
/// When a parameter has no value.
pub fn growth_at(step: &Step) -> Result<Growth, SchemeError> {
    let open = step.free_parameters();
    if !open.is_empty() {
        return Err(SchemeError::NotSet(open));
    }
    let step = step.expanded();
    let demands =
        DemandsAt::new(&step.inequalities_in(None, &Rational::zero(), &Interest::default())?);
    growth_under(&step, &demands, &demands.decide())
}

/// [`growth_at`] with the conditions known, and what they decide.
pub(crate) fn growth_under(
    step: &Step,
    demands: &DemandsAt,
    decided: &PointVerdict<Wave>,
) -> Result<Growth, SchemeError> {
    if step.dimension() > 1 {
        return Ok(Growth { sampled: true, ..growth_on_torus(step, decided)? });
    }
    let chi = primitive_characteristic(step)?;
    let terms = difference_terms(&chi);
    let chi = chi.coefficients(Variable::TIME);
    if let Some(phase) = singular_wave(step, &chi) {
        return Ok(Growth::singular(Wave::along_a_line(phase)));
    }
    let whole = |grows| vec![Cell { from: integer(0), to: integer(1), grows }];
    let cells = match demands {
        DemandsAt::All(all) => {
            cells(all.iter().map(DemandAt::zeros), zeros_of_discriminant(step, &chi))
        }
        DemandsAt::Nowhere(_) => whole(true),
        DemandsAt::Unknown | DemandsAt::OnTorus(_) => whole(false),
    };
    let grows = cells.iter().any(|cell| cell.grows);
    let stable = matches!(demands, DemandsAt::All(_)) && !grows;
    let halves: Vec<Half> = cells
        .iter()
        .filter(|cell| cell.grows == grows)
        .flat_map(|cell| {
            let width = (&cell.to - &cell.from) / integer(2);
            [
                Half { end: cell.from.clone(), width: width.clone() },
                Half { end: cell.to.clone(), width: -width },
            ]
        })
        .collect();
    let compiled = CompiledStep::new(step, &terms);
    let mut bits = BITS;
    loop {
        let search = Search { compiled: &compiled, precise: PreciseStep::new(step, &terms, bits) };
        if stable && let Some(neutral) = search.neutral() {
            return Ok(neutral);
        }
        let Some((spot, largest)) = search.largest(&halves) else {
            return Ok(Growth::neutral(Wave::along_a_line(0.0), Complex64::ONE));
        };
        let finer = PreciseStep::new(step, &terms, 2 * bits);
        let again = finer.largest(&spot.place(&finer));
        let error = again.map_or(f64::INFINITY, |again| {
            let difference = &again.0 - &largest.0;
            difference.ln() - again.0.ln()
        });
        if error < AGREEMENT.ln() && (!grows || !largest.0.is_negative()) || bits >= MOST_BITS {
            let phase = spot.place(&finer).0[0].phase();
            return Ok(growth_of(Wave::along_a_line(phase), &largest));
        }
        bits *= 2;
    }
}

/// From `|z|² − 1` and `z − 1`.
pub(super) fn growth_of(wave: Wave, (excess, y): &(Float, ComplexFloat)) -> Growth {
    let bits = excess.bits();
    let one = Float::integer(&1.into(), bits);
    let modulus = (&one + excess).sqrt();
    // |z| − 1 = (|z|² − 1)/(|z| + 1)
    let growth = excess / &(&modulus + &one);
    let per_step = growth.to_f64();
    let logarithm = if per_step.abs() < 0.5 { per_step.ln_1p() } else { modulus.ln() };
    let multiplier = (y + &ComplexFloat::real(one)).to_c64();
    Growth { per_step, logarithm, wave, multiplier, sampled: false }
}

/// A wave for which the leading coefficient vanishes.
fn singular_wave(step: &Step, chi: &[Laurent]) -> Option<f64> {
    let leading = chi.last()?;
    if leading.as_monomial().is_some_and(|(exponents, _)| exponents[4..].iter().all(|e| *e == 0)) {
        return None;
    }
    let squared = step.names.reduce(leading * &leading.conjugate());
    zeros_of(&squared, &step.names, ZERO_BITS).first().map(phase_of)
}

/// Where the discriminant of two multipliers vanishes, if it is real and not too long: beyond, a pair on the same circle becomes two real
/// ones.
fn zeros_of_discriminant(step: &Step, chi: &[Laurent]) -> Vec<Rational> {
    let [c, b, a] = chi else { return Vec::new() };
    let discriminant = step.names.reduce(b * b - (a * c).scaled(&4.into()));
    let is_long = |p: &Laurent| p.degree(Variable::axis(0)) > MOST_DEGREE;
    let real = symmetric(discriminant).filter(|real| !is_long(real));
    real.map_or_else(Vec::new, |real| zeros_of(&real, &step.names, ZERO_BITS))
}

struct Search<'a> {
    compiled: &'a CompiledStep,
    precise: PreciseStep,
}

/// Half a band, from one end of it to the middle.
#[derive(Debug, Clone)]
struct Half {
    end: Rational,
    width: Rational,
}

/// A wave as a share of the way through half a band.
#[derive(Debug, Clone, Copy)]
struct Spot<'a> {
    half: &'a Half,
    x: f64,
}

impl Spot<'_> {
    fn place(&self, precise: &PreciseStep) -> Place {
        precise.place(&self.half.end, &self.half.width, self.x)
    }
}

impl Half {
    /// Whether it begins at the longest or the shortest wave.
    fn is_outermost(&self) -> bool {
        self.end.is_zero() || self.end.is_one()
    }

    /// The samples, ascending: equal steps, and ever smaller ones towards the end.
    fn samples(&self, span: usize) -> Vec<f64> {
        let nearest = if self.is_outermost() { NEAREST } else { NEAREST.sqrt() };
        let resolving = 8.0 * span as f64 * to_f64(&self.width).abs().sqrt();
        let count = SAMPLES.max(resolving as usize);
        let equal = (1..=count).map(|i| i as f64 / count as f64);
        let nearer = std::iter::successors(Some(NEARER / count as f64), |x| Some(x * NEARER));
        let mut samples: Vec<f64> = nearer.take_while(|x| *x > nearest).collect();
        samples.push(0.0);
        samples.reverse();
        samples.extend(equal);
        samples
    }
}

/// Whether one is larger than another by more than a part in `2^40`.
fn is_larger(one: &Float, other: &Float) -> bool {
    let difference = one - other;
    let sizes = one.magnitude().max(other.magnitude());
    !difference.is_negative() && difference.magnitude() > sizes.map(|size| size - 40)
}

/// A sampled maximum with its neighbours.
#[derive(Debug, Clone, Copy)]
struct Peak<'a> {
    half: &'a Half,
    lower: f64,
    x: f64,
    upper: f64,
    value: f64,
}

impl Search<'_> {
    /// Where nothing grows: the longest or the shortest wave, if it is neutral to all digits.
    fn neutral(&self) -> Option<Growth> {
        for (end, phase) in [(integer(0), 0.0), (integer(1), PI)] {
            let place = self.precise.place(&end, &Rational::zero(), 0.0);
            let (excess, y) = self.precise.largest(&place)?;
            let noise = -i64::from(self.precise.bits()) / 2;
            if excess.magnitude().is_none_or(|magnitude| magnitude < noise) {
                let wave = Wave::along_a_line(phase);
                return Some(Growth::neutral(wave, y.to_c64() + 1.0));
            }
        }
        None
    }

    /// The largest `|z|² − 1` over half bands.
    fn largest<'h>(&self, halves: &'h [Half]) -> Option<(Spot<'h>, (Float, ComplexFloat))> {
        let mut peaks: Vec<Peak> = halves.iter().flat_map(|half| self.peaks(half)).collect();
        peaks.sort_by(|a, b| b.value.total_cmp(&a.value));
        let best = peaks.first()?.value;
        peaks.retain(|peak| peak.value >= best.min(best * WORTH_REFINING));
        peaks.truncate(CANDIDATES);
        let refined = peaks.iter().filter_map(|peak| {
            let at = |x: f64| {
                let spot = Spot { half: peak.half, x };
                Some((spot, self.precise.largest(&spot.place(&self.precise))?))
            };
            let found = at(self.refined(peak))?;
            // Even about the longest and the shortest wave: a maximum that cannot be told from one there is there.
            let end = if peak.half.is_outermost() { at(0.0) } else { None };
            Some(end.filter(|end| !is_larger(&found.1.0, &end.1.0)).unwrap_or(found))
        });
        // Of equal ones the longer wave.
        let phase = |spot: &Spot| spot.place(&self.precise).0[0].phase();
        refined.reduce(|a, b| {
            let better = is_larger(&b.1.0, &a.1.0);
            let longer = || !is_larger(&a.1.0, &b.1.0) && phase(&b.0) < phase(&a.0);
            if better || longer() { b } else { a }
        })
    }

    /// The sampled maxima of half a band; the middle is one of both halves if it is one at all.
    fn peaks<'h>(&self, half: &'h Half) -> Vec<Peak<'h>> {
        let samples = half.samples(self.compiled.span());
        let values: Vec<f64> = samples.iter().map(|&x| self.value(&Spot { half, x })).collect();
        let at = |index: usize| values.get(index).copied().unwrap_or(f64::NEG_INFINITY);
        (0..samples.len())
            .filter(|&i| at(i) >= at(i.wrapping_sub(1)) && at(i) >= at(i + 1))
            .map(|i| Peak {
                half,
                lower: samples[i.saturating_sub(1)],
                x: samples[i],
                upper: samples[(i + 1).min(samples.len() - 1)],
                value: values[i],
            })
            .collect()
    }

    /// Where the maximum about a sampled one is, by golden sections.
    fn refined(&self, peak: &Peak) -> f64 {
        let value = |x: f64| self.value(&Spot { half: peak.half, x });
        let width = FINE * (peak.upper - peak.lower);
        let (found, x) = golden_section(value, [peak.lower, peak.upper], width);
        if found > peak.value { x } else { peak.x }
    }

    /// `|z|² − 1`, in `f64` where that is known to suffice; logarithmic beyond 1, so that it does not overflow.
    fn value(&self, spot: &Spot) -> f64 {
        let place = spot.place(&self.precise);
        let axis = &place.0[0];
        let (excess, error) =
            self.compiled.largest_excess(axis.s.to_f64(), axis.complement.to_f64());
        if error < SUFFICIENT * excess.abs() {
            return if excess > 1.0 { 1.0 + excess.ln() } else { excess };
        }
        match self.precise.largest(&place) {
            None => f64::INFINITY,
            Some((excess, _)) if excess.magnitude() > Some(0) && !excess.is_negative() => {
                1.0 + excess.ln()
            }
            Some((excess, _)) => excess.to_f64(),
        }
    }
}

#[cfg(test)]
mod tests;
