//! The largest stable step looked at on a finite set of waves, for maps: fast, and never below the true limit.

use super::lattice_waves::CompiledWaves;
use crate::exact::laurent::{Exponents, Variable};
use crate::exact::rational::{Rational, to_f64};
use crate::scheme::{Integrator, Lines, SchemeError, Step};
use crate::stability::critical::{negative_intervals, resolving_phases};
use crate::stability::{Conditions, Evidence, Limit};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};

/// One mode of any lattice method: with `t = c Δt/Δ`, `f = t² ω0²` and `g = t b` are what its step depends on.
const DAMPED: &str = "x[j]' = v[j]; v[j]' = -f*x[j] - g*v[j]";
const FREE: &str = "x[j]' = v[j]; v[j]' = -f*x[j]";

/// The conditions on one step of a mode, in `f64`.
#[derive(Debug, Clone)]
pub struct SampledStep {
    /// `Σ c f^i g^j ≥ 0`, by terms `(c, i, j, 2i + j)`: the last is the power of the step, less what all terms share.
    conditions: Vec<Vec<(f64, i32, i32, usize)>>,
    nowhere: bool,
}

impl SampledStep {
    /// For an integrator, and modes with or without damping.
    ///
    /// # Errors
    /// When the integrator does not serve positions and velocities.
    pub fn new(integrator: &Integrator, damped: bool) -> Result<Self, SchemeError> {
        let mode = Lines::from_text(if damped { DAMPED } else { FREE })?;
        let step = Step::lines(&mode, integrator)?;
        let names = step.names();
        let [f, g] = ["f", "g"].map(|name| names.parameter(name));
        let conditions = Conditions::new(&step.characteristic()?, &Rational::zero(), names);
        let compiled = conditions.requirements.iter().map(|requirement| {
            let terms = requirement.polynomial.terms();
            let largest = terms.iter().map(|(_, value)| value.abs()).max().unwrap_or_default();
            let ratio = |value: &BigInt| to_f64(&Rational::new(value.clone(), largest.clone()));
            let powers = |exponents: &Exponents| {
                let power = |name: Option<Variable>| name.map_or(0, |v| i32::from(exponents[v.0]));
                (power(f), power(g))
            };
            let of_step = |exponents: &Exponents| {
                let (i, j) = powers(exponents);
                (2 * i + j) as usize
            };
            let shared = terms.iter().map(|(exponents, _)| of_step(exponents)).min().unwrap_or(0);
            let term = |(exponents, value): &(Exponents, BigInt)| {
                let (i, j) = powers(exponents);
                (ratio(value), i, j, of_step(exponents) - shared)
            };
            terms.iter().map(term).collect()
        });
        Ok(Self { conditions: compiled.collect(), nowhere: conditions.nowhere })
    }

    /// The largest `c Δt/h ≤ max_step` that no sampled phase finds unstable; `ratio` is `h/Δ`.
    pub fn limit(&self, waves: &CompiledWaves, ratio: f64, max_step: f64) -> Limit {
        let (mut step, mut critical) = (max_step, None);
        let mut looked_at = 0;
        let mut powers = Vec::new();
        for phase in resolving_phases(waves.terms()).skip(1) {
            looked_at += 1;
            let mode = waves.mode(phase);
            if mode.restoring < 0.0 || self.nowhere {
                (step, critical) = (0.0, Some(phase));
                break;
            }
            let (p, q) = (ratio * ratio * mode.restoring, ratio * mode.damping);
            for condition in &self.conditions {
                powers.clear();
                for &(coefficient, i, j, power) in condition {
                    if powers.len() <= power {
                        powers.resize(power + 1, 0.0);
                    }
                    powers[power] += coefficient * p.powi(i) * q.powi(j);
                }
                if nowhere_negative(&powers, step) {
                    continue;
                }
                if let Some(&(from, _)) = negative_intervals(&powers, step).first() {
                    (step, critical) = (from, Some(phase));
                }
            }
        }
        let evidence = Evidence::Sampled { phases: looked_at };
        match critical {
            None => Limit::between(max_step, f64::INFINITY, evidence),
            Some(phase) => Limit::between(step, step, evidence).at_phase(phase),
        }
    }
}

/// Whether a polynomial is certainly nowhere negative on `[0, end]`: its negative coefficients do not outweigh the constant one. Most
/// phases are passed over by this.
fn nowhere_negative(powers: &[f64], end: f64) -> bool {
    let Some((constant, rest)) = powers.split_first() else { return true };
    let lowest = rest.iter().rev().fold(0.0, |sum, &a| (sum + a.min(0.0)) * end);
    constant + lowest >= 0.0
}
