//! Tables that can be read in a terminal, in Markdown, in LaTeX and by a spreadsheet.

use crate::latex::latex_text;
use crate::markup::escaped;

/// How a column is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// One cell: what people read, and how LaTeX writes it if that differs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    text: String,
    latex: Option<String>,
}

impl Cell {
    /// A cell that LaTeX writes differently, for example a fraction.
    pub fn with_latex(text: impl Into<String>, latex: impl Into<String>) -> Self {
        Self { text: text.into(), latex: Some(latex.into()) }
    }
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self { text: text.into(), latex: None }
    }
}

/// A table with a caption; every row has as many cells as there are columns.
///
/// ```
/// use courant_reports::table::{Align, Table};
/// let mut table = Table::new("Limits", &[("kernel", Align::Left), ("C", Align::Right)]);
/// table.push(["cubic-spline", "1.875"]);
/// assert!(table.to_markdown().contains("| cubic-spline | 1.875 |"));
/// assert_eq!(table.to_csv(), "kernel,C\ncubic-spline,1.875\n");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    caption: String,
    columns: Vec<(String, Align)>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table.
    pub fn new(caption: impl Into<String>, columns: &[(&str, Align)]) -> Self {
        let columns = columns.iter().map(|(name, align)| ((*name).into(), *align)).collect();
        Self { caption: caption.into(), columns, rows: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// When the number of cells is not the number of columns.
    pub fn push<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        let row: Vec<Cell> = cells.into_iter().map(Into::into).collect();
        assert_eq!(row.len(), self.columns.len(), "a row has a cell for every column");
        self.rows.push(row);
    }

    /// The caption.
    pub fn caption(&self) -> &str {
        &self.caption
    }

    /// The column names.
    pub fn header(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|(name, _)| name.as_str())
    }

    /// The rows as text.
    pub fn rows(&self) -> impl Iterator<Item = impl Iterator<Item = &str>> {
        self.rows.iter().map(|row| row.iter().map(|cell| cell.text.as_str()))
    }

    /// How each column is set.
    pub fn alignments(&self) -> impl Iterator<Item = Align> {
        self.columns.iter().map(|(_, align)| *align)
    }

    /// The widest cell of every column.
    fn widths(&self) -> Vec<usize> {
        (0..self.columns.len())
            .map(|index| {
                let cells = self.rows.iter().map(|row| width(&row[index].text));
                cells.chain([width(&self.columns[index].0)]).max().unwrap_or(0)
            })
            .collect()
    }

    /// How many columns of a terminal [`to_text`](Self::to_text) takes.
    pub fn width(&self) -> usize {
        let widths = self.widths();
        widths.iter().sum::<usize>() + 2 * widths.len().saturating_sub(1)
    }

    /// Aligned columns for a terminal, the caption above.
    pub fn to_text(&self) -> String {
        let widths = self.widths();
        let line = |cells: Vec<&str>| {
            let mut text = String::new();
            for ((cell, wanted), (_, align)) in cells.iter().zip(&widths).zip(&self.columns) {
                let padding = " ".repeat(wanted - width(cell));
                match align {
                    Align::Left => text.push_str(&format!("{cell}{padding}  ")),
                    Align::Right => text.push_str(&format!("{padding}{cell}  ")),
                }
            }
            format!("{}\n", text.trim_end())
        };
        let mut text = format!("{}\n\n", self.caption);
        if self.header().any(|name| !name.is_empty()) {
            let rules: Vec<String> = widths.iter().map(|&width| "─".repeat(width)).collect();
            text.push_str(&line(self.header().collect()));
            text.push_str(&line(rules.iter().map(String::as_str).collect()));
        }
        for row in &self.rows {
            text.push_str(&line(row.iter().map(|cell| cell.text.as_str()).collect()));
        }
        text
    }

    /// A Markdown table without the caption.
    pub fn to_markdown(&self) -> String {
        let escape = |text: &str| text.replace('|', "\\|");
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let mut text = line(self.header().map(escape).collect());
        let rules = self.columns.iter().map(|(_, align)| match align {
            Align::Left => ":---".into(),
            Align::Right => "---:".into(),
        });
        text.push_str(&line(rules.collect()));
        for row in &self.rows {
            text.push_str(&line(row.iter().map(|cell| escape(&cell.text)).collect()));
        }
        text
    }

    /// A LaTeX `table` with the `booktabs` rules.
    pub fn to_latex(&self) -> String {
        let specification: String = self
            .columns
            .iter()
            .map(|(_, align)| if *align == Align::Left { 'l' } else { 'r' })
            .collect();
        let line = |cells: Vec<String>| format!("    {} \\\\\n", cells.join(" & "));
        let mut text = format!(
            "\\begin{{table}}\n  \\centering\n  \\caption{{{}}}\n  \\begin{{tabular}}{{{specification}}}\n    \\toprule\n",
            latex_text(&self.caption)
        );
        text.push_str(&line(self.header().map(latex_text).collect()));
        text.push_str("    \\midrule\n");
        for row in &self.rows {
            let cells = row.iter().map(|cell| match &cell.latex {
                Some(latex) => format!("${latex}$"),
                None => latex_text(&cell.text),
            });
            text.push_str(&line(cells.collect()));
        }
        text.push_str("    \\bottomrule\n  \\end{tabular}\n\\end{table}\n");
        text
    }

    /// Comma-separated values with a header line.
    pub fn to_csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(self.header()).expect("writing to memory does not fail");
        for row in self.rows() {
            writer.write_record(row).expect("rows have as many cells as the header");
        }
        let bytes = writer.into_inner().expect("writing to memory does not fail");
        String::from_utf8(bytes).expect("cells are UTF-8")
    }

    /// An HTML table.
    pub fn to_html(&self) -> String {
        let cells = |tag: &str, texts: Vec<&str>| -> String {
            texts
                .iter()
                .zip(self.alignments())
                .map(|(text, align)| {
                    let class = if align == Align::Right { " class=\"number\"" } else { "" };
                    format!("<{tag}{class}>{}</{tag}>", escaped(text))
                })
                .collect()
        };
        let rows: String =
            self.rows().map(|row| format!("<tr>{}</tr>\n", cells("td", row.collect()))).collect();
        format!(
            "<table>\n<thead><tr>{}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n",
            cells("th", self.header().collect())
        )
    }
}

/// Columns in a terminal: every character here is one wide.
fn width(text: &str) -> usize {
    text.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new("A 5% table", &[("name", Align::Left), ("Δ", Align::Right)]);
        table.push([Cell::from("a|b"), Cell::with_latex("15/8", "\\frac{15}{8}")]);
        table.push(["long, name", "−1"]);
        table
    }

    #[test]
    fn text_columns_line_up() {
        let text = table().to_text();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "A 5% table");
        assert_eq!(lines[2], "name           Δ");
        assert_eq!(lines[4], "a|b         15/8");
        assert_eq!(lines[5], "long, name    −1");
    }

    #[test]
    fn every_format_escapes_what_it_reserves() {
        assert!(table().to_markdown().contains("| a\\|b | 15/8 |"));
        assert!(table().to_csv().contains("\"long, name\",−1"));
        let latex = table().to_latex();
        assert!(
            latex.contains("\\caption{A 5\\% table}") && latex.contains("a$|$b & $\\frac{15}{8}$")
        );
        assert!(latex.contains("$\\Delta$"));
        assert!(table().to_html().contains("<td class=\"number\">15/8</td>"));
    }
}
