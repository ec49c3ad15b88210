//! Arithmetic modulo primes just below `2^61`: the images from which exact results are put together.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

/// The largest prime that is used, `2^61 − 1`.
const LARGEST: u64 = (1 << 61) - 1;

/// Bits of modulus that each prime is certain to contribute.
pub const BITS_PER_PRIME: u64 = 60;

/// The integers modulo an odd prime `p < 2^62`, in Montgomery form: `x` is stored as `2^64 x mod p`, so that a
/// product takes three multiplications and no division.
///
/// ```
/// use courant_analysis::exact::modular::PrimeField;
/// let field = PrimeField::descending().next().unwrap();
/// let third = field.inverse(field.embed(&3.into()));
/// assert_eq!(field.value(field.multiply(third, field.embed(&(-6).into()))), field.prime() - 2);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PrimeField {
    prime: u64,
    /// `−1/p mod 2^64`.
    negated_inverse: u64,
    /// `2^128 mod p`.
    square_of_radix: u64,
}

impl PrimeField {
    /// Modulo the largest prime that is used, of Mersenne.
    pub fn largest() -> Self {
        Self::new(LARGEST)
    }

    /// One field for each prime below `2^61`, the largest first.
    pub fn descending() -> impl Iterator<Item = Self> {
        (0..).map(|step| Self::new(LARGEST - 2 * step)).filter(Self::is_prime)
    }

    /// For an odd modulus below `2^62`; a field only if it is prime.
    fn new(prime: u64) -> Self {
        // Newton's iteration doubles the correct bits of 1/p; an odd p is right to three.
        let inverse =
            (0..5).fold(prime, |x, _| x.wrapping_mul(2u64.wrapping_sub(prime.wrapping_mul(x))));
        let radix = (1u128 << 64) % u128::from(prime);
        Self {
            prime,
            negated_inverse: inverse.wrapping_neg(),
            square_of_radix: (radix * radix % u128::from(prime)) as u64,
        }
    }

    /// Miller and Rabin's test with the bases that decide every 64-bit number.
    fn is_prime(&self) -> bool {
        let minus_one = self.embed(&(-1).into());
        let twos = (self.prime - 1).trailing_zeros();
        [2u64, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37].into_iter().all(|base| {
            let mut power = self.power(self.embed(&base.into()), (self.prime - 1) >> twos);
            if power == self.one() || power == minus_one {
                return true;
            }
            (1..twos).any(|_| {
                power = self.multiply(power, power);
                power == minus_one
            })
        })
    }

    /// The prime.
    pub fn prime(&self) -> u64 {
        self.prime
    }

    /// The element 1.
    pub fn one(&self) -> u64 {
        self.multiply(1, self.square_of_radix)
    }

    /// The residue of an integer.
    pub fn embed(&self, value: &BigInt) -> u64 {
        let residue = value.mod_floor(&self.prime.into()).to_u64().expect("below the prime");
        self.multiply(residue, self.square_of_radix)
    }

    /// An element as a number in `[0, p)`.
    pub fn value(&self, element: u64) -> u64 {
        self.multiply(element, 1)
    }

    /// `a + b`.
    pub fn add(&self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.prime { sum - self.prime } else { sum }
    }

    /// `a − b`.
    pub fn subtract(&self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.prime - b }
    }

    /// `a b`, by Montgomery's reduction.
    pub fn multiply(&self, a: u64, b: u64) -> u64 {
        let product = u128::from(a) * u128::from(b);
        let quotient = (product as u64).wrapping_mul(self.negated_inverse);
        let reduced = ((product + u128::from(quotient) * u128::from(self.prime)) >> 64) as u64;
        if reduced >= self.prime { reduced - self.prime } else { reduced }
    }

    /// `a^exponent`.
    pub fn power(&self, a: u64, mut exponent: u64) -> u64 {
        let (mut result, mut base) = (self.one(), a);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.multiply(result, base);
            }
            base = self.multiply(base, base);
            exponent >>= 1;
        }
        result
    }

    /// `1/a` for `a ≠ 0`, by Fermat.
    pub fn inverse(&self, a: u64) -> u64 {
        self.power(a, self.prime - 2)
    }

    /// The remainder of `a` divided by `b`, both `[c_0, c_1, …]` with a leading coefficient that is not 0.
    pub fn remainder(&self, mut a: Vec<u64>, b: &[u64]) -> Vec<u64> {
        let inverse = self.inverse(b[b.len() - 1]);
        while a.len() >= b.len() {
            let factor = self.multiply(a[a.len() - 1], inverse);
            let shift = a.len() - b.len();
            for (target, &value) in a[shift..].iter_mut().zip(b) {
                *target = self.subtract(*target, self.multiply(factor, value));
            }
            while a.last() == Some(&0) {
                a.pop();
            }
        }
        a
    }

    /// The remainder of `lc(b)^{deg a − deg b + 1} a` divided by `b`, which costs no inverse.
    pub fn pseudo_remainder(&self, mut a: Vec<u64>, b: &[u64]) -> Vec<u64> {
        let (leading, tail) = (b[b.len() - 1], &b[..b.len() - 1]);
        for degree in (b.len() - 1..a.len()).rev() {
            // a_top is eliminated, or was zero already and the rest is multiplied all the same.
            let Some(factor) = a.pop() else { break };
            a.iter_mut().for_each(|value| *value = self.multiply(*value, leading));
            for (target, &value) in a[degree - tail.len()..].iter_mut().zip(tail) {
                *target = self.subtract(*target, self.multiply(factor, value));
            }
        }
        while a.last() == Some(&0) {
            a.pop();
        }
        a
    }
}

/// Integers modulo a growing product of primes, by Chinese remainders.
#[derive(Debug, Clone)]
pub struct Reconstruction {
    modulus: BigInt,
    residues: Vec<BigInt>,
}

impl Reconstruction {
    /// From the images modulo the first prime.
    pub fn new(field: &PrimeField, images: &[u64]) -> Self {
        let residues = images.iter().map(|&image| field.value(image).into()).collect();
        Self { modulus: field.prime().into(), residues }
    }

    /// Takes in the images modulo one more prime, as many as there are residues.
    pub fn extend(&mut self, field: &PrimeField, images: &[u64]) {
        let inverse = field.inverse(field.embed(&self.modulus));
        for (residue, &image) in self.residues.iter_mut().zip(images) {
            let difference = field.subtract(image, field.embed(residue));
            let step = field.value(field.multiply(difference, inverse));
            *residue += &self.modulus * step;
        }
        self.modulus *= field.prime();
    }

    /// The product of the primes.
    pub fn modulus(&self) -> &BigInt {
        &self.modulus
    }

    /// The residues in `[0, modulus)`.
    pub fn residues(&self) -> &[BigInt] {
        &self.residues
    }

    /// The residues of smallest magnitude: the integers themselves once the modulus exceeds twice the
    /// largest of them.
    pub fn integers(&self) -> Vec<BigInt> {
        let half = &self.modulus >> 1;
        let centered = |r: &BigInt| if *r > half { r - &self.modulus } else { r.clone() };
        self.residues.iter().map(centered).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_largest_primes_are_the_known_ones() {
        // 2^61 − 1, − 31, − 45, − 229, − 259: the distances to 2^61 are in every table of primes.
        let found: Vec<u64> =
            PrimeField::descending().take(5).map(|field| (1 << 61) - field.prime()).collect();
        assert_eq!(found, [1, 31, 45, 229, 259]);
    }

    #[test]
    fn residues_of_either_half_are_the_nearest_to_zero() {
        let field = PrimeField::largest();
        let half = BigInt::from(field.prime() / 2);
        let images = [half.clone(), &half + 1].map(|value| field.embed(&value));
        assert_eq!(Reconstruction::new(&field, &images).integers(), [half.clone(), -half]);
    }

    proptest! {
        #[test]
        fn arithmetic_agrees_with_remainders(a in any::<i64>(), b in any::<i64>(), skip in 0usize..4) {
            let field = PrimeField::descending().nth(skip).unwrap();
            let prime = i128::from(field.prime());
            let (x, y) = (field.embed(&a.into()), field.embed(&b.into()));
            let expected = |value: i128| value.rem_euclid(prime) as u64;
            let (a, b) = (i128::from(a), i128::from(b));
            prop_assert_eq!(field.value(field.add(x, y)), expected(a + b));
            prop_assert_eq!(field.value(field.subtract(x, y)), expected(a - b));
            prop_assert_eq!(field.value(field.multiply(x, y)), expected((a % prime) * (b % prime)));
            prop_assert_eq!(field.add(x, field.subtract(0, x)), 0);
            if y != 0 {
                prop_assert_eq!(field.multiply(field.inverse(y), y), field.one());
            }
        }

        #[test]
        fn both_remainders_are_multiples_of_one_another(
            a in prop::collection::vec(0i64..9, 1..8), b in prop::collection::vec(0i64..9, 0..5), last in 1i64..9
        ) {
            let field = PrimeField::descending().next().unwrap();
            let embedded = |values: &[i64]| -> Vec<u64> {
                values.iter().map(|&value| field.embed(&value.into())).collect()
            };
            let (mut a, b) = (embedded(&a), embedded(&[&b[..], &[last]].concat()));
            while a.last() == Some(&0) {
                a.pop();
            }
            let power = (a.len() + 1).saturating_sub(b.len());
            let factor = field.power(b[b.len() - 1], power as u64);
            let plain = field.remainder(a.clone(), &b);
            let scaled: Vec<u64> = plain.iter().map(|&value| field.multiply(value, factor)).collect();
            prop_assert_eq!(field.pseudo_remainder(a, &b), scaled);
            prop_assert!(plain.len() < b.len() && plain.last() != Some(&0));
        }

        #[test]
        fn integers_are_put_together_again(values in prop::collection::vec(any::<i128>(), 1..4)) {
            let mut fields = PrimeField::descending();
            let values: Vec<BigInt> = values.into_iter().map(BigInt::from).collect();
            let images = |field: &PrimeField| -> Vec<u64> {
                values.iter().map(|value| field.embed(value)).collect()
            };
            let first = fields.next().unwrap();
            let mut reconstruction = Reconstruction::new(&first, &images(&first));
            for field in fields.take(2) {
                reconstruction.extend(&field, &images(&field));
            }
            prop_assert_eq!(reconstruction.integers(), values);
        }
    }
}
