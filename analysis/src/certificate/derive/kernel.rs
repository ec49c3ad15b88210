//! Kernel weights from names, once more and in another way: polynomial kernels as sums of truncated powers, the Gaussian by its Taylor
//! series.

use super::super::KernelStatement;
use super::super::verify::{CertificateError, ensure};
use super::letters::{BITS, exponential, pi};
use crate::exact::rational::{Rational, integer, ratio};
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// A weight and how far it may be from the true number.
pub type Weight = (Rational, Rational);

/// The relative error granted to a weight of the Gaussian. In units of `2^−BITS` the exponential series
/// is wrong by less than `2^22`, π by less than `2^16`, and the smallest exponential is `e^{−9} > 2^−13`.
const SLACK_BITS: u32 = 260;

/// The weights by lattice distance, `k = 0, 1, …`.
#[derive(Debug, Clone)]
pub struct Lattice {
    pub ratio: Rational,
    /// `W_k`, `w_k`, `v_k`.
    pub weights: [Vec<Weight>; 3],
    pub rho: Weight,
}

impl Lattice {
    pub fn new(kernel: &KernelStatement) -> Result<Self, CertificateError> {
        let l = &kernel.ratio.0;
        ensure(l.is_positive() && *l <= integer(50), "the smoothing ratio is not in (0, 50]")?;
        let terms = truncated_powers(&kernel.name);
        ensure(terms.is_some() || kernel.name == "gaussian", "there is no such kernel")?;
        let knots = terms.iter().flatten().map(|(_, knot, _)| knot.clone());
        let support = knots.max().unwrap_or_else(|| integer(3));
        let reach = (support * l).floor().to_integer().to_i64().unwrap_or(0);
        let slack = match terms {
            Some(_) => Rational::zero(),
            None => Rational::new(BigInt::one(), BigInt::one() << SLACK_BITS),
        };
        let norm = (BigInt::one() << (3 * BITS)) / pi();
        let norm = norm.sqrt();
        let mut weights = [Vec::new(), Vec::new(), Vec::new()];
        for k in 0..=reach {
            let q = integer(k) / l;
            let shape = |order: i32| match &terms {
                Some(terms) => derivative(terms, &q, order),
                None => {
                    let units = exponential(&(&q * &q)) * &norm;
                    let value = Rational::new(units, BigInt::one() << (2 * BITS));
                    match order {
                        0 => value,
                        1 => -integer(2) * &q * value,
                        _ => (integer(4) * &q * &q - integer(2)) * value,
                    }
                }
            };
            let slope = if k == 0 { Rational::zero() } else { -shape(1) / (l * l) };
            let values = [shape(0) / l, slope, shape(2) / (l * l * l)];
            for (list, value) in weights.iter_mut().zip(values) {
                let error = value.abs() * &slack;
                list.push((value, error));
            }
        }
        // Neighbours on the edge of a smooth kernel have no weight.
        let vanishes = |list: &Vec<Weight>| list.last().is_some_and(|(value, _)| value.is_zero());
        while weights[0].len() > 1 && vanishes(&weights[1]) && vanishes(&weights[2]) {
            weights.iter_mut().for_each(|list| drop(list.pop()));
        }
        let sum = |part: fn(&Weight) -> &Rational| {
            let twice: Rational = weights[0][1..].iter().map(part).sum();
            part(&weights[0][0]) + twice * integer(2)
        };
        let rho = match kernel.density.as_str() {
            "summation" => (sum(|weight| &weight.0), sum(|weight| &weight.1)),
            "mass-per-spacing" => (Rational::one(), Rational::zero()),
            _ => return Err(CertificateError("there is no such density".into())),
        };
        Ok(Self { ratio: l.clone(), weights, rho })
    }

    pub fn reach(&self) -> usize {
        self.weights[1].len() - 1
    }
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

/// A derivative of a sum of truncated powers, up to the second.
fn derivative(terms: &[(Rational, Rational, i32)], q: &Rational, order: i32) -> Rational {
    let inside = terms.iter().filter(|(_, knot, _)| knot > q);
    inside
        .map(|(a, knot, p)| {
            let factor = [1, -p, p * (p - 1)][order as usize];
            a * integer(factor.into()) * (knot - q).pow(p - order)
        })
        .sum()
}
