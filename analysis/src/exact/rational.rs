//! Exact rational numbers: reading them as a person types them, printing them, bringing them over one
//! denominator, and rounding them to `f64` with a direction.

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::float::FloatCore;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use thiserror::Error;

/// An exact fraction of big integers in lowest terms.
pub type Rational = num_rational::BigRational;

/// Why a text is not a number.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ParseRationalError {
    /// Not a decimal, a decimal with exponent, or a fraction of two of them.
    #[error(
        "`{0}` is not a number; write a decimal such as 1.3 or 1e-6, or a fraction such as 3/2"
    )]
    Malformed(String),
    /// A fraction with denominator zero.
    #[error("`{0}` divides by zero")]
    ZeroDenominator(String),
    /// More digits or a larger exponent than anybody means.
    #[error("`{0}` is out of range; write at most 120 digits and an exponent between -400 and 400")]
    OutOfRange(String),
}

/// Reads a decimal or a fraction exactly: `1.3` is 13/10, `3/2`, `-2.5e-3`.
///
/// ```
/// use courant_analysis::exact::rational::{parse, ratio};
/// assert_eq!(parse("1.3"), Ok(ratio(13, 10)));
/// assert_eq!(parse("3/2"), Ok(ratio(3, 2)));
/// assert!(parse("NaN").is_err());
/// ```
///
/// # Errors
/// When the text is not a number, divides by zero or is absurdly long.
pub fn parse(text: &str) -> Result<Rational, ParseRationalError> {
    let trimmed = text.trim();
    match trimmed.split_once('/') {
        None => parse_decimal(trimmed),
        Some((numerator, denominator)) => {
            let (numerator, denominator) =
                (parse_decimal(numerator.trim())?, parse_decimal(denominator.trim())?);
            if denominator.is_zero() {
                return Err(ParseRationalError::ZeroDenominator(trimmed.into()));
            }
            Ok(numerator / denominator)
        }
    }
}

fn parse_decimal(text: &str) -> Result<Rational, ParseRationalError> {
    let malformed = || ParseRationalError::Malformed(text.into());
    let out_of_range = || ParseRationalError::OutOfRange(text.into());
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        None => (text, 0),
        Some((mantissa, exponent)) => {
            let exponent: i64 = exponent.parse().map_err(|_| malformed())?;
            if exponent.abs() > 400 {
                return Err(out_of_range());
            }
            (mantissa, exponent)
        }
    };
    let (sign, digits) = match mantissa.strip_prefix('-') {
        Some(rest) => (Sign::Minus, rest),
        None => (Sign::Plus, mantissa.strip_prefix('+').unwrap_or(mantissa)),
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let all: String = [whole, fraction].concat();
    if !all.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(malformed());
    }
    if all.len() > 120 {
        return Err(out_of_range());
    }
    let magnitude: BigInt = all.parse().map_err(|_| malformed())?;
    let signed = if sign == Sign::Minus { -magnitude } else { magnitude };
    let shift = exponent - fraction.len() as i64;
    let power = BigInt::from(10).pow(shift.unsigned_abs() as u32);
    Ok(if shift < 0 { reduced(signed, power) } else { Rational::from(signed * power) })
}

/// The fraction `numerator / denominator`.
///
/// # Panics
/// When `denominator` is zero.
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// The whole number `value`.
pub fn integer(value: i64) -> Rational {
    Rational::from(BigInt::from(value))
}

/// The least common multiple of the denominators; 1 when there are no values.
///
/// ```
/// use courant_analysis::exact::rational::{common_denominator, numerator_over, ratio};
/// let values = [ratio(1, 6), ratio(-3, 4)];
/// let common = common_denominator(&values);
/// assert_eq!(common, 12.into());
/// assert_eq!(numerator_over(&values[1], &common), (-9).into());
/// ```
pub fn common_denominator<'a>(values: impl IntoIterator<Item = &'a Rational>) -> BigInt {
    values.into_iter().fold(BigInt::one(), |common, value| least_multiple(&common, value.denom()))
}

/// The greatest common divisor: Euclid's algorithm until machine integers hold both, which go on by shifts.
pub(crate) fn greatest_divisor(left: &BigInt, right: &BigInt) -> BigInt {
    let (mut large, mut small) = (left.abs(), right.abs());
    if large < small {
        std::mem::swap(&mut large, &mut small);
    }
    loop {
        if let (Some(a), Some(b)) = (large.to_u64(), small.to_u64()) {
            return a.gcd(&b).into();
        }
        if let (Some(a), Some(b)) = (large.to_u128(), small.to_u128()) {
            return a.gcd(&b).into();
        }
        if small.is_zero() {
            return large;
        }
        let rest = large % &small;
        large = std::mem::replace(&mut small, rest);
    }
}

/// The least common multiple of two positive numbers.
pub(crate) fn least_multiple(left: &BigInt, right: &BigInt) -> BigInt {
    if left.is_one() || left == right {
        return right.clone();
    }
    left / greatest_divisor(left, right) * right
}

/// `numerator / denominator` in lowest terms.
pub(crate) fn reduced(numerator: BigInt, denominator: BigInt) -> Rational {
    let divisor = greatest_divisor(&numerator, &denominator);
    let divisor = if denominator.is_negative() { -divisor } else { divisor };
    if divisor.is_one() {
        return Rational::new_raw(numerator, denominator);
    }
    Rational::new_raw(numerator / &divisor, denominator / &divisor)
}

/// The numerator of `value` over `denominator`, which is a multiple of its own: no gcd is taken.
pub fn numerator_over(value: &Rational, denominator: &BigInt) -> BigInt {
    value.numer() * (denominator / value.denom())
}

/// The nearest `f64`; infinite only when the number itself is out of range.
pub fn to_f64(value: &Rational) -> f64 {
    quotient_to_f64(value.numer(), value.denom())
}

/// The `f64` nearest to `numerator / denominator`, without reducing the fraction first; neither can
/// overflow on the way.
///
/// # Panics
/// When `denominator` is zero.
pub fn quotient_to_f64(numerator: &BigInt, denominator: &BigInt) -> f64 {
    if numerator.is_zero() {
        return 0.0;
    }
    let (magnitude, exponent) = nearest_by_leading_bits(numerator, denominator)
        .unwrap_or_else(|| nearest_by_division(numerator, denominator));
    let result = scale_by_power_of_two(magnitude, exponent);
    if numerator.is_negative() != denominator.is_negative() { -result } else { result }
}

/// The nearest `f64` to the magnitude of a quotient, and the power of two that it is to be multiplied by: by division.
fn nearest_by_division(numerator: &BigInt, denominator: &BigInt) -> (f64, i64) {
    // 66 significant bits of the quotient, then one correct rounding by the integer conversion; the
    // sticky bit keeps ties honest.
    let (magnitude, denominator) = (numerator.magnitude(), denominator.magnitude());
    let shift = 66 - (magnitude.bits() as i64 - denominator.bits() as i64);
    let (mut quotient, remainder) = if shift >= 0 {
        (magnitude << shift as u64).div_rem(denominator)
    } else {
        magnitude.div_rem(&(denominator << (-shift) as u64))
    };
    if !remainder.is_zero() && quotient.is_even() {
        quotient += 1u32;
    }
    // Below the normal range the second rounding of the scaling is harmless for our purposes.
    (quotient.to_f64().unwrap_or(f64::INFINITY), -shift)
}

/// The same by the leading 126 bits of the numerator and 62 of the denominator, nearly always enough; `None` where they are not.
///
/// With `n ≤ N/2^a < n + 1` and `d ≤ D/2^b < d + 1`, `n < 2^126` and `2^61 ≤ d < 2^62`, the quotient of `N/2^a` and `D/2^b` lies between
/// `n/(d + 1) > n/d − n/d² > n/d − 16` and `(n + 1)/d < n/d + 1`: what both ends round to it rounds to as well.
fn nearest_by_leading_bits(numerator: &BigInt, denominator: &BigInt) -> Option<(f64, i64)> {
    let (n, a) = leading_bits(numerator, 126);
    let (d, b) = leading_bits(denominator, 62);
    let quotient = n / d;
    let least = quotient.saturating_sub(16) as f64;
    (least == (quotient + 2) as f64).then_some((least, a - b))
}

/// As many leading bits of a magnitude, at most 126, and the power of two that they are to be multiplied by; cut, not rounded.
fn leading_bits(value: &BigInt, count: i64) -> (u128, i64) {
    let mut digits = value.iter_u64_digits().rev().map(u128::from);
    let mut next = || digits.next().unwrap_or(0);
    let (first, second, third) = (next(), next(), next());
    // 64 bits follow the first two digits: none of 126 leading ones is missed.
    let zeros = first.leading_zeros() - 64;
    let leading = (first << 64 | second) << zeros | third << zeros >> 64;
    (leading >> (128 - count), value.bits() as i64 - count)
}

fn scale_by_power_of_two(value: f64, exponent: i64) -> f64 {
    let half = (exponent / 2).clamp(-1000, 1000) as i32;
    let rest = (exponent - i64::from(half)).clamp(-1070, 1000) as i32;
    value * 2f64.powi(half) * 2f64.powi(rest)
}

/// The largest `f64` that is not above `value`.
pub fn to_f64_below(value: &Rational) -> f64 {
    let nearest = to_f64(value);
    match from_f64(nearest) {
        Some(exact) if compare(&exact, value).is_gt() => nearest.next_down(),
        None if nearest > 0.0 => f64::MAX,
        _ => nearest,
    }
}

/// The smallest `f64` that is not below `value`.
pub fn to_f64_above(value: &Rational) -> f64 {
    // Adding zero turns −0 into 0.
    -to_f64_below(&-value.clone()) + 0.0
}

/// The exact value of a finite `f64`; `None` for infinities and NaN.
pub fn from_f64(value: f64) -> Option<Rational> {
    let (mantissa, exponent, sign) = value.is_finite().then(|| value.integer_decode())?;
    Some(dyadic(BigInt::from(mantissa) * sign, exponent.into()))
}

/// `value · 2^exponent` in lowest terms, without a general gcd.
pub(crate) fn dyadic(value: BigInt, exponent: i64) -> Rational {
    let Some(twos) = value.trailing_zeros() else { return Rational::zero() };
    if exponent >= 0 {
        return Rational::from(value << exponent.unsigned_abs());
    }
    let twos = twos.min(exponent.unsigned_abs());
    Rational::new_raw(value >> twos, BigInt::one() << (exponent.unsigned_abs() - twos))
}

/// The product, without a general gcd where both denominators are powers of two.
pub(crate) fn product(left: &Rational, right: &Rational) -> Rational {
    match (twos_below(left), twos_below(right)) {
        (Some(one), Some(other)) => dyadic(left.numer() * right.numer(), -(one + other)),
        _ => left * right,
    }
}

/// The `k` of a denominator `2^k`.
fn twos_below(value: &Rational) -> Option<i64> {
    let twos = value.denom().trailing_zeros()?;
    (twos + 1 == value.denom().bits()).then_some(twos as i64)
}

/// Whether two are the same: fractions in lowest terms are written in one way, and compare themselves by continued fractions.
pub(crate) fn equal(left: &Rational, right: &Rational) -> bool {
    left.numer() == right.numer() && left.denom() == right.denom()
}

/// Which of two is the larger, by products: fractions compare themselves by continued fractions.
pub(crate) fn compare(left: &Rational, right: &Rational) -> Ordering {
    (left.numer() * right.denom()).cmp(&(right.numer() * left.denom()))
}

/// Fractions below `√lower` and above `√upper` for `0 ≤ lower ≤ upper`, each within about `2^−bits` of it.
pub fn square_root_enclosure(
    lower: &Rational,
    upper: &Rational,
    bits: u32,
) -> (Rational, Rational) {
    // √(p/q) = √(p q)/q; the integer root of p q 4^b, over q 2^b, is cut downwards.
    let root = |value: &Rational, round_up: bool| {
        if !value.is_positive() {
            return Rational::zero();
        }
        let product: BigInt = value.numer() * value.denom();
        let scale = u64::from(bits) + value.denom().bits();
        let root = (product << (2 * scale)).sqrt() + i32::from(round_up);
        Rational::new(root, value.denom() << scale)
    };
    (root(lower, false), root(upper, true))
}

/// The fraction of smallest denominator in the closed interval `[lower, upper]` (Stern–Brocot).
///
/// ```
/// use courant_analysis::exact::rational::{ratio, simplest_between};
/// assert_eq!(simplest_between(&ratio(31, 10), &ratio(32, 10)), ratio(16, 5));
/// assert_eq!(simplest_between(&ratio(-1, 3), &ratio(1, 7)), ratio(0, 1));
/// ```
///
/// # Panics
/// When `lower > upper`.
pub fn simplest_between(lower: &Rational, upper: &Rational) -> Rational {
    assert!(lower <= upper, "an interval has its ends in order");
    if !lower.is_positive() && !upper.is_negative() {
        return Rational::zero();
    }
    if upper.is_negative() {
        return -simplest_between(&-upper.clone(), &-lower.clone());
    }
    // Continued fractions on bare integers: reducing a fraction in each step would cost far more.
    let (mut lower, mut upper) = (
        (lower.numer().clone(), lower.denom().clone()),
        (upper.numer().clone(), upper.denom().clone()),
    );
    let [mut numerators, mut denominators] =
        [[BigInt::zero(), BigInt::one()], [BigInt::one(), BigInt::zero()]];
    loop {
        let (floor, rest) = lower.0.div_rem(&lower.1);
        let ceiling = if rest.is_zero() { floor.clone() } else { &floor + 1 };
        let ends = &ceiling * &upper.1 <= upper.0;
        let quotient = if ends { ceiling } else { floor };
        for [before, last] in [&mut numerators, &mut denominators] {
            let next = &quotient * &*last + &*before;
            *before = std::mem::replace(last, next);
        }
        if ends {
            let ([_, numerator], [_, denominator]) = (numerators, denominators);
            return Rational::new(numerator, denominator);
        }
        let rest_of_upper = &upper.0 - &quotient * &upper.1;
        (lower, upper) = ((upper.1, rest_of_upper), (lower.1, rest));
    }
}

/// A fraction as text: `15/8`, or `2` when it is whole.
pub fn to_text(value: &Rational) -> String {
    if value.denom().is_one() {
        value.numer().to_string()
    } else {
        format!("{}/{}", value.numer(), value.denom())
    }
}

/// The first significant digits of a positive number, cut off and not rounded, so that what is printed is not above
/// it; in scientific notation when it is very small or very large.
///
/// ```
/// use courant_analysis::exact::rational::{decimal_below, ratio};
/// assert_eq!(decimal_below(&ratio(227, 81), 6), "2.80246");
/// assert_eq!(decimal_below(&ratio(15, 8), 6), "1.87500");
/// assert_eq!(decimal_below(&ratio(2, 3_000_000), 3), "6.66e-7");
/// ```
///
/// # Panics
/// When `value` is not positive, or `digits` is 0.
pub fn decimal_below(value: &Rational, digits: usize) -> String {
    assert!(value.is_positive() && digits > 0, "a positive number has a first digit");
    let ten = |power: i64| BigInt::from(10).pow(power.unsigned_abs() as u32);
    let cut = |exponent: i64| {
        let shift = digits as i64 - 1 - exponent;
        let (up, down) =
            if shift >= 0 { (ten(shift), BigInt::one()) } else { (BigInt::one(), ten(shift)) };
        (value.numer() * up) / (value.denom() * down)
    };
    let bits = value.numer().bits() as i64 - value.denom().bits() as i64;
    // One off at most; the digits tell.
    let guess = (bits as f64 * std::f64::consts::LOG10_2).floor() as i64;
    let (exponent, all) = (guess - 1..=guess + 1)
        .map(|exponent| (exponent, cut(exponent).to_string()))
        .find(|(_, all)| all.len() == digits)
        .expect("one of three powers of ten is right");
    if !(-4..digits as i64 + 3).contains(&exponent) {
        let (first, rest) = all.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        return format!("{first}{point}{rest}e{exponent}");
    }
    match usize::try_from(exponent) {
        Err(_) => format!("0.{}{all}", "0".repeat((-exponent - 1) as usize)),
        Ok(whole) if whole + 1 >= digits => format!("{all}{}", "0".repeat(whole + 1 - digits)),
        Ok(whole) => format!("{}.{}", &all[..=whole], &all[whole + 1..]),
    }
}

/// A fraction as LaTeX: `\frac{15}{8}`.
pub fn to_latex(value: &Rational) -> String {
    let sign = if value.is_negative() { "-" } else { "" };
    let magnitude = value.abs();
    if magnitude.denom().is_one() {
        format!("{sign}{}", magnitude.numer())
    } else {
        format!("{sign}\\frac{{{}}}{{{}}}", magnitude.numer(), magnitude.denom())
    }
}

#[cfg(test)]
mod tests;
