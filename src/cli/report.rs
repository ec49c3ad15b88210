//! `courant report`.

use super::output::print;
use super::progress::Bar;
use super::{Failure, Outcome, names};
use clap::{Args, ValueEnum};
use courant::reports::cha_whitworth2003;
use courant::reports::ferrari2008::{self, Table1};
use courant::reports::page::{About, Item, Page, index, today};
use courant::reports::paper_text::PaperText;
use courant::reports::part::{Part, Stage, publish};
use courant::reports::publish::OutputDirectory;
use courant::reports::report::Detail;
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
    /// Nothing but these tables and figures, by their names in `courant list figures`: figure_01, …
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    only: Vec<String>,
}

/// One paper of those asked for.
struct Asked {
    text: &'static PaperText,
    parts: Vec<Part>,
    only: Vec<&'static str>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let detail = match (arguments.quick, arguments.full) {
        (true, _) => Detail::Quick,
        (_, true) => Detail::Full,
        _ => Detail::Standard,
    };
    let only = items(arguments)?;
    let output = OutputDirectory::open(&arguments.out)?;
    // A first look does not overwrite what took longer.
    let output = if arguments.quick { output.below("quick") } else { output };
    let table = Table1::compute();
    if only.is_empty() && arguments.paper != Paper::ChaWhitworth2003 {
        // The tables come first: they are there before the figures are drawn.
        let mut text = String::new();
        for item in table.tables() {
            if let Item::Table { table, .. } = item {
                text.push_str(&format!("{}\n", table.to_text()));
            }
        }
        print(&format!("{text}{}\n\n", wrapped(&table.explanation())))?;
    }
    let parts = [ferrari2008::parts(table, detail), cha_whitworth2003::parts(detail)];
    let papers = arguments.paper.texts().into_iter().zip(parts).filter_map(|(text, mut parts)| {
        let text = text?;
        let of_paper = only.iter().filter(|(paper, _)| *paper == text.paper.name);
        let names: Vec<&str> = of_paper.map(|(_, name)| *name).collect();
        if !only.is_empty() {
            parts.retain(|part| names.iter().any(|name| text.part_of(name) == Some(part.name)));
        }
        (!parts.is_empty()).then_some(Asked { text, parts, only: names })
    });
    let papers: Vec<Asked> = papers.collect();
    let progress = PartProgress::new(papers.iter().map(|asked| asked.parts.len()).sum());
    let pages: Result<Vec<(Page, usize)>, Failure> = papers
        .into_par_iter()
        .map(|Asked { text, parts, only }| {
            let about = About {
                paper: text.paper.clone(),
                command: command(arguments),
                date: today(),
                is_quick: arguments.quick,
                is_one_of_several: arguments.paper == Paper::All,
            };
            let place = place(arguments, &output, text);
            let watch = |part, stage| progress.follow(part, stage);
            Ok(publish(parts, about, &only, &place, &watch)?)
        })
        .collect();
    progress.bar.finish();
    let pages = pages?;
    for (page, files) in &pages {
        let place = if arguments.paper == Paper::All {
            output.below(&page.about.paper.name)
        } else {
            output.clone()
        };
        let index = place.path().join("index.html");
        print(&match only.is_empty() {
            true => format!("{files} files written; open {}\n", index.display()),
            false => format!("{files} files written in {}\n", place.path().display()),
        })?;
    }
    if arguments.paper != Paper::All || !only.is_empty() {
        return Ok(Outcome::Yes);
    }
    let pages: Vec<Page> = pages.into_iter().map(|(page, _)| page).collect();
    let (html, markdown) = index(&pages);
    output.write("index.md", markdown.as_bytes())?;
    let path = output.write("index.html", html.as_bytes())?;
    print(&format!("all papers: open {}\n", path.display()))
}

impl Paper {
    /// The words of the reports asked for, in the order of all papers.
    fn texts(self) -> [Option<&'static PaperText>; 2] {
        [
            (self != Self::ChaWhitworth2003).then(ferrari2008::text),
            (self != Self::Ferrari2008).then(cha_whitworth2003::text),
        ]
    }
}

/// Where the files of a paper go.
fn place(arguments: &Arguments, output: &OutputDirectory, text: &PaperText) -> OutputDirectory {
    match arguments.paper {
        Paper::All => output.below(&text.paper.name),
        _ => output.clone(),
    }
}

/// The command that makes the report again.
fn command(arguments: &Arguments) -> String {
    let name = arguments
        .paper
        .to_possible_value()
        .map_or_else(String::new, |value| value.get_name().into());
    let detail = match (arguments.quick, arguments.full) {
        (true, _) => " --quick",
        (_, true) => " --full",
        _ => "",
    };
    format!("courant report {name}{detail}")
}

/// The tables and figures asked for: paper and name of each.
fn items(arguments: &Arguments) -> Result<Vec<(&'static str, &'static str)>, Failure> {
    let texts = arguments.paper.texts().into_iter().flatten();
    let all: Vec<(&str, &str)> = texts
        .flat_map(|text| text.catalogue().map(|item| (text.paper.name.as_str(), item.name)))
        .collect();
    let found = arguments.only.iter().map(|wanted| {
        let named = |(paper, name): &&(&str, &str)| {
            name == wanted || wanted.split_once('/') == Some((paper, name))
        };
        let mut found: Vec<_> = all.iter().filter(named).collect();
        let full = |(paper, name): &(&str, &str)| format!("{paper}/{name}");
        match found.len() {
            1 => Ok(*found.remove(0)),
            0 => {
                let short = all.iter().map(|item| item.1.to_string());
                let known: Vec<String> = short.chain(all.iter().map(full)).collect();
                let hint = names::nearest(wanted, known.iter().map(String::as_str));
                let hint = hint.map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
                Err(Failure::Message(format!(
                    "--only: no table or figure of the report is called `{wanted}`{hint} (see courant list figures)"
                )))
            }
            _ => {
                let choices: Vec<String> = found.into_iter().map(full).collect();
                Err(Failure::Message(format!(
                    "--only: `{wanted}` is in several papers: {}",
                    choices.join(", ")
                )))
            }
        }
    });
    found.collect()
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
