//! The program as a user meets it: answers, formats, exit codes, errors.

use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;

fn courant(arguments: &[&str]) -> std::process::Output {
    Command::cargo_bin("courant").unwrap().args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let output = courant(arguments);
    assert!(output.status.code().is_some_and(|code| code < 2), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

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
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin!("courant"));
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

/// The program with a standard output that nobody reads.
fn unread(arguments: &[&str]) -> std::process::Output {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin!("courant"));
    command.args(arguments).stdout(writer).output().unwrap()
}

#[test]
fn a_closed_pipe_does_not_change_the_answer() {
    let check = ["check", "--scheme", "upwind", "--cfl"];
    let validate =
        ["validate", "--scheme", "godunov-sph", "--ratio", "2", "--kernel", "cubic", "--cfl", "1"];
    let short = [&validate[..], &["--particles", "8", "--steps", "4"]].concat();
    for (arguments, code) in [
        ([&check[..], &["1/2"]].concat(), 0),
        ([&check[..], &["2"]].concat(), 1),
        (short.clone(), 0),
        ([&short[..], &["--fault", "0.1"]].concat(), 1),
        (vec!["list"], 0),
    ] {
        let output = unread(&arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}");
        assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    }
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("c.json");
    let file = file.to_str().unwrap();
    assert!(courant(&["limits", "--scheme", "upwind", "--certificate", file]).status.success());
    assert_eq!(unread(&["verify", file]).status.code(), Some(0));
    let forged = std::fs::read_to_string(file).unwrap().replace("\"1\"", "\"2\"");
    std::fs::write(file, forged).unwrap();
    assert_eq!(courant(&["verify", file]).status.code(), unread(&["verify", file]).status.code());
    assert_ne!(unread(&["verify", file]).status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn links_pipes_and_devices_are_written_through() {
    use std::os::unix::fs::FileTypeExt;
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    let certify = |name: &str| {
        let file = at(name);
        courant(&["limits", "--scheme", "upwind", "--certificate", file.to_str().unwrap()])
    };
    assert!(certify("plain").status.success());
    let wanted = std::fs::read(at("plain")).unwrap();
    std::os::unix::fs::symlink("behind", at("link")).unwrap();
    for _ in 0..2 {
        assert!(certify("link").status.success());
        assert!(at("link").is_symlink());
        assert_eq!(std::fs::read(at("behind")).unwrap(), wanted);
    }
    let make = |program: &str, arguments: &[&str]| {
        let made = std::process::Command::new(program).args(arguments).current_dir(&place).status();
        made.is_ok_and(|status| status.success())
    };
    if make("mkfifo", &["pipe"]) {
        let pipe = at("pipe");
        let reader = std::thread::spawn(move || std::fs::read(pipe).unwrap());
        assert!(certify("pipe").status.success());
        assert_eq!(reader.join().unwrap(), wanted);
        assert!(std::fs::metadata(at("pipe")).unwrap().file_type().is_fifo());
    }
    // Only where the test may make one: a device that swallows, as the one that everybody has.
    if make("mknod", &["swallows", "c", "1", "3"])
        && std::fs::write(at("swallows"), "x").is_ok()
        && std::fs::metadata(at("swallows")).unwrap().file_type().is_char_device()
    {
        assert!(certify("swallows").status.success());
        assert!(std::fs::metadata(at("swallows")).unwrap().file_type().is_char_device());
    }
}

#[test]
fn nothing_is_made_for_input_that_is_refused() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("out");
    let tube = ["run", "sod", "--method", "lagrangian-roe"];
    for (arguments, words) in [
        (vec!["run", "advection-gaussian", "--ratio", "1e-400"], ["--ratio", "1e-400"]),
        (vec!["run", "advection-gaussian", "--cfl", "1e-400"], ["--cfl", "1e-400"]),
        (vec!["run", "advection-gaussian", "--periods", "1e-320"], ["--periods", "1e-320"]),
        ([&tube[..], &["--time", "1e400"]].concat(), ["--time", "1e400"]),
        ([&tube[..], &["--contact", "1e400"]].concat(), ["--contact", "1e400"]),
    ] {
        let output = courant(&[&arguments[..], &["--out", out.to_str().unwrap()]].concat());
        let error = text(&output.stderr);
        assert_eq!((output.status.code(), error.lines().count()), (Some(2), 1), "{error}");
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
        assert!(!out.exists(), "{arguments:?}");
    }
}

#[test]
fn an_error_is_a_short_line_whatever_was_typed() {
    let long = "9".repeat(20_000);
    let words = "9 ".repeat(10_000);
    for value in [long.as_str(), words.as_str(), "1\n2", "1\u{1b}[31m"] {
        for arguments in [
            vec!["limits", "--scheme", "godunov-sph", "--ratio", value],
            vec!["limits", "--scheme", value],
            vec!["limits", "--equation", value],
            vec!["limits", "--scheme", "upwind", "--set", value],
            vec!["limits", "--method", "sph", "--ratio", "1", "--integrator", value],
            vec!["run", value],
            vec!["run", "sod", "--method", value],
            vec!["list", value],
            vec!["man", value],
            vec!["verify", value],
            vec![value],
        ] {
            let output = courant(&arguments);
            let error = text(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{}: {error}", arguments[0]);
            assert!(error.chars().count() < 2_000, "{error}");
            assert_eq!(error.lines().count(), 1, "{error}");
            assert!(!error.trim_end().contains(char::is_control), "{error:?}");
        }
    }
}

#[test]
fn a_method_that_serves_something_else_is_known() {
    let dispersion = ["dispersion", "--ratio", "1.2", "--kappa", "1", "--method"];
    let limits = ["limits", "--ratio", "1.2", "--integrator", "kdk", "--method"];
    for (arguments, words) in [
        (vec!["run", "sod", "--method", "gph1"], ["does not run sod", "sod-sph", "accepted"]),
        (vec!["run", "sod-sph", "--method", "sph-adke"], ["ferrari1", "simple-wave", "gph1, gph2"]),
        (vec!["run", "advection-step", "--method", "sph1"], ["noh", "godunov-sph", "accepted"]),
        (vec!["run", "sod", "--method", "upwind"], ["a scheme", "runs no scene", "sph-adke"]),
        (vec!["run", "sod", "--method", "sph"], ["waves are judged", "dispersion", "sph-adke"]),
        (vec!["run", "sod", "--method", "sph-adka"], ["no such", "did you mean", "`sph-adke`"]),
        ([&dispersion[..], &["gph1"]].concat(), ["--method", "runs scenes", "courant run"]),
        ([&dispersion[..], &["wcsph"]].concat(), ["weakly compressible", "sph", "--eos tait"]),
        ([&limits[..], &["wcsph"]].concat(), ["weakly compressible", "sph", "--eos tait"]),
        ([&limits[..], &["lagrangian-roe"]].concat(), ["runs scenes", "courant run", "methods"]),
        (vec!["limits", "--scheme", "upwind-3"], ["a space", "--space", "schemes"]),
        (vec!["limits", "--scheme", "rk4"], ["an integrator", "--integrator", "schemes"]),
    ] {
        let output = courant(&arguments);
        let error = text(&output.stderr);
        assert_eq!((output.status.code(), error.lines().count()), (Some(2), 1), "{error}");
        assert!(words.iter().all(|word| error.contains(word)), "{arguments:?}: {error}");
        assert!(!error.contains("sph-av`"), "{error}");
    }
}

#[test]
fn names_are_known_as_people_type_them() {
    let limits = |kernel: &str, integrator: &str| {
        let plain = ["limits", "--method", "sph", "--ratio", "1.2", "--format", "json"];
        let names = ["--kernel", kernel, "--integrator", integrator];
        json(&[&plain[..], &names].concat())["rows"].clone()
    };
    assert_eq!(limits("WendlandC2", "KDK"), limits("wendland-c2", "kdk"));
    assert_eq!(limits("cubic_spline", "symplectic"), limits("cubic", "symplectic-euler"));
    assert_eq!(limits("m4", "leapfrogkdk"), limits("cubic", "leapfrog-kdk"));
}

#[test]
fn every_list_of_dispersion_is_taken() {
    let rows = |lists: &[&str]| {
        let plain = ["dispersion", "--kappa", "1", "--format", "json"];
        json(&[&plain[..], lists].concat())["rows"].as_array().unwrap().clone()
    };
    let several = rows(&[
        "--method=sph,sph-av,gph",
        "--kernel=cubic,gaussian",
        "--ratio=1.1,1.2",
        "--alpha=1,2",
        "--form=resolved",
        "--density=summation,continuity",
        "--integrator=kdk,rk4",
        "--cfl=0.1,0.2",
    ]);
    // One method once, one twice for its viscosities, one in one form; two branches.
    assert_eq!(several.len(), (1 + 2 + 1) * 2 * 2 * 2 * 2 * 2 * 2);
    let one = rows(&[
        "--method=sph-av",
        "--kernel=gaussian",
        "--ratio=1.2",
        "--alpha=2",
        "--density=continuity",
        "--integrator=rk4",
        "--cfl=0.2",
    ]);
    for row in one {
        assert_eq!(several.iter().filter(|other| **other == row).count(), 1, "{row}");
    }
    assert_eq!(rows(&["--method=gph", "--ratio=1.2"])[0]["form"], "resolved");
    let refused =
        courant(&["dispersion", "--method=sph,gph", "--ratio=1", "--kappa=1", "--alpha=1"]);
    assert_eq!(refused.status.code(), Some(2));
}

/// What holds for comma-separated values of every command and file.
fn assert_dialect(table: &str, whence: &str) -> Vec<String> {
    let mut lines = table.lines();
    let names: Vec<String> =
        lines.next().unwrap_or_default().split(',').map(String::from).collect();
    for (index, name) in names.iter().enumerate() {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        assert!(!name.is_empty() && name.chars().all(plain), "{whence}: `{name}`");
        assert!(!names[..index].contains(name), "{whence}: `{name}` twice");
    }
    for cell in lines.flat_map(|line| line.split(',')) {
        let number = cell.parse::<f64>();
        assert!(cell != "–" && !cell.starts_with('−'), "{whence}: {cell}");
        assert!(number.is_err() || !cell.contains(['e', 'E', 'N']), "{whence}: {cell}");
    }
    names
}

#[test]
fn all_commands_and_files_speak_one_dialect_for_machines() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    let heads = |command: &str| {
        let words: Vec<&str> = command.split(' ').chain(["--format", "csv"]).collect();
        let output = courant(&words);
        assert!(output.status.success(), "{command}: {}", text(&output.stderr));
        assert_dialect(&text(&output.stdout), command)
    };
    let sph = "--method sph-av --ratio 1.2 --integrator kdk --kernel cubic";
    let short = "--particles 8 --steps 4 --cfl 0.1";
    let validated = [
        heads(&format!("validate --scheme godunov-sph --ratio 2 --kernel cubic {short}")),
        heads(&format!("validate --scheme upwind {short}")),
        heads(&format!("validate {sph} {short}")),
    ];
    assert!(validated.iter().all(|names| *names == validated[0]));
    let dispersion = heads(&format!("dispersion {sph} --cfl 0.1 --kappa 0,1"));
    let run = heads(&format!("run advection-step --particles 20 --out {out}"));
    for name in ["method", "kernel", "ratio", "cfl"] {
        assert!(dispersion.iter().any(|known| known == name), "{name}");
        assert!(run.iter().any(|known| known == name), "{name}");
        assert!(name == "method" || validated[0].iter().any(|known| known == name), "{name}");
    }
    assert!(run.iter().any(|name| name == "l1_value"));
    heads(&format!("run sod --method sph-adke --particles 20 --out {out}"));
    heads(&format!("run sod-sph --method gph1 --particles 20 --out {out}"));
    heads("list");
    heads("symbol --scheme upwind");
    heads("limits --scheme upwind --growth 1e-9");
    heads("check --scheme upwind --cfl 1/2");
    for map in [
        "map --scheme godunov-sph --ratio 1/4,1,2 --cfl 0:2:1",
        "map --scheme upwind --x C=0:1:1/2 --y C=0:1:1/2",
        "map --method sph --kappa 1,2,3 --ratio 1.1,1.2,1.3",
        "map --method sph-av --integrator kdk --ratio 1.1,1.2 --alpha 0,1",
    ] {
        let words: Vec<&str> = map.split(' ').chain(["--out", out]).collect();
        let output = courant(&words);
        // The axes of a map are two.
        assert_eq!(output.status.success(), !map.contains("y C"), "{}", text(&output.stderr));
    }
    let mut files = 0;
    for entry in std::fs::read_dir(out).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|end| end == "csv") {
            files += 1;
            let table = std::fs::read_to_string(&path).unwrap();
            assert_dialect(&table, path.to_str().unwrap());
        }
    }
    assert_eq!(files, 7);
}

#[test]
fn tables_fit_a_terminal() {
    let lists = "--kernel cubic,gaussian --ratio 1.2,1.3 --cfl 0.1,0.2";
    for command in [
        "list".into(),
        format!("dispersion --method sph,sph-av,gph {lists} --integrator kdk,rk4 --kappa 1"),
        format!("validate --method sph,sph-av {lists} --integrator kdk --particles 12 --steps 4"),
        "validate --method sph-av --kernel cubic --cfl 0.1 --particles 12 --steps 4".into(),
        format!("check --method sph,gph {lists} --integrator kdk --eos isothermal,ideal:7/5"),
        "validate --scheme godunov-sph --ratio 2 --kernel cubic --cfl 1 --particles 8".into(),
    ] {
        let output = courant(&command.split(' ').collect::<Vec<_>>());
        assert!(output.status.code() < Some(2), "{}", text(&output.stderr));
        let shown = text(&output.stdout);
        let widest = shown.lines().max_by_key(|line| line.chars().count()).unwrap();
        assert!(widest.chars().count() <= 100, "{command}: {widest}");
    }
}

#[test]
fn what_a_run_changes_or_leaves_out_is_said() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    let run = |arguments: &[&str]| {
        let all = [&["run"], arguments, &["--out", out]].concat();
        let shown = text(&courant(&all).stdout);
        let record = json(&[&all[..], &["--format", "json"]].concat());
        (shown, record["warnings"].clone())
    };
    let (shown, warnings) = run(&["advection-gaussian", "--cfl", "2.3"]);
    assert!(shown.contains("warning: C = 2.3 does not divide the way"), "{shown}");
    assert!(warnings[0].as_str().unwrap().contains("2.2988506"), "{warnings}");
    assert_eq!(run(&["advection-gaussian", "--cfl", "0.1"]).1, serde_json::json!([]));
    let tube = ["sod", "--method", "finite-volume", "--particles", "20"];
    let (shown, warnings) = run(&[&tube[..], &["--time", "10"]].concat());
    assert!(shown.contains("warning: every wave has left"), "{shown}");
    assert!(warnings[0].as_str().unwrap().contains("t = 10"), "{warnings}");
    assert_eq!(run(&tube).1, serde_json::json!([]));
}

#[cfg(target_os = "linux")]
#[test]
fn the_manual_is_rendered_on_a_terminal() {
    let place = tempfile::tempdir().unwrap();
    let program = assert_cmd::cargo::cargo_bin!("courant");
    let command = format!("'{}' man limits", program.display());
    let seen = std::process::Command::new("script")
        .args(["-qec", &command, place.path().join("typescript").to_str().unwrap()])
        .stdin(std::process::Stdio::null())
        .output();
    // Where there is no program that plays a terminal there is nothing to see.
    let Ok(seen) = seen else { return };
    let seen = String::from_utf8_lossy(&seen.stdout).replace('\r', "");
    assert!(seen.contains("courant-limits(1)") && seen.contains("--certificate"), "{seen}");
    assert!(!seen.contains(".TH") && !seen.contains("\\fB"), "{seen}");
}
