//! From the syntax tree to linear equations on the lattice.

mod irrational;
mod kernel_sum;
mod value;

use crate::exact::rational::Rational;
use crate::scheme::kernel_function::{KernelFunction, KernelLattice};
use crate::scheme::language::LanguageError;
use crate::scheme::language::syntax::{Equations, Expression, Node, Offset, Span};
use crate::scheme::names::{Fraction, LetterKind, Names, TooManyNames};
use irrational::pi_enclosure;
use num_traits::{One, Signed};
use value::{Value, add, negated, number, scaled, single, times};

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
    ) -> Result<Value, LanguageError> {
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
}
