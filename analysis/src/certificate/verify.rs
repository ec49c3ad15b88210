//! The checker: recomputes a certificate from its names by the plainest means.
//!
//! It shares nothing with the search but fractions of big integers: kernels are sums of truncated
//! powers, `|g|²` is multiplied out term by term in powers of `s`, and Bernstein coefficients come from
//! substituting the interval. Slow and short is the point.

mod subject;

use super::{
    Certificate, CertifiedBox, CertifiedLimit, CertifiedSymbol, Exact, FactoredMargin, GrowingWave,
    MonotonicityProof, Proof, StabilityProof, UnstableClaim,
};
use crate::rational::{Rational, integer};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use thiserror::Error;

/// What a certificate proves, now checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verified {
    /// The theorem in one sentence.
    pub statement: String,
    /// How many boxes were recomputed.
    pub boxes: usize,
}

/// The first thing in a certificate that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct CertificateError(pub String);

fn ensure(holds: bool, otherwise: &str) -> Result<(), CertificateError> {
    if holds { Ok(()) } else { Err(CertificateError(otherwise.into())) }
}

/// Checks a certificate.
///
/// # Errors
/// Names the first part that does not hold.
pub fn verify(certificate: &Certificate) -> Result<Verified, CertificateError> {
    let symbol = &certificate.symbol;
    check_symbol(symbol)?;
    let exact = is_exact(symbol);
    let word = if exact { "proved" } else { "enclosed" };
    ensure(certificate.evidence == word, "the evidence is not the one the radii give")?;
    let mut name = String::from("the scheme with the given coefficients");
    if let Some(subject) = &certificate.subject {
        subject::check(subject, symbol)?;
        name = format!(
            "{} with {} at ratio {}",
            subject.scheme,
            subject.kernel,
            text(&subject.ratio.0)
        );
    }
    let (property, boxes, limit, stride) = match &certificate.proof {
        Proof::Stability(proof) => {
            let boxes = check_stability(symbol, proof)?;
            let property = format!("|g| <= 1 + {} for all waves", text(&proof.growth.0));
            (property, boxes, &proof.limit, proof.margin.stride)
        }
        Proof::Monotonicity(proof) => {
            let boxes = check_monotonicity(symbol, proof)?;
            ("no coefficient is negative".to_owned(), boxes, &proof.limit, 1)
        }
    };
    let variable = if stride == 1 { "C".to_owned() } else { format!("C^{stride}") };
    let begin = match &certificate.proof {
        Proof::Stability(proof) if !proof.from.0.is_zero() => {
            format!("from {variable} = {} ", text(&proof.from.0))
        }
        _ => String::new(),
    };
    let end = match (&limit.courant_number, &limit.upper) {
        (Some(exact), _) => format!("up to C = {exact} and not just above"),
        (None, Some(upper)) => {
            format!("up to {variable} = {} and not above {}", text(&limit.lower.0), text(&upper.0))
        }
        (None, None) => format!("at least up to {variable} = {}", text(&limit.lower.0)),
    };
    Ok(Verified { statement: format!("{name}: {property} {begin}{end}"), boxes })
}

fn text(value: &Rational) -> String {
    value.to_string()
}

fn values(list: &[Exact]) -> Vec<Rational> {
    list.iter().map(|value| value.0.clone()).collect()
}

fn is_exact(symbol: &CertifiedSymbol) -> bool {
    let radii = symbol.stencils.iter().flat_map(|stencil| &stencil.radius);
    radii.chain(&symbol.even_radius).chain(&symbol.odd_radius).all(|radius| radius.0.is_zero())
}

fn coefficient(list: &[Exact], lowest: i64, offset: i64) -> Rational {
    let index = usize::try_from(offset - lowest).ok();
    index.and_then(|index| list.get(index)).map_or_else(Rational::zero, |value| value.0.clone())
}

/// Shapes, signs of radii, and that the three kinds of radii agree with each other.
fn check_symbol(symbol: &CertifiedSymbol) -> Result<(), CertificateError> {
    let powers = symbol.stencils.len();
    ensure((1..=64).contains(&powers), "a symbol has a stencil for each power of C")?;
    ensure(
        symbol.even_radius.len() == powers && symbol.odd_radius.len() == powers,
        "a symbol has two radii for each power of C",
    )?;
    for (power, stencil) in symbol.stencils.iter().enumerate() {
        ensure(
            stencil.coefficients.len() == stencil.radius.len()
                && stencil.radius.len() <= 1000
                && stencil.lowest.abs() <= 1000,
            "a stencil has a radius for each coefficient",
        )?;
        let (even, odd) = (&symbol.even_radius[power].0, &symbol.odd_radius[power].0);
        let total: Rational = stencil.radius.iter().map(|radius| &radius.0).sum();
        let consistent =
            stencil.radius.iter().all(|radius| !radius.0.is_negative() && radius.0 <= even + odd)
                && !even.is_negative()
                && !odd.is_negative()
                && *even <= total
                && *odd <= total;
        ensure(consistent, "the radii of a stencil contradict each other")?;
    }
    let mut moments = symbol.stencils.iter().enumerate().map(|(power, stencil)| {
        let sum: Rational = stencil.coefficients.iter().map(|value| &value.0).sum();
        sum == integer(i64::from(power == 0))
    });
    let center_keeps_constants = moments.all(|one| one);
    ensure(
        center_keeps_constants || !symbol.keeps_constants,
        "the coefficients do not keep a constant",
    )?;
    ensure(
        symbol.keeps_constants == center_keeps_constants || !is_exact(symbol),
        "the coefficients do keep a constant",
    )
}

/// What is left of `(1 + ε)² − |g|²`: `[power of t][power of s]` times the denominator.
struct Decider {
    rows: Vec<Vec<BigInt>>,
    radius: Vec<BigInt>,
}

fn check_stability(
    symbol: &CertifiedSymbol,
    proof: &StabilityProof,
) -> Result<usize, CertificateError> {
    let margin = &proof.margin;
    ensure(!proof.growth.0.is_negative(), "the permitted growth is negative")?;
    // With a single power of t either stride would do; one spelling is enough.
    let strides = if margin.coefficients.len() > 1 { 1..=2 } else { 1..=1 };
    ensure(strides.contains(&margin.stride), "the stride is 1 or 2")?;
    let decider = check_margin(symbol, &proof.growth.0, margin)?;
    check_limit(&proof.limit, margin.stride)?;

    let (from, lower) = (&proof.from.0, &proof.limit.lower.0);
    if lower.is_zero() {
        ensure(from.is_zero() && proof.boxes.is_empty(), "a limit of 0 leaves nothing to cover")?;
    } else {
        ensure(!from.is_negative() && from < lower, "the stable interval has no length")?;
        ensure(
            covers(&proof.boxes, &Rational::zero(), &Rational::one()),
            "the boxes do not cover all waves",
        )?;
        let lowered = decider.shifted(-1);
        for each in &proof.boxes {
            let rows: Vec<_> =
                lowered.iter().map(|row| bernstein(row, &each.from.0, &each.to.0)).collect();
            let columns: Vec<Vec<BigInt>> = (0..rows[0].len())
                .map(|i| {
                    let column: Vec<_> = rows.iter().map(|row| row[i].clone()).collect();
                    bernstein(&column, from, lower)
                })
                .collect();
            let signs: Vec<String> = (0..rows.len())
                .map(|j| columns.iter().map(|column| sign(&column[j])).collect())
                .collect();
            ensure(
                each.signs == signs && !signs.iter().any(|row| row.contains('-')),
                "a box has other signs than stated",
            )?;
        }
    }
    match &proof.below {
        None => ensure(from.is_zero(), "the interval begins above 0 without a reason")?,
        Some(wave) => {
            let below = wave.courant_number.0.pow(margin.stride as i32);
            ensure(
                below < *from && below >= from - from * nearness(18),
                "the first witness is not just below the interval",
            )?;
            check_growing(&decider, margin, wave)?;
        }
    }
    match (&proof.unstable, &proof.limit.upper) {
        (None, None) => Ok(proof.boxes.len()),
        (Some(claim), Some(upper)) => {
            check_unstable(&decider, margin, claim, &upper.0)?;
            Ok(proof.boxes.len())
        }
        _ => Err(CertificateError("an upper end comes with a growing wave".into())),
    }
}

/// The end is stated consistently, and tightly.
fn check_limit(limit: &CertifiedLimit, stride: usize) -> Result<(), CertificateError> {
    let lower = &limit.lower.0;
    ensure(!lower.is_negative(), "the limit is negative")?;
    let Some(upper) = limit.upper.as_ref().map(|upper| &upper.0) else {
        return ensure(limit.courant_number.is_none(), "there is no limit to write down");
    };
    ensure(
        lower <= upper && upper - lower <= lower * nearness(20),
        "the ends of the limit are far apart",
    )?;
    if lower < upper {
        return ensure(limit.courant_number.is_none(), "an enclosed limit has no closed form");
    }
    let fraction = (stride == 1).then(|| lower.clone()).or_else(|| square_root(lower));
    let expected =
        fraction.map_or_else(|| format!("sqrt({})", text(lower)), |fraction| text(&fraction));
    ensure(
        limit.courant_number.as_deref() == Some(expected.as_str()),
        "the closed form is not that of the limit",
    )
}

fn square_root(square: &Rational) -> Option<Rational> {
    let root = Rational::new(square.numer().sqrt(), square.denom().sqrt());
    (&root * &root == *square).then_some(root)
}

fn nearness(bits: u32) -> Rational {
    Rational::new(BigInt::one(), BigInt::one() << bits)
}

fn check_unstable(
    decider: &Decider,
    margin: &FactoredMargin,
    claim: &UnstableClaim,
    upper: &Rational,
) -> Result<(), CertificateError> {
    let beyond = claim.witness.courant_number.0.pow(margin.stride as i32);
    let scale = if upper.is_zero() { Rational::one() } else { upper.clone() };
    ensure(
        beyond > *upper && beyond <= upper + scale * nearness(18),
        "the witness is not just above the limit",
    )?;
    let s = &claim.s.0;
    // A polynomial that does not depend on s needs no choice.
    let last = Rational::from(BigInt::from(i32::from(decider.rows[0].len() > 1)));
    ensure(!s.is_negative() && *s <= last, "s is not in [0, 1]")?;
    let signs: Vec<_> = bernstein(&decider.raised_at(s), upper, &beyond);
    ensure(
        signs.iter().all(|value| !value.is_positive()) && signs.iter().any(Signed::is_negative),
        "the wave at s does not grow throughout",
    )?;
    check_growing(decider, margin, &claim.witness)
}

/// Whether the margin is negative at one point, whatever the true coefficients are within the radii.
fn check_growing(
    decider: &Decider,
    margin: &FactoredMargin,
    wave: &GrowingWave,
) -> Result<(), CertificateError> {
    let (s, courant_number) = (&wave.s.0, &wave.courant_number.0);
    let neutral: Rational =
        (0..).zip(&margin.neutral_waves).map(|(i, value)| &value.0 * s.pow(i)).sum();
    ensure(
        courant_number.is_positive()
            && s.is_positive()
            && *s <= Rational::one()
            && (margin.complement_power == 0 || !s.is_one())
            && !neutral.is_zero(),
        "the witness is not a wave that can grow",
    )?;
    let t = courant_number.pow(margin.stride as i32);
    let terms = (0..).zip(decider.raised_at(s));
    let value: Rational = terms.map(|(j, value)| t.pow(j) * Rational::from(value)).sum();
    ensure(value.is_negative(), "the witness does not grow")
}

impl Decider {
    /// The rows with the constant coefficients moved by the radii.
    fn shifted(&self, direction: i64) -> Vec<Vec<BigInt>> {
        let mut rows = self.rows.clone();
        for (row, radius) in rows.iter_mut().zip(&self.radius) {
            row[0] += radius * direction;
        }
        rows
    }

    /// The polynomial in `t` at one `s`, raised by the radii, up to a positive factor.
    fn raised_at(&self, s: &Rational) -> Vec<BigInt> {
        let raised = self.shifted(1);
        let (a, d, length) = (s.numer(), s.denom(), raised[0].len() as u32);
        let terms = |row: &[BigInt]| {
            (0u32..).zip(row).map(|(i, value)| value * a.pow(i) * d.pow(length - i)).sum()
        };
        raised.iter().map(|row| terms(row)).collect()
    }
}

/// Multiplies `(1 + ε)² − |g|²` out and compares it with the product of the stated factors.
fn check_margin(
    symbol: &CertifiedSymbol,
    growth: &Rational,
    margin: &FactoredMargin,
) -> Result<Decider, CertificateError> {
    let columns = margin.coefficients.first().map_or(0, Vec::len);
    ensure(
        (1..=1000).contains(&columns)
            && margin.coefficients.iter().all(|row| row.len() == columns)
            && margin.radius.len() == margin.coefficients.len()
            && margin.courant_power <= 200
            && margin.phase_power + margin.complement_power <= 1000,
        "the polynomial is not a rectangle of coefficients",
    )?;
    let numbers = margin.coefficients.iter().flatten().chain(&margin.radius);
    ensure(
        numbers.chain([&margin.denominator]).all(|value| value.0.is_integer())
            && margin.denominator.0.is_positive(),
        "the polynomial is not written in whole numbers",
    )?;

    // The product: s^a (1 − s)^b H² first.
    let mut factor = vec![Rational::zero(); margin.phase_power];
    factor.push(Rational::one());
    for _ in 0..margin.complement_power {
        factor = product(&factor, &[Rational::one(), -Rational::one()]);
    }
    let neutral = values(&margin.neutral_waves);
    ensure(neutral.iter().any(|value| !value.is_zero()), "H is zero")?;
    factor = product(&product(&factor, &neutral), &neutral);
    let mut stated = vec![Vec::new(); margin.courant_power];
    for (j, row) in margin.coefficients.iter().enumerate() {
        stated.resize(margin.courant_power + margin.stride * j, Vec::new());
        let row: Vec<_> = values(row).iter().map(|value| value / &margin.denominator.0).collect();
        stated.push(product(&factor, &row));
    }
    let expanded = expand(symbol, growth);
    let zero = Rational::zero();
    for power in 0..stated.len().max(expanded.len()) {
        let (left, right) = (stated.get(power), expanded.get(power));
        let length = left.map_or(0, Vec::len).max(right.map_or(0, Vec::len));
        for i in 0..length {
            let left = left.and_then(|row| row.get(i)).unwrap_or(&zero);
            let right = right.and_then(|row| row.get(i)).unwrap_or(&zero);
            ensure(left == right, "the factors do not multiply to (1 + growth)² − |g|²")?;
        }
    }

    let radius = error_bounds(symbol);
    if !is_exact(symbol) {
        // Only what vanishes for the true coefficients too may be taken out.
        ensure(
            margin.complement_power == 0
                && neutral.len() == 1
                && (margin.phase_power == 0
                    || margin.phase_power == 1 && symbol.keeps_constants && growth.is_zero()),
            "a factor was taken out that the true coefficients need not have",
        )?;
    }
    let reach = |end: fn(&super::CertifiedStencil) -> i64| symbol.stencils.iter().map(end);
    let low = reach(|stencil| stencil.lowest).min().unwrap_or(0);
    let high = reach(|stencil| stencil.lowest + stencil.radius.len() as i64 - 1).max().unwrap_or(0);
    // |cos mφ − 1| ≤ 2m² s.
    let stretch = if margin.phase_power == 0 { 1 } else { 2 * (high - low) * (high - low) };
    for (power, bound) in radius.iter().enumerate() {
        let steps = power.checked_sub(margin.courant_power);
        let index = steps.filter(|steps| steps % margin.stride == 0).map(|s| s / margin.stride);
        let declared = index.and_then(|index| margin.radius.get(index));
        let needed = (bound * &margin.denominator.0).ceil() * integer(stretch);
        ensure(
            declared.map_or_else(|| bound.is_zero(), |declared| declared.0 == needed),
            "the radii of the polynomial do not follow from those of the coefficients",
        )?;
    }
    let radius: Vec<BigInt> = margin.radius.iter().map(|value| value.0.to_integer()).collect();
    let beyond_bounds =
        margin.courant_power + margin.stride * (radius.len() - 1) >= 2 * symbol.stencils.len() - 1;
    ensure(!beyond_bounds, "the polynomial has more powers of C than |g|² can have")?;
    let rows = margin.coefficients.iter();
    let rows = rows.map(|row| row.iter().map(|value| value.0.to_integer()).collect()).collect();
    Ok(Decider { rows, radius })
}

/// `(1 + ε)² − |g|²` as `[power of C][power of s]`, from
/// `|g|² = Σ_{k,l} c_k c_l cos (k − l)φ` and `cos mφ = T_m(1 − 2s)`.
fn expand(symbol: &CertifiedSymbol, growth: &Rational) -> Vec<Vec<Rational>> {
    let all = symbol.stencils.iter().flat_map(|stencil| &stencil.coefficients);
    let common = all.fold(BigInt::one(), |all, value| all.lcm(value.0.denom()));
    let whole = |value: &Exact| value.0.numer() * (&common / value.0.denom());
    let terms: Vec<(usize, i64, BigInt)> = symbol
        .stencils
        .iter()
        .enumerate()
        .flat_map(|(power, stencil)| {
            let offsets = stencil.lowest..;
            offsets.zip(&stencil.coefficients).map(move |(k, value)| (power, k, whole(value)))
        })
        .collect();
    let low = terms.iter().map(|(_, k, _)| *k).min().unwrap_or(0);
    let high = terms.iter().map(|(_, k, _)| *k).max().unwrap_or(0);
    let degree = (high - low) as usize;
    let powers = 2 * symbol.stencils.len() - 1;
    let mut cosines = vec![vec![BigInt::zero(); degree + 1]; powers];
    for (i, k, a) in &terms {
        for (j, l, b) in &terms {
            cosines[i + j][k.abs_diff(*l) as usize] += a * b;
        }
    }
    let mut rows = vec![vec![BigInt::zero(); degree + 1]; powers];
    let (mut before, mut current) = (vec![BigInt::one(), BigInt::from(-2)], vec![BigInt::one()]);
    for m in 0..=degree {
        for (row, series) in rows.iter_mut().zip(&cosines) {
            for (target, value) in row.iter_mut().zip(&current) {
                *target -= &series[m] * value;
            }
        }
        // T_{m+1} = 2 (1 − 2s) T_m − T_{m−1}, and T_{−1} = T_1.
        let mut next = vec![BigInt::zero(); m + 2];
        for (i, value) in current.iter().enumerate() {
            next[i] += value * 2;
            next[i + 1] -= value * 4;
        }
        for (target, value) in next.iter_mut().zip(&before) {
            *target -= value;
        }
        before = std::mem::replace(&mut current, next);
    }
    let square = Rational::from(&common * &common);
    let mut rows: Vec<Vec<Rational>> = rows
        .into_iter()
        .map(|row| row.into_iter().map(|value| Rational::from(value) / &square).collect())
        .collect();
    rows[0][0] += (growth + integer(1)) * (growth + integer(1));
    rows
}

/// How far `|g|²` may be off, by power of `C`: `|g|²` is the square of a cosine series plus the square of
/// a sine series, and `|ab − a₀b₀| ≤ |a₀| r_b + |b₀| r_a + r_a r_b`.
fn error_bounds(symbol: &CertifiedSymbol) -> Vec<Rational> {
    let powers = symbol.stencils.len();
    let mut bounds = vec![Rational::zero(); 2 * powers - 1];
    for (mirror, radius) in [(1, &symbol.even_radius), (-1, &symbol.odd_radius)] {
        let norms: Vec<Rational> = symbol
            .stencils
            .iter()
            .map(|stencil| {
                let at = |k| coefficient(&stencil.coefficients, stencil.lowest, k);
                let high = stencil.lowest + stencil.radius.len() as i64;
                let reach = stencil.lowest.abs().max(high.abs());
                (-reach..=reach)
                    .map(|k| (at(k) + at(-k) * integer(mirror)).abs() / integer(2))
                    .sum()
            })
            .collect();
        for i in 0..powers {
            for j in 0..powers {
                let (r, q) = (&radius[i].0, &radius[j].0);
                bounds[i + j] += &norms[i] * q + &norms[j] * r + r * q;
            }
        }
    }
    bounds
}

fn check_monotonicity(
    symbol: &CertifiedSymbol,
    proof: &MonotonicityProof,
) -> Result<usize, CertificateError> {
    check_limit(&proof.limit, 1)?;
    let row = |offset: i64, direction: i64| -> Vec<Rational> {
        let stencils = symbol.stencils.iter();
        stencils
            .map(|stencil| {
                coefficient(&stencil.coefficients, stencil.lowest, offset)
                    + coefficient(&stencil.radius, stencil.lowest, offset) * integer(direction)
            })
            .collect()
    };
    let lower = &proof.limit.lower.0;
    let mut boxes = 0;
    if lower.is_zero() {
        ensure(proof.coefficients.is_empty(), "a limit of 0 leaves nothing to cover")?;
    } else {
        let vanishes = |offset: i64| {
            let both = [row(offset, -1), row(offset, 1)];
            both.iter().flatten().all(Zero::is_zero)
        };
        let mut offsets: Vec<i64> = (-2000..=2000).filter(|&offset| !vanishes(offset)).collect();
        for each in &proof.coefficients {
            let known = offsets.iter().position(|offset| *offset == each.offset);
            ensure(known.is_some(), "an offset occurs twice or has no coefficient")?;
            offsets.retain(|offset| *offset != each.offset);
            ensure(
                covers(&each.boxes, &Rational::zero(), lower),
                "the boxes of a coefficient do not cover the interval",
            )?;
            let lowered = whole_numbers(&row(each.offset, -1));
            for part in &each.boxes {
                let signs: String =
                    bernstein(&lowered, &part.from.0, &part.to.0).iter().map(sign).collect();
                ensure(
                    part.signs == [signs.as_str()] && !signs.contains('-'),
                    "a coefficient has other signs than stated",
                )?;
                boxes += 1;
            }
        }
        ensure(offsets.is_empty(), "a coefficient is missing")?;
    }
    match (&proof.binding, &proof.limit.upper) {
        (None, None) => Ok(boxes),
        (Some(binding), Some(upper)) => {
            let scale = if upper.0.is_zero() { Rational::one() } else { upper.0.clone() };
            ensure(
                binding.to.0 > upper.0 && binding.to.0 <= &upper.0 + scale * nearness(18),
                "the binding coefficient is not looked at just above the limit",
            )?;
            let turns_negative = |offset: i64| {
                let raised = whole_numbers(&row(offset, 1));
                let values = bernstein(&raised, &upper.0, &binding.to.0);
                values.iter().all(|value| !value.is_positive())
                    && values.iter().any(Signed::is_negative)
            };
            ensure(binding.offset.abs() <= 2000, "the binding coefficient is out of reach")?;
            ensure(
                (-2000..=binding.offset).find(|&offset| turns_negative(offset))
                    == Some(binding.offset),
                "the binding coefficient is not the first that turns negative above the limit",
            )?;
            Ok(boxes)
        }
        _ => Err(CertificateError("an upper end comes with a binding coefficient".into())),
    }
}

/// Whether the boxes follow each other from one end to the other.
fn covers(boxes: &[CertifiedBox], from: &Rational, to: &Rational) -> bool {
    let mut reached = from.clone();
    for each in boxes {
        if each.from.0 != reached || each.to.0 <= reached {
            return false;
        }
        reached = each.to.0.clone();
    }
    reached == *to && !boxes.is_empty()
}

fn sign(value: &BigInt) -> char {
    match value.sign() {
        num_bigint::Sign::Plus => '+',
        num_bigint::Sign::NoSign => '0',
        num_bigint::Sign::Minus => '-',
    }
}

fn product(left: &[Rational], right: &[Rational]) -> Vec<Rational> {
    let mut result = vec![Rational::zero(); (left.len() + right.len()).saturating_sub(1)];
    for (i, a) in left.iter().enumerate() {
        for (j, b) in right.iter().enumerate() {
            result[i + j] += a * b;
        }
    }
    result
}

fn whole_numbers(values: &[Rational]) -> Vec<BigInt> {
    let common = values.iter().fold(BigInt::one(), |all, value| all.lcm(value.denom()));
    values.iter().map(|value| value.numer() * (&common / value.denom())).collect()
}

/// Positive multiples of the Bernstein coefficients of `Σ_i a_i x^i` on `[from, to]`: substitute
/// `x = from + (to − from) u`, then `u^i = u^i (u + (1 − u))^{n−i}`.
fn bernstein(values: &[BigInt], from: &Rational, to: &Rational) -> Vec<BigInt> {
    let common = from.denom().lcm(to.denom());
    let start = from.numer() * (&common / from.denom());
    let width = to.numer() * (&common / to.denom()) - &start;
    // Horner's rule with the polynomial start + width u, over powers of the common denominator.
    let mut substituted: Vec<BigInt> = Vec::with_capacity(values.len());
    let mut power = BigInt::one();
    for value in values.iter().rev() {
        substituted.push(BigInt::zero());
        for i in (0..substituted.len()).rev() {
            let below = if i > 0 { &substituted[i - 1] * &width } else { value * &power };
            substituted[i] = &substituted[i] * &start + below;
        }
        power *= &common;
    }
    let mut result: Vec<BigInt> = Vec::with_capacity(values.len());
    for value in substituted {
        // Multiply by (u + (1 − u)), then add the next term.
        result.push(BigInt::zero());
        for k in (1..result.len()).rev() {
            let below = result[k - 1].clone();
            result[k] += below;
        }
        *result.last_mut().expect("one was just pushed") += value;
    }
    result
}
