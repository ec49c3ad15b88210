//! Gas dynamics from the command line.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_courant"))
}

fn courant(arguments: &[&str], out: &Path) -> (i32, String, String) {
    let output =
        program().args(arguments).arg("--out").arg(out).output().expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("no signal"), text(output.stdout), text(output.stderr))
}

fn json(arguments: &[&str], out: &Path) -> Value {
    let (code, text, problem) = courant(arguments, out);
    assert_eq!(code, 0, "{problem}");
    serde_json::from_str(&text).expect("one JSON object")
}

#[test]
fn every_test_runs_with_every_method() {
    let place = tempfile::tempdir().expect("a directory");
    let methods =
        ["lagrangian-exact", "lagrangian-rusanov", "lagrangian-roe", "finite-volume", "sph-adke"];
    for scene in ["ferrari1", "ferrari2", "ferrari3", "ferrari4"] {
        for method in methods {
            let fails = (scene, method) == ("ferrari3", "sph-adke");
            let arguments = ["run", scene, "--method", method, "--format", "json"];
            let (code, text, _) = courant(&arguments, place.path());
            assert_eq!(code, i32::from(fails));
            let run: Value = serde_json::from_str(&text).expect("one JSON object");
            assert_eq!(run["schema"], "courant.run/1");
            assert_eq!((&run["scene"], &run["method"]), (&scene.into(), &method.into()));
            assert_eq!(run["particles"], 100);
            assert_eq!(run["completed"], !fails, "{scene} {method}");
            assert_eq!(run["failure"].is_null(), !fails);
            for column in ["density", "velocity", "pressure", "energy"] {
                assert_eq!(run["l1"][column].as_f64().is_some(), !fails, "{run}");
            }
            assert_eq!(run["l1_note"].is_null(), !fails, "{run}");
            assert!(run["conservation_note"].is_null(), "{run}");
            for total in ["mass", "momentum", "energy"] {
                assert!(run["conservation"][total].as_f64().expect("finite").abs() < 1e-3);
            }
            for ending in ["csv", "png", "svg"] {
                assert!(place.path().join(format!("{scene}_{method}.{ending}")).exists());
            }
        }
    }
}

#[test]
fn options_reach_the_run() {
    let place = tempfile::tempdir().expect("a directory");
    let run = |more: &[&str]| {
        let plain = ["run", "sod", "--method", "lagrangian-roe", "--format", "json"];
        json(&[&plain[..], more].concat(), place.path())
    };
    let steps = |more: &[&str]| run(more)["steps"].as_u64().expect("a count");
    let usual = steps(&[]);
    assert!(steps(&["--particles", "200"]) > usual);
    assert!(steps(&["--cfl", "9/20"]) > usual);
    assert_eq!(run(&["--time", "0.1"])["time"], 0.1);
    let error = |more: &[&str]| run(more)["l1"]["density"].as_f64().expect("it ends");
    assert!(error(&["--ratio", "4"]) > error(&[]));
    assert_ne!(error(&["--kernel", "wendland-c2"]), error(&[]));
    for choice in [["--roe-mean", "volume"], ["--contact", "1/2"], ["--contact-form", "mass-flux"]]
    {
        assert_ne!(error(&choice), error(&[]), "{choice:?}");
    }
    let viscous = |alpha: &str, beta: &str| {
        let plain = ["run", "sod", "--method", "sph-adke", "--format", "json"];
        let run = json(&[&plain[..], &["--alpha", alpha, "--beta", beta]].concat(), place.path());
        run["l1"]["density"].as_f64().expect("it ends")
    };
    assert!(viscous("1", "2") != viscous("1/2", "2") && viscous("1", "2") != viscous("1", "1"));
    assert_eq!(
        (&run(&[])["ratio"], &run(&["--ratio", "7/3"])["ratio"]),
        (&"2".into(), &"7/3".into())
    );
    let wave = ["run", "simple-wave", "--method", "lagrangian-exact", "--format", "json"];
    // The amplitude is 0.1.
    assert!(json(&wave, place.path())["l1"]["density"].as_f64().expect("it ends") < 0.03);
}

#[test]
fn bad_input_is_one_line_and_writes_nothing() {
    let place = tempfile::tempdir().expect("a directory");
    let out = place.path().join("out");
    let volumes = ["run", "sod", "--method", "finite-volume"];
    let roe = ["run", "sod", "--method", "lagrangian-roe"];
    for (arguments, words) in [
        (vec!["run", "ferrari1"], ["--method", "sph-adke"]),
        (vec!["run", "ferrari1", "--method", "lagrangian-row"], ["lagrangian-row", "did you mean"]),
        (vec!["run", "ferrari9", "--method", "sph-adke"], ["ferrari9", "accepted"]),
        ([&volumes[..], &["--ratio", "2"]].concat(), ["--ratio 2", "finite-volume"]),
        ([&volumes[..], &["--kernel", "cubic"]].concat(), ["--kernel cubic-spline", "kernel"]),
        ([&roe[..], &["--particles", "5"]].concat(), ["--particles 5", "7"]),
        ([&roe[..], &["--ratio", "0.3"]].concat(), ["--ratio 3/10", "reach"]),
        (
            vec!["run", "ferrari4", "--method", "lagrangian-exact", "--time", "1e7"],
            ["particles", "would be needed, at most 10000000"],
        ),
        (
            vec!["run", "isothermal-tube", "--method", "finite-volume"],
            ["does not run isothermal-tube", "total energy"],
        ),
        ([&volumes[..], &["--alpha", "2"]].concat(), ["--alpha", "finite-volume"]),
        ([&roe[..], &["--beta", "2"]].concat(), ["--beta", "--contact-form"]),
        ([&roe[..], &["--riemann", "exact"]].concat(), ["--riemann", "lagrangian-roe"]),
        (vec!["run", "nowhere.toml", "--method", "lagrangian-roe"], ["nowhere.toml", "density"]),
    ] {
        let (code, text, problem) = courant(&arguments, &out);
        assert_eq!((code, text.as_str()), (2, ""), "{arguments:?}");
        assert_eq!(problem.lines().count(), 1, "{problem}");
        assert!(words.iter().all(|word| problem.contains(word)), "{problem}");
        assert!(!out.exists(), "{arguments:?}");
    }
}

#[test]
fn a_tube_of_ones_own_is_the_standard_one_under_another_name() {
    let place = tempfile::tempdir().expect("a directory");
    let file = place.path().join("mine.toml");
    let text = "gamma = 1.4\ndomain = [0.0, 1.0]\ndiaphragm = 0.5\nend_time = 0.2\n\n\
                [left]\ndensity = 1.0\nvelocity = 0.0\npressure = 1.0\n\n\
                [right]\ndensity = 0.125\nvelocity = 0.0\npressure = 0.1\n";
    std::fs::write(&file, text).expect("the directory accepts files");
    let path = file.to_str().expect("a plain path");
    let run = |scene: &str| {
        json(&["run", scene, "--method", "lagrangian-exact", "--format", "json"], place.path())
    };
    assert_eq!(run(path)["l1"], run("sod")["l1"]);
    assert_eq!(run(path)["scene"], "mine");
    for (from, to, line, word) in [
        ("density = 0.125", "density = -0.125", 12, "right.density = -0.125"),
        ("velocity = 0.0\npressure = 0.1\n", "velocity = 0.0\n", 12, "right.pressure is missing"),
        ("gamma = 1.4\n", "gamma = 1.4\nmethod = \"godunov\"\n", 2, "lagrangian-exact"),
    ] {
        std::fs::write(&file, text.replace(from, to)).expect("the directory accepts files");
        let (code, _, problem) =
            courant(&["run", path, "--method", "lagrangian-exact"], place.path());
        assert_eq!((code, problem.lines().count()), (2, 1), "{problem}");
        let wanted = format!("mine.toml, line {line}:");
        assert!(problem.contains(&wanted) && problem.contains(word), "{problem}");
    }
}

/// Tubes of other codes, the shock of Shu & Osher and Noh's streams among them, with every method.
#[test]
fn every_method_runs_every_scene_that_its_physics_covers() {
    let place = tempfile::tempdir().expect("a directory");
    for scene in ["toro4", "simple-wave", "isothermal-tube", "sjogreen", "shu-osher", "sound-wave"]
    {
        for method in ["finite-volume", "lagrangian-rusanov", "gph3", "sph1", "sph-adke"] {
            let arguments =
                ["run", scene, "--method", method, "--particles", "60", "--format", "json"];
            let (code, text, problem) = courant(&arguments, place.path());
            let isothermal = ["isothermal-tube", "sound-wave"].contains(&scene);
            if isothermal && ["finite-volume", "lagrangian-rusanov"].contains(&method) {
                assert!(code == 2 && problem.contains("isothermal"), "{scene} {method}: {problem}");
                continue;
            }
            let run: Value = serde_json::from_str(&text).expect("one JSON object");
            let cold = (scene, method) == ("toro4", "sph-adke");
            assert_eq!((code, &run["completed"]), (i32::from(cold), &(!cold).into()), "{run}");
        }
    }
}

#[test]
fn a_vacuum_has_no_particles_and_its_neighbour_runs_into_it() {
    let place = tempfile::tempdir().expect("a directory");
    let file = place.path().join("vacuum.toml");
    let text = "gamma = 1.6666666666666667\ndomain = [0, 2]\ndiaphragm = 1\nend_time = 0.05\n\
                [left]\ndensity = 0\nvelocity = 1\npressure = 0\n\
                [right]\ndensity = 0.124\nvelocity = 0.5\npressure = 1\n";
    std::fs::write(&file, text).expect("the directory accepts files");
    let path = file.to_str().expect("a plain path");
    for method in ["finite-volume", "lagrangian-exact", "gph2", "sph1", "sph-adke"] {
        let run = json(&["run", path, "--method", method, "--format", "json"], place.path());
        // A tenth of the density is a large error; all are far below.
        assert!(run["l1"]["density"].as_f64().expect("it ends") < 0.003, "{method} {run}");
    }
}

#[test]
fn unresolved_gas_is_told_with_a_number_that_would_do() {
    let place = tempfile::tempdir().expect("a directory");
    let arguments = ["run", "leblanc", "--method", "gph1", "--particles", "100", "--time", "0.1"];
    let run = json(&[&arguments[..], &["--format", "json"]].concat(), place.path());
    // Three units of gas on the left, 0.006 on the right.
    let warnings = run["warnings"].to_string();
    assert!(warnings.contains("0.20 of a particle's") && warnings.contains("5010"), "{warnings}");
}

#[test]
fn scenes_and_methods_are_listed_with_sources() {
    let list = |topic: &str| {
        let output = program().args(["list", topic, "--format", "json"]).output();
        let text = output.expect("the program starts").stdout;
        serde_json::from_slice::<Value>(&text).expect("one JSON object")[topic].clone()
    };
    let source = |list: &Value, name: &str| {
        let entries = list.as_array().expect("a list");
        let entry = entries.iter().find(|entry| entry["name"] == name).expect("it is listed");
        entry["source"].as_str().expect("text").to_string()
    };
    let scenes = list("scenes");
    for name in ["ferrari1", "ferrari2", "ferrari3", "ferrari4"] {
        assert!(source(&scenes, name).contains("Table 2"));
    }
    let methods = list("methods");
    for name in ["lagrangian-exact", "lagrangian-rusanov", "lagrangian-roe", "sph-adke"] {
        assert!(source(&methods, name).contains("Ferrari et al. 2008"), "{name}");
    }
    let figures = list("figures");
    for number in 3..=21 {
        // A name that both papers give carries the paper.
        let plain = format!("figure_{number:02}");
        let named = |name: &str| {
            let entries = figures.as_array().expect("a list");
            entries.iter().any(|entry| entry["name"] == name)
        };
        let name = if named(&plain) { plain } else { format!("ferrari2008/{plain}") };
        assert!(source(&figures, &name).ends_with(&format!("Figure {number}")), "{name}");
    }
}

#[test]
fn flows_and_clouds_state_what_they_assume_and_judge_themselves() {
    let out = tempfile::tempdir().expect("a directory");
    let shear = [
        "run",
        "shear",
        "--method",
        "sph1",
        "--particles",
        "144",
        "--time",
        "0.2",
        "--format",
        "json",
    ];
    let shear = json(&shear, out.path());
    assert_eq!((&shear["dimension"], &shear["eos"]), (&2.into(), &"isothermal, c = 1".into()));
    assert_eq!(shear["warnings"], Value::Array(Vec::new()));
    let lost = shear["measures"]["kinetic_energy_left"].as_f64().expect("a measure");
    assert!(lost > 0.5 && lost < 1.0, "{lost}");
    let collapse =
        ["run", "sis-collapse", "--method", "sph1", "--particles", "200", "--time", "0.05"];
    let collapse = json(&[&collapse[..], &["--format", "json"]].concat(), out.path());
    assert_eq!(collapse["dimension"], 3);
    // The sink gets the mass that the gas loses.
    let mass = collapse["conservation"]["mass"].as_f64().expect("it is counted");
    assert!(mass.abs() < 1e-12, "{mass:e}");
    // 200 particles do not resolve a sink of 0.03 radii.
    let warning = collapse["warnings"][0].as_str().expect("a warning");
    assert!(warning.contains("smoothing length") && warning.contains("would need"), "{warning}");
}

#[test]
fn options_of_flows_and_clouds_are_those_of_all_particles() {
    let out = tempfile::tempdir().expect("a directory");
    for (arguments, wanted) in [
        (&["shear", "--method", "gph4", "--kernel", "cubic"][..], "--kernel cubic-spline: gph4"),
        (&["shear", "--method", "gph3", "--alpha", "1"], "--alpha: gph3 has no such option"),
        (
            &["sis-collapse", "--method", "sph1", "--particles", "99"],
            "--particles 99: sph1 needs at least 100",
        ),
        (&["shear", "--method", "gph3", "--time", "1e9"], "steps of the size of the first"),
        (&["evrard", "--method", "sph1", "--time", "1e9"], "would be needed, at most 1000000"),
        (&["evrard", "--method", "sph-adke"], "--method sph-adke: it does not run evrard"),
        (&["gresho", "--method", "sph1", "--levels", "2"], "--integrator rk2-heun: --levels needs"),
        (
            &["sis-collapse", "--method", "gph3", "--lattice", "fcc"],
            "--lattice: scene sis-collapse",
        ),
    ] {
        let place = out.path().join("none");
        let (code, stdout, stderr) = courant(&[&["run"], arguments].concat(), &place);
        assert!(
            code == 2 && stdout.is_empty() && stderr.contains(wanted),
            "{arguments:?}: {stderr}"
        );
        assert!(!place.exists(), "{arguments:?} made a folder");
    }
}
