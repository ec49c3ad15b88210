//! `courant map --x … --y …`: any scheme over two of its parameters.

use super::{Arguments, MAX_POINTS};
use crate::cli::progress::Bar;
use crate::cli::subject::{Defaults, Subject, SubjectError};
use crate::cli::{Failure, Outcome, numbers};
use courant::analysis::scheme::catalogue;
use courant::analysis::stability::SearchPlan;
use courant::analysis::waves::sweep::SweepError;
use courant::reports::plane_map::{PlaneAxis, plane_map};
use courant::reports::publish::OutputDirectory;
use courant::reports::subject::shown;

/// The longest name of a file before its axes.
const LONGEST_STEM: usize = 60;

fn refuse(message: impl Into<String>) -> Failure {
    Failure::Message(message.into())
}

pub fn run(arguments: &Arguments, x: &PlaneAxis, y: &PlaneAxis) -> Result<Outcome, Failure> {
    let subjects = arguments.subject.subjects(&Defaults::default())?;
    for (option, axis) in [("--x", x), ("--y", y)] {
        numbers::axis(&numbers::Names(axis.values.clone()))
            .map_err(|problem| refuse(format!("{option} {}: {problem}", axis.name)))?;
    }
    // Stability is decided from 0 on.
    for value in &y.values {
        numbers::from_zero(value.clone())
            .map_err(|problem| refuse(format!("--y {} = {}: {problem}", y.name, shown(value))))?;
    }
    if x.name == y.name {
        return Err(refuse(format!("--y {}: it is the parameter of --x", y.name)));
    }
    let points = x.values.len() * y.values.len();
    if points > MAX_POINTS {
        return Err(refuse(format!(
            "--x and --y: the map would have {points} points; at most {MAX_POINTS} are accepted"
        )));
    }
    // All of them before the first is written.
    let bar = Bar::new("map");
    let mut maps = Vec::new();
    for (index, subject) in subjects.iter().enumerate() {
        let step = subject.plane([&x.name, &y.name]).map_err(|error| match error.unknown() {
            Some(problem) => {
                let (option, name) = match &error {
                    SubjectError::UnknownParameter { name, .. } if *name == x.name => ("--x", name),
                    _ => ("--y", &y.name),
                };
                refuse(format!("{option} {name}: {problem}"))
            }
            None => error.into(),
        })?;
        let progress =
            |done: usize, all: usize| bar.advance(index * all + done, all * subjects.len());
        let map = plane_map(&step, x.clone(), y.clone(), &SearchPlan::default(), &progress)
            .map_err(|error| match error {
                SweepError::Scheme(error) => subject.failure(error).into(),
                other => refuse(other.to_string()),
            })?;
        maps.push((subject, map));
    }
    bar.finish();
    let output = OutputDirectory::open(&arguments.out)?;
    for (subject, map) in maps {
        let title: Vec<String> = subject.labels().into_iter().map(|label| label.caption).collect();
        let stem = format!("map_{}_{}_{}", stem(subject), x.name, y.name);
        super::write(
            &output,
            &stem,
            || Ok(map.figure(&title.join(", "))?),
            || map.data_files(&stem),
        )?;
    }
    Ok(Outcome::Yes)
}

/// A name for files. What is not from the catalogue, or was cut, carries a number made of its whole text.
fn stem(subject: &Subject) -> String {
    let file = &*subject.file;
    let mut catalogues =
        [catalogue::schemes(), catalogue::spaces(), catalogue::methods()].into_iter().flatten();
    let known = catalogues.any(|one| one == file);
    let words: Vec<String> = subject.labels().into_iter().map(|label| label.cell).collect();
    let plain = |c: char| if c.is_ascii_alphanumeric() || "-.".contains(c) { c } else { '_' };
    let text: String = words.join("_").chars().map(plain).collect();
    let short = text.split('_').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_");
    if known && short.len() <= LONGEST_STEM {
        return short;
    }
    // Fowler, Noll & Vo's hash: the same in every run of every version.
    let whole = format!("{} {}", words.join("\n"), file.equations.text);
    let hash = whole
        .bytes()
        .fold(0x811c_9dc5_u32, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193));
    format!("{}_{hash:08x}", &short[..short.len().min(LONGEST_STEM)])
}
