//! Tables that can be read in a terminal, in Markdown, in LaTeX and by a spreadsheet.

mod machine;
mod terminal;

use crate::latex::latex_text;
use crate::markup::inline;
use machine::{machine_cell, machine_name};

/// How a column is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// One cell: what people read, and what LaTeX and machines read if that differs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    text: String,
    latex: Option<String>,
    machine: Option<String>,
}

impl Cell {
    /// The same cell with another text for people; machines read what it was.
    pub fn called(self, text: impl Into<String>) -> Self {
        Self { machine: Some(self.text), ..Self::from(text) }
    }

    /// What machines read.
    pub fn machine(&self) -> &str {
        self.machine.as_deref().unwrap_or(&self.text)
    }

    /// A cell that LaTeX writes differently, for example a fraction.
    pub fn with_latex(text: impl Into<String>, latex: impl Into<String>) -> Self {
        Self { latex: Some(latex.into()), ..Self::from(text) }
    }
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self { text: text.into(), latex: None, machine: None }
    }
}

/// A table with a caption; every row has as many cells as there are columns.
///
/// ```
/// use courant_reports::table::{Align, Table};
/// let mut table = Table::new("Limits", &[("kernel", Align::Left), ("C", Align::Right)]);
/// table.push(["cubic-spline", "1.875"]);
/// assert!(table.to_markdown().contains("| cubic-spline | 1.875 |"));
/// assert_eq!(table.to_csv(), "kernel,cfl\ncubic-spline,1.875\n");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    caption: String,
    columns: Vec<(String, Align)>,
    rows: Vec<Vec<Cell>>,
    /// Columns at the left that say what a row is about.
    keys: usize,
}

impl Table {
    /// An empty table.
    pub fn new(caption: impl Into<String>, columns: &[(&str, Align)]) -> Self {
        let columns = columns.iter().map(|(name, align)| ((*name).into(), *align)).collect();
        Self { caption: caption.into(), columns, rows: Vec::new(), keys: 1 }
    }

    /// How many columns at the left say what a row is about (default: 1): where a table goes on below, they stand again.
    pub fn keyed(mut self, keys: usize) -> Self {
        self.keys = keys;
        self
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

    /// Comma-separated values for machines: headings in ASCII, words joined by `_`; numbers as plain decimals; what is
    /// not there is empty.
    pub fn to_csv(&self) -> String {
        let mut names: Vec<String> = Vec::new();
        for heading in self.header() {
            let name = machine_name(heading);
            // Two columns of one name are told apart by their place.
            let unique =
                if names.contains(&name) { format!("{name}_{}", names.len()) } else { name };
            names.push(unique);
        }
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(names).expect("writing to memory does not fail");
        for row in &self.rows {
            let cells = row.iter().map(|cell| machine_cell(cell.machine()));
            writer.write_record(cells).expect("rows are as long as the header");
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
                    format!("<{tag}{class}>{}</{tag}>", inline(text))
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

#[cfg(test)]
mod tests {
    use super::machine::without_exponent;
    use super::terminal::width;
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
    fn cells_that_are_too_wide_go_on_below() {
        let mut table = Table::new("", &[("words", Align::Left), ("a number", Align::Right)]);
        table.push(["one two three", "1.25"]);
        let text = table.to_text_within(15);
        let lines: Vec<&str> = text.lines().skip(2).collect();
        assert_eq!(
            lines,
            ["words         a", "         number", "───────  ──────", "one two    1.25", "three"]
        );
        assert!(table.to_text_within(3).lines().all(|line| width(line) <= 13));
        assert_eq!(table.to_text_within(30), table.to_text());
    }

    #[test]
    fn columns_that_find_no_room_go_on_below_beside_what_a_row_is_about() {
        let heads = ["method", "N", "velocity", "pressure", "energy"];
        let mut table = Table::new("", &heads.map(|head| (head, Align::Left))).keyed(2);
        table.push(["gph3", "10", "1", "2", "3"]);
        let text = table.to_text_within(22);
        let lines: Vec<&str> = text.lines().skip(2).collect();
        assert_eq!(lines[0], "method  N   velocity");
        assert_eq!(lines[2..5], ["gph3    10  1", "", "method  N   pressure"]);
        assert_eq!(lines[8..], ["method  N   energy", "──────  ──  ──────", "gph3    10  3"]);
    }

    #[test]
    fn machines_get_ascii_headings_and_plain_decimals() {
        let heads = ["l/Δξ", "|g| − 1", "C", "max error of ω", "κΔ", "growth 1e-3", "|g| − 1"];
        let mut table = Table::new("", &heads.map(|head| (head, Align::Left)));
        table.push(["3/2", "−1.50e-4", "∞", "–", "-0", "a – b", "1.250"]);
        assert_eq!(
            table.to_csv(),
            "ratio,gain_minus_1,cfl,max_error_of_omega,kappa,growth_1e_3,gain_minus_1_6\n\
             3/2,-0.000150,inf,,-0,a – b,1.250\n"
        );
        for (number, plain) in [
            ("1.25e1", "12.5"),
            ("1.25e2", "125"),
            ("-1.25e4", "-12500"),
            ("1.25e-1", "0.125"),
            ("12e-3", "0.012"),
            ("5e0", "5"),
        ] {
            assert_eq!(without_exponent(number).as_deref(), Some(plain));
            assert_eq!(number.parse::<f64>(), plain.parse());
        }
    }

    #[test]
    fn every_format_escapes_what_it_reserves() {
        assert!(table().to_markdown().contains("| a\\|b | 15/8 |"));
        assert!(table().to_csv().contains("\"long, name\",-1"));
        let latex = table().to_latex();
        assert!(
            latex.contains("\\caption{A 5\\% table}") && latex.contains("a$|$b & $\\frac{15}{8}$")
        );
        assert!(latex.contains("$\\Delta$"));
        assert!(table().to_html().contains("<td class=\"number\">15/8</td>"));
    }
}
