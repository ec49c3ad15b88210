//! Formulas: operators and their precedence, functions, names with and without an index.

use super::affine::{Affine, whole};
use super::error::Problem;
use super::index::Bracketed;
use super::syntax::{Expression, Node, Span};
use super::tokens::{Kind, Token};
use winnow::combinator::{Infix, dispatch, expression as operators, fail};
use winnow::prelude::*;
use winnow::stream::{Stateful, Stream, TokenSlice};
use winnow::token::any;

/// Trees are not higher, so that everybody may walk them by recursion.
const HIGHEST_TREE: usize = 1000;

/// No exponent, and no product of nested exponents, is larger.
const LARGEST_EXPONENT: i32 = 100;

/// What the grammar knows beside the tokens.
#[derive(Debug, Clone, Default)]
pub(super) struct State<'t> {
    /// The running index of the sum around.
    running: Option<&'t str>,
    /// Whether it is between `[` and `]`, where `n`, `i`, `j` are indices.
    in_index: bool,
}

pub(super) type Input<'a, 't> = Stateful<TokenSlice<'a, Token<'t>>, State<'t>>;
pub(super) type Parsed<T> = ModalResult<T, Problem>;

/// Whether the next token is of some kind.
pub(super) fn next_is<'t>(input: &Input<'_, 't>, accepted: impl Fn(&Kind<'t>) -> bool) -> bool {
    input.peek_token().is_some_and(|token| accepted(&token.kind))
}

/// An expression with what is kept in bounds while it is put together.
struct Operand {
    expression: Expression,
    /// Levels of the tree.
    height: usize,
    /// The largest product of nested exponents.
    exponent: i32,
}

impl Operand {
    fn leaf(node: Node, span: Span) -> Self {
        Self { expression: Expression { node, span }, height: 1, exponent: 1 }
    }

    /// One level more.
    fn wrap(self, span: Span, node: impl FnOnce(Box<Expression>) -> Node) -> Parsed<Self> {
        let Self { expression, height, exponent } = self;
        let expression = Expression { node: node(Box::new(expression)), span };
        Self { expression, height: height + 1, exponent }.bounded()
    }

    fn join(
        self,
        right: Self,
        node: impl FnOnce(Box<Expression>, Box<Expression>) -> Node,
    ) -> Parsed<Self> {
        let span = self.expression.span.start..right.expression.span.end;
        let node = node(Box::new(self.expression), Box::new(right.expression));
        let height = self.height.max(right.height) + 1;
        let exponent = self.exponent.max(right.exponent);
        Self { expression: Expression { node, span }, height, exponent }.bounded()
    }

    fn bounded(self) -> Parsed<Self> {
        if self.height <= HIGHEST_TREE {
            return Ok(self);
        }
        let message = format!(
            "more than {HIGHEST_TREE} operations one upon the other; name a part by an equation of its own"
        );
        Err(Problem::new(message, self.expression.span).cut())
    }
}

/// An expression, as far as it goes.
pub(super) fn expression(input: &mut Input<'_, '_>) -> Parsed<Expression> {
    operation(input).map(|operand| operand.expression)
}

/// Sums of products of signed powers.
fn operation<'a, 't>(input: &mut Input<'a, 't>) -> Parsed<Operand> {
    let (sum, product) = (1, 2);
    operators(signed)
        .infix(dispatch! { any.map(|token: &'a Token<'t>| &token.kind);
            Kind::Plus => Infix::Left(sum, |_, left: Operand, right| left.join(right, Node::Add)),
            Kind::Minus => Infix::Left(sum, |_, left: Operand, right| left.join(right, Node::Subtract)),
            Kind::Times => Infix::Left(product, |_, left: Operand, right| left.join(right, Node::Multiply)),
            Kind::Over => Infix::Left(product, |_, left: Operand, right| left.join(right, Node::Divide)),
            _ => fail,
        })
        .parse_next(input)
}

/// `-a^2` is `-(a^2)`, `-a*b` is `(-a)*b`.
fn signed(input: &mut Input<'_, '_>) -> Parsed<Operand> {
    let minus = signs(input);
    let operand = power(input)?;
    minus.into_iter().rev().try_fold(operand, |operand, start| {
        let span = start..operand.expression.span.end;
        operand.wrap(span, Node::Negative)
    })
}

/// Where the minus signs of a row of signs stand.
fn signs(input: &mut Input<'_, '_>) -> Vec<usize> {
    let mut minus = Vec::new();
    while let Some(token) = input.peek_token() {
        match token.kind {
            Kind::Minus => minus.push(token.span.start),
            Kind::Plus => {}
            _ => break,
        }
        input.next_token();
    }
    minus
}

/// `base ^ exponent`; a tower counts from the right: `2^3^2` is `2^9`.
fn power(input: &mut Input<'_, '_>) -> Parsed<Operand> {
    let base = atom(input)?;
    let mut tower = Vec::new();
    while next_is(input, |kind| *kind == Kind::Power) {
        input.next_token();
        let negative = signs(input).len() % 2 == 1;
        tower.push((negative, atom(input)?.expression));
    }
    let (Some((_, first)), Some((_, last))) = (tower.first(), tower.last()) else {
        return Ok(base);
    };
    let place = first.span.start..last.span.end;
    let exponent = tower.iter().rev().try_fold(None, |above, (negative, expression)| {
        integer_power(expression, above).map(|value| Some(if *negative { -value } else { value }))
    });
    let Some(exponent) = exponent.flatten() else {
        let message = format!(
            "the exponent is not an integer from -{LARGEST_EXPONENT} to {LARGEST_EXPONENT} (square roots are sqrt(…))"
        );
        return Err(Problem::new(message, place).cut());
    };
    // Powers of powers multiply out: a short text must not mean a number with a million digits.
    let nested = exponent.saturating_abs().max(1).saturating_mul(base.exponent);
    if nested > LARGEST_EXPONENT {
        let message = format!("powers of powers go beyond the exponent {LARGEST_EXPONENT}");
        return Err(Problem::new(message, place).cut());
    }
    let span = base.expression.span.start..place.end;
    let power = base.wrap(span, |base| Node::Power(base, exponent))?;
    Ok(Operand { exponent: nested, ..power })
}

/// One storey of a tower of exponents.
fn integer_power(expression: &Expression, above: Option<i32>) -> Option<i32> {
    let value = Affine::of(expression).ok().filter(|value| value.multiples.is_empty())?.constant;
    let base = whole(&value, LARGEST_EXPONENT)?;
    match above {
        None => Some(base),
        Some(exponent) if base == 0 && exponent < 0 => None,
        Some(exponent) => whole(&value.pow(exponent), LARGEST_EXPONENT),
    }
}

/// A number, a name, something in brackets.
fn atom<'t>(input: &mut Input<'_, 't>) -> Parsed<Operand> {
    let last = input.previous_tokens().next().map(|token| token.span.clone());
    let token = match input.next_token() {
        Some(token) if token.kind != Kind::Separator => token,
        // Where nothing follows, what came before is the place.
        _ => {
            let message = "something is missing after this";
            return Err(Problem::new(message, last.unwrap_or(0..0)).cut());
        }
    };
    match &token.kind {
        Kind::Number(value) => Ok(Operand::leaf(Node::Number(value.clone()), token.span.clone())),
        Kind::Name(name) => named(input, name, &token.span),
        Kind::Open('(') => {
            let inner = operation(input)?;
            let end = closing(input)?;
            // The brackets belong to the place of what they hold.
            let span = token.span.start..end;
            Ok(Operand { expression: Expression { span, ..inner.expression }, ..inner })
        }
        _ => Err(Problem::new(operand_expected(&token.kind), token.span.clone()).cut()),
    }
}

/// What begins with a name.
fn named<'t>(input: &mut Input<'_, 't>, name: &'t str, span: &Span) -> Parsed<Operand> {
    let next = input.peek_token();
    let opens = match next.map(|token| &token.kind) {
        Some(Kind::Open(bracket)) => Some(*bracket),
        _ => None,
    };
    let refuse = |message: String| Err(Problem::new(message, span.clone()).cut());
    match (name, opens) {
        _ if input.state.in_index && opens.is_some() => {
            refuse(format!("`{name}` with brackets in an index; write j, j+1, j-1/2"))
        }
        ("sqrt", Some('(')) => {
            let argument = bracketed(input)?;
            let end = previous_end(input);
            argument.wrap(span.start..end, Node::SquareRoot)
        }
        ("sum", Some('(')) => sum(input, span),
        ("sqrt", _) => refuse("sqrt is a function; write sqrt(3)".into()),
        ("sum", _) => refuse("sum is a function; write sum(k, w[k]*(u[n,j+k] - u[n,j-k]))".into()),
        (_, Some('(')) => refuse(format!(
            "there is no function `{name}`, only sqrt(…) and sum(k, …); a product is {name}*(…)"
        )),
        ("n" | "i" | "j", _) if !input.state.in_index => refuse(format!(
            "{name} is an index and no parameter; it stands in brackets only, as in u[n,{}]",
            if name == "i" { "i,j" } else { "j" }
        )),
        ("pi" | "π", Some(_)) => refuse("pi is a number and has no index".into()),
        ("pi" | "π", None) => Ok(Operand::leaf(Node::Pi, span.clone())),
        (_, Some(_)) => on_lattice(input, name, span),
        (_, None) => Ok(Operand::leaf(Node::Name(name.into()), span.clone())),
    }
}

/// `(operation)`.
fn bracketed(input: &mut Input<'_, '_>) -> Parsed<Operand> {
    input.next_token();
    let inner = operation(input)?;
    closing(input)?;
    Ok(inner)
}

/// The end of the bracket, which the [tokens] promise to match.
fn closing(input: &mut Input<'_, '_>) -> Parsed<usize> {
    match input.next_token() {
        Some(Token { kind: Kind::Close(_), span }) => Ok(span.end),
        Some(token) => Err(unexpected(token).cut()),
        None => Err(Problem::new("a bracket is never closed", 0..0).cut()),
    }
}

fn previous_end(input: &Input<'_, '_>) -> usize {
    input.previous_tokens().next().map_or(0, |token| token.span.end)
}

/// `sum(k, body)`; the next token is its bracket.
fn sum<'t>(input: &mut Input<'_, 't>, span: &Span) -> Parsed<Operand> {
    if input.state.running.is_some() {
        let message = "a sum in a sum; there is one kernel and one running index";
        return Err(Problem::new(message, span.clone()).cut());
    }
    input.next_token();
    let written = "a sum is written sum(k, w[k]*(u[n,j+k] - u[n,j-k]))";
    let index = match input.next_token() {
        Some(Token { kind: Kind::Name("n" | "i" | "j" | "pi" | "π" | "sqrt" | "sum"), span }) => {
            let message =
                "this name has a meaning of its own; call the running index of the sum k or m";
            return Err(Problem::new(message, span.clone()).cut());
        }
        Some(Token { kind: Kind::Name(index), .. }) => *index,
        other => {
            let place = other.map_or(span.clone(), |token| token.span.clone());
            return Err(
                Problem::new(format!("the running index is missing; {written}"), place).cut()
            );
        }
    };
    match input.next_token() {
        Some(Token { kind: Kind::Comma, .. }) => {}
        other => {
            let place = other.map_or(span.clone(), |token| token.span.clone());
            let message = format!("a comma belongs behind the running index; {written}");
            return Err(Problem::new(message, place).cut());
        }
    }
    input.state.running = Some(index);
    let body = operation(input)?;
    let end = closing(input)?;
    input.state.running = None;
    body.wrap(span.start..end, |body| Node::Sum { index: index.into(), body })
}

/// `u[n+1,j]`, `u[j]'`, `w[k]`; the next token is a bracket.
fn on_lattice<'t>(input: &mut Input<'_, 't>, name: &'t str, span: &Span) -> Parsed<Operand> {
    let open = input.next_token();
    if let (Some(open), Some(Token { kind: Kind::Close(_), span })) = (open, input.peek_token()) {
        let place = open.span.start..span.end;
        return Err(Problem::new(format!("there is no index; write {name}[n,j]"), place).cut());
    }
    input.state.in_index = true;
    let mut items = vec![expression(input)?];
    while next_is(input, |kind| *kind == Kind::Comma) {
        input.next_token();
        items.push(expression(input)?);
    }
    let mut end = closing(input)?;
    input.state.in_index = false;
    let mut primes = 0;
    while let Some(token) = input.peek_token().filter(|token| token.kind == Kind::Prime) {
        input.next_token();
        primes += 1;
        end = token.span.end;
        if primes == 2 {
            let message = "only first derivatives in time; name the first by an unknown of its own";
            return Err(Problem::new(message, token.span.clone()).cut());
        }
    }
    let span = span.start..end;
    let running = input.state.running;
    let bracketed = Bracketed { name, items, derivative: primes == 1, span: span.clone(), running };
    bracketed.resolve().map(|node| Operand::leaf(node, span)).map_err(Problem::cut)
}

/// A token where an operator or the end of something belongs.
pub(super) fn unexpected(token: &Token<'_>) -> Problem {
    let message = match &token.kind {
        Kind::Number(_) | Kind::Name(_) | Kind::Open('(') => {
            "a product needs its sign, as in 2*u[n,j]"
        }
        Kind::Open(_) => "a bracket with indices follows the name of an unknown, as in u[n,j]",
        Kind::Close(_) => "this bracket closes too early",
        Kind::Comma => {
            "a comma stands only between indices and in sum(k, …); decimals have a point"
        }
        Kind::Prime => "a prime follows an unknown of the method of lines, as in u[j]'",
        Kind::Equals => "`=` inside brackets",
        Kind::Separator => "a separator inside a formula",
        Kind::Plus | Kind::Minus | Kind::Times | Kind::Over | Kind::Power => {
            "an operator where none belongs"
        }
    };
    Problem::new(message, token.span.clone())
}

/// What is wrong with a token where a number, a name or a bracket belongs.
fn operand_expected(kind: &Kind<'_>) -> &'static str {
    match kind {
        Kind::Equals => "one side of the equation is missing",
        Kind::Open(_) => "the name of an unknown is missing; write u[n,j], and ( ) in formulas",
        Kind::Prime => "a prime follows an unknown of the method of lines, as in u[j]'",
        _ => "a number, a name or a bracket is missing before this",
    }
}
