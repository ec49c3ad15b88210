//! Scenes of a user's own, of every kind, and what is said before steps that are too long.

use super::{courant, json, text};
use serde_json::Value;
use std::path::Path;

/// A file of the tree with something changed, under another name.
fn changed(place: &Path, scene: &str, changes: &[(&str, &str)]) -> String {
    let file = format!("{}/simulation/scenes/{scene}.toml", env!("CARGO_MANIFEST_DIR"));
    let mut text = std::fs::read_to_string(file).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "{scene}: {from}");
        text = text.replacen(from, to, 1);
    }
    let path = place.join("mine.toml");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_string()
}

fn run(place: &Path, scene: &str, more: &str) -> Value {
    let out = place.join("out");
    let plain = ["run", scene, "--format", "json", "--out", out.to_str().unwrap()];
    let more: Vec<&str> = more.split(' ').filter(|word| !word.is_empty()).collect();
    json(&[&plain[..], &more].concat())
}

#[test]
fn a_scene_of_ones_own_is_the_named_one_with_other_numbers() {
    let place = tempfile::tempdir().unwrap();
    let place = place.path();
    for (scene, options, changes) in [
        ("advection-gaussian", "--particles 40", &[("amplitude = 1.0", "amplitude = 2.0")][..]),
        (
            "shear",
            "--particles 100 --time 0.3 --method gph3",
            &[("\nspeed = 1.0", "\nspeed = 0.5")],
        ),
        ("sedov", "--particles 216 --time 0.02 --method sph1", &[("energy = 1.0", "energy = 2.0")]),
        (
            "bonnor-ebert",
            "--particles 200 --time 0.2 --method sph1",
            &[("exact = \"static\"", ""), ("pressure = 1.03", "pressure = 2.03")],
        ),
    ] {
        let named = run(place, scene, options);
        let same = changed(place, scene, &[("name = ", "name = \"mine\" # ")]);
        let copy = run(place, &same, options);
        assert_eq!(copy["scene"], "mine");
        for key in ["steps", "time", "l1", "conservation", "measures"] {
            assert_eq!(copy[key], named[key], "{scene}: {key}");
        }
        let other = run(place, &changed(place, scene, changes), options);
        let found = |run: &Value| (run["l1"].clone(), run["measures"].clone());
        assert_ne!(found(&other), found(&named), "{scene}");
    }
}

#[test]
fn a_bad_scene_of_any_kind_is_told_by_its_line_and_writes_nothing() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("out");
    for (scene, from, to, words) in [
        ("shear", "[shear]", "[sheer]", ["line 11", "did you mean `shear`?"]),
        (
            "shear",
            "\nparticles",
            "\nmethod = \"godunov-sph\"\nparticles",
            ["line 9", "accepted: gph1"],
        ),
        ("evrard", "exponent = 1.0", "exponent = 4.0", ["line 9", "from 0 to below 3"]),
        ("advection-step", "\nvelocity = 1.0", "\nvelocity = 0", ["line 6", "other than 0"]),
    ] {
        let file = changed(place.path(), scene, &[(from, to)]);
        let output = courant(&["run", &file, "--method", "gph3", "--out", out.to_str().unwrap()]);
        let error = text(&output.stderr);
        assert_eq!((output.status.code(), error.lines().count()), (Some(2), 1), "{error}");
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
        assert!(!out.exists());
    }
}

#[test]
fn a_step_beyond_the_proved_limit_of_a_gas_method_is_told_before_the_run() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    let told = |line: &str| {
        let words = ["run"].into_iter().chain(line.split(' ')).chain(["--out", out]);
        let output = courant(&words.collect::<Vec<_>>());
        assert!(output.status.code() < Some(2), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    let short = "--particles 20 --time 0.01";
    // The upwind scheme, and Godunov SPH with the cubic spline at ratio 2.
    let volumes = told(&format!("sod --method finite-volume --cfl 1.1 {short}"));
    assert!(
        volumes.contains("C = 1.10000 is beyond") && volumes.contains("C = 1, by proof"),
        "{volumes}"
    );
    let lagrangian = told(&format!("sod --method lagrangian-exact --cfl 2 {short}"));
    assert!(lagrangian.contains("steps up to C = 15/8"), "{lagrangian}");
    for method in ["finite-volume", "lagrangian-roe", "gph1", "gph3", "gph4", "sph1", "sph-adke"] {
        assert_eq!(told(&format!("sod --method {method} {short}")), "", "{method}");
    }
    for scene in ["sound-wave", "sod"] {
        let long = told(&format!("{scene} --method gph3 --cfl 5 {short}"));
        let words = ["c Δt/h = 2.50000", "gph3 with centred-euler", "--cfl", "in one dimension"];
        assert!(words.iter().all(|word| long.contains(word)), "{long}");
    }
    // Without viscosity a Runge–Kutta step of second order lets every wave grow.
    let plain = told(&format!("sod --method sph1 --alpha 0 --beta 0 {short}"));
    assert!(plain.contains("no step, however small"), "{plain}");
}
