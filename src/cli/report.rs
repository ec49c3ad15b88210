//! `courant report`.

use super::output::print;
use super::progress::Bar;
use super::{Failure, Outcome};
use clap::{Args, ValueEnum};
use courant::reports::ferrari2008::{self, Detail, Table1};
use courant::reports::page::Page;
use courant::reports::publish::OutputDirectory;
use std::path::PathBuf;

/// The papers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Paper {
    /// Ferrari, Dumbser, Toro & Armanini 2008.
    Ferrari2008,
    /// Every paper.
    All,
}

#[derive(Debug, Args)]
pub struct Arguments {
    /// Which paper.
    #[arg(value_enum, default_value = "all")]
    paper: Paper,
    /// Directory for the files.
    #[arg(long, default_value = "courant-out")]
    out: PathBuf,
    /// Coarse grids: a quick look.
    #[arg(long)]
    quick: bool,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let output = OutputDirectory::open(&arguments.out)?;
    let detail = if arguments.quick { Detail::Quick } else { Detail::Full };
    let table = Table1::compute();
    // The tables come first: they are there before the figures are drawn.
    let mut text = String::new();
    for table in [table.exact_table(), table.published_table(), table.difference_table()] {
        text.push_str(&format!("{}\n", table.to_text()));
    }
    print(&format!("{text}{}\n\n", wrapped(&table.explanation())))?;
    let bar = Bar::new("report");
    let sections = ferrari2008::sections(&table, detail, &|done, all| bar.advance(done, all))
        .map_err(|error| Failure::Message(error.to_string()))?;
    bar.finish();
    let page = Page { title: "courant: a report on Ferrari et al. 2008".into(), sections };
    let files = page.write(&output)?;
    let index = output.path().join("index.html");
    print(&format!("{files} files written; open {}\n", index.display()))
}

/// Text broken at spaces before column 100.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last_mut().expect("there is a line");
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= 100 {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.push(word.into());
        }
    }
    lines.join("\n")
}
