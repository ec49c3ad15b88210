//! Particle scenes and the check of particle methods from the command line.

use serde_json::Value;
use std::process::Command;

fn courant(arguments: &[&str]) -> std::process::Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_courant"));
    command.args(arguments).output().expect("the program starts")
}

fn run(arguments: &[&str]) -> (Value, tempfile::TempDir) {
    let place = tempfile::tempdir().expect("a temporary directory");
    let out = place.path().to_str().expect("the path is text");
    let all = [&["run"], arguments, &["--format", "json", "--out", out]].concat();
    let output = courant(&all);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    (serde_json::from_slice(&output.stdout).expect("one JSON object"), place)
}

#[test]
fn every_scene_and_method_gives_a_record_a_profile_and_a_figure() {
    let scenes = [
        "sound-wave",
        "sod-sph",
        "strong-blast",
        "isothermal-tube",
        "sjogreen",
        "collision-subsonic",
        "collision-supersonic",
        "noh",
        "woodward-colella",
    ];
    let methods = ["gph1", "gph2", "gph3", "gph4", "sph1", "sph2"];
    // Every scene once, every method at least once.
    for (i, scene) in scenes.iter().enumerate() {
        let method = methods[i % methods.len()];
        let (record, place) = run(&[scene, "--method", method, "--particles", "40"]);
        assert_eq!(record["schema"], "courant.run/1");
        assert_eq!((&record["scene"], &record["method"]), (&(*scene).into(), &method.into()));
        assert_eq!(record["completed"], true, "{record}");
        let has_exact = *scene != "woodward-colella";
        assert_eq!(record["l1"]["density"].is_f64(), has_exact, "{record}");
        // A note stands beside whatever is null, and only there.
        for (part, note) in [("l1", "l1_note"), ("conservation", "conservation_note")] {
            let part = record[part].as_object().expect("an object");
            let complete = part.values().all(Value::is_f64);
            assert_eq!(record[note].is_null(), complete, "{record}");
        }
        assert_eq!(record["ratio"], if method == "gph4" { "21/20" } else { "1" });
        assert!(record["conservation"]["momentum"].as_f64().expect("a number") < 1e-12);
        for end in ["csv", "png", "svg"] {
            let file = place.path().join(format!("{scene}_{method}.{end}"));
            assert!(std::fs::metadata(&file).is_ok_and(|file| file.len() > 500), "{file:?}");
        }
    }
}

#[test]
fn options_reach_the_run() {
    let plain = ["sod-sph", "--method", "gph1", "--particles", "50"];
    let steps = |more: &[&str]| run(&[&plain, more].concat()).0["steps"].as_u64().expect("a count");
    let reference = steps(&[]);
    assert!(steps(&["--cfl", "0.25"]) > reference * 3 / 2);
    assert!(steps(&["--time", "0.05"]) < reference / 2);
    let (wide, _) = run(&[&plain[..], &["--kernel", "quintic-spline", "--ratio", "1.3"]].concat());
    assert_eq!((&wide["kernel"], &wide["ratio"]), (&"quintic-spline".into(), &"13/10".into()));
    let (late, _) = run(&[&plain[..], &["--time", "0.6"]].concat());
    assert!(late["l1"]["density"].is_null() && late["l1_note"].is_string());
}

#[test]
fn what_a_method_leaves_open_is_an_option() {
    let error = |method: &str, more: &[&str]| {
        let plain = ["sod-sph", "--method", method, "--particles", "50", "--time", "0.1"];
        run(&[&plain[..], more].concat()).0["l1"]["density"].as_f64().expect("it ends")
    };
    for (method, option, value, usual) in [
        ("sph1", "--alpha", "1/2", "1"),
        ("sph2", "--beta", "0", "2"),
        ("sph1", "--integrator", "rk4", "rk2-heun"),
        ("gph1", "--riemann", "exact", "published"),
        ("gph3", "--integrator", "rk2-heun", "centred-euler"),
        ("gph1", "--work", "published", "centred"),
        ("gph3", "--pair-work", "shared", "star"),
        ("gph1", "--pair-work", "star", "mean"),
    ] {
        assert_ne!(error(method, &[option, value]), error(method, &[]), "{method} {option}");
        assert_eq!(error(method, &[option, usual]), error(method, &[]), "{method} {option}");
    }
}

#[test]
fn a_run_that_breaks_down_is_a_result_without_norms() {
    let place = tempfile::tempdir().expect("a temporary directory");
    let out = place.path().to_str().expect("the path is text");
    let plain = ["run", "ferrari3", "--method", "sph-adke", "--format", "json", "--out", out];
    let output = courant(&plain);
    assert_eq!(output.status.code(), Some(1));
    let record: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
    assert_eq!(record["completed"], false);
    assert!(record["failure"].is_string() && record["l1"]["density"].is_null());
    assert_eq!(record["l1_note"], "the run broke down");
}

#[test]
fn bad_input_is_one_line_and_leaves_nothing() {
    let place = tempfile::tempdir().expect("a temporary directory");
    let out = place.path().join("out");
    for (arguments, words) in [
        (&["sod-sph"][..], &["--method", "gph1"][..]),
        (&["sod-sph", "--method", "gph5"], &["--method", "gph5", "did you mean"]),
        (&["sod-sph", "--method", "gph4", "--kernel", "cubic"], &["--kernel", "gaussian"]),
        (&["sod-sph", "--method", "sph1", "--particles", "9"], &["--particles", "10"]),
        (&["sod-sph", "--method", "gph1", "--alpha", "2"], &["--alpha", "gph1", "--riemann"]),
        (&["sod-sph", "--method", "sph1", "--riemann", "exact"], &["--riemann", "sph1", "--beta"]),
        (&["sod-sph", "--method", "sph1", "--roe-mean", "volume"], &["--roe-mean", "sph1"]),
        (&["sod-sph", "--method", "sph1", "--alpha", "-1"], &["--alpha", "-1", "0 to"]),
        (&["sod-sph", "--method", "sph1", "--particles", "-5"], &["--particles", "-5", "whole"]),
    ] {
        let path = out.to_str().expect("the path is text");
        let output = courant(&[&["run"], arguments, &["--out", path]].concat());
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(
            error.lines().count() == 1 && words.iter().all(|word| error.contains(word)),
            "{error}"
        );
        assert!(!out.exists());
    }
}

#[test]
fn validate_says_yes_to_the_resolved_and_no_to_the_published_relation() {
    let gph = ["validate", "--method", "gph", "--kernel", "cubic", "--format", "json"];
    for (form, code) in [("resolved", 0), ("published", 1)] {
        let more = ["--form", form, "--integrator", "rk4", "--particles", "16", "--steps", "50"];
        let output = courant(&[&gph[..], &more].concat());
        assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stderr));
        let record: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
        assert_eq!(record["passed"], code == 0);
        let rows = record["rows"].as_array().expect("a list");
        // Three codes, eight modes, two branches.
        assert_eq!(rows.len(), 48);
        assert!(rows.iter().all(|row| row["measured"]["gain"].is_f64()));
        assert_eq!(record["tolerance"], 1e-6);
    }
}

#[test]
fn agreement_is_relative_to_the_factors() {
    let case = ["validate", "--method", "sph", "--kernel", "cubic", "--cfl", "100"];
    // A step of a hundred crossing times multiplies waves by up to 5e7.
    assert_eq!(courant(&case).status.code(), Some(0));
    let published = ["--method", "gph", "--form", "published", "--kernel", "cubic", "--cfl", "10"];
    let output = courant(&[&["validate"], &published[..]].concat());
    let text = String::from_utf8_lossy(&output.stdout);
    let verdict = text.lines().find(|line| line.contains("cases do not agree")).unwrap_or_default();
    let counts: Vec<&str> = verdict.split(' ').take(3).collect();
    assert!(counts.len() == 3 && counts[0] == counts[2], "{text}");
}

#[test]
fn validate_refuses_options_of_the_other_family() {
    for (arguments, word) in [
        (&["--alpha", "1"][..], "--alpha"),
        (&["--method", "gph", "--alpha", "1"], "--alpha"),
        (&["--method", "sph", "--form", "published"], "--form"),
        (&["--method", "sph", "--kernel", "gaussian", "--ratio", "1"], "--ratio"),
        (&["--method", "sph", "--integrator", "magic"], "--integrator"),
    ] {
        let output = courant(&[&["validate"], arguments].concat());
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.lines().count() == 1 && error.contains(word), "{error}");
    }
}
