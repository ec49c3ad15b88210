//! The program as a user meets it.

use serde_json::Value;
use std::process::{Command, Output};

mod advection;
mod answers;
mod curves;
mod dialect;
mod dimensions;
mod gas;
mod manners;
mod particles;
mod probe;
mod report;
mod runs;
mod scenes;
mod subjects;
mod waves;

fn courant(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_courant")).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let output = courant(arguments);
    assert!(output.status.code().is_some_and(|code| code < 2), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}
