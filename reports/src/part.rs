//! The parts of a report: made side by side, written as they are finished, in the order of their page.

use crate::page::{About, Page, Section};
use crate::publish::OutputDirectory;
use crate::report::ReportError;
use rayon::prelude::*;
use std::time::{Duration, Instant};

type Make = dyn FnOnce() -> Result<Vec<Section>, ReportError> + Send;

/// Sections that are made together.
pub struct Part {
    /// What is being made, for whoever waits.
    pub name: &'static str,
    make: Box<Make>,
}

impl Part {
    /// A part that is made when its turn comes.
    pub fn new(
        name: &'static str,
        make: impl FnOnce() -> Result<Vec<Section>, ReportError> + Send + 'static,
    ) -> Self {
        Self { name, make: Box::new(make) }
    }
}

/// What whoever waits is told of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Work on it begins.
    Begun,
    /// Its files are written, so long after it was begun.
    Finished(Duration),
}

/// Makes a page of its parts, as many at a time as there are threads, and returns it with the number of its files. The
/// files of a part are written when it is finished: who interrupts the work keeps them. The index comes last, so that it
/// never names a file that is not there; what is written does not depend on the number of threads.
///
/// With names in `only`, nothing but the files of these items is written.
///
/// # Errors
/// When a part cannot be made or a file cannot be written.
pub fn publish(
    parts: Vec<Part>,
    about: About,
    only: &[&str],
    output: &OutputDirectory,
    watch: &(dyn Fn(&'static str, Stage) + Sync),
) -> Result<(Page, usize), ReportError> {
    let made = parts.into_par_iter().with_max_len(1).map(|Part { name, make }| {
        watch(name, Stage::Begun);
        let start = Instant::now();
        let mut sections = make()?;
        let mut count = 0;
        for section in &mut sections {
            if !only.is_empty() {
                section.items.retain(|item| item.name().is_some_and(|name| only.contains(&name)));
            }
            for (file, bytes) in section.files()? {
                output.write(&file, &bytes)?;
                count += 1;
            }
        }
        watch(name, Stage::Finished(start.elapsed()));
        Ok((sections, count))
    });
    let made: Vec<(Vec<Section>, usize)> = made.collect::<Result<_, ReportError>>()?;
    let files: usize = made.iter().map(|(_, count)| count).sum();
    let sections = made.into_iter().flat_map(|(sections, _)| sections).collect();
    let page = Page { about, sections };
    if !only.is_empty() {
        return Ok((page, files));
    }
    output.write("index.md", page.to_markdown().as_bytes())?;
    output.write("index.html", page.to_html().as_bytes())?;
    Ok((page, files + 2))
}
