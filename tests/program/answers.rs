//! Answers in all formats, their exit codes, and bad input.

use super::{courant, json, text};
use serde_json::Value;
use std::path::Path;

#[test]
fn limits_of_table_1_as_json() {
    let answer = json(&[
        "limits",
        "--scheme",
        "godunov-sph",
        "--kernel",
        "cubic,gaussian",
        "--ratio",
        "1,2,3,4,5,10",
        "--format",
        "json",
    ]);
    assert_eq!(answer["schema"], "courant.limits/1");
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 12);
    let ratio_2 = &rows[1];
    assert_eq!(ratio_2["ratio"], "2");
    assert_eq!(ratio_2["kernel"], "cubic-spline");
    assert_eq!(ratio_2["stability"]["exact"], "15/8");
    assert_eq!(ratio_2["stability"]["value"], 1.875);
    assert_eq!(ratio_2["stability"]["evidence"], "proved");
    assert_eq!(ratio_2["stability"]["cause"], "long-wave");
    assert_eq!(ratio_2["monotonicity"]["exact"], "8/5");
    assert_eq!(ratio_2["keeps_constants"], true);
    assert_eq!(ratio_2["stable_set"][0]["from"], 0.0);
    let gaussian = &rows[6]["stability"];
    assert_eq!(gaussian["evidence"], "enclosed");
    assert!(gaussian["exact"].is_null());
    let (lower, upper) = (gaussian["lower"].as_f64().unwrap(), gaussian["upper"].as_f64().unwrap());
    assert!(lower <= upper && upper - lower < 1e-14 && lower > 1.17 && upper < 1.18);
}

#[test]
fn ratios_are_read_exactly() {
    let rows = |ratio: &str| {
        json(&["limits", "--scheme", "godunov-sph", "--ratio", ratio, "--format", "json"])["rows"]
            .clone()
    };
    assert_eq!(rows("1.3"), rows("13/10"));
    assert_eq!(rows("1.3")[0]["ratio"], "13/10");
    assert_eq!(rows("3.7")[0]["stability"]["exact"], "15137598397/4376736800");
    assert_eq!(rows("1:2:0.5").as_array().unwrap().len(), 3);
}

#[test]
fn a_scheme_without_a_limit_has_value_zero_and_budgets_tell_the_rest() {
    let answer = json(&[
        "limits",
        "--scheme",
        "lax-wendroff-sph",
        "--kernel",
        "gaussian",
        "--ratio",
        "3",
        "--growth",
        "1e-9,1e-6,1e-3",
        "--format",
        "json",
    ]);
    let row = &answer["rows"][0];
    assert_eq!(row["stability"]["value"], 0.0);
    assert_eq!(row["keeps_constants"], false);
    let budgets: Vec<f64> = row["growth_limits"]
        .as_array()
        .unwrap()
        .iter()
        .map(|limit| limit["value"].as_f64().unwrap())
        .collect();
    assert!(budgets.is_sorted() && budgets[0] < 0.01 && budgets[2] > 3.1, "{budgets:?}");
}

#[test]
fn an_unlimited_scheme_says_null_and_why() {
    let answer = json(&["limits", "--scheme", "godunov-sph", "--ratio", "1/4", "--format", "json"]);
    let stability = &answer["rows"][0]["stability"];
    assert!(stability["value"].is_null() && stability["upper"].is_null());
    assert!(stability["reason"].as_str().unwrap().contains("no limit up to"));
}

#[test]
fn check_answers_with_its_exit_code() {
    let check = |cfl: &str, more: &[&str]| {
        let fixed = [
            "check",
            "--scheme",
            "godunov-sph",
            "--kernel",
            "gaussian",
            "--ratio",
            "1",
            "--cfl",
            cfl,
        ];
        courant(&[&fixed, more].concat())
    };
    let unstable = check("1.2", &[]);
    assert_eq!(unstable.status.code(), Some(1));
    let shown = text(&unstable.stdout);
    for word in ["unstable", "growth per step", "steps to double", "fastest growing wave"] {
        assert!(shown.contains(word), "{shown}");
    }
    let stable = check("1.1", &[]);
    assert_eq!(stable.status.code(), Some(0));
    assert!(text(&stable.stdout).contains("stable, not monotone"));
    assert_eq!(check("1.2", &["--growth", "0.02"]).status.code(), Some(0));
    assert_eq!(check("1.2", &["--growth", "0.01"]).status.code(), Some(1));
    let record = json(&[
        "check",
        "--scheme",
        "godunov-sph",
        "--kernel",
        "gaussian",
        "--ratio",
        "1",
        "--cfl",
        "1.2",
        "--format",
        "json",
    ]);
    assert_eq!(record["schema"], "courant.check/1");
    assert_eq!((&record["verdict"], &record["monotone"]), (&"unstable".into(), &false.into()));
    assert!(
        (record["max_gain"].as_f64().unwrap() - 1.0 - record["growth_per_step"].as_f64().unwrap())
            .abs()
            < 1e-15
    );
    assert!(record["steps_to_double"].as_f64().unwrap() > 40.0);
}

#[test]
fn symbol_is_exact_where_the_data_are() {
    let record = json(&["symbol", "--scheme", "godunov-sph", "--ratio", "2", "--format", "json"]);
    assert_eq!(record["schema"], "courant.symbol/1");
    assert_eq!(record["coefficients"][2]["offset"], -1);
    assert_eq!(record["coefficients"][2]["polynomial"], serde_json::json!(["0", "5/16"]));
    assert_eq!(
        (&record["order"]["overall"], &record["keeps_constants"]),
        (&1.into(), &true.into())
    );
    assert!(record["latex"].as_str().unwrap().contains("\\frac{5}{16}"));
}

#[test]
fn what_is_named_twice_counts_once() {
    let rows = |kernel: &str, ratio: &str| {
        let plain = ["limits", "--scheme", "godunov-sph", "--format", "json"];
        json(&[&plain[..], &["--kernel", kernel, "--ratio", ratio]].concat())["rows"].clone()
    };
    assert_eq!(rows("cubic,cubic,m4", "2,4/2"), rows("cubic", "2"));
}

#[test]
fn an_interval_without_an_end_says_so_and_zero_has_no_sign() {
    let limits = |scheme: &str, most: &str| {
        let arguments =
            ["limits", "--scheme", scheme, "--ratio", "2", "--max-cfl", most, "--format", "json"];
        courant(&arguments).stdout
    };
    let row = |text: &[u8]| serde_json::from_slice::<Value>(text).unwrap()["rows"][0].clone();
    let open = row(&limits("godunov-sph", "1"))["stable_set"][0].clone();
    assert!(open["to"].is_null() && open["to_note"].is_string(), "{open}");
    let closed = row(&limits("godunov-sph", "3"))["stable_set"][0].clone();
    assert!(closed["to"].is_f64() && closed.get("to_note").is_none(), "{closed}");
    assert!(!text(&limits("euler-sph", "1")).contains("-0.0"));
}

#[test]
fn check_as_csv_is_one_row() {
    let check = |arguments: &[&str]| {
        let all = [&["check"], arguments, &["--ratio", "2", "--cfl", "1", "--format", "csv"]];
        text(&courant(&all.concat()).stdout)
    };
    for arguments in [&["--scheme", "godunov-sph"][..], &["--method", "sph", "--integrator", "kdk"]]
    {
        let shown = check(arguments);
        let lines: Vec<&str> = shown.lines().collect();
        assert_eq!(lines.len(), 2, "{shown}");
        let names: Vec<&str> = lines[0].split(',').collect();
        assert!(names.contains(&"verdict") && names.contains(&"value"), "{shown}");
        assert_eq!(names.len(), lines[1].split(',').count(), "{shown}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_named() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_courant"));
    let output = command.arg("list").stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("standard output"), "{}", text(&output.stderr));
}

#[test]
fn every_format_has_its_shape() {
    let limits = |format: &str| {
        text(
            &courant(&["limits", "--scheme", "godunov-sph", "--ratio", "2", "--format", format])
                .stdout,
        )
    };
    assert!(limits("csv").starts_with("scheme,integrator,kernel,ratio,"));
    assert!(limits("markdown").starts_with("| kernel |"));
    assert!(limits("latex").contains("$\\frac{15}{8}$"));
    assert!(limits("table").contains("15/8"));
}

#[test]
fn sampling_is_named_and_sees_less() {
    let row = |more: &[&str]| {
        let fixed = [
            "limits",
            "--scheme",
            "godunov-sph",
            "--kernel",
            "gaussian",
            "--ratio",
            "1",
            "--format",
            "json",
        ];
        json(&[&fixed, more].concat())["rows"][0]["stability"].clone()
    };
    let sampled = row(&["--samples", "33"]);
    assert_eq!((&sampled["evidence"], &sampled["phases"]), (&"sampled".into(), &33.into()));
    assert!(sampled["value"].as_f64() > row(&[])["value"].as_f64());
}

#[test]
fn bad_input_is_one_clear_line_and_exit_code_2() {
    let place = tempfile::Builder::new().prefix("place").tempdir().unwrap();
    let file = place.path().join("file");
    std::fs::write(&file, "").unwrap();
    let below_a_file = file.join("out");
    let below_a_file = below_a_file.to_str().unwrap();
    for (arguments, words) in [
        (
            vec!["limits", "--scheme", "godunov-sph", "--kernel", "cubicsplin", "--ratio", "1"],
            vec!["--kernel", "cubicsplin", "did you mean `cubic-spline`"],
        ),
        (
            vec!["limits", "--scheme", "godunov-sph", "--ratio", "0"],
            vec!["--ratio", "at least 1/100 and at most 50"],
        ),
        (
            vec!["limits", "--scheme", "godunov-sph", "--ratio", "-2"],
            vec!["--ratio", "-2", "at least 1/100"],
        ),
        (
            vec!["limits", "--scheme", "godunov-sph", "--ratio", "NaN"],
            vec!["--ratio", "NaN", "not a number"],
        ),
        (
            vec!["limits", "--scheme", "godunov-sph", "--ratio", "1:0:1"],
            vec!["--ratio", "1:0:1", "empty"],
        ),
        (
            vec!["limits", "--scheme", "godunov-sph", "--ratio", "1:1e9:1"],
            vec!["--ratio", "more than 100000 values"],
        ),
        (vec!["limits", "--scheme", "godunov-sph", "--ratio", ""], vec!["--ratio", "empty"]),
        (vec!["limits", "--scheme", "godunov-sph"], vec!["--ratio", "required"]),
        (vec!["limits"], vec!["--equation", "--scheme", "--space", "--method", "required"]),
        (vec!["check", "--scheme", "godunov-sph", "--cfl", "1", "--ratio"], vec!["--ratio", "3/2"]),
        (vec!["limits", "--scheme", "--ratio", "2"], vec!["--scheme", "lax-wendroff-sph"]),
        (vec!["map", "--scheme", "godunov-sph", "--out", ""], vec!["--out", "Directory"]),
        (
            vec!["limits", "--scheme", "godunov-sph", "--ratio", "1", "--samples", "-3"],
            vec!["--samples", "-3", "whole number"],
        ),
        (
            vec!["limits", "--scheme", "godunov-sph", "--ratio", "1", "--threads", "-1"],
            vec!["--threads", "-1", "whole number"],
        ),
        (vec!["list", "kernels", "schemes"], vec!["`schemes`", "one argument too many"]),
        (vec!["man", "limitz"], vec!["limitz", "`limits`"]),
        (
            vec!["check", "--scheme", "godunov-sph", "--ratio", "1", "--cfl", "-1"],
            vec!["--cfl", "from 0 to"],
        ),
        (
            vec!["check", "--scheme", "godunov-sph", "--ratio", "1", "--cfl", "1e9"],
            vec!["--cfl", "from 0 to"],
        ),
        (
            vec![
                "map",
                "--scheme",
                "godunov-sph",
                "--ratio",
                "1:2:0.1",
                "--cfl",
                "2,1",
                "--out",
                below_a_file,
            ],
            vec!["--cfl", "ascend"],
        ),
        (
            vec!["map", "--scheme", "godunov-sph", "--out", below_a_file],
            vec!["--out", "cannot write"],
        ),
        (vec!["report", "--out", below_a_file], vec!["--out", "cannot write"]),
        (
            vec![
                "limits",
                "--scheme",
                "godunov-sph",
                "--ratio",
                "1",
                "--certificate",
                "/no/such/dir/x.json",
            ],
            vec!["--certificate: cannot write `/no/such/dir/x.json`: No such file"],
        ),
        (vec!["report", "--out", ""], vec!["--out <OUT> needs a value; accepted: Directory"]),
        (vec!["report", "ferarri2008"], vec!["did you mean `ferrari2008`"]),
        (vec!["limits", "--schem", "x"], vec!["--schem", "did you mean"]),
        (vec!["limitz"], vec!["limitz"]),
        (
            vec!["limits", "--scheme", "godunov-sph", "--ratio", "1", "--threads", "0"],
            vec!["--threads", "1 to 1024"],
        ),
    ] {
        let output = courant(&arguments);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert_eq!(error.trim_end().lines().count(), 1, "{arguments:?}: {error}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {error} lacks {word}");
        }
        assert!(!error.contains(".tmp"), "{arguments:?}: {error} names a temporary file");
    }
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 1);
}

#[test]
fn a_map_writes_every_format_and_nothing_depends_on_threads() {
    let place = tempfile::tempdir().unwrap();
    let map = |threads: &str| {
        let out = place.path().join(threads);
        let output = courant(&[
            "map",
            "--scheme",
            "godunov-sph",
            "--kernel",
            "gaussian",
            "--ratio",
            "1:3:0.1",
            "--cfl",
            "0:4:0.1",
            "--threads",
            threads,
            "--out",
            out.to_str().unwrap(),
        ]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        out
    };
    let (one, two) = (map("1"), map("2"));
    let names = |place: &Path| {
        let mut names: Vec<_> =
            std::fs::read_dir(place).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    assert_eq!(names(&one), names(&two));
    for end in [".png", ".svg", ".csv", "_limits.csv", "_max_gain.npy", "_min_gain.npy"] {
        assert!(one.join(format!("map_godunov-sph_gaussian{end}")).exists(), "{end}");
    }
    for name in names(&one) {
        assert_eq!(
            std::fs::read(one.join(&name)).unwrap(),
            std::fs::read(two.join(&name)).unwrap()
        );
    }
}

#[test]
fn completions_manual_and_lists_are_there() {
    assert!(text(&courant(&["completions", "bash"]).stdout).contains("_courant"));
    assert!(text(&courant(&["man"]).stdout).contains(".TH courant 1"));
    let limits = courant(&["man", "limits"]).stdout;
    assert!(text(&limits).contains("growth"));
    let place = tempfile::tempdir().unwrap();
    assert!(courant(&["man", "--out", place.path().to_str().unwrap()]).status.success());
    assert_eq!(std::fs::read(place.path().join("courant-limits.1")).unwrap(), limits);
    // Every page that the first one names is there.
    let page = std::fs::read_to_string(place.path().join("courant.1")).unwrap().replace('\\', "");
    let named: Vec<&str> = page.lines().filter_map(|line| line.strip_suffix("(1)")).collect();
    assert_eq!(named.len(), 14, "{named:?}");
    for name in named {
        assert!(place.path().join(format!("{name}.1")).exists(), "{name}");
    }
    let kernels = json(&["list", "kernels", "--format", "json"]);
    assert_eq!(kernels["kernels"].as_array().unwrap().len(), 7);
    let schemes = text(&courant(&["list", "schemes"]).stdout);
    assert!(schemes.contains("godunov-sph") && schemes.contains("(2.18)"));
}
