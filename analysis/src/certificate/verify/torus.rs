//! Proofs in two and three dimensions: waves covered up to symmetries, cuts replayed on each cube.

use super::super::derive::{Characteristic, Derived};
use super::super::{End, Interval, Subject, TorusCell, TorusInequality, TorusProof, TorusWave};
use super::arithmetic::bernstein;
use super::cube::{Form, linear_power, times};
use super::{CertificateError, Shown, ensure};
use crate::certificate::derive::Poly;
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::{BTreeMap, BTreeSet};

type Read<T> = Result<T, CertificateError>;

/// The largest multiple of a phase.
const MOST_MULTIPLE: u32 = 64;

/// Whether the derived polynomial is `|Q|²` times the margin.
pub(super) fn compare(
    derived: &Derived,
    chi: &Characteristic,
    subject: &Subject,
    stated: &TorusInequality,
) -> Read<()> {
    let exact = derived.polynomial.0.keys().all(|power| power.letters.is_empty());
    ensure(exact, "in several dimensions numbers are fractions")?;
    let root = chi.polynomial(&stated.square, subject)?;
    let common = common_denominator(stated);
    let mut margin = Poly::<BigInt>::default();
    for term in &stated.margin {
        ensure(term.k.len() == chi.dimension, "a wave has a phase for each axis")?;
        // cos x = (e^{ix} + e^{−ix})/2
        let value = (&term.value.0 * Rational::from(common.clone())).to_integer();
        for sign in [1, -1] {
            let shift = std::array::from_fn(|axis| term.k.get(axis).map_or(0, |k| sign * k));
            let power = Poly::monomial(0, shift, term.power as i32);
            margin = margin.plus(&power.scaled(&value));
        }
    }
    let product = root.times(&root.conjugate()).times(&margin);
    let same = product == derived.polynomial.scaled(&(common * 2));
    ensure(same, "a polynomial is not that of the scheme")
}

fn common_denominator(stated: &TorusInequality) -> BigInt {
    let values = stated.margin.iter().map(|term| term.value.0.denom().clone());
    values.fold(BigInt::one(), num_integer::lcm)
}

/// What the cubes and waves show about the interval.
pub(super) fn shown(proof: &TorusProof, interval: &Interval) -> Read<Shown> {
    ensure([1, 2].contains(&proof.stride), "a count is out of range")?;
    let margins = proof.inequalities.iter().map(|one| Margin::new(one, proof.stride));
    let margins = margins.collect::<Read<Vec<_>>>()?;
    let mut shown = Shown::default();
    let nothing = interval.lower.square().is_some_and(|square| square.is_zero());
    for (margin, stated) in margins.iter().zip(&proof.inequalities) {
        if nothing {
            ensure(stated.cells.is_empty(), "an interval of nothing is covered")?;
            continue;
        }
        margin.covers_all_waves(&stated.cells)?;
        for cell in &stated.cells {
            let (cover, boxes) = margin.holds(cell)?;
            shown.covers.push(cover);
            shown.boxes += boxes;
        }
    }
    let margin = |wave: &TorusWave| {
        let margin = margins.get(wave.wave.inequality);
        margin.ok_or_else(|| CertificateError("there is no such inequality".into()))
    };
    let power = |value: &Rational| value.pow(proof.stride as i32);
    if let Some(wave) = &proof.below {
        let value = &wave.value.0;
        ensure(value.is_positive(), "the wave does not grow")?;
        margin(wave)?.grows_at(wave, &power(value))?;
        shown.below = Some(value * value);
    }
    if let Some(wave) = &proof.above {
        let t = match &interval.upper {
            Some(End::Fraction(value)) => power(value),
            Some(End::Root(square)) if proof.stride == 2 => square.clone(),
            _ => return Err(CertificateError("t is no fraction".into())),
        };
        let value = &wave.value.0;
        ensure(value.is_positive(), "the wave is not just above the limit")?;
        margin(wave)?.grows_between(wave, &t, &power(value))?;
        shown.above = Some(value * value);
    }
    Ok(shown)
}

/// Multiples of the phases, the first that is not zero positive.
fn normal(k: Vec<i32>) -> Vec<i32> {
    let negative = k.iter().find(|k| **k != 0).is_some_and(|k| *k < 0);
    if negative { k.into_iter().map(|k| -k).collect() } else { k }
}

/// A margin as a cosine series, `C^stride` in powers above the least one.
pub(in super::super) struct Margin {
    dimension: usize,
    stride: usize,
    terms: BTreeMap<(usize, Vec<i32>), BigInt>,
}

impl Margin {
    pub(in super::super) fn new(stated: &TorusInequality, stride: usize) -> Read<Self> {
        let dimension = stated.margin.first().map_or(0, |term| term.k.len());
        ensure((1..=3).contains(&dimension), "a polynomial that is zero says nothing")?;
        let (common, lowest) =
            (common_denominator(stated), stated.margin.iter().map(|term| term.power).min());
        let mut terms = BTreeMap::new();
        for term in &stated.margin {
            let power = term.power - lowest.unwrap_or(0);
            let small = term.k.iter().all(|k| k.unsigned_abs() <= MOST_MULTIPLE);
            ensure(
                term.k.len() == dimension && small && power % stride == 0,
                "a term of a cosine series is not understood",
            )?;
            let value = (&term.value.0 * Rational::from(common.clone())).to_integer();
            let key = (power / stride, normal(term.k.clone()));
            let twice = term.value.0.is_zero() || key.1 != term.k;
            ensure(!twice && terms.insert(key, value).is_none(), "a term stands twice")?;
        }
        Ok(Self { dimension, stride, terms })
    }

    /// Whether exchanging axes and mirroring some of them leaves it as it is.
    fn is_symmetric(&self, order: &[usize], mirrored: usize) -> bool {
        let moved = self.terms.iter().map(|((power, k), value)| {
            let sign = |axis: usize| if mirrored >> axis & 1 == 1 { -1 } else { 1 };
            let moved = order.iter().enumerate().map(|(axis, &from)| sign(axis) * k[from]);
            ((*power, normal(moved.collect())), value.clone())
        });
        moved.collect::<BTreeMap<_, _>>() == self.terms
    }

    fn is_even(&self, axis: usize) -> bool {
        self.is_symmetric(&[0, 1, 2][..self.dimension], 1 << axis)
    }

    /// Each cube has an image under a symmetry among those stated.
    fn covers_all_waves(&self, cells: &[TorusCell]) -> Read<()> {
        let orders: &[&[usize]] = match self.dimension {
            1 => &[&[0]],
            2 => &[&[0, 1], &[1, 0]],
            _ => &[&[0, 1, 2], &[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]],
        };
        let mut covered: BTreeSet<String> = BTreeSet::new();
        for order in orders {
            for mirrored in (0..1 << self.dimension).filter(|m| self.is_symmetric(order, *m)) {
                for cell in cells {
                    let letters: Vec<char> = cell.cube.chars().collect();
                    ensure(letters.len() == self.dimension, "there is no such cube")?;
                    let image = order.iter().enumerate().map(|(axis, &from)| {
                        match (mirrored >> axis & 1, letters[from].to_digit(4)) {
                            (1, Some(quarter)) => char::from(b'3' - quarter as u8),
                            _ => letters[from],
                        }
                    });
                    covered.insert(image.collect());
                }
            }
        }
        let mut all = vec![String::new()];
        for axis in 0..self.dimension {
            let letters = if self.is_even(axis) { "h" } else { "0123" };
            let longer = |cube: String| letters.chars().map(move |turn| format!("{cube}{turn}"));
            all = all.into_iter().flat_map(longer).collect();
        }
        ensure(all.iter().all(|cube| covered.contains(cube)), "not all waves are covered")
    }

    /// On a cube, times a positive function of the wave.
    fn on_cube(&self, cube: &str) -> Read<Form> {
        ensure(cube.chars().count() == self.dimension, "there is no such cube")?;
        let zero = BigInt::zero;
        let mut rows: Vec<BTreeMap<i32, [Vec<BigInt>; 2]>> = Vec::new();
        for (axis, letter) in cube.chars().enumerate() {
            let all: BTreeSet<i32> = self.terms.keys().map(|(_, k)| k[axis]).collect();
            let most = all.iter().map(|k| k.unsigned_abs()).max().unwrap_or(0) as i32;
            let row = match (letter, letter.to_digit(4)) {
                ('h', _) if self.is_even(axis) => |k: i32, _, _| [half_turn(k), Vec::new()],
                (_, Some(_)) => quarter_turn,
                _ => return Err(CertificateError("there is no such cube".into())),
            };
            let quarter = letter.to_digit(4).unwrap_or(0);
            rows.push(all.into_iter().map(|k| (k, row(k, most, quarter))).collect());
        }
        let mut form = Form::default();
        for ((power, k), value) in &self.terms {
            // Real and imaginary part by powers of the coordinates.
            let mut product = vec![(Vec::new(), [value.clone(), zero()])];
            for (row, k) in rows.iter().zip(k) {
                let [real, imaginary] = &row[k];
                let longer = |(powers, [re, im]): (Vec<usize>, [BigInt; 2])| {
                    (0..real.len().max(imaginary.len())).map(move |power| {
                        let at = |list: &Vec<BigInt>| list.get(power).cloned().unwrap_or_default();
                        let (a, b) = (at(real), at(imaginary));
                        let powers = [powers.as_slice(), &[power]].concat();
                        (powers, [&re * &a - &im * &b, &re * &b + &im * &a])
                    })
                };
                product = product.into_iter().flat_map(longer).collect();
            }
            for (mut powers, [real, _]) in product {
                powers.push(*power);
                *form.0.entry(powers).or_default() += real;
            }
        }
        form.0.retain(|_, value| !value.is_zero());
        Ok(form)
    }

    /// Checks a cube; gives the squares of the values where the cover begins and ends, and the number of boxes.
    fn holds(&self, cell: &TorusCell) -> Read<((Rational, Option<Rational>), usize)> {
        let form = self.on_cube(&cell.cube)?;
        let begin = cell.begin.0.clone();
        ensure(!begin.is_negative() && !cell.pieces.is_empty(), "an interval is not covered")?;
        let (mut reached, mut boxes) = (Some(begin.clone()), 0);
        for piece in &cell.pieces {
            let from =
                reached.ok_or_else(|| CertificateError("something beyond everything".into()))?;
            let rows = match &piece.end {
                End::Fraction(to) => {
                    ensure(from < *to, "an interval is not covered")?;
                    reached = Some(to.clone());
                    form.in_last(&from, to)
                }
                End::Infinity => {
                    // From t₀ on: t^n P(1/t) from 0 to 1/t₀.
                    ensure(from.is_positive(), "an interval is not covered")?;
                    reached = None;
                    form.reversed_in_last().in_last(&Rational::zero(), &from.recip())
                }
                End::Root(_) => return Err(CertificateError("t is no fraction".into())),
            };
            ensure(rows.len() == piece.cuts.len(), "cuts for each coefficient in t")?;
            for (row, cuts) in rows.into_iter().zip(&piece.cuts) {
                boxes += row.nowhere_negative(cuts, self.dimension)?;
            }
        }
        let square = |t: Rational| if self.stride == 1 { &t * &t } else { t };
        Ok(((square(begin), reached.map(square)), boxes))
    }

    /// The margin at a wave is negative at a value of `t`.
    pub(in super::super) fn grows_at(&self, wave: &TorusWave, t: &Rational) -> Read<()> {
        let negative = bernstein(&self.at(wave)?, t, t).iter().all(Signed::is_negative);
        ensure(negative, "the wave does not grow")
    }

    /// The margin at a wave is negative between two values of `t`.
    pub(in super::super) fn grows_between(
        &self,
        wave: &TorusWave,
        from: &Rational,
        to: &Rational,
    ) -> Read<()> {
        let signs = bernstein(&self.at(wave)?, from, to);
        ensure(
            from < to
                && !signs.iter().any(Signed::is_positive)
                && signs.iter().any(Signed::is_negative),
            "the wave does not grow throughout",
        )
    }

    /// The margin at a wave in powers of `t`, times a positive number.
    fn at(&self, wave: &TorusWave) -> Read<Vec<BigInt>> {
        let wave = &wave.wave;
        let inside = |x: &Rational| !x.is_negative() && *x <= Rational::one();
        let point: Vec<Rational> = wave.point.iter().map(|x| x.0.clone()).collect();
        let sound = point.len() == self.dimension && point.iter().all(inside);
        ensure(sound, "there is no such wave")?;
        Ok(self.on_cube(&wave.cube)?.followed(&wave.way, self.dimension)?.at_point(&point))
    }
}

/// `cos kφ = Re (cos φ/2 + i sin φ/2)^{2k}` in powers of `x = sin²(φ/2)`.
fn half_turn(k: i32) -> Vec<BigInt> {
    let k = k.unsigned_abs() as usize;
    let mut row = vec![BigInt::zero(); k + 1];
    let mut choice = BigInt::one(); // (−1)^m C(2k, 2m)
    for m in 0..=k {
        let rest = linear_power(&1.into(), &(-1).into(), k - m);
        row[m..].iter_mut().zip(rest).for_each(|(sum, value)| *sum += value * &choice);
        choice = -choice * ((2 * k - 2 * m) * (2 * k).saturating_sub(2 * m + 1))
            / ((2 * m + 1) * (2 * m + 2));
    }
    row
}

/// `(1 + x²)^n e^{ikφ} = i^{qk} (1 + ix)^{n+k} (1 − ix)^{n−k}`, real and imaginary part.
fn quarter_turn(k: i32, n: i32, quarter: u32) -> [Vec<BigInt>; 2] {
    let mut parts = [vec![BigInt::one()], vec![BigInt::zero()]];
    for sign in
        std::iter::repeat_n(1, (n + k) as usize).chain(std::iter::repeat_n(-1, (n - k) as usize))
    {
        // (a + ib)(1 ± ix) = a ∓ bx + i (b ± ax)
        let [a, b] = parts;
        let shifted = |list: &[BigInt]| times(list, &[BigInt::zero(), BigInt::from(sign)]);
        let (mut real, mut imaginary) = (shifted(&b), shifted(&a));
        real.iter_mut().for_each(|value| *value = -std::mem::take(value));
        real.iter_mut().zip(a).for_each(|(sum, value)| *sum += value);
        imaginary.iter_mut().zip(b).for_each(|(sum, value)| *sum += value);
        parts = [real, imaginary];
    }
    for _ in 0..(quarter as i32 * k).rem_euclid(4) {
        let [a, b] = parts;
        parts = [b.into_iter().map(|value| -value).collect(), a];
    }
    parts
}
