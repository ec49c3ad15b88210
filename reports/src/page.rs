//! A report: sections of tables and figures, written as `index.html` and `index.md` with every file
//! they show.

use crate::figure::{Figure, FigureError};
use crate::markup::escaped;
use crate::table::Table;
use rayon::prelude::*;

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

/// A whole report.
#[derive(Debug, Clone)]
pub struct Page {
    /// The heading of the page.
    pub title: String,
    /// The sections in order.
    pub sections: Vec<Section>,
}

const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#1a1a1a}\
h1{font-size:1.7rem}h2{font-size:1.3rem;margin-top:2.5rem;border-bottom:1px solid #ccc}\
table{border-collapse:collapse;margin:.5rem 0;font-variant-numeric:tabular-nums}\
th,td{padding:.2rem .7rem;text-align:left;border-bottom:1px solid #e2e2e2}th{border-bottom:2px solid #555}\
.number{text-align:right}img{max-width:100%;height:auto}figure{margin:1rem 0}\
figcaption,.caption{color:#333}code{background:#f3f3f3;padding:.1rem .3rem;border-radius:3px}.files{font-size:.9rem;color:#555}";

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
                    let mut files = vec![
                        (format!("{name}.png"), figure.png()?),
                        (format!("{name}.svg"), figure.svg()?.into_bytes()),
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
        let mut text = format!("# {}\n", self.title);
        for section in &self.sections {
            text.push_str(&format!("\n## {}\n", section.title));
            for item in &section.items {
                let block = match item {
                    Item::Paragraph(paragraph) => format!("{paragraph}\n"),
                    Item::Table { name, table, command } => format!(
                        "**{}**\n\n{}\nData: [CSV]({name}.csv), [LaTeX]({name}.tex). Made by `{command}`.\n",
                        table.caption(),
                        table.to_markdown()
                    ),
                    Item::Figure { name, caption, data, command, .. } => format!(
                        "![{caption}]({name}.png)\n\n{caption}\n\n{}. Made by `{command}`.\n",
                        links(name, data)
                            .map(|(label, file)| format!("[{label}]({file})"))
                            .collect::<Vec<_>>()
                            .join(", ")
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
        let title = escaped(&self.title);
        let mut text = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
        );
        for section in &self.sections {
            text.push_str(&format!("<h2>{}</h2>\n", escaped(&section.title)));
            for item in &section.items {
                text.push_str(&match item {
                    Item::Paragraph(paragraph) => format!("<p>{}</p>\n", escaped(paragraph)),
                    Item::Table { name, table, command } => format!(
                        "<p class=\"caption\"><strong>{}</strong></p>\n{}<p class=\"files\">Data: \
                         <a href=\"{name}.csv\">CSV</a>, <a href=\"{name}.tex\">LaTeX</a>. Made by <code>{}</code>.</p>\n",
                        escaped(table.caption()),
                        table.to_html(),
                        escaped(command)
                    ),
                    Item::Figure { name, caption, data, command, .. } => format!(
                        "<figure>\n<a href=\"{name}.svg\"><img src=\"{name}.png\" alt=\"{0}\"></a>\n\
                         <figcaption>{0}</figcaption>\n<p class=\"files\">{1}. Made by <code>{2}</code>.</p>\n</figure>\n",
                        escaped(caption),
                        links(name, data)
                            .map(|(label, file)| format!("<a href=\"{file}\">{label}</a>"))
                            .collect::<Vec<_>>()
                            .join(", "),
                        escaped(command)
                    ),
                });
            }
        }
        text.push_str("</body>\n</html>\n");
        text
    }
}

/// Labels and files of a figure: the picture in both formats, then its data.
fn links<'a>(
    name: &'a str,
    data: &'a [(String, Vec<u8>)],
) -> impl Iterator<Item = (String, String)> + 'a {
    let pictures = [("PNG", "png"), ("SVG", "svg")]
        .map(|(label, end)| (label.into(), format!("{name}.{end}")));
    pictures.into_iter().chain(data.iter().map(|(file, _)| (file.clone(), file.clone())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Axis, Line, Panel};
    use crate::part::{Part, publish};
    use crate::publish::OutputDirectory;
    use crate::table::Align;

    #[test]
    fn every_file_a_page_links_to_is_written() {
        let mut table = Table::new("T", &[("a", Align::Left)]);
        table.push(["x < y"]);
        let panel = Panel::new(Axis::linear("x"), Axis::linear("y"))
            .layer(Line::new([(0.0, 0.0), (1.0, 1.0)]));
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
        let parts = vec![Part::new("a part", move || Ok(vec![section]))];
        let count = publish(parts, "A & B", &output, &|_, _| ()).unwrap();
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
        for link in html.split("href=\"").chain(html.split("src=\"")).skip(1) {
            if let Some((file, _)) = link.split_once('"').filter(|(file, _)| !file.contains('<')) {
                assert!(place.path().join(file).exists(), "{file}");
            }
        }
    }
}
