//! Certificates written down from the limits that were found.

use super::{
    BindingCoefficient, Certificate, CertifiedBox, CertifiedCoefficient, CertifiedLimit,
    CertifiedPiece, CertifiedStencil, CertifiedSymbol, Exact, FactoredMargin, GrowingWave,
    MonotonicityProof, Proof, StabilityProof, Subject, UnstableClaim,
};
use crate::bernstein::{MarginForm, Sign, SignedBox, exact_cover, is_negative_between};
use crate::limit::{
    ExactValue, Limit, StableInterval, enclosed_coefficients, monotonicity_limit, phase_parameter,
    stable_set,
};
use crate::margin::Margin;
use crate::polynomial::Polynomial;
use crate::rational::{Rational, from_f64, integer, to_text};
use crate::symbol::EnclosedSymbol;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use thiserror::Error;

/// Boxes a cover may have.
const MAX_BOXES: usize = 20_000;

/// Boxes a cover may have before its piece of `t` is halved, and how many pieces are looked at.
const BOXES_OF_A_PIECE: usize = 400;
const MAX_PIECES: usize = 400;

/// How far above the limit instability is shown, relative: powers of one half, the widest that works.
const ABOVE: [i32; 6] = [20, 26, 32, 38, 44, 50];

/// Why no certificate can be written.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum CertificationError {
    /// The limit itself is not decided.
    #[error("the limit is not decided near C = {0}: there is nothing to certify")]
    Undecided(String),
    /// The claim holds, but the permitted number of boxes does not show it.
    #[error("the certificate would need more than {MAX_BOXES} boxes")]
    TooLarge,
    /// No growing wave was found just above the limit.
    #[error("no growing wave was found just above the limit")]
    NoWitness,
}

/// One certificate for each stable interval of `|g| ≤ 1 + growth` within `[0, max_courant]`, or the one
/// that says that no small Courant number is stable.
///
/// ```
/// use courant_analysis::certificate::{certify_stability, verify};
/// use courant_analysis::{kernel::Kernel, rational::integer};
/// use courant_analysis::scheme::{AdvectionScheme, Discretisation, Scheme};
/// let scheme = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(2));
/// let scheme = scheme.unwrap();
/// let certificates =
///     certify_stability(&scheme.symbol(), Some(&scheme), &integer(0), &integer(10)).unwrap();
/// assert!(verify(&certificates[0]).unwrap().statement.contains("15/8"));
/// ```
///
/// # Errors
/// When the limit is not decided, or when the certificate would be too large.
pub fn certify_stability(
    symbol: &EnclosedSymbol,
    subject: Option<&crate::scheme::Discretisation>,
    growth: &Rational,
    max_courant: &Rational,
) -> Result<Vec<Certificate>, CertificationError> {
    let set = stable_set(symbol, growth, max_courant);
    if let Some((from, to)) = set.undecided.first() {
        return Err(CertificationError::Undecided(format!("{from} … {to}")));
    }
    let margin = Margin::new(symbol, growth);
    let prover = StabilityProver { form: MarginForm::new(&margin), margin: &margin };
    let from_zero = set.intervals.first().is_some_and(|first| first.from.upper() == 0.0);
    let mut proofs = Vec::new();
    if !from_zero {
        proofs.push(prover.no_limit(&set.limit(), max_courant)?);
    }
    for interval in &set.intervals {
        proofs.push(prover.interval(interval, max_courant)?);
    }
    Ok(proofs
        .into_iter()
        .map(|proof| certificate(symbol, subject, Proof::Stability(Box::new(proof))))
        .collect())
}

/// The certificate of the monotonicity limit within `[0, max_courant]`.
///
/// # Errors
/// When the limit is not decided, or when the certificate would be too large.
pub fn certify_monotonicity(
    symbol: &EnclosedSymbol,
    subject: Option<&crate::scheme::Discretisation>,
    max_courant: &Rational,
) -> Result<Certificate, CertificationError> {
    let limit = monotonicity_limit(symbol, max_courant);
    let (lower, upper) = ends(&limit, 1, max_courant);
    let coefficients = enclosed_coefficients(symbol);
    let mut proof = MonotonicityProof {
        limit: certified_limit(&limit, lower.clone(), upper.clone()),
        coefficients: Vec::new(),
        binding: None,
    };
    if lower.is_positive() {
        for (offset, center, radius) in &coefficients {
            let lowered = center.clone() - radius.clone();
            let boxes = non_negative_cover(&lowered, &lower).ok_or(CertificationError::TooLarge)?;
            proof.coefficients.push(CertifiedCoefficient { offset: *offset, boxes });
        }
    }
    if let (Some(offset), Some(upper)) = (limit.binding_offset(), &upper) {
        let binding = coefficients.iter().find(|(candidate, ..)| *candidate == offset);
        let (_, center, radius) = binding.ok_or(CertificationError::NoWitness)?;
        let raised = center.clone() + radius.clone();
        let mut beyond = above(upper, max_courant);
        let to = beyond
            .find(|to| is_negative_between(raised.coefficients(), upper, to) == Some(true))
            .ok_or(CertificationError::NoWitness)?;
        proof.binding = Some(BindingCoefficient { offset, to: to.into() });
    }
    Ok(certificate(symbol, subject, Proof::Monotonicity(Box::new(proof))))
}

struct StabilityProver<'a> {
    margin: &'a Margin,
    form: MarginForm,
}

impl StabilityProver<'_> {
    fn interval(
        &self,
        interval: &StableInterval,
        max_courant: &Rational,
    ) -> Result<StabilityProof, CertificationError> {
        let stride = self.margin.stride();
        let from = match interval.from.exact() {
            Some(exact) => parameter(exact, stride),
            // Inside the interval: its beginning is enclosed, not known.
            None => power(&exactly(interval.from.upper()), stride),
        };
        let (lower, upper) = ends(&interval.to, stride, max_courant);
        let pieces = self.pieces(&from, &lower)?;
        let unstable = match &upper {
            Some(upper) => Some(self.unstable(&interval.to, upper, max_courant)?),
            None => None,
        };
        Ok(StabilityProof {
            growth: self.margin.growth().clone().into(),
            margin: self.factored_margin(),
            below: self.below(&interval.from, &from)?,
            from: from.into(),
            limit: certified_limit(&interval.to, lower, upper),
            pieces,
            unstable,
        })
    }

    /// Covers of all waves over an interval of `t`, which is halved where boxes over all of it would never
    /// do: of a degree above one in `t` the Bernstein coefficients may stay negative however small `s` is.
    fn pieces(
        &self,
        from: &Rational,
        to: &Rational,
    ) -> Result<Vec<CertifiedPiece>, CertificationError> {
        let linear = self.margin.powers() <= 2;
        let (boxes, mut left) =
            if linear { (MAX_BOXES, 1) } else { (BOXES_OF_A_PIECE, MAX_PIECES) };
        let mut pieces = Vec::new();
        let mut pending = vec![(from.clone(), to.clone())];
        while let Some((from, to)) = pending.pop() {
            if left == 0 {
                return Err(CertificationError::TooLarge);
            }
            left -= 1;
            match exact_cover(&self.form, &from, &to, boxes) {
                Some(cover) => pieces.push(CertifiedPiece {
                    to: to.into(),
                    boxes: cover.into_iter().map(certified_box).collect(),
                }),
                None => {
                    let middle = (&from + &to) / integer(2);
                    pending.push((middle.clone(), to));
                    pending.push((from, middle));
                }
            }
        }
        Ok(pieces)
    }

    fn no_limit(
        &self,
        limit: &Limit,
        max_courant: &Rational,
    ) -> Result<StabilityProof, CertificationError> {
        let zero = Rational::zero();
        Ok(StabilityProof {
            growth: self.margin.growth().clone().into(),
            margin: self.factored_margin(),
            from: zero.clone().into(),
            below: None,
            limit: certified_limit(limit, zero.clone(), Some(zero.clone())),
            pieces: Vec::new(),
            unstable: Some(self.unstable(limit, &zero, max_courant)?),
        })
    }

    /// A wave that is unstable from `upper` (in `t`) to a little above it.
    fn unstable(
        &self,
        limit: &Limit,
        upper: &Rational,
        max_courant: &Rational,
    ) -> Result<UnstableClaim, CertificationError> {
        let stride = self.margin.stride();
        let courant_number = if upper.is_zero() {
            Rational::zero()
        } else {
            match limit.exact().and_then(ExactValue::as_fraction) {
                Some(exact) => exact.clone(),
                None => exactly(limit.upper()),
            }
        };
        for witness in above(&courant_number, max_courant) {
            let beyond = power(&witness, stride);
            if beyond <= *upper {
                continue;
            }
            let critical = limit.critical_phase().filter(|_| self.margin.degree() > 0);
            let mut candidates = vec![phase_parameter(critical.unwrap_or(0.0))];
            if let (Sign::SomewhereNegative { phase_parameter, .. }, _) =
                self.form.sign(&beyond, &beyond, MAX_BOXES)
            {
                candidates.push(phase_parameter);
            }
            for s in candidates {
                let values = self.form.at_phase_parameter(&s, 1);
                if is_negative_between(&values, upper, &beyond) != Some(true) {
                    continue;
                }
                if let Some(witness_s) = self.growing_wave(&s, &beyond) {
                    return Ok(UnstableClaim {
                        s: s.into(),
                        witness: GrowingWave {
                            s: witness_s.into(),
                            courant_number: witness.into(),
                        },
                    });
                }
            }
        }
        Err(CertificationError::NoWitness)
    }

    /// A wave that grows just below the beginning of a stable interval.
    fn below(
        &self,
        begin: &Limit,
        from: &Rational,
    ) -> Result<Option<GrowingWave>, CertificationError> {
        if from.is_zero() {
            return Ok(None);
        }
        let courant_number = exactly(begin.lower());
        for bits in ABOVE {
            let witness = &courant_number
                - &courant_number * Rational::new(BigInt::one(), BigInt::one() << bits);
            let t = power(&witness, self.margin.stride());
            let (Sign::SomewhereNegative { phase_parameter, .. }, _) =
                self.form.sign(&t, &t, MAX_BOXES)
            else {
                continue;
            };
            if let Some(s) = self.growing_wave(&phase_parameter, &t) {
                return Ok(Some(GrowingWave { s: s.into(), courant_number: witness.into() }));
            }
        }
        Err(CertificationError::NoWitness)
    }

    /// A wave near `s`, itself neither infinitely long nor neutral at every Courant number, whose margin
    /// is negative at `t`.
    fn growing_wave(&self, s: &Rational, t: &Rational) -> Option<Rational> {
        let steps = (4..400).step_by(2).flat_map(|bits| {
            let step = Rational::new(BigInt::one(), BigInt::one() << bits);
            [s + &step, s - step]
        });
        std::iter::once(s.clone()).chain(steps).find(|candidate| {
            let in_range = candidate.is_positive() && *candidate <= integer(1);
            let complement = self.margin.complement_power() == 0 || !candidate.is_one();
            in_range
                && complement
                && !self.margin.neutral_waves().evaluate(candidate).is_zero()
                && Polynomial::new(self.form.at_phase_parameter(candidate, 1))
                    .evaluate(t)
                    .is_negative()
        })
    }

    fn factored_margin(&self) -> FactoredMargin {
        let margin = self.margin;
        let mut coefficients: Vec<Vec<Exact>> = Vec::new();
        for series in margin.integer_series() {
            let powers = series.in_powers_of_s();
            coefficients
                .push((0..=margin.degree()).map(|i| powers.coefficient(i).into()).collect());
        }
        let mut radius: Vec<Exact> =
            margin.integer_radius().iter().cloned().map(Exact::from).collect();
        if coefficients.is_empty() {
            // |g| = 1 everywhere: the polynomial is zero.
            coefficients.push(vec![BigInt::zero().into()]);
            radius.push(BigInt::zero().into());
        }
        let neutral = margin.neutral_waves().coefficients();
        FactoredMargin {
            phase_power: margin.phase_power(),
            complement_power: margin.complement_power(),
            neutral_waves: neutral.iter().cloned().map(Exact).collect(),
            courant_power: margin.courant_power(),
            stride: margin.stride(),
            denominator: margin.denominator().clone().into(),
            coefficients,
            radius,
        }
    }
}

/// The ends of a limit in `t = C^stride`: equal when it is exact.
fn ends(limit: &Limit, stride: usize, max_courant: &Rational) -> (Rational, Option<Rational>) {
    if limit.upper().is_infinite() {
        return (power(max_courant, stride), None);
    }
    match limit.exact() {
        Some(exact) => (parameter(exact, stride), Some(parameter(exact, stride))),
        None => {
            let end = |value: f64| power(&exactly(value), stride);
            (end(limit.lower()), Some(end(limit.upper())))
        }
    }
}

fn parameter(exact: &ExactValue, stride: usize) -> Rational {
    match exact {
        ExactValue::Fraction(value) => power(value, stride),
        // Square roots occur where only even powers of C do.
        ExactValue::SquareRoot(square) => square.clone(),
    }
}

fn power(value: &Rational, stride: usize) -> Rational {
    value.pow(stride as i32)
}

fn exactly(value: f64) -> Rational {
    from_f64(value).expect("an end that is not exact is finite")
}

/// Numbers above the limit, from far to near.
fn above(limit: &Rational, max_courant: &Rational) -> impl Iterator<Item = Rational> {
    let scale = if limit.is_zero() { max_courant.clone().min(integer(1)) } else { limit.clone() };
    let limit = limit.clone();
    ABOVE
        .into_iter()
        .map(move |bits| &limit + &scale * Rational::new(BigInt::one(), BigInt::one() << bits))
}

fn certified_limit(limit: &Limit, lower: Rational, upper: Option<Rational>) -> CertifiedLimit {
    let exact = upper.as_ref().is_some_and(|upper| *upper == lower);
    let courant_number = limit.exact().filter(|_| exact).map(|exact| match exact {
        ExactValue::Fraction(value) => to_text(value),
        ExactValue::SquareRoot(square) => format!("sqrt({})", to_text(square)),
    });
    CertifiedLimit { lower: lower.into(), upper: upper.map(Exact), courant_number }
}

fn certified_box(signed: SignedBox) -> CertifiedBox {
    CertifiedBox { from: signed.from.into(), to: signed.to.into(), signs: signed.signs }
}

/// A cover of `[0, end]` on which the polynomial has no negative Bernstein coefficient.
fn non_negative_cover(
    polynomial: &Polynomial<Rational>,
    end: &Rational,
) -> Option<Vec<CertifiedBox>> {
    let mut cover = Vec::new();
    let mut pending = vec![(Rational::zero(), end.clone())];
    while let Some((from, to)) = pending.pop() {
        let values = bernstein(polynomial, &from, &to);
        if values.iter().all(|value| !value.is_negative()) {
            let signs = values.iter().map(|v| if v.is_zero() { '0' } else { '+' }).collect();
            cover.push(CertifiedBox { from: from.into(), to: to.into(), signs: vec![signs] });
            continue;
        }
        if cover.len() + pending.len() >= MAX_BOXES {
            return None;
        }
        let middle = (&from + &to) / integer(2);
        pending.push((middle.clone(), to));
        pending.push((from, middle));
    }
    Some(cover)
}

/// Bernstein coefficients on `[from, to]` as blossoms: the symmetric multi-affine form of the
/// polynomial at `n − k` times `from` and `k` times `to`.
fn bernstein(polynomial: &Polynomial<Rational>, from: &Rational, to: &Rational) -> Vec<Rational> {
    let degree = polynomial.degree().unwrap_or(0);
    let choices = binomial_row(degree);
    (0..=degree)
        .map(|k| {
            let arguments = std::iter::repeat_n(from, degree - k).chain(std::iter::repeat_n(to, k));
            let symmetric = arguments.fold(vec![Rational::one()], |mut sums, value| {
                sums.push(Rational::zero());
                for index in (1..sums.len()).rev() {
                    let product = &sums[index - 1] * value;
                    sums[index] += product;
                }
                sums
            });
            (0..=degree).map(|j| polynomial.coefficient(j) * &symmetric[j] / &choices[j]).sum()
        })
        .collect()
}

fn binomial_row(degree: usize) -> Vec<Rational> {
    let mut row = vec![Rational::one()];
    for index in 0..degree {
        let next = &row[index] * integer((degree - index) as i64) / integer(index as i64 + 1);
        row.push(next);
    }
    row
}

fn certificate(
    symbol: &EnclosedSymbol,
    subject: Option<&crate::scheme::Discretisation>,
    proof: Proof,
) -> Certificate {
    let exact = |values: &[Rational]| values.iter().cloned().map(Exact).collect();
    let powers = symbol.even_radius().len();
    let stencils = (0..powers).map(|power| {
        let center = symbol.center().stencils().get(power);
        let radius = &symbol.coefficient_radius()[power];
        let reaches = center.and_then(|stencil| stencil.reach()).into_iter().chain(radius.reach());
        let reach = reaches.reduce(|(a, b), (c, d)| (a.min(c), b.max(d)));
        let (low, high) = reach.unwrap_or((0, -1));
        CertifiedStencil {
            lowest: low,
            coefficients: (low..=high)
                .map(|k| center.map_or_else(Rational::zero, |c| c.coefficient(k)).into())
                .collect(),
            radius: (low..=high).map(|k| radius.coefficient(k).into()).collect(),
        }
    });
    Certificate {
        subject: subject.map(|subject| Subject {
            scheme: subject.scheme().name().into(),
            kernel: subject.kernel().name().into(),
            ratio: subject.ratio().clone().into(),
        }),
        evidence: if symbol.is_exact() { "proved" } else { "enclosed" }.into(),
        symbol: CertifiedSymbol {
            stencils: stencils.collect(),
            even_radius: exact(symbol.even_radius()),
            odd_radius: exact(symbol.odd_radius()),
            keeps_constants: symbol.keeps_constants(),
        },
        proof,
    }
}
