//! `courant verify`.

use super::output::{Format, print, print_record};
use super::{Failure, Outcome};
use clap::Args;
use courant::reports::certificate_file::{CertificateFileError, verify_file};
use courant::reports::table::{Align, Table};
use serde::Serialize;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Arguments {
    /// A file written by `courant limits --certificate`.
    file: PathBuf,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

#[derive(Debug, Serialize)]
struct Answer {
    valid: bool,
    certificates: usize,
    boxes: usize,
    statements: Vec<String>,
    refused: Option<String>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let answer = match verify_file(&arguments.file) {
        Ok(verified) => Answer {
            valid: true,
            certificates: verified.len(),
            boxes: verified.iter().map(|one| one.boxes).sum(),
            statements: verified.into_iter().map(|one| one.statement).collect(),
            refused: None,
        },
        Err(refusal @ CertificateFileError::Refused { .. }) => Answer {
            valid: false,
            certificates: 0,
            boxes: 0,
            statements: Vec::new(),
            refused: Some(refusal.to_string()),
        },
        Err(unreadable) => return Err(Failure::Message(format!("FILE: {unreadable}"))),
    };
    let conclusion = match &answer.refused {
        None => {
            format!("{} certificates hold ({} boxes recomputed)", answer.certificates, answer.boxes)
        }
        Some(refusal) => format!("refused: {refusal}"),
    };
    let lines = answer.statements.iter().chain([&conclusion]);
    if arguments.format == Format::Table {
        print(&lines.map(|line| format!("{line}\n")).collect::<String>())?;
    } else {
        let mut table = Table::new("Certificates", &[("statement", Align::Left)]);
        lines.for_each(|line| table.push([line.as_str()]));
        print_record("verify", &answer, &table, arguments.format)?;
    }
    Ok(if answer.valid { Outcome::Yes } else { Outcome::No })
}
