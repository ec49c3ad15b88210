//! Waves of particle methods as a user meets them: `dispersion`, `limits`, `check`, `map`.

use courant::analysis::scheme::catalogue::PARTICLE_INTEGRATORS;
use serde_json::Value;
use std::process::{Command, Output};

fn courant(arguments: &str) -> Output {
    let words = arguments.split_whitespace();
    Command::new(env!("CARGO_BIN_EXE_courant")).args(words).output().unwrap()
}

fn json(arguments: &str) -> Value {
    let output = courant(&format!("{arguments} --format json"));
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code().is_some_and(|code| code < 2), "{errors}");
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(!text.contains(": NaN") && !text.contains(": inf"), "{text}");
    serde_json::from_str(&text).unwrap()
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or_else(|| panic!("{key} of {row}"))
}

#[test]
fn both_branches_of_both_forms_solve_their_relations() {
    let answer = json("dispersion --method gph --kernel cubic --ratio 1.2 --kappa 0.1:3.1:0.1");
    assert_eq!(answer["schema"], "courant.dispersion/1");
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2 * 31 * 2);
    for pair in rows.chunks(2) {
        let [forward, backward] = pair else { panic!("branches come in pairs") };
        assert_eq!(
            (&forward["branch"], &backward["branch"]),
            (&"forward".into(), &"backward".into())
        );
        assert_eq!(forward["form"], backward["form"]);
        let kappa = number(forward, "kappa");
        // The sums of the cubic spline at h/Δ = 6/5 by hand: neighbours at q = 5/6 and 5/3.
        let h: f64 = 1.2;
        let (q, p) = (1.0 / h, 2.0 / h);
        let shape = |q: f64| {
            if q < 1.0 { 2.0 / 3.0 - q * q + 0.5 * q * q * q } else { (2.0 - q).powi(3) / 6.0 }
        };
        let slope =
            |q: f64| if q < 1.0 { -2.0 * q + 1.5 * q * q } else { -0.5 * (2.0 - q).powi(2) };
        let curvature = |q: f64| if q < 1.0 { -2.0 + 3.0 * q } else { 2.0 - q };
        let density = (shape(0.0) + 2.0 * shape(q) + 2.0 * shape(p)) / h;
        let sum = |one: f64, two: f64, power: i32| 2.0 * (one + two) / (density * h.powi(power));
        let s = -sum(kappa.sin() * slope(q), (2.0 * kappa).sin() * slope(p), 2);
        let (one, two) = (1.0 - kappa.cos(), 1.0 - (2.0 * kappa).cos());
        let t = sum(one * curvature(q), two * curvature(p), 3);
        let d = -sum(one * slope(q), two * slope(p), 2);
        let squared = 2.0 * t - s * s;
        let sum_of = |key| number(forward, key) + number(backward, key);
        let (re, im) = ("omega_re", "omega_im");
        let product_re =
            number(forward, re) * number(backward, re) - number(forward, im) * number(backward, im);
        // Vieta: the sum of the roots is −icD or −cS, their product −ω0².
        assert!((product_re + squared).abs() < 1e-12, "{forward}");
        match forward["form"].as_str() {
            Some("resolved") => {
                assert!((sum_of(im) + d).abs() < 1e-12 && sum_of(re).abs() < 1e-12);
                assert!((number(forward, "amplitude") - number(forward, im).exp()).abs() < 1e-15);
            }
            Some("published") => {
                assert!((sum_of(re) + s).abs() < 1e-12 && sum_of(im) == 0.0, "{forward}");
                let error = -number(backward, re) / kappa - 1.0;
                assert!((number(backward, "phase_error") - error).abs() < 1e-14);
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn what_is_not_finite_is_null_with_a_reason() {
    let rows = json("dispersion --method sph --ratio 1 --kappa 0,1")["rows"].clone();
    assert!(rows[0]["phase_error"].is_null() && rows[0]["reason"].is_string());
    assert!(rows[2]["phase_error"].is_number() && rows[2].get("reason").is_none());
    // Stepped waves have frequencies too, over-damped ones among them.
    let rows = json(
        "dispersion --method sph-av --alpha 2 --ratio 1.5 --kappa 0.5:3:0.5 --integrator euler --cfl 0.3",
    )["rows"]
        .clone();
    assert!(rows.as_array().unwrap().iter().all(|row| row["omega_re"].is_number()));
    assert_eq!(rows[0]["integrator"], "forward-euler");
}

#[test]
fn limits_of_a_particle_method_are_proved() {
    let row =
        json("limits --method gph --integrator kdk-predicted --kernel cubic --ratio 1.2")["rows"]
            [0]
        .clone();
    assert_eq!(
        (&row["method"], &row["integrator"]),
        (&"gph".into(), &"leapfrog-kdk-predicted".into())
    );
    assert_eq!(row["ratio"], "6/5");
    assert_eq!(row["stability"]["exact"], "779/810");
    assert_eq!(row["stability"]["evidence"], "proved");
    assert!((number(&row, "per_spacing") - 779.0 / 810.0 * 1.2).abs() < 1e-15);
    assert!(row["monotonicity"].is_null() && row["monotonicity_reason"].is_string());
    let row =
        json("limits --method sph --integrator rk2 --ratio 1.2 --growth 1e-3")["rows"][0].clone();
    assert_eq!(row["stability"]["value"], 0.0);
    assert!(row["growth_limits"][0]["value"].as_f64().unwrap() > 0.15);
}

#[test]
fn check_answers_with_its_exit_code() {
    let code = |cfl: &str, more: &str| {
        let command = format!("check --method sph --integrator kdk --ratio 1 --cfl {cfl} {more}");
        courant(&command).status.code()
    };
    // The limit is √(1/2).
    assert_eq!((code("0.7", ""), code("0.71", "")), (Some(0), Some(1)));
    let answer = json("check --method sph --integrator rk4 --ratio 1 --cfl 1");
    assert_eq!(answer["verdict"], "marginal");
    let weak = "check --method sph --integrator rk2 --ratio 1.2 --cfl 0.1";
    assert_eq!(courant(weak).status.code(), Some(1));
    assert_eq!(courant(&format!("{weak} --growth 1e-3")).status.code(), Some(0));
}

#[test]
fn maps_are_written_for_every_plane() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    for (arguments, stem) in [
        (
            "--method gph --kappa 0.1:3.1:0.3 --h 1:1.5:0.1",
            "map_phase_error_gph_cubic-spline_resolved",
        ),
        (
            "--method sph-av --kappa 0.1:3.1:0.3 --alpha 0:3:0.5",
            "map_amplitude_sph-av_cubic-spline",
        ),
        (
            "--method sph-av --integrator kdk --h 1:2:0.5 --alpha 0:2:1",
            "map_stable_step_sph-av_cubic-spline_leapfrog-kdk",
        ),
    ] {
        let output = courant(&format!("map {arguments} --out {out}"));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        for end in ["png", "svg", "csv"] {
            assert!(place.path().join(format!("{stem}.{end}")).exists(), "{stem}.{end}");
        }
    }
}

#[test]
fn bad_input_is_one_line_and_writes_nothing() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("new");
    let out = out.to_str().unwrap();
    for (arguments, word) in [
        ("limits --ratio 1", "--scheme"),
        ("limits --method gph --ratio 1", "--integrator"),
        ("limits --scheme godunov-sph --method sph --integrator kdk --ratio 1", "--method"),
        ("limits --scheme godunov-sph --alpha 1 --ratio 1", "--alpha"),
        ("limits --method sph --alpha 1 --integrator kdk --ratio 1", "--alpha 1"),
        ("limits --method gph --form published --integrator kdk --ratio 1", "resolved"),
        ("limits --method sph --integrator kdkk --ratio 1", "leapfrog-kdk"),
        ("limits --method sph --integrator kdk --ratio 1 --samples 9", "--samples"),
        ("dispersion --method sph --ratio 1 --kappa 7", "2π"),
        ("dispersion --method sph --form both --ratio 1 --kappa 1", "--form"),
        ("dispersion --method sph --ratio 1 --kappa 1 --cfl 1", "--integrator"),
        (&format!("map --method sph --out {out}"), "--kappa"),
        (&format!("map --method sph --kappa 0:1:0.1 --h 1:2:0.1 --out {out}"), "above 0"),
        (&format!("map --method gph --kappa 0.1:1:0.1 --alpha 1:2:0.1 --out {out}"), "sph-av"),
        (&format!("map --method sph --kappa 0.1:1:0.1 --h 1:2:0.1 --cfl 1,2 --out {out}"), "--cfl"),
    ] {
        let output = courant(arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments}: {error}");
        assert_eq!(error.trim_end().lines().count(), 1, "{arguments}: {error}");
        assert!(error.contains(word), "{arguments}: {error}");
        assert!(output.stdout.is_empty());
    }
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 0);
}

#[test]
fn the_lists_name_integrators_and_wave_methods() {
    let answer = json("list");
    let names = |topic: &str| -> Vec<String> {
        let entries = answer[topic].as_array().unwrap();
        entries.iter().map(|entry| entry["name"].as_str().unwrap().to_owned()).collect()
    };
    // Whatever `validate` steps has a proved limit.
    for integrator in PARTICLE_INTEGRATORS {
        assert!(names("integrators").iter().any(|name| name == integrator), "{integrator}");
        let limits = format!("limits --method gph --integrator {integrator} --ratio 1");
        assert_eq!(json(&limits)["rows"][0]["stability"]["evidence"], "proved", "{integrator}");
        let case = "validate --method gph --kernel cubic --particles 8 --steps 2 --ratio 1";
        assert_eq!(json(&format!("{case} --integrator {integrator}"))["passed"], true);
    }
    for method in ["sph", "sph-av", "gph"] {
        assert!(names("methods").contains(&method.to_owned()));
    }
    assert!(names("figures").iter().any(|name| name.ends_with("figure_05")));
}
