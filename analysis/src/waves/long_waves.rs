//! The physical multiplier at long waves as an exact power series.
//!
//! With `E = e^x`, `x = iφ`, and `z = e^λ`, the characteristic equation `χ(e^λ, e^x; p) = 0` defines `λ(x) = Σ_m c_m(p) x^m`. A power
//! of `x` is a derivative, `x ↔ Δx ∂/∂x`, and `λ ↔ Δt ∂/∂t`: the series is the modified equation of the scheme (Warming & Hyett 1974).
//! Coefficients are rational functions of the parameters, with one square root where two branches begin alike. Irrational numbers of
//! the equations stay letters, independent of one another but for square roots of fractions, whose squares are known.

mod exact_step;
mod leading;
mod levels;

pub(crate) use exact_step::{ExactStep, ROOT, Weight};

use crate::exact::laurent::{Laurent, Variable, greatest_common_divisor};
use crate::exact::rational::Rational;
use crate::exact::rational_function::RationalFunction;
use crate::scheme::{LetterKind, Names, SchemeError, Step};
use levels::{Levels, Series};
use num_complex::Complex64;
use num_traits::{One, Zero};
use thiserror::Error;

/// Why there is no series.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NoSeries {
    /// No characteristic polynomial.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
    /// The exact step is not understood.
    #[error("the exact step `{0}` does not serve: {1}")]
    Exact(String, String),
    /// A constant is not kept.
    #[error("no multiplier is 1 for the longest waves: a constant is not kept, the mean drifts")]
    Drift,
    /// Several kinds of waves begin at 1.
    #[error(
        "several kinds of long waves have a multiplier that begins at 1, and nothing says which is meant"
    )]
    Several,
    /// No branch is a power series.
    #[error("no multiplier that begins at 1 changes with the phase as a power series does")]
    NoPower,
    /// The leading term is the root of a polynomial of higher degree.
    #[error("the leading term at long waves is no square root of a polynomial in the parameters")]
    Algebraic,
    /// Branches that share the leading term.
    #[error("two multipliers share their leading term at long waves")]
    Double,
}

/// Arithmetic where some letters are square roots.
#[derive(Debug, Clone)]
pub(crate) struct Field {
    roots: Vec<(Variable, RationalFunction)>,
}

impl Field {
    fn new(names: &Names) -> Self {
        let roots = names.letters().filter_map(|(variable, letter)| match &letter.kind {
            LetterKind::SquareRoot(square) => {
                Some((variable, RationalFunction::from(Rational::from(square.clone()))))
            }
            _ => None,
        });
        Self { roots: roots.collect() }
    }

    /// With a letter for the root of a polynomial; one only.
    fn adjoin(&mut self, square: Laurent) -> bool {
        let square = RationalFunction::from(square);
        match self.roots.iter().find(|(root, _)| *root == ROOT) {
            Some((_, known)) => *known == square,
            None => {
                self.roots.push((ROOT, square));
                true
            }
        }
    }

    /// The square of the letter that was adjoined; 1 where none was.
    fn square(&self) -> Laurent {
        let found = self.roots.iter().find(|(root, _)| *root == ROOT);
        found.map_or_else(Laurent::one, |(_, square)| square.numerator().clone())
    }

    fn simple(&self, value: RationalFunction) -> RationalFunction {
        self.roots.iter().fold(value, |value, (root, square)| value.with_square(*root, square))
    }

    fn times(&self, a: &RationalFunction, b: &RationalFunction) -> RationalFunction {
        if a.is_zero() || b.is_zero() {
            return RationalFunction::zero();
        }
        self.simple(a.clone() * b.clone())
    }

    /// The product of series, as far as the first goes.
    fn product(&self, a: &Series, b: &Series) -> Series {
        let coefficient = |k: usize| {
            let terms = (0..=k).map(|j| self.times(&a[j], &b[k - j]));
            terms.fold(RationalFunction::zero(), |sum, term| sum + term)
        };
        (0..a.len()).map(coefficient).collect()
    }

    /// `Σ_j a_j ν^j`.
    fn polynomial(&self, a: &[RationalFunction], value: &RationalFunction) -> RationalFunction {
        a.iter().rev().fold(RationalFunction::zero(), |sum, a| self.times(&sum, value) + a.clone())
    }
}

/// `log z` of the physical multiplier at long waves, and what it is compared with.
#[derive(Debug, Clone)]
pub struct LongWaves {
    /// `[c_0, c_1, …]`.
    pub(crate) coefficients: Series,
    /// The power of the leading term.
    pub(crate) leading: usize,
    pub(crate) exact: ExactStep,
    /// Whether somebody stated the exact step; otherwise it is the leading term.
    pub(crate) is_stated: bool,
    /// The largest radius of a kernel sum in it: zero where all is exact.
    pub(crate) radius: Rational,
    /// The square of the [root](ROOT).
    pub(crate) square: Laurent,
    pub(crate) names: Names,
    pub(crate) dimension: usize,
}

impl Step {
    /// The series of the physical multiplier up to the power `order` of `x = iφ`: the branch that follows the exact step
    /// (`-I*C*phi`, as files state it), or the only one that begins at 1.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
    /// let series = upwind.long_waves(Some("-I*C*phi"), 3)?;
    /// assert_eq!(series.coefficient_text(2), "C (1 - C)/2");
    /// assert_eq!(series.coefficient_text(3), "-C (1 - C) (1 - 2 C)/6");
    /// # Ok::<(), courant_analysis::waves::long_waves::NoSeries>(())
    /// ```
    ///
    /// # Errors
    /// When no multiplier is such a series, or it is not clear which.
    pub fn long_waves(&self, exact: Option<&str>, order: usize) -> Result<LongWaves, NoSeries> {
        let exact = exact.map(|text| ExactStep::new(text, self)).transpose()?;
        let characteristic = self.characteristic()?;
        let content = characteristic.content(Variable::TIME);
        let chi = characteristic.divide_exactly(&content).expect("a content divides");
        match series(self, &chi, exact.as_ref(), order) {
            Err(NoSeries::Double) => {
                let repeated = greatest_common_divisor(&chi, &chi.derivative(Variable::TIME));
                if !repeated.contains(Variable::TIME) {
                    return Err(NoSeries::Double);
                }
                let simple = chi.divide_exactly(&repeated).expect("a divisor divides");
                series(self, &simple, exact.as_ref(), order)
            }
            found => found,
        }
    }
}

/// Lifts the leading term by one power of `x` after another: each coefficient is linear in what is left over.
fn series(
    step: &Step,
    chi: &Laurent,
    exact: Option<&ExactStep>,
    order: usize,
) -> Result<LongWaves, NoSeries> {
    let mut field = Field::new(step.names());
    if exact.is_some_and(ExactStep::is_complex) {
        field.adjoin(Laurent::integer(-1));
    }
    // As far as the leading terms of any equation go.
    let beginning = Levels::new(step, chi, &field, order.max(8));
    let begin = leading::leading(&beginning.levels, &mut field, exact)?;
    let (power, weight) = (begin.power, begin.weight);
    let order = order.max(power);
    let Levels { levels, radius } = Levels::new(step, chi, &field, weight + order - power);
    let mut lambda = vec![RationalFunction::zero(); order + 1];
    lambda[power] = begin.value;
    let mut exponentials: Vec<Exponential> = (0..levels.len()).map(Exponential::new).collect();
    for next in power + 1..=order {
        let target = weight + next - power;
        let mut residual = RationalFunction::zero();
        for (level, exponential) in levels.iter().zip(&mut exponentials) {
            exponential.extend(&lambda, next, target, &field);
            for (k, coefficient) in level.iter().enumerate().take(target + 1) {
                residual = residual + field.times(coefficient, &exponential.series[target - k]);
            }
        }
        let quotient = (-residual).over(&begin.derivative).expect("it does not vanish");
        lambda[next] = field.simple(quotient);
    }
    let square = field.square();
    let stated = exact.cloned();
    let is_stated = stated.is_some();
    let exact = stated.unwrap_or_else(|| ExactStep::of_leading(power, &lambda[power], &square));
    Ok(LongWaves {
        coefficients: lambda,
        leading: power,
        exact,
        is_stated,
        radius,
        square,
        names: step.names().clone(),
        dimension: step.dimension(),
    })
}

/// `e^{nλ}`.
struct Exponential {
    exponent: usize,
    series: Series,
}

impl Exponential {
    fn new(exponent: usize) -> Self {
        Self { exponent, series: vec![RationalFunction::one()] }
    }

    /// Up to the power `to`, anew from the last coefficient of `λ` that was found before `next`: `k Z_k = n Σ_j j λ_j Z_{k−j}`.
    fn extend(&mut self, lambda: &Series, next: usize, to: usize, field: &Field) {
        self.series.truncate(next - 1);
        for k in self.series.len()..=to {
            let terms = (1..=k.min(lambda.len() - 1)).map(|j| {
                let factor = Rational::new((self.exponent * j).into(), k.into());
                field.times(&lambda[j], &self.series[k - j]) * RationalFunction::from(factor)
            });
            let sum = terms.fold(RationalFunction::zero(), |sum, term| sum + term);
            self.series.push(sum);
        }
    }
}

impl LongWaves {
    /// The power of its leading term: 1 for advection and waves, 2 for diffusion.
    pub fn leading_power(&self) -> usize {
        self.leading
    }

    /// The highest power that is known.
    pub fn order(&self) -> usize {
        self.coefficients.len() - 1
    }

    /// Whether the exact step was stated; otherwise the series is compared with its leading term.
    pub fn is_compared_with_a_stated_step(&self) -> bool {
        self.is_stated
    }

    /// Whether all coefficients are exact: a kernel that is known within a radius leaves none of them so.
    pub fn is_exact(&self) -> bool {
        self.radius.is_zero()
    }

    /// `c_m` minus that of the exact step.
    pub(crate) fn error(&self, power: usize) -> RationalFunction {
        let own = self.coefficients.get(power).cloned().unwrap_or_else(RationalFunction::zero);
        own - self.exact.coefficient(power)
    }

    /// Speed of long waves over that of the exact step, where both have the same leading power and the quotient is a number.
    pub fn speed_ratio(&self) -> Option<Rational> {
        let (power, value) = self.exact.leading()?;
        self.coefficients.get(power)?.over(value)?.as_number()
    }

    /// `λ` at a phase, for values of the free parameters, in `f64`: what the series says of one wave along the first axis.
    pub fn evaluate(&self, values: &[(&str, f64)], phase: f64) -> Complex64 {
        let of = |p: &Laurent| self.laurent_at(p, values);
        let x = Complex64::new(0.0, phase);
        self.coefficients.iter().rev().fold(Complex64::ZERO, |sum, coefficient| {
            sum * x + of(coefficient.numerator()) / of(coefficient.denominator())
        })
    }

    fn laurent_at(&self, polynomial: &Laurent, values: &[(&str, f64)]) -> Complex64 {
        let terms = polynomial.terms().iter().map(|(exponents, coefficient)| {
            let mut product =
                Complex64::from(crate::exact::rational::to_f64(&coefficient.clone().into()));
            if exponents[ROOT.0] != 0 {
                product *= self.laurent_at(&self.square, values).sqrt();
            }
            for (place, &power) in exponents.iter().enumerate().filter(|(_, power)| **power != 0) {
                let value = match place {
                    0 => continue,
                    1 => 1.0,
                    2 | 3 => 0.0,
                    _ => self.value_of(place, values),
                };
                product *= value.powi(power.into());
            }
            product
        });
        terms.sum()
    }

    fn value_of(&self, place: usize, values: &[(&str, f64)]) -> f64 {
        let letter = self.names.letters().find(|(variable, _)| variable.0 == place);
        match letter {
            Some((_, letter)) => letter.value.compile().at_cosine(1.0),
            None => {
                let name = self.names.name_at(place);
                values.iter().find(|(known, _)| *known == name).map_or(f64::NAN, |(_, v)| *v)
            }
        }
    }
}

#[cfg(test)]
mod tests;
