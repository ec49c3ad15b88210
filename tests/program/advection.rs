//! Advection from the command line: `run` and `validate`.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// What the program says, where it ends with that code.
fn courant(arguments: &[&str], code: i32) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_courant")).args(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
    output
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Exit code 2 and one line on standard error that holds every word; nothing on standard output.
fn refused(arguments: &[&str], words: &[&str]) {
    let output = courant(arguments, 2);
    let error = text(&output.stderr);
    assert_eq!(error.trim_end().lines().count(), 1, "{error}");
    for word in words {
        assert!(error.contains(word), "{arguments:?}: {error}");
    }
    assert!(output.stdout.is_empty());
}

#[test]
fn validation_with_default_settings_passes() {
    let answer = json(&courant(&["validate", "--format", "json"], 0));
    assert_eq!(answer["schema"], "courant.validate/1");
    assert_eq!((&answer["passed"], &answer["steps"]), (&Value::from(true), &Value::from(100)));
    assert!(answer["max_error"].as_f64().unwrap() < 1e-12);
    let cases = answer["cases"].as_array().unwrap();
    // Three schemes, seven kernels, three Courant numbers.
    assert_eq!(cases.len(), 3 * 7 * 3);
    for regime in ["stable", "neutral", "unstable"] {
        assert!(cases.iter().any(|case| case["regime"] == regime), "{regime}");
    }
    let row = &answer["rows"][1];
    for key in ["mode", "phase", "error"] {
        assert!(row[key].is_number(), "{key}");
    }
    for side in ["predicted", "measured"] {
        assert!(row[side]["gain"].is_number() && row[side]["phase"].is_number());
    }
}

#[test]
fn a_coefficient_off_by_a_billionth_is_noticed() {
    let arguments = ["validate", "--kernel", "cubic", "--particles", "40", "--steps", "20"];
    courant(&arguments, 0);
    for fault in ["1e-9", "-1e-9"] {
        let faulty: Vec<&str> = arguments.iter().copied().chain(["--fault", fault]).collect();
        let output = courant(&faulty, 1);
        assert!(text(&output.stdout).contains("do not agree"));
    }
}

#[test]
fn one_case_is_shown_mode_by_mode() {
    let arguments = [
        "validate",
        "--scheme",
        "godunov-sph",
        "--kernel",
        "m4",
        "--ratio",
        "2",
        "--cfl",
        "15/8",
        "--particles",
        "12",
        "--steps",
        "5",
        "--format",
        "csv",
    ];
    let text = text(&courant(&arguments, 0).stdout);
    // Modes 0 to 6, and a header.
    assert_eq!(text.lines().count(), 8);
}

#[test]
fn bad_validations_are_refused() {
    refused(&["validate", "--cfl", "0"], &["--cfl", "0"]);
    refused(&["validate", "--particles", "3"], &["--particles", "3", "4"]);
    refused(&["validate", "--steps", "0"], &["--steps", "1"]);
    refused(&["validate", "--kernel", "cubic,foo"], &["--kernel", "foo"]);
    refused(&["validate", "--ratio", "51"], &["--ratio", "51", "50"]);
}

fn run(out: &Path, arguments: &[&str], code: i32) -> Output {
    let out = out.to_str().unwrap();
    let all: Vec<&str> = ["run"].iter().chain(arguments).copied().chain(["--out", out]).collect();
    courant(&all, code)
}

#[test]
fn a_run_writes_profile_pictures_and_record() {
    let place = tempfile::tempdir().unwrap();
    let arguments = [
        "advection-step",
        "--method",
        "godunov-sph",
        "--particles",
        "80",
        "--cfl",
        "8/5",
        "--format",
        "json",
    ];
    let answer = json(&run(place.path(), &arguments, 0));
    assert_eq!(answer["schema"], "courant.run/1");
    assert_eq!((&answer["completed"], &answer["failure"]), (&Value::from(true), &Value::Null));
    // 80 particles at C = 8/5 take exactly 50 steps.
    assert_eq!((&answer["steps"], &answer["cfl"]), (&Value::from(50), &Value::from(1.6)));
    // What an advection scheme does not have is null with a note.
    assert!(answer["l1_note"].is_string() && answer["conservation_note"].is_string());
    // At the monotonicity limit the values stay within the data.
    assert!(answer["maximum"].as_f64().unwrap() <= 1.0 + 1e-13);
    assert!(answer["minimum"].as_f64().unwrap() >= 0.25 - 1e-13);
    let mut names: Vec<String> = std::fs::read_dir(place.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let stem = "advection-step_godunov-sph";
    assert_eq!(names, ["csv", "json", "png", "svg"].map(|end| format!("{stem}.{end}")));
    let profile = std::fs::read_to_string(place.path().join(format!("{stem}.csv"))).unwrap();
    assert_eq!(profile.lines().count(), 81);
}

#[test]
fn both_paths_give_the_same_errors() {
    let error = |layout: &str| {
        let place = tempfile::tempdir().unwrap();
        let arguments = [
            "advection-gaussian",
            "--method",
            "lax-wendroff-sph",
            "--particles",
            "60",
            "--periods",
            "2",
            "--layout",
            layout,
            "--format",
            "json",
        ];
        json(&run(place.path(), &arguments, 0))["l1"]["value"].as_f64().unwrap()
    };
    let (lattice, uniform) = (error("lattice"), error("uniform"));
    // 120 steps of rounding.
    assert!((lattice - uniform).abs() < 1e-13, "{lattice} {uniform}");
}

#[test]
fn a_run_that_overflows_is_told_with_its_reason() {
    let place = tempfile::tempdir().unwrap();
    let arguments = [
        "advection-square",
        "--method",
        "euler-sph",
        "--particles",
        "50",
        "--cfl",
        "2",
        "--time",
        "500",
        "--format",
        "json",
    ];
    let answer = json(&run(place.path(), &arguments, 1));
    assert_eq!(answer["completed"], false);
    assert!(answer["failure"].as_str().unwrap().contains("unstable at C = 2"));
    assert_eq!(answer["l1_note"], "the run broke down");
    assert_eq!(answer["conservation_note"], "the run broke down");
    assert!(answer["l1"]["value"].is_null() && answer["time"].as_f64().unwrap() < 500.0);
}

#[test]
fn a_step_beyond_the_proved_limit_is_told_before_the_run_and_in_its_record() {
    let place = tempfile::tempdir().unwrap();
    let warning = |more: &[&str]| {
        let plain = ["advection-step", "--ratio", "2", "--particles", "100", "--format", "json"];
        let output = run(place.path(), &[&plain[..], more].concat(), 0);
        let told = text(&output.stderr);
        let answer = json(&output);
        assert_eq!(told.is_empty(), answer["warnings"] == Value::from(Vec::<String>::new()));
        told
    };
    assert!(warning(&["--cfl", "2"]).contains("steps up to C = 15/8, by proof"));
    assert_eq!(warning(&["--cfl", "15/8", "--time", "3/4"]), "");
    let central = warning(&["--method", "euler-sph", "--cfl", "1/2"]);
    assert!(central.contains("no step, however small"), "{central}");
}

#[test]
fn bad_runs_are_refused_before_anything_is_written() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("out");
    let out = out.to_str().unwrap();
    for (arguments, words) in [
        (vec!["advection-stepp"], vec!["advection-stepp", "advection-step"]),
        (vec!["advection-step", "--method", "gph"], vec!["--method", "gph", "godunov-sph"]),
        (vec!["advection-waves", "--waves", "101"], vec!["--waves 101", "200", "100"]),
        (vec!["advection-waves", "--waves", "-1"], vec!["--waves", "-1", "whole"]),
        (vec!["advection-step", "--seed", "-1"], vec!["--seed", "-1", "whole"]),
        (vec!["advection-step", "--disorder", "-1"], vec!["--disorder", "-1", "negative"]),
        (vec!["advection-step", "--alpha", "1"], vec!["--alpha", "advection"]),
        (vec!["advection-step", "--waves", "3"], vec!["--waves 3", "advection-waves"]),
        (vec!["advection-step", "--disorder", "0.1"], vec!["--disorder", "--layout"]),
        (vec!["advection-step", "--seed", "1"], vec!["--seed", "--layout"]),
        (vec!["advection-step", "--periods", "0"], vec!["--periods", "0"]),
        (vec!["advection-square", "--time", "1e300"], vec!["--time 1", "steps", "would be needed"]),
        (vec!["advection-step", "--time", "1", "--periods", "1"], vec!["--time", "--periods"]),
        (
            vec!["advection-step", "--layout", "disordered", "--disorder", "1/2"],
            vec!["--disorder", "1/2"],
        ),
    ] {
        let all: Vec<&str> = ["run"].into_iter().chain(arguments).chain(["--out", out]).collect();
        refused(&all, &words);
        assert!(!Path::new(out).exists());
    }
}

#[test]
fn the_shortest_wave_is_the_last_that_is_accepted() {
    let place = tempfile::tempdir().unwrap();
    for waves in ["--waves=8", "--waves=10"] {
        run(place.path(), &["advection-waves", "--particles", "20", waves], 0);
    }
    // Without the option there are fewer waves on few particles.
    run(place.path(), &["advection-waves", "--particles", "6"], 0);
}

#[test]
fn a_run_as_csv_is_its_record() {
    let place = tempfile::tempdir().unwrap();
    let table = text(&run(place.path(), &["advection-step", "--format", "csv"], 0).stdout);
    let record = json(&run(place.path(), &["advection-step", "--format", "json"], 0));
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 2, "{table}");
    let names: Vec<&str> = lines[0].split(',').collect();
    let mut unique = names.clone();
    unique.sort_unstable();
    unique.dedup();
    assert_eq!(unique.len(), names.len());
    let cell = |name: &str| {
        let index = names.iter().position(|known| *known == name).expect(name);
        lines[1].split(',').nth(index).expect("as many cells as names")
    };
    // Every digit, and nothing where the record has null.
    assert_eq!(cell("l1_value").parse().ok(), record["l1"]["value"].as_f64());
    assert_eq!((cell("l1_density"), cell("ratio")), ("", "2"));
}
