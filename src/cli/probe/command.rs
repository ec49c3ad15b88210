//! The user's program: one state in, one new level out.

use courant::analysis::scheme::measurement::StateLayout;
use courant::reports::npy::NpyArray;
use std::fs::File;
use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// How often a running program is looked at.
const LOOK: Duration = Duration::from_millis(2);

/// The longest first line of a program's complaint that is repeated.
const MOST_CHARACTERS: usize = 200;

/// A program that steps states, with its words and the files it reads and writes.
pub struct StepProgram {
    words: Vec<String>,
    layout: StateLayout,
    timeout: Duration,
    directory: TempDir,
    runs: AtomicUsize,
}

/// Why a state was not stepped.
#[derive(Debug, Clone, PartialEq)]
pub enum NoStep {
    /// The program does not do what the protocol asks for: bad input.
    Protocol(String),
    /// It ran and broke down.
    BrokeDown(String),
}

impl std::fmt::Display for NoStep {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (Self::Protocol(text) | Self::BrokeDown(text)) = self;
        formatter.write_str(text)
    }
}

/// A parameter as the program receives it.
#[derive(Debug, Clone)]
pub struct Given {
    /// Its name.
    pub name: String,
    /// Its value, a decimal.
    pub value: String,
}

impl StepProgram {
    pub fn new(words: &[String], layout: StateLayout, timeout: Duration) -> std::io::Result<Self> {
        let directory = tempfile::Builder::new().prefix("courant-probe-").tempdir()?;
        Ok(Self { words: words.to_vec(), layout, timeout, directory, runs: AtomicUsize::new(0) })
    }

    /// Whether a word holds a placeholder.
    pub fn has_placeholder(words: &[String], name: &str) -> bool {
        words.iter().any(|word| word.contains(&format!("{{{name}}}")))
    }

    /// Runs the program on a state.
    pub fn step(&self, state: &[f64], given: &[Given]) -> Result<Vec<f64>, NoStep> {
        let run = self.runs.fetch_add(1, Ordering::Relaxed);
        let file = |kind: &str| self.directory.path().join(format!("{run}-{kind}"));
        let files = RunFiles {
            state: file("in.npy"),
            answer: file("out.npy"),
            output: file("stdout"),
            complaint: file("stderr"),
        };
        let found = self.step_in(&files, state, given);
        files.remove();
        found
    }

    fn step_in(
        &self,
        files: &RunFiles,
        state: &[f64],
        given: &[Given],
    ) -> Result<Vec<f64>, NoStep> {
        let unwritable = |error: std::io::Error| {
            NoStep::Protocol(format!(
                "temporary files in {}: {error}",
                self.directory.path().display()
            ))
        };
        let array = NpyArray { shape: self.layout.state_shape(), values: state.to_vec() };
        std::fs::write(&files.state, array.to_bytes()).map_err(unwritable)?;
        let mut command = self.command(files, given).map_err(unwritable)?;
        let name = &self.words[0];
        let mut child = command
            .spawn()
            .map_err(|error| NoStep::Protocol(format!("COMMAND {name} cannot be run: {error}")))?;
        let begun = Instant::now();
        let status = loop {
            match child.try_wait().map_err(unwritable)? {
                Some(status) => break status,
                None if begun.elapsed() > self.timeout => {
                    // Both fail only where it has just ended by itself.
                    let _ = child.kill();
                    let _ = child.wait();
                    let seconds = self.timeout.as_secs_f64();
                    return Err(NoStep::BrokeDown(format!(
                        "the program did not finish one step in {seconds} s; --timeout gives it longer"
                    )));
                }
                None => std::thread::sleep(LOOK),
            }
        };
        if !status.success() {
            return Err(NoStep::BrokeDown(self.complaint(files, status)));
        }
        self.answer(files)
    }

    fn command(&self, files: &RunFiles, given: &[Given]) -> std::io::Result<Command> {
        let (state, answer) = (&files.state, &files.answer);
        let filled = |word: &String| {
            let paths = [("in", state), ("out", answer)];
            let word = paths.iter().fold(word.clone(), |word, (name, path)| {
                word.replace(&format!("{{{name}}}"), &path.to_string_lossy())
            });
            given
                .iter()
                .fold(word, |word, one| word.replace(&format!("{{{}}}", one.name), &one.value))
        };
        let mut command = Command::new(&self.words[0]);
        command
            .args(self.words[1..].iter().map(filled))
            .env("COURANT_IN", state)
            .env("COURANT_OUT", answer)
            .envs(given.iter().map(|one| (format!("COURANT_SET_{}", one.name), &one.value)))
            .stdin(File::open(state)?)
            .stdout(File::create(&files.output)?)
            .stderr(Stdio::from(File::create(&files.complaint)?));
        Ok(command)
    }

    /// How it ended and the first line that says why: of Python the last, where the exception stands.
    fn complaint(&self, files: &RunFiles, status: ExitStatus) -> String {
        let bytes = std::fs::read(&files.complaint).unwrap_or_default();
        let text = String::from_utf8_lossy(&bytes);
        let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
        let first = lines.next().unwrap_or_default();
        let line = match first.starts_with("Traceback") {
            true => lines.next_back().unwrap_or(first),
            false => first,
        };
        let line: String = line.chars().take(MOST_CHARACTERS).collect();
        let ending = match status.code() {
            Some(code) => format!("the program ended with exit code {code}"),
            None => format!("the program was ended ({status})"),
        };
        if line.is_empty() { ending } else { format!("{ending}: {line}") }
    }

    fn answer(&self, files: &RunFiles) -> Result<Vec<f64>, NoStep> {
        let written = std::fs::read(&files.answer).ok();
        let bytes = match written {
            Some(bytes) => bytes,
            None => std::fs::read(&files.output).unwrap_or_default(),
        };
        if bytes.is_empty() {
            return Err(NoStep::Protocol(
                "the program wrote no answer: neither to the file {out} (COURANT_OUT) nor to standard output".into(),
            ));
        }
        let array = NpyArray::from_bytes(&bytes)
            .map_err(|error| NoStep::Protocol(format!("the program's answer: {error}")))?;
        let shape = self.layout.answer_shape();
        if array.shape != shape {
            return Err(NoStep::Protocol(format!(
                "the program's answer has the shape {}, not {}",
                tuple(&array.shape),
                tuple(&shape)
            )));
        }
        match array.values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(NoStep::BrokeDown(format!(
                "the program's answer holds {value}; where 0 is no state to start from, --about STATE gives another"
            ))),
            None => Ok(array.values),
        }
    }
}

/// The files of one run.
struct RunFiles {
    state: PathBuf,
    answer: PathBuf,
    output: PathBuf,
    complaint: PathBuf,
}

impl RunFiles {
    fn remove(&self) {
        for file in [&self.state, &self.answer, &self.output, &self.complaint] {
            // Not all of them need be there; what is left goes with the directory.
            let _ = std::fs::remove_file(file);
        }
    }
}

/// A shape as NumPy writes it.
pub fn tuple(shape: &[usize]) -> String {
    let sizes: Vec<String> = shape.iter().map(usize::to_string).collect();
    format!("({}{})", sizes.join(", "), if shape.len() == 1 { "," } else { "" })
}
