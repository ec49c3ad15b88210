//! A report: sections of tables and figures, written as `index.html` and `index.md` with every file
//! they show.

mod html;

use crate::figure::{Figure, FigureError};
use crate::paper_text::Paper;
use crate::table::Table;
use rayon::prelude::*;
use std::time::{SystemTime, UNIX_EPOCH};

/// One thing a report shows.
#[derive(Debug, Clone)]
pub enum Item {
    /// Text.
    Paragraph(String),
    /// A table; written as CSV, LaTeX and Markdown beside the page.
    Table {
        /// The file name without extension.
        name: String,
        /// The table.
        table: Table,
        /// The command that makes it again.
        command: String,
    },
    /// A figure; written as PNG and SVG beside the page.
    Figure {
        /// The file name without extension.
        name: String,
        /// The picture.
        figure: Box<Figure>,
        /// What is seen.
        caption: String,
        /// The data behind it: file names with their contents.
        data: Vec<(String, Vec<u8>)>,
        /// The command that makes it again.
        command: String,
    },
}

impl Item {
    /// The item with another command that makes it again.
    pub fn made_by(mut self, by: String) -> Self {
        if let Self::Table { command, .. } | Self::Figure { command, .. } = &mut self {
            *command = by;
        }
        self
    }
}

/// A titled part of a report.
#[derive(Debug, Clone)]
pub struct Section {
    /// The heading.
    pub title: String,
    /// What it shows.
    pub items: Vec<Item>,
}

/// What stands at the head of a page.
#[derive(Debug, Clone)]
pub struct About {
    /// The paper.
    pub paper: Paper,
    /// The command that makes the page.
    pub command: String,
    /// The day on which it was made.
    pub date: String,
    /// Whether it is but a first look.
    pub is_quick: bool,
    /// Whether a page above it leads to others.
    pub is_one_of_several: bool,
}

/// A whole report.
#[derive(Debug, Clone)]
pub struct Page {
    /// What it is about.
    pub about: About,
    /// The sections in order.
    pub sections: Vec<Section>,
}

/// The day it is, as people write it; that of `SOURCE_DATE_EPOCH` where it is set, so that a page can be made again byte
/// for byte.
pub fn today() -> String {
    let epoch = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    date(epoch.unwrap_or_else(now) / 86_400)
}

/// The date so many days after 1 January 1970.
fn date(mut days: u64) -> String {
    const MONTHS: [(&str, u64); 12] = [
        ("January", 31),
        ("February", 28),
        ("March", 31),
        ("April", 30),
        ("May", 31),
        ("June", 30),
        ("July", 31),
        ("August", 31),
        ("September", 30),
        ("October", 31),
        ("November", 30),
        ("December", 31),
    ];
    let mut year = 1970;
    let leaps = |year: u64| {
        u64::from(year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400)))
    };
    while days >= 365 + leaps(year) {
        days -= 365 + leaps(year);
        year += 1;
    }
    for (name, length) in MONTHS {
        let length = length + if name == "February" { leaps(year) } else { 0 };
        if days < length {
            return format!("{} {name} {year}", days + 1);
        }
        days -= length;
    }
    unreachable!("what is left is less than a year")
}

/// The page that leads to the pages of several papers, as HTML and as Markdown.
pub fn index(pages: &[Page]) -> (String, String) {
    let title = "Papers computed again";
    let entry = |page: &Page| {
        let Paper { name, title, citation, summary, .. } = &page.about.paper;
        format!("## [{title}]({name}/index.md)\n\n{citation}.\n\n{summary}\n")
    };
    let entries: Vec<String> = pages.iter().map(entry).collect();
    (html::index(title, pages), format!("# {title}\n\n{}", entries.join("\n")))
}

impl Item {
    /// The name of its files; paragraphs have none.
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Paragraph(_) => None,
            Self::Table { name, .. } | Self::Figure { name, .. } => Some(name),
        }
    }
}

impl Section {
    /// The files of its tables and figures, with their contents; pictures are drawn side by side.
    ///
    /// # Errors
    /// When a figure cannot be drawn.
    pub fn files(&self) -> Result<Vec<(String, Vec<u8>)>, FigureError> {
        let files: Result<Vec<_>, FigureError> = self
            .items
            .par_iter()
            .map(|item| match item {
                Item::Paragraph(_) => Ok(Vec::new()),
                Item::Table { name, table, .. } => Ok(vec![
                    (format!("{name}.csv"), table.to_csv().into_bytes()),
                    (format!("{name}.tex"), table.to_latex().into_bytes()),
                    (format!("{name}.md"), table.to_markdown().into_bytes()),
                ]),
                Item::Figure { name, figure, data, .. } => {
                    let svg = figure.svg()?;
                    let mut files = vec![
                        (format!("{name}.png"), svg.png()?),
                        (format!("{name}.svg"), svg.0.as_bytes().into()),
                    ];
                    files.extend(data.iter().cloned());
                    Ok(files)
                }
            })
            .collect();
        Ok(files?.into_iter().flatten().collect())
    }
}

impl Page {
    /// The page as Markdown.
    pub fn to_markdown(&self) -> String {
        let About { paper, command, date, is_quick, .. } = &self.about;
        let doi =
            paper.doi.as_ref().map_or_else(String::new, |doi| format!(" <https://doi.org/{doi}>"));
        let version = env!("CARGO_PKG_VERSION");
        let mut text = format!(
            "# {}\n\n{}.{doi}\n\nMade by courant {version} on {date} with `{command}`.\n",
            paper.title, paper.citation
        );
        if *is_quick {
            text.push_str(&format!("\n**A quick look.** {QUICK}\n"));
        }
        for section in &self.sections {
            text.push_str(&format!("\n## {}\n", section.title));
            for item in &section.items {
                let link = |(label, file): (String, String)| format!("[{label}]({file})");
                let files = || links(item).into_iter().map(link).collect::<Vec<_>>().join(", ");
                let block = match item {
                    Item::Paragraph(paragraph) => format!("{paragraph}\n"),
                    Item::Table { table, command, .. } => format!(
                        "**{}**\n\n{}\nData: {}. Made by `{command}`.\n",
                        table.caption(),
                        table.to_markdown(),
                        files()
                    ),
                    Item::Figure { name, caption, command, .. } => format!(
                        "![{name}]({name}.png)\n\n{caption}\n\nData: {}. Made by `{command}`.\n",
                        files()
                    ),
                };
                text.push('\n');
                text.push_str(&block);
            }
        }
        text
    }

    /// The page as HTML.
    pub fn to_html(&self) -> String {
        html::page(self)
    }
}

/// What a quick look is.
const QUICK: &str = "Grids are coarse and studies short: numbers and pictures differ from those of the whole report.";

/// Labels and files of an item: its picture or table in every format, then its data.
fn links(item: &Item) -> Vec<(String, String)> {
    let formats = |name: &String, all: &[(&str, &str)]| -> Vec<(String, String)> {
        all.iter().map(|(label, end)| (label.to_string(), format!("{name}.{end}"))).collect()
    };
    match item {
        Item::Paragraph(_) => Vec::new(),
        Item::Table { name, .. } => {
            formats(name, &[("CSV", "csv"), ("LaTeX", "tex"), ("Markdown", "md")])
        }
        Item::Figure { name, data, .. } => {
            let mut links = formats(name, &[("PNG", "png"), ("SVG", "svg")]);
            links.extend(data.iter().map(|(file, _)| {
                let (stem, end) = file.rsplit_once('.').unwrap_or((file, "data"));
                (format!("{} ({})", stem.replace('_', " "), end.to_uppercase()), file.clone())
            }));
            links
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Axis, Panel, Series};
    use crate::part::{Part, publish};
    use crate::publish::OutputDirectory;
    use crate::table::Align;

    #[test]
    fn every_file_a_page_links_to_is_written() {
        let mut table = Table::new("T", &[("a", Align::Left)]);
        table.push(["x < y"]);
        let panel = Panel::new(Axis::linear("x"), Axis::linear("y"))
            .layer(Series::line([(0.0, 0.0), (1.0, 1.0)]));
        let section = Section {
            title: "S".into(),
            items: vec![
                Item::Paragraph("text".into()),
                Item::Table { name: "t".into(), table, command: "courant x".into() },
                Item::Figure {
                    name: "f".into(),
                    figure: Box::new(Figure::single(panel)),
                    caption: "c".into(),
                    data: vec![("f.csv".into(), b"1\n".to_vec())],
                    command: "courant y".into(),
                },
            ],
        };
        let place = tempfile::tempdir().unwrap();
        let output = OutputDirectory::open(place.path()).unwrap();
        let about = About {
            paper: Paper {
                name: "ab".into(),
                title: "A & B".into(),
                citation: "A, B: C".into(),
                doi: Some("10.1/x".into()),
                summary: "s".into(),
            },
            command: "courant report ab --quick".into(),
            date: date(0),
            is_quick: true,
            is_one_of_several: false,
        };
        let part = |section: &Section| {
            let section = section.clone();
            vec![Part::new("a part", move || Ok(vec![section]))]
        };
        let (page, count) =
            publish(part(&section), about.clone(), &[], &output, &|_, _| ()).unwrap();
        let mut files: Vec<String> = std::fs::read_dir(place.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        files.sort();
        let wanted =
            ["f.csv", "f.png", "f.svg", "index.html", "index.md", "t.csv", "t.md", "t.tex"];
        assert_eq!(files, wanted);
        assert_eq!(count, wanted.len());
        let html = std::fs::read_to_string(place.path().join("index.html")).unwrap();
        assert!(html.contains("A &amp; B") && html.contains("x &lt; y"));
        // What a reader looks for: where it is from, when it was made, what it is worth, what is in it, and no marks of
        // plain text.
        for wanted in
            ["https://doi.org/10.1/x", "1 January 1970", "A quick look", "href=\"#s\"", "id=\"s\""]
        {
            assert!(html.contains(wanted), "{wanted}");
        }
        assert!(!html.contains('`'));
        for link in html.split("href=\"").chain(html.split("src=\"")).skip(1) {
            let file = link.split_once('"').map(|(file, _)| file);
            if let Some(file) = file.filter(|file| !file.contains(['<', '#', ':'])) {
                assert!(place.path().join(file).exists(), "{file}");
            }
        }
        let (html, markdown) = index(&[page]);
        assert!(html.contains("href=\"ab/index.html#s\"") && html.contains("ab/f.png"));
        assert!(markdown.contains("(ab/index.md)"));
        // One item alone: its files and nothing else.
        let alone = tempfile::tempdir().unwrap();
        let output = OutputDirectory::open(alone.path()).unwrap();
        assert_eq!(publish(part(&section), about, &["t"], &output, &|_, _| ()).unwrap().1, 3);
        assert_eq!(std::fs::read_dir(alone.path()).unwrap().count(), 3);
    }

    #[test]
    fn dates_are_those_of_the_calendar() {
        assert_eq!(
            [0, 59, 19_782, 20_088].map(date),
            ["1 January 1970", "1 March 1970", "29 February 2024", "31 December 2024"]
        );
    }
}
