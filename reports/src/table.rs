//! Tables that can be read in a terminal, in Markdown, in LaTeX and by a spreadsheet.

use crate::latex::latex_text;
use crate::markup::inline;

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

    /// The longest word of every column.
    fn least_widths(&self) -> Vec<usize> {
        (0..self.columns.len())
            .map(|index| {
                let cells = self.rows.iter().map(|row| row[index].text.as_str());
                let words =
                    cells.chain([self.columns[index].0.as_str()]).flat_map(|c| c.split(' '));
                words.map(width).max().unwrap_or(0)
            })
            .collect()
    }

    /// The table in parts of so many columns of a terminal, if their words are short enough.
    fn parts_within(&self, room: usize) -> Vec<Self> {
        let least = self.least_widths();
        let keys = self.keys.min(least.len());
        let of_keys = least[..keys].iter().map(|one| one + 2).sum::<usize>();
        let mut parts: Vec<Vec<usize>> = Vec::new();
        let mut used = usize::MAX;
        for (index, one) in least.iter().enumerate().skip(keys) {
            match parts.last_mut() {
                Some(part) if used.saturating_add(2 + one) <= room => {
                    part.push(index);
                    used += 2 + one;
                }
                _ => {
                    parts.push((0..keys).chain([index]).collect());
                    used = of_keys + one;
                }
            }
        }
        if parts.len() < 2 {
            return vec![self.clone()];
        }
        let part = |chosen: Vec<usize>| Self {
            caption: self.caption.clone(),
            columns: chosen.iter().map(|&index| self.columns[index].clone()).collect(),
            rows: self
                .rows
                .iter()
                .map(|row| chosen.iter().map(|&i| row[i].clone()).collect())
                .collect(),
            keys,
        };
        parts.into_iter().map(part).collect()
    }

    /// The widths of the columns in so much room: the widest are narrowed, down to their longest word.
    fn widths_within(&self, room: usize) -> Vec<usize> {
        let mut widths = self.widths();
        let least = self.least_widths();
        let gaps = 2 * widths.len().saturating_sub(1);
        while widths.iter().sum::<usize>() + gaps > room {
            let narrower = (0..widths.len()).filter(|&index| widths[index] > least[index]);
            match narrower.max_by_key(|&index| widths[index]) {
                Some(index) => widths[index] -= 1,
                None => break,
            }
        }
        widths
    }

    /// Aligned columns for a terminal, the caption above.
    pub fn to_text(&self) -> String {
        self.to_text_within(usize::MAX)
    }

    /// The same in so many columns of a terminal, if words and numbers are short enough: longer cells and headings go on
    /// in lines of their own, and columns that find no room go on below.
    pub fn to_text_within(&self, room: usize) -> String {
        let parts: Vec<String> =
            self.parts_within(room).iter().map(|part| part.lines_within(room)).collect();
        format!("{}\n\n{}", self.caption, parts.join("\n"))
    }

    /// Columns side by side, without the caption.
    fn lines_within(&self, room: usize) -> String {
        let widths = self.widths_within(room);
        let line = |cells: Vec<&str>| {
            let cells: Vec<Vec<String>> =
                cells.iter().zip(&widths).map(|(cell, width)| broken(cell, *width)).collect();
            let lines = cells.iter().map(Vec::len).max().unwrap_or(0);
            let one = |index: usize| {
                let mut text = String::new();
                for ((cell, wanted), (_, align)) in cells.iter().zip(&widths).zip(&self.columns) {
                    let cell = cell.get(index).map_or("", String::as_str);
                    let padding = " ".repeat(wanted - width(cell));
                    match align {
                        Align::Left => text.push_str(&format!("{cell}{padding}  ")),
                        Align::Right => text.push_str(&format!("{padding}{cell}  ")),
                    }
                }
                format!("{}\n", text.trim_end())
            };
            (0..lines).map(one).collect::<String>()
        };
        let mut text = String::new();
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

/// A cell in lines of at most so many characters, broken at spaces.
fn broken(cell: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for (index, word) in cell.split(' ').enumerate() {
        let line = lines.last_mut().expect("there is a line");
        if index > 0 && width(line) + 1 + width(word) > most {
            lines.push(word.into());
        } else {
            line.push_str(if index > 0 { " " } else { "" });
            line.push_str(word);
        }
    }
    lines
}

/// A heading for machines: `l/Δξ` and `h/Δ` are the `ratio` everywhere, `|g|` and `|z|` the `gain`, `C` the `cfl`.
fn machine_name(heading: &str) -> String {
    if heading == "C" {
        return "cfl".into();
    }
    let known = [
        ("l/Δξ", "ratio"),
        ("h/Δ", "ratio"),
        ("|g|", "gain"),
        ("|z|", "gain"),
        ("arg g", "phase"),
        ("arg z", "phase"),
        ("α", "alpha"),
        ("β", "beta"),
        ("γ", "gamma"),
        ("κΔ", "kappa"),
        ("Δ", "delta_"),
        ("η", "eta"),
        ("κ", "kappa"),
        ("λ", "lambda"),
        ("ξ", "xi"),
        ("π", "pi"),
        ("ρ", "rho"),
        ("σ", "sigma"),
        ("φ", "phase"),
        ("ω", "omega"),
        ("∞", "inf"),
        ("−", " minus "),
        ("%", " percent"),
    ];
    let text =
        known.iter().fold(heading.to_string(), |text, (sign, name)| text.replace(sign, name));
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { ' ' };
    let words: String = text.chars().map(plain).collect();
    words.split_whitespace().collect::<Vec<_>>().join("_")
}

/// A cell for machines.
fn machine_cell(cell: &str) -> String {
    let number = cell.replace('−', "-").replace('∞', "inf");
    match number.parse::<f64>() {
        _ if cell == "–" => String::new(),
        Ok(value) if value.is_nan() => String::new(),
        Ok(_) => without_exponent(&number).unwrap_or(number),
        Err(_) => cell.into(),
    }
}

/// A decimal with its exponent written out, all digits as they are.
fn without_exponent(number: &str) -> Option<String> {
    let (mantissa, exponent) = number.split_once(['e', 'E'])?;
    let exponent: i32 = exponent.parse().ok()?;
    let (sign, digits) = match mantissa.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", mantissa),
    };
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let (before, after) = (whole.len() as i32 + exponent, part.len() as i32 - exponent);
    let zeros = |count: i32| "0".repeat(count.max(0) as usize);
    let all = format!("{}{whole}{part}{}", zeros(1 - before), zeros(-after));
    let (whole, part) = all.split_at(before.max(1) as usize);
    let point = if part.is_empty() { "" } else { "." };
    Some(format!("{sign}{whole}{point}{part}"))
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
