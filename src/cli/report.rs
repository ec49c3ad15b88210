//! `courant report`.

use super::output::print;
use super::progress::Bar;
use super::{Failure, Outcome};
use clap::{Args, ValueEnum};
use courant::reports::cha_whitworth2003;
use courant::reports::ferrari2008::{self, Detail, Table1};
use courant::reports::page::Item;
use courant::reports::part::{Stage, publish};
use courant::reports::publish::OutputDirectory;
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::Mutex;

/// The papers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Paper {
    /// Cha & Whitworth 2003.
    #[value(name = "cha-whitworth2003")]
    ChaWhitworth2003,
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
    /// Coarse grids and short studies: a first look, in seconds.
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Long studies at their full sizes: minutes.
    #[arg(long)]
    full: bool,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let output = OutputDirectory::open(&arguments.out)?;
    let detail = match (arguments.quick, arguments.full) {
        (true, _) => Detail::Quick,
        (_, true) => Detail::Full,
        _ => Detail::Standard,
    };
    let table = Table1::compute();
    if arguments.paper != Paper::ChaWhitworth2003 {
        // The tables come first: they are there before the figures are drawn.
        let mut text = String::new();
        for item in table.tables() {
            if let Item::Table { table, .. } = item {
                text.push_str(&format!("{}\n", table.to_text()));
            }
        }
        print(&format!("{text}{}\n\n", wrapped(&table.explanation())))?;
    }
    let mut papers = Vec::new();
    if arguments.paper != Paper::ChaWhitworth2003 {
        papers.push(("ferrari2008", "Ferrari et al. 2008", ferrari2008::parts(table, detail)));
    }
    if arguments.paper != Paper::Ferrari2008 {
        let parts = cha_whitworth2003::parts(detail);
        papers.push(("cha-whitworth2003", "Cha & Whitworth 2003", parts));
    }
    let progress = PartProgress::new(papers.iter().map(|(_, _, parts)| parts.len()).sum());
    let pages: Result<Vec<(usize, PathBuf)>, Failure> = papers
        .into_par_iter()
        .map(|(name, paper, parts)| {
            let output = match arguments.paper {
                Paper::All => OutputDirectory::open(&output.path().join(name))?,
                _ => output.clone(),
            };
            let title = format!("courant: a report on {paper}");
            let watch = |part, stage| progress.follow(part, stage);
            Ok((publish(parts, &title, &output, &watch)?, output.path().join("index.html")))
        })
        .collect();
    progress.bar.finish();
    let pages = pages?;
    for (files, index) in &pages {
        print(&format!("{files} files written; open {}\n", index.display()))?;
    }
    if arguments.paper == Paper::All { write_contents(&output) } else { Ok(Outcome::Yes) }
}

/// One bar for all parts, with the names of those that are being made; a line for each where nobody sees a bar.
struct PartProgress {
    bar: Bar,
    count: usize,
    /// The parts being made, and how many are finished.
    state: Mutex<(Vec<&'static str>, usize)>,
}

impl PartProgress {
    fn new(count: usize) -> Self {
        Self { bar: Bar::new("report"), count, state: Mutex::default() }
    }

    fn follow(&self, part: &'static str, stage: Stage) {
        let mut state = self.state.lock().expect("no thread panics while it tells its part");
        let (making, finished) = &mut *state;
        match stage {
            Stage::Begun => making.push(part),
            Stage::Finished(time) => {
                making.retain(|other| *other != part);
                *finished += 1;
                if self.bar.is_hidden() {
                    // Who reads no lines still gets the files.
                    let _ = print(&format!("{part}: {:.1} s\n", time.as_secs_f64()));
                }
            }
        }
        let _ = self.bar.advance(*finished, self.count);
        self.bar.doing(making.join(", "));
    }
}

/// The page that links the papers' pages.
fn write_contents(output: &OutputDirectory) -> Result<Outcome, Failure> {
    let papers = [
        ("Ferrari, Dumbser, Toro & Armanini 2008", "ferrari2008"),
        ("Cha & Whitworth 2003", "cha-whitworth2003"),
    ];
    let markdown: String =
        papers.iter().map(|(title, place)| format!("- [{title}]({place}/index.md)\n")).collect();
    let html: String = papers
        .iter()
        .map(|(title, place)| {
            let title = title.replace('&', "&amp;");
            format!("<li><a href=\"{place}/index.html\">{title}</a></li>\n")
        })
        .collect();
    output.write("index.md", format!("# courant: reports\n\n{markdown}").as_bytes())?;
    let page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>courant: reports</title>\n\
         <h1>courant: reports</h1>\n<ul>\n{html}</ul>\n</html>\n"
    );
    let path = output.write("index.html", page.as_bytes())?;
    print(&format!("all papers: open {}\n", path.display()))
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
