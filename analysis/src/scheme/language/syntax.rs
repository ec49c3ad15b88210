//! The syntax tree of a scheme as it was typed: what the analysis and the running code both read.
//!
//! Nothing here knows of `z`, `E` or a determinant. Numbers are exact.

use crate::exact::rational::Rational;
use std::ops::Range;

/// A place in the text, in bytes.
pub type Span = Range<usize>;

/// A whole text: equations in the order they were typed.
#[derive(Debug, Clone, PartialEq)]
pub struct Equations {
    /// The text they were read from.
    pub text: String,
    /// `left = right`, each.
    pub equations: Vec<Equation>,
}

/// `left = right`.
#[derive(Debug, Clone, PartialEq)]
pub struct Equation {
    /// Left of the sign of equality.
    pub left: Expression,
    /// Right of it.
    pub right: Expression,
    /// Where the equation stands.
    pub span: Span,
}

/// An expression with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    /// What it is.
    pub node: Node,
    /// Where it stands.
    pub span: Span,
}

/// What an expression is.
#[derive(Debug, Clone, PartialEq)]
pub enum Node {
    /// An integer, decimal or fraction, exact.
    Number(Rational),
    /// `pi`.
    Pi,
    /// `sqrt(argument)`; the argument must be a rational constant.
    SquareRoot(Box<Expression>),
    /// A parameter, the name `ratio`, or the running index of the [sum](Node::Sum) it stands in.
    Name(String),
    /// `u[n+1, j-1]`, `u[j]`, `u[j]'`.
    Unknown(Unknown),
    /// `W[k]`, `w[k]`, `v[k]`, `v[0]`: lattice weights of the kernel.
    Weight {
        /// Which.
        weight: Weight,
        /// The offset `k`, as a plain number or with the running index.
        offset: Offset,
    },
    /// `sum(k, body)`: over `k = 1, 2, …` as far as the kernel reaches.
    Sum {
        /// The running index.
        index: String,
        /// What is added up.
        body: Box<Expression>,
    },
    /// `-argument`.
    Negative(Box<Expression>),
    /// `left + right`.
    Add(Box<Expression>, Box<Expression>),
    /// `left - right`.
    Subtract(Box<Expression>, Box<Expression>),
    /// `left * right`.
    Multiply(Box<Expression>, Box<Expression>),
    /// `left / right`.
    Divide(Box<Expression>, Box<Expression>),
    /// `base ^ exponent` with an integer exponent.
    Power(Box<Expression>, i32),
}

/// A value of an unknown on the lattice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unknown {
    /// Its name.
    pub name: String,
    /// The time level relative to `n`; `None` in the method of lines.
    pub time: Option<Offset>,
    /// The cell relative to `j`, or `i, j`, or `i, j, k`: one offset for each axis.
    pub space: Vec<Offset>,
    /// Whether it is the time derivative, `u[j]'`.
    pub derivative: bool,
}

/// An offset in halves, and how many times the running index of a sum is added: `j+k-1/2` is `{ halves: -1, index: 1 }`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Offset {
    /// Twice the constant part.
    pub halves: i32,
    /// The multiple of the running index: usually −1, 0 or 1.
    pub index: i32,
}

/// The lattice weights of a kernel, by offset `k`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Weight {
    /// `W_k = Δξ W(kΔξ)`.
    Value,
    /// `w_k = Δξ² |W'(kΔξ)|`.
    Slope,
    /// `v_k = Δξ³ W''(kΔξ)`.
    Curvature,
}
