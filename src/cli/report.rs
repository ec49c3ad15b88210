//! `courant report`.

use super::output::print;
use super::progress::Bar;
use super::{Failure, Outcome};
use clap::{Args, ValueEnum};
use courant::reports::cha_whitworth2003;
use courant::reports::ferrari2008::{self, Detail, Table1};
use courant::reports::page::PageWriter;
use courant::reports::publish::OutputDirectory;
use std::path::PathBuf;

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
    /// Coarse grids: a quick look.
    #[arg(long)]
    quick: bool,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let output = OutputDirectory::open(&arguments.out)?;
    let detail = if arguments.quick { Detail::Quick } else { Detail::Full };
    match arguments.paper {
        Paper::Ferrari2008 => report_on_ferrari(&output, detail),
        Paper::ChaWhitworth2003 => report_on_cha_whitworth(&output, detail),
        Paper::All => {
            let part = |name: &str| OutputDirectory::open(&output.path().join(name));
            report_on_ferrari(&part("ferrari2008")?, detail)?;
            report_on_cha_whitworth(&part("cha-whitworth2003")?, detail)?;
            write_contents(&output)
        }
    }
}

fn report_on_ferrari(output: &OutputDirectory, detail: Detail) -> Result<Outcome, Failure> {
    let table = Table1::compute();
    // The tables come first: they are there before the figures are drawn.
    let mut text = String::new();
    for table in [table.exact_table(), table.published_table(), table.difference_table()] {
        text.push_str(&format!("{}\n", table.to_text()));
    }
    print(&format!("{text}{}\n\n", wrapped(&table.explanation())))?;
    let bar = Bar::new("Ferrari et al. 2008");
    let mut page = PageWriter::new(output, "courant: a report on Ferrari et al. 2008");
    ferrari2008::publish_sections(
        &table,
        detail,
        &|done, all| bar.advance(done, all),
        &mut |section| page.add(section),
    )?;
    bar.finish();
    finish(page, output)
}

fn report_on_cha_whitworth(output: &OutputDirectory, detail: Detail) -> Result<Outcome, Failure> {
    let bar = Bar::new("Cha & Whitworth 2003");
    let mut page = PageWriter::new(output, "courant: a report on Cha & Whitworth 2003");
    cha_whitworth2003::publish_sections(
        detail,
        &|done, all| bar.advance(done, all),
        &mut |section| page.add(section),
    )?;
    bar.finish();
    finish(page, output)
}

fn finish(page: PageWriter<'_>, output: &OutputDirectory) -> Result<Outcome, Failure> {
    let files = page.finish()?;
    let index = output.path().join("index.html");
    print(&format!("{files} files written; open {}\n", index.display()))
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
