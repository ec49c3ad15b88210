//! What is wrong with a text, and where.

use super::syntax::Span;
use winnow::error::{ErrMode, ParserError};
use winnow::stream::Stream;

/// One problem with its place in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LanguageError {
    /// What is wrong and what would be accepted, in one line.
    pub message: String,
    /// The text.
    pub text: String,
    /// Where.
    pub span: Span,
}

impl LanguageError {
    /// A problem at a place of a text.
    pub fn new(message: impl Into<String>, text: &str, span: Span) -> Self {
        Self { message: message.into(), text: text.into(), span }
    }
}

impl std::error::Error for LanguageError {}

impl std::fmt::Display for LanguageError {
    /// One line: the message, then the part of the text with its place marked `»here«`.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // On character boundaries, whoever made the place.
        let boundary = |mut at: usize| {
            at = at.min(self.text.len());
            while !self.text.is_char_boundary(at) {
                at -= 1;
            }
            at
        };
        let start = boundary(self.span.start);
        let end = boundary(self.span.end).max(start);
        let here = first_characters(&self.text[start..end], 60);
        if self.text.trim().is_empty() {
            return formatter.write_str(&self.message);
        }
        // No more than some dozen characters on either side.
        let before = last_characters(self.text[..start].trim_start(), 24);
        let after = first_characters(self.text[end..].trim_end(), 24);
        let line = format!("{before}»{here}«{after}").replace(char::is_control, " ");
        write!(formatter, "{}: {line}", self.message)
    }
}

/// The beginning of a text, with an ellipsis where it goes on.
fn first_characters(text: &str, count: usize) -> String {
    match text.char_indices().nth(count) {
        None => text.into(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}

/// The end of a text, with an ellipsis where it begins earlier.
fn last_characters(text: &str, count: usize) -> String {
    match text.char_indices().rev().nth(count) {
        None => text.into(),
        Some((start, cut)) => format!("…{}", &text[start + cut.len_utf8()..]),
    }
}

/// What the parsers carry: a problem that does not hold the text yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Problem {
    pub message: String,
    pub span: Span,
}

impl Problem {
    pub(super) fn new(message: impl Into<String>, span: Span) -> Self {
        Self { message: message.into(), span }
    }

    /// As an error that no other alternative of the grammar can repair.
    pub(super) fn cut(self) -> ErrMode<Self> {
        ErrMode::Cut(self)
    }

    pub(super) fn from_mode(error: ErrMode<Self>) -> Self {
        // `Incomplete` belongs to streams that are still being filled: ours never are.
        error.into_inner().unwrap_or_else(|_| Self::new("not understood", 0..0))
    }

    pub(super) fn in_text(self, text: &str) -> LanguageError {
        LanguageError::new(self.message, text, self.span)
    }
}

/// Errors of the library itself only steer its search for another alternative: nobody sees them.
impl<I: Stream> ParserError<I> for Problem {
    type Inner = Self;

    fn from_input(_: &I) -> Self {
        Self::new(String::new(), 0..0)
    }

    fn into_inner(self) -> Result<Self, Self> {
        Ok(self)
    }
}
