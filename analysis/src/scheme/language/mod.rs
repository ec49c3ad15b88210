//! The language in which schemes are written: `u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])`.
//!
//! Text in, [syntax tree](syntax) out. Nothing here knows what a scheme does: whether the equations are linear,
//! square and steppable is asked by those who read the tree. The grammar stands in `docs/language.md`.

pub mod error;
pub mod syntax;

mod affine;
mod agreement;
mod formula;
mod index;
mod parser;
mod print;
mod tokens;

#[cfg(test)]
mod tests;

pub use error::LanguageError;
pub use parser::{LONGEST_TEXT, parse, parse_expression};
