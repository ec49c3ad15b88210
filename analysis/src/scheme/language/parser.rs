//! From a text to its equations, or to one value.

use super::agreement;
use super::error::{LanguageError, Problem};
use super::formula::{Input, Parsed, State, expression, next_is, unexpected};
use super::syntax::{Equation, Equations, Expression};
use super::tokens::{Kind, tokens};
use winnow::stream::{Stateful, Stream, TokenSlice};

/// Longer texts, in characters, are refused.
pub const LONGEST_TEXT: usize = 20_000;

/// Reads equations.
///
/// ```
/// use courant_analysis::scheme::language::parse;
/// let upwind = parse("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])").unwrap();
/// assert_eq!(upwind.equations.len(), 1);
/// let error = parse("u[n+1,j] = u[n,j] - 2u[n,j-1]").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "a product needs its sign, as in 2*u[n,j]: u[n+1,j] = u[n,j] - 2»u«[n,j-1]",
/// );
/// ```
///
/// # Errors
/// What is not understood, with its place.
pub fn parse(text: &str) -> Result<Equations, LanguageError> {
    let equations = read(text, |input| {
        let mut equations = Vec::new();
        loop {
            skip_separators(input);
            match input.peek_token() {
                Some(_) => equations.push(equation(input)?),
                None => break,
            }
        }
        if equations.is_empty() {
            return Err(Problem::new(
                "there is no equation; write one such as u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])",
                0..text.len(),
            )
            .cut());
        }
        Ok(equations)
    })?;
    agreement::check(&equations).map_err(|problem| problem.in_text(text))?;
    Ok(Equations { text: text.into(), equations })
}

/// Reads a constant expression such as `sqrt(3)/6`, `2/3` or `-I*C*phi`: numbers and names, no unknown, no sum.
///
/// ```
/// use courant_analysis::scheme::language::parse_expression;
/// assert_eq!(parse_expression("- I*C * phi").unwrap().to_string(), "-I*C*phi");
/// assert!(parse_expression("u[n,j]/2").is_err());
/// ```
///
/// # Errors
/// What is not understood, with its place.
pub fn parse_expression(text: &str) -> Result<Expression, LanguageError> {
    read(text, |input| {
        skip_separators(input);
        if input.is_empty() {
            let message = "there is no expression; write one such as sqrt(3)/6 or -C*phi";
            return Err(Problem::new(message, 0..text.len()).cut());
        }
        let expression = expression(input)?;
        let separated = skip_separators(input);
        match input.peek_token() {
            Some(token) if separated => {
                Err(Problem::new("a second value where one is expected", token.span.clone()).cut())
            }
            Some(token) if token.kind == Kind::Equals => {
                Err(Problem::new("`=` in a value; write its right side alone", token.span.clone())
                    .cut())
            }
            Some(token) => Err(unexpected(token).cut()),
            None => agreement::constant(&expression).map_err(Problem::cut).map(|()| expression),
        }
    })
}

fn read<T>(
    text: &str,
    grammar: impl for<'a, 't> FnOnce(&mut Input<'a, 't>) -> Parsed<T>,
) -> Result<T, LanguageError> {
    if let Some((end, _)) = text.char_indices().nth(LONGEST_TEXT) {
        let message = format!("the text is longer than {LONGEST_TEXT} characters");
        return Err(LanguageError::new(message, &text[..end], end..end));
    }
    let tokens = tokens(text).map_err(|problem| problem.in_text(text))?;
    let mut input = Stateful { input: TokenSlice::new(&tokens), state: State::default() };
    grammar(&mut input).map_err(|error| Problem::from_mode(error).in_text(text))
}

/// Whether there were any.
fn skip_separators(input: &mut Input<'_, '_>) -> bool {
    let mut any = false;
    while next_is(input, |kind| *kind == Kind::Separator) {
        input.next_token();
        any = true;
    }
    any
}

/// `left = right`, up to the separator.
fn equation(input: &mut Input<'_, '_>) -> Parsed<Equation> {
    let left = expression(input)?;
    match input.next_token() {
        Some(token) if token.kind == Kind::Equals => {}
        Some(token) if token.kind != Kind::Separator => return Err(unexpected(token).cut()),
        _ => {
            let message = "no `=` in this equation (a line that goes on ends in an operator or inside brackets)";
            return Err(Problem::new(message, left.span).cut());
        }
    }
    let right = expression(input)?;
    match input.peek_token() {
        Some(token) if token.kind == Kind::Equals => {
            let message = "a second `=` in one equation; separate equations by ; or a new line";
            Err(Problem::new(message, token.span.clone()).cut())
        }
        Some(token) if token.kind != Kind::Separator => Err(unexpected(token).cut()),
        _ => {
            let span = left.span.start..right.span.end;
            Ok(Equation { left, right, span })
        }
    }
}
