//! The coefficients of a scheme from its names, once more and in another way: polynomial kernels as
//! sums of truncated powers, the Gaussian by its Taylor series.

use super::super::{CertifiedSymbol, Subject};
use super::{CertificateError, coefficient, ensure};
use crate::exact::rational::{Rational, integer, ratio};
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// A weight and how far it may be from the true number.
type Weight = (Rational, Rational);

/// Fixed-point bits of the Gaussian; at least 60 more than [`SLACK_BITS`] needs.
const BITS: u32 = 320;

/// The relative error granted to a weight of the Gaussian. In units of `2^−BITS` the exponential series
/// is wrong by less than `2^22`, π by less than `2^16`, and the smallest exponential is `e^{−9} > 2^−13`.
const SLACK_BITS: u32 = 260;

/// Whether the coefficients are those of the named scheme, within the stated radii.
pub(super) fn check(subject: &Subject, symbol: &CertifiedSymbol) -> Result<(), CertificateError> {
    let (gradient, curvature) = weights(&subject.kernel, &subject.ratio.0)?;
    let (half, two) = (ratio(1, 2), integer(2));
    let mut expected: Vec<BTreeMap<i64, Weight>> = vec![BTreeMap::new(); 2];
    expected[0].insert(0, (Rational::one(), Rational::zero()));
    let error: Rational = gradient.iter().map(|(_, slack)| slack).sum();
    let zero = Rational::zero();
    let mut even = vec![zero.clone(); 2];
    let mut odd = vec![zero.clone(), &error * &two];
    match subject.scheme.as_str() {
        "euler-sph" | "lax-wendroff-sph" => {
            for (k, (w, slack)) in (1..).zip(&gradient) {
                expected[1].insert(k, (-w, slack.clone()));
                expected[1].insert(-k, (w.clone(), slack.clone()));
            }
            if subject.scheme == "lax-wendroff-sph" {
                let mut second = BTreeMap::new();
                for (k, (v, slack)) in (0i64..).zip(&curvature) {
                    second.insert(k, (v * &half, slack * &half));
                    second.insert(-k, (v * &half, slack * &half));
                }
                even.push(second.values().map(|(_, slack)| slack).sum());
                odd.push(zero.clone());
                expected.push(second);
            }
        }
        "godunov-sph" => {
            let sum: Rational = gradient.iter().map(|(w, _)| w).sum();
            expected[1].insert(0, (-sum * &two, &error * &two));
            for (k, (w, slack)) in (1..).zip(&gradient) {
                expected[1].insert(-k, (w * &two, slack * &two));
            }
            even[1] = &error * integer(4);
        }
        other => return Err(CertificateError(format!("there is no scheme `{other}`"))),
    }

    let structure_keeps_constants = subject.scheme != "lax-wendroff-sph";
    ensure(
        subject.kernel != "gaussian" || symbol.keeps_constants == structure_keeps_constants,
        "whether the scheme keeps constants is stated wrongly",
    )?;
    // A scheme without neighbours has fewer powers of C than its formula.
    expected.resize(expected.len().max(symbol.stencils.len()), BTreeMap::new());
    for (power, terms) in expected.iter().enumerate() {
        let stencil = symbol.stencils.get(power);
        let reach = 1 + stencil.map_or(0, |s| s.lowest.abs() + s.radius.len() as i64);
        let reach = terms.keys().fold(reach, |reach, k| reach.max(k.abs()));
        let difference = |k: i64| {
            let stated = stencil.map_or_else(Rational::zero, |stencil| {
                coefficient(&stencil.coefficients, stencil.lowest, k)
            });
            stated - terms.get(&k).map_or(&zero, |(value, _)| value)
        };
        let mut errors = [
            even.get(power).cloned().unwrap_or_else(Rational::zero),
            odd.get(power).cloned().unwrap_or_else(Rational::zero),
        ];
        for k in -reach..=reach {
            let radius = stencil.map_or_else(Rational::zero, |stencil| {
                coefficient(&stencil.radius, stencil.lowest, k)
            });
            let slack = terms.get(&k).map_or(&zero, |(_, slack)| slack);
            ensure(
                difference(k).abs() + slack <= radius,
                "a coefficient is not that of the named scheme",
            )?;
            errors[0] += (difference(k) + difference(-k)).abs() * &half;
            errors[1] += (difference(k) - difference(-k)).abs() * &half;
        }
        let declared = [&symbol.even_radius, &symbol.odd_radius];
        for (error, radii) in errors.iter().zip(declared) {
            let granted = radii.get(power).map_or(&zero, |radius| &radius.0);
            ensure(error <= granted, "the radii do not cover the named scheme")?;
        }
    }
    Ok(())
}

/// `[w_1, …]` and `[v_0, v_1, …]`.
fn weights(kernel: &str, l: &Rational) -> Result<(Vec<Weight>, Vec<Weight>), CertificateError> {
    ensure(l.is_positive() && *l <= integer(50), "the smoothing ratio is not in [1/100, 50]")?;
    let terms = truncated_powers(kernel);
    let support = match &terms {
        Some(terms) => terms.iter().map(|(_, knot, _)| knot.clone()).max(),
        None => (kernel == "gaussian").then(|| integer(3)),
    };
    let support =
        support.ok_or_else(|| CertificateError(format!("there is no kernel `{kernel}`")))?;
    let reach = (support * l).floor().to_integer().to_i64().unwrap_or(0);
    let (mut gradient, mut curvature) = (Vec::new(), Vec::new());
    for k in 0..=reach {
        let q = integer(k) / l;
        let (slope, bend) = match &terms {
            Some(terms) => (derivative(terms, &q, 1), derivative(terms, &q, 2)),
            None => {
                let shape = gaussian(&q);
                let bend = (integer(4) * &q * &q - integer(2)) * &shape;
                (-integer(2) * &q * shape, bend)
            }
        };
        let weight = |value: Rational| {
            let exact = terms.is_some();
            let slack = Rational::new(BigInt::from(i32::from(!exact)), BigInt::one() << SLACK_BITS);
            let slack = value.abs() * slack;
            (value, slack)
        };
        if k > 0 {
            gradient.push(weight(-slope / (l * l)));
        }
        curvature.push(weight(bend / (l * l * l)));
    }
    Ok((gradient, curvature))
}

/// `w(q) = Σ a (b − q)_+^p` for `q ≥ 0`: triples `(a, b, p)`. For the splines these are the terms of
/// Schoenberg's divided difference whose knots are positive; for Wendland's functions the expansion in
/// `1 − q/2`.
fn truncated_powers(kernel: &str) -> Option<Vec<(Rational, Rational, i32)>> {
    let spline = |order: i64, factors: &[i64]| {
        let factorial: i64 = (1..order).product();
        let knots = (0..).map(move |k| ratio(order, 2) - integer(k));
        factors
            .iter()
            .zip(knots)
            .map(|(&a, b)| (ratio(a, factorial), b, order as i32 - 1))
            .collect()
    };
    let wendland = |norm: Rational, lowest: i32, factors: &[i64]| {
        (lowest..)
            .zip(factors)
            .map(|(p, &a)| (&norm * integer(a) * ratio(1, 2).pow(p), integer(2), p))
            .collect()
    };
    match kernel {
        "cubic-spline" => Some(spline(4, &[1, -4])),
        "quartic-spline" => Some(spline(5, &[1, -5, 10])),
        "quintic-spline" => Some(spline(6, &[1, -6, 15])),
        "wendland-c2" => Some(wendland(ratio(5, 8), 3, &[4, -3])),
        "wendland-c4" => Some(wendland(ratio(3, 4), 5, &[14, -21, 8])),
        "wendland-c6" => Some(wendland(ratio(55, 64), 7, &[48, -108, 82, -21])),
        _ => None,
    }
}

/// The first or second derivative of a sum of truncated powers.
fn derivative(terms: &[(Rational, Rational, i32)], q: &Rational, order: i32) -> Rational {
    let inside = terms.iter().filter(|(_, knot, _)| knot > q);
    inside
        .map(|(a, knot, p)| {
            let factor = if order == 1 { -p } else { p * (p - 1) };
            a * integer(factor.into()) * (knot - q).pow(p - order)
        })
        .sum()
}

/// `e^{−q²}/√π`, relative error below `2^−SLACK_BITS`.
fn gaussian(q: &Rational) -> Rational {
    let one = BigInt::one() << BITS;
    let x = q * q;
    let (mut sum, mut term) = (BigInt::zero(), one.clone());
    for n in 1u32.. {
        sum += &term;
        term = -(term * x.numer()) / (x.denom() * n);
        // Beyond n = x the terms fall in size and alternate.
        if n > 9 && term.abs() <= BigInt::one() {
            break;
        }
    }
    // Gauss: π = 48 arctan 1/18 + 32 arctan 1/57 − 20 arctan 1/239.
    let arctan = |n: u32| -> BigInt {
        (0u32..130).fold(BigInt::zero(), |sum, k| {
            let term = &one / (BigInt::from(n).pow(2 * k + 1) * (2 * k + 1));
            if k % 2 == 0 { sum + term } else { sum - term }
        })
    };
    let pi = arctan(18) * 48 + arctan(57) * 32 - arctan(239) * 20;
    let square: BigInt = (BigInt::one() << (3 * BITS)) / pi;
    Rational::new(sum * square.sqrt(), BigInt::one() << (2 * BITS))
}
