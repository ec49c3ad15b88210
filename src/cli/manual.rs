//! `courant man`.

use super::output::{print, print_bytes};
use super::{Failure, Outcome, names};
use clap::{Args, Command};
use courant::reports::publish::OutputDirectory;
use std::io::IsTerminal;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Arguments {
    /// The command whose page is wanted (default: the page of the program): for reading on a terminal, in roff elsewhere.
    #[arg(value_name = "COMMAND", conflicts_with = "out")]
    page: Option<String>,
    /// Write every page to this directory: courant.1, courant-limits.1, …
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run(arguments: &Arguments, mut program: Command) -> Result<Outcome, Failure> {
    // No page speaks of a page that is not there; building names the others `courant-limits` and so on.
    program = program.disable_help_subcommand(true);
    program.build();
    if let Some(out) = &arguments.out {
        let output = OutputDirectory::open(out)?;
        let mut text = String::new();
        for command in std::iter::once(&program).chain(program.get_subcommands()) {
            let path = output.write(&format!("{}.1", title(command)), &page(command)?)?;
            text.push_str(&format!("{}\n", path.display()));
        }
        return print(&text);
    }
    let command = match &arguments.page {
        None => &program,
        Some(name) => program.find_subcommand(name).ok_or_else(|| {
            let all: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
            Failure::Message(format!("COMMAND {name}: {}", names::unknown("command", name, &all)))
        })?,
    };
    match std::io::stdout().is_terminal() {
        true => print(&rendered(command)),
        false => print_bytes(&page(command)?),
    }
}

/// A page as a terminal shows it: no formatter is called, which may not be there.
fn rendered(command: &Command) -> String {
    format!("{}(1)\n\n{}", title(command), command.clone().render_long_help().ansi())
}

fn title(command: &Command) -> String {
    command.get_display_name().unwrap_or(command.get_name()).into()
}

fn page(command: &Command) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    clap_mangen::Man::new(command.clone())
        .title(title(command))
        .source(concat!("courant ", env!("CARGO_PKG_VERSION")))
        .render(&mut page)?;
    Ok(page)
}
