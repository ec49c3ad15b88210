//! Two and three space dimensions from the command line.

use super::courant;
use serde_json::{Value, json};

const WAVE: &str = "u[n+1,i,j] = 2*u[n,i,j] - u[n-1,i,j] + C^2*(u[n,i+1,j] + u[n,i-1,j] + u[n,i,j+1] + u[n,i,j-1] - 4*u[n,i,j])";
const HEAT: &str = "u[n+1,i,j,k] = u[n,i,j,k] + r*(u[n,i+1,j,k] + u[n,i-1,j,k] + u[n,i,j+1,k] + u[n,i,j-1,k] + u[n,i,j,k+1] + u[n,i,j,k-1] - 6*u[n,i,j,k])";

fn answer(arguments: &[&str]) -> Value {
    let output = courant(&[arguments, &["--format", "json"]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn every_wave_of_a_torus_is_validated() {
    let record = answer(&["validate", "--equation", WAVE, "--cfl", "0.7,0.8"]);
    assert_eq!((&record["passed"], &record["particles"]), (&json!(true), &json!([12, 10])));
    let rows = record["rows"].as_array().unwrap();
    // Two values, (120 + 4)/2 waves, two branches.
    assert_eq!(rows.len(), 2 * 62 * 2);
    assert_eq!((&rows[2]["mode"], &rows[2]["phase"][0]), (&json!([0, 1]), &json!(0.0)));
    // The shortest wave grows above √(1/2) and not below.
    let gain = |cfl: f64| {
        let of = rows.iter().filter(|row| row["cfl"] == cfl);
        of.map(|row| row["measured"]["gain"].as_f64().unwrap()).fold(0.0, f64::max)
    };
    assert!(gain(0.7) < 1.0 + 1e-7 && gain(0.8) > 1.5);
    let record = answer(&["validate", "--equation", HEAT, "--cfl", "0.1", "--particles", "4x5x6"]);
    assert_eq!((&record["passed"], &record["particles"]), (&json!(true), &json!([4, 5, 6])));
    let record = answer(&["validate", "--equation", HEAT, "--cfl", "0.1", "--particles", "4"]);
    assert_eq!(record["particles"], json!([4, 4, 4]));
}

#[test]
fn numbers_of_cells_that_do_not_fit_are_refused() {
    for (subject, cells) in [
        (&["--equation", WAVE][..], "8x8x8"),
        (&["--equation", HEAT], "8x8"),
        (&["--equation", HEAT], "30"),
        (&["--scheme", "godunov-sph"], "8x8"),
        (&["--method", "sph"], "8x8"),
        (&["--equation", WAVE], "8x3"),
        (&["--equation", WAVE], "200x200"),
        (&["--equation", WAVE], "8xx8"),
    ] {
        let output = courant(&[&["validate"], subject, &["--particles", cells]].concat());
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{cells}: {message}");
        assert!(message.contains("--particles") && message.contains("accepted"), "{message}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn symbols_name_the_shift_of_each_axis() {
    let equation = "u[n+1,i,j] = u[n,i,j] - A*(u[n,i,j] - u[n,i-1,j]) - B*(u[n,i,j] - u[n,i,j-1])";
    let record = answer(&["symbol", "--equation", equation, "--matrix"]);
    assert_eq!(record["characteristic_text"], "z + (-E_1^-1 A - E_2^-1 B - 1 + B + A) = 0");
    assert_eq!(record["latex"], "z + (-E_1^{-1} A - E_2^{-1} B - 1 + B + A) = 0");
    assert_eq!(record["matrix"], json!([["-E_1^-1 A - E_2^-1 B - 1 + B + A + z"]]));
    assert_eq!((&record["dimension"], &record["coefficients"]), (&json!(2), &Value::Null));
    let output = courant(&["symbol", "--equation", HEAT]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("E_1 = e^(iφ_x)") && text.contains("E_3 = e^(iφ_z)"), "{text}");
}
