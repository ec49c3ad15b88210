//! What tells one row of an answer from another, in columns, captions and remarks.

use crate::table::Align;
use courant_analysis::exact::rational::{Rational, decimal_below, parse, to_text};
use num_traits::Signed;

/// What tells one row of an answer from another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// The name of the column.
    pub heading: String,
    /// What stands in it.
    pub cell: String,
    /// The same in a caption.
    pub caption: String,
}

impl Label {
    /// Whether the column has words in it, not numbers.
    pub fn is_text(&self) -> bool {
        !self.caption.contains(" = ") || self.heading == "equation"
    }

    /// How a column is set whose cells are like this one.
    pub fn align(label: Option<&Self>) -> Align {
        if label.is_some_and(Self::is_text) { Align::Left } else { Align::Right }
    }
}

/// The longest fraction that a heading has room for.
const LONGEST_FRACTION: usize = 24;

/// A value in headings and cells: exact where there is room, else cut off, with an ellipsis.
///
/// ```
/// use courant_analysis::exact::rational::{parse, ratio};
/// use courant_reports::subject::shown;
/// assert_eq!(shown(&parse("-0.1234567890123").unwrap()), "-0.1234567890123");
/// assert_eq!(shown(&ratio(-1, 3).pow(51)), "-4.6431852303284611e-25…");
/// ```
pub fn shown(value: &Rational) -> String {
    let text = to_text(value);
    if text.len() <= LONGEST_FRACTION {
        return text;
    }
    if value.is_negative() {
        return format!("-{}", shown(&-value.clone()));
    }
    let digits = decimal_below(value, 17);
    let (mantissa, exponent) = digits.split_at(digits.find('e').unwrap_or(digits.len()));
    let short = match mantissa.contains('.') {
        true => mantissa.trim_end_matches('0').trim_end_matches('.'),
        false => mantissa,
    };
    let exact = format!("{short}{exponent}");
    if parse(&exact).as_ref() == Ok(value) { exact } else { format!("{digits}…") }
}

/// The headings of labels that are not the same in all rows, and kernel and ratio wherever there are any.
pub fn varying(rows: &[Vec<Label>]) -> Vec<String> {
    let mut headings: Vec<&Label> = Vec::new();
    for label in rows.iter().flatten() {
        if headings.iter().all(|known| known.heading != label.heading) {
            headings.push(label);
        }
    }
    let always = ["kernel", "l/Δξ", "h/Δ"];
    let differs = |wanted: &Label| {
        always.contains(&wanted.heading.as_str())
            || rows
                .iter()
                .any(|row| row.iter().find(|label| label.heading == wanted.heading) != Some(wanted))
    };
    headings.into_iter().filter(|label| differs(label)).map(|l| l.heading.clone()).collect()
}

/// What tells one row from the others in a remark.
pub fn row_name(labels: &[Label], varying: &[String]) -> String {
    let told = labels.iter().filter(|label| varying.contains(&label.heading));
    let text = |label: &Label| if label.is_text() { &label.cell } else { &label.caption }.clone();
    told.map(text).collect::<Vec<_>>().join(", ")
}
