//! `courant probe`: programs that courant knows nothing of.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn probe(words: &[&str]) -> Output {
    super::courant(&[&["probe"], words].concat())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn json(words: &[&str]) -> Value {
    let output = probe(&[&["--format", "json"], words].concat());
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}{}", text(&output.stdout), text(&output.stderr)))
}

/// Whether Python with NumPy is there; says so where it is not.
fn has_numpy() -> bool {
    let output = std::process::Command::new("python3").args(["-c", "import numpy"]).output();
    let found = output.is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("skipped: python3 with numpy is not there");
    }
    found
}

/// The example in Rust; `cargo test` builds it beside the program, `cargo test --test program` does not.
fn probe_step() -> PathBuf {
    let program = Path::new(env!("CARGO_BIN_EXE_courant"));
    let name = format!("probe_step{}", std::env::consts::EXE_SUFFIX);
    let built = program.parent().unwrap().join("examples").join(name);
    if !built.exists() {
        let cargo = std::process::Command::new(env!("CARGO"))
            .args(["build", "--quiet", "--example", "probe_step"])
            .status();
        assert!(cargo.unwrap().success() && built.exists(), "{}", built.display());
    }
    built
}

#[test]
fn upwind_in_numpy_has_its_limit_and_verdicts() {
    if !has_numpy() {
        return;
    }
    let words = ["--", "python3", "examples/probe/upwind.py", "{in}", "{out}", "{C}"];
    let answer = json(&[&["--set", "C=1/2,1.25", "--fit", "1/4:1:1/4"], &words[..]].concat());
    assert_eq!(answer["schema"], "courant.probe/1");
    assert_eq!(answer["equations"][0], "u[n+1,j] = C*u[n,j-1] + (1 - C)*u[n,j]");
    assert_eq!((&answer["recognised"], &answer["keeps_constants"]), (&true.into(), &true.into()));
    for limit in ["stability", "monotonicity"] {
        assert_eq!(answer[limit]["exact"], "1", "{answer}");
        assert_eq!(answer[limit]["evidence"], "measured");
    }
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!((&rows[0]["verdict"], &rows[1]["verdict"]), (&"stable".into(), &"unstable".into()));
    assert_eq!(rows[1]["max_gain"], 1.5);
}

#[test]
fn staggered_codes_in_two_dimensions_have_the_limit_of_the_literature() {
    let example = probe_step();
    let yee = [example.to_str().unwrap(), "{in}", "{out}", "{C}"];
    let options = ["--unknowns", "E,Hx,Hy", "--size", "10,12", "--set", "C=0.7", "--"];
    let output = probe(&[&options[..], &yee].concat());
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{shown}{}", text(&output.stderr));
    assert!(shown.contains("0.707106781186 = sqrt(1/2) (measured, shortest-wave"), "{shown}");
    assert!(shown.contains("recognised as fractions"), "{shown}");
    // The other road: the equations it prints are the same scheme.
    let answer = json(&[&options[..], &yee].concat());
    let equations = answer["equations"].as_array().unwrap();
    let typed: Vec<&str> = equations.iter().map(|line| line.as_str().unwrap()).collect();
    let limits = Command::new(env!("CARGO_BIN_EXE_courant"))
        .args(["limits", "--format", "json", "--equation", &typed.join("; ")])
        .output()
        .unwrap();
    let limits: Value = serde_json::from_slice(&limits.stdout).unwrap();
    assert_eq!(limits["rows"][0]["stability"]["exact"], "sqrt(1/2)");
    assert_eq!(limits["rows"][0]["stability"]["evidence"], "proved");
    // Squares of C cannot be told from four values: three settle them, two verify.
    let few = ["--unknowns", "E,Hx,Hy", "--size", "8,8", "--fit", "1/4:1:1/4", "--"];
    let answer = json(&[&few[..], &yee].concat());
    let reason = answer["reason"].as_str().unwrap();
    assert!(reason.contains("no polynomial in C of degree up to 1"), "{reason}");
    if has_numpy() {
        let acoustics = ["python3", "examples/probe/acoustics.py", "{in}", "{out}", "{C}"];
        let options = ["--unknowns", "p,u,v", "--size", "8,8", "--fit", "1/5:1:1/5", "--"];
        let answer = json(&[&options[..], &acoustics].concat());
        assert_eq!(answer["stability"]["exact"], "sqrt(1/2)", "{answer}");
        assert_eq!(answer["stability"]["evidence"], "measured");
    }
}

#[test]
fn a_filter_without_a_parameter_is_judged_as_it_is() {
    let output = probe(&["--", "cat"]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{shown}{}", text(&output.stderr));
    assert!(shown.contains("stable") && shown.contains("u[n+1,j] = u[n,j]"), "{shown}");
}

#[test]
fn programs_that_break_down_are_answered_in_one_line() {
    for (words, expected) in [
        (&["--", "sh", "-c", "echo 'no licence' >&2; exit 3"][..], "exit code 3: no licence"),
        (&["--timeout", "0.05", "--", "sleep", "20"], "--timeout"),
    ] {
        let output = probe(words);
        let shown = text(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "{shown}{}", text(&output.stderr));
        assert!(shown.contains(expected) && shown.lines().count() == 1, "{shown}");
        let answer = json(words);
        assert_eq!(answer["measured"], false);
        assert!(answer["reason"].as_str().unwrap().contains(expected), "{answer}");
    }
}

#[test]
fn what_is_not_the_protocol_is_bad_input() {
    for (words, expected) in [
        (&["--", "no-such-program-anywhere"][..], "cannot be run"),
        (&["--", "true"], "wrote no answer"),
        (&["--", "echo", "hello"], "no .npy file"),
        (&["--levels", "2", "--", "cat"], "shape (2, 32), not (32,)"),
        (&["--size", "3", "--", "cat"], "--size"),
        (&["--unknowns", "u,2v", "--", "cat"], "--unknowns"),
        (&["--about", "x", "--", "cat"], "--about x"),
        (&["--about", "1,2", "--", "cat"], "one is accepted"),
        (&["--set", "a=1,2", "--", "cat"], "--set a: 2 values"),
        (&["--tolerance", "1", "--", "cat"], "--tolerance"),
        (&[], "COMMAND"),
    ] {
        let output = probe(words);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {}{error}", text(&output.stdout));
        assert!(error.contains(expected) && error.lines().count() == 1, "{words:?}: {error}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn programs_that_are_no_schemes_are_told_apart() {
    if !has_numpy() {
        return;
    }
    let program = |body: &str| {
        format!(
            "import os, numpy as np; u = np.load(os.environ['COURANT_IN']); {body}; np.save(os.environ['COURANT_OUT'], u)"
        )
    };
    for (options, body, code, expected) in [
        (&[][..], "u = u - 0.25*(u**2 - np.roll(u, 1)**2)", 1, "not linear"),
        (&[], "u[0] = 0", 1, "not the same everywhere"),
        (
            &[],
            "u = np.real(np.fft.ifft(np.fft.fft(u)/(1.5 - 0.5*np.cos(np.arange(32)))))",
            1,
            "too wide",
        ),
        (&[], "u = u/u.max()", 1, "--about"),
        (&[], "u = u.astype('f4')", 2, "<f4"),
        (&["--about", "0.5"], "u = u - 0.5*(u**2 - np.roll(u, 1)**2)", 0, "linearised"),
        (
            &["--about", "0.5"],
            "u = u - 1.5*(u**2 - np.roll(u, 1)**2)",
            1,
            "unstable, largest |z| 2.0",
        ),
    ] {
        let script = program(body);
        let words = [options, &["--", "python3", "-W", "ignore", "-c", &script]].concat();
        let output = probe(&words);
        let shown = text(&output.stdout) + &text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{body}: {shown}");
        assert!(shown.contains(expected), "{body}: {shown}");
    }
}
