//! Limits on the Courant number, each with its evidence.

use super::conditions::Condition;
use super::wave::Wave;
use crate::exact::algebraic_number::AlgebraicNumber;
use crate::exact::rational::{
    Rational, compare, decimal_below, from_f64, integer, parse, square_root_enclosure, to_f64,
    to_f64_above, to_f64_below, to_text,
};
use num_bigint::BigInt;
use num_traits::Signed;
use std::f64::consts::PI;

/// Bits that settle the `f64` on either side of an irrational limit.
const EXACT_BITS: u32 = 120;

/// What stands behind a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// The sign of the polynomial was decided in exact arithmetic on both sides of the limit.
    Proved,
    /// The same, with coefficients that are themselves enclosures (the Gaussian).
    Enclosed,
    /// Looked at on this many phases; the true limit is lower or equal.
    Sampled {
        /// How many phases were looked at.
        phases: usize,
    },
    /// Decided in exact arithmetic for coefficients that were measured on a running code.
    Measured,
    /// The property holds up to the lower end; beyond it nothing is known, up to the upper end.
    Undecided,
}

impl Evidence {
    /// The weaker of two: what stands behind several limits together.
    ///
    /// ```
    /// use courant_analysis::stability::Evidence;
    /// assert_eq!(Evidence::Enclosed.weaker(Evidence::Proved), Evidence::Enclosed);
    /// assert_eq!(Evidence::Proved.weaker(Evidence::Undecided), Evidence::Undecided);
    /// ```
    #[must_use]
    pub fn weaker(self, other: Self) -> Self {
        let weakness = |evidence: Self| match evidence {
            Self::Proved => 0,
            Self::Enclosed => 1,
            Self::Measured => 2,
            Self::Sampled { .. } => 3,
            Self::Undecided => 4,
        };
        if weakness(other) > weakness(self) { other } else { self }
    }

    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::Enclosed => "enclosed",
            Self::Sampled { .. } => "sampled",
            Self::Measured => "measured",
            Self::Undecided => "undecided",
        }
    }

    /// The same of coefficients that were measured.
    fn measured(self) -> Self {
        if self == Self::Undecided { self } else { Self::Measured }
    }
}

/// Which wave sets a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// `φ → 0`.
    LongWave,
    /// Any other: in one dimension a phase strictly between 0 and π.
    Interior,
    /// Two cells per wavelength, `φ = π`, along one axis or several.
    ShortestWave,
}

impl Cause {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::LongWave => "long-wave",
            Self::Interior => "interior",
            Self::ShortestWave => "shortest-wave",
        }
    }

    pub(crate) fn of_wave(wave: &Wave) -> Self {
        let (zero, shortest) = (|phase: &f64| *phase == 0.0, |phase: &f64| phase.abs() >= PI);
        if wave.phases().iter().all(zero) {
            Self::LongWave
        } else if wave.phases().iter().all(|phase| zero(phase) || shortest(phase)) {
            Self::ShortestWave
        } else {
            Self::Interior
        }
    }
}

/// A number known in closed form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ExactValue {
    /// A fraction.
    Fraction(Rational),
    /// The square root of a positive fraction that is no square.
    SquareRoot(Rational),
}

impl ExactValue {
    /// `√square`, as a fraction when it is one.
    pub(crate) fn square_root(square: Rational) -> Self {
        let root = |value: &BigInt| {
            let root = value.sqrt();
            (&root * &root == *value).then_some(root)
        };
        match (root(square.numer()), root(square.denom())) {
            (Some(numerator), Some(denominator)) => {
                Self::Fraction(Rational::new(numerator, denominator))
            }
            _ => Self::SquareRoot(square),
        }
    }

    /// The fraction, if it is one.
    pub fn as_fraction(&self) -> Option<&Rational> {
        match self {
            Self::Fraction(value) => Some(value),
            Self::SquareRoot(_) => None,
        }
    }

    /// Two fractions around it: equal for a fraction, else `2^−bits` of it apart.
    pub fn enclosure(&self, bits: u32) -> (Rational, Rational) {
        match self {
            Self::Fraction(value) => (value.clone(), value.clone()),
            Self::SquareRoot(square) => square_root_enclosure(square, square, bits),
        }
    }

    /// As LaTeX.
    pub fn to_latex(&self) -> String {
        match self {
            Self::Fraction(value) => crate::exact::rational::to_latex(value),
            Self::SquareRoot(square) => {
                format!("\\sqrt{{{}}}", crate::exact::rational::to_latex(square))
            }
        }
    }
}

impl std::fmt::Display for ExactValue {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fraction(value) => formatter.pad(&to_text(value)),
            Self::SquareRoot(square) => formatter.pad(&format!("sqrt({})", to_text(square))),
        }
    }
}

/// A Courant number where stability or monotonicity ends, with an enclosure and its evidence.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    lower: f64,
    upper: f64,
    enclosure: Option<(Rational, Rational)>,
    exact: Option<ExactValue>,
    root_of: Option<AlgebraicNumber>,
    evidence: Evidence,
    critical_wave: Option<Wave>,
    binding_offset: Option<Vec<i64>>,
    binding: Option<Binding>,
    included: bool,
    unbounded: bool,
}

/// The condition that ends stability.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Binding {
    /// What fails beyond.
    pub condition: Condition,
    /// Whether two multipliers on the circle meet at the limit.
    pub on_circle: bool,
    /// Whether some wave is unstable whatever the step: its restoring force has the wrong sign.
    pub whatever_the_step: bool,
}

impl Binding {
    /// The word used in files: `lattice` where no step helps, else the name of the condition.
    pub fn name(self) -> String {
        if self.whatever_the_step { "lattice".into() } else { self.condition.name() }
    }
}

impl Limit {
    /// No limit was met up to `range_end`: the property holds at least so far.
    pub(crate) fn beyond(range_end: &Rational, evidence: Evidence) -> Self {
        Self::between(to_f64_below(range_end), f64::INFINITY, evidence)
    }

    pub(crate) fn exactly(value: ExactValue, evidence: Evidence) -> Self {
        let (lower, upper) = value.enclosure(EXACT_BITS);
        let (lower, upper) = (to_f64_below(&lower), to_f64_above(&upper));
        Self { exact: Some(value), ..Self::between(lower, upper, evidence) }
    }

    pub(crate) fn between(lower: f64, upper: f64, evidence: Evidence) -> Self {
        Self {
            lower,
            upper,
            enclosure: None,
            exact: None,
            root_of: None,
            evidence,
            critical_wave: None,
            binding_offset: None,
            binding: None,
            included: true,
            unbounded: false,
        }
    }

    /// Enclosed between two fractions.
    pub(crate) fn enclosed(lower: Rational, upper: Rational, evidence: Evidence) -> Self {
        let (below, above) = (to_f64_below(&lower), to_f64_above(&upper));
        Self { enclosure: Some((lower, upper)), ..Self::between(below, above, evidence) }
    }

    /// The root of a polynomial.
    pub(crate) fn root_of(number: AlgebraicNumber, evidence: Evidence) -> Self {
        let (lower, upper) = number.enclosure(EXACT_BITS);
        let (below, above) = (to_f64_below(&lower), to_f64_above(&upper));
        Self { root_of: Some(number), ..Self::between(below, above, evidence) }
    }

    /// The property holds for every value from `range_end` on as well: proved.
    pub(crate) fn unbounded(range_end: &Rational, evidence: Evidence) -> Self {
        Self { unbounded: true, ..Self::beyond(range_end, evidence) }
    }

    pub(crate) fn bound_by(self, binding: Binding) -> Self {
        Self { binding: Some(binding), included: !binding.on_circle, ..self }
    }

    pub(crate) fn included_if(self, included: bool) -> Self {
        Self { included, ..self }
    }

    /// Of coefficients that were measured: what is not undecided is measured.
    pub(crate) fn measured(self) -> Self {
        Self { evidence: self.evidence.measured(), ..self }
    }

    pub(crate) fn at_phase(self, phase: f64) -> Self {
        self.at_wave(Wave::along_a_line(phase))
    }

    pub(crate) fn at_wave(self, wave: Wave) -> Self {
        Self { critical_wave: Some(wave), ..self }
    }

    pub(crate) fn at_offset(self, offset: Vec<i64>) -> Self {
        Self { binding_offset: Some(offset), ..self }
    }

    /// The best single number that, written as a decimal, is not above the limit: 1.6 for 8/5. Infinite when no limit was met in
    /// the range looked at; [`lower`](Self::lower) is then the end of that range.
    pub fn value(&self) -> f64 {
        if self.upper.is_infinite() {
            return f64::INFINITY;
        }
        // A user who types what is printed means the decimal, not the binary number nearest to it.
        let certain = self.certain_lower();
        [to_f64(&certain), self.lower]
            .into_iter()
            .find(|value| {
                parse(&value.to_string()).is_ok_and(|typed| compare(&typed, &certain).is_le())
            })
            .unwrap_or(self.lower.next_down())
    }

    /// The first digits of the lower end, cut off: what is proved, however far the upper end may be. `None` when no limit was met.
    pub fn proved_decimal(&self, digits: usize) -> Option<String> {
        let lower = self.upper.is_finite().then(|| self.certain_lower())?;
        Some(if lower.is_positive() { decimal_below(&lower, digits) } else { "0".into() })
    }

    /// The property certainly holds up to this fraction, as far as is known without effort.
    pub(crate) fn certain_lower(&self) -> Rational {
        let enclosed = self.enclosure(EXACT_BITS).map(|(lower, _)| lower);
        enclosed.or_else(|| from_f64(self.lower)).expect("an end begins at a finite value")
    }

    /// The property is certainly lost above this fraction.
    pub(crate) fn certain_upper(&self) -> Option<Rational> {
        self.enclosure(EXACT_BITS).map(|(_, upper)| upper).or_else(|| from_f64(self.upper))
    }

    /// The first digits of the limit, at most so many and no more than the enclosure settles to one unit; cut off, not rounded, so
    /// that what is printed is not above it. `None` when no limit was met.
    ///
    /// ```
    /// use courant_analysis::{exact::rational::ratio, kernel::Kernel, scheme::catalogue};
    /// let scheme = catalogue::scheme("lax-wendroff-sph").unwrap();
    /// let limit = scheme.with_kernel(Kernel::CubicSpline, &ratio(3, 2))?.limit("C")?;
    /// assert_eq!(limit.decimal(30).unwrap(), "1.43606169335384336927869442224");
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    pub fn decimal(&self, digits: usize) -> Option<String> {
        let bits = (digits as f64 * std::f64::consts::LOG2_10).ceil() as u32 + 8;
        let known = || self.certain_upper().map(|upper| (self.certain_lower(), upper));
        let (lower, upper) = self.enclosure(bits).or_else(known)?;
        if !lower.is_positive() {
            return Some("0".into());
        }
        // An f64 from samples has no more digits than this, however long it is in decimals.
        let most = if matches!(self.evidence, Evidence::Sampled { .. }) { 15 } else { digits };
        // The power of ten of the first digit; logarithms may be one off.
        let mut first = integer(10).pow(to_f64(&lower).log10().floor() as i32);
        while first > lower {
            first /= integer(10);
        }
        let settled =
            |digits: &usize| &upper - &lower < &first / integer(10).pow(*digits as i32 - 1);
        let digits = (1..=digits.min(most)).rev().find(settled).unwrap_or(1);
        Some(decimal_below(&lower, digits))
    }

    /// The property holds from 0 up to here.
    pub fn lower(&self) -> f64 {
        self.lower
    }

    /// The property is lost above here.
    pub fn upper(&self) -> f64 {
        self.upper
    }

    /// The closed form, where there is one.
    pub fn exact(&self) -> Option<&ExactValue> {
        self.exact.as_ref()
    }

    /// The closed form as people write it: `15/8`, `sqrt(3)`, `(2/3)^(1/3)`; `None` where there is none.
    pub fn closed_form(&self) -> Option<String> {
        if let Some(exact) = &self.exact {
            return Some(exact.to_string());
        }
        let (radicand, index) = self.root_of.as_ref()?.radical()?;
        let text = to_text(&radicand);
        Some(match (index, radicand.is_integer()) {
            (2, _) => format!("sqrt({text})"),
            (_, true) => format!("{text}^(1/{index})"),
            (_, false) => format!("({text})^(1/{index})"),
        })
    }

    /// The polynomial equation it solves, where one was found and there is no closed form.
    pub fn equation(&self) -> Option<&AlgebraicNumber> {
        self.root_of.as_ref()
    }

    /// Two fractions that enclose the limit, `2^−bits` of it apart where it is known so well: always when
    /// it has a closed form or solves a known equation, else as narrow as the search was asked to be. `None` when
    /// only the enclosure in `f64` is known.
    pub fn enclosure(&self, bits: u32) -> Option<(Rational, Rational)> {
        match (&self.exact, &self.root_of) {
            (Some(value), _) => Some(value.enclosure(bits)),
            (None, Some(number)) => Some(number.enclosure(bits)),
            (None, None) => self.enclosure.clone(),
        }
    }

    /// What stands behind the number.
    pub fn evidence(&self) -> Evidence {
        self.evidence
    }

    /// The wave that binds; for a limit of 0 one that grows as `C → 0`, in one dimension the fastest.
    pub fn critical_wave(&self) -> Option<&Wave> {
        self.critical_wave.as_ref()
    }

    /// The phase of the wave that binds, in radians, in one dimension.
    pub fn critical_phase(&self) -> Option<f64> {
        self.critical_wave.as_ref()?.phase()
    }

    /// Which wave binds.
    pub fn cause(&self) -> Option<Cause> {
        self.critical_wave.as_ref().map(Cause::of_wave)
    }

    /// For monotonicity: the offset of the coefficient that turns negative.
    pub fn binding_offset(&self) -> Option<&[i64]> {
        self.binding_offset.as_deref()
    }

    /// The condition that fails beyond.
    pub fn binding(&self) -> Option<Binding> {
        self.binding
    }

    /// Whether the property holds at the limit itself. It does not where two multipliers meet on the circle with one eigenvector:
    /// the wave then grows like a power of the number of steps.
    pub fn is_included(&self) -> bool {
        self.included
    }

    /// Whether there is no limit at all, to infinity: proved, not only up to the end of a range.
    pub fn is_unbounded(&self) -> bool {
        self.unbounded
    }

    /// Whether there is a positive Courant number below the limit.
    pub fn is_positive(&self) -> bool {
        self.lower > 0.0
    }
}

#[cfg(test)]
mod tests;
