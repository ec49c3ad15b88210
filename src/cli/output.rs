//! What goes to standard output, in the format asked for.

use super::Outcome;
use super::error::Failure;
use clap::ValueEnum;
use courant::reports::table::Table;
use serde::Serialize;
use std::io::Write;

/// The format of standard output.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Aligned columns for people.
    Table,
    /// One JSON object.
    Json,
    /// Comma-separated values.
    Csv,
    /// A Markdown table.
    Markdown,
    /// A LaTeX table.
    Latex,
}

/// A JSON object with its schema name.
#[derive(Debug, Serialize)]
struct Envelope<'a, T> {
    schema: String,
    #[serde(flatten)]
    body: &'a T,
}

/// Prints text; a reader that went away is reported as such.
pub fn print(text: &str) -> Result<Outcome, Failure> {
    print_bytes(text.as_bytes())
}

/// Prints bytes.
pub fn print_bytes(bytes: &[u8]) -> Result<Outcome, Failure> {
    let mut output = std::io::stdout().lock();
    output.write_all(bytes)?;
    output.flush()?;
    Ok(Outcome::Yes)
}

/// Prints one JSON object with `"schema": "courant.<command>/1"`.
pub fn print_json<T: Serialize>(command: &str, body: &T) -> Result<Outcome, Failure> {
    let envelope = Envelope { schema: format!("courant.{command}/1"), body };
    let text = serde_json::to_string_pretty(&envelope)
        .map_err(|error| Failure::Message(error.to_string()))?;
    print(&format!("{text}\n"))
}

/// Prints a table in one of the formats that are tables; `None` for JSON.
pub fn table_text(table: &Table, format: Format) -> Option<String> {
    match format {
        Format::Table => Some(table.to_text()),
        Format::Csv => Some(table.to_csv()),
        Format::Markdown => Some(table.to_markdown()),
        Format::Latex => Some(table.to_latex()),
        Format::Json => None,
    }
}
