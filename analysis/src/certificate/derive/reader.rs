//! Trees evaluated to linear equations on the lattice.

use super::super::verify::{CertificateError, ensure};
use super::fraction::{Fraction, cleared};
use super::kernel::{Lattice, Weight};
use super::letters::{BITS, Letters, in_units, pi, root};
use super::parser::{Tree, affine, equations, whole};
use super::polynomial::{Letter, Poly, Shifts};
use crate::exact::rational::{Rational, ratio};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

type Read<T> = Result<T, CertificateError>;

/// An equation: places with polynomials of whole coefficients.
pub type PlacedRow = Vec<(Place, Poly<BigInt>)>;

/// Where a value of an unknown stands: levels and cells in halves.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    pub unknown: usize,
    pub time: Option<i32>,
    pub space: Shifts,
    pub derivative: bool,
    /// The multiple of the running index along the first axis.
    index: i32,
}

/// The values of something that depends on the running index `k = 1, 2, …`, each with its error.
type Function = Vec<Weight>;

/// Fractions by place, `None` for numbers, and function of the running index.
type Value = Vec<((Option<Place>, Option<Function>), Fraction)>;

fn number(poly: Poly<Rational>) -> Value {
    if poly.is_zero() { Vec::new() } else { vec![((None, None), Fraction::whole(poly))] }
}

fn add(value: &mut Value, more: Value) {
    for (key, fraction) in more {
        match value.iter_mut().find(|(known, _)| *known == key) {
            Some((_, sum)) => *sum = sum.plus(&fraction),
            None => value.push((key, fraction)),
        }
    }
    value.retain(|(_, fraction)| !fraction.over.is_zero());
}

fn negated(value: Value) -> Value {
    let minus = |f: Fraction| Fraction { over: f.over.negated(), under: f.under };
    value.into_iter().map(|(key, fraction)| (key, minus(fraction))).collect()
}

fn refuse<T>(message: &str) -> Read<T> {
    Err(CertificateError(message.into()))
}

/// What names mean.
pub struct Reader<'a> {
    pub names: BTreeMap<String, Poly<Rational>>,
    pub lattice: Option<&'a Lattice>,
    /// Whether sums of enclosed weights become functions of the wave, not one letter for each weight.
    pub wave: bool,
    pub unknowns: Vec<String>,
    pub letters: Letters,
    /// The number of axes, once an unknown has been read.
    pub dimension: Option<usize>,
}

impl<'a> Reader<'a> {
    pub fn new(
        names: BTreeMap<String, Poly<Rational>>,
        lattice: Option<&'a Lattice>,
        wave: bool,
    ) -> Self {
        let letters = Letters::default();
        Self { names, lattice, wave, unknowns: Vec::new(), letters, dimension: None }
    }

    fn evaluate(&mut self, tree: &Tree, index: Option<&str>) -> Read<Value> {
        match tree {
            Tree::Number(value) => Ok(number(Poly::number(value.clone()))),
            Tree::Name(name) => self.name(name, index),
            Tree::At(name, items, prime) => self.at(name, items, *prime, index),
            Tree::Sum(own, body) => {
                ensure(
                    index.is_none() && !["n", "i", "j"].contains(&own.as_str()),
                    "a sum in a sum",
                )?;
                let body = self.evaluate(body, Some(own))?;
                self.sum(body)
            }
            Tree::Root(inner) => {
                let inner = self.evaluate(inner, index)?;
                let Some(square) = constant(&inner) else { return refuse("sqrt takes a fraction") };
                ensure(!square.is_negative(), "sqrt takes a fraction that is not negative")?;
                Ok(number(root(&square)))
            }
            Tree::Negative(inner) => Ok(negated(self.evaluate(inner, index)?)),
            Tree::Infix('^', base, exponent) => {
                let mut base = self.evaluate(base, index)?;
                let exponent = affine(exponent)?;
                ensure(exponent.keys().all(String::is_empty), "an exponent is no number")?;
                let exponent = whole(&exponent.get("").cloned().unwrap_or_default(), 100)?;
                if exponent < 0 {
                    base = self.inverse(base)?;
                }
                let count = exponent.unsigned_abs();
                let most = size(&base).max(10 * reach(&base));
                ensure(most * u64::from(count) < 1_000_000, "a power is too large")?;
                (0..count).try_fold(number(Poly::one()), |power, _| product(&power, &base))
            }
            Tree::Infix(sign, left, right) => {
                let (mut left, right) = (self.evaluate(left, index)?, self.evaluate(right, index)?);
                match sign {
                    '*' => product(&left, &right),
                    '/' => product(&left, &self.inverse(right)?),
                    _ => {
                        add(&mut left, if *sign == '-' { negated(right) } else { right });
                        Ok(left)
                    }
                }
            }
        }
    }

    /// A value without unknowns.
    pub fn fraction(&mut self, tree: &Tree) -> Read<Fraction> {
        match self.evaluate(tree, None)?.as_slice() {
            [] => Ok(Fraction::whole(Poly::default())),
            [((None, None), fraction)] => Ok(fraction.clone()),
            _ => refuse("a number is expected"),
        }
    }

    fn lattice(&self) -> Read<&Lattice> {
        self.lattice.ok_or_else(|| CertificateError("kernel sums need a kernel".into()))
    }

    fn enclosed(&mut self, weight: &Weight) -> Value {
        number(self.letters.constant(&weight.0, &weight.1))
    }

    fn name(&mut self, name: &str, index: Option<&str>) -> Read<Value> {
        if index == Some(name) {
            let exactly = |k: usize| (ratio(k as i64, 1), Rational::zero());
            let function = (1..=self.lattice()?.reach()).map(exactly).collect();
            return Ok(vec![((None, Some(function)), Fraction::one())]);
        }
        match (name, self.lattice) {
            ("pi" | "π", _) => {
                let unit = Rational::new(BigInt::one(), BigInt::one() << BITS);
                let error = &unit * ratio(1 << 16, 1);
                Ok(self.enclosed(&(unit * Rational::from(pi()), error)))
            }
            ("ratio", Some(lattice)) => Ok(number(Poly::number(lattice.ratio.clone()))),
            ("rho", Some(lattice)) => Ok(self.enclosed(&lattice.rho)),
            _ => match self.names.get(name) {
                Some(poly) if !self.unknowns.iter().any(|unknown| unknown == name) => {
                    Ok(number(poly.clone()))
                }
                _ => Err(CertificateError(format!("the parameter `{name}` has no value"))),
            },
        }
    }

    fn at(&mut self, name: &str, items: &[Tree], prime: bool, index: Option<&str>) -> Read<Value> {
        let mut items = items.iter().map(affine).collect::<Read<Vec<_>>>()?;
        let kind = ["W", "w", "v"].iter().position(|weight| *weight == name);
        let on_lattice = ["n", "i", "j"].iter().any(|axis| items[0].contains_key(*axis));
        if let (Some(kind), 1, false) = (kind, items.len(), on_lattice) {
            ensure(!prime, "a weight has no time derivative")?;
            let weights = self.lattice()?.weights[kind].clone();
            let offset = &items[0];
            if offset.keys().all(String::is_empty) {
                let k = whole(&offset.get("").cloned().unwrap_or_default(), 1000)?;
                let weight = weights.get(k.unsigned_abs() as usize);
                return Ok(weight.map_or_else(Vec::new, |weight| self.enclosed(weight)));
            }
            let alone =
                offset.len() == 1 && index.and_then(|k| offset.get(k)).is_some_and(One::is_one);
            ensure(alone, "inside a sum over k a weight is written w[k]")?;
            return Ok(vec![((None, Some(weights[1..].to_vec())), Fraction::one())]);
        }
        let mut time = None;
        if items[0].contains_key("n") {
            let item = items.remove(0);
            let known = item.keys().all(|name| name.is_empty() || name == "n");
            ensure(known && item["n"].is_one() && !prime, "a time index is not understood")?;
            let halves = item.get("").cloned().unwrap_or_default() * ratio(2, 1);
            time = Some(whole(&halves, 2000)?);
        }
        let axes: &[&str] = match items.len() {
            1 => &["j"],
            2 => &["i", "j"],
            3 => &["i", "j", "k"],
            _ => return refuse("one, two or three space indices are expected"),
        };
        let same = *self.dimension.get_or_insert(axes.len()) == axes.len();
        ensure(same, "all unknowns have as many space indices")?;
        ensure(index.is_none_or(|index| !axes.contains(&index)), "a running index is an axis")?;
        let mut space = [0; 3];
        let mut multiple = Rational::zero();
        for (number, (item, axis)) in items.iter().zip(axes).enumerate() {
            let running = index.filter(|_| number == 0);
            let known = |name: &String| name.is_empty() || name == axis || running == Some(name);
            let relative = item.get(*axis).is_some_and(One::is_one);
            ensure(item.keys().all(known) && relative, "a space index is not understood")?;
            multiple += running.and_then(|k| item.get(k)).cloned().unwrap_or_default();
            let halves = item.get("").cloned().unwrap_or_default() * ratio(2, 1);
            space[number] = whole(&halves, 2000)?;
        }
        let unknown = self.unknowns.iter().position(|known| known == name).unwrap_or_else(|| {
            self.unknowns.push(name.into());
            self.unknowns.len() - 1
        });
        let place = Place { unknown, time, space, derivative: prime, index: whole(&multiple, 1)? };
        Ok(vec![((Some(place), None), Fraction::one())])
    }

    fn inverse(&mut self, value: Value) -> Read<Value> {
        let [((None, function), fraction)] = value.as_slice() else {
            return refuse("a quotient by zero, by an unknown, or by a sum inside a sum");
        };
        let turned = Fraction { over: fraction.under.clone(), under: fraction.over.clone() };
        if let Some(function) = function {
            let exact = function.iter().all(|(x, error)| !x.is_zero() && error.is_zero());
            ensure(exact, "inside a sum only a quotient by k or a number is understood")?;
            let inverse = function.iter().map(|(x, _)| (x.recip(), Rational::zero())).collect();
            return Ok(vec![((None, Some(inverse)), turned)]);
        }
        if let Some(whole) = constant(&value) {
            return Ok(number(Poly::number(whole.recip())));
        }
        let powers = || fraction.over.0.keys().chain(fraction.under.0.keys());
        let enclosed = powers()
            .flat_map(|power| &power.letters)
            .any(|(letter, _)| matches!(letter, Letter::Enclosed(_)));
        if !enclosed || powers().any(|power| power.c != 0) {
            return Ok(vec![((None, None), turned)]);
        }
        let balls = (self.letters.ball(&fraction.over), self.letters.ball(&fraction.under));
        let (Some((x, r)), Some((y, t))) = balls else {
            return refuse("a quotient by what depends on the wave");
        };
        ensure(x.abs() > r, "a quotient by what may be zero")?;
        // |y/x − y₀/x₀| ≤ (|y₀| r + |x₀| t)/(|x₀| (|x₀| − r)), and the quotient is cut.
        let unit = Rational::new(BigInt::one(), BigInt::one() << BITS);
        let error = (y.abs() * &r + x.abs() * t) / (x.abs() * (x.abs() - r)) + &unit;
        let quotient = Rational::from(in_units(&(y / x))) * unit;
        Ok(self.enclosed(&(quotient, error)))
    }

    /// Adds up over the running index.
    fn sum(&mut self, body: Value) -> Read<Value> {
        let reach = self.lattice()?.reach();
        let mut result = Vec::new();
        for ((place, function), fraction) in body {
            let function =
                function.unwrap_or_else(|| vec![(Rational::one(), Rational::zero()); reach]);
            let multiple = place.as_ref().map_or(0, |place| place.index);
            for (step, share) in self.shares(&function, multiple) {
                let moved = place.clone().map(|mut place| {
                    place.space[0] += 2 * step;
                    Place { index: 0, ..place }
                });
                let share = Fraction::whole(share).times(&fraction);
                add(&mut result, vec![((moved, None), share)]);
            }
        }
        Ok(result)
    }

    /// `Σ_k f(k) E^{mk}` by powers of `E`.
    fn shares(&mut self, function: &Function, multiple: i32) -> Vec<(i32, Poly<Rational>)> {
        let exact = function.iter().all(|(_, error)| error.is_zero());
        if multiple != 0 && (exact || !self.wave) {
            let share =
                |(k, (x, error)): (i32, &Weight)| (multiple * k, self.letters.constant(x, error));
            return (1..).zip(function).map(share).collect();
        }
        let total = |part: fn(&Weight) -> &Rational| function.iter().map(part).sum::<Rational>();
        let sum = self.letters.constant(&total(|weight| &weight.0), &total(|weight| &weight.1));
        if multiple == 0 {
            return vec![(0, sum)];
        }
        // E^{mk} = 1 − s (1 − cos kφ)/s + m (E − 1/E)/2 sin kφ/sin φ, s = (2 − E − 1/E)/4.
        let (versines, sines) = (self.letters.versines(function), self.letters.sines(function));
        let versine = |step, quarters| (step, versines.scaled(&ratio(quarters, 4)));
        let sine = |step: i32| (step * multiple, sines.scaled(&ratio(step.into(), 2)));
        vec![(0, sum), versine(-1, 1), versine(0, -2), versine(1, 1), sine(-1), sine(1)]
    }

    /// Rows of places and polynomials with whole coefficients.
    pub fn rows(&mut self, text: &str) -> Read<Vec<PlacedRow>> {
        let mut rows = Vec::new();
        for tree in equations(text)? {
            let value = self.evaluate(&tree, None)?;
            let mut places = Vec::new();
            let mut fractions = Vec::new();
            for ((place, function), fraction) in value {
                let Some(place) = place.filter(|place| place.index == 0 && function.is_none())
                else {
                    return refuse(
                        "a number is added to unknowns, or an index stands outside a sum",
                    );
                };
                places.push(place);
                fractions.push(fraction);
            }
            ensure(!places.is_empty(), "an equation says nothing")?;
            rows.push(places.into_iter().zip(cleared(&fractions)).collect());
        }
        ensure(rows.len() == self.unknowns.len(), "there must be as many equations as unknowns")?;
        Ok(rows)
    }
}

fn constant(value: &Value) -> Option<Rational> {
    match value.as_slice() {
        [] => Some(Rational::zero()),
        [((None, None), fraction)] => {
            Some(fraction.over.as_number()? / fraction.under.as_number()?)
        }
        _ => None,
    }
}

fn size(value: &Value) -> u64 {
    let polys = value.iter().flat_map(|(_, fraction)| [&fraction.over, &fraction.under]);
    polys.flat_map(|poly| poly.0.values()).map(|x| x.numer().bits() + x.denom().bits()).sum()
}

/// The largest power of `z`, of a shift or of the parameter.
fn reach(value: &Value) -> u64 {
    let polys = value.iter().flat_map(|(_, fraction)| [&fraction.over, &fraction.under]);
    let powers = polys.flat_map(|poly| poly.0.keys());
    let all = powers.flat_map(|power| [power.z, power.c].into_iter().chain(power.e));
    all.map(|power| u64::from(power.unsigned_abs())).max().unwrap_or(0)
}

fn product(left: &Value, right: &Value) -> Read<Value> {
    let mut result = Vec::new();
    for ((a, f), p) in left {
        for ((b, g), q) in right {
            ensure(a.is_none() || b.is_none(), "not linear: a product of unknowns")?;
            let function = match (f, g) {
                (Some(f), Some(g)) => Some(f.iter().zip(g).map(|(x, y)| both(x, y)).collect()),
                (one, other) => one.clone().or_else(|| other.clone()),
            };
            let place = a.clone().or_else(|| b.clone());
            add(&mut result, vec![((place, function), p.times(q))]);
        }
    }
    Ok(result)
}

/// `|ab − a₀b₀| ≤ |a₀| q + |b₀| r + q r`.
fn both((x, r): &Weight, (y, q): &Weight) -> Weight {
    (x * y, x.abs() * q + y.abs() * r + r * q)
}
