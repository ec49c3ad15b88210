//! From the syntax tree to linear equations on the lattice.

use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::laurent::{Laurent, Variable};
use crate::exact::rational::{Rational, square_root_enclosure};
use crate::scheme::kernel_function::{KernelFunction, KernelLattice};
use crate::scheme::language::syntax::{Equations, Expression, Node, Offset, Span, Weight};
use crate::scheme::language::{LanguageError, error};
use crate::scheme::names::{Fraction, LetterKind, Names, TooManyNames};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Bits of the enclosure of an irrational number.
const CONSTANT_BITS: u32 = 256;

/// A value of an unknown: where it stands, with doubled offsets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Place {
    pub(crate) unknown: usize,
    pub(crate) time: Option<Offset>,
    pub(crate) space: [Offset; 3],
    pub(crate) derivative: bool,
}

/// `Σ coefficient · value` = 0.
#[derive(Debug, Clone)]
pub(crate) struct LinearEquation {
    pub(crate) terms: Vec<(Place, Fraction)>,
    pub(crate) span: Span,
}

/// Linear equations with constant coefficients, as they were typed.
#[derive(Debug, Clone)]
pub(crate) struct LinearEquations {
    pub(crate) text: String,
    pub(crate) unknowns: Vec<String>,
    pub(crate) dimension: usize,
    pub(crate) names: Names,
    pub(crate) equations: Vec<LinearEquation>,
}

/// A coefficient inside a sum: fractions times functions of the running index; `None` for 1.
type Scalar = Vec<(Fraction, Option<KernelFunction>)>;

/// What an expression evaluates to.
enum Value {
    Scalar(Scalar),
    Linear(Vec<(Place, Scalar)>),
}

impl LinearEquations {
    /// Reads the tree; `lattice` serves the weights of kernel sums.
    pub(crate) fn new(
        tree: &Equations,
        lattice: Option<&KernelLattice>,
    ) -> Result<Self, LanguageError> {
        let mut reader = Reader::new(&tree.text, lattice);
        let mut equations = Vec::new();
        for equation in &tree.equations {
            let left = reader.value(&equation.left, None)?;
            let right = reader.value(&equation.right, None)?;
            let difference = add(left, negated(right));
            let span = equation.span.clone();
            let Value::Linear(terms) = difference else {
                return Err(reader.error("an equation without an unknown", &span));
            };
            let mut merged: Vec<(Place, Fraction)> = Vec::new();
            for (place, scalar) in terms {
                let fraction = single(scalar);
                match merged.iter_mut().find(|(known, _)| *known == place) {
                    Some((_, sum)) => *sum = sum.plus(&fraction),
                    None => merged.push((place, fraction)),
                }
            }
            merged.retain(|(_, fraction)| !fraction.is_zero());
            equations.push(LinearEquation { terms: merged, span });
        }
        let read = Self {
            text: tree.text.clone(),
            unknowns: reader.unknowns,
            dimension: reader.dimension,
            names: reader.names,
            equations,
        };
        read.is_square()?;
        Ok(read)
    }

    fn is_square(&self) -> Result<(), LanguageError> {
        if self.equations.len() != self.unknowns.len() {
            let message = format!(
                "{} equation{} for {} unknown{} ({}): there must be as many",
                self.equations.len(),
                if self.equations.len() == 1 { "" } else { "s" },
                self.unknowns.len(),
                if self.unknowns.len() == 1 { "" } else { "s" },
                self.unknowns.join(", "),
            );
            return Err(LanguageError::new(message, &self.text, 0..self.text.len()));
        }
        Ok(())
    }

    /// A problem with an equation.
    pub(crate) fn error(&self, message: impl Into<String>, equation: usize) -> LanguageError {
        let span = self.equations.get(equation).map_or(0..self.text.len(), |e| e.span.clone());
        LanguageError::new(message, &self.text, span)
    }
}

/// An exact constant expression such as `sqrt(3)/6`, with its letters put among `names`.
pub(crate) fn constant(
    expression: &Expression,
    text: &str,
    names: &mut Names,
) -> Result<Fraction, LanguageError> {
    let mut reader = Reader::new(text, None);
    reader.names = std::mem::take(names);
    let value = reader.value(expression, None);
    *names = reader.names;
    match value? {
        Value::Scalar(scalar) => Ok(single(scalar)),
        Value::Linear(_) => {
            Err(LanguageError::new("a number is wanted", text, expression.span.clone()))
        }
    }
}

struct Reader<'a> {
    text: &'a str,
    lattice: Option<&'a KernelLattice>,
    unknowns: Vec<String>,
    dimension: usize,
    lines: Option<bool>,
    names: Names,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str, lattice: Option<&'a KernelLattice>) -> Self {
        let names = Names::default();
        Self { text, lattice, unknowns: Vec::new(), dimension: 0, lines: None, names }
    }

    fn error(&self, message: impl Into<String>, span: &Span) -> LanguageError {
        LanguageError::new(message, self.text, span.clone())
    }

    fn value(
        &mut self,
        expression: &Expression,
        index: Option<&str>,
    ) -> Result<Value, error::LanguageError> {
        let span = &expression.span;
        let too_many = |TooManyNames: TooManyNames| {
            LanguageError::new(TooManyNames.to_string(), self.text, span.clone())
        };
        match &expression.node {
            Node::Number(value) => Ok(number(Fraction::number(value))),
            Node::Pi => {
                let value = pi_enclosure();
                let variable = self
                    .names
                    .insert_letter(LetterKind::Constant, value, None, |_| "pi".into())
                    .map_err(too_many)?;
                Ok(number(Fraction::variable(variable)))
            }
            Node::SquareRoot(argument) => {
                let Value::Scalar(scalar) = self.value(argument, index)? else {
                    return Err(self.error("the root of an unknown is not linear", span));
                };
                let square = single(scalar).as_number().filter(|value| !value.is_negative());
                let Some(square) = square else {
                    return Err(self.error("sqrt takes a fraction that is not negative", span));
                };
                self.square_root(&square, span)
            }
            Node::Name(name) => self.name(name, index, span),
            Node::Unknown(unknown) => {
                if unknown.time.is_some() == self.lines.unwrap_or(unknown.time.is_none()) {
                    return Err(self.error(
                        "values with a time level and values without one do not mix: write u[n,j] everywhere, or u[j] and u[j]' everywhere",
                        span,
                    ));
                }
                self.lines = Some(unknown.time.is_none());
                if self.dimension != 0 && self.dimension != unknown.space.len() {
                    return Err(self.error(
                        format!(
                            "{} has {} space indices, the others {}",
                            unknown.name,
                            unknown.space.len(),
                            self.dimension
                        ),
                        span,
                    ));
                }
                self.dimension = unknown.space.len();
                let number = match self.unknowns.iter().position(|known| *known == unknown.name) {
                    Some(number) => number,
                    None => {
                        self.unknowns.push(unknown.name.clone());
                        self.unknowns.len() - 1
                    }
                };
                let mut space = [Offset::default(); 3];
                space[..unknown.space.len()].copy_from_slice(&unknown.space);
                let place = Place {
                    unknown: number,
                    time: unknown.time,
                    space,
                    derivative: unknown.derivative,
                };
                Ok(Value::Linear(vec![(place, vec![(Fraction::number(&Rational::one()), None)])]))
            }
            Node::Weight { weight, offset } => self.weight(*weight, *offset, index, span),
            Node::Sum { index: own, body } => {
                let value = self.value(body, Some(own))?;
                self.sum(value, span)
            }
            Node::Negative(argument) => Ok(negated(self.value(argument, index)?)),
            Node::Add(left, right) => {
                let (a, b) = (self.value(left, index)?, self.value(right, index)?);
                self.addable(&a, &b, span)?;
                Ok(add(a, b))
            }
            Node::Subtract(left, right) => {
                let (a, b) = (self.value(left, index)?, self.value(right, index)?);
                self.addable(&a, &b, span)?;
                Ok(add(a, negated(b)))
            }
            Node::Multiply(left, right) => {
                let (a, b) = (self.value(left, index)?, self.value(right, index)?);
                match (a, b) {
                    (Value::Scalar(a), Value::Scalar(b)) => Ok(Value::Scalar(times(&a, &b))),
                    (Value::Scalar(factor), Value::Linear(terms))
                    | (Value::Linear(terms), Value::Scalar(factor)) => Ok(scaled(terms, &factor)),
                    (Value::Linear(_), Value::Linear(_)) => {
                        Err(self.error("not linear: a product of unknowns", span))
                    }
                }
            }
            Node::Divide(left, right) => {
                let (a, b) = (self.value(left, index)?, self.value(right, index)?);
                let Value::Scalar(divisor) = b else {
                    return Err(self.error("not linear: a quotient by an unknown", span));
                };
                let reciprocal = self.reciprocal(divisor, &right.span)?;
                match a {
                    Value::Scalar(a) => Ok(Value::Scalar(times(&a, &reciprocal))),
                    Value::Linear(terms) => Ok(scaled(terms, &reciprocal)),
                }
            }
            Node::Power(base, exponent) => {
                let value = self.value(base, index)?;
                let Value::Scalar(scalar) = value else {
                    return match exponent {
                        1 => Ok(value),
                        _ => Err(self.error("not linear: a power of an unknown", span)),
                    };
                };
                let base = if *exponent < 0 { self.reciprocal(scalar, span)? } else { scalar };
                let one = vec![(Fraction::number(&Rational::one()), None)];
                let power =
                    (0..exponent.unsigned_abs()).fold(one, |product, _| times(&product, &base));
                Ok(Value::Scalar(power))
            }
        }
    }

    fn addable(&self, left: &Value, right: &Value, span: &Span) -> Result<(), LanguageError> {
        let is_zero =
            |value: &Value| matches!(value, Value::Scalar(s) if s.iter().all(|(f, _)| f.is_zero()));
        match (left, right) {
            (Value::Scalar(_), Value::Linear(_)) if !is_zero(left) => {
                Err(self.error("not linear: a number is added to unknowns", span))
            }
            (Value::Linear(_), Value::Scalar(_)) if !is_zero(right) => {
                Err(self.error("not linear: a number is added to unknowns", span))
            }
            _ => Ok(()),
        }
    }

    fn name(
        &mut self,
        name: &str,
        index: Option<&str>,
        span: &Span,
    ) -> Result<Value, LanguageError> {
        if index == Some(name) {
            let lattice = self.lattice(span)?;
            let function = KernelFunction::index(lattice.reach());
            return Ok(Value::Scalar(vec![(Fraction::number(&Rational::one()), Some(function))]));
        }
        if let ("ratio", Some(lattice)) = (name, self.lattice) {
            return Ok(number(Fraction::number(&lattice.ratio)));
        }
        if let ("rho", Some(lattice)) = (name, self.lattice) {
            let density = lattice.density();
            return self.enclosed(density.center, density.radius, "rho", span);
        }
        let variable = self
            .names
            .insert_parameter(name)
            .map_err(|problem| LanguageError::new(problem.to_string(), self.text, span.clone()))?;
        Ok(number(Fraction::variable(variable)))
    }

    fn lattice(&self, span: &Span) -> Result<&'a KernelLattice, LanguageError> {
        let missing = "kernel sums need a kernel and its ratio: give --kernel and --ratio";
        self.lattice.ok_or_else(|| self.error(missing, span))
    }

    fn weight(
        &mut self,
        weight: Weight,
        offset: Offset,
        index: Option<&str>,
        span: &Span,
    ) -> Result<Value, LanguageError> {
        let lattice = self.lattice(span)?;
        let unknown = "this kernel is given by its derivatives only: W is not known";
        if offset.halves % 2 != 0 {
            return Err(self.error("a lattice weight has a whole offset", span));
        }
        match (offset.index, index) {
            (0, _) => {
                let place = (offset.halves / 2).unsigned_abs() as usize;
                let (value, radius) =
                    lattice.weight(weight, place).ok_or_else(|| self.error(unknown, span))?;
                let kind = match weight {
                    Weight::Value => "W",
                    Weight::Slope => "w",
                    Weight::Curvature => "v",
                };
                self.enclosed(value, radius, &format!("{kind}{place}"), span)
            }
            (1, Some(_)) if offset.halves == 0 => {
                let function = KernelFunction::weight(lattice, weight)
                    .ok_or_else(|| self.error(unknown, span))?;
                Ok(Value::Scalar(vec![(Fraction::number(&Rational::one()), Some(function))]))
            }
            _ => Err(self.error("inside a sum over k a weight is written w[k]", span)),
        }
    }

    /// A number within a radius: a letter, unless it is exact.
    fn enclosed(
        &mut self,
        value: Rational,
        radius: Rational,
        name: &str,
        span: &Span,
    ) -> Result<Value, LanguageError> {
        if radius.is_zero() {
            return Ok(number(Fraction::number(&value)));
        }
        let series = EnclosedSeries::new(&[value], radius);
        self.letter(LetterKind::Constant, series, None, name, span)
            .map(|variable| number(Fraction::variable(variable)))
    }

    /// `Σ_k f(k)`: a letter, unless it is exact.
    fn total(&mut self, function: &KernelFunction, span: &Span) -> Result<Scalar, LanguageError> {
        let (sum, radius) = function.sum();
        if radius.is_zero() {
            return Ok(vec![(Fraction::number(&sum), None)]);
        }
        let series = EnclosedSeries::new(&[sum], radius);
        let of = Some(function.clone());
        let variable = self.letter(LetterKind::Constant, series, of, "s", span)?;
        Ok(vec![(Fraction::variable(variable), None)])
    }

    fn letter(
        &mut self,
        kind: LetterKind,
        value: EnclosedSeries,
        of: Option<KernelFunction>,
        name: &str,
        span: &Span,
    ) -> Result<Variable, LanguageError> {
        self.names
            .insert_letter(kind, value, of, |number| match number {
                0 => name.to_string(),
                _ => format!("{name}_{number}"),
            })
            .map_err(|problem| self.error(problem.to_string(), span))
    }

    fn square_root(&mut self, square: &Rational, span: &Span) -> Result<Value, LanguageError> {
        let root = |value: &BigInt| {
            let root = value.sqrt();
            (&root * &root == *value).then_some(root)
        };
        if let (Some(numerator), Some(denominator)) = (root(square.numer()), root(square.denom())) {
            return Ok(number(Fraction::number(&Rational::new(numerator, denominator))));
        }
        let (lower, upper) = square_root_enclosure(square, square, CONSTANT_BITS);
        let two = Rational::from(BigInt::from(2));
        let series = EnclosedSeries::new(&[(&lower + &upper) / &two], (upper - lower) / two);
        let kind = LetterKind::SquareRoot(square.clone());
        let name = format!("sqrt({})", crate::exact::rational::to_text(square));
        self.letter(kind, series, None, &name, span).map(|v| number(Fraction::variable(v)))
    }

    /// `1/scalar`; of a number with a radius, a new letter.
    fn reciprocal(&mut self, scalar: Scalar, span: &Span) -> Result<Scalar, LanguageError> {
        let zero = "a quotient by zero";
        if let [(fraction, Some(function))] = scalar.as_slice() {
            let (function, whole) = (function.reciprocal(), fraction.as_number());
            return match (function, whole) {
                (Some(function), Some(whole)) if !whole.is_zero() => {
                    Ok(vec![(Fraction::number(&whole.recip()), Some(function))])
                }
                _ => {
                    Err(self
                        .error("inside a sum only a quotient by k or a number is understood", span))
                }
            };
        }
        if scalar.iter().any(|(_, function)| function.is_some()) {
            return Err(
                self.error("inside a sum only a quotient by k or a number is understood", span)
            );
        }
        let divisor = single(scalar);
        if divisor.is_zero() {
            return Err(self.error(zero, span));
        }
        let letters: Vec<Variable> = self.names.letters().map(|(variable, _)| variable).collect();
        let occurs = |variable: &Variable| {
            divisor.numerator.contains(*variable) || divisor.denominator.contains(*variable)
        };
        let parameters = self.names.parameters().any(|(_, variable)| occurs(&variable));
        if parameters || !letters.iter().any(occurs) {
            return Ok(vec![(Fraction::number(&Rational::one()).over(&divisor), None)]);
        }
        let (center, radius) = self.ball(&divisor.numerator);
        let (below, below_radius) = self.ball(&divisor.denominator);
        if center.abs() <= radius || below.abs() <= below_radius {
            return Err(self.error(zero, span));
        }
        // |b/a − b₀/a₀| ≤ (|b₀| r_a + |a₀| r_b)/(|a₀| (|a₀| − r_a)).
        let value = &below / &center;
        let spread = (below.abs() * &radius + center.abs() * &below_radius)
            / (center.abs() * (center.abs() - &radius));
        // A long fraction is cut: products of it would be longer still.
        let unit = Rational::from(BigInt::one() << CONSTANT_BITS);
        let cut = (&value * &unit).floor() / &unit;
        let value = self.enclosed(cut, spread + unit.recip(), "q", span)?;
        match value {
            Value::Scalar(scalar) => Ok(scalar),
            Value::Linear(_) => Err(self.error(zero, span)),
        }
    }

    /// A polynomial in constant letters as a number within a radius.
    fn ball(&self, polynomial: &Laurent) -> (Rational, Rational) {
        let mut sum = EnclosedSeries::constant(Rational::zero());
        for (exponents, value) in polynomial.terms() {
            let mut term = EnclosedSeries::constant(Rational::from(value.clone()));
            for (place, power) in self.names.letters_at(exponents) {
                let letter = self.names.letters().find(|(v, _)| v.0 == place).map(|(_, l)| l);
                for _ in 0..power {
                    term = term.times(&letter.expect("a letter that occurs").value);
                }
            }
            sum = sum.plus(&term);
        }
        (sum.center().at_zero(), sum.radius().clone())
    }

    /// Adds up over the running index: `E^{±k} = Σ… = Σ f − s V ± (E − 1/E)/2 S`.
    fn sum(&mut self, value: Value, span: &Span) -> Result<Value, LanguageError> {
        let lattice = self.lattice(span)?;
        let reach = lattice.reach();
        let terms = match value {
            Value::Scalar(scalar) => {
                let mut total: Scalar = Vec::new();
                for (fraction, function) in scalar {
                    let function = function.unwrap_or_else(|| KernelFunction::one(reach));
                    let sum = self.total(&function, span)?;
                    total = plus(total, times(&vec![(fraction, None)], &sum));
                }
                return Ok(Value::Scalar(total));
            }
            Value::Linear(terms) => terms,
        };
        // What belongs together, as in 2 x[j] - x[j+k] - x[j-k], is added up before letters are made: what cancels needs none.
        let mut shares: Vec<(Place, [Scalar; 3])> = Vec::new();
        for (place, scalar) in terms {
            let multiple = place.space[0].index;
            let mut base = place;
            base.space.iter_mut().for_each(|offset| offset.index = 0);
            let in_time = place.time.is_some_and(|time| time.index != 0);
            if multiple.abs() > 1 || place.space[1..].iter().any(|o| o.index != 0) || in_time {
                return Err(self.error("inside a sum over k an unknown stands at j+k or j-k", span));
            }
            let number = match shares.iter().position(|(known, _)| *known == base) {
                Some(number) => number,
                None => {
                    shares.push((base, Default::default()));
                    shares.len() - 1
                }
            };
            let [sums, versines, sines] = &mut shares[number].1;
            let times_index = |scalar: Scalar| if multiple < 0 { minus(scalar) } else { scalar };
            *sums = plus(std::mem::take(sums), scalar.clone());
            if multiple != 0 {
                *versines = plus(std::mem::take(versines), scalar.clone());
                *sines = plus(std::mem::take(sines), times_index(scalar));
            }
        }
        let mut result: Vec<(Place, Scalar)> = Vec::new();
        for (base, [sums, versines, sines]) in shares {
            let occurring = |scalar: Scalar| {
                let function = |function: Option<KernelFunction>| {
                    function.unwrap_or_else(|| KernelFunction::one(reach))
                };
                let kept = scalar.into_iter().filter(|(fraction, _)| !fraction.is_zero());
                kept.map(|(fraction, f)| (fraction, function(f))).collect::<Vec<_>>()
            };
            for (fraction, function) in occurring(sums) {
                let sum = self.total(&function, span)?;
                push(&mut result, base, times(&vec![(fraction, None)], &sum));
            }
            let versines = occurring(versines).into_iter().map(|(fraction, f)| {
                let shares = [(-1, (1, 4)), (0, (-1, 2)), (1, (1, 4))];
                (fraction, f.versines(), f, LetterKind::Versines, shares)
            });
            let sines = occurring(sines).into_iter().map(|(fraction, f)| {
                let shares = [(-1, (-1, 2)), (0, (0, 1)), (1, (1, 2))];
                (fraction, f.sines(), f, LetterKind::Sines, shares)
            });
            for (fraction, series, function, kind, shares) in versines.chain(sines) {
                if series.is_zero() {
                    continue;
                }
                let name = if kind == LetterKind::Versines { "V" } else { "S" };
                let variable = self.letter(kind, series, Some(function), name, span)?;
                let letter = fraction.times(&Fraction::variable(variable));
                for (step, (numerator, denominator)) in shares {
                    let share =
                        Fraction::number(&crate::exact::rational::ratio(numerator, denominator));
                    let mut moved = base;
                    moved.space[0].halves += 2 * step;
                    push(&mut result, moved, vec![(letter.times(&share), None)]);
                }
            }
        }
        result.retain(|(_, scalar)| scalar.iter().any(|(fraction, _)| !fraction.is_zero()));
        Ok(Value::Linear(result))
    }
}

fn push(terms: &mut Vec<(Place, Scalar)>, place: Place, scalar: Scalar) {
    match terms.iter_mut().find(|(known, _)| *known == place) {
        Some((_, sum)) => *sum = plus(std::mem::take(sum), scalar),
        None => terms.push((place, scalar)),
    }
}

fn number(fraction: Fraction) -> Value {
    Value::Scalar(vec![(fraction, None)])
}

/// A scalar outside a sum.
fn single(scalar: Scalar) -> Fraction {
    scalar
        .into_iter()
        .map(|(fraction, _)| fraction)
        .reduce(|sum, fraction| sum.plus(&fraction))
        .unwrap_or_else(|| Fraction::number(&Rational::zero()))
}

fn plus(mut left: Scalar, right: Scalar) -> Scalar {
    for (fraction, function) in right {
        match left.iter_mut().find(|(_, known)| *known == function) {
            Some((sum, _)) => *sum = sum.plus(&fraction),
            None => left.push((fraction, function)),
        }
    }
    left
}

fn times(left: &Scalar, right: &Scalar) -> Scalar {
    let mut product = Vec::new();
    for (a, f) in left {
        for (b, g) in right {
            let function = match (f, g) {
                (Some(f), Some(g)) => Some(f.times(g)),
                (Some(one), None) | (None, Some(one)) => Some(one.clone()),
                (None, None) => None,
            };
            product = plus(product, vec![(a.times(b), function)]);
        }
    }
    product
}

fn scaled(terms: Vec<(Place, Scalar)>, factor: &Scalar) -> Value {
    Value::Linear(terms.into_iter().map(|(place, value)| (place, times(&value, factor))).collect())
}

fn minus(scalar: Scalar) -> Scalar {
    scalar.into_iter().map(|(fraction, function)| (fraction.negated(), function)).collect()
}

fn negated(value: Value) -> Value {
    match value {
        Value::Scalar(scalar) => Value::Scalar(minus(scalar)),
        Value::Linear(terms) => {
            Value::Linear(terms.into_iter().map(|(place, scalar)| (place, minus(scalar))).collect())
        }
    }
}

/// The sum of two of a kind; a zero is of every kind.
fn add(left: Value, right: Value) -> Value {
    match (left, right) {
        (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(plus(a, b)),
        (Value::Linear(mut terms), Value::Linear(more)) => {
            for (place, scalar) in more {
                push(&mut terms, place, scalar);
            }
            Value::Linear(terms)
        }
        (Value::Scalar(_), Value::Linear(terms)) | (Value::Linear(terms), Value::Scalar(_)) => {
            Value::Linear(terms)
        }
    }
}

/// π within `2^−250`, by Machin's formula.
fn pi_enclosure() -> EnclosedSeries {
    let bits = CONSTANT_BITS;
    let one: BigInt = BigInt::one() << bits;
    let arctangent = |inverse: i64| {
        let square = BigInt::from(inverse * inverse);
        let mut power = &one / inverse;
        let mut sum = power.clone();
        let mut odd = 1;
        while !power.is_zero() {
            power /= &square;
            odd += 2;
            let term: BigInt = &power / odd;
            sum += if odd % 4 == 3 { -term } else { term };
        }
        sum
    };
    let value = BigInt::from(16) * arctangent(5) - BigInt::from(4) * arctangent(239);
    // Some hundred terms, each cut twice, times 16.
    let radius = Rational::new(BigInt::from(1 << 13), one.clone());
    EnclosedSeries::new(&[Rational::new(value, one)], radius)
}
