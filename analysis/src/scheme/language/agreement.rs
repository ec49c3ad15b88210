//! What the equations of one text must agree on: names, the time index, the number of axes.

use super::error::Problem;
use super::syntax::{Equation, Expression, Node, Span, Unknown};
use std::collections::HashMap;

/// One reading of a name: every equation, every expression in it.
#[derive(Default)]
struct Seen<'e> {
    unknowns: Vec<(&'e Unknown, &'e Span)>,
    /// Parameters and running indices.
    names: Vec<(&'e str, &'e Span)>,
}

impl<'e> Seen<'e> {
    fn visit(&mut self, expression: &'e Expression) {
        match &expression.node {
            Node::Number(_) | Node::Pi | Node::Weight { .. } => {}
            Node::Name(name) => self.names.push((name, &expression.span)),
            Node::Unknown(unknown) => self.unknowns.push((unknown, &expression.span)),
            Node::Sum { index, body } => {
                self.names.push((index, &expression.span));
                self.visit(body);
            }
            Node::SquareRoot(argument) | Node::Negative(argument) | Node::Power(argument, _) => {
                self.visit(argument);
            }
            Node::Add(left, right)
            | Node::Subtract(left, right)
            | Node::Multiply(left, right)
            | Node::Divide(left, right) => {
                self.visit(left);
                self.visit(right);
            }
        }
    }
}

/// Checks a whole text.
pub(super) fn check(equations: &[Equation]) -> Result<(), Problem> {
    let mut seen = Seen::default();
    for equation in equations {
        let before = seen.unknowns.len();
        seen.visit(&equation.left);
        seen.visit(&equation.right);
        if seen.unknowns.len() == before {
            let message =
                "no unknown in this equation (parameters get their values elsewhere: --set C=1/2)";
            return Err(Problem::new(message, equation.span.clone()));
        }
    }
    let Some((first, _)) = seen.unknowns.first() else { return Ok(()) };
    for (unknown, span) in &seen.unknowns {
        let problem = |message: String| Err(Problem::new(message, (*span).clone()));
        if unknown.time.is_some() != first.time.is_some() {
            let [with, without] =
                if first.time.is_some() { [first, *unknown] } else { [*unknown, first] };
            return problem(format!(
                "{with} has the time index n and {without} has none; write all with it, or all without and u[j]' for the derivative"
            ));
        }
        if unknown.space.len() != first.space.len() {
            return problem(format!(
                "{} lives in {} and {} in {}; one text has one lattice",
                first.name,
                dimensions(first),
                unknown.name,
                dimensions(unknown)
            ));
        }
    }
    let unknowns: HashMap<&str, &Unknown> =
        seen.unknowns.iter().map(|(unknown, _)| (unknown.name.as_str(), *unknown)).collect();
    for (name, span) in seen.names {
        let problem = |message: String| Err(Problem::new(message, span.clone()));
        if let Some(unknown) = unknowns.get(name) {
            return problem(format!("`{name}` is an unknown and needs its index, as in {unknown}"));
        }
        if name == "k" && first.space.len() == 3 {
            return problem("k is the third axis here and no parameter or running index".into());
        }
    }
    Ok(())
}

fn dimensions(unknown: &Unknown) -> &'static str {
    match unknown.space.len() {
        1 => "one dimension",
        2 => "two dimensions",
        _ => "three dimensions",
    }
}

/// Checks a constant expression.
pub(super) fn constant(expression: &Expression) -> Result<(), Problem> {
    let refuse = |what: &str| {
        let message =
            format!("{what} in a value; write numbers and parameters, as in sqrt(3)/6 or -C*phi");
        Err(Problem::new(message, expression.span.clone()))
    };
    match &expression.node {
        Node::Unknown(_) => refuse("an unknown"),
        Node::Weight { .. } => refuse("a lattice weight"),
        Node::Sum { .. } => refuse("a sum"),
        Node::Number(_) | Node::Pi | Node::Name(_) => Ok(()),
        Node::SquareRoot(argument) | Node::Negative(argument) | Node::Power(argument, _) => {
            constant(argument)
        }
        Node::Add(left, right)
        | Node::Subtract(left, right)
        | Node::Multiply(left, right)
        | Node::Divide(left, right) => constant(left).and_then(|()| constant(right)),
    }
}
