//! From the syntax tree to stencils: which values enter each equation, and with which number.

use super::SteppingError;
use super::rounded::Rounded;
use courant_analysis::exact::rational::to_f64;
use courant_analysis::scheme::KernelLattice;
use courant_analysis::scheme::language::syntax::{
    Equations, Expression, Node, Offset, Span, Unknown, Weight,
};
use std::collections::BTreeMap;

/// A value of an unknown near the cell where an equation is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place {
    pub unknown: usize,
    /// Levels after the present one; 0 in the method of lines.
    pub level: i32,
    /// Cells along each axis. What stands at half indices is stored at the cell before them.
    pub offset: [i32; 3],
    /// Whether it is the time derivative.
    pub derivative: bool,
}

/// `Σ coefficient · value = 0` for each equation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LinearForms {
    pub unknowns: Vec<String>,
    /// How many space indices the unknowns have.
    pub dimension: usize,
    /// Whether the equations are for `u[j]'`.
    pub of_lines: bool,
    pub equations: Vec<BTreeMap<Place, Rounded>>,
}

/// `constant + Σ coefficient · value`.
#[derive(Debug, Clone, Default)]
struct Affine {
    constant: Rounded,
    terms: BTreeMap<Place, Rounded>,
}

impl LinearForms {
    pub fn new(
        tree: &Equations,
        lattice: Option<&KernelLattice>,
        parameters: &[(String, f64)],
    ) -> Result<Self, SteppingError> {
        let unknowns = Vec::new();
        let mut reader =
            Reader { tree, lattice, parameters, unknowns, dimension: 0, of_lines: false };
        let mut equations = Vec::new();
        for equation in &tree.equations {
            let left = reader.value(&equation.left, None)?;
            let right = reader.value(&equation.right, None)?;
            let mut difference = left.plus(right.times(Rounded::exact(-1.0)));
            if !difference.constant.vanishes() {
                return Err(reader.refuse("a number is added to unknowns", &equation.span));
            }
            difference.terms.retain(|_, coefficient| !coefficient.vanishes());
            if difference.terms.values().any(|coefficient| !coefficient.value.is_finite()) {
                return Err(reader.refuse("a coefficient is no finite number", &equation.span));
            }
            equations.push(difference.terms);
        }
        Ok(Self {
            unknowns: reader.unknowns.into_iter().map(|known| known.name).collect(),
            dimension: reader.dimension,
            of_lines: reader.of_lines,
            equations,
        })
    }
}

/// An unknown and where its values are stored: at whole or at half indices.
struct Known {
    name: String,
    half_level: i32,
    half_cell: [i32; 3],
}

struct Reader<'a> {
    tree: &'a Equations,
    lattice: Option<&'a KernelLattice>,
    parameters: &'a [(String, f64)],
    unknowns: Vec<Known>,
    dimension: usize,
    of_lines: bool,
}

impl Reader<'_> {
    fn refuse(&self, problem: &str, span: &Span) -> SteppingError {
        let text = self.tree.text.get(span.clone()).unwrap_or_default();
        SteppingError::NotUnderstood { problem: problem.into(), place: text.into() }
    }

    /// The value of an expression; inside a sum the running index has a value.
    fn value(
        &mut self,
        expression: &Expression,
        index: Option<(&str, i32)>,
    ) -> Result<Affine, SteppingError> {
        let span = &expression.span;
        Ok(match &expression.node {
            Node::Number(number) => Affine::number(Rounded::nearest(to_f64(number))),
            Node::Pi => Affine::number(Rounded::nearest(std::f64::consts::PI)),
            Node::SquareRoot(argument) => {
                let argument = self.number(argument, index)?;
                if argument.value < 0.0 {
                    return Err(self.refuse("the root of a negative number", span));
                }
                Affine::number(argument.sqrt())
            }
            Node::Name(name) => Affine::number(self.name(name, index, span)?),
            Node::Unknown(unknown) => self.unknown(unknown, index, span)?,
            Node::Weight { weight, offset } => {
                Affine::number(self.weight(*weight, *offset, index, span)?)
            }
            Node::Sum { index: own, body } => {
                let reach = self.lattice(span)?.reach() as i32;
                let mut sum = Affine::default();
                for k in 1..=reach {
                    sum = sum.plus(self.value(body, Some((own, k)))?);
                }
                sum
            }
            Node::Negative(argument) => self.value(argument, index)?.times(Rounded::exact(-1.0)),
            Node::Add(a, b) => self.value(a, index)?.plus(self.value(b, index)?),
            Node::Subtract(a, b) => {
                let subtrahend = self.value(b, index)?.times(Rounded::exact(-1.0));
                self.value(a, index)?.plus(subtrahend)
            }
            Node::Multiply(a, b) => {
                let (a, b) = (self.value(a, index)?, self.value(b, index)?);
                match (a.terms.is_empty(), b.terms.is_empty()) {
                    (_, true) => a.times(b.constant),
                    (true, _) => b.times(a.constant),
                    _ => return Err(self.refuse("a product of unknowns", span)),
                }
            }
            Node::Divide(a, b) => {
                let divisor = self.number(b, index)?;
                if divisor.vanishes() {
                    return Err(self.refuse("a quotient by zero", span));
                }
                let mut quotient = self.value(a, index)?;
                quotient.constant = quotient.constant / divisor;
                quotient.terms.values_mut().for_each(|value| *value = *value / divisor);
                quotient
            }
            Node::Power(base, 1) => self.value(base, index)?,
            Node::Power(base, exponent) => {
                let base = self.number(base, index)?;
                if *exponent < 0 && base.vanishes() {
                    return Err(self.refuse("a quotient by zero", span));
                }
                Affine::number(base.power(*exponent))
            }
        })
    }

    fn number(
        &mut self,
        expression: &Expression,
        index: Option<(&str, i32)>,
    ) -> Result<Rounded, SteppingError> {
        let value = self.value(expression, index)?;
        if value.terms.is_empty() {
            return Ok(value.constant);
        }
        Err(self.refuse("not linear in the unknowns", &expression.span))
    }

    fn name(
        &self,
        name: &str,
        index: Option<(&str, i32)>,
        span: &Span,
    ) -> Result<Rounded, SteppingError> {
        if let Some((_, k)) = index.filter(|(own, _)| *own == name) {
            return Ok(Rounded::exact(f64::from(k)));
        }
        match (name, self.lattice) {
            ("ratio", Some(lattice)) => return Ok(Rounded::nearest(to_f64(&lattice.ratio))),
            ("rho", Some(lattice)) => {
                return Ok(Rounded::nearest(to_f64(&lattice.density().center)));
            }
            _ => {}
        }
        let given = self.parameters.iter().find(|(known, _)| known == name);
        let (_, value) = given.ok_or_else(|| SteppingError::NotSet(name.into()))?;
        if !value.is_finite() {
            return Err(self.refuse("a parameter is no finite number", span));
        }
        Ok(Rounded::nearest(*value))
    }

    fn lattice(&self, span: &Span) -> Result<&KernelLattice, SteppingError> {
        self.lattice.ok_or_else(|| self.refuse("kernel sums need a kernel and its ratio", span))
    }

    fn weight(
        &self,
        weight: Weight,
        offset: Offset,
        index: Option<(&str, i32)>,
        span: &Span,
    ) -> Result<Rounded, SteppingError> {
        let halves = halves(offset, index);
        if halves % 2 != 0 {
            return Err(self.refuse("a lattice weight has a whole offset", span));
        }
        let place = (halves / 2).unsigned_abs() as usize;
        let known = self.lattice(span)?.weight(weight, place);
        let (value, _) =
            known.ok_or_else(|| self.refuse("the values of this kernel are not known", span))?;
        Ok(Rounded::nearest(to_f64(&value)))
    }

    fn unknown(
        &mut self,
        unknown: &Unknown,
        index: Option<(&str, i32)>,
        span: &Span,
    ) -> Result<Affine, SteppingError> {
        // The same for all of a text that was parsed.
        self.dimension = unknown.space.len();
        let mut cell = [0; 3];
        for (cell, offset) in cell.iter_mut().zip(&unknown.space) {
            *cell = halves(*offset, index);
        }
        let level = unknown.time.map_or(0, |time| halves(time, index));
        let (half_level, half_cell) =
            (level.rem_euclid(2), cell.map(|halves| halves.rem_euclid(2)));
        let number = match self.unknowns.iter().position(|known| known.name == unknown.name) {
            Some(number) => number,
            None => {
                let name = unknown.name.clone();
                self.unknowns.push(Known { name, half_level, half_cell });
                self.unknowns.len() - 1
            }
        };
        let known = &self.unknowns[number];
        if (known.half_level, known.half_cell) != (half_level, half_cell) {
            return Err(self.refuse("an unknown at whole and at half indices", span));
        }
        self.of_lines |= unknown.time.is_none();
        let place = Place {
            unknown: number,
            level: (level - half_level) / 2,
            offset: cell.map(|halves| halves.div_euclid(2)),
            derivative: unknown.derivative,
        };
        Ok(Affine { terms: [(place, Rounded::exact(1.0))].into(), ..Affine::default() })
    }
}

/// Twice an offset, with the running index put in.
fn halves(offset: Offset, index: Option<(&str, i32)>) -> i32 {
    offset.halves + 2 * offset.index * index.map_or(0, |(_, k)| k)
}

impl Affine {
    fn number(constant: Rounded) -> Self {
        Self { constant, ..Self::default() }
    }

    fn plus(mut self, other: Self) -> Self {
        self.constant = self.constant + other.constant;
        for (place, value) in other.terms {
            self.terms.entry(place).and_modify(|sum| *sum = *sum + value).or_insert(value);
        }
        self
    }

    fn times(mut self, factor: Rounded) -> Self {
        self.constant = self.constant * factor;
        self.terms.values_mut().for_each(|value| *value = *value * factor);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::scheme::language::parse;

    fn forms(text: &str, parameters: &[(&str, f64)]) -> Result<LinearForms, SteppingError> {
        let parameters: Vec<_> = parameters.iter().map(|(n, v)| (n.to_string(), *v)).collect();
        LinearForms::new(&parse(text).unwrap(), None, &parameters)
    }

    #[test]
    fn coefficients_that_cancel_are_left_out() {
        let text = "u[n+1,j] = u[n,j] - C*u[n,j] - C*u[n,j] + (3*C - 0.3)*u[n,j+1]";
        let read = forms(text, &[("C", 0.1)]).unwrap();
        assert_eq!(read.equations[0].len(), 2);
    }

    #[test]
    fn what_is_no_scheme_is_refused_with_its_reason() {
        let problem = |text: &str| forms(text, &[("C", 1.0)]).unwrap_err().to_string();
        assert!(problem("u[n+1,j] = u[n,j]*u[n,j]").contains("product of unknowns"));
        assert!(problem("u[n+1,j] = u[n,j] + 1").contains("number is added"));
        assert!(problem("u[n+1,j] = u[n,j]/(C - 1)").contains("quotient by zero"));
        assert!(problem("u[n+1,j] = D*u[n,j]").contains("`D`"));
        assert!(problem("u[n+1,j] = u[n,j+1/2]").contains("half"));
        assert!(problem("u[n+1,j] = w[1]*u[n,j]").contains("kernel"));
    }
}
