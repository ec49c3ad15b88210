//! From characters to tokens: numbers, names and signs with their places, brackets matched, lines joined.

use super::error::Problem;
use super::syntax::Span;
use crate::exact::rational::{self, Rational};
use winnow::combinator::{alt, opt};
use winnow::prelude::*;
use winnow::stream::LocatingSlice;
use winnow::token::{any, one_of, take_till, take_while};

/// How deep brackets may be nested: all recursion of the parser goes through brackets.
pub(super) const DEEPEST_BRACKETS: usize = 100;

/// Numerators and denominators of written numbers stay below two to this power, about 1e361.
const LONGEST_NUMBER: u64 = 1200;

/// A token with its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Token<'t> {
    pub kind: Kind<'t>,
    pub span: Span,
}

/// What a token is.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind<'t> {
    Number(Rational),
    Name(&'t str),
    /// `(` or `[`.
    Open(char),
    /// `)` or `]`.
    Close(char),
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Equals,
    Comma,
    Prime,
    /// `;`, or the end of a line that is not continued.
    Separator,
}

impl Kind<'_> {
    /// Whether a line that ends in it goes on in the next.
    fn continues(&self) -> bool {
        use Kind::*;
        matches!(self, Plus | Minus | Times | Over | Power | Equals | Comma)
    }
}

type Input<'t> = LocatingSlice<&'t str>;
type Lexed<T> = ModalResult<T, Problem>;

/// The tokens of a text.
pub(super) fn tokens(text: &str) -> Result<Vec<Token<'_>>, Problem> {
    let mut input = LocatingSlice::new(text);
    let mut tokens: Vec<Token<'_>> = Vec::new();
    let mut open: Vec<(char, Span)> = Vec::new();
    loop {
        blank(&mut input).map_err(Problem::from_mode)?;
        if input.is_empty() {
            break;
        }
        let line_ends = input.starts_with(['\n', '\r']);
        let token = token(&mut input).map_err(Problem::from_mode)?;
        match token.kind {
            Kind::Open(_) if open.len() == DEEPEST_BRACKETS => {
                return Err(Problem::new(
                    format!("brackets are nested more than {DEEPEST_BRACKETS} deep"),
                    token.span,
                ));
            }
            Kind::Open(bracket) => open.push((bracket, token.span.clone())),
            Kind::Close(bracket) => close(&mut open, bracket, &token.span)?,
            Kind::Separator if line_ends => {
                let goes_on = tokens.last().is_some_and(|last| last.kind.continues());
                if goes_on || !open.is_empty() {
                    continue;
                }
            }
            Kind::Separator => {
                if let Some((bracket, place)) = open.pop() {
                    let message = format!("`{bracket}` is not closed before the `;`");
                    return Err(Problem::new(message, place));
                }
            }
            _ => {}
        }
        tokens.push(token);
    }
    match open.pop() {
        Some((bracket, place)) => Err(Problem::new(format!("`{bracket}` is never closed"), place)),
        None => Ok(tokens),
    }
}

/// Takes the bracket that is closed here off the stack.
fn close(open: &mut Vec<(char, Span)>, closing: char, place: &Span) -> Result<(), Problem> {
    let message = match (open.pop(), closing) {
        (Some(('(', _)), ')') | (Some(('[', _)), ']') => return Ok(()),
        (Some((bracket, _)), _) => format!("`{closing}` closes a `{bracket}`"),
        (None, _) => format!("`{closing}` closes no bracket"),
    };
    Err(Problem::new(message, place.clone()))
}

/// White space within a line, and comments.
fn blank(input: &mut Input<'_>) -> Lexed<()> {
    let space = |c: char| (c.is_whitespace() && c != '\n' && c != '\r') || c == '\u{feff}';
    (take_while(0.., space), opt(('#', take_till(0.., ['\n', '\r'])))).void().parse_next(input)
}

fn token<'t>(input: &mut Input<'t>) -> Lexed<Token<'t>> {
    let (kind, span) = alt((number, name, sign)).with_span().parse_next(input)?;
    Ok(Token { kind, span })
}

/// `12`, `0.5`, `.5`, `1e-3`: read exactly.
fn number<'t>(input: &mut Input<'t>) -> Lexed<Kind<'t>> {
    let digit = |c: char| c.is_ascii_digit();
    // `2e` is no number with an exponent but a product somebody forgot to write.
    let exponent = (one_of(['e', 'E']), opt(one_of(['+', '-', '−'])), take_while(1.., digit));
    let (written, span) =
        (take_while(1.., ('0'..='9', '.')), opt(exponent)).take().with_span().parse_next(input)?;
    let value = rational::parse(&written.replace('−', "-"))
        .map_err(|error| Problem::new(error.to_string(), span.clone()).cut())?;
    if value.numer().bits().max(value.denom().bits()) > LONGEST_NUMBER {
        let message = "the number is out of range; write one between 1e-300 and 1e300";
        return Err(Problem::new(message, span).cut());
    }
    Ok(Kind::Number(value))
}

/// A letter or `_`, then letters, digits and `_`.
fn name<'t>(input: &mut Input<'t>) -> Lexed<Kind<'t>> {
    let first = |c: char| c.is_alphabetic() || c == '_';
    let later = |c: char| c.is_alphanumeric() || c == '_';
    // Superscript letters count as letters and `²` as a digit, but they are exponents.
    let word = (one_of(first), take_while(0.., move |c| later(c) && !is_superscript(c))).take();
    word.map(Kind::Name).parse_next(input)
}

fn is_superscript(c: char) -> bool {
    matches!(c, '²' | '³' | '¹' | '\u{2070}'..='\u{207f}')
}

/// Everything else. Signs as they come out of papers are taken for what they mean.
fn sign<'t>(input: &mut Input<'t>) -> Lexed<Kind<'t>> {
    let (first, span) = any.with_span().parse_next(input)?;
    Ok(match first {
        '(' | '[' => Kind::Open(first),
        ')' | ']' => Kind::Close(first),
        '+' => Kind::Plus,
        '-' | '−' | '–' => Kind::Minus,
        '*' if input.starts_with('*') => {
            any.parse_next(input)?;
            Kind::Power
        }
        '*' | '·' | '⋅' | '×' => Kind::Times,
        '/' => Kind::Over,
        '^' => Kind::Power,
        '=' => Kind::Equals,
        ',' => Kind::Comma,
        '\'' | '′' | '’' => Kind::Prime,
        ';' | '\n' | '\r' => Kind::Separator,
        '{' | '}' => {
            let message =
                format!("`{first}` is no bracket here; write u[n+1,j], and ( ) in formulas");
            return Err(Problem::new(message, span).cut());
        }
        _ if is_superscript(first) => {
            return Err(Problem::new("write a power with ^, as in C^2", span).cut());
        }
        _ => {
            let shown = first.escape_debug();
            return Err(Problem::new(format!("unexpected character `{shown}`"), span).cut());
        }
    })
}
