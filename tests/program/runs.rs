//! Lists of runs: a row for each combination.

use super::{courant, json, text};
use serde_json::Value;

/// Arguments in one string, with a directory for the files.
fn arguments<'a>(line: &'a str, out: &'a str) -> Vec<&'a str> {
    ["run"].into_iter().chain(line.split(' ')).chain(["--out", out]).collect()
}

fn rows(line: &str, out: &str) -> Vec<Value> {
    let answer = json(&[&arguments(line, out)[..], &["--format", "json"]].concat());
    assert_eq!(answer["schema"], "courant.run/1");
    // What differs from run to run of one program.
    let timeless = |row: &Value| {
        let mut row = row.clone();
        let keys = row.as_object_mut().unwrap();
        keys.remove("wall_seconds");
        keys.remove("schema");
        row
    };
    match answer["rows"].as_array() {
        Some(rows) => rows.iter().map(timeless).collect(),
        None => vec![timeless(&answer)],
    }
}

#[test]
fn every_row_of_a_list_is_the_run_alone() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    let several =
        rows("sod,noh --method gph3,lagrangian-roe --particles 20,30:40:10 --cfl 0.2,1/4", out);
    assert_eq!(several.len(), 2 * 2 * 3 * 2);
    let mut index = 0;
    for scene in ["sod", "noh"] {
        for method in ["gph3", "lagrangian-roe"] {
            for particles in ["20", "30", "40"] {
                for cfl in ["0.2", "0.25"] {
                    let one =
                        format!("{scene} --method {method} --particles {particles} --cfl {cfl}");
                    if (index + 1) % 5 == 0 {
                        assert_eq!(rows(&one, out), several[index..=index], "{one}");
                    }
                    let row = &several[index];
                    let found = [&row["scene"], &row["method"]];
                    assert_eq!(found, [scene, method]);
                    assert_eq!(row["particles"].to_string(), particles);
                    assert_eq!(row["cfl"].to_string(), cfl);
                    index += 1;
                }
            }
        }
    }
    for name in ["sod_gph3_particles-20_cfl-1-5.csv", "noh_lagrangian-roe_particles-40_cfl-1-4.png"]
    {
        assert!(place.path().join(name).is_file(), "{name}");
    }
}

#[test]
fn families_of_scenes_share_a_table_and_its_columns() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    let line = "sod,shear,advection-step --particles 100 --time 0.01";
    let refused = courant(&arguments(&format!("{line} --method gph1"), out));
    let error = text(&refused.stderr);
    assert_eq!((refused.status.code(), error.lines().count()), (Some(2), 1));
    assert!(error.contains("advection-step") && error.contains("godunov-sph"), "{error}");
    assert_eq!(std::fs::read_dir(&place).unwrap().count(), 0);
    let line = "sod,shear --particles 100 --time 0.01 --method gph1,sph1";
    let shown = text(&courant(&arguments(line, out)).stdout);
    assert!(shown.lines().all(|line| line.chars().count() <= 100), "{shown}");
    for word in ["sod", "GPH case 1", "(gph1)", "L1", "cross", "wrote"] {
        assert!(shown.contains(word), "{word}: {shown}");
    }
    let csv = courant(&[&arguments(line, out)[..], &["--format", "csv"]].concat());
    let mut reader = csv::Reader::from_reader(&csv.stdout[..]);
    let heads = reader.headers().unwrap().clone();
    let at = |name: &str| heads.iter().position(|head| head == name).unwrap();
    let records: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(records.len(), 4);
    for (record, has_measures) in records.iter().zip([false, false, true, true]) {
        assert_eq!(!record[at("measures_cross_velocity")].is_empty(), has_measures);
        assert!(!record[at("l1_density")].is_empty());
    }
}

#[test]
fn what_breaks_down_is_said_beside_what_does_not() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().to_str().unwrap();
    let output = courant(&arguments("ferrari3 --method sph-adke,lagrangian-rusanov", out));
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1));
    assert!(shown.contains("warning: sph-adke: broke down: "), "{shown}");
    assert!(shown.contains("(lagrangian-rusanov)"), "{shown}");
}
