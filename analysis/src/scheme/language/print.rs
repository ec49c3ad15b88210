//! The syntax tree as text again, in the notation in which it is read.

use super::syntax::{Equation, Equations, Expression, Node, Offset, Unknown, Weight};
use crate::exact::rational::{Rational, to_text};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};
use std::fmt::{Display, Formatter, Result};

/// How strongly a node holds its parts together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Power,
    Atom,
}

impl Display for Equations {
    /// One equation a line.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        for (position, equation) in self.equations.iter().enumerate() {
            let separator = if position == 0 { "" } else { "\n" };
            write!(formatter, "{separator}{equation}")?;
        }
        Ok(())
    }
}

impl Display for Equation {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        write!(formatter, "{} = {}", self.left, self.right)
    }
}

impl Display for Expression {
    /// With no more brackets than reading it back needs.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        expression(formatter, self, Binding::Sum, "k")
    }
}

impl Display for Unknown {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        unknown(formatter, self, "k")
    }
}

/// `running` is the running index of the sum around.
fn expression(
    formatter: &mut Formatter<'_>,
    whole: &Expression,
    wanted: Binding,
    running: &str,
) -> Result {
    if binding(&whole.node) < wanted {
        formatter.write_str("(")?;
        node(formatter, &whole.node, running)?;
        return formatter.write_str(")");
    }
    node(formatter, &whole.node, running)
}

fn binding(node: &Node) -> Binding {
    match node {
        Node::Add(..) | Node::Subtract(..) => Binding::Sum,
        Node::Multiply(..) | Node::Divide(..) => Binding::Product,
        Node::Negative(_) => Binding::Sign,
        Node::Power(..) => Binding::Power,
        // Made by a program: read back, it is a quotient or has a sign of its own.
        Node::Number(value) if value.is_negative() || decimal(value).is_none() => Binding::Sum,
        _ => Binding::Atom,
    }
}

fn node(formatter: &mut Formatter<'_>, node: &Node, running: &str) -> Result {
    let mut infix = |left, sign, right, [at_left, at_right]: [Binding; 2]| {
        expression(formatter, left, at_left, running)?;
        formatter.write_str(sign)?;
        expression(formatter, right, at_right, running)
    };
    match node {
        Node::Add(left, right) => infix(left, " + ", right, [Binding::Sum, Binding::Product]),
        Node::Subtract(left, right) => infix(left, " - ", right, [Binding::Sum, Binding::Product]),
        Node::Multiply(left, right) => infix(left, "*", right, [Binding::Product, Binding::Sign]),
        Node::Divide(left, right) => infix(left, "/", right, [Binding::Product, Binding::Sign]),
        Node::Number(value) => {
            formatter.write_str(&decimal(value).unwrap_or_else(|| to_text(value)))
        }
        Node::Pi => formatter.write_str("pi"),
        Node::Name(name) => formatter.write_str(name),
        Node::SquareRoot(argument) => {
            formatter.write_str("sqrt(")?;
            expression(formatter, argument, Binding::Sum, running)?;
            formatter.write_str(")")
        }
        Node::Unknown(value) => unknown(formatter, value, running),
        Node::Weight { weight, offset } => {
            let name = match weight {
                Weight::Value => "W",
                Weight::Slope => "w",
                Weight::Curvature => "v",
            };
            write!(formatter, "{name}[{}]", index("", *offset, running))
        }
        Node::Sum { index, body } => {
            write!(formatter, "sum({index}, ")?;
            expression(formatter, body, Binding::Sum, index)?;
            formatter.write_str(")")
        }
        Node::Negative(argument) => {
            formatter.write_str("-")?;
            expression(formatter, argument, Binding::Sign, running)
        }
        Node::Power(base, exponent) => {
            expression(formatter, base, Binding::Atom, running)?;
            write!(formatter, "^{exponent}")
        }
    }
}

fn unknown(formatter: &mut Formatter<'_>, unknown: &Unknown, running: &str) -> Result {
    let axes: &[&str] = if unknown.space.len() == 1 { &["j"] } else { &["i", "j", "k"] };
    let time = unknown.time.map(|offset| index("n", offset, running));
    let space = unknown.space.iter().zip(axes).map(|(offset, axis)| index(axis, *offset, running));
    let all: Vec<String> = time.into_iter().chain(space).collect();
    let prime = if unknown.derivative { "'" } else { "" };
    write!(formatter, "{}[{}]{prime}", unknown.name, all.join(","))
}

/// `j+k-1/2`; without a base `k`, `2`.
fn index(base: &str, offset: Offset, running: &str) -> String {
    let multiple = match offset.index {
        0 => String::new(),
        1 => format!("+{running}"),
        -1 => format!("-{running}"),
        times => format!("{times:+}*{running}"),
    };
    let constant = match (offset.halves, offset.halves % 2) {
        (0, _) => String::new(),
        (halves, 0) => format!("{:+}", halves / 2),
        (halves, _) => format!("{halves:+}/2"),
    };
    match format!("{base}{multiple}{constant}") {
        nothing if nothing.is_empty() => "0".into(),
        text => text.strip_prefix('+').unwrap_or(&text).into(),
    }
}

/// The exact decimal of a number that is not negative; `None` where there is none of a length that can be read
/// back.
fn decimal(value: &Rational) -> Option<String> {
    if value.is_zero() {
        return Some("0".into());
    }
    // A denominator 2^a 5^b has max(a, b) decimals.
    let mut rest = value.denom().clone();
    let [twos, fives] = [2, 5].map(|prime| {
        let prime = BigInt::from(prime);
        let mut count = 0_usize;
        while rest.is_multiple_of(&prime) {
            rest /= &prime;
            count += 1;
        }
        count
    });
    if rest != BigInt::from(1) {
        return None;
    }
    let places = twos.max(fives);
    let scaled = value * Rational::from(BigInt::from(10).pow(places as u32));
    let all = scaled.numer().to_string();
    let digits = all.trim_end_matches('0');
    if digits.len() > 60 {
        return None;
    }
    // The power of ten of the first digit.
    let leading = all.len() as i64 - 1 - places as i64;
    let last = leading - (digits.len() as i64 - 1);
    Some(match (leading, last) {
        (0..=17, 0..) => format!("{digits}{}", "0".repeat(last as usize)),
        (0..=17, _) => {
            let (whole, fraction) = digits.split_at(leading as usize + 1);
            format!("{whole}.{fraction}")
        }
        (-6..=-1, -50..) => format!("0.{}{digits}", "0".repeat((-leading - 1) as usize)),
        _ => {
            let (first, others) = digits.split_at(1);
            let point = if others.is_empty() { "" } else { "." };
            format!("{first}{point}{others}e{leading}")
        }
    })
}
