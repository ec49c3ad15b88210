//! What goes to standard output, in the format asked for.

use super::Outcome;
use super::error::Failure;
use clap::ValueEnum;
use courant::reports::table::{Align, Table};
use serde::Serialize;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
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

/// What a terminal has room for.
pub const WIDTH: usize = 100;

/// Lines below a table, after an empty one; long ones are broken at spaces.
pub fn paragraphs(lines: &[String]) -> String {
    let text: String = lines.iter().map(|line| format!("\n{}", broken(line))).collect();
    if text.is_empty() { text } else { text + "\n" }
}

/// Warnings below a table.
pub fn warnings(all: &[String]) -> String {
    paragraphs(&all.iter().map(|one| format!("warning: {one}")).collect::<Vec<_>>())
}

/// A line, broken at spaces where it is long.
fn broken(line: &str) -> String {
    let mut text = String::new();
    let mut used = 0;
    for word in line.split(' ') {
        let width = word.chars().count();
        if used > 0 && used + 1 + width > WIDTH {
            text.push_str("\n  ");
            used = 2;
        } else if used > 0 {
            text.push(' ');
            used += 1;
        }
        text.push_str(word);
        used += width;
    }
    text
}

/// Prints text. A reader that went away is no failure: what is left of the command is done, and its answer is the same.
pub fn print(text: &str) -> Result<Outcome, Failure> {
    print_bytes(text.as_bytes())
}

/// Prints bytes.
pub fn print_bytes(bytes: &[u8]) -> Result<Outcome, Failure> {
    let mut output = std::io::stdout().lock();
    match output.write_all(bytes).and_then(|()| output.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(Outcome::Yes),
    }
}

/// Prints one JSON object with `"schema": "courant.<command>/1"`.
pub fn print_json<T: Serialize>(command: &str, body: &T) -> Result<Outcome, Failure> {
    let envelope = Envelope { schema: format!("courant.{command}/1"), body };
    let text = serde_json::to_string_pretty(&envelope)
        .map_err(|error| Failure::Message(error.to_string()))?;
    print(&format!("{text}\n"))
}

/// The rows of an answer that has several.
#[derive(Debug, Serialize)]
struct Rows<'a, T> {
    rows: &'a [T],
}

/// Prints one answer: for people its table, for scripts its record.
pub fn print_record<T: Serialize>(
    command: &str,
    record: &T,
    table: &Table,
    format: Format,
) -> Result<Outcome, Failure> {
    print_records(command, &[record], table, format)
}

/// Prints records: for people a table, for scripts one as an object and several as its rows.
pub fn print_records<T: Serialize>(
    command: &str,
    records: &[T],
    table: &Table,
    format: Format,
) -> Result<Outcome, Failure> {
    match (table_text(table, format), records) {
        (Some(_), _) if format == Format::Csv => print(&records_csv(records)?),
        (Some(text), _) => print(&text),
        (None, [one]) => print_json(command, one),
        (None, rows) => print_json(command, &Rows { rows }),
    }
}

/// Records as comma-separated values: the names of their JSON keys, nested ones as `stability_value`, above a row
/// for each with all digits. What is `null` or what a record does not have is an empty cell; the note beside it is a
/// column as well; a list is one cell.
fn records_csv<T: Serialize>(records: &[T]) -> Result<String, Failure> {
    let problem = |error: serde_json::Error| Failure::Message(error.to_string());
    let leaves =
        |record| serde_json::to_string(record).and_then(|text| serde_json::from_str(&text));
    let rows: Vec<Leaves> =
        records.iter().map(leaves).collect::<Result<_, _>>().map_err(problem)?;
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in rows.iter().flat_map(|row| &row.0) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    let columns: Vec<(&str, Align)> = names.iter().map(|name| (*name, Align::Left)).collect();
    let mut table = Table::new("", &columns);
    for Leaves(row) in &rows {
        let cell = |name: &str| row.iter().find(|(known, _)| known == name);
        table.push(names.iter().map(|name| cell(name).map_or("", |(_, value)| value.as_str())));
    }
    Ok(table.to_csv())
}

/// The values of a JSON text with the path to each, in the order of the text.
#[derive(Debug, PartialEq)]
struct Leaves(Vec<(String, String)>);

impl Leaves {
    fn one(value: impl ToString) -> Self {
        Self(vec![(String::new(), value.to_string())])
    }

    fn append(&mut self, key: &str, inner: Self) {
        self.0.extend(inner.0.into_iter().map(|(path, value)| {
            (if path.is_empty() { key.into() } else { format!("{key}_{path}") }, value)
        }));
    }
}

impl<'de> Deserialize<'de> for Leaves {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LeavesVisitor)
    }
}

struct LeavesVisitor;

impl<'de> Visitor<'de> for LeavesVisitor {
    type Value = Leaves;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("JSON")
    }

    fn visit_unit<E>(self) -> Result<Leaves, E> {
        Ok(Leaves::one(""))
    }

    fn visit_bool<E>(self, value: bool) -> Result<Leaves, E> {
        Ok(Leaves::one(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Leaves, E> {
        Ok(Leaves::one(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Leaves, E> {
        Ok(Leaves::one(value))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Leaves, E> {
        // The shortest decimal that is this number, without an exponent.
        Ok(Leaves::one(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Leaves, E> {
        Ok(Leaves::one(value))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Leaves, A::Error> {
        let mut leaves = Leaves(Vec::new());
        while let Some((key, inner)) = map.next_entry::<String, Leaves>()? {
            leaves.append(&key, inner);
        }
        Ok(leaves)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Leaves, A::Error> {
        let mut values = Vec::new();
        while let Some(Leaves(inner)) = items.next_element()? {
            values.extend(inner.into_iter().map(|(_, value)| value));
        }
        Ok(Leaves::one(values.join(";")))
    }
}

/// Prints a table in one of the formats that are tables; `None` for JSON.
pub fn table_text(table: &Table, format: Format) -> Option<String> {
    match format {
        Format::Table => {
            let text = table.to_text_within(WIDTH);
            let (caption, rest) = text.split_once('\n')?;
            Some(format!("{}\n{rest}", broken(caption)))
        }
        Format::Csv => Some(table.to_csv()),
        Format::Markdown => Some(table.to_markdown()),
        Format::Latex => Some(table.to_latex()),
        Format::Json => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_as_csv_has_the_keys_in_order_and_every_digit() {
        let text = r#"{"z":1e-30,"a":{"value":null,"note":"none, \"so far\""},"list":[true,-2]}"#;
        let leaves: Leaves = serde_json::from_str(text).unwrap();
        let names: Vec<&str> = leaves.0.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(leaves.0[3].1, "true;-2");
        assert_eq!(names, ["z", "a_value", "a_note", "list"]);
        #[derive(Serialize)]
        struct Record {
            z: f64,
            a: Option<f64>,
            note: &'static str,
        }
        let record = Record { z: 1.0 / 3.0, a: None, note: "none, so far" };
        let csv = records_csv(&[&record]).unwrap();
        assert_eq!(csv, "z,a,note\n0.3333333333333333,,\"none, so far\"\n");
        let several =
            records_csv(&[serde_json::json!({"a": 1}), serde_json::json!({"a": 2, "b": {"c": 3}})])
                .unwrap();
        assert_eq!(several, "a,b_c\n1,\n2,3\n");
    }
}
