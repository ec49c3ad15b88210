//! What a run leaves: its record, its files, and all of them in one table.

use crate::cli::Failure;
use crate::cli::output::{Format, paragraphs, print, print_records, warnings};
use courant::reports::figure::{Figure, FigureError};
use courant::reports::number::significant;
use courant::reports::publish::OutputDirectory;
use courant::reports::run_record::{RunRecord, RunReport, method_title};
use courant::reports::table::{Align, Table};
use std::path::PathBuf;

/// What a run leaves.
#[derive(Debug)]
pub struct Answer {
    /// For machines.
    pub record: RunRecord,
    /// Scene, method and settings in words.
    caption: String,
    /// Endings of the names of files, and what is in them.
    files: Vec<(&'static str, Vec<u8>)>,
    /// The options with several values, and those of this run.
    pub choices: Vec<(&'static str, String)>,
    written: Vec<PathBuf>,
}

impl Answer {
    /// The answer of a run: its pictures are made, where there is something to see.
    pub fn new(report: RunReport) -> Result<Self, Failure> {
        let RunReport { record, caption, mut files, figure } = report;
        let json = serde_json::to_string_pretty(&record)
            .map_err(|error| Failure::Message(error.to_string()))?;
        files.push((".json", format!("{json}\n").into_bytes()));
        let drawn = |figure: Figure| {
            let svg = figure.svg()?;
            Ok::<_, FigureError>([(".png", svg.png()?), (".svg", svg.0.as_bytes().into())])
        };
        match figure.map(drawn) {
            Some(Ok(pictures)) => files.extend(pictures),
            Some(Err(error)) if record.completed => return Err(error.into()),
            // A state that is not finite has no picture; the table of it is still there.
            Some(Err(_)) | None => {}
        }
        Ok(Self { record, caption, files, choices: Vec::new(), written: Vec::new() })
    }

    /// What it says to people, where it is the only one.
    fn table(&self) -> Table {
        let mut table = Table::new(self.caption.as_str(), &[("", Align::Left), ("", Align::Right)]);
        for row in self.record.rows() {
            table.push(row);
        }
        table
    }

    /// Writes the files: scene, method and what else is told apart are in their names.
    pub fn write(&mut self, output: &OutputDirectory) -> Result<(), Failure> {
        let run = &self.record;
        let mut stem = format!("{}_{}", run.scene, run.method);
        for (option, value) in self.own_choices() {
            stem.push_str(&format!("_{option}-{value}"));
        }
        let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' };
        let stem: String = stem.chars().map(plain).collect();
        for (ending, bytes) in std::mem::take(&mut self.files) {
            self.written.push(output.write(&format!("{stem}{ending}"), &bytes)?);
        }
        Ok(())
    }

    /// The choices that scene and method do not tell.
    fn own_choices(&self) -> impl Iterator<Item = &(&'static str, String)> {
        self.choices.iter().filter(|(option, _)| !["scene", "method"].contains(option))
    }
}

/// Prints one answer line by line, several as rows.
pub fn show(answers: &[Answer], format: Format) -> Result<(), Failure> {
    let records: Vec<&RunRecord> = answers.iter().map(|answer| &answer.record).collect();
    let rows = match answers {
        [one] => &one.table(),
        several => &rows_table(several),
    };
    print_records("run", &records, rows, format)?;
    if format != Format::Table {
        return Ok(());
    }
    let mut said: Vec<String> = Vec::new();
    for answer in answers {
        let name = |(option, value): &(&str, String)| match *option {
            "scene" | "method" => value.clone(),
            _ => format!("{option} {value}"),
        };
        let names: Vec<String> = answer.choices.iter().map(name).collect();
        let of = if names.is_empty() { String::new() } else { names.join(", ") + ": " };
        let run = &answer.record;
        let failure = run.failure.iter().filter(|_| answers.len() > 1);
        said.extend(failure.map(|why| format!("{of}broke down: {why}")));
        said.extend(run.warnings.iter().map(|warning| format!("{of}{warning}")));
    }
    print(&warnings(&said))?;
    let written: Vec<&PathBuf> = answers.iter().flat_map(|answer| &answer.written).collect();
    let lines: Vec<String> = match (answers, written.as_slice()) {
        ([_], files) => files.iter().map(|path| format!("wrote {}", path.display())).collect(),
        (_, [first, ..]) => {
            let place = first.parent().unwrap_or(first);
            vec![format!("wrote {} files to {}", written.len(), place.display())]
        }
        (_, []) => Vec::new(),
    };
    match lines.is_empty() {
        true => Ok(()),
        false => print(&paragraphs(&lines)).map(|_| ()),
    }
}

/// One row a run: what was chosen, and what it found; columns that no run has are not there.
fn rows_table(answers: &[Answer]) -> Table {
    let rows: Vec<Row> = answers.iter().map(row).collect();
    let mut columns: Vec<(&str, Align)> = Vec::new();
    for (name, _, align) in rows.iter().flatten() {
        if !columns.iter().any(|(known, _)| known == name) {
            columns.push((name, *align));
        }
    }
    let first = &answers[0].record;
    let varies = |option| answers[0].choices.iter().any(|(one, _)| *one == option);
    let caption = [
        Some(first.scene.clone()).filter(|_| !varies("scene")),
        Some(method_title(&first.method)).filter(|_| !varies("method")),
        Some(format!("{} runs", answers.len())),
    ];
    let caption: Vec<String> = caption.into_iter().flatten().collect();
    let keys = columns.iter().take_while(|(name, _)| *name != "steps").count();
    let mut table = Table::new(caption.join(", "), &columns).keyed(keys);
    for row in &rows {
        table.push(columns.iter().map(|(name, _)| {
            let cell = row.iter().find(|(known, ..)| known == name);
            cell.map_or_else(|| "–".to_string(), |(_, value, _)| value.clone())
        }));
    }
    table
}

/// Headings and cells of a run.
type Row = Vec<(String, String, Align)>;

fn row(answer: &Answer) -> Row {
    let run = &answer.record;
    let mut cells = Row::new();
    // The record has these, of every run.
    let own = |(option, _): &&(&str, String)| !["particles", "time"].contains(option);
    for (option, value) in answer.choices.iter().filter(own) {
        let is_number = value.starts_with(|c: char| c.is_ascii_digit());
        let align = if is_number { Align::Right } else { Align::Left };
        let shown = if *option == "method" { method_title(value) } else { value.clone() };
        cells.push(((*option).into(), shown, align));
    }
    let mut add = |name: &str, value: String| cells.push((name.into(), value, Align::Right));
    add("particles", run.particles.to_string());
    add("time", significant(run.time, 5));
    add("steps", run.steps.to_string());
    let norms = [
        ("L1", run.l1.value),
        ("L1 density", run.l1.density),
        ("L1 velocity", run.l1.velocity),
        ("L1 pressure", run.l1.pressure),
        ("L1 energy", run.l1.energy),
    ];
    let measures = run.measures.iter().map(|(name, value)| (*name, *value));
    for (name, value) in norms.into_iter().chain(measures) {
        if let Some(value) = value {
            add(&name.replace('_', " "), significant(value, 4));
        }
    }
    add("seconds", significant(run.wall_seconds, 3));
    cells
}
