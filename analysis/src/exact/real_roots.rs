//! Real roots of rational polynomials in one variable: counted by Sturm's theorem, isolated by
//! bisection, recognised as fractions, and refined from a guess by Newton's method.

use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{
    Rational, compare, dyadic, equal, from_f64, integer, product, ratio, simplest_between,
};
use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// A real root enclosed in `[lower, upper]`; the two are equal when the root is that fraction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RealRoot {
    /// Not above the root.
    pub lower: Rational,
    /// Not below the root.
    pub upper: Rational,
}

impl RealRoot {
    /// The root as a fraction, when it was recognised as one.
    pub fn exact(&self) -> Option<&Rational> {
        equal(&self.lower, &self.upper).then_some(&self.lower)
    }
}

/// The distinct roots in `(from, to]`, ascending, each enclosed to `2^−bits` of its size.
///
/// ```
/// use courant_analysis::{exact::polynomial::Polynomial, exact::rational::{integer, ratio}};
/// use courant_analysis::exact::real_roots::real_roots;
/// // (2t − 1)(t² − 2)
/// let p = Polynomial::new(vec![integer(2), integer(-4), integer(-1), integer(2)]);
/// let roots = real_roots(&p, &integer(0), &integer(10), 60);
/// assert_eq!(roots[0].exact(), Some(&ratio(1, 2)));
/// assert!(roots[1].exact().is_none() && roots.len() == 2);
/// ```
pub fn real_roots(
    polynomial: &Polynomial<Rational>,
    from: &Rational,
    to: &Rational,
    bits: u32,
) -> Vec<RealRoot> {
    let chain = SturmChain::new(polynomial);
    let mut roots = Vec::new();
    let mut pending = vec![(from.clone(), to.clone())];
    while let Some((lower, upper)) = pending.pop() {
        match chain.count(&lower, &upper) {
            0 => {}
            1 => roots.push(chain.refine(lower, upper, bits)),
            _ => {
                let middle = (&lower + &upper) / integer(2);
                // The lower half is looked at first.
                pending.push((middle.clone(), upper));
                pending.push((lower, middle));
            }
        }
    }
    roots
}

/// Cauchy's bound on the moduli of all roots.
pub(crate) fn root_bound(polynomial: &Polynomial<Rational>) -> Rational {
    let Some((leading, rest)) = polynomial.coefficients().split_last() else {
        return Rational::one();
    };
    let ratios = rest.iter().map(|value| (value / leading).abs());
    Rational::one() + ratios.max().unwrap_or_default()
}

/// Sturm's chain of a polynomial: `p, p', −rem(p, p'), …`, each made primitive.
#[derive(Debug, Clone)]
pub struct SturmChain {
    chain: Vec<Polynomial<Rational>>,
}

impl SturmChain {
    /// The chain; for the zero polynomial it is empty.
    pub fn new(polynomial: &Polynomial<Rational>) -> Self {
        let mut chain = vec![primitive(polynomial), primitive(&polynomial.derivative())];
        while chain.last().is_some_and(|last| !last.is_zero()) {
            let [.., before, last] = chain.as_slice() else {
                unreachable!("the chain starts with two")
            };
            let next = primitive(&-before.divide(last).1);
            chain.push(next);
        }
        chain.retain(|polynomial| !polynomial.is_zero());
        // The last one is the common divisor of p and p'. Without it multiple roots are simple, and
        // the count holds even where an end of the interval is a multiple root.
        if let Some(common) = chain.last().cloned() {
            chain.iter_mut().for_each(|polynomial| *polynomial = polynomial.divide(&common).0);
        }
        Self { chain }
    }

    /// The number of distinct roots in `(from, to]`.
    pub fn count(&self, from: &Rational, to: &Rational) -> usize {
        self.variations(from).saturating_sub(self.variations(to))
    }

    /// Sign changes of the chain at a point, zeros left out. At a root of `p` the count is that just
    /// above the root, which makes intervals open below and closed above.
    fn variations(&self, point: &Rational) -> usize {
        let signs: Vec<bool> = self
            .chain
            .iter()
            .map(|polynomial| polynomial.evaluate(point))
            .filter(|value| !value.is_zero())
            .map(|value| value.is_positive())
            .collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// Shrinks an interval `(lower, upper]` with exactly one root, and recognises a fraction.
    fn refine(&self, mut lower: Rational, mut upper: Rational, bits: u32) -> RealRoot {
        let polynomial = &self.chain[0];
        // The end below does not belong to the interval, and may be another root.
        let simplest_root = |lower: &Rational, upper: &Rational| {
            let simplest = simplest_between(lower, upper);
            (simplest > *lower && polynomial.evaluate(&simplest).is_zero())
                .then(|| RealRoot { lower: simplest.clone(), upper: simplest })
        };
        let fine = ratio(1, 2).pow(bits as i32);
        while &upper - &lower > &fine * upper.abs().max(lower.abs()) {
            if let Some(root) = simplest_root(&lower, &upper) {
                return root;
            }
            let middle = (&lower + &upper) / integer(2);
            if self.count(&lower, &middle) == 1 { upper = middle } else { lower = middle }
        }
        simplest_root(&lower, &upper).unwrap_or(RealRoot { lower, upper })
    }
}

/// Divided by the positive content, so that coefficients stay small integers.
fn primitive(polynomial: &Polynomial<Rational>) -> Polynomial<Rational> {
    let coefficients = polynomial.coefficients();
    let (numerator, denominator) = coefficients.iter().fold(
        (BigInt::zero(), BigInt::one()),
        |(numerator, denominator), value| {
            (numerator.gcd(value.numer()), denominator.lcm(value.denom()))
        },
    );
    if numerator.is_zero() {
        return Polynomial::zero();
    }
    polynomial.scale(&Rational::new(denominator, numerator))
}

/// A root of odd multiplicity near a positive guess, enclosed to about `2^−bits` of its size: Newton's method in
/// integer fixed point, verified by the signs of the polynomial at both ends. (The coefficients have thousands of digits;
/// fractions and Sturm's chain on them cost a thousand times as much.)
pub(crate) fn root_near(coefficients: &[BigInt], guess: f64, bits: u32) -> Option<RealRoot> {
    // Unit of t: about 2^−3·bits of its size. The largest coefficient has twice as many.
    let digits = 3 * i64::from(bits);
    // A guess beyond that unit is so large that the highest coefficients would be cut off whole.
    let shift = u64::try_from(digits - guess.log2().ceil() as i64).ok()?;
    let largest = coefficients.iter().map(|value| value.bits() as i64).max()?;
    let cut = largest - 2 * digits;
    let rounded: Vec<BigInt> = coefficients
        .iter()
        .map(|value| if cut >= 0 { value >> cut as u64 } else { value << (-cut) as u64 })
        .collect();
    let unit = |value: BigInt| value >> shift;
    let mut root = product(&from_f64(guess)?, &power_of_two(shift as i64)).to_integer();
    // The digits double in each step, from about ten bits on.
    for _ in 0..(bits / 5).max(2).ilog2() + 2 {
        let (mut value, mut slope) = (BigInt::zero(), BigInt::zero());
        for coefficient in rounded.iter().rev() {
            slope = unit(slope * &root) + &value;
            value = unit(value * &root) + coefficient;
        }
        if slope.is_zero() {
            return None;
        }
        root -= (value << shift) / slope;
    }
    let margin: BigInt = root.abs() >> u64::from(bits);
    // Ends with few digits keep the exact evaluations cheap.
    let coarse = (i64::from(bits) - 8).max(0) as u64;
    let (lower, upper) = ((&root - &margin) >> coarse, ((&root + &margin) >> coarse) + 1);
    let scale = coarse as i64 - shift as i64;
    let end = |value: BigInt| dyadic(value, scale);
    let root_width = &upper - &lower;
    let (lower, upper) = (end(lower), end(upper));
    let width = dyadic(root_width, scale);
    if compare(&width, &product(&upper, &power_of_two(4 - i64::from(bits)))).is_gt() {
        // Much smaller than the guess: the unit was too coarse.
        return None;
    }
    let sign = |end: &Rational| sign_of_value(coefficients, end);
    (sign(&lower) != sign(&upper)).then_some(RealRoot { lower, upper })
}

/// The sign of an integer polynomial at a fraction.
pub(crate) fn sign_at(polynomial: &Polynomial<BigInt>, point: &Rational) -> Sign {
    sign_of_value(polynomial.coefficients(), point)
}

/// Homogeneous in numerator and denominator: only the sign counts.
fn sign_of_value(coefficients: &[BigInt], point: &Rational) -> Sign {
    let mut weight = BigInt::one();
    let mut value = BigInt::zero();
    for coefficient in coefficients.iter().rev() {
        value = value * point.numer() + coefficient * &weight;
        weight *= point.denom();
    }
    value.sign()
}

/// `2^exponent`.
pub(crate) fn power_of_two(exponent: i64) -> Rational {
    dyadic(BigInt::one(), exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn from_roots(roots: &[Rational]) -> Polynomial<Rational> {
        roots.iter().fold(Polynomial::one(), |product, root| {
            product * Polynomial::new(vec![-root.clone(), integer(1)])
        })
    }

    #[test]
    fn multiple_roots_count_once_and_ends_belong_to_the_right_interval() {
        let p = from_roots(&[integer(1), integer(1), integer(2), integer(3)]);
        let chain = SturmChain::new(&p);
        assert_eq!(chain.count(&integer(0), &integer(1)), 1);
        assert_eq!(chain.count(&integer(1), &integer(3)), 2);
        assert_eq!(chain.count(&integer(3), &integer(9)), 0);
        assert_eq!(real_roots(&p, &integer(0), &integer(9), 60).len(), 3);
        assert!(real_roots(&Polynomial::zero(), &integer(0), &integer(1), 60).is_empty());
    }

    #[test]
    fn a_root_at_the_open_end_is_not_taken_for_the_one_inside() {
        // 1 and √2; 1 and 1 + 2^−100, which 60 bits do not tell apart.
        let beside = from_roots(&[integer(1)]) * Polynomial::new([-2, 0, 1].map(integer).to_vec());
        let [root] = &real_roots(&beside, &integer(1), &integer(2), 60)[..] else {
            panic!("√2 alone")
        };
        assert!(&root.lower * &root.lower < integer(2) && integer(2) < &root.upper * &root.upper);
        let close = integer(1) + power_of_two(-100);
        let [root] = &real_roots(
            &from_roots(&[integer(1), close.clone()]),
            &integer(1),
            &integer(2),
            60,
        )[..] else {
            panic!("one root above 1")
        };
        assert!(root.lower <= close && close <= root.upper && root.exact().is_none());
    }

    #[test]
    fn newtons_method_needs_no_more_than_ten_bits() {
        for bits in [20, 400] {
            // √2 · 2^exponent from a guess with an error of a thousandth.
            for exponent in [0, 10, -10] {
                let guess = 2f64.sqrt() * 1.001 * 2f64.powi(exponent);
                let radicand = integer(2) * power_of_two(2 * i64::from(exponent));
                let coefficients = [-radicand.numer(), BigInt::zero(), radicand.denom().clone()];
                let root = root_near(&coefficients, guess, bits);
                let root = root.unwrap_or_else(|| panic!("{bits} {exponent}"));
                assert!(
                    &root.lower * &root.lower < radicand && radicand < &root.upper * &root.upper
                );
            }
        }
        assert!(root_near(&[-1, 1].map(BigInt::from), 1e30, 20).is_none());
        // A double root has the same sign on both sides, and a flat spot no tangent.
        assert!(root_near(&[1, -2, 1].map(BigInt::from), 1.0, 60).is_none());
        assert!(root_near(&[2, -2, 1].map(BigInt::from), 1.0, 60).is_none());
    }

    proptest! {
        #[test]
        fn chosen_roots_are_found(numerators in prop::collection::btree_set(-40i64..40, 1..5)) {
            let chosen: Vec<_> = numerators.into_iter().map(|n| ratio(n, 7)).collect();
            // An extra factor without real roots.
            let p = from_roots(&chosen) * Polynomial::new(vec![integer(3), integer(1), integer(1)]);
            let found = real_roots(&p, &integer(-10), &integer(10), 80);
            let exact: Vec<_> = found.iter().filter_map(|root| root.exact().cloned()).collect();
            prop_assert_eq!(exact, chosen);
        }

        #[test]
        fn newtons_method_serves_short_coefficients_too(square in 2i64..1000, bits in 20u32..500) {
            prop_assume!(BigInt::from(square).sqrt().pow(2) != BigInt::from(square));
            let guess = (square as f64).sqrt();
            let root = root_near(&[(-square).into(), BigInt::zero(), 1.into()], guess, bits);
            let root = root.expect("a simple root close to the guess");
            prop_assert!(&root.lower * &root.lower < integer(square));
            prop_assert!(integer(square) < &root.upper * &root.upper);
            prop_assert!(&root.upper - &root.lower <= &root.upper * power_of_two(3 - i64::from(bits)));
        }

        #[test]
        fn irrational_roots_are_enclosed(square in 2i64..1000) {
            let p = Polynomial::new(vec![integer(-square), integer(0), integer(1)]);
            let found = real_roots(&p, &integer(0), &integer(square), 70);
            prop_assert_eq!(found.len(), 1);
            let root = &found[0];
            prop_assert!(&root.lower * &root.lower <= integer(square));
            prop_assert!(&root.upper * &root.upper >= integer(square));
            prop_assert!(&root.upper - &root.lower <= ratio(1, 1 << 30) * ratio(1, 1 << 30));
        }
    }
}
