//! `courant verify`.

use super::output::{Format, print, print_json};
use super::{Failure, Outcome};
use clap::Args;
use courant::reports::certificate_file::{CertificateFileError, verify_file};
use serde::Serialize;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Arguments {
    /// A file written by `courant limits --certificate`.
    file: PathBuf,
    /// Format of the output: table or json.
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
    if arguments.format == Format::Json {
        print_json("verify", &answer)?;
    } else {
        let mut text: String =
            answer.statements.iter().map(|statement| format!("{statement}\n")).collect();
        text.push_str(&match &answer.refused {
            None => format!(
                "{} certificates hold ({} boxes recomputed)\n",
                answer.certificates, answer.boxes
            ),
            Some(refusal) => format!("refused: {refusal}\n"),
        });
        print(&text)?;
    }
    Ok(if answer.valid { Outcome::Yes } else { Outcome::No })
}
