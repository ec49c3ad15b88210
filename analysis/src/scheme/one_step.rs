//! Explicit schemes for one unknown between two levels, as people know them: `u_j^{n+1} = Σ_k c_k(p) u_{j+k}^n`.

mod expansion;
mod print;

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, integer, reduced, to_f64};
use crate::exact::stencil::Stencil;
use crate::scheme::Step;
use num_bigint::BigInt;
use num_complex::Complex64;
use num_traits::{One, Signed, Zero};

/// The coefficients of `u_j^{n+1} = Σ_k c_k(p) u_{j+k}^n`, polynomials in one parameter `p`.
///
/// ```
/// use courant_analysis::scheme::Step;
/// let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
/// let one_step = upwind.one_step("C").unwrap();
/// assert_eq!(one_step.to_text(), "g(φ) = 1 + C (-1 + cos φ - i sin φ)");
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct OneStep {
    /// The parameter.
    pub parameter: String,
    /// Every coefficient that is not identically zero: its offset `k`, ascending, `c_k` in powers of the parameter, and how far each
    /// power may be from the true one (zero polynomial where the weights are exact).
    pub coefficients: Vec<(i64, Polynomial<Rational>, Polynomial<Rational>)>,
    /// Whether a constant is mapped to itself at every value of the parameter: decided from the structure of the scheme, whatever
    /// the weights are exactly.
    pub keeps_constants: bool,
}

impl Step {
    /// The coefficients of an explicit scheme for one unknown between two levels, once auxiliaries are substituted; `None` for other
    /// schemes, in more than one dimension, or when another parameter has no value.
    pub fn one_step(&self, parameter: &str) -> Option<OneStep> {
        let variable = self.names.parameter(parameter)?;
        let only = self.free_parameters().iter().all(|name| name == parameter);
        if !only || self.dimension != 1 {
            return None;
        }
        let (expansion, keeps_constants) = expansion::coefficients(self, variable)?;
        let over = |values: Vec<BigInt>| {
            let fraction = |value| reduced(value, expansion.denominator.clone());
            Polynomial::new(values.into_iter().map(fraction).collect())
        };
        let coefficients = expansion.coefficients.into_iter();
        let coefficients = coefficients.map(|c| (c.offset[0], over(c.centers), over(c.radii)));
        Some(OneStep {
            parameter: parameter.into(),
            coefficients: coefficients.collect(),
            keeps_constants,
        })
    }

    /// The coefficients with their offsets along every axis, in any number of dimensions, and how far each may be from the true one; `None`
    /// as from [`one_step`](Self::one_step).
    pub(crate) fn coefficients(&self, parameter: &str) -> Option<Vec<OffsetCoefficient>> {
        let variable = self.names.parameter(parameter)?;
        if self.free_parameters().iter().any(|name| name != parameter) {
            return None;
        }
        let expansion = match self.dimension {
            1 => expansion::coefficients(self, variable)?.0,
            _ if self.names.letters().next().is_some() => return None,
            _ => expansion::coefficients_on_torus(self, variable)?,
        };
        Some(expansion.coefficients)
    }
}

/// All coefficients over one positive denominator.
struct Expansion {
    coefficients: Vec<OffsetCoefficient>,
    denominator: BigInt,
}

impl Expansion {
    /// Without coefficients that vanish.
    fn new(mut coefficients: Vec<OffsetCoefficient>, denominator: BigInt) -> Self {
        if denominator.is_negative() {
            coefficients.iter_mut().flat_map(|c| &mut c.centers).for_each(|c| *c = -&*c);
        }
        coefficients.retain(|c| c.centers.iter().chain(&c.radii).any(|value| !value.is_zero()));
        let denominator = denominator.abs();
        Self { coefficients, denominator }
    }
}

/// A coefficient at its offset along every axis, in powers of the parameter and times a positive number that all have in common: its signs
/// are known without a fraction.
#[derive(Debug, Clone)]
pub(crate) struct OffsetCoefficient {
    pub(crate) offset: Vec<i64>,
    centers: Vec<BigInt>,
    /// How far each may be from the true one; as many.
    radii: Vec<BigInt>,
}

impl OffsetCoefficient {
    pub(crate) fn is_exact(&self) -> bool {
        self.radii.iter().all(Zero::is_zero)
    }

    /// Whether no power can be negative.
    pub(crate) fn is_plainly_non_negative(&self) -> bool {
        self.centers.iter().zip(&self.radii).all(|(center, radius)| center >= radius)
    }

    /// The least that it may be.
    pub(crate) fn least(&self) -> Polynomial<BigInt> {
        self.bound(|center, radius| center - radius)
    }

    /// The most that it may be.
    pub(crate) fn most(&self) -> Polynomial<BigInt> {
        self.bound(|center, radius| center + radius)
    }

    fn bound(&self, of: impl Fn(&BigInt, &BigInt) -> BigInt) -> Polynomial<BigInt> {
        let pairs = self.centers.iter().zip(&self.radii);
        Polynomial::new(pairs.map(|(center, radius)| of(center, radius)).collect())
    }
}

impl OneStep {
    /// Whether all coefficients are known exactly.
    pub fn is_exact(&self) -> bool {
        self.coefficients.iter().all(|(_, _, radius)| radius.is_zero())
    }

    /// `c_k`, without its radius.
    pub fn coefficient(&self, offset: i64) -> Polynomial<Rational> {
        let found = self.coefficients.iter().find(|(known, _, _)| *known == offset);
        found.map_or_else(Polynomial::zero, |(_, center, _)| center.clone())
    }

    /// The moment `Σ_k c_k k^power`, a polynomial in the parameter.
    pub fn moment(&self, power: u32) -> Polynomial<Rational> {
        let terms = self.coefficients.iter();
        terms.fold(Polynomial::zero(), |sum, (offset, center, _)| {
            sum + center.scale(&integer(*offset).pow(power as i32))
        })
    }

    /// `Σ_k c_k`, the factor by which one step multiplies the mean.
    pub fn mean_gain(&self) -> Polynomial<Rational> {
        if self.keeps_constants { Polynomial::one() } else { self.moment(0) }
    }

    /// `Σ_k c_k E^k` at one value of the parameter, without radii.
    pub fn stencil_at(&self, value: &Rational) -> Stencil<Rational> {
        let lowest = self.coefficients.first().map_or(0, |(offset, _, _)| *offset);
        let highest = self.coefficients.last().map_or(-1, |(offset, _, _)| *offset);
        let mut values = vec![Rational::zero(); (highest - lowest + 1) as usize];
        for (offset, center, _) in &self.coefficients {
            values[(offset - lowest) as usize] = center.evaluate(value);
        }
        Stencil::new(lowest, values)
    }

    /// The amplification factor `g(φ) = Σ_k c_k e^{ikφ}`; the phase in radians.
    pub fn gain(&self, parameter: f64, phase: f64) -> Complex64 {
        let terms = self.coefficients.iter().map(|(offset, center, _)| {
            let value = center.map(to_f64).evaluate(&parameter);
            value * Complex64::from_polar(1.0, *offset as f64 * phase)
        });
        terms.sum()
    }
}

#[cfg(test)]
mod tests;
