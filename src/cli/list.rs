//! `courant list`.

use super::output::{Format, print, print_json, table_text};
use super::{Failure, Outcome, columns, run};
use clap::{Args, ValueEnum};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::Integrator;
use courant::analysis::scheme::catalogue::{self, SchemeFile};
use courant::reports::table::{Align, Table};
use courant::reports::{cha_whitworth2003, ferrari2008};
use serde::Serialize;

/// What can be listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Topic {
    /// Smoothing kernels.
    Kernels,
    /// Schemes that step by themselves, with their equations.
    Schemes,
    /// Spaces for the method of lines.
    Spaces,
    /// Time integrators.
    Integrators,
    /// Particle methods whose waves are judged, and methods that run scenes.
    Methods,
    /// How particles may lie.
    Lattices,
    /// Scenes to run.
    Scenes,
    /// Tables and figures of the reports.
    Figures,
}

#[derive(Debug, Args)]
pub struct Arguments {
    /// What to list (default: everything).
    topic: Option<Topic>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// One thing there is.
#[derive(Debug, Serialize)]
struct Entry {
    name: String,
    aliases: Vec<String>,
    description: String,
    /// The equations of a scheme.
    #[serde(skip_serializing_if = "Option::is_none")]
    equations: Option<String>,
    source: String,
}

impl Entry {
    fn new(name: &str, description: impl Into<String>, source: &str) -> Self {
        Self {
            name: name.into(),
            aliases: Vec::new(),
            description: description.into(),
            equations: None,
            source: source.into(),
        }
    }
}

impl From<run::Entry> for Entry {
    fn from(entry: run::Entry) -> Self {
        Self::new(entry.name, entry.description, entry.source)
    }
}

impl From<&SchemeFile> for Entry {
    fn from(file: &SchemeFile) -> Self {
        let equations = file.equations.text.trim().to_string();
        Self {
            equations: Some(equations),
            ..Self::new(&file.name, file.title.as_str(), &file.source)
        }
    }
}

impl From<&Integrator> for Entry {
    fn from(integrator: &Integrator) -> Self {
        let stages = integrator.stages();
        let plural = if stages == 1 { "" } else { "s" };
        let description = format!("{}; {stages} new evaluation{plural} a step", integrator.title);
        let aliases = integrator.aliases.clone();
        Self { aliases, ..Self::new(&integrator.name, description, &integrator.source) }
    }
}

impl From<Kernel> for Entry {
    fn from(kernel: Kernel) -> Self {
        let (support, deviation) = (kernel.support(), kernel.standard_deviation());
        let description =
            format!("{}; support {support} l, standard deviation {deviation:.4} l", kernel.title());
        let aliases = kernel.aliases().iter().map(ToString::to_string).collect();
        Self { aliases, ..Self::new(kernel.name(), description, kernel.source()) }
    }
}

impl Topic {
    fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().into())
    }

    fn entries(self) -> Vec<Entry> {
        match self {
            Self::Kernels => Kernel::ALL.into_iter().map(Entry::from).collect(),
            Self::Schemes => catalogue::schemes().iter().map(Entry::from).collect(),
            Self::Spaces => catalogue::spaces().iter().map(Entry::from).collect(),
            Self::Integrators => catalogue::integrators().iter().map(Entry::from).collect(),
            Self::Methods => {
                let waves = catalogue::methods().iter().map(Entry::from);
                waves.chain(run::methods().into_iter().map(Entry::from)).collect()
            }
            Self::Lattices => {
                vec![Entry::new("line", "equal particles along a line, one spacing apart", "")]
            }
            Self::Scenes => run::scenes().into_iter().map(Entry::from).collect(),
            Self::Figures => figures(),
        }
    }
}

/// The tables and figures, by paper and name.
fn figures() -> Vec<Entry> {
    let texts = [ferrari2008::text(), cha_whitworth2003::text()];
    let all = texts.iter().flat_map(|text| {
        text.catalogue().map(|item| {
            let name = format!("{}/{}", text.paper.name, item.name);
            Entry::new(&name, item.description, item.source)
        })
    });
    all.collect()
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let topics =
        arguments.topic.map_or_else(|| Topic::value_variants().to_vec(), |topic| vec![topic]);
    if arguments.format == Format::Json {
        let lists: serde_json::Map<String, serde_json::Value> = topics
            .iter()
            .map(|topic| {
                let entries =
                    serde_json::to_value(topic.entries()).expect("entries are plain data");
                (topic.name(), entries)
            })
            .collect();
        return print_json("list", &lists);
    }
    if arguments.format == Format::Csv {
        let columns = ["topic", "name", "also", "what", "equations", "source"].map(String::from);
        let mut table = columns::empty(&columns);
        for topic in topics {
            for entry in topic.entries() {
                let also = entry.aliases.join(";");
                // A row is a line.
                let equations = entry.equations.unwrap_or_default();
                let equations = in_a_line(&equations);
                let cells = [entry.name, also, entry.description, equations, entry.source];
                table.push([topic.name()].into_iter().chain(cells));
            }
        }
        return print(&table.to_csv());
    }
    let mut text = String::new();
    for topic in topics {
        let entries = topic.entries();
        let also = entries.iter().any(|entry| !entry.aliases.is_empty());
        let equations = entries.iter().any(|entry| entry.equations.is_some())
            && !matches!(arguments.format, Format::Table | Format::Latex);
        let columns = [
            ("name", true),
            ("also", also),
            ("what it is", true),
            ("equations", equations),
            ("source", true),
        ];
        let heads: Vec<(&str, Align)> = columns
            .iter()
            .filter(|(_, when)| *when)
            .map(|(name, _)| (*name, Align::Left))
            .collect();
        let mut table = Table::new(topic.name(), &heads);
        for entry in entries {
            let cells = [
                entry.name,
                entry.aliases.join(", "),
                entry.description,
                entry.equations.unwrap_or_default(),
                entry.source,
            ];
            let kept = cells.into_iter().zip(&columns).filter(|(_, (_, when))| *when);
            table.push(kept.map(|(cell, _)| cell));
        }
        text.push_str(&table_text(&table, arguments.format).unwrap_or_default());
        text.push('\n');
    }
    print(text.trim_end_matches('\n')).and_then(|_| print("\n"))
}

/// Equations in one line: `;` between them, nothing where a line goes on.
pub fn in_a_line(equations: &str) -> String {
    let mut text = String::new();
    for line in equations.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let goes_on = text.ends_with(['+', '-', '*', '/', '=', '(', ',']);
        let begun = text.strip_suffix('\\').map(|begun| begun.trim_end().to_string());
        match begun {
            Some(begun) => text = begun + " ",
            None if goes_on => text.push(' '),
            None if !text.is_empty() => text.push_str("; "),
            None => {}
        }
        text.push_str(line);
    }
    text
}
