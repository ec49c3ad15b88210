//! `courant curves` as a user meets it.

use serde_json::Value;
use std::path::Path;
use std::process::Output;

fn courant(arguments: &[&str], out: &Path) -> Output {
    super::courant(&[&["curves"], arguments, &["--out", out.to_str().unwrap()]].concat())
}

fn json(arguments: &str) -> Value {
    let place = tempfile::tempdir().unwrap();
    let words: Vec<&str> = arguments.split(' ').chain(["--format", "json"]).collect();
    let output = courant(&words, place.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or_else(|| panic!("{key} of {row}"))
}

#[test]
fn schemes_and_values_make_one_figure_with_all_waves_beside_it() {
    let place = tempfile::tempdir().unwrap();
    let arguments = "--scheme upwind,lax-wendroff,fromm --set C=0.5,0.8 --format json";
    let output = courant(&arguments.split(' ').collect::<Vec<_>>(), place.path());
    assert!(output.status.success());
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(answer["schema"], "courant.curves/1");
    assert_eq!(answer["rows"].as_array().unwrap().len(), 3 * 2 * 128);
    assert_eq!(answer["metrics"].as_array().unwrap().len(), 3 * 2);
    let file = |end: &str| {
        let name = format!("curves_upwind_lax-wendroff_fromm{end}");
        std::fs::read(place.path().join(name)).unwrap()
    };
    assert_eq!(&file(".png")[1..4], b"PNG");
    assert!(file(".svg").starts_with(b"<svg"));
    let table = String::from_utf8(file(".csv")).unwrap();
    let heading = table.lines().next().unwrap();
    assert!(heading.ends_with(
        "direction,phase,branch,physical,gain,argument,phase_error,phase_speed,group_speed,exact_gain,exact_argument"
    ));
    assert_eq!(table.lines().count(), 1 + 3 * 2 * 128);
    let (array, columns) = (file(".npy"), String::from_utf8(file("_columns.txt")).unwrap());
    assert!(String::from_utf8_lossy(&array[..128]).contains("'shape': (768, 11)"));
    assert_eq!(columns.lines().count(), 11);
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 5);
}

#[test]
fn rows_are_those_of_the_multiplier() {
    let answer = json("--scheme lax-wendroff --set C=3/5 --phase 0:pi:pi/16");
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 16);
    for row in rows {
        for key in ["parameters", "branch", "physical", "phase_error", "group_speed"] {
            assert!(!row[key].is_null(), "{key} of {row}");
        }
        let (c, phase) = (0.6, number(row, "phase"));
        let (re, im) = (1.0 - c * c * (1.0 - phase.cos()), -c * phase.sin());
        assert!((number(row, "gain") - re.hypot(im)).abs() < 1e-12);
        let argument = im.atan2(re);
        assert!((number(row, "argument") - argument).abs() < 1e-12);
        assert!((number(row, "phase_speed") + argument / (c * phase)).abs() < 1e-12);
        assert!((number(row, "phase_error") - number(row, "phase_speed") + 1.0).abs() < 1e-15);
        // d arg z = Im(dz/z).
        let (d_re, d_im) = (-c * c * phase.sin(), -c * phase.cos());
        let group = -(re * d_im - im * d_re) / (re * re + im * im) / c;
        assert!((number(row, "group_speed") - group).abs() < 1e-12);
    }
}

#[test]
fn the_leapfrog_sends_the_sawtooth_back() {
    let answer = json("--scheme leapfrog --set C=1/2 --phase 0.001,pi");
    let rows = answer["rows"].as_array().unwrap();
    let of = |branch: u64| rows.iter().filter(move |row| row["branch"] == branch);
    let group: Vec<f64> = of(1).map(|row| number(row, "group_speed")).collect();
    assert!((group[0] - 1.0).abs() < 1e-5 && (group[1] + 1.0).abs() < 1e-12, "{group:?}");
    let computational: Vec<f64> = of(2).map(|row| number(row, "group_speed")).collect();
    assert!((computational[0] + 1.0).abs() < 1e-5 && (computational[1] - 1.0).abs() < 1e-12);
    assert!(of(1).all(|row| row["physical"] == true) && of(2).all(|row| row["physical"] == false));
}

#[test]
fn spaces_stand_without_an_integrator() {
    let answer = json("--space central-2,compact-6 --wavelengths 10");
    let metrics = answer["metrics"].as_array().unwrap();
    let efficiency =
        |metric: &Value, place: usize| number(&metric["resolution"][place], "resolving_efficiency");
    // Lele 1992, Table 1.
    assert!((efficiency(&metrics[0], 0) - 0.25).abs() < 5e-3);
    assert!((efficiency(&metrics[1], 0) - 0.70).abs() < 5e-3);
    assert!((efficiency(&metrics[1], 2) - 0.35).abs() < 5e-3);
    assert_eq!(metrics[0]["resolution"][3]["wavelengths"], 10.0);
    assert!((efficiency(&metrics[0], 3) - efficiency(&metrics[0], 1)).abs() < 1e-12);
    assert_eq!(metrics[0]["parameters"]["C"], "1");
}

#[test]
fn waves_of_a_plane_have_directions() {
    let answer = json("--scheme wave-2-2d --set C=1/2 --direction 0,45 --phase 1");
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2 * 2);
    assert_eq!(rows[0]["phase"], serde_json::json!([1.0, 0.0]));
    let speed = |sum: f64| 2.0 * (0.5 * sum.sqrt()).asin() / 0.5;
    let half = 0.5f64.sqrt();
    assert!((number(&rows[0], "phase_speed") - speed(0.5f64.sin().powi(2))).abs() < 1e-12);
    let diagonal = speed(2.0 * (0.5 * half).sin().powi(2));
    assert!((number(&rows[2], "phase_speed") - diagonal).abs() < 1e-12);
}

#[test]
fn particles_are_measured_by_sound() {
    let answer = json("--method sph,gph --ratio 1.2 --phase 0.001");
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2 * 2);
    for row in rows {
        assert_eq!(row["physical"], true);
        // The cubic spline at h/Δ = 1.2 hears sound up to a few hundredths wrong.
        assert!((number(row, "phase_speed") - 1.0).abs() < 0.05, "{row}");
    }
}

#[test]
fn typed_equations_are_measured_by_what_they_do_at_long_waves() {
    let place = tempfile::tempdir().unwrap();
    let upwind = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])";
    let arguments = ["--equation", upwind, "--set", "C=1/2", "--phase", "1", "--format", "json"];
    let output = courant(&arguments, place.path());
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    // At C = 1/2 upwind has no phase error.
    assert!(number(&answer["rows"][0], "phase_error").abs() < 1e-14);
}

#[test]
fn metrics_come_in_every_format() {
    let place = tempfile::tempdir().unwrap();
    for (format, sign) in [
        ("table", "10 %"),
        ("csv", "points_per_wavelength_0_1"),
        ("markdown", "|"),
        ("latex", "\\toprule"),
    ] {
        let arguments = ["--scheme", "upwind", "--set", "C=1/4,3/4", "--format", format];
        let output = courant(&arguments, place.path());
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && text.contains(sign), "{format}: {text}");
        assert!(
            format != "table"
                || text.lines().all(|l| l.chars().count() <= 100 || l.contains("courant"))
        );
    }
}

#[test]
fn bad_input_is_one_line_and_leaves_nothing() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("out");
    for (arguments, word) in [
        ("--scheme upwind", "C=…"),
        ("--scheme upwind --set C=x", "C=x"),
        ("--scheme upwind --set C=1/2 --phase 4", "--phase"),
        ("--scheme upwind --set C=1/2 --phase pie", "pie"),
        ("--scheme upwind --set C=1/2 --direction 30", "--direction"),
        ("--scheme upwind,donor-cell-2d --set C=1/2", "donor-cell-2d"),
        ("--scheme upwind --set C=0:1:0.01", "64"),
        ("--scheme upwind --set C=1/2 --exact K", "--exact"),
        ("--scheme upwind --set C=1/2 --wavelengths 0", "above 0"),
        ("--scheme donor-cell-2d --set C=1/2 --phase 4", "0°"),
    ] {
        let words: Vec<&str> = arguments.split(' ').collect();
        let output = courant(&words, &out);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments}: {error}");
        assert!(error.lines().count() == 1 && error.contains(word), "{arguments}: {error}");
        assert!(!out.exists(), "{arguments}");
    }
}
