//! The conditions for a stable step, as polynomials in the time step and the phase.
//!
//! With `t = c Δt/h`, `p = (h/Δ)² ω0²Δ²/(c² s)` and `q = (h/Δ) bΔ/(c s)` every integrator sees
//! `f = FΔt² = −t² s p` and `g = GΔt = −t s q`. A condition `Σ c_ij f^i g^j ≥ 0` on its multipliers
//! becomes a polynomial in `t` whose coefficients are cosine series.

use super::wave_scheme::WaveScheme;
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::rational::{Rational, to_f64};
use crate::scheme::integrator::{BivariatePolynomial, Integrator};
use crate::stability::margin::Margin;
use num_traits::Zero;

/// `Σ c t^a s^b p^i q^j`, with the powers of `f` and of `t s` taken out that all terms share.
#[derive(Debug, Clone)]
pub(super) struct StepCondition {
    terms: Vec<Term>,
}

#[derive(Debug, Clone)]
struct Term {
    coefficient: Rational,
    power_of_t: usize,
    power_of_s: usize,
    power_of_p: usize,
    power_of_q: usize,
}

impl StepCondition {
    /// The conditions `[no +r passed, no −r passed, no pair leaves the circle]` for `|z| ≤ 1 + growth`.
    ///
    /// Without growth allowed, a common factor `−f` is taken out, which needs `p ≥ 0`: where `p` is
    /// negative the lattice itself is unstable and no step helps.
    pub(super) fn all(integrator: Integrator, damped: bool, growth: &Rational) -> [Self; 3] {
        let conditions = integrator.polynomials().conditions(growth);
        conditions.map(|condition| Self::new(&condition, damped))
    }

    fn new(condition: &BivariatePolynomial, damped: bool) -> Self {
        let kept: Vec<_> = condition.terms().filter(|(_, j, _)| damped || *j == 0).collect();
        let shared_f = kept.iter().map(|(i, ..)| *i).min().unwrap_or(0);
        let mut terms: Vec<Term> = kept
            .into_iter()
            .map(|(i, j, value)| Term {
                coefficient: if (i + j) % 2 == 0 { value.clone() } else { -value },
                power_of_t: 2 * (i - shared_f) + j,
                power_of_s: i - shared_f + j,
                power_of_p: i - shared_f,
                power_of_q: j,
            })
            .collect();
        let shared_t = terms.iter().map(|term| term.power_of_t).min().unwrap_or(0);
        let shared_s = terms.iter().map(|term| term.power_of_s).min().unwrap_or(0);
        for term in &mut terms {
            term.power_of_t -= shared_t;
            term.power_of_s -= shared_s;
        }
        Self { terms }
    }

    /// The condition of a scheme, ready for exact decisions about its sign.
    pub(super) fn margin(&self, p: &EnclosedSeries, q: &EnclosedSeries) -> Margin {
        let powers_of = |base: &EnclosedSeries, highest: usize| {
            let mut powers = vec![EnclosedSeries::constant(Rational::from_integer(1.into()))];
            for index in 0..highest {
                powers.push(powers[index].times(base));
            }
            powers
        };
        let highest = |power: fn(&Term) -> usize| self.terms.iter().map(power).max().unwrap_or(0);
        let s = powers_of(&EnclosedSeries::half_versine(), highest(|term| term.power_of_s));
        let p = powers_of(p, highest(|term| term.power_of_p));
        let q = powers_of(q, highest(|term| term.power_of_q));
        let nothing = EnclosedSeries::constant(Rational::zero());
        let mut powers = vec![nothing; highest(|term| term.power_of_t) + 1];
        for term in &self.terms {
            let product = s[term.power_of_s]
                .times(&p[term.power_of_p])
                .times(&q[term.power_of_q])
                .scaled(&term.coefficient);
            powers[term.power_of_t] = powers[term.power_of_t].plus(&product);
        }
        Margin::of_polynomial(&powers)
    }

    /// The numeric form.
    pub(super) fn compile(&self) -> CompiledCondition {
        CompiledCondition {
            terms: self
                .terms
                .iter()
                .map(|term| {
                    let powers =
                        [term.power_of_t, term.power_of_s, term.power_of_p, term.power_of_q];
                    (to_f64(&term.coefficient), powers)
                })
                .collect(),
        }
    }
}

/// [`StepCondition`] in `f64`.
#[derive(Debug, Clone)]
pub(super) struct CompiledCondition {
    terms: Vec<(f64, [usize; 4])>,
}

impl CompiledCondition {
    /// The coefficients of the powers of `t` at one phase.
    pub(super) fn powers_at(&self, s: f64, p: f64, q: f64, values: &mut Vec<f64>) {
        values.clear();
        for &(coefficient, [t, powers @ ..]) in &self.terms {
            if values.len() <= t {
                values.resize(t + 1, 0.0);
            }
            let [a, i, j] = powers.map(|power| power as i32);
            values[t] += coefficient * s.powi(a) * p.powi(i) * q.powi(j);
        }
    }
}

/// Bits kept of coefficients that are not exact: far more than a limit is reported with, and few enough
/// for the high powers that the conditions are made of.
const KEPT_BITS: u32 = 112;

/// `p` and `q` of a scheme; `None` when its velocity coefficient is not real.
pub(super) fn scaled_series(scheme: &WaveScheme) -> Option<(EnclosedSeries, EnclosedSeries)> {
    let ratio = scheme.sums().ratio();
    let p = scheme.restoring().scaled(&(ratio * ratio));
    let q = scheme.damping()?.scaled(ratio);
    Some((p.shortened(KEPT_BITS), q.shortened(KEPT_BITS)))
}
