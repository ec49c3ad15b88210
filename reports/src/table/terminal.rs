//! A table in a terminal: columns side by side, in as much room as there is.

use super::{Align, Table};

impl Table {
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

/// Columns in a terminal: every character here is one wide.
pub(super) fn width(text: &str) -> usize {
    text.chars().count()
}
