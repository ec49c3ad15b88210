//! Manners of the program: pipes, links, names, warnings, widths.

use super::{courant, json, text};

/// The program with a standard output that nobody reads.
fn unread(arguments: &[&str]) -> std::process::Output {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_courant"));
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
        (
            vec!["run", "sod", "--method", "godunov-sph"],
            ["does not run sod", "advection-step", "gph1"],
        ),
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
        (vec!["limits", "--scheme", "gaussian"], ["a kernel", "--kernel", "schemes"]),
    ] {
        let output = courant(&arguments);
        let error = text(&output.stderr);
        assert_eq!((output.status.code(), error.lines().count()), (Some(2), 1), "{error}");
        assert!(words.iter().all(|word| error.contains(word)), "{arguments:?}: {error}");
        assert!(!error.contains("sph-av`"), "{error}");
        // What exists is not said not to.
        let unknown = arguments.iter().any(|name| ["wcsph", "sph-adka"].contains(name));
        assert_eq!(error.contains("no such"), unknown, "{error}");
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
    let place = tempfile::tempdir().unwrap();
    let out = ["--particles", "20", "--format", "json", "--out", place.path().to_str().unwrap()];
    let run = |names: [&str; 4]| json(&[&names[..], &out].concat())["l1"].clone();
    let typed = run(["run", "Sod_SPH", "--method", "LagrangianRoe"]);
    assert_eq!(typed, run(["run", "sod-sph", "--method", "lagrangian-roe"]));
    let kappa = |kappa: &str| {
        let plain = ["dispersion", "--method", "sph", "--ratio", "1.2", "--format", "json"];
        json(&[&plain[..], &["--kappa", kappa]].concat())["rows"].clone()
    };
    assert_eq!(kappa("pi/4:pi:pi/4")[2], kappa("pi/2")[0]);
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
    let program = env!("CARGO_BIN_EXE_courant");
    let command = format!("'{program}' man limits");
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
