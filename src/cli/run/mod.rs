//! `courant run`: one scene, one method.

mod advection;
mod boxes;
mod choices;
mod methods;
mod particle_options;
mod plan;
mod scene;

pub use methods::all as methods;

use super::output::{Format, print, print_record, warnings};
use super::progress::Bar;
use super::{Failure, Outcome, complain, names, numbers};
use clap::Args;
use courant::analysis::exact::rational::Rational;
use courant::analysis::kernel::Kernel;
use courant::reports::publish::OutputDirectory;
use courant::reports::run_record::RunReport;
use courant::reports::table::{Align, Table};
use courant::simulation::scene::AnyScene;
use plan::Plan;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Arguments {
    /// Scene: see `courant list scenes`; or a file NAME.toml of your own.
    scene: String,
    /// Method: see `courant list methods`; advection and gases have their own. Without it the method is what the
    /// file of the scene says (advection scenes: godunov-sph); where it says none it is required.
    #[arg(long)]
    method: Option<String>,
    /// Number of particles (default: the scene's own).
    #[arg(long, value_name = "N", value_parser = numbers::particles)]
    particles: Option<usize>,
    /// Kernel: see `courant list kernels` (default: the method's own).
    #[arg(long, value_parser = names::kernel)]
    kernel: Option<Kernel>,
    /// Smoothing length over particle spacing (default: the method's own).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio)]
    ratio: Option<Rational>,
    /// Courant number (default: the method's own).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::running_courant_number)]
    cfl: Option<Rational>,
    /// End time (default: the scene's own).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::running_positive)]
    time: Option<Rational>,
    #[command(flatten)]
    choices: choices::Choices,
    #[command(flatten)]
    advection: advection::Options,
    #[command(flatten)]
    boxes: boxes::Options,
    /// Directory for profile and figure.
    #[arg(long, default_value = "courant-out")]
    out: PathBuf,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// A scene or method, for listing.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The name on the command line.
    pub name: &'static str,
    /// What it is.
    pub description: &'static str,
    /// Where it comes from.
    pub source: &'static str,
}

/// Every scene.
pub fn scenes() -> Vec<Entry> {
    let own = Entry {
        name: "FILE.toml",
        description: "a scene of your own, in the format of these; a bad file is answered with the keys it needs",
        source: "docs/scenes.md",
    };
    let entry = |scene: &'static AnyScene| Entry {
        name: scene.name(),
        description: scene.description(),
        source: scene.source(),
    };
    AnyScene::all().iter().map(entry).chain([own]).collect()
}

/// A scene name as part of a file name.
fn file_stem(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' };
    name.chars().map(plain).collect()
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let plan = Plan::new(arguments, scene::load(arguments)?)?;
    // Said before it starts: the user may stop it.
    let beyond = plan.beyond_limit();
    if let Some(warning) = &beyond {
        complain(&format!("warning: {warning}\n"));
    }
    let output = OutputDirectory::open(&arguments.out)?;
    let (scene, method, end_time) = plan.names();
    let bar = Bar::new(scene);
    let report = plan.run(arguments, |time| bar.march(time, end_time))?;
    bar.finish();
    let RunReport { mut record, caption, mut files, figure } = report;
    record.warnings.extend(beyond);
    let json = serde_json::to_string_pretty(&record)
        .map_err(|error| Failure::Message(error.to_string()))?;
    files.push(("json", format!("{json}\n").into_bytes()));
    match figure.map(|figure| figure.png().and_then(|png| Ok((png, figure.svg()?)))) {
        Some(Ok((png, svg))) => files.extend([("png", png), ("svg", svg.into_bytes())]),
        Some(Err(error)) if record.completed => return Err(error.into()),
        // A state that is not finite has no picture; the table of it is still there.
        Some(Err(_)) | None => {}
    }
    let stem = format!("{}_{method}", file_stem(scene));
    let mut written = Vec::new();
    for (end, bytes) in &files {
        // A second table has a name before its ending.
        let joint = if end.contains('.') { '_' } else { '.' };
        written.push(output.write(&format!("{stem}{joint}{end}"), bytes)?.display().to_string());
    }
    let mut table = Table::new(caption, &[("", Align::Left), ("", Align::Right)]);
    for row in record.rows() {
        table.push(row);
    }
    print_record("run", &record, &table, arguments.format)?;
    if arguments.format == Format::Table {
        print(&warnings(&record.warnings))?;
        print(&format!("\n{}\n", written.join("\n")))?;
    }
    Ok(if record.completed { Outcome::Yes } else { Outcome::No })
}
