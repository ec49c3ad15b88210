//! The words of a report, as data: what each table and figure is called, shows and says, with places for numbers.
//!
//! ```
//! use courant_reports::paper_text::{PaperText, cells, words};
//! use courant_reports::page::Item;
//! let text = PaperText::from_toml(r#"
//!     command = "courant report example"
//!     [paper]
//!     name = "example"
//!     title = "An example"
//!     citation = "Somebody: Something, Somewhere 1 (2000)"
//!     summary = "It shows errors."
//!     [[item]]
//!     name = "errors"
//!     description = "errors of every run"
//!     source = "Table 1"
//!     text = "Errors, {steps} steps"
//!     columns = ["@method", ">L1"]
//! "#)?;
//! let item = text.table("errors", words!["steps" = 100], [cells!["gph3", 0.25]]);
//! let Item::Table { table, .. } = item else { panic!("a table") };
//! assert_eq!(table.caption(), "Errors, 100 steps");
//! assert_eq!(table.to_csv(), "method,l1\ngph3,0.25\n");
//! assert!(table.to_markdown().contains("| GPH case 3 | 0.25 |"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::CatalogueItem;
use crate::figure::Figure;
use crate::page::{Item, Section};
use crate::table::{Align, Cell, Table};
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::AdvectionScheme;
use courant_simulation::method::Method;
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// The cells of a row, from whatever can be displayed.
#[macro_export]
macro_rules! cells {
    ($($cell:expr),* $(,)?) => { vec![$($cell.to_string()),*] };
}

/// The numbers of a text by the names of their places.
#[macro_export]
macro_rules! words {
    ($($name:literal = $value:expr),* $(,)?) => { &[$(($name, $value.to_string())),*] };
}

pub use {cells, words};

/// Numbers for the places of a text.
pub type Words<'a> = &'a [(&'a str, String)];

/// A paragraph, table or figure.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
struct ItemText {
    name: String,
    /// What it shows; items that are listed have one.
    #[serde(default)]
    description: String,
    /// The paper and its number there.
    #[serde(default)]
    source: String,
    /// The caption or the paragraph, with places for numbers in braces.
    text: String,
    /// The columns of a table; those of numbers start with `>`, those of methods, schemes and kernels by their names on the
    /// command line with `@`: people read what they are called.
    #[serde(default)]
    columns: Vec<String>,
    /// What makes it again, if not the command of the report.
    command: Option<String>,
    /// The part of the report that begins here: what makes this item and the following ones.
    part: Option<String>,
}

/// A paper that is computed again.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Paper {
    /// What it is called on the command line and in paths.
    pub name: String,
    /// The heading of its page.
    pub title: String,
    /// Authors, title and place.
    pub citation: String,
    /// Its digital object identifier, if it has one.
    pub doi: Option<String>,
    /// What its page shows.
    pub summary: String,
}

/// The words of the report on a paper, and what its studies look at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperText {
    command: String,
    /// The paper itself.
    pub paper: Paper,
    #[serde(rename = "item")]
    items: Vec<ItemText>,
    #[serde(default)]
    study: toml::Table,
}

impl PaperText {
    /// Reads the words of a report.
    ///
    /// # Errors
    /// When the text is no such file.
    pub fn from_toml(text: &str) -> Result<Self, toml::de::Error> {
        toml::from_str(text)
    }

    /// The tables and figures by name.
    pub fn catalogue(&self) -> impl Iterator<Item = CatalogueItem<'_>> {
        let listed = self.items.iter().filter(|item| !item.description.is_empty());
        listed.map(|item| CatalogueItem {
            name: &item.name,
            description: &item.description,
            source: &item.source,
        })
    }

    /// The name of the part of the report that makes an item.
    pub fn part_of(&self, name: &str) -> Option<&str> {
        let until = self.items.iter().position(|item| item.name == name)?;
        self.items[..=until].iter().rev().find_map(|item| item.part.as_deref())
    }

    /// What a study looks at: the table `[study.NAME]`.
    ///
    /// # Panics
    /// When it is not there or not what the study needs: a fault of the report.
    pub fn plan<T: DeserializeOwned>(&self, study: &str) -> T {
        let table = self.study.get(study).cloned();
        let table = table.unwrap_or_else(|| panic!("the report has no plan of `{study}`"));
        table.try_into().unwrap_or_else(|error| panic!("the plan of `{study}`: {error}"))
    }

    fn item(&self, name: &str) -> &ItemText {
        let found = self.items.iter().find(|item| item.name == name);
        found.unwrap_or_else(|| panic!("the report has no words for `{name}`"))
    }

    /// A text with its numbers in their places.
    ///
    /// # Panics
    /// When the report has no such text or a place has no number: a fault of the report.
    pub fn text(&self, name: &str, words: Words<'_>) -> String {
        let text = words.iter().fold(self.item(name).text.clone(), |text, (place, word)| {
            let filled = text.replace(&format!("{{{place}}}"), word);
            assert!(filled != text || text.contains(word), "`{name}` has no place `{place}`");
            filled
        });
        assert!(!text.contains('{'), "a place of `{name}` has no number: {text}");
        text
    }

    /// A section by the text that is its title.
    pub fn section(&self, title: &str, items: Vec<Item>) -> Section {
        Section { title: self.text(title, &[]), items }
    }

    /// A paragraph.
    pub fn paragraph(&self, name: &str, words: Words<'_>) -> Item {
        Item::Paragraph(self.text(name, words))
    }

    /// A table.
    pub fn table<C: Into<Cell>>(
        &self,
        name: &str,
        words: Words<'_>,
        rows: impl IntoIterator<Item = Vec<C>>,
    ) -> Item {
        self.wide_table(name, words, &[], rows)
    }

    /// A table whose columns of numbers depend on the report: they take the place of the column `>{…}`.
    pub fn wide_table<C: Into<Cell>>(
        &self,
        name: &str,
        words: Words<'_>,
        numbers: &[String],
        rows: impl IntoIterator<Item = Vec<C>>,
    ) -> Item {
        let item = self.item(name);
        let mut columns: Vec<(&str, Align)> = Vec::new();
        let mut named = Vec::new();
        for column in &item.columns {
            match column.split_at_checked(1) {
                Some((">", "{…}")) => {
                    columns.extend(numbers.iter().map(|name| (name.as_str(), Align::Right)));
                }
                Some((">", number)) => columns.push((number, Align::Right)),
                Some(("@", what)) => {
                    named.push(columns.len());
                    columns.push((what, Align::Left));
                }
                _ => columns.push((column, Align::Left)),
            }
        }
        let mut table = Table::new(self.text(name, words), &columns);
        for row in rows {
            table.push(row.into_iter().enumerate().map(|(index, cell)| {
                let cell: Cell = cell.into();
                if named.contains(&index) { with_title(cell) } else { cell }
            }));
        }
        Item::Table { name: name.into(), table, command: self.command_of(item) }
    }

    /// A figure with the data behind it.
    pub fn figure(
        &self,
        name: &str,
        words: Words<'_>,
        figure: Figure,
        data: Vec<(String, Vec<u8>)>,
    ) -> Item {
        Item::Figure {
            name: name.into(),
            figure: Box::new(figure),
            caption: self.text(name, words),
            data,
            command: self.command_of(self.item(name)),
        }
    }

    fn command_of(&self, item: &ItemText) -> String {
        item.command.as_ref().unwrap_or(&self.command).clone()
    }
}

/// A method, scheme or kernel as people call it; what stands behind a comma stays.
fn with_title(cell: Cell) -> Cell {
    let (name, rest) = match cell.machine().split_once(',') {
        Some((name, rest)) => (name, format!(",{rest}")),
        None => (cell.machine(), String::new()),
    };
    let method = Method::named(name).map(|method| method.title());
    let scheme = || name.parse().ok().map(AdvectionScheme::title);
    let kernel = || name.parse().ok().map(Kernel::title);
    match method.or_else(scheme).or_else(kernel) {
        Some(title) => {
            let called = format!("{title}{rest}");
            cell.called(called)
        }
        None => cell,
    }
}

/// The lines of a file of comma-separated values.
pub fn csv(header: &str, rows: impl IntoIterator<Item = Vec<String>>) -> Vec<u8> {
    let lines = rows.into_iter().map(|row| row.join(",") + "\n");
    format!("{header}\n{}", lines.collect::<String>()).into_bytes()
}

/// A value in significant digits, or a dash.
pub fn or_dash(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".into(), |value| crate::number::significant(value, digits))
}
